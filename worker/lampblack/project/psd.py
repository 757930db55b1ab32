"""Photoshop's files, the layers of one drawing (.psd and .psb, which many programs write), as
projects of one frame.

Frame of reference: x right, y down, with the origin in the canvas's corner. The first layer is the
lowest.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace
from itertools import count, islice
from pathlib import Path

from psd_tools import PSDImage
from psd_tools.api.layers import AdjustmentLayer, FillLayer, GroupMixin, ShapeLayer
from psd_tools.api.layers import Layer as Stored
from psd_tools.constants import BlendMode, Tag
from psd_tools.psd.layer_and_mask import LayerBlendingRanges

from ..errors import LampblackWarning, ProjectError
from .archive import Archive
from .attributes import UNKNOWN_BLENDS, check_size, tell_of_layers
from .blend import Blend
from .camera_layer import Camera, CameraKey
from .document import Group, Key, Layer, Mask, Project
from .psd_pictures import MERGED, PsdFile, box_of, has_layers, is_drawn, open_psd

MAX_LAYERS = 1000
MAX_DEPTH = 50
BLENDS: dict[BlendMode, Blend] = {
    BlendMode.NORMAL: "normal",
    BlendMode.PASS_THROUGH: "normal",
    BlendMode.DARKEN: "darken",
    BlendMode.MULTIPLY: "multiply",
    BlendMode.COLOR_BURN: "color-burn",
    BlendMode.LINEAR_BURN: "linear-burn",
    BlendMode.DARKER_COLOR: "darker-color",
    BlendMode.LIGHTEN: "lighten",
    BlendMode.SCREEN: "screen",
    BlendMode.COLOR_DODGE: "color-dodge",
    BlendMode.LINEAR_DODGE: "linear-dodge",
    BlendMode.LIGHTER_COLOR: "lighter-color",
    BlendMode.OVERLAY: "overlay",
    BlendMode.SOFT_LIGHT: "soft-light",
    BlendMode.HARD_LIGHT: "hard-light",
    BlendMode.VIVID_LIGHT: "vivid-light",
    BlendMode.LINEAR_LIGHT: "linear-light",
    BlendMode.PIN_LIGHT: "pin-light",
    BlendMode.HARD_MIX: "hard-mix",
    BlendMode.DIFFERENCE: "difference",
    BlendMode.EXCLUSION: "exclusion",
    BlendMode.SUBTRACT: "subtract",
    BlendMode.DIVIDE: "divide",
    BlendMode.HUE: "hue",
    BlendMode.SATURATION: "saturation",
    BlendMode.COLOR: "color",
    BlendMode.LUMINOSITY: "luminosity",
}


def read_psd(path: Path) -> tuple[Project, Archive]:
    """The project that a file of Photoshop holds. One in other colours than RGB or grey with 8 or
    16 bits is read as the one picture that its program stored with the layers.

    Raises:
        ProjectError: the file is damaged, too large, or has nothing that can be read.

    Warns:
        LampblackWarning: something in the file is not shown as its program shows it.
    """
    psd, identity = open_psd(path)
    check_size(psd.width, psd.height, path.name)
    reader = _Reader(path.name, psd)
    layers = reader.layers() if has_layers(psd) else (_merged(path.name, psd),)
    if not layers:
        raise ProjectError(f"{path.name} has no layer with a picture.", "Draw something on one.")
    canvas = Camera("Canvas", psd.width, psd.height, (CameraKey(1),))
    return Project(layers, (canvas,), 1, 1), PsdFile(path, psd, identity, reader.stored)


def _merged(name: str, psd: PSDImage) -> Layer:
    """The picture that the program stored with the layers."""
    if len(psd):
        colours = f"{psd.color_mode.name} colours with {psd.depth} bits"
        remedy = "Save it in RGB with 8 or 16 bits"
        if not psd.has_preview():
            raise ProjectError(
                f"{name} is in {colours}, which Lampblack cannot read.", remedy + "."
            )
        warnings.warn(
            f"{name} is in {colours}: its layers are lit as one picture. {remedy} to keep them "
            "apart.",
            LampblackWarning,
            stacklevel=3,
        )
    key = Key(1, MERGED, -(psd.width // 2), -(psd.height // 2))
    return Layer(1, "Background", "bitmap", True, (key,))


@dataclass(frozen=True)
class _Place:
    """What the groups around a layer say of it."""

    visible: bool = True
    groups: tuple[Group, ...] = ()


@dataclass
class _Reader:
    """Reads the tree of layers.

    Attributes:
        stored: the layers by the names of their pictures and masks.
    """

    name: str
    psd: PSDImage
    stored: dict[str, Stored] = field(default_factory=dict)
    _numbers: Iterator[int] = field(default_factory=lambda: count(1))
    _unknown: set[str] = field(default_factory=set)
    _left_out: set[str] = field(default_factory=set)
    _without: set[str] = field(default_factory=set)

    def layers(self) -> tuple[Layer, ...]:
        """The layers that can be drawn, lowest first."""
        if sum(1 for _ in islice(self.psd.descendants(), MAX_LAYERS + 1)) > MAX_LAYERS:
            raise ProjectError(
                f"{self.name} has more than {MAX_LAYERS} layers.", "Merge some of them."
            )
        found = tuple(self._siblings(self.psd, _Place()))
        tell_of_layers(self._unknown, self.name, UNKNOWN_BLENDS)
        tell_of_layers(
            self._left_out,
            self.name,
            "have no pixels of their own (adjustments, gradients, patterns or paths) and are left "
            "out. Merge them with the layers below, or turn them into pixels, to see them",
        )
        tell_of_layers(
            self._without,
            self.name,
            "have layer styles, vector masks or Blend If, and are shown without. Turn these into "
            "pixels to see them",
        )
        return found

    def _siblings(self, layers: Iterable[Stored], place: _Place) -> Iterator[Layer]:
        if len(place.groups) > MAX_DEPTH:
            raise ProjectError(
                f"{self.name} has groups in groups, {MAX_DEPTH} deep.", "Merge some of them."
            )
        stacks: list[list[Stored]] = []
        for layer in layers:
            if layer.clipping and stacks:
                stacks[-1].append(layer)
            else:
                stacks.append([layer])
        for base, *clipped in stacks:
            if not clipped:
                yield from self._one(base, place)
                continue
            # What is clipped shows only on its base, and goes through the base's blend mode.
            joined = self._group(base)
            within = _Place(place.visible and base.visible, (*place.groups, joined))
            yield from self._one(base, within, bare=True)
            for layer in clipped:
                yield from self._one(layer, within, clipped=True)

    def _one(
        self, layer: Stored, place: _Place, *, bare: bool = False, clipped: bool = False
    ) -> Iterator[Layer]:
        """A layer, or those in a group. ``bare``: its opacity, masks and blend mode are those of a
        group around it."""
        visible = place.visible and layer.visible
        if visible and _has_more(layer):
            self._without.add(_label(layer))
        if isinstance(layer, GroupMixin):
            groups = place.groups
            if not bare:
                group = replace(self._group(layer), clipped=clipped)
                passes = layer.blend_mode == BlendMode.PASS_THROUGH and not clipped
                if not passes or group.opacity < 1 or group.masks:
                    groups = (*groups, replace(group, passes=passes))
            yield from self._siblings(layer, _Place(visible, groups))
        elif not is_drawn(layer):
            if visible and not _is_empty(layer):
                self._left_out.add(_label(layer))
        else:
            number = next(self._numbers)
            group = Group(0) if bare else self._group(layer)
            left, top, _, _ = box_of(layer)
            file = f"layer {number}"
            self.stored[file] = layer
            key = Key(1, file, *self._place(left, top), group.opacity, masks=group.masks)
            yield Layer(
                number, _label(layer) or f"Layer {number}", "bitmap", visible, (key,), group.blend,
                clipped, place.groups,
            )  # fmt: skip

    def _group(self, layer: Stored) -> Group:
        """A group with the opacity, blend mode and masks of ``layer``."""
        if layer.blend_mode not in BLENDS:
            self._unknown.add(_label(layer))
        fill = layer.tagged_blocks.get_data(Tag.BLEND_FILL_OPACITY, 255)
        return Group(
            next(self._numbers),
            layer.opacity / 255 * fill / 255,
            BLENDS.get(layer.blend_mode, "normal"),
            masks=self._masks(layer),
        )

    def _masks(self, layer: Stored) -> tuple[Mask, ...]:
        mask = layer.mask
        if mask is None or mask.disabled:
            return ()
        density = mask.parameters.user_mask_density if mask.parameters else None
        file = f"mask {next(self._numbers)}"
        self.stored[file] = layer
        place = self._place(mask.left, mask.top)
        share = 1.0 if density is None else density / 255
        return (Mask(file, *place, mask.background_color, share),)

    def _place(self, left: int, top: int) -> tuple[int, int]:
        """Keys are positioned relative to the middle of the canvas, as in Pencil2D."""
        return left - self.psd.width // 2, top - self.psd.height // 2


def _label(layer: Stored) -> str:
    return layer.name.rstrip("\0")[:200]


def _is_empty(layer: Stored) -> bool:
    """Whether it shows nothing in its own program either."""
    plain = not isinstance(layer, AdjustmentLayer | FillLayer) and not layer.has_vector_mask()
    return plain and 0 in layer.size


def _has_more(layer: Stored) -> bool:
    """Whether its look depends on more than its pixels and mask."""
    vector = layer.vector_mask
    path = vector is not None and not vector.disabled
    if path and is_drawn(layer):
        drawn = isinstance(layer, ShapeLayer | FillLayer)
        path = not (drawn or (layer.mask is not None and layer.mask.has_real()))
    ranges = layer._record.blending_ranges
    return path or layer.has_effects() or _is_cut(ranges)


def _is_cut(ranges: LayerBlendingRanges) -> bool:
    """Whether Blend If leaves out some levels."""
    full = [(0, 65535), (0, 65535)]
    given = [ranges.composite_ranges, *(ranges.channel_ranges or ())]
    return any(list(map(tuple, one)) != full for one in given if one)
