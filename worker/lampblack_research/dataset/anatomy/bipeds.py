"""People, upright animals and seated toys; z is where they look."""

from __future__ import annotations

import numpy as np

from .faces import MUZZLES, head
from .field import Vector
from .figure import Ball, Figure, aim, towards

# leg, trunk; width of hips and shoulders; belly; neck; head; arm; thickness of limbs.
_BIPEDS = {
    "human": (1.0, 0.65, 0.16, 0.2, 0.17, 0.12, 0.17, 0.75, 0.075),
    "toddler": (0.45, 0.5, 0.17, 0.16, 0.21, 0.03, 0.27, 0.4, 0.08),
    "bear": (0.4, 0.8, 0.28, 0.25, 0.4, 0.02, 0.33, 0.55, 0.14),
    "penguin": (0.1, 0.8, 0.25, 0.2, 0.36, 0.0, 0.27, 0.5, 0.09),
    "mascot": (0.35, 0.45, 0.16, 0.15, 0.22, 0.02, 0.45, 0.42, 0.09),
    "mouse": (0.6, 0.4, 0.15, 0.12, 0.18, 0.06, 0.32, 0.55, 0.055),
    "giant": (0.7, 0.9, 0.22, 0.45, 0.34, 0.05, 0.2, 1.0, 0.15),
}


def biped(figure: Figure, *, seated: bool = False) -> None:
    """Upright, arms and legs posed each for itself."""
    vary = figure.vary
    preset = _BIPEDS[figure.pick(*_BIPEDS)]
    leg, trunk, hip, shoulder, belly, neck, size, arm, thick = (vary(v, 0.17) for v in preset)
    lean = aim(figure.bend(15), 90 + figure.bend(10), 0)
    up = lean[:, 2]
    frame = np.stack([np.cross(up, [0, 0, 1]), up, [0, 0, 1]], axis=1)
    frame[:, 0] = np.cross(frame[:, 1], frame[:, 2])
    frame /= np.linalg.norm(frame, axis=0)
    frame[:, 2] = np.cross(frame[:, 0], frame[:, 1])
    hips, chest = np.zeros(3), up * trunk * 0.75
    round_hip = hip * figure.between(0.85, 1.1)
    figure.ball(hips, [1.15 * round_hip, round_hip, 0.9 * round_hip], frame)
    figure.limb([hips, chest], [0.95 * round_hip, 0.9 * shoulder])
    figure.ball(chest, [1.25 * shoulder, vary(0.9 * shoulder), 0.8 * shoulder], frame)
    middle = hips + up * trunk * figure.between(0.2, 0.45) + [0, 0, 0.15 * belly]
    tummy = Ball(middle, np.array([vary(belly, 0.1), 0.5 * trunk, vary(0.9 * belly, 0.1)]), frame)
    figure.ball(tummy.centre, list(tummy.radii), frame)
    for side in (1, -1):
        root = hips + frame @ np.array([side * 0.8 * hip, -0.3 * hip, 0])
        _stand(figure, root, side, leg, thick * figure.between(1.15, 1.4), seated)
        joint = chest + frame @ np.array([side * 1.15 * shoulder, 0.25 * shoulder, 0])
        _arm(figure, joint, frame, side, arm, thick)
    top = chest + up * (0.8 * shoulder + neck)
    look = aim(figure.bend(30), figure.bend(12), figure.bend(10))
    figure.limb([chest, top], [0.6 * shoulder, min(0.55 * size, 1.2 * thick + 0.2 * size)])
    head(figure, top + look[:, 1] * 0.75 * size, size, look, figure.pick(*MUZZLES))
    if figure.some(0.25):
        _tail(figure, hips + np.array([0, 0, -0.6 * hip]), hip)
    _clothes(figure, tummy, hips, chest, shoulder, frame)


def _stand(figure: Figure, root: Vector, side: int, leg: float, thick: float, seated: bool) -> None:
    out = side * figure.between(2, 25)
    raised = figure.between(-10, 10) + 85 if seated else figure.bend(22)
    bent = figure.between(0, 50) if not seated else figure.between(0, 70)
    knee = root + aim(out, raised - 90)[:, 2] * 0.5 * leg
    foot = knee + aim(out, raised - bent - 90)[:, 2] * 0.5 * leg
    knee[0] += 0.08 * leg * side
    foot[0] += 0.1 * leg * side
    slim = figure.between(0.7, 1.0) * thick
    figure.limb([root, knee, foot], [1.35 * thick, thick, slim])
    if figure.some(0.5):
        figure.ball((0.35 * knee + 0.65 * foot) + [0, 0, -0.3 * slim], [slim, 1.8 * slim, slim])
    shoe = figure.vary(1.35 * slim, 0.2)
    turn = aim(out, 70 if seated else figure.between(-5, 10))
    at = foot + turn @ np.array([0, -0.2, 0.55]) * shoe
    radii = [0.9 * shoe, 0.65 * shoe, 1.5 * shoe]
    if figure.softness < 0.3:
        figure.lay_ball(at, radii, turn)
    else:
        figure.ball(at, radii, turn)


def _arm(figure: Figure, joint: Vector, frame: Vector, side: int, arm: float, thick: float) -> None:
    raised = figure.between(-80, 60) if figure.some(0.6) else figure.between(-80, -60)
    forward = figure.bend(35)
    upper = frame @ (aim(side * (90 - forward), raised)[:, 2])
    bend = figure.between(0, 90)
    lower = (
        frame
        @ aim(side * (90 - forward - bend * figure.between(0.3, 1)), raised + bend * 0.5)[:, 2]
    )
    elbow = joint + upper * 0.5 * arm
    wrist = elbow + lower * 0.5 * arm
    if figure.some(0.15):  # a flipper or a sleeve
        turn = towards(wrist - joint)
        wide = figure.between(1.2, 2.2) * thick
        figure.ball((joint + wrist) / 2, [0.5 * wide, wide, 0.55 * arm], turn)
        return
    slim = figure.between(0.65, 1.0) * thick
    figure.limb([joint, elbow, wrist], [figure.vary(1.3 * thick, 0.1), thick, slim])
    hand(figure, wrist, towards(lower) @ aim(0, 0, figure.between(0, 360)), 1.25 * slim)


def hand(figure: Figure, wrist: Vector, turn: Vector, size: float) -> None:
    """A ball, a mitten with a thumb, or fingers; it points along the z of ``turn``."""
    palm = wrist + turn[:, 2] * 0.7 * size
    kind = figure.pick("ball", "mitten", "fingers", "fingers")
    if kind == "ball":
        figure.ball(palm, [1.1 * size] * 3)
        return
    figure.ball(palm, [0.55 * size, size, 1.1 * size], turn)
    thumb = palm + turn @ np.array([0, 0.6, -0.2]) * size
    figure.limb([thumb, thumb + turn @ np.array([0.3, 0.8, 0.7]) * size], [0.4 * size, 0.3 * size])
    if kind == "fingers":
        count, curl = int(figure.rng.integers(3, 5)), figure.between(0, 70)
        for n in range(count):
            spread = (n - (count - 1) / 2) / count
            start = palm + turn @ np.array([0, -1.4 * spread, 0.7]) * size
            out = turn @ aim(0, -40 * spread) @ aim(curl, 0)
            end = start + out[:, 2] * size * figure.between(1.0, 1.4)
            figure.limb([start, end], [0.36 * size, 0.27 * size])


def _tail(figure: Figure, root: Vector, size: float) -> None:
    points, radii, _ = figure.curl(
        root,
        aim(180 + figure.bend(30), figure.between(-40, 50)),
        figure.between(0.3, 1.0),
        (size * figure.between(0.2, 0.6), 0.06),
        80,
    )
    figure.limb(points, radii)


def _clothes(
    figure: Figure, tummy: Ball, hips: Vector, chest: Vector, shoulder: float, frame: Vector
) -> None:
    """Some of: a skirt, a cape, a belt, a scarf, buttons."""
    wide = float(max(tummy.radii[0], 1.1 * shoulder))
    if figure.some(0.22):
        long, flare = figure.between(0.2, 0.7), figure.between(1.1, 2.2)
        waist = tummy.centre - hips
        figure.lay_turned(
            hips + 0.8 * waist,
            frame,
            [
                [0.85 * wide, 0.1],
                [1.1 * wide, 0],
                [(0.5 + 0.6 * flare) * wide, -0.5 * long],
                [flare * wide, -long],
            ],
            0.03,
            folds=figure.rng.integers(4, 14),
            depth=figure.between(0, 0.14),
            phase=figure.between(0, 6),
        )
    if figure.some(0.12):
        long, flare = figure.between(0.5, 1.1), figure.between(1.3, 2.2)
        figure.lay_turned(
            chest + 0.5 * shoulder * frame[:, 1],
            frame,
            [[0.8 * shoulder, 0.1], [1.6 * shoulder, -0.1], [flare * wide, -long]],
            0.03,
            folds=figure.rng.integers(5, 14),
            depth=figure.between(0.03, 0.12),
            phase=figure.between(0, 6),
            arc=figure.between(150, 260),
        )
    if figure.some(0.2):
        for _ in range(int(figure.rng.integers(1, 3))):
            ring = figure.between(0.75, 1.0) * 0.9 * shoulder
            height = figure.between(0.7, 1.0) * shoulder
            tube = figure.between(0.2, 0.4) * shoulder
            figure.lay_turned(
                chest + frame[:, 1] * height,
                frame @ aim(figure.bend(30), figure.bend(12)),
                [[ring, 0.5 * tube], [ring, -0.5 * tube]],
                tube,
            )
    if figure.some(0.25):
        button = figure.between(0.06, 0.16) * wide
        for up in (-0.35, 0.0, 0.35):
            turn = tummy.facing(0, up, 1)
            figure.lay_ball(tummy.at(0, up, 1, 1.03), [button, button, 0.5 * button], turn)
