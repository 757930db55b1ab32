"""The parent's side of the render process: starts it, sends it requests, and replaces it if it
dies."""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import warnings
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from io import FileIO
from pathlib import Path
from types import TracebackType
from typing import IO, TYPE_CHECKING, Literal, Self, cast

import numpy as np
from numpy.typing import NDArray

from ..choices import DeviceChoice, GlowName
from ..errors import LampblackWarning, RenderError
from ..own_folder import own_folder
from ..scene import Ambient, AreaLight
from .device import USED, memory_path
from .passes import DARK, LightPasses, Passes
from .spent import Activity
from .watched_pipe import Stalled, WatchedPipe, unblocked
from .wire import (
    Accumulate,
    Array,
    Failed,
    Load,
    Mixture,
    SaveBlend,
    Started,
    Trace,
    Traced,
    WireError,
    receive,
    send,
)

if TYPE_CHECKING:
    # A child is started before all that makes a request is loaded.
    from .request import RenderRequest, Surface

# The child gets only these: library and Python paths of a drawing program would break it.
KEPT_VARIABLES = (
    *("PATH", "HOME", "LANG", "SYSTEMROOT"),
    # They say which of a machine's graphics cards this process may use.
    *("CUDA_VISIBLE_DEVICES", "HIP_VISIBLE_DEVICES", "ROCR_VISIBLE_DEVICES"),
    *("ONEAPI_DEVICE_SELECTOR", "ZE_AFFINITY_MASK"),
)
KILLED = -9
"""Exit status of a process that was ended by SIGKILL."""
COMMAND = (sys.executable, "-I", "-m", "lampblack.render.child")
SLOW = (
    "The renderer hardly gets to work: the machine is busy, or short of memory. It is waited for; "
    "other programs can be closed."
)
CARD_LOST = "The graphics card may have failed. From now on the processor is used."

_STARTER = ThreadPoolExecutor(1, "render-starter")
"""The kernel ends a child with the thread that started it: this one lives on with the process."""


class RenderChild:
    """Cycles in its own process, so that a crash does not end the parent.

    Use as a context manager. The child starts at once, and loads while the parent continues. If
    it dies, the current render raises and the next one starts a new child. It ignores Ctrl-C in
    the terminal, and ends with the parent.

    A graphics card that fails is given up: what failed is to be asked again, and is then traced on
    the processor, as is all that follows.

    Args:
        niceness: of the child's process, 0 to 19.
        device: what it traces on. A card that is not there, or that is not right, is replaced by
            the processor, with a warning.

    Attributes:
        spent: processor seconds of all children so far, by activity.
        on_slow: called in the thread that waits for a child, if the machine keeps that child from
            its work; once for each child. By default it warns.

    Example:
        >>> with RenderChild() as child:
        ...     passes = child.render(frame_request(drawing.size, surface, scene))
    """

    def __init__(self, niceness: int = 0, device: DeviceChoice = "cpu") -> None:
        self._niceness = niceness
        self._wanted = device
        self._started: Started | None = None
        self._killed = self._told = self._slow = False
        self._surface: Surface | None = None
        self._process: subprocess.Popen[bytes] | None = None
        self._log: IO[bytes] | None = None
        self._folder: Path | None = None
        self._loaded = b""
        self.spent: dict[Activity, float] = defaultdict(float)
        self.on_slow: Callable[[], None] = _warn_of_slowness

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def render(self, request: RenderRequest) -> Passes:
        """Trace every light of ``request``, and the ambient light and emitters if it asks for them;
        or all lights, and the ambient light that they are mixed with, as one.

        The surface is sent only if it differs from the last one. Without ambient light, its pass
        is 1 x 1 zeros.

        Raises:
            RenderError: the child failed or died; rendering again starts a new one.
        """
        with self._conversation(request.surface):
            shining = [glow for glow in request.glows if glow in request.surface.emitters]
            glows = {glow: self._trace(request, glow=glow) for glow in shining}
            mixture = None
            if request.mixed_with is not None:
                together = Mixture(request.lights, request.mixed_with)
                mixture = self._trace(request, mixture=together)
                request = replace(request, lights=())
            lights = tuple(self._trace(request, light) for light in request.lights)
            ambient = self._trace(request) if request.ambient else DARK
            return Passes(lights, ambient, **glows, mixture=mixture, device=self._on.device)

    def accumulate(self, surface: Surface, job: Accumulate) -> tuple[NDArray[np.float32], ...]:
        """Trace more samples of one source; see ``Accumulate``.

        Returns:
            If resolved, diffuse and glossy light of the character, or the floor's light with and
            without the character, (h, w, 3) as in ``LightPasses``; otherwise nothing.

        Raises:
            RenderError: the child failed or died; the accumulation has to start again.
        """
        with self._conversation(surface):
            return self._ask(job)

    def save_blend(
        self,
        request: RenderRequest,
        ambient: Ambient,
        ink: Array,
        diffuse: Array,
        unlit: Array,
        path: Path,
    ) -> None:
        """Write the scene of ``request`` as a .blend. This ends the child.

        Args:
            request: its lights with their colours and powers.
            ink: (H, W, 4) float32 sRGB, straight alpha: the line over the character.
            diffuse, unlit: (V,) float32, 1 where a vertex is diffuse, or left as drawn.

        Raises:
            RenderError: Blender could not write it.
        """
        height, width = ink.shape[:2]
        job = SaveBlend(
            request.canvas, request.view, (width, height), request.lights, ambient, request.floor,
            str(path),
        )  # fmt: skip
        with self._conversation(request.surface):
            self._ask(job, [ink, diffuse, unlit])
        self._end()

    @contextlib.contextmanager
    def _conversation(self, surface: Surface) -> Iterator[None]:
        """A context in which a child runs and has ``surface``; if it dies, a RenderError."""
        try:
            self.start()
            self._await_start()
            if self._on.notice and not self._told:
                self._told = True
                warnings.warn(self._on.notice, LampblackWarning, stacklevel=4)
            self._load(surface)
            yield
        except (WireError, OSError) as error:
            raise self._lost(error) from error
        except RenderError as error:
            if self._give_up_card():
                error.remedy = CARD_LOST
                self._end()
            raise
        except BaseException:
            # An interrupted exchange cannot be resumed, so the child is ended.
            self._end()
            raise

    def kill(self) -> None:
        """End the current render, which then raises; any thread may call this."""
        process = self._process
        if process:
            self._killed = True
            process.kill()

    def close(self) -> None:
        """End the child; safe to call twice."""
        self._end()

    @property
    def pid(self) -> int | None:
        """Process id of the child, None while there is none."""
        return self._process.pid if self._process else None

    @property
    def card(self) -> str:
        """Name of the graphics card that the child traces on; empty if it has none, or before its
        first render."""
        started = self._started
        return started.name if started is not None else ""

    def device(self) -> Started:
        """What the child traces on; waits until it has loaded.

        Raises:
            RenderError: the child died.
        """
        try:
            self.start()
            self._await_start()
        except (WireError, OSError) as error:
            raise self._lost(error) from error
        return self._on

    def require_device(self) -> None:
        """Wait until it is known that the child traces on the device that was asked for by name.

        Raises:
            RenderError: it does not, or it died.
        """
        if self._wanted in ("auto", "cpu"):
            return
        started = self.device()
        if started.device != self._wanted:
            self._told = True
            what = started.notice.removesuffix(USED).strip()
            raise RenderError(what, "Leave out --device, or see what lampblack doctor finds.")

    @property
    def alive(self) -> bool:
        """Whether there is a child, and it has not ended."""
        return self._process is not None and self._process.poll() is None

    def start(self) -> None:
        """Start the child unless it runs. Returns at once, while the child loads."""
        if self.alive:
            return
        self._end()
        self._log = tempfile.TemporaryFile()  # noqa: SIM115 - lives as long as the child
        # Blender leaves its temporary folder behind when it is ended.
        self._folder = own_folder()
        self._killed = self._slow = False
        self._process = _STARTER.submit(
            subprocess.Popen,
            [*COMMAND, self._wanted, str(memory_path())],
            bufsize=0,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._log,
            env={
                **{name: os.environ[name] for name in KEPT_VARIABLES if name in os.environ},
                **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(self._folder)),
            },
            # The user's current folder may be a downloaded project: nothing in it is to be loaded.
            cwd=os.sep,
            start_new_session=True,
        ).result()
        unblocked(cast(FileIO, self._process.stdin))
        if self._niceness and hasattr(os, "setpriority"):
            os.setpriority(os.PRIO_PROCESS, self._process.pid, self._niceness)

    def _end(self) -> None:
        process, self._process, self._loaded = self._process, None, b""
        self._surface, self._started = None, None
        if process:
            process.kill()
            process.wait()
            for pipe in (process.stdin, process.stdout):
                with contextlib.suppress(OSError):
                    pipe and pipe.close()
        if self._log:
            self._log.close()
            self._log = None
        if self._folder:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None

    @property
    def _on(self) -> Started:
        assert self._started is not None
        return self._started

    def _await_start(self) -> None:
        """Read what the child traces on, once."""
        if self._started is not None:
            return
        message, _ = receive(self._pipe("stdout"))
        if isinstance(message, Failed):
            raise RenderError("The renderer could not start.", message.what, message.details)
        if not isinstance(message, Started):
            raise WireError(f"an unexpected {type(message).__name__}")
        self._started = message

    def _give_up_card(self) -> bool:
        """After a failure, trace on the processor from now on. Whether a card was used."""
        if self._killed or (self._started is not None and self._started.device == "cpu"):
            return False
        self._wanted = "cpu"
        return self._started is not None

    def _load(self, surface: Surface) -> None:
        if surface is self._surface:
            return
        arrays: list[Array] = [
            surface.relief.vertices,
            surface.relief.faces,
            surface.albedo,
            surface.gloss,
            surface.roughness,
        ]
        for emitter in surface.emitters.values():
            arrays += emitter.arrays
        digest = hashlib.blake2b(repr(tuple(surface.emitters)).encode())
        for array in arrays:
            digest.update(np.ascontiguousarray(array).data)
        if digest.digest() != self._loaded:
            send(self._pipe("stdin"), Load(tuple(surface.emitters)), arrays)
            self._loaded = digest.digest()
        self._surface = surface

    def _trace(
        self,
        request: RenderRequest,
        light: AreaLight | None = None,
        glow: GlowName | None = None,
        mixture: Mixture | None = None,
    ) -> LightPasses:
        place = request.canvas, request.view
        job = Trace(*place, light, request.floor, request.quality, glow, mixture)
        return LightPasses(*self._ask(job))

    def _ask(
        self, job: Trace | Accumulate | SaveBlend, arrays: Iterable[Array] = ()
    ) -> tuple[NDArray[np.float32], ...]:
        send(self._pipe("stdin"), job, arrays)
        message, arrays = receive(self._pipe("stdout"))
        if isinstance(message, Failed):
            self._loaded, self._surface = b"", None
            raise RenderError(
                "The renderer could not render this frame.", message.what, message.details
            )
        if not isinstance(message, Traced) or len(arrays) not in (0, 2, 4):
            raise WireError(f"an unexpected {type(message).__name__}")
        for activity, seconds in message.spent.items():
            self.spent[activity] += seconds
        return tuple(array.astype(np.float32, copy=False) for array in arrays)

    def _pipe(self, name: Literal["stdin", "stdout"]) -> WatchedPipe:
        """The child's end ``name``, unbuffered."""
        assert self._process is not None
        end = cast(FileIO, getattr(self._process, name))
        return WatchedPipe(end, self._process.pid, self._tell_slow)

    def _tell_slow(self) -> None:
        if not self._slow:
            self._slow = True
            self.on_slow()

    def _lost(self, error: Exception) -> RenderError:
        """Clean up after a dead child. Returns the error with its exit status and log."""
        status, log = None, ""
        if self._process and self._log:
            with contextlib.suppress(subprocess.TimeoutExpired):
                # A child that hangs has no status to wait for.
                status = self._process.wait(timeout=0 if isinstance(error, Stalled) else 2)
            self._log.seek(max(0, self._log.seek(0, os.SEEK_END) - 4096))
            log = self._log.read().decode(errors="replace").strip()
        gave_up = self._give_up_card()
        self._end()
        remedy = CARD_LOST if gave_up else "Try again; the renderer starts anew by itself."
        if status == KILLED:
            remedy += " If the machine ran out of memory, choose a lower quality."
        details = f"exit status {status}; {error}\n{log}".strip()
        return RenderError("The renderer stopped unexpectedly.", remedy, details)


def _warn_of_slowness() -> None:
    warnings.warn(SLOW, LampblackWarning, stacklevel=2)
