"""Photoshop's files as psd-tools reads them, in little memory: pixels stay in the file until they
are asked for, and large blocks that are not shown (linked files, patterns) are passed over."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, BinaryIO

from psd_tools.constants import Tag
from psd_tools.psd import PSD
from psd_tools.psd.bin_utils import bounded_reader, is_readable, read_fmt
from psd_tools.psd.color_mode_data import ColorModeData
from psd_tools.psd.header import FileHeader
from psd_tools.psd.image_data import ImageData
from psd_tools.psd.image_resources import ImageResources
from psd_tools.psd.layer_and_mask import (
    ChannelData,
    ChannelDataList,
    ChannelImageData,
    ChannelInfo,
    LayerAndMaskInformation,
    LayerInfo,
    LayerRecords,
)
from psd_tools.psd.parse_limits import ParseLimitError, ParseLimits, parse_context
from psd_tools.psd.tagged_blocks import TaggedBlock, TaggedBlocks

from ..errors import ProjectError
from ..files import open_regular

MAX_DESCRIBED = 192 << 20
"""Bytes of all but pixels: names, styles, texts, metadata. Parts of parts count again."""
LARGE_BLOCK = 1 << 20
ENCODING = "macroman"
_LAYERS = (Tag.LAYER_16.value, Tag.LAYER_32.value)
_SIGNATURES = (b"8BIM", b"8B64")


@dataclass(frozen=True)
class Source:
    """The file at ``path``, as it was when it was opened."""

    path: Path
    state: tuple[int, ...]

    @classmethod
    def of(cls, file: BinaryIO, path: Path) -> Source:
        return cls(path, _state(file))

    def part(self, start: int, length: int) -> bytes:
        """``length`` bytes.

        Raises:
            ProjectError: the file is another one by now. OSError: it cannot be read.
        """
        with open_regular(self.path) as file:
            file.seek(start)
            data = file.read(length)
            if _state(file) != self.state:
                raise ProjectError(
                    f"{self.path.name} was changed while the shot was rendered.",
                    "Render the shot again.",
                )
        return data


def _state(file: BinaryIO) -> tuple[int, ...]:
    found = os.fstat(file.fileno())
    return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns


class _Channel(ChannelData):
    """A channel of a layer. Of its data, psd-tools itself asks only how long they are."""

    def __init__(self, source: Source, compression: int, start: int, length: int) -> None:
        super().__init__(compression, range(length))  # type: ignore[arg-type]
        self._source, self._start = source, start

    def get_data(
        self, width: int, height: int, depth: int, version: int = 1, **limits: Any
    ) -> bytes:
        length = min(len(self.data), _most(width, height, depth))
        data = ChannelData(self.compression, self._source.part(self._start, length))
        return data.get_data(width, height, depth, version, **limits)


class _Merged(ImageData):
    """The picture of all layers."""

    def __init__(self, source: Source, compression: int, start: int, length: int) -> None:
        super().__init__(compression, range(length))  # type: ignore[arg-type]
        self._source, self._start = source, start

    def get_data(
        self, header: FileHeader, split: bool = True, **limits: Any
    ) -> list[bytes] | bytes:
        most = _most(header.width, header.height * header.channels, header.depth)
        length = min(len(self.data), most)
        data = ImageData(self.compression, self._source.part(self._start, length))
        return data.get_data(header, split, **limits)


def _most(width: int, height: int, depth: int) -> int:
    """Bytes of samples that packing made no smaller, with the lengths of their rows."""
    return 2 * ((width * depth + 7) // 8 + 4) * height + 1024


def read_record(file: BinaryIO, path: Path) -> PSD:
    """The structure of a file of Photoshop.

    Raises:
        ProjectError: too much of it is no pixels.
        Exception: whatever psd-tools raises for what it does not understand.
    """
    source = Source.of(file, path)
    try:
        with parse_context(ParseLimits(max_total_bytes=MAX_DESCRIBED)):
            header = FileHeader.read(file)
            colours, resources = ColorModeData.read(file), ImageResources.read(file, ENCODING)
            layers = LayerAndMaskInformation()
            with _section(file, "IQ"[header.version - 1]) as section:
                if is_readable(section, 4):
                    layers = _layers(section, header.version, source)
            compression, start = read_fmt("H", file)[0], file.tell()
    except ParseLimitError as error:
        raise ProjectError(
            f"{path.name} describes more than can be read (styles, texts, metadata).",
            "Save a copy of it with its layers turned into pixels.",
            str(error),
        ) from error
    merged = _Merged(source, compression, start, file.seek(0, os.SEEK_END) - start)
    return PSD(header, colours, resources, layers, merged)


@contextmanager
def _section(file: IO[bytes], length: str) -> Iterator[IO[bytes]]:
    """The part of ``file`` whose length is said first; afterwards it stands behind it."""
    with bounded_reader(file, read_fmt(length, file)[0]) as section:
        yield section


def _layers(section: IO[bytes], version: int, source: Source) -> LayerAndMaskInformation:
    size = "IQ"[version - 1]
    with _section(section, size) as body:
        info = _layer_info(body, version, source) if is_readable(body, 2) else LayerInfo()
    blocks = TaggedBlocks()
    if is_readable(section, 4):
        signature = section.read(4)
        section.seek(-4, os.SEEK_CUR)
        if signature not in _SIGNATURES:
            with _section(section, "I"):
                pass  # the colour in which Photoshop shows masks
        blocks = _blocks(section, version, source)
    return LayerAndMaskInformation(info, None, blocks)


def _layer_info(body: IO[bytes], version: int, source: Source) -> LayerInfo:
    count = read_fmt("h", body)[0]
    records = LayerRecords.read(body, count, ENCODING, version)
    channels: list[Any] = []
    for record in records:
        found: list[Any] = [_channel(body, each, source) for each in record.channel_info]
        channels.append(ChannelDataList(found))
    return LayerInfo(count, records, ChannelImageData(channels))


def _channel(body: IO[bytes], info: ChannelInfo, source: Source) -> ChannelData:
    if info.length < 2:
        body.seek(info.length, os.SEEK_CUR)
        return ChannelData()
    compression, start = read_fmt("H", body)[0], body.tell()
    body.seek(info.length - 2, os.SEEK_CUR)
    return _Channel(source, compression, start, info.length - 2)


def _blocks(section: IO[bytes], version: int, source: Source) -> TaggedBlocks:
    """What is said of the whole picture: in files of 16 bits, also its layers."""
    found = TaggedBlocks()
    while is_readable(section, 12):
        start = section.tell()
        signature, name = read_fmt("4s4s", section)
        if signature not in _SIGNATURES:
            break
        length = read_fmt(TaggedBlock._length_format(_tag(name), version), section)[0]
        end = section.tell() + length + -length % 4
        if name in _LAYERS:
            with bounded_reader(section, length) as body:
                layers: Any = _layer_info(body, version, source)
            found[Tag(name)] = TaggedBlock(signature, name, layers)
        elif length < LARGE_BLOCK:
            section.seek(start)
            block = TaggedBlock.read(section, version, padding=4)
            found[block.key] = block
        section.seek(min(end, section.seek(0, os.SEEK_END)))
    return found


def _tag(name: bytes) -> Tag | bytes:
    try:
        return Tag(name)
    except ValueError:
        return name
