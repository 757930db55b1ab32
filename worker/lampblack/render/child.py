"""The render process: ``python -m lampblack.render.child DEVICE MEMORY``. Only this process runs
Blender. DEVICE is a ``DeviceChoice``, MEMORY the file of what is known of graphics cards.

Its first message says on what it traces. It reads requests from stdin and writes answers to its
original stdout, until either closes.
"""

from __future__ import annotations

import ctypes
import os
import queue
import signal
import sys
import threading
import traceback
from collections.abc import Iterator
from functools import cache
from io import FileIO
from pathlib import Path
from typing import NoReturn, cast

from ..choices import DeviceChoice
from .spent import take_spent
from .wire import (
    Accumulate,
    Array,
    Failed,
    Load,
    Message,
    SaveBlend,
    Trace,
    Traced,
    WireError,
    receive,
    send,
)

PR_SET_PDEATHSIG = 1

Received = tuple[Message, list[Array]]


def main() -> NoReturn:
    """Serve requests until the parent ends."""
    _end_with_parent()
    answers = private_stdout()
    inbox: queue.SimpleQueue[Received] = queue.SimpleQueue()
    threading.Thread(target=_read_requests, args=(inbox,), daemon=True).start()

    from .accumulation import Accumulation
    from .trace import trace
    from .trial import set_up

    stage, denoiser, started = set_up(cast(DeviceChoice, sys.argv[1]), Path(sys.argv[2]))
    send(answers, started)
    accumulation = Accumulation()
    while True:
        message, arrays = inbox.get()
        try:
            if isinstance(message, Load):
                emitters = zip(message.emitters, _threes(arrays[5:]), strict=True)
                stage.set_surface(arrays[:5], dict(emitters))
                accumulation = Accumulation()
            elif isinstance(message, Accumulate):
                light = accumulation.accumulate(stage, denoiser, message)
                send(answers, Traced(take_spent()), light)
            elif isinstance(message, Trace):
                passes = trace(stage, denoiser, message)
                found = (passes.diffuse, passes.glossy, passes.floor, passes.open_floor)
                send(answers, Traced(take_spent()), [array for array in found if array is not None])
            elif isinstance(message, SaveBlend):
                from .blend import save_blend

                save_blend(stage, message, *arrays)  # type: ignore[arg-type]
                send(answers, Traced())
                os._exit(0)
        except OSError:
            os._exit(0)
        except Exception as error:
            send(answers, Failed(str(error), traceback.format_exc()))


@cache
def private_stdout() -> FileIO:
    """The stream of the answers, on the original stdout. Descriptor 1, to which Blender prints from
    its import on, is redirected."""
    answers = FileIO(os.dup(1), "wb")
    silence = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silence, 1)
    os.close(silence)
    return answers


def _end_with_parent() -> None:
    """Let the kernel end this process with its parent. The end of the requests says it too, but not
    to a process that is stopped."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def _threes(arrays: list[Array]) -> Iterator[list[Array]]:
    """Vertices, faces and radiance of each emitter."""
    return (arrays[first : first + 3] for first in range(0, len(arrays), 3))


def _read_requests(inbox: queue.SimpleQueue[Received]) -> None:
    """Queue requests. When the parent has ended, end at once, even during a render."""
    requests = FileIO(sys.stdin.fileno(), "rb", closefd=False)
    try:
        while True:
            inbox.put(receive(requests))
    except (WireError, OSError):
        os._exit(0)


if __name__ == "__main__":
    main()
