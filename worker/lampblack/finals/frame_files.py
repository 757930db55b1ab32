"""The files of a frame: its lit picture, and the layers that the picture is taken apart into."""

from __future__ import annotations

import shutil
from dataclasses import dataclass
from typing import Any

from numpy.typing import NDArray

from ..atomic import atomic_path
from ..composite import composite
from ..composite.apart import Stages, apart_bytes, apart_linear, byte_stages, float_stages
from ..drawing import Drawing
from ..shot import Picture, Shot, ShotFrame
from .exr import save_exr
from .layers import Layers, make_layers, scene_linear, seen_layers
from .ora import save_ora
from .png import save_png
from .targets import Targets
from .tasks import Traced


@dataclass(frozen=True)
class LitCel:
    """A lit cel, as far as its files need it.

    Attributes:
        picture: (H, W, 4) uint8 sRGB, straight alpha, or the layers of an EXR.
        stages: the picture in its stages; None if it is not taken apart.
    """

    picture: Picture | Layers
    stages: Stages | None = None

    @staticmethod
    def blank(pixels: Picture, targets: Targets) -> LitCel:
        """A cel that is shown as drawn."""
        apart = targets.apart != "none" and targets.kind == "png"
        return LitCel(pixels, Stages.unlit(pixels) if apart else None)

    @staticmethod
    def of(traced: Traced, targets: Targets) -> LitCel:
        """The cel lit by its passes."""
        prepared, scene, passes = traced.task.prepared, traced.task.scene, traced.passes
        drawing = prepared.layers
        assert isinstance(drawing, Drawing)
        edges, form = prepared.edges_for(scene), prepared.form_for(scene)
        if targets.kind == "exr":
            apart = None
            if targets.apart != "none":
                apart = float_stages(drawing, passes, scene, edges, form)
            return LitCel(make_layers(prepared, scene, passes), apart)
        if targets.apart == "none":
            return LitCel(composite(drawing, passes, scene, edges=edges, form=form))
        stages = byte_stages(drawing, passes, scene, edges, form)
        return LitCel(stages.lit[-1], stages)


def save_frame(shot: Shot, frame: ShotFrame, lit: LitCel, targets: Targets, stamp: str) -> None:
    """Write all files of ``frame``.

    Raises:
        OutputError: one cannot be written.
    """

    def finish(picture: NDArray[Any]) -> NDArray[Any]:
        return shot.finish(frame, picture)

    stages = None if lit.stages is None else lit.stages.seen(finish)
    path = targets.path(frame)
    if targets.kind == "exr":
        layers = seen_layers(shot, frame, lit.picture)
        if stages is not None:
            layers |= apart_linear(stages, scene_linear)
        save_exr(path, layers, stamp)
    elif stages is None:
        assert not isinstance(lit.picture, Layers)
        save_png(path, finish(lit.picture), stamp)
    else:
        merged = stages.lit[-1]
        parts = apart_bytes(stages, blended=targets.apart != "pencil2d")
        if targets.apart == "ora":
            save_ora(targets.ora(frame), parts, merged, stamp)
        else:
            for name, _, part in parts:
                save_png(targets.layer(frame, name), part, stamp)
        save_png(path, merged, stamp)


def copy_frame(source: ShotFrame, frame: ShotFrame, targets: Targets) -> None:
    """Copy the files of another frame that has the same inputs.

    Raises:
        OutputError: one cannot be written.
    """
    for path, target in zip(targets.paths(source), targets.paths(frame), strict=True):
        with atomic_path(target) as temporary:
            shutil.copyfile(path, temporary)
