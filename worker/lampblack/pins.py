"""Pinned lights: they follow a place of the drawing, or a layer, from drawing to drawing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from .cache import digest as digest_of
from .drawing import Drawing
from .normals.temporal.carry import carry_points
from .normals.temporal.registration import rigid_registration
from .normals.temporal.temporal_filter import TemporalFilter
from .normals.temporal.thumbnail import RegistrationThumbnail, make_thumbnail
from .scene import Pin, Scene

Offset = tuple[float, float]
"""How far a place has moved, in pixels of the drawing: right, and down."""


def pins_of(scene: Scene) -> tuple[Pin, ...]:
    """The pins of the scene's lamps, each once. Suns have none: only their direction counts."""
    pins = (light.pin for light in scene.lights if light.kind == "lamp")
    return tuple(dict.fromkeys(pin for pin in pins if pin is not None))


def followed(scene: Scene, offsets: Mapping[Pin, Offset]) -> Scene:
    """``scene``, in pixels of a drawing, with its lamps where their pins have moved."""
    if not offsets:
        return scene
    lights = []
    for light in scene.lights:
        moved = offsets.get(light.pin) if light.pin is not None and light.kind == "lamp" else None
        if moved is not None:
            light = replace(light, x=light.x + moved[0], y=light.y + moved[1])
        lights.append(light)
    return replace(scene, lights=tuple(lights))


def carried_place(
    place: Offset, layer: str, source: Drawing, target: Drawing, temporal_filter: TemporalFilter
) -> Offset | None:
    """Where ``place`` of the drawing ``source`` lies in ``target``; None if they have nothing in
    common.

    A place goes where the drawing around it goes. With the name of a ``layer`` it is carried as a
    whole with that layer; with the whole drawing, if the layer is no body in one of the two.

    Args:
        place: x, y in pixels of ``source``.
        temporal_filter: caches registrations.
    """
    start, end = np.zeros(2, np.float32), np.zeros(2, np.float32)
    if layer:
        parts = [
            next((body for body in drawing.bodies if body.name == layer), None)
            for drawing in (source, target)
        ]
        if parts[0] is not None and parts[1] is not None:
            source, target = parts[0].drawing, parts[1].drawing
            start[:], end[:] = (parts[0].left, parts[0].top), (parts[1].left, parts[1].top)
    if not source.mask.any() or not target.mask.any():
        return None
    here, there = _thumbnail(source), _thumbnail(target)
    point = np.array([place], np.float32) - start
    found = None
    if not layer:
        found = carry_points(point, here, there, temporal_filter.registration(here, there))
    if found is None:
        found = carry_points(point, here, there, rigid_registration(here, there))
    if found is None:
        return None
    x, y = (found[0] + end).tolist()
    return x, y


def _thumbnail(drawing: Drawing) -> RegistrationThumbnail:
    """Normals have no part in a registration."""
    name = digest_of("pins", drawing.lines, drawing.mask, drawing.albedo)
    flat = np.zeros((*drawing.mask.shape, 3), np.float32)
    return make_thumbnail(name, drawing.lines, drawing.mask, drawing.albedo, flat)
