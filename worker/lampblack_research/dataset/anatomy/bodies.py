"""Birds, fish, snakes, caterpillars and blobs; z is where they look."""

from __future__ import annotations

import numpy as np

from .bipeds import hand
from .faces import MUZZLES, head
from .field import Vector
from .figure import Figure, aim, towards


def bird(figure: Figure) -> None:
    """Perched, walking or with its wings spread."""
    girth, long = figure.between(0.28, 0.5), figure.between(0.4, 0.7)
    stand = aim(0, figure.between(0, 65))
    trunk = figure.ball(np.zeros(3), [girth, figure.vary(girth, 0.1), long], stand)
    size = girth * figure.between(0.45, 0.9)
    reach = figure.between(0.05, 0.9) if figure.some(0.4) else 0.05
    points, radii, _ = figure.curl(
        trunk.at(0, 0.3, 1, 0.7),
        aim(figure.bend(15), 60),
        reach + size,
        (0.7 * girth, 0.6 * size),
        40,
    )
    figure.limb(points, radii)
    look = aim(figure.bend(45), figure.bend(12), figure.bend(10))
    head(figure, points[-1] + look[:, 2] * 0.1 * size, size, look, "beak")
    spread = figure.some(0.5)
    lift, sweep = figure.between(-20, 60), figure.between(-30, 40)
    for side in (1, -1):
        root = trunk.at(side, 0.35, 0.35, 0.9)
        if spread:
            for n in range(int(figure.rng.integers(3, 6))):
                out = stand @ aim(side * (75 + sweep + 14 * n), lift + figure.bend(4))
                feather = long * figure.between(0.75, 0.95) * (1.2 - 0.12 * n)
                broad = feather * 0.26
                figure.ball(root + out[:, 2] * feather * 0.9, [broad, 0.3 * broad, feather], out)
        else:
            fold = stand @ aim(180 - side * figure.between(5, 20), figure.between(-15, 10))
            wing = long * figure.between(0.65, 0.9)
            radii_of = [0.16 * girth, figure.between(0.5, 0.75) * girth, wing]
            if figure.some(0.5):
                figure.lay_ball(trunk.at(side, 0.1, -0.1, 0.98), radii_of, fold)
            else:
                figure.ball(trunk.at(side, 0.1, -0.1, 0.98), radii_of, fold)
    fan, feather = int(figure.rng.integers(1, 5)), figure.between(0.2, 0.6)
    for n in range(fan):
        out = stand @ aim(180 + 18 * (n - (fan - 1) / 2), figure.between(0, 25))
        figure.ball(
            trunk.at(0, 0.15, -1, 0.85) + out[:, 2] * feather * 0.8, [0.1, 0.05, feather], out
        )
    leg, thick = figure.between(0.15, 0.8), figure.between(0.035, 0.07)
    for side in (1, -1):
        root = np.array([0.45 * girth * side, -0.5 * girth, 0])
        knee = root + aim(0, -90 + figure.bend(20))[:, 2] * leg * 0.6
        foot = knee + aim(0, -90 + figure.bend(15))[:, 2] * leg * 0.6
        figure.limb([root, knee, foot], [figure.between(1.5, 3) * thick, thick, 0.9 * thick])
        for toe in (-35, 0, 35, 180):
            end = foot + aim(toe, -5)[:, 2] * figure.between(0.12, 0.2)
            figure.limb([foot, end], [thick, 0.6 * thick])


def fish(figure: Figure) -> None:
    """A fish or a whale, its body bent."""
    figure.softness = max(figure.softness, 0.6)  # scales overlap; rings would be a worm's
    long, tall = figure.between(0.8, 1.4), figure.between(0.22, 0.55)
    wide = tall * figure.between(0.45, 1.0)
    whale = figure.some(0.35)
    points, _, turn = figure.curl(
        np.array([0, 0, 0.3 * long]), aim(180, figure.bend(8)), long, (1, 1), 35
    )
    girths = tall * np.interp(
        np.linspace(0, 1, len(points)), [0, 0.3, 0.7, 1], [0.85, 1, 0.5, 0.18]
    )
    front = figure.ball(points[0], [0.9 * wide, 0.9 * tall, 0.9 * tall])
    for point, girth in zip(points[1:], girths[1:], strict=True):
        figure.ball(point, [girth * wide / tall, girth, 1.5 * long / len(points)])
    figure.limb(points, list(girths * min(1.0, wide / tall) * 0.9))
    fin = tall * figure.between(0.6, 1.1)
    for side in (1, -1):
        out = turn @ (aim(0, 40 * side) if not whale else aim(45 * side, 0))
        flat = [0.16 * fin, 0.4 * fin, fin] if not whale else [0.4 * fin, 0.16 * fin, fin]
        figure.ball(points[-1] + out[:, 2] * fin * 0.7, flat, out)
        arm = aim(side * figure.between(100, 140), figure.between(-40, 10))
        root = points[2] + np.array([side * 0.8 * wide, -0.25 * tall, 0])
        figure.ball(root + arm[:, 2] * fin * 0.5, [0.4 * fin, 0.14 * fin, 0.8 * fin], arm)
    for place in (2, 4) if not whale else (4,):
        crest = aim(180, figure.between(25, 60))
        root = points[place] + np.array([0, 0.9 * girths[place], 0])
        figure.ball(root, [0.12 * tall, 0.4 * tall, figure.between(0.4, 0.8) * tall], crest)
    eye = figure.between(0.08, 0.2) * tall
    for side in (1, -1):
        figure.lay_ball(front.at(side, 0.35, 0.6, 0.98), [eye] * 3)
    mouth = front.at(0, -0.3, 1)
    gape = figure.between(0.1, 0.45) * tall
    if figure.some(0.7):
        figure.body.dent(mouth, np.array([0.7 * wide, gape, 0.35 * tall]), 0.15 * gape)
    if figure.some(0.4):
        for lip in (1, -1):
            figure.ball(
                mouth + np.array([0, lip * gape, 0]), [0.5 * wide, 0.09 * tall, 0.12 * tall]
            )


def snake(figure: Figure) -> None:
    """A snake in coils, a worm, or a caterpillar of beads."""
    beads = figure.some(0.45)
    count = 26
    girth = figure.between(0.15, 0.26) if beads else figure.between(0.09, 0.2)
    share = np.linspace(0, 1, count)
    if figure.some(0.4) and not beads:
        angle = share * figure.between(1.5, 3) * 2 * np.pi
        ring = 0.75 - 0.45 * share
        points = np.stack(
            [ring * np.sin(angle), 0.5 * girth * angle / np.pi, ring * np.cos(angle)], 1
        )
        points[:, 1] *= figure.between(0.6, 1.6)
    else:
        sway, waves = figure.between(0, 0.5), figure.between(0.5, 2)
        raised = figure.between(0, 0.9)
        points = np.stack(
            [
                sway * np.sin(2 * np.pi * waves * share + figure.between(0, 6)),
                raised * np.clip(share - 0.6, 0, 1) ** 1.5 * 4 * 0.6
                + figure.between(0, 0.15) * np.sin(figure.between(5, 12) * share),
                (share - 0.5) * (2.0 if beads else 2.6) * (1 - 0.3 * raised * share),
            ],
            axis=1,
        )
    if beads:
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        along = np.concatenate([[0], np.cumsum(steps)])
        evenly = np.arange(0, along[-1], girth * figure.between(1.1, 1.6))
        points = np.stack([np.interp(evenly, along, axis) for axis in points.T], axis=1)
        for point in points[:-1]:
            bead = figure.vary(girth, 0.06)
            figure.body.ellipsoid(point, np.full(3, bead), figure.softness * 0.6 * bead)
            if figure.some(0.8):
                for side in (1, -1):
                    foot = point + np.array([0.6 * side, -0.9, 0]) * girth
                    figure.ball(foot, [0.3 * girth, 0.35 * girth, 0.3 * girth])
    else:
        thick = girth * np.interp(share, [0, 0.35, 0.8, 1], [0.25, 1, 1, 0.75])
        figure.limb(list(points), list(thick))
        if figure.some(0.4):
            figure.body.wave(_direction(figure) * figure.between(10, 25), 0, 0.06 * girth)
    size = girth * figure.between(1.15, 1.7)
    look = aim(figure.bend(30), figure.bend(12))
    head(
        figure,
        points[-1] + look[:, 2] * 0.4 * size,
        size,
        look,
        figure.pick("none", "short", "long"),
    )


def blob(figure: Figure) -> None:
    """A lump with a face: a drop, a ghost, a monster, a fruit; or without."""
    radii = [figure.vary(0.6, 0.25) for _ in range(3)]
    trunk = figure.ball(np.zeros(3), radii)
    for _ in range(int(figure.rng.integers(0, 7))):
        lump = figure.between(0.15, 0.45)
        at = trunk.at(figure.bend(1), figure.bend(1), figure.bend(1) + 0.01)
        turn = aim(figure.bend(60), figure.bend(60), figure.bend(60))
        figure.ball(at, [figure.vary(lump), figure.vary(lump), figure.vary(lump)], turn)
    for side in (1, -1) if figure.some(0.5) else ():
        arm = aim(side * figure.between(50, 100), figure.between(-60, 60))
        points, widths, _ = figure.curl(
            trunk.at(side, 0, 0.2, 0.8), arm, figure.between(0.3, 0.8), (0.14, 0.08), 60
        )
        figure.limb(points, widths)
        hand(figure, points[-1], towards(points[-1] - points[-2]), 0.12)
        if figure.some(0.6):
            foot = np.array([0.3 * side, -radii[1] - 0.1, 0.15])
            figure.limb([foot * [1, 0.5, 0], foot], [0.15, 0.12])
            figure.ball(foot + np.array([0, 0, 0.1]), [0.15, 0.1, 0.22])
    if figure.some(0.75):
        size = min(radii) * figure.between(0.7, 1)
        top = trunk.at(0, figure.between(0.1, 1), figure.between(0.3, 1), 0.7)
        head(figure, top, size, aim(figure.bend(20), figure.bend(10)), figure.pick(*MUZZLES))
    if figure.some(0.15):
        ring = max(radii[0], radii[2])
        figure.lay_turned(
            np.array([0, -0.2 * radii[1], 0]),
            aim(figure.bend(15), figure.bend(15)),
            [[0.2, -0.9], [ring * 0.9, -0.75], [1.2 * ring, 0.0], [1.25 * ring, 0.2]],
            0.09,
        )


def _direction(figure: Figure) -> Vector:
    direction: Vector = towards(figure.rng.normal(0, 1, 3))[:, 2]
    return direction
