"""The materials of a drawing, by label, for the composite and the renderer."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .affects import Affects, traced_part
from .scene import Material, Scene


@dataclass(frozen=True, eq=False)
class MaterialTable:
    """Materials by label, n + 1 of them. Label -1, past the drawing's edge, is the last one, the
    default material.

    Attributes:
        diffuse, glossy: (n + 1,) bool.
        gloss: (n + 1,) float32 in 0..1, amount of the glossy lobe; 0 where not glossy.
        roughness: (n + 1,) float32 in 0.02..1.
        cel: (n + 1,) bool, lit in tones.
        emission: (n + 1,) float32; none past the edge. glow: the same in 0..1, as a share of the
            scene's largest.
        key: all that affects traced light, except the amounts of gloss.
        amounts: ``gloss`` as a comparable value.
    """

    diffuse: NDArray[np.bool_]
    glossy: NDArray[np.bool_]
    gloss: NDArray[np.float32]
    roughness: NDArray[np.float32]
    cel: NDArray[np.bool_]
    emission: NDArray[np.float32]
    glow: NDArray[np.float32]
    key: Hashable
    amounts: tuple[float, ...]

    @staticmethod
    def of(scene: Scene, colours: Iterable[str]) -> MaterialTable:
        """The materials of flat ``colours``, ``#rrggbb`` in the order of their labels."""
        materials = [*map(scene.material, colours), scene.default_material]
        amounts = tuple(m.gloss if m.glossy else 0.0 for m in materials)
        emission = np.array([*(m.emission for m in materials[:-1]), 0.0], np.float32)
        return MaterialTable(
            diffuse=np.array([m.diffuse for m in materials], np.bool_),
            glossy=np.array([m.glossy for m in materials], np.bool_),
            gloss=np.array(amounts, np.float32),
            roughness=np.array([m.roughness for m in materials], np.float32),
            cel=np.array([_in_tones(m, scene) for m in materials], np.bool_),
            emission=emission,
            glow=emission / np.float32(scene.brightest or 1),
            key=tuple(
                (amount > 0, traced_part(material, Affects.GLOSS))
                for amount, material in zip(amounts, materials, strict=True)
            ),
            amounts=amounts,
        )

    def smooth(self) -> MaterialTable:
        """The same materials, none of them in tones."""
        return replace(self, cel=np.zeros_like(self.cel))


def _in_tones(material: Material, scene: Scene) -> bool:
    return material.look == "cel" or (material.look == "scene" and bool(scene.look.tones))
