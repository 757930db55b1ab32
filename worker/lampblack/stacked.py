"""The bodies of a drawing: each is prepared on its own, then they rest on one another."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .drawing import Body
from .drawing.joints import body_width, joint_of
from .drawing.morphology import from_nearest
from .prepared import PreparedBody, PreparedDrawing, Sample
from .surface import Overlap, Sheet, stack


def stack_bodies(
    bodies: Sequence[Body], prepared: Sequence[PreparedDrawing], step: int
) -> tuple[PreparedBody, ...]:
    """Put prepared bodies onto one another.

    Args:
        bodies: bottom first, in pixels of which each is ``step`` pixels of the whole drawing.
        prepared: the same bodies, each as a drawing of its own.
    """
    prepared = [_with_rim(own, body, step) for body, own in zip(bodies, prepared, strict=True)]
    sheets = [
        Sheet(
            height=own.height,
            mask=own.mask,
            joint=_sampled(joint_of(body.drawing), own, step),
            left=float(body.left * step),
            top=float(body.top * step),
            scale=own.scale,
            width=body_width(body.drawing) * step,
        )
        for body, own in zip(bodies, prepared, strict=True)
    ]
    return tuple(
        PreparedBody(body.name, body.left * step, body.top * step, own, base)
        for body, own, base in zip(bodies, prepared, stack(sheets), strict=True)
    )


def seen_height(
    bodies: Sequence[PreparedBody], mask: NDArray[np.bool_], scale: float
) -> NDArray[np.float32]:
    """The height of the topmost body at each element of ``mask``, (h, w), 0 outside; in pixels of
    the whole, each element ``scale`` pixels wide."""
    height = np.zeros(mask.shape, np.float32)
    for body in bodies:
        row, column, at = body.seen_on(mask.shape, scale)
        base = body.base.at((column + 0.5) * scale, (row + 0.5) * scale)
        height[row, column] = body.drawing.height.ravel()[at] + base
    return np.where(mask, height, np.float32(0))


def seen_normals(
    bodies: Sequence[PreparedBody], mask: NDArray[np.bool_], scale: float
) -> NDArray[np.float32]:
    """The normals of the topmost body at each element of ``mask``, (h, w, 3), 0 outside; those of
    the bodies are as large as their masks."""
    normals = np.zeros((*mask.shape, 3), np.float32)
    for body in bodies:
        row, column, at = body.seen_on(mask.shape, scale)
        assert body.drawing.normals is not None
        normals[row, column] = body.drawing.normals.reshape(-1, 3)[at]
    normals[~mask] = 0
    return normals


def seen_overlaps(bodies: Sequence[PreparedBody]) -> tuple[Overlap, ...]:
    """The overlaps within the bodies, in pixels of the whole, the longest first."""
    found = [
        replace(overlap, points=overlap.points + body.corner[:2])
        for body in bodies
        for overlap in body.drawing.overlaps
    ]
    return tuple(sorted(found, key=lambda overlap: -len(overlap.points)))


def _with_rim(own: PreparedDrawing, body: Body, step: int) -> PreparedDrawing:
    """The prepared body with its rim, which is as high as the nearest part of it."""
    rim = _sampled(body.rim, own, step) & ~own.mask
    if not rim.any():
        return own
    height = np.where(rim, from_nearest(own.height, own.mask), own.height)
    normals = own.normals
    if normals is not None and normals.shape[:2] == rim.shape:
        normals = np.where(rim[..., None], from_nearest(normals, own.mask), normals)
    return replace(own, height=height, mask=own.mask | rim, normals=normals)


def _sampled(plane: NDArray[Sample], own: PreparedDrawing, step: int) -> NDArray[Sample]:
    """``plane``, of the body's drawing, at the elements of its height."""
    row, column = (
        np.minimum(((np.arange(count) + 0.5) * own.scale / step).astype(np.intp), size - 1)
        for count, size in zip(own.mask.shape, plane.shape, strict=True)
    )
    found: NDArray[Sample] = plane[np.ix_(row, column)]
    return found
