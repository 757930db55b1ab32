"""People, upright animals and seated toys; z is where they look."""

from __future__ import annotations

import numpy as np

from .builder import Ball, CharacterBuilder, aim, towards
from .faces import MUZZLES, head
from .field import Vector

# Sizes: leg, trunk, hips, shoulders, belly, neck, head, arm, thickness of limbs.
_BIPEDS = {
    "human": (1.0, 0.65, 0.16, 0.2, 0.17, 0.12, 0.17, 0.75, 0.075),
    "toddler": (0.45, 0.5, 0.17, 0.16, 0.21, 0.03, 0.27, 0.4, 0.08),
    "bear": (0.4, 0.8, 0.28, 0.25, 0.4, 0.02, 0.33, 0.55, 0.14),
    "penguin": (0.1, 0.8, 0.25, 0.2, 0.36, 0.0, 0.27, 0.5, 0.09),
    "mascot": (0.35, 0.45, 0.16, 0.15, 0.22, 0.02, 0.45, 0.42, 0.09),
    "mouse": (0.6, 0.4, 0.15, 0.12, 0.18, 0.06, 0.32, 0.55, 0.055),
    "giant": (0.7, 0.9, 0.22, 0.45, 0.34, 0.05, 0.2, 1.0, 0.15),
}


def biped(builder: CharacterBuilder, *, seated: bool = False) -> None:
    """Stands or sits upright; each arm and leg has its own pose."""
    vary = builder.vary
    preset = _BIPEDS[builder.pick(*_BIPEDS)]
    leg, trunk, hip, shoulder, belly, neck, size, arm, thick = (vary(v, 0.17) for v in preset)
    lean = aim(builder.bend(15), 90 + builder.bend(10), 0)
    up = lean[:, 2]
    frame = np.stack([np.cross(up, [0, 0, 1]), up, [0, 0, 1]], axis=1)
    frame[:, 0] = np.cross(frame[:, 1], frame[:, 2])
    frame /= np.linalg.norm(frame, axis=0)
    frame[:, 2] = np.cross(frame[:, 0], frame[:, 1])
    hips, chest = np.zeros(3), up * trunk * 0.75
    round_hip = hip * builder.between(0.85, 1.1)
    builder.ball(hips, [1.15 * round_hip, round_hip, 0.9 * round_hip], frame)
    builder.limb([hips, chest], [0.95 * round_hip, 0.9 * shoulder])
    builder.ball(chest, [1.25 * shoulder, vary(0.9 * shoulder), 0.8 * shoulder], frame)
    middle = hips + up * trunk * builder.between(0.2, 0.45) + [0, 0, 0.15 * belly]
    tummy = Ball(middle, np.array([vary(belly, 0.1), 0.5 * trunk, vary(0.9 * belly, 0.1)]), frame)
    builder.ball(tummy.centre, list(tummy.radii), frame)
    for side in (1, -1):
        root = hips + frame @ np.array([side * 0.8 * hip, -0.3 * hip, 0])
        _stand(builder, root, side, leg, thick * builder.between(1.15, 1.4), seated)
        joint = chest + frame @ np.array([side * 1.15 * shoulder, 0.25 * shoulder, 0])
        _arm(builder, joint, frame, side, arm, thick)
    top = chest + up * (0.8 * shoulder + neck)
    look = aim(builder.bend(30), builder.bend(12), builder.bend(10))
    builder.limb([chest, top], [0.6 * shoulder, min(0.55 * size, 1.2 * thick + 0.2 * size)])
    head(builder, top + look[:, 1] * 0.75 * size, size, look, builder.pick(*MUZZLES))
    if builder.chance(0.25):
        _tail(builder, hips + np.array([0, 0, -0.6 * hip]), hip)
    _clothes(builder, tummy, hips, chest, shoulder, frame)


def _stand(
    builder: CharacterBuilder, root: Vector, side: int, leg: float, thick: float, seated: bool
) -> None:
    out = side * builder.between(2, 25)
    raised = builder.between(-10, 10) + 85 if seated else builder.bend(22)
    bent = builder.between(0, 50) if not seated else builder.between(0, 70)
    knee = root + aim(out, raised - 90)[:, 2] * 0.5 * leg
    foot = knee + aim(out, raised - bent - 90)[:, 2] * 0.5 * leg
    knee[0] += 0.08 * leg * side
    foot[0] += 0.1 * leg * side
    slim = builder.between(0.7, 1.0) * thick
    builder.limb([root, knee, foot], [1.35 * thick, thick, slim])
    if builder.chance(0.5):
        builder.ball((0.35 * knee + 0.65 * foot) + [0, 0, -0.3 * slim], [slim, 1.8 * slim, slim])
    shoe = builder.vary(1.35 * slim, 0.2)
    turn = aim(out, 70 if seated else builder.between(-5, 10))
    at = foot + turn @ np.array([0, -0.2, 0.55]) * shoe
    radii = [0.9 * shoe, 0.65 * shoe, 1.5 * shoe]
    if builder.softness < 0.3:
        builder.attach_ball(at, radii, turn)
    else:
        builder.ball(at, radii, turn)


def _arm(
    builder: CharacterBuilder, joint: Vector, frame: Vector, side: int, arm: float, thick: float
) -> None:
    raised = builder.between(-80, 60) if builder.chance(0.6) else builder.between(-80, -60)
    forward = builder.bend(35)
    upper = frame @ (aim(side * (90 - forward), raised)[:, 2])
    bend = builder.between(0, 90)
    lower = (
        frame
        @ aim(side * (90 - forward - bend * builder.between(0.3, 1)), raised + bend * 0.5)[:, 2]
    )
    elbow = joint + upper * 0.5 * arm
    wrist = elbow + lower * 0.5 * arm
    if builder.chance(0.15):  # a flipper or a sleeve
        turn = towards(wrist - joint)
        wide = builder.between(1.2, 2.2) * thick
        builder.ball((joint + wrist) / 2, [0.5 * wide, wide, 0.55 * arm], turn)
        return
    slim = builder.between(0.65, 1.0) * thick
    builder.limb([joint, elbow, wrist], [builder.vary(1.3 * thick, 0.1), thick, slim])
    hand(builder, wrist, towards(lower) @ aim(0, 0, builder.between(0, 360)), 1.25 * slim)


def hand(builder: CharacterBuilder, wrist: Vector, turn: Vector, size: float) -> None:
    """A ball, a mitten with a thumb, or fingers; it points along the z of ``turn``."""
    palm = wrist + turn[:, 2] * 0.7 * size
    kind = builder.pick("ball", "mitten", "fingers", "fingers")
    if kind == "ball":
        builder.ball(palm, [1.1 * size] * 3)
        return
    builder.ball(palm, [0.55 * size, size, 1.1 * size], turn)
    thumb = palm + turn @ np.array([0, 0.6, -0.2]) * size
    builder.limb([thumb, thumb + turn @ np.array([0.3, 0.8, 0.7]) * size], [0.4 * size, 0.3 * size])
    if kind == "fingers":
        count, curl = int(builder.rng.integers(3, 5)), builder.between(0, 70)
        for n in range(count):
            spread = (n - (count - 1) / 2) / count
            start = palm + turn @ np.array([0, -1.4 * spread, 0.7]) * size
            out = turn @ aim(0, -40 * spread) @ aim(curl, 0)
            end = start + out[:, 2] * size * builder.between(1.0, 1.4)
            builder.limb([start, end], [0.36 * size, 0.27 * size])


def _tail(builder: CharacterBuilder, root: Vector, size: float) -> None:
    points, radii, _ = builder.curl(
        root,
        aim(180 + builder.bend(30), builder.between(-40, 50)),
        builder.between(0.3, 1.0),
        (size * builder.between(0.2, 0.6), 0.06),
        80,
    )
    builder.limb(points, radii)


def _clothes(
    builder: CharacterBuilder,
    tummy: Ball,
    hips: Vector,
    chest: Vector,
    shoulder: float,
    frame: Vector,
) -> None:
    """Add a skirt, a cape, a belt or scarf, and buttons, each by chance."""
    wide = float(max(tummy.radii[0], 1.1 * shoulder))
    if builder.chance(0.22):
        long, flare = builder.between(0.2, 0.7), builder.between(1.1, 2.2)
        waist = tummy.centre - hips
        builder.attach_lathed(
            hips + 0.8 * waist,
            frame,
            [
                [0.85 * wide, 0.1],
                [1.1 * wide, 0],
                [(0.5 + 0.6 * flare) * wide, -0.5 * long],
                [flare * wide, -long],
            ],
            0.03,
            folds=int(builder.rng.integers(4, 14)),
            depth=builder.between(0, 0.14),
            phase=builder.between(0, 6),
        )
    if builder.chance(0.12):
        long, flare = builder.between(0.5, 1.1), builder.between(1.3, 2.2)
        builder.attach_lathed(
            chest + 0.5 * shoulder * frame[:, 1],
            frame,
            [[0.8 * shoulder, 0.1], [1.6 * shoulder, -0.1], [flare * wide, -long]],
            0.03,
            folds=int(builder.rng.integers(5, 14)),
            depth=builder.between(0.03, 0.12),
            phase=builder.between(0, 6),
            arc=builder.between(150, 260),
        )
    if builder.chance(0.2):
        for _ in range(int(builder.rng.integers(1, 3))):
            ring = builder.between(0.75, 1.0) * 0.9 * shoulder
            height = builder.between(0.7, 1.0) * shoulder
            tube = builder.between(0.2, 0.4) * shoulder
            builder.attach_lathed(
                chest + frame[:, 1] * height,
                frame @ aim(builder.bend(30), builder.bend(12)),
                [[ring, 0.5 * tube], [ring, -0.5 * tube]],
                tube,
            )
    if builder.chance(0.25):
        button = builder.between(0.06, 0.16) * wide
        for up in (-0.35, 0.0, 0.35):
            turn = tummy.facing(0, up, 1)
            builder.attach_ball(tummy.at(0, up, 1, 1.03), [button, button, 0.5 * button], turn)
