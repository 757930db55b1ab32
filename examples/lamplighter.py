"""The lamplighter: a stout, furry keeper of lanterns, drawn part over part from back to front.

Character units are pixels of a 1000 pixel canvas; the origin is on the floor beneath the character,
x right, y down, so all of the character has y < 0.
"""

from __future__ import annotations

import numpy as np
from attire import draw_boot, draw_hat, draw_lantern, draw_scarf, draw_scarf_end
from pose import BLACK, COLOURS, CREAM, FUR, PINK, STRIPE, WHITE, Pose
from strokes import Points, Sheet, bezier, curve, ellipse, place


def draw_lamplighter(
    size: tuple[int, int], floor: tuple[float, float], scale: float, line: float, pose: Pose
) -> Sheet:
    """Draw the character standing on canvas point ``floor``; ``line`` scales the ink's width."""
    sheet = Sheet(size, COLOURS, lambda p: pose.bend(p) * scale + np.asarray(floor), scale, line)
    _tail(sheet, pose)
    draw_scarf_end(sheet, pose, at=(160, -440), turn=-24 + pose.scarf, length=225)
    _legs(sheet, pose)
    _body(sheet)
    hand = _arm(sheet, (-140, -440), pose.lantern_arm)
    _free_arm(sheet, pose)
    draw_scarf(sheet, pose)
    draw_lantern(sheet, hand, pose)
    _fist(sheet, hand, pose)
    _head(sheet, pose)
    return sheet


def _tail(sheet: Sheet, pose: Pose) -> None:
    root = (170, -170)
    outline = place(
        curve(
            [(0, 55), (120, 75), (215, 20), (255, -90), (238, -195), (196, -262), (196, -262),
             (186, -190), (150, -120), (90, -75), (0, -60), (0, -60)], closed=False,
        ),
        root, pose.tail,
    )  # fmt: skip
    tip = place(
        curve(
            [(300, -60), (300, -60), (262, -92), (240, -62), (240, -62), (222, -112), (196, -96),
             (196, -96), (186, -140), (130, -130), (130, -130), (140, -300), (300, -300)],
            closed=False,
        ),
        root, pose.tail,
    )  # fmt: skip
    sheet.fill(outline, FUR)
    sheet.fill(tip, CREAM, over=FUR)
    sheet.ink(outline, 6.5)
    zigzag = curve(
        [(253, -80), (240, -62), (240, -62), (222, -112), (196, -96), (196, -96), (184, -142),
         (160, -136)]
    )  # fmt: skip
    sheet.ink(place(zigzag, root, pose.tail), 3.6, (0, 20))
    for fold in ([(60, 40), (120, 36), (168, 6)], [(228, -150), (226, -190), (214, -220)]):
        sheet.ink(place(curve(fold), root, pose.tail), 4, (30, 30))


def _legs(sheet: Sheet, pose: Pose) -> None:
    for side, foot in zip((-1, 1), pose.feet, strict=True):
        ankle = (side * 118 + foot.x, -92 + foot.y)
        hip, knee = np.array([side * 112, -190]), np.array([side * 114, -140])
        sheet.tube(bezier(hip, knee, np.asarray(ankle)), [60, 58, 52], FUR, 6.5, root=0.0)
        draw_boot(sheet, ankle, side, foot.turn)


def _body(sheet: Sheet) -> None:
    outline = curve(
        [(-150, -480), (0, -520), (160, -480), (232, -410), (278, -310), (284, -220), (232, -140),
         (110, -116), (-20, -112), (-140, -118), (-238, -146), (-284, -224), (-274, -314),
         (-226, -412)],
        closed=True,
    )  # fmt: skip
    belly = curve(
        [(-8, -430), (80, -396), (166, -318), (184, -224), (120, -156), (-8, -134),
         (-136, -156), (-200, -226), (-182, -318), (-100, -396)],
        closed=True,
    )  # fmt: skip
    sheet.fill(outline, FUR)
    sheet.fill(belly, CREAM)
    sheet.ink(belly, 3.6, closed=True)
    sheet.ink(outline, 6.8, closed=True)
    for tuft in (
        [(10, -330), (22, -312), (36, -326)],
        [(-92, -196), (-80, -180), (-66, -194)],
        [(-60, -182), (-48, -166), (-34, -180)],
    ):
        sheet.ink(curve([tuft[0], tuft[1], tuft[1], tuft[2]]), 3.4, (16, 16))


def _arm(sheet: Sheet, shoulder: tuple[float, float], angles: tuple[float, float]) -> Points:
    """Draw an arm; returns its wrist."""
    upper, lower = np.radians(angles)
    elbow = np.asarray(shoulder) + 170 * np.array([np.cos(upper), np.sin(upper)])
    wrist: Points = elbow + 140 * np.array([np.cos(lower), np.sin(lower)])
    axis = bezier(np.asarray(shoulder), elbow, wrist)
    sheet.tube(axis, [44, 58, 55, 49, 44], FUR, 6.2, root=0.3)
    return wrist


def _free_arm(sheet: Sheet, pose: Pose) -> None:
    wrist = _arm(sheet, (140, -440), pose.free_arm)
    turn = pose.free_arm[1] + pose.paw_turn
    thumb_side = 1 if pose.palm_out else -1

    def part(knots: list[tuple[float, float]]) -> Points:
        points = place(curve([(x, thumb_side * y) for x, y in knots]), wrist, turn)
        return points if pose.palm_out else points[::-1]

    paw = part(
        [(-8, -44), (10, -47), (30, -53), (66, -56), (84, -40), (72, -22), (72, -22), (100, -22),
         (108, -2), (78, 8), (78, 8), (98, 12), (100, 32), (72, 44), (40, 48),
         (12, 45), (-8, 44)]
    )  # fmt: skip
    thumb = part([(2, -34), (14, -66), (40, -84), (56, -68), (46, -46), (34, -28)])
    for outline in (thumb, paw):
        sheet.fill(outline, FUR)
        sheet.ink(outline, 6, (5, 5))
    for crease in ([(72, -22), (56, -19), (38, -22)], [(78, 8), (60, 10), (42, 6)]):
        sheet.ink(place([(x, thumb_side * y) for x, y in crease], wrist, turn), 4.4, (0, 18))


def _fist(sheet: Sheet, hand: Points, pose: Pose) -> None:
    turn = pose.lantern_arm[1] - 225
    palm = place(
        curve(
            [(30, 34), (0, 38), (-34, 30), (-58, 14), (-66, -10), (-58, -34), (-36, -48),
             (-8, -52), (22, -46), (40, -22)],
        ),
        hand, turn,
    )  # fmt: skip
    sheet.fill(palm, FUR)
    sheet.ink(palm, 6, (16, 16))
    for x, y, taper in ((0, 12, 20), (-27, 8, 20), (-51, 0, 0)):
        finger = curve(
            [(x - 13, y - 24), (x - 17, y + 6), (x - 11, y + 26), (x + 2, y + 31), (x + 14, y + 24),
             (x + 17, y + 4), (x + 14, y - 18)]
        )[::-1]  # fmt: skip
        sheet.fill(place(finger, hand, turn), FUR)
        sheet.ink(place(finger, hand, turn), 5.2, (20, taper))


def _head(sheet: Sheet, pose: Pose) -> None:
    for side in (-1, 1):
        sheet.shape(ellipse(side * 172, -772, 66, 64), FUR, 6.4)
        sheet.fill(ellipse(side * 168, -764, 38, 38), PINK)
        sheet.ink(ellipse(side * 168, -764, 38, 38), 3.6, closed=True)
    outline = curve(
        [(-296, -592), (-296, -592), (-254, -622), (-240, -676), (-202, -754), (-120, -802),
         (0, -816), (120, -802), (202, -754), (240, -676), (254, -622), (296, -592), (296, -592),
         (268, -564), (246, -554), (246, -554), (262, -534), (280, -520), (280, -520),
         (222, -494), (140, -456), (0, -442), (-140, -456), (-222, -494), (-280, -520),
         (-280, -520), (-262, -534), (-246, -554), (-246, -554), (-268, -564)],
        closed=True,
    )  # fmt: skip
    sheet.shape(outline, FUR, 6.8)
    _face(sheet, pose)
    draw_hat(sheet, pose)


def _face(sheet: Sheet, pose: Pose) -> None:
    x = -22.0
    for side in (-1, 1):
        sheet.fill(ellipse(x + side * 160, -580, 36, 23), PINK, over=FUR)
    muzzle = ellipse(x, -552, 118, 72)
    sheet.shape(muzzle, CREAM, 4.5)
    _mouth(sheet, x, pose.smile)
    nose = curve(
        [(x, -637), (x + 34, -631), (x + 44, -611), (x + 23, -588), (x, -582), (x - 23, -588),
         (x - 44, -611), (x - 34, -631)],
        closed=True,
    )  # fmt: skip
    # No ink about black: the two could not be told apart.
    sheet.fill(nose, BLACK)
    for side in (-1, 1):
        _eye(sheet, x + side * 93, pose)
        brow = [(x + side * 56, -734), (x + side * 94, -750), (x + side * 132, -730)]
        sheet.ink(curve(brow[::side]), 9, (26, 26))


def _mouth(sheet: Sheet, x: float, smile: float) -> None:
    sheet.ink(curve([(x, -586), (x, -548)]), 5)
    corner = 62 + 6 * smile
    lips = curve(
        [(x - corner, -560), (x - 36, -540), (x, -548), (x + 36, -540), (x + corner, -560)]
    )
    if smile > 0:
        upper = lips[np.abs(lips[:, 0] - x) < 44]
        (left, left_y), (right, right_y) = upper[0], upper[-1]
        chin = -545 + 46 * smile
        jaw = curve([(right, right_y), (x + 29, chin - 9), (x, chin), (x - 29, chin - 9),
                     (left, left_y)])  # fmt: skip
        sheet.fill(np.vstack([upper, jaw]), STRIPE)
        sheet.fill(ellipse(x, chin + 2, 30, 24 * smile), PINK, over=STRIPE)
        sheet.ink(jaw, 5, (6, 6))
    sheet.ink(lips, 5.5, (12, 12))


def _eye(sheet: Sheet, x: float, pose: Pose) -> None:
    y = -660.0
    if pose.eyes_shut:
        sheet.ink(curve([(x - 46, y + 14), (x, y - 22), (x + 46, y + 14)]), 10, (14, 14))
        return
    white = ellipse(x, y, 50, 62)
    sheet.fill(white, WHITE)
    px, py = x + pose.gaze[0], y + pose.gaze[1]
    sheet.fill(ellipse(px, py, 30, 39), BLACK, over=WHITE)
    sheet.fill(ellipse(px - 5, py - 13, 8, 10), WHITE)
    sheet.ink(white, 5.5, closed=True)
