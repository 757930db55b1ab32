"""Builds a character from a blended body and parts attached to it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import trimesh
from scipy.spatial.transform import Rotation

from ..models import Model
from .field import Vector
from .implicit_surface import ImplicitSurface, Mesh
from .lathe import lathe


def aim(yaw: float, pitch: float, roll: float = 0.0) -> Vector:
    """(3, 3) rotation, degrees: turns z to the character's left (x), then up, then about itself."""
    turn: Vector = Rotation.from_euler("YXZ", [yaw, -pitch, roll], degrees=True).as_matrix()
    return turn


def towards(direction: Vector) -> Vector:
    """(3, 3) rotation that takes z to ``direction`` and keeps x level."""
    x, y, z = direction / np.linalg.norm(direction)
    return aim(np.degrees(np.arctan2(x, z)), np.degrees(np.arcsin(np.clip(y, -1, 1))))


@cache
def _ball() -> Mesh:
    ball = trimesh.creation.icosphere(subdivisions=4)
    vertices: Vector = np.asarray(ball.vertices, float)
    return Mesh(vertices, np.asarray(ball.faces, np.int64), vertices)


@dataclass(frozen=True)
class Ball:
    """An ellipsoid on which other parts are placed: a head, a belly."""

    centre: Vector
    radii: Vector
    turn: Vector

    def at(self, x: float, y: float, z: float, depth: float = 1.0) -> Vector:
        """The point of the surface in a direction of its axes; ``depth`` 0 is the centre."""
        direction = np.array([x, y, z]) / np.linalg.norm([x, y, z])
        point: Vector = self.centre + self.turn @ (self.radii * direction * depth)
        return point

    def facing(self, x: float, y: float, z: float) -> Vector:
        """(3, 3) rotation that takes z to the normal of the surface in a direction."""
        return towards(self.turn @ (np.array([x, y, z]) / self.radii))


class CharacterBuilder:
    """Parts are blended into ``body``, or attached as meshes of their own.

    Sizes and angles are drawn from ``rng``.
    """

    def __init__(self, rng: np.random.Generator) -> None:
        self.rng = rng
        self.body = ImplicitSurface()
        self.softness = float(np.exp(rng.uniform(np.log(0.08), np.log(1.3))))
        """How far parts flow into one another, as a share of their radius."""
        self._attached: list[Mesh] = []

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def pick(self, *kinds: str) -> str:
        return kinds[int(self.rng.integers(len(kinds)))]

    def vary(self, value: float, spread: float = 0.2) -> float:
        """``value`` made larger or smaller by chance."""
        return float(value * np.exp(np.clip(self.rng.normal(0, spread), -2 * spread, 2 * spread)))

    def bend(self, degrees: float) -> float:
        """An angle about 0."""
        return float(np.clip(self.rng.normal(0, degrees), -2 * degrees, 2 * degrees))

    def between(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def ball(self, centre: Vector, radii: list[float], turn: Vector | None = None) -> Ball:
        """Blend an ellipsoid into the body."""
        self.body.ellipsoid(centre, np.array(radii), self.softness * min(radii), turn)
        return Ball(centre, np.array(radii), np.eye(3) if turn is None else turn)

    def limb(self, points: list[Vector], radii: list[float], *, attached: bool = False) -> None:
        """Blend a chain of round cones into the body, or attach it."""
        surface = ImplicitSurface() if attached else self.body
        surface.chain(np.array(points), np.array(radii), self.softness * radii[0])
        if attached:
            self.attach(surface.mesh(56))

    def curl(
        self, start: Vector, turn: Vector, length: float, radii: tuple[float, float], sway: float
    ) -> tuple[list[Vector], list[float], Vector]:
        """A bent chain from ``start`` along the z of ``turn``: points, radii and the last turn."""
        steps = 7
        yaw, pitch, change = self.bend(sway), self.bend(sway), self.bend(sway / 2)
        points, widths = [start], [radii[0]]
        for step in range(1, steps + 1):
            turn = turn @ aim(yaw / steps * 2, (pitch + change * (step - 4)) / steps * 2)
            points.append(points[-1] + turn[:, 2] * length / steps)
            widths.append(radii[0] + (radii[1] - radii[0]) * step / steps)
        return points, widths, turn

    def attach(
        self, mesh: Mesh, centre: Vector | None = None, transform: Vector | None = None
    ) -> None:
        """Add a mesh without blending; ``transform`` (3, 3) may stretch it."""
        vertices, normals = mesh.vertices, mesh.normals
        if transform is not None:
            vertices = vertices @ transform.T
            normals = normals @ np.linalg.inv(transform)
            normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
        if centre is not None:
            vertices = vertices + centre
        self._attached.append(Mesh(vertices, mesh.faces, normals))

    def attach_ball(self, centre: Vector, radii: list[float], turn: Vector | None = None) -> None:
        stretch = np.diag(radii) if turn is None else turn * radii
        self.attach(_ball(), centre, stretch)

    def attach_lathed(
        self,
        centre: Vector,
        turn: Vector,
        profile: list[list[float]],
        thickness: float,
        **cloth: float,
    ) -> None:
        """Attach a surface of revolution, see ``lathe``; the y of ``turn`` is its axis."""
        folds = int(cloth.pop("folds", 0))
        self.attach(lathe(np.array(profile), thickness, folds=folds, **cloth), centre, turn)

    def model(self, name: str) -> Model:
        """All parts as one mesh, centred, its bounding-box half diagonal 1."""
        meshes = [self.body.mesh(), *self._attached]
        starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
        vertices = np.concatenate([mesh.vertices for mesh in meshes])
        faces = np.concatenate(
            [mesh.faces + start for mesh, start in zip(meshes, starts[:-1], strict=True)]
        )
        normals = np.concatenate([mesh.normals for mesh in meshes])
        low, high = vertices.min(axis=0), vertices.max(axis=0)
        vertices = (vertices - (low + high) / 2) / (float(np.linalg.norm(high - low)) / 2)
        return Model(
            name=name,
            vertices=vertices.astype(np.float32),
            faces=faces.astype(np.int32),
            corner_normals=normals[faces].astype(np.float32),
            double_sided=False,
        )
