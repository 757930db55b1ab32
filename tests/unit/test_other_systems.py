"""Windows and macOS on paper: what they lack is taken away, and the rest has to go on."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

from support.paths import ROOT

WORKER = ROOT / "worker" / "lampblack"
PAGE = ROOT / "docs" / "research" / "other-systems.md"
LINUX_ONLY = {
    "os": "pidfd_open eventfd eventfd_read eventfd_write EFD_NONBLOCK EFD_CLOEXEC memfd_create "
    "sched_getaffinity sched_setaffinity posix_fadvise sendfile splice",
    "signal": "pidfd_send_signal",
    "select": "epoll",
}
"""What Python has on Linux and not on macOS."""
POSIX_ONLY = {
    "os": "nice getuid geteuid getgid getpgid setsid killpg fork forkpty wait3 wait4 "
    "mkfifo mknod statvfs sysconf uname getloadavg setpriority getpriority set_blocking chown "
    "O_CLOEXEC O_NONBLOCK O_NOFOLLOW O_DIRECTORY posix_spawn register_at_fork",
    "signal": "SIGKILL SIGHUP SIGCHLD SIGCONT SIGSTOP SIGUSR1 SIGUSR2 SIGPIPE SIGALRM alarm "
    "pthread_sigmask setitimer",
    "select": "poll",
    "resource": "",
    "fcntl": "",
    "pwd": "",
    "grp": "",
    "termios": "",
}
"""What Python has on Linux and macOS, and not on Windows (``set_blocking`` is since 3.12)."""
SYSTEMS = {"darwin": [LINUX_ONLY], "win32": [LINUX_ONLY, POSIX_ONLY]}


def lacking(system: str) -> dict[str, set[str]]:
    """The names that each module lacks there; none: the whole module."""
    lacks: dict[str, set[str]] = {}
    for table in SYSTEMS[system]:
        for module, names in table.items():
            lacks.setdefault(module, set()).update(names.split())
    return lacks


def calls(path: Path, system: str) -> set[str]:
    """Names in a file that the system lacks: not those in a branch or ``try`` that asks first."""
    lacks, found = lacking(system), set()

    def look(node: ast.AST) -> None:
        asks = isinstance(node, ast.If) and re.search(
            r"hasattr|sys\.platform|os\.name", ast.unparse(node.test)
        )
        asks = asks or (isinstance(node, ast.Try) and "ImportError" in ast.unparse(node))
        if asks:
            return
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            module, attribute = node.value.id, node.attr
            whole = module in lacks and not lacks[module] and not attribute.isupper()
            if whole or attribute in lacks.get(module, ()):
                found.add(f"{module}.{attribute}")
        for child in ast.iter_child_nodes(node):
            look(child)

    look(ast.parse(path.read_text()))
    return found


def told() -> dict[str, set[tuple[str, str]]]:
    """For each system the files and calls that the page names."""
    systems: dict[str, set[tuple[str, str]]] = {"win32": set(), "darwin": set()}
    for row in re.findall(r"^\| `(\S+\.py)` \| (.*?) \| (.*?) \|", PAGE.read_text(), re.MULTILINE):
        for system, title in (("win32", "Windows"), ("darwin", "macOS")):
            if title in row[2]:
                systems[system] |= {(row[0], call) for call in re.findall(r"`(.*?)`", row[1])}
    return systems


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_page_names_every_call_that_a_system_lacks(system: str) -> None:
    found = {
        (str(path.relative_to(WORKER)), call)
        for path in WORKER.rglob("*.py")
        for call in calls(path, system)
    }
    assert found == told()[system]


FAKE = """
import importlib, os, pkgutil, sys
import lampblack
names = [m.name for m in pkgutil.walk_packages(lampblack.__path__, "lampblack.")]
names = [n for n in names if n != "lampblack.__main__" and ".render." not in n]
for name in names:  # what they import of others stays
    importlib.import_module(name)
for name in [n for n in sys.modules if n.partition(".")[0] == "lampblack"]:
    del sys.modules[name]
for module, lost in LACKS.items():
    if lost:
        for name in lost:
            if hasattr(sys.modules[module], name):
                delattr(sys.modules[module], name)
    else:
        sys.modules[module] = None
sys.platform = SYSTEM  # not os.name: pathlib asks it for the kind of path
broken = []
for name in names:
    try:
        importlib.import_module(name)
    except Exception as error:
        broken.append((name, repr(error)))
print(broken)
"""
TALK = """
import tempfile, zmq
from pathlib import Path
from lampblack.service.client import Client
from lampblack.service.keys import make_keys, only_admitted, read_keys, read_public_key
from lampblack.service.socket import RouterSocket
folder = Path(tempfile.mkdtemp())
make_keys(folder, "studio")
make_keys(folder / "admitted", "ana")
context = zmq.Context()
ana = read_keys(folder / "admitted" / "ana.key_secret")
with only_admitted(context, folder / "admitted"):
    router = RouterSocket(context, "tcp://127.0.0.1:*", read_keys(folder / "studio.key_secret"))
    endpoint = router._router.getsockopt_string(zmq.LAST_ENDPOINT)
    with Client(endpoint, ana, read_public_key(folder / "studio.key")) as client:
        client.socket.send(b"hello")
        heard = []
        while not heard:
            router.wait(5)
            heard = [frames for _, frames in router.messages()]
        router.post(lambda: print("woken", heard))
        router.wait(5)
        for event in router.events():
            event()
    router.close()
context.term()
"""
DOCTOR = """
from lampblack.cli import doctor
from lampblack.cli.app import app
for check in ("_temporary_folder", "_network", "_cards", "_cycles", "_live_preview"):
    setattr(doctor, check, lambda: "not tried")
app(["doctor"], standalone_mode=False)
"""


def faked(system: str, program: str) -> str:
    """What a program prints on a Python that has only what the system has."""
    head = f"LACKS = {lacking(system)!r}\nSYSTEM = {system!r}\n"
    done = subprocess.run(
        [sys.executable, "-c", head + program], capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_worker_and_the_command_line_can_be_imported(system: str) -> None:
    broken = faked(system, FAKE)
    measuring = ("animation", "final", "memory", "relight", "scale") if system == "win32" else ()
    assert re.findall(r"\('lampblack\.([\w.]+)'", broken) == [f"bench.{m}" for m in measuring]


@pytest.mark.parametrize("system", SYSTEMS)
def test_a_worker_talks_to_other_machines(system: str) -> None:
    assert "woken [[b'hello']]" in faked(system, FAKE + TALK)


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_doctor_tells_of_the_machine(system: str) -> None:
    (machine,) = re.findall(r"^machine: .*", faked(system, FAKE + DOCTOR), re.MULTILINE)
    assert re.search(r", \d+ cores", machine)
    assert machine.endswith(" GiB") == (system != "win32"), "Windows has no sysconf"
