"""Target files: the file of each frame, and whether it is up to date."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import get_args

from ..choices import ApartKind, DeviceChoice, DeviceKind, FileFormat
from ..composite.apart import LAYERS
from ..drawing import PICTURE_SUFFIXES
from ..drawing.numbering import numbered_names
from ..errors import LampblackError
from ..shot import ShotFrame
from .exr import exr_stamp
from .ora import ora_stamp
from .png import png_stamp

_STAMPS = {".png": png_stamp, ".exr": exr_stamp, ".ora": ora_stamp}


class Targets:
    """The files of frames. ``output`` is a folder (frames keep their names), a pattern
    (``out/a.%04d.png``, ``out/a####.exr``, ``out/a..png``), or one file name for one frame.

    Args:
        output: folder, pattern or file name.
        kind: file format; None is that of the pattern's suffix, or the first of ``kinds``.
        kinds: allowed file formats, as suffixes.
        apart: kind of the files of layers of each frame.
        ending: what names in a folder end with, before the suffix.

    Raises:
        LampblackError: the suffix is not in ``kinds``, or is not ``kind``, or does not fit
            ``apart``.
    """

    def __init__(
        self,
        output: str,
        kind: str | None = None,
        kinds: tuple[str, ...] = get_args(FileFormat),
        apart: ApartKind = "none",
        ending: str = "",
    ) -> None:
        self._ending = ending
        self._path = Path(output)
        number = numbered_names(self._path.name)
        suffix = self._path.suffix.lower().removeprefix(".")
        named = suffix in kinds and not self._path.is_dir()
        if number and not named:
            raise LampblackError(
                f"{output} is not of a file format that can be written here.",
                f"Name a folder, or files that end in {' or '.join(f'.{kind}' for kind in kinds)}.",
            )
        if len(number) > 1:
            raise LampblackError(f"{output} has two places for the frame number.", "Leave one.")
        if named and kind is not None and kind != suffix:
            raise LampblackError(
                f"{output} ends in .{suffix}, but --format says {kind}.", "Leave one of them out."
            )
        usual = "exr" if apart == "exr" else kinds[0]
        self.kind = kind or (suffix if named else usual)
        if apart != "none" and (apart == "exr") != (self.kind == "exr"):
            raise LampblackError(
                f"--apart {apart} cannot be used with frames in {self.kind.upper()}.",
                "Write PNG, or take EXR apart with --apart exr.",
            )
        self.apart = apart
        self._number = number[0] if number else None
        self._named = named

    @property
    def folder(self) -> Path:
        """The folder of all files."""
        return self._path.parent if self._named else self._path

    def path(self, frame: ShotFrame) -> Path:
        """The file of ``frame``."""
        if not self._named:
            return self._path / f"{Path(frame.name).stem}{self._ending}.{self.kind}"
        if self._number is None:
            return self._path
        assert frame.number is not None
        return self._path.with_name(self._number.name(frame.number))

    def paths(self, frame: ShotFrame) -> list[Path]:
        """All files of ``frame``: its layers, and last the frame itself."""
        layers: list[Path] = []
        if self.apart == "ora":
            layers = [self.ora(frame)]
        elif self.apart in ("png", "pencil2d"):
            layers = [self.layer(frame, name) for name, _ in LAYERS]
        return [*layers, self.path(frame)]

    def ora(self, frame: ShotFrame) -> Path:
        """The OpenRaster file of ``frame``."""
        return self.path(frame).with_suffix(".ora")

    def layer(self, frame: ShotFrame, name: str) -> Path:
        """The file of one layer of ``frame``, in a folder named after the layer."""
        path = self.path(frame)
        return path.parent / name / path.name

    def prepare(self, frames: Sequence[ShotFrame], sources: Sequence[Path]) -> None:
        """Create the folder. Jobs that would lose a file are refused before any work.

        Raises:
            LampblackError: two frames would share a file, a source would be replaced, or the
                folder cannot be made.
        """
        if self._number is not None and any(frame.number is None for frame in frames):
            raise LampblackError(
                "The inputs have no numbers to put into the pattern.", "Name an output folder."
            )
        if self._named and self._number is None and len(frames) > 1:
            raise LampblackError(
                f"{len(frames)} frames cannot all be written to {self._path}.",
                f"Put a number into its name: {self._path.stem}.%04d{self._path.suffix}.",
            )
        twice = [name for name, n in Counter(self.path(f).name for f in frames).items() if n > 1]
        if twice:
            raise LampblackError(
                f"Two inputs are named {twice[0]}: one result would replace the other.",
                "Render them into different folders.",
            )
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            for path in self.paths(frames[0])[:-1] if frames else ():
                path.parent.mkdir(exist_ok=True)
            folder = self.folder.resolve()
        except OSError as error:
            raise LampblackError(
                f"The output folder {self.folder} cannot be made.", "Choose another.", str(error)
            ) from error
        beside = {source.resolve() for source in sources if source.resolve().parent == folder}
        if not self._named and any(path.suffix.lower() in PICTURE_SUFFIXES for path in beside):
            raise LampblackError(
                f"{self.folder} contains the drawings, which would be overwritten.",
                "Choose another output folder.",
            )
        inputs = {source.resolve() for source in sources}
        for path in (path for frame in frames for path in self.paths(frame)):
            if path.resolve() in inputs:
                raise LampblackError(
                    f"{path} is one of the inputs, and would be overwritten.",
                    "Choose another output.",
                )

    def holds(self, frame: ShotFrame, stamp: str, device: DeviceChoice) -> DeviceKind | None:
        """The device that traced the files of ``frame`` if they are up to date: complete, with
        this ``stamp``, and all from ``device``. None if they are not."""
        found = {_STAMPS[path.suffix.lower()](path) for path in self.paths(frame)}
        for kind in get_args(DeviceKind):
            if found == {device_stamp(stamp, kind)} and device in ("auto", kind):
                return kind  # type: ignore[no-any-return]
        return None


def device_stamp(stamp: str, device: DeviceKind) -> str:
    """The stamp of a file that ``device`` traced: a card's pictures differ in their last bits."""
    return stamp if device == "cpu" else f"{stamp} {device}"
