"""Prepared drawings: layers, height and surface, ready to be lit."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from .choices import GlowName
from .composite.byte_layers import ByteLayers, byte_layers_of
from .composite.edges import edge_distance
from .composite.form import Form
from .composite.resample import Box
from .drawing import Drawing, Palette
from .materials import MaterialTable
from .render.emitters import glowing_parts, painted_plane
from .render.request import Surface, assign_materials, vertex_pixels
from .scene import Pin, Scene
from .surface import Base, Relief, build_relief, joined_reliefs
from .surface.overlap import Overlap

Detail = Literal["quick", "full"]

Places = NDArray[np.intp]
Sample = TypeVar("Sample", bound=np.generic)


@dataclass(frozen=True, eq=False)
class PreparedDrawing:
    """A drawing that is ready to be lit, for finals and for previews.

    Attributes:
        digest: identifies the drawing; empty where drawings are not identified by content.
        detail: ``full`` for finals; ``quick`` is small and has quick normals.
        size: (width, height) of the drawing in pixels.
        layers: the drawing's layers; one of their pixels is ``step`` pixels of the drawing.
        height: (h, w) float32, in pixels of the drawing towards the viewer; one element is
            ``scale`` pixels of the drawing wide.
        mask: (h, w) bool, the character.
        normals: x right, y up, z to the viewer, 0 outside the mask; float32 at the size of
            ``layers`` or ``mask``, or (h, w, 3) float16 when compact. None if not requested.
        box: box around the character, in pixels of the drawing.
        overlaps: where the height steps because one part is in front of another, longest first.
        pinned: where pins of other drawings are in this one, x and y in its pixels.
        bodies: its parts, bottom first, if it has several. Each of them is lit as a surface of its
            own; height and normals are then those that are seen, of the topmost body.
    """

    digest: str
    detail: Detail
    size: tuple[int, int]
    step: int
    layers: Drawing | ByteLayers
    scale: float
    height: NDArray[np.float32]
    mask: NDArray[np.bool_]
    normals: NDArray[np.float32] | NDArray[np.float16] | None
    box: Box
    overlaps: tuple[Overlap, ...] = ()
    bodies: tuple[PreparedBody, ...] = ()
    pinned: Mapping[Pin, tuple[float, float]] = field(default_factory=dict)

    @property
    def nbytes(self) -> int:
        """Memory in bytes."""
        normals = 0 if self.normals is None else self.normals.nbytes
        parts = sum(body.drawing.nbytes for body in self.bodies)
        return self.layers.nbytes + self.height.nbytes + self.mask.nbytes + normals + parts

    @cached_property
    def edges(self) -> NDArray[np.uint8]:
        """What a rim of light follows, at the size of ``layers``; see ``edge_distance``."""
        labels, ink = self.layers.labels, self.layers.ink.astype(np.float32)
        if isinstance(self.layers, ByteLayers):
            ink /= 255
        places = (
            np.minimum(((np.arange(side) + 0.5) * self.step / self.scale).astype(np.intp), most - 1)
            for side, most in zip(labels.shape, self.height.shape, strict=True)
        )
        height = self.height[np.ix_(*places)] / np.float32(self.step)
        return edge_distance(labels >= 0, ink, height)

    @cached_property
    def form(self) -> Form:
        """A small copy of the surface, of the topmost body, for the composite."""
        return Form.of(self.height, self.mask, self.scale)

    def form_for(self, scene: Scene) -> Form | None:
        """``form`` if ``scene`` has tones that need it."""
        needed = scene.floor is not None or scene.look.cast_strength > 0
        return self.form if needed and scene.look.tones else None

    def edges_for(self, scene: Scene) -> NDArray[np.uint8] | None:
        """``edges`` if ``scene`` has a rim."""
        return None if scene.rim is None else self.edges

    @property
    def palette(self) -> Palette:
        """The flat colours, also those that are covered: a colour that several bodies have is in
        it several times."""
        if not self.bodies:
            return self.layers.palette
        return Palette(tuple(s for body in self.bodies for s in body.drawing.palette.swatches))

    @property
    def painted(self) -> NDArray[np.float32] | None:
        """(h, w, 3) float32 scene-linear, painted light over the whole drawing; None if there is
        none."""
        return self.layers.painted

    def compact(self) -> PreparedDrawing:
        """The same drawing in a third of the memory: byte layers, and normals as float16."""
        if isinstance(self.layers, ByteLayers):
            return self
        normals = None
        if self.normals is not None:
            step = max(1, round(self.scale / self.step))
            rows, columns = self.mask.shape
            normals = block_middles(self.normals, step)[:rows, :columns].astype(np.float16)
        bodies = tuple(replace(body, drawing=body.drawing.compact()) for body in self.bodies)
        return replace(self, layers=byte_layers_of(self.layers), normals=normals, bodies=bodies)

    def relief(
        self, *, stride: int = 1, relief_scale: float = 1.0, coarse_for: Scene | None = None
    ) -> Relief:
        """The character's closed mesh in pixels of the drawing, one vertex every ``stride``
        pixels of the height; fewer where light on the materials of ``coarse_for`` needs fewer."""
        if self.bodies:
            reliefs = [
                body.relief(stride * self.scale, relief_scale, coarse_for) for body in self.bodies
            ]
            return joined_reliefs(reliefs)
        scale = np.float32(self.scale)
        relief = build_relief(
            self.height / scale,
            self.mask,
            stride=stride,
            relief_scale=relief_scale,
            parts=None if coarse_for is None else self._finishes(coarse_for),
        )
        return replace(relief, vertices=relief.vertices * scale)

    def _finishes(self, scene: Scene) -> NDArray[np.intp]:
        """(h, w) numbers that differ where gloss, roughness or glow of the material do."""
        table = MaterialTable.of(scene, self.palette.colours)
        values = np.stack([table.gloss, table.roughness, table.glow], axis=1)
        _, finish = np.unique(values, axis=0, return_inverse=True)
        if not finish.any():
            return np.zeros(self.mask.shape, np.intp)
        labels = self.layers.labels
        rows, columns = (
            (np.arange(size) * whole // size)
            for size, whole in zip(self.mask.shape, labels.shape, strict=True)
        )
        return np.asarray(finish.ravel()[labels[np.ix_(rows, columns)]])

    def surface(self, scene: Scene, stride: int) -> Surface:
        """The surface to light: with the relief scale and the materials of ``scene``."""
        relief = self.relief(stride=stride, relief_scale=scene.relief_scale, coarse_for=scene)
        return self.with_materials(relief, scene)

    def with_materials(self, relief: Relief, scene: Scene) -> Surface:
        """``relief``, in pixels of the drawing, with the materials of ``scene``, and all of it that
        gives light."""
        albedo, labels = self.paint_at(relief)
        surface = assign_materials(relief, albedo, labels, self.palette, scene)
        unit, emitters = max(self.size) / 2, dict(surface.emitters)
        glow = MaterialTable.of(scene, self.palette.colours).glow
        if glow.any():
            part = glowing_parts(relief, surface.albedo * glow[labels][:, None], unit)
            emitters |= {} if part is None else {"emission": part}
        if self.painted is not None:
            nearest = float(relief.vertices[:, 2].max(initial=0))
            plane = painted_plane(
                self.painted, self.size, nearest + scene.painted_light.height * unit
            )
            emitters |= {} if plane is None else {"painted": plane}
        return replace(surface, emitters=emitters) if emitters else surface

    def glows(self, scene: Scene) -> dict[GlowName, Hashable]:
        """The light of ``scene`` on this drawing that comes from surfaces; by name, all that
        shapes it beside the scene's ``render_key``."""
        found: dict[GlowName, Hashable] = {}
        if scene.brightest:
            glow = MaterialTable.of(scene, self.palette.colours).glow
            found |= {"emission": tuple(glow.tolist())} if glow.any() else {}
        if self.painted is not None and scene.painted_light.power:
            found["painted"] = scene.painted_light.height
        return found

    def paint_at(self, relief: Relief) -> tuple[NDArray[np.float32], NDArray[np.int16]]:
        """The paint at each of the V vertices of ``relief``, that of their own body: (V, 3) sRGB
        albedo in 0..1, and (V,) index into ``palette``, -1 for none."""
        if not self.bodies or relief.bodies is None:
            labels = self.layers.labels
            row, column = vertex_pixels(labels, relief.vertices / np.float32(self.step))
            return self.layers.albedo_at(row, column), labels[row, column]
        albedo = np.zeros((len(relief.vertices), 3), np.float32)
        found = np.full(len(relief.vertices), -1, np.int16)
        first = 0
        for index, body in enumerate(self.bodies):
            own = relief.bodies == index
            part = Relief(relief.vertices[own] - body.corner, relief.faces[:0])
            albedo[own], label = body.drawing.paint_at(part)
            found[own] = np.where(label >= 0, label + np.int16(first), np.int16(-1))
            first += len(body.drawing.palette.swatches)
        return albedo, found


@dataclass(frozen=True, eq=False)
class PreparedBody:
    """A body of a drawing.

    Attributes:
        name: the artist's name of its layer.
        left, top: corner of the body's own drawing in the whole, in pixels of the whole.
        drawing: the body alone, also where others cover it; its height is that over the base.
        base: what it rests on, in pixels of the whole.
    """

    name: str
    left: int
    top: int
    drawing: PreparedDrawing
    base: Base

    @property
    def corner(self) -> NDArray[np.float32]:
        """(3,) from the body's own pixels to those of the whole."""
        return np.array([self.left, self.top, 0], np.float32)

    def relief(
        self, spacing: float, relief_scale: float, coarse_for: Scene | None = None
    ) -> Relief:
        """The body's mesh in pixels of the whole, one vertex about every ``spacing`` pixels."""
        stride = max(1, round(spacing / self.drawing.scale))
        own = self.drawing.relief(stride=stride, relief_scale=relief_scale, coarse_for=coarse_for)
        vertices = own.vertices + self.corner
        vertices[:, 2] += relief_scale * self.base.at(vertices[:, 0], vertices[:, 1])
        return replace(own, vertices=vertices)

    def seen_on(self, shape: tuple[int, ...], scale: float) -> tuple[Places, Places, Places]:
        """Where the body lies on an array of ``shape`` over the whole, each element ``scale``
        pixels wide: rows and columns there, and the index of each in the flattened arrays of the
        body's own drawing."""
        own = self.drawing
        rows, columns = (
            ((np.arange(count) + 0.5) * scale - start) / own.scale
            for count, start in zip(shape, (self.top, self.left), strict=True)
        )
        row, column = (np.floor(place).astype(np.intp) for place in (rows, columns))
        near_row, near_column = (
            np.flatnonzero((place >= 0) & (place < size))
            for place, size in zip((row, column), own.mask.shape, strict=True)
        )
        inside = own.mask[np.ix_(row[near_row], column[near_column])]
        r, c = np.nonzero(inside)
        at = row[near_row][r] * own.mask.shape[1] + column[near_column][c]
        return near_row[r], near_column[c], at


def block_middles(plane: NDArray[Sample], step: int) -> NDArray[Sample]:
    """The middle pixel of each block of ``step`` x ``step`` pixels, (H, W, ...)."""
    return plane[step // 2 :: step, step // 2 :: step] if step > 1 else plane


def character_box(mask: NDArray[np.bool_], step: int) -> Box:
    """A box around ``mask``, (H, W) bool, with a margin. One pixel of the mask is ``step`` units of
    the box."""
    rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
    left, top = int(columns[0]) - 2, int(rows[0]) - 2
    width, height = int(columns[-1]) + 3 - left, int(rows[-1]) + 3 - top
    return float(left * step), float(top * step), float(width * step), float(height * step)
