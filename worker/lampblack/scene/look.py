"""The look: how traced light becomes a picture."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated

from msgspec import Meta

from .values import Colour, Extra, Unit

MAX_TONES = 3


@dataclass(frozen=True)
class Look:
    """How light is shown: in smooth gradients, or in flat tones as in cel animation.

    ``tones`` are thresholds between two tones each, as shares of the full light, the way the eye
    sees them: 0 is no light, 1 a surface that faces the strongest light. Without any the light is
    smooth. ``softness`` is the width of the blend at a threshold; 0 is hard. ``shade_strength`` is
    how far the shade has the drawn colour times ``shade_colour`` in place of its own light.
    ``cast_strength`` is how far shadows that something casts on the character have the drawn colour
    times ``cast_colour`` in place of the light of the shade, where there are tones.
    ``highlight`` is the threshold of the highlights of glossy paint, where there are tones.

    ``contact`` darkens where surfaces touch. With ``ink_light`` the line takes light: it is darker
    in shade, and tinted by the lit fill. ``glow`` is the bloom around emissive colours.
    """

    tones: Annotated[
        tuple[Unit, ...],
        Meta(max_length=MAX_TONES, description="shares of the full light; none: smooth"),
    ] = ()
    softness: Annotated[Unit, Meta(description="width of the blend between two tones")] = 0.05
    shade_colour: Colour = "#4a4468"
    shade_strength: Annotated[Unit, Meta(description="how far shade has its colour")] = 0.0
    cast_colour: Colour = "#332e52"
    cast_strength: Annotated[Unit, Meta(description="how far cast shadows have their colour")] = 0.0
    highlight: Annotated[Unit, Meta(description="from which light on gloss is seen")] = 0.5
    contact: Annotated[Unit, Meta(description="darkness where surfaces touch")] = 0.0
    ink_light: Annotated[Unit, Meta(description="how far the line takes light")] = 0.0
    glow: Annotated[Unit, Meta(description="bloom around colours that shine")] = 0.0
    extra: Extra = field(default_factory=dict)


@dataclass(frozen=True)
class Rim:
    """A band of light inside the character's silhouette, and along the edge of each part that is in
    front of another.

    ``width`` is that of the band. It begins at the inner edge of the outline. ``away`` is how far
    the band is left out on the side that faces the strongest light: 0 is all around.
    """

    width: Annotated[float, Meta(ge=0.25, le=1000, description="canvas pixels")] = 8.0
    colour: Colour = "#ffffff"
    strength: Annotated[Unit, Meta(description="brightness of the band")] = 0.8
    away: Annotated[Unit, Meta(description="how far the band is left out towards the light")] = 0.5
    extra: Extra = field(default_factory=dict)
