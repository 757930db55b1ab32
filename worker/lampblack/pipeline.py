"""The path from a drawing to a lit drawing: drawing -> surface -> passes -> picture.

The command line, the farm and the live worker all use it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from types import TracebackType
from typing import Protocol, Self

import numpy as np
from numpy.typing import NDArray

from .cache import ArrayCache
from .choices import DeviceChoice, GlowName, PipelineOptions
from .composite import composite
from .composite.shading import needs_ambient, needs_each_light
from .drawing import Drawing, DrawingPlanes
from .materials import MaterialTable
from .normals.temporal.temporal_filter import LazyNeighbours
from .preparation import prepare, prepare_quick
from .prepared import PreparedDrawing
from .render.client import RenderChild
from .render.light_pass_cache import LightPassCache
from .render.passes import Passes
from .render.quality import QUALITIES
from .render.request import RenderRequest, Surface, as_mixture, frame_request, mixable
from .scene import Hint, LayerBody, Scene
from .surface_maker import Predictor, Progress, SurfaceMaker, no_progress


class Renderer(Protocol):
    """Traces light; see ``RenderChild``."""

    @property
    def pid(self) -> int | None:
        """ID of its process; None if it does not run."""

    def start(self) -> None:
        """Start the renderer, unless it runs."""

    def require_device(self) -> None:
        """Wait until it is known that it traces on the device that was asked for by name."""

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
        device: what the child process traces on.

    Attributes:
        surfaces: makes normals and heights.
    """

    def __init__(
        self,
        cache: ArrayCache,
        options: PipelineOptions | None = None,
        *,
        predictor: Predictor | None = None,
        renderer: Renderer | None = None,
        device: DeviceChoice = "cpu",
    ) -> None:
        self.surfaces = SurfaceMaker(cache, options or PipelineOptions(), predictor)
        self.renderer: Renderer = renderer or RenderChild(device=device)
        self._light_passes = LightPassCache()

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
        _ = self.surfaces.predictor

    def prepare(
        self,
        drawing: Drawing,
        neighbours: LazyNeighbours | None = None,
        *,
        hints: Sequence[Hint] = (),
        digest: str = "",
        progress: Progress = no_progress,
        with_normals: bool = False,
    ) -> PreparedDrawing:
        """See ``preparation.prepare``."""
        return prepare(
            self.surfaces,
            drawing,
            neighbours,
            hints=hints,
            digest=digest,
            progress=progress,
            with_normals=with_normals,
        )

    def prepare_quick(
        self, planes: DrawingPlanes, digest: str = "", choices: Sequence[LayerBody] = ()
    ) -> PreparedDrawing:
        """See ``preparation.prepare_quick``."""
        return prepare_quick(self.surfaces.first_look, planes, digest, choices)

    def light(
        self,
        prepared: PreparedDrawing,
        scene: Scene,
        surface: Surface | None = None,
        *,
        mixed: bool = False,
    ) -> Passes:
        """Trace the lights of ``scene``, except those that the last call traced on the same
        drawing.

        Args:
            surface: used if given: then one thread can trace while another prepares the next one.
            mixed: the composite of these passes is all that is wanted of them. Unless it tells
                lights apart, they and the ambient light are then traced as one, at lower cost.
        """

        def request(asked: Scene, glows: Collection[GlowName]) -> RenderRequest:
            stride = QUALITIES[asked.quality].mesh_stride
            found = surface or prepared.surface(asked, stride)
            return replace(frame_request(prepared.size, found, asked), glows=glows)

        def trace(asked: Scene, ambient: bool, glows: Collection[GlowName]) -> Passes:
            return self.renderer.render(replace(request(asked, glows), ambient=ambient))

        glows = prepared.glows(scene)
        materials = MaterialTable.of(scene, prepared.palette.colours)
        if mixed and mixable(scene.lights) and not needs_each_light(scene, materials):
            apart = needs_ambient(scene, materials)
            mixture = as_mixture(request(scene, glows), scene, with_ambient=not apart)
            if not apart:
                return self.renderer.render(mixture)
            if len(mixture.lights) > 1:  # one light is its own mixture
                return self._light_passes.beside_mixture(
                    prepared.layers,
                    scene,
                    lambda ambient: self.renderer.render(replace(mixture, ambient=ambient)),
                )
        return self._light_passes.complete(prepared.layers, scene, trace, glows)

    def render(
        self, drawing: Drawing, scene: Scene, neighbours: LazyNeighbours | None = None
    ) -> NDArray[np.uint8]:
        """The lit drawing, (H, W, 4) uint8 sRGB, straight alpha. All hints of ``scene`` are about
        this drawing."""
        prepared = self.prepare(
            drawing, neighbours, hints=(*scene.depth.drawn, *scene.depth.colours)
        )
        passes = self.light(prepared, scene, mixed=True)
        edges, form = prepared.edges_for(scene), prepared.form_for(scene)
        return composite(drawing, passes, scene, edges=edges, form=form)
