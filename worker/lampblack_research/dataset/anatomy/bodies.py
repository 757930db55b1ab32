"""Birds, fish, snakes, caterpillars and blobs; z is where they look."""

from __future__ import annotations

import numpy as np

from .bipeds import hand
from .builder import CharacterBuilder, aim, towards
from .faces import MUZZLES, head
from .field import Vector


def bird(builder: CharacterBuilder) -> None:
    """Perched, walking or with its wings spread."""
    girth, long = builder.between(0.28, 0.5), builder.between(0.4, 0.7)
    stand = aim(0, builder.between(0, 65))
    trunk = builder.ball(np.zeros(3), [girth, builder.vary(girth, 0.1), long], stand)
    size = girth * builder.between(0.45, 0.9)
    reach = builder.between(0.05, 0.9) if builder.chance(0.4) else 0.05
    points, radii, _ = builder.curl(
        trunk.at(0, 0.3, 1, 0.7),
        aim(builder.bend(15), 60),
        reach + size,
        (0.7 * girth, 0.6 * size),
        40,
    )
    builder.limb(points, radii)
    look = aim(builder.bend(45), builder.bend(12), builder.bend(10))
    head(builder, points[-1] + look[:, 2] * 0.1 * size, size, look, "beak")
    spread = builder.chance(0.5)
    lift, sweep = builder.between(-20, 60), builder.between(-30, 40)
    for side in (1, -1):
        root = trunk.at(side, 0.35, 0.35, 0.9)
        if spread:
            for n in range(int(builder.rng.integers(3, 6))):
                out = stand @ aim(side * (75 + sweep + 14 * n), lift + builder.bend(4))
                feather = long * builder.between(0.75, 0.95) * (1.2 - 0.12 * n)
                broad = feather * 0.26
                builder.ball(root + out[:, 2] * feather * 0.9, [broad, 0.3 * broad, feather], out)
        else:
            fold = stand @ aim(180 - side * builder.between(5, 20), builder.between(-15, 10))
            wing = long * builder.between(0.65, 0.9)
            radii_of = [0.16 * girth, builder.between(0.5, 0.75) * girth, wing]
            if builder.chance(0.5):
                builder.attach_ball(trunk.at(side, 0.1, -0.1, 0.98), radii_of, fold)
            else:
                builder.ball(trunk.at(side, 0.1, -0.1, 0.98), radii_of, fold)
    fan, feather = int(builder.rng.integers(1, 5)), builder.between(0.2, 0.6)
    for n in range(fan):
        out = stand @ aim(180 + 18 * (n - (fan - 1) / 2), builder.between(0, 25))
        builder.ball(
            trunk.at(0, 0.15, -1, 0.85) + out[:, 2] * feather * 0.8, [0.1, 0.05, feather], out
        )
    leg, thick = builder.between(0.15, 0.8), builder.between(0.035, 0.07)
    for side in (1, -1):
        root = np.array([0.45 * girth * side, -0.5 * girth, 0])
        knee = root + aim(0, -90 + builder.bend(20))[:, 2] * leg * 0.6
        foot = knee + aim(0, -90 + builder.bend(15))[:, 2] * leg * 0.6
        builder.limb([root, knee, foot], [builder.between(1.5, 3) * thick, thick, 0.9 * thick])
        for toe in (-35, 0, 35, 180):
            end = foot + aim(toe, -5)[:, 2] * builder.between(0.12, 0.2)
            builder.limb([foot, end], [thick, 0.6 * thick])


def fish(builder: CharacterBuilder) -> None:
    """A fish or a whale, its body bent."""
    builder.softness = max(builder.softness, 0.6)  # scales overlap; rings would be a worm's
    long, tall = builder.between(0.8, 1.4), builder.between(0.22, 0.55)
    wide = tall * builder.between(0.45, 1.0)
    whale = builder.chance(0.35)
    points, _, turn = builder.curl(
        np.array([0, 0, 0.3 * long]), aim(180, builder.bend(8)), long, (1, 1), 35
    )
    girths = tall * np.interp(
        np.linspace(0, 1, len(points)), [0, 0.3, 0.7, 1], [0.85, 1, 0.5, 0.18]
    )
    front = builder.ball(points[0], [0.9 * wide, 0.9 * tall, 0.9 * tall])
    for point, girth in zip(points[1:], girths[1:], strict=True):
        builder.ball(point, [girth * wide / tall, girth, 1.5 * long / len(points)])
    builder.limb(points, list(girths * min(1.0, wide / tall) * 0.9))
    fin = tall * builder.between(0.6, 1.1)
    for side in (1, -1):
        out = turn @ (aim(0, 40 * side) if not whale else aim(45 * side, 0))
        flat = [0.16 * fin, 0.4 * fin, fin] if not whale else [0.4 * fin, 0.16 * fin, fin]
        builder.ball(points[-1] + out[:, 2] * fin * 0.7, flat, out)
        arm = aim(side * builder.between(100, 140), builder.between(-40, 10))
        root = points[2] + np.array([side * 0.8 * wide, -0.25 * tall, 0])
        builder.ball(root + arm[:, 2] * fin * 0.5, [0.4 * fin, 0.14 * fin, 0.8 * fin], arm)
    for place in (2, 4) if not whale else (4,):
        crest = aim(180, builder.between(25, 60))
        root = points[place] + np.array([0, 0.9 * girths[place], 0])
        builder.ball(root, [0.12 * tall, 0.4 * tall, builder.between(0.4, 0.8) * tall], crest)
    eye = builder.between(0.08, 0.2) * tall
    for side in (1, -1):
        builder.attach_ball(front.at(side, 0.35, 0.6, 0.98), [eye] * 3)
    mouth = front.at(0, -0.3, 1)
    gape = builder.between(0.1, 0.45) * tall
    if builder.chance(0.7):
        builder.body.dent(mouth, np.array([0.7 * wide, gape, 0.35 * tall]), 0.15 * gape)
    if builder.chance(0.4):
        for lip in (1, -1):
            builder.ball(
                mouth + np.array([0, lip * gape, 0]), [0.5 * wide, 0.09 * tall, 0.12 * tall]
            )


def snake(builder: CharacterBuilder) -> None:
    """A snake in coils, a worm, or a caterpillar of beads."""
    beads = builder.chance(0.45)
    count = 26
    girth = builder.between(0.15, 0.26) if beads else builder.between(0.09, 0.2)
    share = np.linspace(0, 1, count)
    if builder.chance(0.4) and not beads:
        angle = share * builder.between(1.5, 3) * 2 * np.pi
        ring = 0.75 - 0.45 * share
        points = np.stack(
            [ring * np.sin(angle), 0.5 * girth * angle / np.pi, ring * np.cos(angle)], 1
        )
        points[:, 1] *= builder.between(0.6, 1.6)
    else:
        sway, waves = builder.between(0, 0.5), builder.between(0.5, 2)
        raised = builder.between(0, 0.9)
        points = np.stack(
            [
                sway * np.sin(2 * np.pi * waves * share + builder.between(0, 6)),
                raised * np.clip(share - 0.6, 0, 1) ** 1.5 * 4 * 0.6
                + builder.between(0, 0.15) * np.sin(builder.between(5, 12) * share),
                (share - 0.5) * (2.0 if beads else 2.6) * (1 - 0.3 * raised * share),
            ],
            axis=1,
        )
    if beads:
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        along = np.concatenate([[0], np.cumsum(steps)])
        evenly = np.arange(0, along[-1], girth * builder.between(1.1, 1.6))
        points = np.stack([np.interp(evenly, along, axis) for axis in points.T], axis=1)
        for point in points[:-1]:
            bead = builder.vary(girth, 0.06)
            builder.body.ellipsoid(point, np.full(3, bead), builder.softness * 0.6 * bead)
            if builder.chance(0.8):
                for side in (1, -1):
                    foot = point + np.array([0.6 * side, -0.9, 0]) * girth
                    builder.ball(foot, [0.3 * girth, 0.35 * girth, 0.3 * girth])
    else:
        thick = girth * np.interp(share, [0, 0.35, 0.8, 1], [0.25, 1, 1, 0.75])
        builder.limb(list(points), list(thick))
        if builder.chance(0.4):
            builder.body.wave(_direction(builder) * builder.between(10, 25), 0, 0.06 * girth)
    size = girth * builder.between(1.15, 1.7)
    look = aim(builder.bend(30), builder.bend(12))
    head(
        builder,
        points[-1] + look[:, 2] * 0.4 * size,
        size,
        look,
        builder.pick("none", "short", "long"),
    )


def blob(builder: CharacterBuilder) -> None:
    """A lump, with or without a face: a drop, a ghost, a monster, a fruit."""
    radii = [builder.vary(0.6, 0.25) for _ in range(3)]
    trunk = builder.ball(np.zeros(3), radii)
    for _ in range(int(builder.rng.integers(0, 7))):
        lump = builder.between(0.15, 0.45)
        at = trunk.at(builder.bend(1), builder.bend(1), builder.bend(1) + 0.01)
        turn = aim(builder.bend(60), builder.bend(60), builder.bend(60))
        builder.ball(at, [builder.vary(lump), builder.vary(lump), builder.vary(lump)], turn)
    for side in (1, -1) if builder.chance(0.5) else ():
        arm = aim(side * builder.between(50, 100), builder.between(-60, 60))
        points, widths, _ = builder.curl(
            trunk.at(side, 0, 0.2, 0.8), arm, builder.between(0.3, 0.8), (0.14, 0.08), 60
        )
        builder.limb(points, widths)
        hand(builder, points[-1], towards(points[-1] - points[-2]), 0.12)
        if builder.chance(0.6):
            foot = np.array([0.3 * side, -radii[1] - 0.1, 0.15])
            builder.limb([foot * [1, 0.5, 0], foot], [0.15, 0.12])
            builder.ball(foot + np.array([0, 0, 0.1]), [0.15, 0.1, 0.22])
    if builder.chance(0.75):
        size = min(radii) * builder.between(0.7, 1)
        top = trunk.at(0, builder.between(0.1, 1), builder.between(0.3, 1), 0.7)
        head(builder, top, size, aim(builder.bend(20), builder.bend(10)), builder.pick(*MUZZLES))
    if builder.chance(0.15):
        ring = max(radii[0], radii[2])
        builder.attach_lathed(
            np.array([0, -0.2 * radii[1], 0]),
            aim(builder.bend(15), builder.bend(15)),
            [[0.2, -0.9], [ring * 0.9, -0.75], [1.2 * ring, 0.0], [1.25 * ring, 0.2]],
            0.09,
        )


def _direction(builder: CharacterBuilder) -> Vector:
    direction: Vector = towards(builder.rng.normal(0, 1, 3))[:, 2]
    return direction
