"""The command line itself: its help, what it imports, and settings that go there and back."""

from __future__ import annotations

import random
import subprocess
import sys
from typing import get_args

import msgspec
import pytest
import typer

from lampblack.choices import (
    ApartKind,
    BodyChoice,
    DeviceChoice,
    FileFormat,
    FrameLayers,
    LayerRole,
    QualityName,
    SolverName,
)
from lampblack.cli.app import COMMANDS, DATASET_COMMANDS, RIG_COMMANDS
from lampblack.cli.lazy import LazyCommand
from lampblack.cli.options import OPTIONS, with_settings
from lampblack.finals.settings import RenderSettings
from support.command_line import Run

ALL = COMMANDS | {f"dataset {name}": listed for name, listed in DATASET_COMMANDS.items()}
ALL |= {f"rig {name}": listed for name, listed in RIG_COMMANDS.items()}
HEAVY = {"OpenEXR", "PIL", "bpy", "numba", "numpy", "rich", "scipy", "torch", "trimesh"}


@pytest.mark.parametrize("name", ALL)
def test_every_command_helps(run: Run, name: str) -> None:
    shown = run(*name.split(), "--help")
    assert shown.code == 0
    assert f"Example: lampblack {name}" in shown.out
    command = LazyCommand(name, *ALL[name]).load()
    assert command.help.partition("\n")[0] == ALL[name][1]
    for parameter in command.params:
        words = (parameter.help or "").split()
        assert words, f"{name} does not explain {parameter.name}"
        assert words[0] not in ("Of", "Its"), f"{name} does not name {parameter.name}"


def test_help_lists_every_command(run: Run) -> None:
    shown = run("--help")
    assert all(
        f"{name} " in shown.out and listed[1] in shown.out for name, listed in COMMANDS.items()
    )
    assert run("render").code == 2
    assert "Did you mean 'render'" in run("rendr").err


def test_a_command_that_is_not_installed_is_named(
    run: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in [name for name in sys.modules if name.startswith("lampblack_research")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, "lampblack_research", None)
    told = run("train", "data")
    assert told.code == 1
    assert "train" in told.err


def test_help_imports_nothing_heavy() -> None:
    """Help should come at once; ``lampblack.cli`` and the package itself import little."""
    helped = [["--help"]] + [[n, "--help"] for n, at in COMMANDS.items() if "research" not in at[0]]
    program = f"""
import sys
import lampblack
from lampblack.cli.app import app
for words in {helped}:
    app(words, standalone_mode=False)
print(*{HEAVY} & set(sys.modules), file=sys.stderr)
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stderr.split() == []


def parse(arguments: list[str]) -> RenderSettings:
    """What ``lampblack render`` makes of ``arguments``."""
    seen: list[RenderSettings] = []
    app = typer.Typer()
    names = set(OPTIONS) - {"input", "frame"}
    app.command()(with_settings(*names)(seen.append))
    app(arguments, standalone_mode=False)
    return seen[0]


def some_settings(random: random.Random) -> RenderSettings:
    """Each field filled in, some with words that look like options."""
    texts = ["a b", "-b", "--c", "d,e", "=", "ü", "%04d", "{{Task.Param.Frames}}", "'", '"', "[1]"]

    def few() -> list[str]:
        return random.sample(texts, random.randint(1, 4))

    return RenderSettings(
        inputs=(f"walk{random.randint(0, 9)}.pclx", "b c"),
        output=f"lit {random.randint(0, 9)}",
        scene=random.choice(texts),
        rig=random.choice(texts),
        look=random.choice(texts),
        lights=tuple(few()),
        floor=random.uniform(-9, 9),
        quality=random.choice(get_args(QualityName)),
        depth_hints=random.choice(texts),
        frames=random.choice(texts),
        sheet=random.choice(texts),
        format=random.choice(get_args(FileFormat)),
        mask=random.choice(texts),
        ink=random.choice(texts),
        grids=random.randint(1, 64),
        solver=random.choice(get_args(SolverName)),
        roles={name: random.choice(get_args(LayerRole)) for name in few()},
        bodies={name: random.choice(get_args(BodyChoice)) for name in few()},
        camera=random.choice(texts),
        layers=random.choice(get_args(FrameLayers)),
        apart=random.choice(get_args(ApartKind)),
        device=random.choice(get_args(DeviceChoice)),
        steady=random.random() < 0.5,
        again=random.random() < 0.5,
    )


def test_settings_survive_the_command_line() -> None:
    plain = RenderSettings(inputs=("a",), output="b")
    assert parse(plain.arguments()) == plain
    changed: set[str] = set()
    for seed in range(60):
        settings = some_settings(random.Random(seed))
        assert parse(settings.arguments()) == settings
        assert msgspec.json.decode(msgspec.json.encode(settings), type=RenderSettings) == settings
        fields = RenderSettings.__struct_fields__
        changed |= {name for name in fields if getattr(settings, name) != getattr(plain, name)}
    assert changed == set(RenderSettings.__struct_fields__)


def test_every_setting_has_an_option() -> None:
    made = {"input": "inputs", "frame": "frames", "layer_body": "bodies"}
    made |= dict.fromkeys(get_args(LayerRole), "roles")
    assert {made.get(name, name) for name in OPTIONS} == set(RenderSettings.__struct_fields__)
