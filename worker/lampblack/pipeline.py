"""The path from a drawing to a lit drawing: drawing -> surface -> passes -> picture.

The command line, the farm and the live worker all use it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from types import TracebackType
from typing import Protocol, Self

import numpy as np
import torch
from numpy.typing import NDArray
from PIL import Image

from .cache import ArrayCache
from .cache import digest as digest_of
from .choices import DEFAULT_GRIDS, GlowName, PipelineOptions
from .composite import composite
from .corrected import corrected_normals, corrections_of
from .drawing import Drawing, DrawingPlanes
from .drawing.morphology import from_nearest
from .hints import hints_by_body, scaled_hint
from .normals.predict import NormalPredictor
from .normals.prediction import Prediction, pack_order, unpack_order
from .normals.temporal.temporal_filter import LazyNeighbours, TemporalFilter, body_neighbours
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .prepared import PreparedDrawing, block_middles, character_box
from .render import QUALITIES, Passes, RenderChild, RenderRequest, Surface, frame_request
from .render.light_pass_cache import LightPassCache
from .scene import DepthColour, DepthHint, Hint, LayerBody, Scene
from .stacked import seen_height, seen_normals, seen_overlaps, stack_bodies
from .surface import (
    Overlap,
    dividing_lines,
    guided_filter,
    overlap_votes,
    solve,
    solve_with_overlaps,
)
from .surface.cuts import Cuts
from .surface.overlap import pack_overlaps, unpack_overlaps

MAX_SURFACE_PX = 2048
"""Longest side at which a surface is solved; larger pictures are lit at this size."""
QUICK_PX = 500
"""Longest side at which a drawing is prepared in quick detail."""

Progress = Callable[[float], None]


class Predictor(Protocol):
    """Predicts normals and depth; see ``NormalPredictor``."""

    @property
    def identity(self) -> str:
        """A digest of the weights."""

    def predict(
        self,
        lines: NDArray[np.float32],
        mask: NDArray[np.bool_],
        *,
        grids: int = DEFAULT_GRIDS,
        quick: bool = False,
        progress: Progress = lambda share: None,
    ) -> Prediction:
        """The prediction for one drawing; see ``NormalPredictor.predict``."""


class Renderer(Protocol):
    """Traces light; see ``RenderChild``."""

    @property
    def pid(self) -> int | None:
        """ID of its process; None if it does not run."""

    def start(self) -> None:
        """Start the renderer, unless it runs."""

    def render(self, request: RenderRequest) -> Passes:
        """Trace every light of ``request``."""

    def kill(self) -> None:
        """End the current render, which then raises; any thread may call this."""

    def close(self) -> None:
        """End the renderer; safe to call twice."""


class Pipeline:
    """Drawing -> normals -> surface -> passes -> picture; results are cached by their inputs.

    Use as a context manager: it owns the renderer. Network and renderer are loaded when they are
    needed.

    Args:
        cache: keeps normals and heights across runs.
        options: how surfaces are made.
        predictor: None is the shipped network.
        renderer: None is Cycles in a child process.
        niceness: of the child process, 0 to 19.
    """

    def __init__(
        self,
        cache: ArrayCache,
        options: PipelineOptions | None = None,
        *,
        predictor: Predictor | None = None,
        renderer: Renderer | None = None,
        niceness: int = 0,
    ) -> None:
        self._cache = cache
        self._given_predictor = predictor
        self.renderer: Renderer = renderer or RenderChild(niceness)
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
        self.close()

    def close(self) -> None:
        """End the renderer and drop cached light. The next render starts it again."""
        self.renderer.close()
        self._light_passes = LightPassCache()

    def interrupt(self) -> None:
        """End the current render, which then raises; any thread may call this."""
        self.renderer.kill()

    def warm_up(self) -> None:
        """Load the network and start the renderer before the first drawing."""
        self.renderer.start()
        _ = self._predictor

    @property
    def _predictor(self) -> Predictor:
        if self._given_predictor is None:
            self._given_predictor = NormalPredictor()
        return self._given_predictor

    def normals(
        self,
        drawing: Drawing,
        progress: Progress = lambda share: None,
        neighbours: LazyNeighbours | None = None,
    ) -> NDArray[np.float32]:
        """(H, W, 3) float32 normal map, x right, y up, z to the viewer; 0 outside the mask. With
        ``neighbours`` it passes the temporal filter. Of several bodies, the topmost is seen."""
        if drawing.bodies:
            return self._seen_normals(drawing, progress, neighbours)
        return self._predicted(drawing, progress, neighbours).normals

    def _predicted(
        self,
        drawing: Drawing,
        progress: Progress = lambda share: None,
        neighbours: LazyNeighbours | None = None,
    ) -> Prediction:
        """The prediction, its depth and edges at low resolution."""
        made: list[Prediction] = []

        def predict() -> Prediction:
            if not made:
                grids = self.options.grids
                made.append(
                    self._predictor.predict(
                        drawing.lines, drawing.mask, grids=grids, progress=progress
                    )
                )
            return made[0]

        made_from = self._predictor.identity, self.options.grids, drawing.lines, drawing.mask
        normals = self._cache.get(digest_of("normals", *made_from), lambda: predict().normals)
        order = self._cache.get(
            digest_of("order", *made_from), lambda: pack_order(predict(), drawing.mask)
        )
        prediction = unpack_order(normals, order, drawing.mask)
        if neighbours is None:
            return prediction
        here = _thumbnail(drawing, prediction)
        return self._temporal_filter.smooth_prediction(
            prediction, drawing.mask, here, neighbours.load()
        )

    def thumbnail(self, drawing: Drawing) -> RegistrationThumbnail:
        """The drawing's registration thumbnail, about 4 MB."""
        return _thumbnail(drawing, self._predicted(drawing))

    def height(
        self,
        drawing: Drawing,
        progress: Progress = lambda share: None,
        neighbours: LazyNeighbours | None = None,
    ) -> NDArray[np.float32]:
        """(h, w) float32 height in canvas pixels, at the drawing's size or less (see
        ``surface_step``)."""
        return self.surface(drawing, progress, neighbours)[0]

    def surface(
        self,
        drawing: Drawing,
        progress: Progress = lambda share: None,
        neighbours: LazyNeighbours | None = None,
        hints: Sequence[Hint] = (),
    ) -> tuple[NDArray[np.float32], tuple[Overlap, ...]]:
        """The height, as from ``height``, and the overlaps along which it steps; ``hints`` are in
        pixels of the drawing."""
        made: list[tuple[NDArray[np.float32], list[Overlap]]] = []

        def inflate() -> tuple[NDArray[np.float32], list[Overlap]]:
            if not made:
                made.append(self._inflate(drawing, progress, neighbours, hints))
            return made[0]

        made_from = [self._predictor.identity, self.options, drawing.lines, drawing.mask]
        made_from.append(drawing.ink)
        if neighbours is not None:
            made_from += [drawing.albedo, neighbours.keys]
        if hints:
            # A stroke says the same whatever the frame on which it was drawn.
            made_from.append(
                repr([h if isinstance(h, DepthColour) else replace(h, frame=0) for h in hints])
            )
            made_from += [drawing.labels, drawing.palette.colours]
        height = self._cache.get(digest_of("steps", *made_from), lambda: inflate()[0])
        packed = self._cache.get(
            digest_of("overlaps", *made_from), lambda: pack_overlaps(inflate()[1])
        )
        return height, unpack_overlaps(packed)

    def _inflate(
        self,
        drawing: Drawing,
        progress: Progress,
        neighbours: LazyNeighbours | None,
        hints: Sequence[Hint],
    ) -> tuple[NDArray[np.float32], list[Overlap]]:
        prediction, mask = self._predicted(drawing, progress, neighbours), drawing.mask
        lines = dividing_lines(drawing.lines, drawing.ink, mask)
        step = surface_step(drawing)
        if step > 1:
            prediction, mask, lines = _shrink(prediction, mask, lines, step)
        corrections = corrections_of(drawing, mask, hints, step)
        if self.options.solver == "direct":
            sides = [scaled_hint(hint, 1 / step) for hint in hints if isinstance(hint, DepthHint)]
            height, overlaps = solve_with_overlaps(prediction, mask, lines, sides, corrections)
        else:
            height, overlaps = solve(prediction.normals, mask, solver=self.options.solver), []
            height = corrections.height(height, mask, Cuts.none(mask.shape))
        height = guided_filter(height, mask) * np.float32(step)
        return height, [
            replace(overlap, points=overlap.points * step, amount=overlap.amount * step)
            for overlap in overlaps
        ]

    def prepare(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None = None,
        *,
        hints: Sequence[Hint] = (),
        digest: str = "",
        progress: Progress = lambda share: None,
        with_normals: bool = False,
    ) -> PreparedDrawing:
        """Prepare a drawing in full detail, as for finals.

        Args:
            neighbours: for the temporal filter of its normals.
            hints: what the artist says of its depth, in pixels of the drawing.
            digest: identifies the drawing.
            progress: called with the share done, 0 to 1, of predicting normals.
            with_normals: keep them in the result.
        """
        if drawing.bodies:
            return self._prepare_bodies(drawing, neighbours, hints, digest, progress, with_normals)
        height, overlaps = self.surface(drawing, progress, neighbours, hints)
        normals = self.normals(drawing, progress, neighbours) if with_normals else None
        step = surface_step(drawing)
        if normals is not None:
            normals = corrected_normals(drawing, normals, height, hints, step)
        return PreparedDrawing(
            digest=digest,
            detail="full",
            size=drawing.size,
            step=1,
            layers=drawing,
            scale=float(step),
            height=height,
            mask=block_middles(drawing.mask, step)[: height.shape[0], : height.shape[1]],
            normals=normals,
            box=character_box(drawing.mask, 1),
            overlaps=overlaps,
        )

    def _prepare_bodies(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None,
        hints: Sequence[Hint],
        digest: str,
        progress: Progress,
        with_normals: bool,
    ) -> PreparedDrawing:
        own = [
            self.prepare(
                body.drawing,
                body_neighbours(neighbours, body.name),
                hints=own_hints,
                progress=progress,
            )
            for body, own_hints in zip(
                drawing.bodies, hints_by_body(drawing.bodies, hints), strict=True
            )
        ]
        bodies = stack_bodies(drawing.bodies, own, 1)
        step = surface_step(drawing)
        rows, columns = (side // step for side in drawing.mask.shape)
        mask = block_middles(drawing.mask, step)[:rows, :columns]
        height = seen_height(bodies, mask, step)
        normals = self.normals(drawing, progress, neighbours) if with_normals else None
        if normals is not None:
            normals = corrected_normals(drawing, normals, height, hints, step)
        return PreparedDrawing(
            digest=digest,
            detail="full",
            size=drawing.size,
            step=1,
            layers=drawing,
            scale=float(step),
            height=height,
            mask=mask,
            normals=normals,
            box=character_box(drawing.mask, 1),
            overlaps=seen_overlaps(bodies),
            bodies=bodies,
        )

    def _seen_normals(
        self, drawing: Drawing, progress: Progress, neighbours: LazyNeighbours | None
    ) -> NDArray[np.float32]:
        """The normals of the topmost body at each pixel."""
        seen = np.zeros((*drawing.mask.shape, 3), np.float32)
        for body in drawing.bodies:
            around = body_neighbours(neighbours, body.name)
            normals, inside = self.normals(body.drawing, progress, around), body.drawing.mask
            if body.rim.any():
                normals, inside = from_nearest(normals, inside), inside | body.rim
            rows, columns = inside.shape
            place = slice(body.top, body.top + rows), slice(body.left, body.left + columns)
            seen[place][inside] = normals[inside]
        return seen

    def prepare_quick(
        self, planes: DrawingPlanes, digest: str = "", choices: Sequence[LayerBody] = ()
    ) -> PreparedDrawing:
        """Prepare a drawing in quick detail, in a fraction of a second: small, from quick normals,
        which are neither cached nor filtered, and without overlaps. ``choices`` are the artist's,
        of the bodies of layers.

        Raises:
            DrawingError: there is nothing to light.
        """
        height, width = planes.pixels.shape[:2]
        step = -(-max(width, height) // QUICK_PX)
        drawing = planes.reduced(step).decompose(choices)
        if not drawing.bodies:
            return self._prepare_quick(drawing, (width, height), step, digest)
        own = [
            self._prepare_quick(
                b.drawing, (step * b.drawing.size[0], step * b.drawing.size[1]), step
            )
            for b in drawing.bodies
        ]
        bodies = stack_bodies(drawing.bodies, own, step)
        return PreparedDrawing(
            digest=digest,
            detail="quick",
            size=(width, height),
            step=step,
            layers=drawing,
            scale=float(step),
            height=seen_height(bodies, drawing.mask, step),
            mask=drawing.mask,
            normals=seen_normals(bodies, drawing.mask, step),
            box=character_box(drawing.mask, step),
            bodies=bodies,
        )

    def _prepare_quick(
        self, drawing: Drawing, size: tuple[int, int], step: int, digest: str = ""
    ) -> PreparedDrawing:
        """``drawing`` is a copy of one of ``size`` (width, height), smaller by ``step``."""
        width, height = size
        lines, mask = _halved(drawing)
        normals = self._predictor.predict(lines, mask, quick=True).normals
        scale = width / mask.shape[1]
        return PreparedDrawing(
            digest=digest,
            detail="quick",
            size=(width, height),
            step=step,
            layers=drawing,
            scale=scale,
            height=solve(normals, mask) * np.float32(scale),
            mask=mask,
            normals=normals,
            box=character_box(drawing.mask, step),
        )

    def light(
        self, prepared: PreparedDrawing, scene: Scene, surface: Surface | None = None
    ) -> Passes:
        """Trace the lights of ``scene``, except those that the last call traced on the same
        drawing. ``surface`` is used if given: then one thread can trace while another prepares the
        next surface."""

        def trace(asked: Scene, ambient: bool, glows: Collection[GlowName]) -> Passes:
            stride = QUALITIES[asked.quality].mesh_stride
            found = surface or prepared.surface(asked, stride)
            request = frame_request(prepared.size, found, asked)
            request = replace(request, ambient=ambient, glows=glows)
            return self.renderer.render(request)

        return self._light_passes.complete(prepared.layers, scene, trace, prepared.glows(scene))

    def render(
        self, drawing: Drawing, scene: Scene, neighbours: LazyNeighbours | None = None
    ) -> NDArray[np.uint8]:
        """The lit drawing, (H, W, 4) uint8 sRGB, straight alpha. All hints of ``scene`` are about
        this drawing."""
        prepared = self.prepare(
            drawing, neighbours, hints=(*scene.depth.drawn, *scene.depth.colours)
        )
        passes = self.light(prepared, scene)
        return composite(drawing, passes, scene, edges=prepared.edges_for(scene))


def surface_step(drawing: Drawing) -> int:
    """Canvas pixels per pixel of the surface: 1 up to ``MAX_SURFACE_PX``."""
    return -(-max(drawing.size) // MAX_SURFACE_PX)


def _thumbnail(drawing: Drawing, prediction: Prediction) -> RegistrationThumbnail:
    normals, depth, edge = prediction.normals, prediction.depth, prediction.edge
    order = None
    if depth is not None and edge is not None:
        lines = dividing_lines(drawing.lines, drawing.ink, drawing.mask)
        order = np.dstack([overlap_votes(prediction, drawing.mask, lines), depth, edge])
    name = digest_of(drawing.lines, drawing.mask, drawing.albedo, normals)
    return make_thumbnail(name, drawing.lines, drawing.mask, drawing.albedo, normals, order)


def _shrink(
    prediction: Prediction, mask: NDArray[np.bool_], lines: NDArray[np.float32], step: int
) -> tuple[Prediction, NDArray[np.bool_], NDArray[np.float32]]:
    """Blocks of ``step`` x ``step`` pixels as one: normals are averaged, and a line remains if any
    of its pixels is there. A block is inside if its middle pixel is."""
    rows, columns = mask.shape[0] // step, mask.shape[1] // step
    whole = np.s_[: rows * step, : columns * step]
    pool = torch.nn.functional
    planes = torch.from_numpy(prediction.normals[whole]).permute(2, 0, 1)
    pooled = pool.avg_pool2d(planes, step).permute(1, 2, 0).numpy()
    darkest = pool.max_pool2d(torch.from_numpy(lines[whole])[None], step)[0].numpy()
    middle = block_middles(mask, step)[:rows, :columns]
    length = np.maximum(np.linalg.norm(pooled, axis=2, keepdims=True), 1e-6)
    normals = (pooled / length * middle[..., None]).astype(np.float32)
    depth, edge, votes = (
        None if plane is None else block_middles(plane, step)[:rows, :columns]
        for plane in (prediction.depth, prediction.edge, prediction.votes)
    )
    depth = None if depth is None else depth / np.float32(step)
    return Prediction(normals, depth, edge, votes), middle, darkest


def _halved(drawing: Drawing) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Lines and mask at half the size, or at full size if nothing of the mask would remain."""
    size = max(1, drawing.size[0] // 2), max(1, drawing.size[1] // 2)
    cover = Image.fromarray(drawing.mask.astype(np.uint8) * 255)
    mask = np.asarray(cover.resize(size, Image.Resampling.BOX)) > 96
    if not mask.any():
        return drawing.lines, drawing.mask
    lines = Image.fromarray(drawing.lines).resize(size, Image.Resampling.BOX)
    return np.asarray(lines), mask
