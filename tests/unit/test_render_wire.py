"""Messages to the render child survive the pipe, and nothing oversized is believed."""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from io import FileIO

import msgspec
import numpy as np
import pytest

from lampblack.render.quality import QUALITIES
from lampblack.render.wire import MAX_HEADER_BYTES, Array, Load, Trace, WireError, receive, send
from lampblack.scene import AreaLight, Canvas, Floor

Pipe = tuple[FileIO, FileIO]


@pytest.fixture
def pipe() -> Iterator[Pipe]:
    reading, writing = os.pipe()
    with FileIO(reading, "rb") as reader, FileIO(writing, "wb") as writer:
        yield reader, writer


def test_message_and_arrays_round_trip(pipe: Pipe) -> None:
    reader, writer = pipe
    job = Trace(Canvas(40, 30), (0, 0, 40, 30), AreaLight(1, 2, -3), Floor(20), QUALITIES["final"])
    arrays: list[Array] = [
        np.arange(24, dtype=np.float32).reshape(2, 4, 3)[:, ::2],
        np.arange(6, dtype=np.int32).reshape(2, 3),
        np.zeros((0, 3), np.float32),
    ]
    send(writer, job, arrays)
    send(writer, Load())
    message, received = receive(reader)
    assert message == job
    for array, copy in zip(arrays, received, strict=True):
        assert copy.dtype == array.dtype
        assert np.array_equal(copy, array)
    assert receive(reader) == (Load(), [])


def header(value: object) -> bytes:
    text = msgspec.json.encode(value)
    return struct.pack("<I", len(text)) + text


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"\x01\x00",
        struct.pack("<I", MAX_HEADER_BYTES + 1),
        struct.pack("<I", 5) + b"{nope",
        header([{"type": "Unknown"}, []]),
        header([{"type": "Load"}, [["float64", [2]]]]),
        header([{"type": "Load"}, [["float32", [-1, 3]]]]),
        header([{"type": "Load"}, [["float32", [1 << 20, 1 << 20, 3]]]]),
        header([{"type": "Load"}, [["float32", [1, 1, 1, 1]]]]),
        header([{"type": "Load"}, [["float32", [8]]]]) + b"short",
    ],
)
def test_broken_messages_are_refused(pipe: Pipe, data: bytes) -> None:
    reader, writer = pipe
    writer.write(data)
    writer.close()
    with pytest.raises(WireError):
        receive(reader)


def test_render_size_is_bounded_and_never_empty() -> None:
    for quality in QUALITIES.values():
        for sampling in (quality.light, quality.ambient, quality.floor):
            assert max(sampling.size(65536, 65536)) <= sampling.longest
            assert min(sampling.size(65536, 1)) >= 1
