"""What the lamplighter wears and carries: boots, scarf, hat and lantern."""

from __future__ import annotations

import numpy as np
from pose import BOOTS, BRASS, FLAME, GLASS, HAT, INK, SCARF, SOLES, STRIPE, Pose
from strokes import Points, Sheet, curve, place


def draw_boot(sheet: Sheet, ankle: tuple[float, float], side: int, turn: float) -> None:
    def part(knots: list[tuple[float, float]], closed: bool = True) -> Points:
        # Drawn for the character's boot on the page's right, toe to the right.
        points = place(curve([(side * x, y) for x, y in knots], closed), ankle, side * turn)
        return points if side > 0 else points[::-1]

    upper = part(
        [(-62, -42), (-62, -42), (0, -50), (60, -42), (60, -42), (62, -8), (98, 8), (134, 36),
         (138, 76), (138, 76), (40, 84), (-64, 76), (-64, 76), (-66, 20)]
    )  # fmt: skip
    sole = part(
        [(-68, 72), (-68, 72), (40, 82), (142, 70), (142, 70), (148, 84), (138, 94), (30, 97),
         (-58, 94), (-70, 84)]
    )  # fmt: skip
    sheet.shape(upper, BOOTS, 6.4)
    sheet.shape(sole, SOLES, 6.5)
    cuff = part(
        [(-68, -38), (-68, -38), (0, -46), (68, -38), (68, -38), (74, -20), (70, 0), (70, 0),
         (0, -8), (-70, 0), (-70, 0), (-75, -20)]
    )  # fmt: skip
    sheet.shape(cuff, SOLES, 6)
    sheet.ink(part([(78, 66), (84, 40), (106, 22)], closed=False), 3.6, (14, 18))
    sheet.ink(part([(24, 14), (46, 22), (62, 18)], closed=False), 3.6, (14, 10))
    sheet.ink(part([(18, 32), (40, 38), (58, 34)], closed=False), 3.2, (14, 10))


def draw_scarf_end(
    sheet: Sheet, pose: Pose, at: tuple[float, float], turn: float, length: float
) -> None:
    """A hanging or flying end of the scarf, along its own x, with stripes and a fringe."""
    wave = 10 + 0.5 * pose.scarf

    def across(x: float, y: float) -> tuple[float, float]:
        return (x, y + wave * float(np.sin(x / length * 5)))

    n = length
    top = [across(x * n, -34 - 8 * x) for x in (0, 0.25, 0.5, 0.75, 1)]
    bottom = [across(x * n, 34 + 8 * x) for x in (1, 0.75, 0.5, 0.25, 0)]
    fringe = [across(n, -42), across(n + 24, -30), across(n, -14), across(n, -14),
              across(n + 26, -1), across(n, 14), across(n, 14), across(n + 24, 28),
              across(n, 42), across(n, 42)]  # fmt: skip
    outline = place(curve([*top, *fringe, *bottom[1:]]), at, turn)
    sheet.fill(outline, SCARF)
    for x in (0.5, 0.74):
        stripe = [across(x * n, -60), across(x * n + 20, -60), across(x * n + 20, 60),
                  across(x * n, 60)]  # fmt: skip
        sheet.fill(place(stripe, at, turn), STRIPE, over=SCARF)
    sheet.ink(outline, 5.5)
    hem = [across(n - 8, -40), across(n - 4, 0), across(n - 8, 41)]
    sheet.ink(place(curve(hem), at, turn), 3.4)


def draw_scarf(sheet: Sheet, pose: Pose) -> None:
    draw_scarf_end(sheet, pose, at=(-66, -408), turn=97 + 0.4 * pose.scarf, length=150)
    band = curve(
        [(-206, -520), (-206, -520), (-216, -480), (-196, -444), (-110, -402), (0, -388),
         (110, -400), (196, -440), (216, -480), (206, -520), (206, -520), (0, -560)],
        closed=True,
    )  # fmt: skip
    sheet.shape(band[::-1], SCARF, 6.5)
    for fold in (
        [(190, -478), (120, -436), (30, -422)],
        [(150, -500), (80, -462), (0, -446), (-34, -446)],
        [(-192, -480), (-164, -456), (-122, -436)],
    ):
        sheet.ink(curve(fold), 4.2, (30, 40))
    knot = curve(
        [(-104, -444), (-68, -456), (-32, -446), (-20, -416), (-34, -388), (-68, -378),
         (-104, -388), (-116, -416)],
        closed=True,
    )  # fmt: skip
    sheet.shape(knot, SCARF, 6)
    sheet.ink(curve([(-86, -438), (-76, -420), (-80, -398)]), 3.8, (10, 22))
    sheet.ink(curve([(-46, -434), (-56, -418), (-54, -402)]), 3.8, (10, 20))


def draw_hat(sheet: Sheet, pose: Pose) -> None:
    at, turn = (34.0, -806.0 - pose.hat_lift), 8.0
    crown = place(
        curve([(-96, 6), (-96, -40), (-62, -78), (0, -90), (62, -78), (96, -40), (96, 6)]), at, turn
    )
    brim = place(
        curve(
            [(-150, -8), (-120, -14), (-60, 4), (0, 8), (60, 4), (120, -14), (150, -8), (138, 18),
             (70, 32), (0, 36), (-70, 32), (-138, 18)],
            closed=True,
        ),
        at, turn,
    )  # fmt: skip
    edge = curve([(-98, -30), (-50, -18), (0, -14), (50, -18), (98, -30)])
    band = place(
        np.vstack([edge, [(110, 30), (-110, 30)]]),
        at, turn,
    )  # fmt: skip
    sheet.fill(crown, HAT)
    sheet.fill(band, SCARF, over=HAT)
    sheet.ink(crown, 6.5)
    sheet.ink(place(edge, at, turn), 3.6)
    sheet.shape(brim, HAT, 6.5)
    sheet.ink(place(curve([(-20, -76), (6, -64), (30, -72)]), at, turn), 4, (16, 20))


def draw_lantern(sheet: Sheet, hand: Points, pose: Pose) -> None:
    # Metal keeps its shape when the character squashes.
    rigid = (1 / pose.stretch[0], 1 / pose.stretch[1])
    grip = hand + np.array([-18, -14])

    def part(knots: list[tuple[float, float]], closed: bool = True) -> Points:
        return place(curve(knots, closed), grip, pose.swing, rigid)

    bail = part([(-58, 112), (-56, 60), (-30, 14), (0, 2), (30, 14), (56, 60), (58, 112)], False)
    sheet.ink(bail, 15, colour=INK)
    sheet.ink(bail, 6.5, colour=BRASS)
    glass = part(
        [(-56, 118), (-56, 118), (56, 118), (56, 118), (72, 170), (58, 226), (58, 226),
         (-58, 226), (-58, 226), (-72, 170)]
    )  # fmt: skip
    sheet.shape(glass, GLASS, 5.5)
    flame = part(
        [(2, 146), (2, 146), (20, 174), (25, 195), (0, 215), (-25, 195), (-15, 172)]
    )  # fmt: skip
    sheet.fill(flame, FLAME)
    sheet.ink(flame, 3, closed=True)
    for x in (-44, 44):
        post = part([(0.8 * x, 118), (1.06 * x, 172), (0.86 * x, 226)], False)
        sheet.ink(post, 12, colour=INK)
        sheet.ink(post, 5, colour=BRASS)
    base = part(
        [(-66, 218), (-66, 218), (0, 226), (66, 218), (66, 218), (84, 244), (82, 262), (82, 262),
         (0, 272), (-82, 262), (-82, 262), (-84, 244)]
    )  # fmt: skip
    cap = part(
        [(-76, 122), (-76, 122), (-58, 92), (-34, 74), (-18, 66), (0, 64), (18, 66), (34, 74),
         (58, 92), (76, 122), (76, 122), (0, 134)]
    )  # fmt: skip
    knob = part([(-16, 66), (-20, 50), (0, 40), (20, 50), (16, 66), (0, 70)])
    for brass in (base, knob, cap):
        sheet.shape(brass, BRASS, 6)
    sheet.ink(part([(-80, 246), (0, 254), (80, 246)], False), 3.4)
    sheet.ink(part([(-60, 106), (0, 116), (60, 106)], False), 3.4)
