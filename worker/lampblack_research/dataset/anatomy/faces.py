"""Heads: muzzles, eyes, ears, horns, mouths, hair and hats."""

from __future__ import annotations

import numpy as np

from .builder import Ball, CharacterBuilder, aim, towards
from .field import Vector
from .implicit_surface import ImplicitSurface

MUZZLES = ("none", "none", "none", "short", "long", "pig", "beak", "trunk")
"""Of people and upright animals: one is picked; most have none."""


def head(builder: CharacterBuilder, centre: Vector, size: float, turn: Vector, muzzle: str) -> Ball:
    """A head of radius ``size`` that looks along the z of ``turn``; ``muzzle`` is ``none``,
    ``short``, ``long``, ``trunk``, ``pig`` or ``beak``."""
    skull = builder.ball(
        centre, [builder.vary(size, 0.12), builder.vary(size, 0.12), builder.vary(size, 0.1)], turn
    )
    if builder.chance(0.3):
        cheek = size * builder.between(0.35, 0.5)
        for side in (1, -1):
            builder.ball(skull.at(0.55 * side, -0.35, 0.6, 0.8), [cheek, cheek, cheek])
    _SHAPES[muzzle](builder, skull, size)
    _eyes(builder, skull, size)
    ears = builder.pick("none", "ball", "cone", "flop", "long", "hollow", "hollow")
    if muzzle != "beak" and ears != "none":
        _ears(builder, skull, size, ears)
    _top(builder, skull, size)
    return skull


def _bare(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    if builder.chance(0.6):
        nose = builder.vary(0.14 * size, 0.4)
        at = skull.at(0, -0.1, 1)
        if builder.chance(0.5):
            builder.ball(at, [nose, nose, nose * 1.2], skull.turn)
        else:
            builder.attach_ball(at, [nose * 1.3, nose, nose], skull.turn)
    _mouth(builder, skull.at(0, -0.5, 0.9), skull.turn, size * builder.between(0.25, 0.55))


def _mouth(builder: CharacterBuilder, at: Vector, turn: Vector, width: float) -> None:
    kind = builder.pick("none", "smile", "open", "lips")
    if kind == "open":
        radii = np.array([width, width * builder.between(0.35, 1), width * 0.9])
        builder.body.dent(at, radii, 0.15 * width, turn)
        if builder.chance(0.5):
            tongue = at - turn[:, 1] * radii[1] * 0.6 - turn[:, 2] * width * 0.1
            builder.attach_ball(tongue, [width * 0.6, width * 0.2, width * 0.6], turn)
    elif kind == "smile":
        for side in (-2, -1, 0, 1, 2):
            x, up = side * width * 0.4, (side / 2) ** 2 * width * 0.4
            dent = at + turn @ np.array([x, up, -abs(side) * width * 0.08])
            slant = turn @ aim(0, 0, side * 18)
            builder.body.dent(dent, np.array([0.32, 0.1, 0.3]) * width, 0.08 * width, slant)
    elif kind == "lips":
        builder.attach_ball(at, [width * 0.6, width * 0.14, width * 0.2], turn)
        builder.attach_ball(
            at - turn[:, 1] * width * 0.22, [width * 0.5, width * 0.16, width * 0.2], turn
        )


def _short(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    wide = builder.vary(0.5 * size)
    high, out = builder.vary(0.36 * size), builder.vary(0.45 * size)
    at = skull.at(0, -0.35, 0.9, 0.9)
    snout = builder.ball(at, [wide, high, out], skull.turn)
    nose = builder.vary(0.15 * size, 0.3)
    builder.attach_ball(snout.at(0, 0.6, 1), [nose * 1.3, nose, nose], skull.turn)
    _mouth(builder, snout.at(0, -0.4, 1), skull.turn, 0.6 * wide)


def _long(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    turn = skull.turn @ aim(0, builder.between(-25, 0))
    length, tip = size * builder.between(0.8, 1.8), size * builder.between(0.2, 0.42)
    start = skull.at(0, -0.3, 0.8, 0.5)
    end = start + turn[:, 2] * length
    builder.limb([start, end], [builder.vary(0.55 * size, 0.1), tip])
    if builder.chance(0.5):  # a jaw, open
        jaw = turn @ aim(0, builder.between(-40, -10))
        under = start - turn[:, 1] * 0.2 * size
        builder.limb([under, under + jaw[:, 2] * length * 0.9], [0.35 * size, 0.6 * tip])
    nose = builder.vary(0.6 * tip, 0.2)
    at = end + turn @ np.array([0, 0.6, 0.75]) * tip
    if builder.chance(0.6):
        builder.attach_ball(at, [nose * 1.2, nose, nose], turn)
    else:
        for side in (1, -1):
            nostril = end + turn @ np.array([0.5 * side, 0.5, 0.75]) * tip
            builder.body.dent(nostril, np.full(3, 0.22 * tip), 0.1 * tip)


def _trunk(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    turn = skull.turn @ aim(0, builder.between(-80, -30))
    points, radii, _ = builder.curl(
        skull.at(0, -0.2, 1, 0.75),
        turn,
        size * builder.between(1.5, 3.2),
        (0.42 * size, 0.17 * size),
        70,
    )
    builder.limb(points, radii)
    builder.body.dent(
        points[-1] + 0.15 * size * _unit(points[-1] - points[-2]), np.full(3, 0.1 * size), 0.02
    )
    if builder.chance(0.6):
        for side in (1, -1):
            tusk = skull.turn @ aim(15 * side, builder.between(-40, 10))
            start = skull.at(0.45 * side, -0.5, 0.8, 0.8)
            tusks, widths, _ = builder.curl(start, tusk, size * 1.2, (0.12 * size, 0.03 * size), 0)
            builder.limb(tusks, widths, attached=True)


def _pig(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    disc = builder.vary(0.4 * size)
    start = skull.at(0, -0.2, 1, 0.6)
    end = start + skull.turn[:, 2] * size * builder.between(0.6, 0.9)
    builder.limb([start, end], [disc * 1.1, disc * 0.9])
    flat = end + skull.turn[:, 2] * disc * 0.6
    builder.attach_ball(flat, [disc * 1.1, disc * 0.95, disc * 0.5], skull.turn)
    _mouth(builder, skull.at(0, -0.75, 0.8), skull.turn, 0.4 * size)


def _beak(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    length, high = size * builder.between(0.5, 1.8), size * builder.between(0.2, 0.4)
    droop, gape = builder.between(-15, 5), builder.chance(0.4) * builder.between(10, 40)
    wide = builder.between(0.7, 1.6)
    for upper in (1, -1):
        turn = skull.turn @ aim(0, droop + upper * gape / 2)
        surface = ImplicitSurface()
        surface.cone(np.zeros(3), high, np.array([0, -0.1 * high, length]), 0.15 * high, 0)
        start = skull.at(0, -0.1 - 0.25 * (upper < 0), 1, 0.8)
        builder.attach(
            surface.mesh(56), start, turn @ np.diag([wide, 0.8, 1 if upper > 0 else 0.85])
        )


_SHAPES = {
    "none": _bare,
    "short": _short,
    "long": _long,
    "trunk": _trunk,
    "pig": _pig,
    "beak": _beak,
}


def _eyes(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    wide, up = builder.between(0.3, 0.7), builder.between(0.15, 0.5)
    radius = builder.vary(0.17 * size, 0.45)
    kind = builder.pick("attached", "attached", "socket", "lid", "blended")
    for side in (1, -1):
        at = skull.at(wide * side, up, 0.85, 0.97)
        turn = skull.facing(wide * side, up, 0.85)
        if kind == "socket":
            builder.body.dent(at, radius * np.array([1.6, 1.3, 1.1]), 0.4 * radius, turn)
            at = at - turn[:, 2] * 0.5 * radius
        if kind == "blended":
            builder.ball(at, [radius, radius, radius], turn)
            continue
        builder.attach_ball(at, [radius, builder.between(1, 1.4) * radius, 0.8 * radius], turn)
        if kind == "lid":
            lid = ImplicitSurface()
            lid.ellipsoid(np.zeros(3), np.full(3, 1.25 * radius), 0)
            lid.dent(np.array([0, -1.3, 0.9]) * radius, np.full(3, 1.6 * radius), 0.1 * radius)
            builder.attach(lid.mesh(36), at, turn)


def _ears(builder: CharacterBuilder, skull: Ball, size: float, kind: str) -> None:
    wide, up, back = (
        builder.between(0.5, 1.1),
        builder.between(0.4, 1.1),
        builder.between(-0.4, 0.2),
    )
    if kind == "flop":
        wide, up = 1.0, 0.6
    length, broad = builder.vary(0.55 * size, 0.3), builder.vary(0.32 * size, 0.25)
    if kind == "long":
        length, broad, wide, up = 1.5 * length, 0.7 * broad, 0.45, 1.0
    swing, tilt = builder.between(10, 60), builder.bend(25)
    for side in (1, -1):
        root = skull.at(wide * side, up, back, 0.9)
        lean = swing if kind in ("cone", "long", "hollow", "ball") else 140
        lean = lean + builder.bend(12)
        out = np.array([np.sin(np.radians(lean)) * side, np.cos(np.radians(lean)), 0.0])
        axis = skull.turn @ aim(0, tilt) @ out
        turn = _upright(axis, skull.turn[:, 2])
        if kind == "ball":
            builder.attach_ball(root + axis * broad, [1.2 * broad, 1.2 * broad, 0.5 * broad], turn)
            continue
        if kind == "cone":
            builder.limb(
                [root, root + axis * length * 1.4],
                [broad, 0.15 * broad],
                attached=builder.softness < 0.4,
            )
            continue
        ear = ImplicitSurface()
        thick = 0.4 * broad
        ear.ellipsoid(np.zeros(3), np.array([broad, length, thick]), 0)
        if kind != "flop" or builder.softness < 0.3:
            hollow = np.array([0.75 * broad, 0.8 * length, thick])
            ear.dent(np.array([0, 0, 0.75 * thick]), hollow, 0.25 * thick)
        builder.attach(ear.mesh(64), root + axis * length * 0.75, turn)


def _top(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    kind = builder.pick("none", "none", "horns", "tuft", "hat", "crest", "hair", "bow")
    up, turn = skull.turn[:, 1], skull.turn
    if kind == "horns":
        length, sway = size * builder.between(0.5, 1.6), builder.between(0, 60)
        state = builder.rng.bit_generator.state
        for side in (1, -1):
            builder.rng.bit_generator.state = state
            outward = turn @ towards(np.array([0.5, 0.9, 0.1]))
            points, radii, _ = builder.curl(
                np.zeros(3), turn.T @ outward, length, (0.17 * size, 0.03 * size), sway
            )
            root = skull.at(0.45 * side, 0.85, 0.1, 0.9)
            builder.limb([root + turn @ (p * [side, 1, 1]) for p in points], radii, attached=True)
    elif kind in ("tuft", "crest"):
        count = int(builder.rng.integers(2, 6))
        for n in range(count):
            back = 0.8 - 1.6 * n / count if kind == "crest" else builder.between(-0.3, 0.3)
            lean = aim(builder.bend(15), 90 - 40 * builder.chance(0.5) + builder.bend(15))
            points, radii, _ = builder.curl(
                skull.at(0, 0.9, back, 0.85),
                turn @ lean,
                size * builder.between(0.4, 0.9),
                (size * builder.between(0.1, 0.22), 0.03 * size),
                50,
            )
            builder.limb(points, radii, attached=builder.chance(0.5))
    elif kind == "hat":
        hat(builder, skull, size)
    elif kind == "hair":
        hair = ImplicitSurface()
        hair.ellipsoid(np.zeros(3), skull.radii * 1.13, 0)
        face = np.array([0, builder.between(-0.6, -0.3), 0.8]) * size
        hair.dent(face, skull.radii * [0.95, builder.between(0.8, 1), 0.9], 0.1 * size)
        for _ in range(int(builder.rng.integers(0, 5))):
            x, z = builder.between(-1, 1), builder.between(-1, 0.4)
            lock = builder.between(0.2, 0.4) * size
            hair.ellipsoid(np.array([x, 0.5, z]) * size * 0.8, np.full(3, lock), 0.1 * size)
        builder.attach(hair.mesh(72), skull.centre + 0.05 * size * up, turn)
    elif kind == "bow":
        at = skull.at(builder.between(-0.7, 0.7), 1, 0.2, 1.05)
        for side in (1, -1):
            wing = turn @ aim(0, 0, 20 * side)
            builder.attach_ball(
                at + wing[:, 0] * side * 0.3 * size, [0.3 * size, 0.18 * size, 0.12 * size], wing
            )
        builder.attach_ball(at, [0.12 * size] * 3, turn)


def hat(builder: CharacterBuilder, skull: Ball, size: float) -> None:
    """A cone, a bowler, a top hat, a cap with a bobble, or a bowl turned over."""
    turn = skull.turn @ aim(0, builder.bend(8), builder.bend(10))
    wide, thick = 0.95 * size, 0.08 * size
    base = skull.centre + skull.turn[:, 1] * size * builder.between(0.35, 0.65)
    tall, brim = builder.between(0.6, 1.8) * size, wide * builder.between(1.1, 1.9)
    droop = builder.between(-0.25, 0.2) * size
    profile = {
        "cone": [[0, tall], [0.45 * wide, 0.5 * tall], [wide, 0]],
        "bowler": [[0, 0.9 * wide], [0.6 * wide, 0.75 * wide], [wide, 0.2 * wide], [wide, 0]],
        "top": [[0, tall], [0.75 * wide, tall], [0.85 * wide, 0.9 * tall], [0.85 * wide, 0]],
    }[builder.pick("cone", "bowler", "top")]
    if builder.chance(0.6):
        profile += [[(brim + wide) / 2, 0.3 * droop], [brim, droop]]
    folds = {"folds": int(builder.rng.integers(3, 8)), "depth": builder.between(0, 0.12)}
    builder.attach_lathed(base, turn, profile, thick, **folds)
    if builder.chance(0.25):
        bobble = builder.between(0.12, 0.3) * size
        builder.attach_ball(base + turn[:, 1] * profile[0][1], [bobble] * 3)


def _upright(axis: Vector, front: Vector) -> Vector:
    """(3, 3) rotation that takes y to ``axis`` and z near ``front``."""
    y = _unit(axis)
    x = _unit(np.cross(y, front))
    return np.stack([x, y, np.cross(x, y)], axis=1)


def _unit(vector: Vector) -> Vector:
    unit: Vector = vector / max(float(np.linalg.norm(vector)), 1e-12)
    return unit
