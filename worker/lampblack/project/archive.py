"""The files of a project: in a zip (``.pclx``, ``.ora``), or in a folder beside the XML (``.pcl``).

Nothing is unpacked. Names, sizes and counts are untrusted input, and all of them are bounded.
"""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..drawing import read_picture
from ..errors import ProjectError
from ..files import open_regular, understood

ORA = ".ora"
MAX_XML_BYTES = 16 << 20
MAX_FILE_BYTES = 128 << 20
MAX_ENTRIES = 200_000
PACKINGS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
"""How the files of a zip may be packed: what paint programs use, and what is unpacked bit by bit.
Of the others, one small file may fill the memory before its size is known."""


class Archive(Protocol):
    """Reads the files of one project."""

    path: Path

    def has(self, name: str) -> bool:
        """Whether the data folder has such a file.

        Raises:
            ProjectError: the name leads out of the folder.
        """

    def read(self, name: str, limit: int = MAX_FILE_BYTES) -> bytes:
        """A file of the data folder.

        Raises:
            ProjectError: the name leads out of the folder, or the file is missing, damaged or
                too large.
        """

    def picture(self, name: str, data: bytes, subject: str) -> NDArray[np.uint8]:
        """(H, W, 4) uint8 sRGB, straight alpha: the picture in ``data``, which was read from the
        file ``name``; ``subject`` is for the errors.

        Raises:
            DrawingError: it is no picture, is damaged or too large.
        """


class Described(Archive, Protocol):
    """The files of a project that XML describes."""

    def xml(self) -> bytes:
        """The description."""


def open_archive(path: Path) -> Described:
    """Open the files of a project.

    Raises:
        ProjectError: there is no such file, or it is not a project.
    """
    if not path.is_file():
        raise ProjectError(f"There is no project at {path}.", "Check the name and the folder.")
    suffix = path.suffix.lower()
    if suffix == ".pcl":
        return _Folder(path)
    return Zipped(path, "stack.xml" if suffix == ORA else "main.xml")


class Zipped:
    """A zip file.

    Args:
        description: the name of the XML.

    Raises:
        ProjectError: it is no zip file, or holds too many files.
    """

    def __init__(self, path: Path, description: str) -> None:
        self.path = path
        self._description = description
        cut_short = ProjectError(
            f"{path} cannot be opened: it is not complete, or it is not a project.",
            "Restore it from a backup. A program that repairs zip files may save some of it.",
        )
        with understood(cut_short):
            self._zip = zipfile.ZipFile(path)
        if len(self._zip.namelist()) > MAX_ENTRIES:
            raise ProjectError(
                f"{path} holds more than {MAX_ENTRIES} files.",
                "Save it under another name in its own program.",
            )
        self._names = frozenset(self._zip.namelist())

    def xml(self) -> bytes:
        if self._description not in self._names:
            self._explain()
        return self.entry(self._description, MAX_XML_BYTES)

    def _explain(self) -> None:
        """Say why the description is not there."""
        wanted = self._description
        inner = [name for name in self._names if name.endswith(f"/{wanted}")]
        if inner:
            raise ProjectError(
                f"{self.path.name} has its files in a folder, {inner[0].removesuffix(wanted)!r}.",
                f"Unpack it, and pack what is in that folder: {wanted} must be at the top.",
            )
        raise ProjectError(
            f"{self.path.name} is a zip file, but no project: it has no {wanted}.",
            "Restore the project from a backup.",
        )

    def has(self, name: str) -> bool:
        _check_name(name)
        return f"data/{name}" in self._names

    def read(self, name: str, limit: int = MAX_FILE_BYTES) -> bytes:
        _check_name(name)
        return self.entry(f"data/{name}", limit)

    def picture(self, name: str, data: bytes, subject: str) -> NDArray[np.uint8]:
        return read_picture(io.BytesIO(data), subject)

    def holds(self, name: str) -> bool:
        """Whether there is an entry of this whole name."""
        return name in self._names

    def entry(self, name: str, limit: int = MAX_FILE_BYTES) -> bytes:
        """The entry of this whole name.

        Raises:
            ProjectError: it is missing, damaged or too large.
        """
        if name not in self._names:
            raise _missing(self.path, name)
        damaged = ProjectError(
            f"{name} in {self.path.name} is damaged.", "Restore the project from a backup."
        )
        with understood(damaged):
            if self._zip.getinfo(name).compress_type not in PACKINGS:
                raise ProjectError(
                    f"{self.path.name} is compressed in a way that Lampblack cannot read.",
                    "Unpack it, and pack it again as an ordinary zip file (method: deflate).",
                )
            with self._zip.open(name) as file:
                # The size in the zip's directory is not trusted.
                data = file.read(limit + 1)
        return _within(data, name, limit)


class _Folder:
    def __init__(self, path: Path) -> None:
        self.path = path
        self._data = path.with_name(f"{path.name}.data")

    def xml(self) -> bytes:
        return self._read(self.path, MAX_XML_BYTES)

    def has(self, name: str) -> bool:
        _check_name(name)
        return (self._data / name).is_file()

    def read(self, name: str, limit: int = MAX_FILE_BYTES) -> bytes:
        _check_name(name)
        path = self._data / name
        if path.is_file() and not path.resolve().is_relative_to(self._data.resolve()):
            raise _strays(name)
        return self._read(path, limit)

    def picture(self, name: str, data: bytes, subject: str) -> NDArray[np.uint8]:
        return read_picture(io.BytesIO(data), subject)

    def _read(self, path: Path, limit: int) -> bytes:
        try:
            with open_regular(path) as file:
                return _within(file.read(limit + 1), path.name, limit)
        except FileNotFoundError as error:
            raise _missing(self.path, f"{self._data.name}/{path.name}") from error
        except OSError as error:
            raise ProjectError(
                f"{path} could not be read.", "Check its permissions.", str(error)
            ) from error


def _check_name(name: str) -> None:
    """Refuse a name with a path in it: keyframes are directly in the data folder."""
    if not name or len(name) > 255 or name in (".", "..") or set(name) & set("/\\:\0"):
        raise _strays(name)


def _strays(name: str) -> ProjectError:
    return ProjectError(
        "The project names a file outside its own folder; nothing was read from there.",
        "Do not trust this project. Ask the person who made it.",
        repr(name[:200]),
    )


def _missing(project: Path, name: str) -> ProjectError:
    return ProjectError(
        f"{project.name} has no {name}.",
        "Restore it from a backup, or draw what is missing again and save it.",
    )


def _within(data: bytes, name: str, limit: int) -> bytes:
    if len(data) > limit:
        raise ProjectError(
            f"{name} in the project is larger than {limit >> 20} MiB.",
            "Make that drawing smaller, or split it.",
        )
    return data
