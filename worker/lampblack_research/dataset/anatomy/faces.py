"""Heads: muzzles, eyes, ears, horns, mouths, hair and hats."""

from __future__ import annotations

import numpy as np

from .clay import Clay
from .field import Vector
from .figure import Ball, Figure, aim, towards

MUZZLES = ("none", "none", "none", "short", "long", "pig", "beak", "trunk")
"""Of whom any may have any, and most none."""


def head(figure: Figure, centre: Vector, size: float, turn: Vector, muzzle: str) -> Ball:
    """A head of radius ``size`` that looks along the z of ``turn``; ``muzzle`` is ``none``,
    ``short``, ``long``, ``trunk``, ``pig`` or ``beak``."""
    skull = figure.ball(
        centre, [figure.vary(size, 0.12), figure.vary(size, 0.12), figure.vary(size, 0.1)], turn
    )
    if figure.some(0.3):
        cheek = size * figure.between(0.35, 0.5)
        for side in (1, -1):
            figure.ball(skull.at(0.55 * side, -0.35, 0.6, 0.8), [cheek, cheek, cheek])
    _SHAPES[muzzle](figure, skull, size)
    _eyes(figure, skull, size)
    ears = figure.pick("none", "ball", "cone", "flop", "long", "hollow", "hollow")
    if muzzle != "beak" and ears != "none":
        _ears(figure, skull, size, ears)
    _top(figure, skull, size)
    return skull


def _bare(figure: Figure, skull: Ball, size: float) -> None:
    if figure.some(0.6):
        nose = figure.vary(0.14 * size, 0.4)
        at = skull.at(0, -0.1, 1)
        if figure.some(0.5):
            figure.ball(at, [nose, nose, nose * 1.2], skull.turn)
        else:
            figure.lay_ball(at, [nose * 1.3, nose, nose], skull.turn)
    _mouth(figure, skull.at(0, -0.5, 0.9), skull.turn, size * figure.between(0.25, 0.55))


def _mouth(figure: Figure, at: Vector, turn: Vector, width: float) -> None:
    kind = figure.pick("none", "smile", "open", "lips")
    if kind == "open":
        radii = np.array([width, width * figure.between(0.35, 1), width * 0.9])
        figure.body.dent(at, radii, 0.15 * width, turn)
        if figure.some(0.5):
            tongue = at - turn[:, 1] * radii[1] * 0.6 - turn[:, 2] * width * 0.1
            figure.lay_ball(tongue, [width * 0.6, width * 0.2, width * 0.6], turn)
    elif kind == "smile":
        for side in (-2, -1, 0, 1, 2):
            x, up = side * width * 0.4, (side / 2) ** 2 * width * 0.4
            dent = at + turn @ np.array([x, up, -abs(side) * width * 0.08])
            slant = turn @ aim(0, 0, side * 18)
            figure.body.dent(dent, np.array([0.32, 0.1, 0.3]) * width, 0.08 * width, slant)
    elif kind == "lips":
        figure.lay_ball(at, [width * 0.6, width * 0.14, width * 0.2], turn)
        figure.lay_ball(
            at - turn[:, 1] * width * 0.22, [width * 0.5, width * 0.16, width * 0.2], turn
        )


def _short(figure: Figure, skull: Ball, size: float) -> None:
    wide = figure.vary(0.5 * size)
    high, out = figure.vary(0.36 * size), figure.vary(0.45 * size)
    at = skull.at(0, -0.35, 0.9, 0.9)
    snout = figure.ball(at, [wide, high, out], skull.turn)
    nose = figure.vary(0.15 * size, 0.3)
    figure.lay_ball(snout.at(0, 0.6, 1), [nose * 1.3, nose, nose], skull.turn)
    _mouth(figure, snout.at(0, -0.4, 1), skull.turn, 0.6 * wide)


def _long(figure: Figure, skull: Ball, size: float) -> None:
    turn = skull.turn @ aim(0, figure.between(-25, 0))
    length, tip = size * figure.between(0.8, 1.8), size * figure.between(0.2, 0.42)
    start = skull.at(0, -0.3, 0.8, 0.5)
    end = start + turn[:, 2] * length
    figure.limb([start, end], [figure.vary(0.55 * size, 0.1), tip])
    if figure.some(0.5):  # a jaw, open
        jaw = turn @ aim(0, figure.between(-40, -10))
        under = start - turn[:, 1] * 0.2 * size
        figure.limb([under, under + jaw[:, 2] * length * 0.9], [0.35 * size, 0.6 * tip])
    nose = figure.vary(0.6 * tip, 0.2)
    at = end + turn @ np.array([0, 0.6, 0.75]) * tip
    if figure.some(0.6):
        figure.lay_ball(at, [nose * 1.2, nose, nose], turn)
    else:
        for side in (1, -1):
            nostril = end + turn @ np.array([0.5 * side, 0.5, 0.75]) * tip
            figure.body.dent(nostril, np.full(3, 0.22 * tip), 0.1 * tip)


def _trunk(figure: Figure, skull: Ball, size: float) -> None:
    turn = skull.turn @ aim(0, figure.between(-80, -30))
    points, radii, _ = figure.curl(
        skull.at(0, -0.2, 1, 0.75),
        turn,
        size * figure.between(1.5, 3.2),
        (0.42 * size, 0.17 * size),
        70,
    )
    figure.limb(points, radii)
    figure.body.dent(
        points[-1] + 0.15 * size * _unit(points[-1] - points[-2]), np.full(3, 0.1 * size), 0.02
    )
    if figure.some(0.6):
        for side in (1, -1):
            tusk = skull.turn @ aim(15 * side, figure.between(-40, 10))
            start = skull.at(0.45 * side, -0.5, 0.8, 0.8)
            tusks, widths, _ = figure.curl(start, tusk, size * 1.2, (0.12 * size, 0.03 * size), 0)
            figure.limb(tusks, widths, laid=True)


def _pig(figure: Figure, skull: Ball, size: float) -> None:
    disc = figure.vary(0.4 * size)
    start = skull.at(0, -0.2, 1, 0.6)
    end = start + skull.turn[:, 2] * size * figure.between(0.6, 0.9)
    figure.limb([start, end], [disc * 1.1, disc * 0.9])
    flat = end + skull.turn[:, 2] * disc * 0.6
    figure.lay_ball(flat, [disc * 1.1, disc * 0.95, disc * 0.5], skull.turn)
    _mouth(figure, skull.at(0, -0.75, 0.8), skull.turn, 0.4 * size)


def _beak(figure: Figure, skull: Ball, size: float) -> None:
    length, high = size * figure.between(0.5, 1.8), size * figure.between(0.2, 0.4)
    droop, gape = figure.between(-15, 5), figure.some(0.4) * figure.between(10, 40)
    wide = figure.between(0.7, 1.6)
    for upper in (1, -1):
        turn = skull.turn @ aim(0, droop + upper * gape / 2)
        clay = Clay()
        clay.cone(np.zeros(3), high, np.array([0, -0.1 * high, length]), 0.15 * high, 0)
        start = skull.at(0, -0.1 - 0.25 * (upper < 0), 1, 0.8)
        figure.lay(clay.mesh(56), start, turn @ np.diag([wide, 0.8, 1 if upper > 0 else 0.85]))


_SHAPES = {
    "none": _bare,
    "short": _short,
    "long": _long,
    "trunk": _trunk,
    "pig": _pig,
    "beak": _beak,
}


def _eyes(figure: Figure, skull: Ball, size: float) -> None:
    wide, up = figure.between(0.3, 0.7), figure.between(0.15, 0.5)
    radius = figure.vary(0.17 * size, 0.45)
    kind = figure.pick("laid", "laid", "socket", "lid", "blended")
    for side in (1, -1):
        at = skull.at(wide * side, up, 0.85, 0.97)
        turn = skull.facing(wide * side, up, 0.85)
        if kind == "socket":
            figure.body.dent(at, radius * np.array([1.6, 1.3, 1.1]), 0.4 * radius, turn)
            at = at - turn[:, 2] * 0.5 * radius
        if kind == "blended":
            figure.ball(at, [radius, radius, radius], turn)
            continue
        figure.lay_ball(at, [radius, figure.between(1, 1.4) * radius, 0.8 * radius], turn)
        if kind == "lid":
            lid = Clay()
            lid.ellipsoid(np.zeros(3), np.full(3, 1.25 * radius), 0)
            lid.dent(np.array([0, -1.3, 0.9]) * radius, np.full(3, 1.6 * radius), 0.1 * radius)
            figure.lay(lid.mesh(36), at, turn)


def _ears(figure: Figure, skull: Ball, size: float, kind: str) -> None:
    wide, up, back = figure.between(0.5, 1.1), figure.between(0.4, 1.1), figure.between(-0.4, 0.2)
    if kind == "flop":
        wide, up = 1.0, 0.6
    length, broad = figure.vary(0.55 * size, 0.3), figure.vary(0.32 * size, 0.25)
    if kind == "long":
        length, broad, wide, up = 1.5 * length, 0.7 * broad, 0.45, 1.0
    swing, tilt = figure.between(10, 60), figure.bend(25)
    for side in (1, -1):
        root = skull.at(wide * side, up, back, 0.9)
        lean = swing if kind in ("cone", "long", "hollow", "ball") else 140
        lean = lean + figure.bend(12)
        out = np.array([np.sin(np.radians(lean)) * side, np.cos(np.radians(lean)), 0.0])
        axis = skull.turn @ aim(0, tilt) @ out
        turn = _upright(axis, skull.turn[:, 2])
        if kind == "ball":
            figure.lay_ball(root + axis * broad, [1.2 * broad, 1.2 * broad, 0.5 * broad], turn)
            continue
        if kind == "cone":
            figure.limb(
                [root, root + axis * length * 1.4],
                [broad, 0.15 * broad],
                laid=figure.softness < 0.4,
            )
            continue
        ear = Clay()
        thick = 0.4 * broad
        ear.ellipsoid(np.zeros(3), np.array([broad, length, thick]), 0)
        if kind != "flop" or figure.softness < 0.3:
            hollow = np.array([0.75 * broad, 0.8 * length, thick])
            ear.dent(np.array([0, 0, 0.75 * thick]), hollow, 0.25 * thick)
        figure.lay(ear.mesh(64), root + axis * length * 0.75, turn)


def _top(figure: Figure, skull: Ball, size: float) -> None:
    kind = figure.pick("none", "none", "horns", "tuft", "hat", "crest", "hair", "bow")
    up, turn = skull.turn[:, 1], skull.turn
    if kind == "horns":
        length, sway = size * figure.between(0.5, 1.6), figure.between(0, 60)
        state = figure.rng.bit_generator.state
        for side in (1, -1):
            figure.rng.bit_generator.state = state
            outward = turn @ towards(np.array([0.5, 0.9, 0.1]))
            points, radii, _ = figure.curl(
                np.zeros(3), turn.T @ outward, length, (0.17 * size, 0.03 * size), sway
            )
            root = skull.at(0.45 * side, 0.85, 0.1, 0.9)
            figure.limb([root + turn @ (p * [side, 1, 1]) for p in points], radii, laid=True)
    elif kind in ("tuft", "crest"):
        count = int(figure.rng.integers(2, 6))
        for n in range(count):
            back = 0.8 - 1.6 * n / count if kind == "crest" else figure.between(-0.3, 0.3)
            lean = aim(figure.bend(15), 90 - 40 * figure.some(0.5) + figure.bend(15))
            points, radii, _ = figure.curl(
                skull.at(0, 0.9, back, 0.85),
                turn @ lean,
                size * figure.between(0.4, 0.9),
                (size * figure.between(0.1, 0.22), 0.03 * size),
                50,
            )
            figure.limb(points, radii, laid=figure.some(0.5))
    elif kind == "hat":
        hat(figure, skull, size)
    elif kind == "hair":
        hair = Clay()
        hair.ellipsoid(np.zeros(3), skull.radii * 1.13, 0)
        face = np.array([0, figure.between(-0.6, -0.3), 0.8]) * size
        hair.dent(face, skull.radii * [0.95, figure.between(0.8, 1), 0.9], 0.1 * size)
        for _ in range(int(figure.rng.integers(0, 5))):
            x, z = figure.between(-1, 1), figure.between(-1, 0.4)
            lock = figure.between(0.2, 0.4) * size
            hair.ellipsoid(np.array([x, 0.5, z]) * size * 0.8, np.full(3, lock), 0.1 * size)
        figure.lay(hair.mesh(72), skull.centre + 0.05 * size * up, turn)
    elif kind == "bow":
        at = skull.at(figure.between(-0.7, 0.7), 1, 0.2, 1.05)
        for side in (1, -1):
            wing = turn @ aim(0, 0, 20 * side)
            figure.lay_ball(
                at + wing[:, 0] * side * 0.3 * size, [0.3 * size, 0.18 * size, 0.12 * size], wing
            )
        figure.lay_ball(at, [0.12 * size] * 3, turn)


def hat(figure: Figure, skull: Ball, size: float) -> None:
    """A cone, a bowler, a top hat, a cap with a bobble, or a bowl turned over."""
    turn = skull.turn @ aim(0, figure.bend(8), figure.bend(10))
    wide, thick = 0.95 * size, 0.08 * size
    base = skull.centre + skull.turn[:, 1] * size * figure.between(0.35, 0.65)
    tall, brim = figure.between(0.6, 1.8) * size, wide * figure.between(1.1, 1.9)
    droop = figure.between(-0.25, 0.2) * size
    profile = {
        "cone": [[0, tall], [0.45 * wide, 0.5 * tall], [wide, 0]],
        "bowler": [[0, 0.9 * wide], [0.6 * wide, 0.75 * wide], [wide, 0.2 * wide], [wide, 0]],
        "top": [[0, tall], [0.75 * wide, tall], [0.85 * wide, 0.9 * tall], [0.85 * wide, 0]],
    }[figure.pick("cone", "bowler", "top")]
    if figure.some(0.6):
        profile += [[(brim + wide) / 2, 0.3 * droop], [brim, droop]]
    folds = {"folds": int(figure.rng.integers(3, 8)), "depth": figure.between(0, 0.12)}
    figure.lay_turned(base, turn, profile, thick, **folds)
    if figure.some(0.25):
        bobble = figure.between(0.12, 0.3) * size
        figure.lay_ball(base + turn[:, 1] * profile[0][1], [bobble] * 3)


def _upright(axis: Vector, front: Vector) -> Vector:
    """(3, 3) rotation that takes y to ``axis`` and z near ``front``."""
    y = _unit(axis)
    x = _unit(np.cross(y, front))
    return np.stack([x, y, np.cross(x, y)], axis=1)


def _unit(vector: Vector) -> Vector:
    unit: Vector = vector / max(float(np.linalg.norm(vector)), 1e-12)
    return unit
