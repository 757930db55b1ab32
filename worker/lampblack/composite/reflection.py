"""The light at each pixel of the character, and what its paint reflects of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..colour import linear
from ..drawing.drawing import Drawing
from ..materials import MaterialTable
from ..scene import Scene
from .borders import mixed_labels, swatch_albedos
from .illumination import Illumination
from .resample import Band, enlarge
from .shading import Shading
from .tones import highlight_shares, shade_at, tone_shares

Floats = NDArray[np.float32]
Labels = NDArray[np.int16]


@dataclass(frozen=True, eq=False)
class PixelLight:
    """The light at each pixel of a band, scene-linear (H, W, 3); None where nothing needs it.

    Attributes:
        diffuse: on the paint that each pixel wears. smooth, toned: the same as gradient, in tones.
        glossy: mirrored by paint that is glossy only. sheen: by paint that is diffuse as well.
        shine: in tones.
    """

    diffuse: Floats | None
    smooth: Floats | None
    toned: Floats | None
    glossy: Floats | None
    sheen: Floats | None
    shine: Floats | None
    parts: tuple[PartLight, ...] = ()

    def at(self, places: NDArray[np.bool_]) -> PixelLight:
        """The light at some pixels, (H, W) bool."""
        planes = {n: plane for n, plane in vars(self).items() if n != "parts"}
        there = {n: None if plane is None else plane[places] for n, plane in planes.items()}
        parts = tuple(
            PartLight(part.labels, part.diffuse[places], part.glossy[places]) for part in self.parts
        )
        return PixelLight(**there, parts=parts)


@dataclass(frozen=True, eq=False)
class PartLight:
    """Light on some colours only, dark where a pixel's layer is not lit.

    Attributes:
        labels: (n + 1,) bool, whether each label is lit.
        diffuse, glossy: (H, W, 3) scene-linear.
    """

    labels: NDArray[np.bool_]
    diffuse: Floats
    glossy: Floats

    def on(self, labels: Labels) -> Floats:
        """(..., 1) whether pixels of these labels are lit."""
        return np.asarray(self.labels[labels][..., None], np.float32)


def light_at(drawing: Drawing, shading: Shading, band: Band) -> PixelLight:
    """The light on the rows ``drawing`` of a whole drawing."""
    materials, illumination, tones = shading.materials, shading.illumination, shading.tones
    smooth = toned = glossy = sheen = shine = None
    plain = ~materials.cel
    if (materials.diffuse & plain).any():
        smooth = enlarge(illumination.diffuse, band)
        if tones is not None and tones.strength > 0:
            dark = 1 - np.clip(enlarge(tones.amount[..., None], band), 0, 1)
            smooth = smooth + tones.strength * dark * (tones.tint - smooth)
    if tones is not None and (materials.diffuse & materials.cel).any():
        shade = shade_at(tones, band)
        toned = shade + tone_shares(tones, band)[..., None] * (enlarge(tones.lit, band) - shade)
    if (materials.glossy & plain & ~materials.diffuse).any():
        glossy = enlarge(illumination.glossy, band)
    if (materials.glossy & plain & materials.diffuse).any():
        sheen = enlarge(illumination.sheen, band)
    if tones is not None and (materials.glossy & materials.cel).any():
        shine = highlight_shares(tones, band)[..., None] * enlarge(tones.lit, band)
    if shading.contact is not None:
        near = enlarge(shading.contact, band)
        smooth, toned, glossy, sheen = (
            None if light is None else light * near for light in (smooth, toned, glossy, sheen)
        )
    parts = parts_at(drawing, shading, band)
    diffuse = smooth if toned is None else toned
    if smooth is not None and toned is not None:
        diffuse = np.where(materials.cel[drawing.labels][..., None], toned, smooth)
    if diffuse is not None:
        for part in parts:
            diffuse = diffuse + part.on(drawing.labels) * part.diffuse
    return PixelLight(diffuse, smooth, toned, glossy, sheen, shine, parts)


def parts_at(drawing: Drawing, shading: Shading, band: Band) -> tuple[PartLight, ...]:
    """The light on parts of the character, on the rows ``drawing`` of a whole drawing."""
    found = []
    for link, diffuse, glossy in shading.parts:
        diffuse, glossy = enlarge(diffuse, band), enlarge(glossy, band)
        if shading.contact is not None:
            near = enlarge(shading.contact, band)
            diffuse, glossy = diffuse * near, glossy * near
        if drawing.owners is not None:
            lit = link.owners(drawing.layers)[drawing.owners][..., None]
            diffuse, glossy = diffuse * lit, glossy * lit
        found.append(PartLight(link.labels(drawing.palette), diffuse, glossy))
    return tuple(found)


def character_light(
    drawing: Drawing, scene: Scene, illumination: Illumination, band: Band
) -> tuple[Floats, Floats, Floats]:
    """Diffuse light, glossy light, and colours that are shown as drawn, for the fill in ``band``,
    all smooth; scene-linear (H, W, 3), unbounded."""
    materials = MaterialTable.of(scene, drawing.palette.colours).smooth()
    parts = tuple(illumination.parts)
    shading = Shading(illumination, materials, None, None, None, None, 0.0, parts)
    return reflected_light(drawing, shading, light_at(drawing, shading, band))


def reflected_light(
    drawing: Drawing, shading: Shading, light: PixelLight
) -> tuple[Floats, Floats, Floats]:
    """Diffuse light, glossy light, and colours that are shown as drawn; scene-linear (H, W, 3),
    unbounded."""
    albedo = linear(drawing.albedo)
    other, share = mixed_labels(drawing.labels, albedo, drawing.palette)
    blend = share > 0
    theirs = np.minimum(
        albedo[blend], share[blend, None] * swatch_albedos(drawing.palette)[other[blend]]
    )
    albedo[blend] -= theirs
    found = _reflected(shading.materials, drawing.labels, albedo, 1 - share[..., None], light)
    there = light.at(blend)
    second = _reflected(shading.materials, other[blend], theirs, share[blend, None], there)
    for whole, part in zip(found, second, strict=True):
        whole[blend] += part
    return found


def _reflected(
    materials: MaterialTable, labels: Labels, albedo: Floats, share: Floats, light: PixelLight
) -> tuple[Floats, Floats, Floats]:
    """Diffuse light, glossy light, and colours left as drawn, (..., 3) each, of parts of
    pixels: ``albedo`` is weighted by their ``share`` (..., 1)."""
    has_diffuse, has_glossy, cel = (
        kind[labels][..., None] for kind in (materials.diffuse, materials.glossy, materials.cel)
    )
    amount = materials.gloss[labels][..., None]
    none = np.float32(0)

    def chosen(toned: Floats | None, smooth: Floats | None) -> Floats | np.float32:
        if toned is None or smooth is None:
            return smooth if smooth is not None else toned if toned is not None else none
        return np.where(cel, toned, smooth)

    lit, sheen = chosen(light.toned, light.smooth), chosen(light.shine, light.sheen)
    mirrored = chosen(light.shine, light.glossy)
    for part in light.parts:
        reached = part.on(labels)
        lit = lit + reached * part.diffuse
        sheen, mirrored = sheen + reached * part.glossy, mirrored + reached * part.glossy
    shine = amount * np.where(has_diffuse, share * sheen, albedo * mirrored)
    return (
        np.where(has_diffuse, albedo * lit, none),
        np.where(has_glossy, shine, none),
        np.where(has_diffuse | has_glossy, none, albedo),
    )


def emitted_light(drawing: Drawing, materials: MaterialTable) -> tuple[Floats, Floats] | None:
    """What emissive colours show beside the light on them, scene-linear (H, W, 3): what they give,
    and of it the colours that would be left as drawn. None if there are none."""
    if not materials.emission.any():
        return None
    albedo = linear(drawing.albedo)
    other, share = mixed_labels(drawing.labels, albedo, drawing.palette)
    theirs = np.minimum(albedo, share[..., None] * swatch_albedos(drawing.palette)[other])
    theirs[share <= 0] = 0
    as_drawn = ~(materials.diffuse | materials.glossy) & (materials.emission > 0)
    given, own = np.zeros_like(albedo), np.zeros_like(albedo)
    for labels, paint in ((drawing.labels, albedo - theirs), (other, theirs)):
        given += paint * materials.emission[labels][..., None]
        own += paint * as_drawn[labels][..., None]
    return given + own, own
