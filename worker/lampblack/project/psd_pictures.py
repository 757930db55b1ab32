"""The pixels of Photoshop's files. psd-tools reads them, within bounds."""

from __future__ import annotations

import hashlib
import logging
import os
import struct
import threading
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from psd_tools import PSDDecompressionWarning, PSDImage
from psd_tools.api.adjustments import SolidColorFill
from psd_tools.api.layers import AdjustmentLayer, Layer
from psd_tools.constants import ColorMode, Resource

from ..colour import srgb
from ..drawing.profile import to_srgb
from ..errors import ProjectError
from ..files import open_regular, understood
from .attributes import check_size
from .psd_record import read_record

MERGED = "merged"
"""The name of the picture of all layers."""
MAX_BYTES = 1 << 30
MAX_ALLOCATED = 4 << 30
_HEADER = struct.Struct(">4sH6sHII")

Picture = NDArray[np.uint8]
Floats = NDArray[np.float32]

_READING = threading.Lock()

# What it says is for programmers.
logging.getLogger("psd_tools").addHandler(logging.NullHandler())


class PsdFile:
    """The pictures of one file.

    Args:
        identity: a digest of the file's content.
        stored: the layers by the names of their pictures (``layer ...``) and masks (``mask ...``).
    """

    def __init__(
        self, path: Path, psd: PSDImage, identity: str, stored: Mapping[str, Layer]
    ) -> None:
        self.path = path
        self._psd = psd
        self._identity = identity
        self._stored = stored

    def has(self, name: str) -> bool:
        return name == MERGED or name in self._stored

    def read(self, name: str, limit: int = 0) -> bytes:
        return f"{self._identity} {name}".encode()

    def picture(self, name: str, data: bytes, subject: str) -> Picture:
        with understood(_damaged(self.path)), _strictly():
            if name == MERGED:
                return self._in_srgb(_merged(self._psd), subject)
            layer = self._stored[name]
            if name.startswith("mask"):
                return _mask(layer)
            left, top, right, bottom = box_of(layer)
            check_size(right - left, bottom - top, subject)
            return self._in_srgb(_pixels(layer), subject)

    def _in_srgb(self, image: Image.Image, subject: str) -> Picture:
        profile = self._psd.image_resources.get_data(Resource.ICC_PROFILE)
        if profile:
            image.info["icc_profile"] = bytes(profile)
        return np.array(to_srgb(image, subject))


def open_psd(path: Path) -> tuple[PSDImage, str]:
    """Open a file. Returns it with a digest of its content.

    Raises:
        ProjectError: there is none, it is no file of Photoshop, is damaged or too large.
    """
    try:
        with open_regular(path) as file, understood(_damaged(path)), _strictly():
            if os.fstat(file.fileno()).st_size > MAX_BYTES:
                raise ProjectError(
                    f"{path} is larger than {MAX_BYTES >> 20} MiB.", "Merge some of its layers."
                )
            _check_header(file, path)
            identity = hashlib.file_digest(file, "blake2b").hexdigest()
            file.seek(0)
            psd = PSDImage(read_record(file, path))
            psd.max_alloc_bytes = MAX_ALLOCATED
            return psd, identity
    except FileNotFoundError as error:
        raise ProjectError(
            f"There is no drawing at {path}.", "Check the name and the folder."
        ) from error
    except OSError as error:
        raise ProjectError(
            f"{path} could not be read.", "Check its permissions.", str(error)
        ) from error


def _check_header(file: BinaryIO, path: Path) -> None:
    """Refuse what is no file of Photoshop, or too large a picture, before more of it is read."""
    signature, version, _, _, height, width = _HEADER.unpack(file.read(_HEADER.size))
    if signature != b"8BPS" or version not in (1, 2):
        raise ValueError("no file of Photoshop")
    check_size(width, height, path.name)
    file.seek(0)


@contextmanager
def _strictly() -> Iterator[None]:
    """A channel that cannot be decoded is an error here; it would else be black. Filters of
    warnings are for the whole process, so only one thread reads at a time."""
    with _READING, warnings.catch_warnings():
        warnings.simplefilter("error", PSDDecompressionWarning)
        yield


def has_layers(psd: PSDImage) -> bool:
    """Whether there are layers, in colours that can be composited here."""
    known = psd.color_mode in (ColorMode.RGB, ColorMode.GRAYSCALE) and psd.depth in (8, 16)
    return known and len(psd) > 0


def is_drawn(layer: Layer) -> bool:
    """Whether a layer is shown by pixels, or is one colour all over."""
    if isinstance(layer, AdjustmentLayer):
        return False
    return layer.has_pixels() or (
        isinstance(layer, SolidColorFill) and not layer.has_vector_mask() and bool(layer.data)
    )


def box_of(layer: Layer) -> tuple[int, int, int, int]:
    """Left, top, right and bottom of a layer that is drawn, canvas pixels."""
    box: tuple[int, int, int, int] = layer.bbox if layer.has_pixels() else layer._psd.viewbox
    return box


def _pixels(layer: Layer) -> Image.Image:
    left, top, right, bottom = box_of(layer)
    height, width = bottom - top, right - left
    if not layer.has_pixels():
        assert isinstance(layer, SolidColorFill)
        assert layer.data is not None
        levels = [float(layer.data.get(key, 0)) for key in (b"Rd  ", b"Grn ", b"Bl  ")]
        colour = np.clip(np.rint(levels), 0, 255).astype(np.uint8)
        return Image.fromarray(np.full((height, width, 4), (*colour, 255), np.uint8))
    if layer._psd.depth == 8:  # already bytes
        image = layer.topil(apply_icc=False)
        if image is None:
            raise ValueError("no pixels")
        return image.convert("RGBA")
    colour = _levels(layer.numpy("color"))
    shape = layer.numpy("shape")
    alpha = np.full((height, width, 1), 255, np.uint8) if shape is None else _levels(shape)
    if colour.shape[2] == 1:
        colour = np.repeat(colour, 3, axis=2)
    return Image.fromarray(np.dstack([colour[..., :3], alpha]))


def _mask(layer: Layer) -> Picture:
    """(H, W, 4) the grey of a layer's mask; it may be empty."""
    mask = layer.mask
    assert mask is not None
    if 0 in mask.size:
        return np.zeros((0, 0, 4), np.uint8)
    check_size(*mask.size, f"the mask of {layer.name!r}")
    grey = _levels(layer.numpy("mask"))
    return np.dstack([grey, grey, grey, np.full_like(grey, 255)])


def _merged(psd: PSDImage) -> Image.Image:
    if psd.depth == 32:  # linear light
        colour, alpha = srgb(psd.numpy("color")), psd.numpy("shape")
        if colour.shape[2] == 1:
            colour = np.repeat(colour, 3, axis=2)
        return Image.fromarray(_levels(np.dstack([colour[..., :3], alpha])))
    image = psd.topil(apply_icc=False)
    if image is None:
        raise ValueError("no merged picture")
    return image


def _levels(samples: Floats | None) -> Picture:
    if samples is None:
        raise ValueError("no pixels")
    levels: Picture = np.rint(np.clip(samples, 0, 1) * 255).astype(np.uint8)
    return levels


def _damaged(path: Path) -> ProjectError:
    return ProjectError(
        f"{path.name} is damaged, or is no file of Photoshop.",
        "Save it again in the program that it was drawn in, or restore a backup.",
    )
