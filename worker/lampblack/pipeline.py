"""The one way from a drawing to a lit drawing; command line and window drive the same."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property
from types import TracebackType
from typing import Self

import numpy as np
import torch
from numpy.typing import NDArray

from .cache import ArrayCache, digest
from .choices import PipelineOptions
from .composite import composite
from .drawing import Drawing
from .normals.predict import NormalPredictor
from .normals.temporal.temporal_filter import LazyNeighbours, TemporalFilter
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .render import (
    QUALITIES,
    Passes,
    RenderChild,
    Surface,
    frame_request,
    frame_surface,
)
from .render.light_pass_cache import LightPassCache
from .scene import Scene
from .surface import Relief, build_relief, guided_filter, solve

MAX_SURFACE_PX = 2048
"""Longest side at which a surface is solved; larger pictures are lit at this size."""


class Pipeline:
    """Drawing -> normals -> surface -> passes -> picture, each kept while it holds.

    Use as a context manager: it owns the render child. Nothing is loaded before it is needed.

    Args:
        cache: keeps normals and heights across runs.
        options: how surfaces are made.
        niceness: how far the render child stands back for others, 0 to 19.
    """

    def __init__(
        self, cache: ArrayCache, options: PipelineOptions | None = None, *, niceness: int = 0
    ) -> None:
        self._cache = cache
        self._niceness = niceness
        self._light_passes = LightPassCache()
        self._temporal_filter = TemporalFilter()
        self.options = options or PipelineOptions()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if "child" in self.__dict__:
            self.child.close()

    @cached_property
    def _predictor(self) -> NormalPredictor:
        return NormalPredictor()

    @cached_property
    def child(self) -> RenderChild:
        """The renderer, started when first needed."""
        return RenderChild(self._niceness)

    def interrupt(self) -> None:
        """End a render at hand, which then raises; any thread may call this."""
        if "child" in self.__dict__:
            self.child.kill()

    def rest(self) -> None:
        """End the renderer and let go of its light; the next frame brings both back."""
        self.child.close()
        self._light_passes = LightPassCache()

    def warm_up(self) -> None:
        """Load the network and start the renderer before the first drawing comes."""
        self.child.start()
        _ = self._predictor

    def normals(
        self,
        drawing: Drawing,
        progress: Callable[[float], None] = lambda share: None,
        neighbours: LazyNeighbours | None = None,
    ) -> NDArray[np.float32]:
        """(H, W, 3) float32 normal map, x right, y up, z to the viewer; 0 outside the mask.
        Smoothed over time with the ``neighbours``."""
        key = digest(
            "normals", self._predictor.identity, self.options.grids, drawing.lines, drawing.mask
        )
        predicted = self._cache.get(
            key,
            lambda: self._predictor.predict(
                drawing.lines, drawing.mask, grids=self.options.grids, progress=progress
            ),
        )
        if neighbours is None:
            return predicted
        here = self._thumbnail(drawing, predicted)
        return self._temporal_filter.smooth(predicted, drawing.mask, here, neighbours.load())

    def quick_normals(
        self, lines: NDArray[np.float32], mask: NDArray[np.bool_]
    ) -> NDArray[np.float32]:
        """Normals as above, cheaply, for somebody who waits: not kept, and never steadied."""
        return self._predictor.predict(lines, mask, quick=True)

    def thumbnail(self, drawing: Drawing) -> RegistrationThumbnail:
        """What the drawings beside this one need of it; about 4 MB."""
        return self._thumbnail(drawing, self.normals(drawing))

    def _thumbnail(self, drawing: Drawing, normals: NDArray[np.float32]) -> RegistrationThumbnail:
        name = digest(drawing.lines, drawing.mask, drawing.albedo, normals)
        return make_thumbnail(name, drawing.lines, drawing.mask, drawing.albedo, normals)

    def height(
        self,
        drawing: Drawing,
        progress: Callable[[float], None] = lambda share: None,
        neighbours: LazyNeighbours | None = None,
    ) -> NDArray[np.float32]:
        """(h, w) float32 height in canvas pixels; the drawing's size, or capped below it."""
        made_from = [self._predictor.identity, self.options, drawing.lines, drawing.mask]
        if neighbours is not None:
            made_from += [drawing.albedo, neighbours.keys]
        key = digest("height", *made_from)
        return self._cache.get(key, lambda: self._inflate(drawing, progress, neighbours))

    def _inflate(
        self, drawing: Drawing, progress: Callable[[float], None], neighbours: LazyNeighbours | None
    ) -> NDArray[np.float32]:
        normals, mask = self.normals(drawing, progress, neighbours), drawing.mask
        step = surface_step(drawing)
        if step > 1:
            normals, mask = _shrink_normals(normals, mask, step)
        height = solve(normals, mask, solver=self.options.solver)
        return guided_filter(height, mask) * np.float32(step)

    def relief(
        self,
        drawing: Drawing,
        *,
        relief_scale: float = 1.0,
        stride: int = 1,
        neighbours: LazyNeighbours | None = None,
    ) -> Relief:
        """The figure's closed mesh in canvas pixels, one vertex every ``stride`` pixels."""
        height, mask = self.height(drawing, neighbours=neighbours), drawing.mask
        step = surface_step(drawing)
        if step > 1:
            mask = mask[step // 2 :: step, step // 2 :: step][: height.shape[0], : height.shape[1]]
        relief = build_relief(
            height / np.float32(step), mask, stride=stride, relief_scale=relief_scale
        )
        return replace(relief, vertices=relief.vertices * np.float32(step))

    def surface(
        self, drawing: Drawing, scene: Scene, neighbours: LazyNeighbours | None = None
    ) -> Surface:
        """What the lights of ``scene`` fall on: its relief, quality and materials count."""
        relief = self.relief(
            drawing,
            relief_scale=scene.relief_scale,
            stride=QUALITIES[scene.quality].mesh_stride,
            neighbours=neighbours,
        )
        return frame_surface(drawing, relief, scene)

    def light(
        self,
        drawing: Drawing,
        scene: Scene,
        neighbours: LazyNeighbours | None = None,
        surface: Surface | None = None,
    ) -> Passes:
        """Trace the lights of ``scene`` over the drawing's surface, but for those that the last
        call traced over the very same drawing. A ``surface`` that is at hand is not made anew;
        with one, a thread of its own may trace while another makes the next."""

        def trace(asked: Scene, ambient: bool) -> Passes:
            found = surface or self.surface(drawing, asked, neighbours)
            return self.child.render(replace(frame_request(drawing, found, asked), ambient=ambient))

        return self._light_passes.complete(drawing, scene, trace)

    def render(
        self, drawing: Drawing, scene: Scene, neighbours: LazyNeighbours | None = None
    ) -> NDArray[np.uint8]:
        """(H, W, 4) uint8, sRGB, straight alpha: the drawing, lit."""
        return composite(drawing, self.light(drawing, scene, neighbours), scene)


def surface_step(drawing: Drawing) -> int:
    """Canvas pixels per pixel of the surface: 1 up to ``MAX_SURFACE_PX``."""
    return -(-max(drawing.size) // MAX_SURFACE_PX)


def _shrink_normals(
    normals: NDArray[np.float32], mask: NDArray[np.bool_], step: int
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Average blocks of ``step`` pixels; a block belongs to the figure if its middle does."""
    rows, columns = mask.shape[0] // step, mask.shape[1] // step
    planes = torch.from_numpy(normals[: rows * step, : columns * step]).permute(2, 0, 1)
    pooled = torch.nn.functional.avg_pool2d(planes, step).permute(1, 2, 0).numpy()
    middle = mask[step // 2 :: step, step // 2 :: step][:rows, :columns]
    length = np.maximum(np.linalg.norm(pooled, axis=2, keepdims=True), 1e-6)
    return (pooled / length * middle[..., None]).astype(np.float32), middle
