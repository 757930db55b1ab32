"""Animals on four legs; z is where they walk."""

from __future__ import annotations

import numpy as np

from .builder import Ball, CharacterBuilder, aim
from .faces import head
from .field import Vector

# length and girth of the trunk; leg and its thickness; neck, its rise in degrees; head, tail.
_QUADRUPEDS = {
    "dog": (0.9, 0.28, 0.6, 0.1, 0.3, 45, 0.27, 0.6, "long"),
    "cat": (0.8, 0.25, 0.5, 0.08, 0.2, 50, 0.28, 0.8, "short"),
    "horse": (1.1, 0.34, 1.0, 0.11, 0.7, 55, 0.26, 0.8, "long"),
    "bear": (1.0, 0.46, 0.45, 0.18, 0.15, 20, 0.36, 0.1, "short"),
    "elephant": (1.1, 0.55, 0.75, 0.19, 0.1, 25, 0.45, 0.6, "trunk"),
    "giraffe": (0.8, 0.34, 1.2, 0.1, 1.4, 70, 0.25, 0.6, "long"),
    "lizard": (1.1, 0.22, 0.3, 0.08, 0.15, 10, 0.24, 1.4, "long"),
    "dinosaur": (1.2, 0.48, 0.6, 0.17, 1.3, 50, 0.22, 1.6, "short"),
    "pig": (0.9, 0.43, 0.3, 0.11, 0.05, 10, 0.38, 0.3, "pig"),
    "cub": (0.5, 0.3, 0.3, 0.12, 0.05, 50, 0.42, 0.3, "none"),
}


def quadruped(builder: CharacterBuilder) -> None:
    """Walks on four legs, the head turned and the tail bent."""
    vary = builder.vary
    preset = _QUADRUPEDS[builder.pick(*_QUADRUPEDS)]
    length, girth, leg, thick, neck, rise, size, tail = (
        vary(value, 0.15) for value in preset[:8] if isinstance(value, (int, float))
    )
    muzzle = str(preset[8]) if builder.chance(0.8) else builder.pick("none", "short", "long", "pig")
    sprawl = (
        builder.between(35, 70) if leg < 0.33 and builder.chance(0.6) else builder.between(0, 8)
    )
    twist = builder.bend(20)
    hips = np.array([0, 0, -length / 2])
    waist = np.array([0, builder.bend(0.06), 0.0])
    chest = waist + aim(twist, builder.bend(10))[:, 2] * length / 2
    rear, front = girth * builder.between(0.75, 1), girth * builder.between(0.85, 1.1)
    builder.limb([hips, waist, chest], [rear, girth * builder.between(0.75, 1.1), front])
    if builder.chance(0.5):
        builder.ball(
            waist - np.array([0, 0.2 * girth, 0]), [0.95 * girth, 0.95 * girth, vary(0.45 * length)]
        )
    stride = builder.between(0, 35)
    for end, girth_here, yaw, fore in ((hips, rear, 0.0, -1), (chest, front, twist, 1)):
        frame = aim(yaw, 0)
        for side in (1, -1):
            root = end + frame @ np.array([side * (girth_here - 0.7 * thick), -0.3 * girth_here, 0])
            _leg(builder, root, frame, side, leg, thick, sprawl, builder.bend(stride), fore)
    if tail > 0.15 and builder.chance(0.9):
        tip = builder.between(0.1, 0.5)
        base = vary(min(0.9 * rear, 0.12 + 0.12 * tail), 0.3)
        points, radii, _ = builder.curl(
            hips + np.array([0, 0.2 * rear, -0.5 * rear]),
            aim(180 + builder.bend(25), builder.between(-50, 50)),
            vary(tail, 0.3),
            (base, tip * base),
            70,
        )
        builder.limb(points, radii)
        if builder.chance(0.3):
            builder.ball(points[-1], [vary(1.5 * base), vary(1.5 * base), vary(2 * base)])
    reach = neck + 0.5 * front + 0.6 * size
    points, radii, _ = builder.curl(
        chest + np.array([0, 0.25 * front, 0.2 * front]),
        aim(twist + builder.bend(20), rise + builder.bend(12)),
        reach,
        (0.75 * front if neck < 0.5 else 0.6 * front, 0.62 * size),
        25,
    )
    builder.limb(points, radii)
    look = aim(twist + builder.bend(35), builder.between(-30, 15), builder.bend(10))
    head(builder, points[-1] + look @ np.array([0, 0.2, 0.25]) * size, size, look, muzzle)
    _back(builder, Ball((hips + chest) / 2, np.array([girth, girth, length / 2]), np.eye(3)))


def _leg(
    builder: CharacterBuilder,
    root: Vector,
    frame: Vector,
    side: int,
    length: float,
    thick: float,
    sprawl: float,
    swing: float,
    fore: int,
) -> None:
    bent = builder.between(5, 30)
    upper = frame @ aim(0, swing - 90 + fore * bent)[:, 2] * 0.5 * length
    lower = frame @ aim(0, swing - 90 - fore * bent)[:, 2] * 0.5 * length
    out = np.tan(np.radians(sprawl)) * 0.5 * length * side * frame[:, 0]
    knee = root + upper + out
    foot = knee + lower + 0.2 * out
    ankle = thick * builder.between(0.55, 1.0)
    builder.limb([root, knee, foot], [builder.vary(1.5 * thick, 0.15), thick, ankle])
    paw = builder.vary(1.25 * ankle, 0.15)
    at = foot + frame[:, 2] * 0.5 * paw
    builder.ball(at, [paw, 0.7 * paw, 1.4 * paw], frame)
    if builder.softness < 0.5:
        for toe in (-0.55, 0, 0.55):
            builder.ball(at + frame @ np.array([toe, -0.1, 1.1]) * paw, [0.4 * paw] * 3)


def _back(builder: CharacterBuilder, trunk: Ball) -> None:
    """Add a shell, plates, a hump or spikes to the back, by chance."""
    kind = builder.pick("none", "none", "none", "none", "shell", "plates", "hump", "spikes")
    x, y, z = trunk.radii
    if kind == "shell":
        builder.attach_lathed(
            trunk.centre + np.array([0, 0.25 * y, 0]),
            np.diag([1.1, 1, builder.between(1, 1.15) * max(1.0, z / x * 0.8)]),
            [[0, 1.2 * y], [0.8 * x, 0.9 * y], [1.25 * x, 0.1 * y], [1.4 * x, -0.1 * y]],
            0.1 * y,
            folds=int(builder.rng.integers(3, 9)),
            depth=builder.between(0, 0.06),
        )
    elif kind == "hump":
        for at in (-0.4, 0.4) if builder.chance(0.5) else (0.0,):
            hump = builder.between(0.35, 0.6) * y
            builder.ball(
                trunk.centre + np.array([0, 0.9 * y, at * z]), [0.8 * hump, 1.3 * hump, hump]
            )
    elif kind in ("plates", "spikes"):
        for at in np.linspace(-0.95, 0.95, int(builder.rng.integers(4, 9))):
            tall = y * (0.75 - 0.4 * abs(at))
            base = trunk.centre + np.array([0, 0.85 * y, at * z])
            if kind == "plates":
                builder.attach_ball(
                    base + np.array([0, 0.4 * tall, 0]), [0.15 * tall, tall, 0.7 * tall]
                )
            else:
                builder.limb(
                    [base, base + np.array([0, tall, -0.2 * tall])], [0.3 * tall, 0.04 * tall]
                )
