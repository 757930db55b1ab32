"""Easing curves between two keys of a camera: those of Qt, by its numbers, as Pencil2D 0.7 saves
them (https://doc.qt.io/qt-5/qeasingcurve.html)."""

from __future__ import annotations

import math
from collections.abc import Callable

Curve = Callable[[float], float]

LINEAR = 0
_OVERSHOOT = 1.70158
_PERIOD = 0.3


def eased(number: int, share: float) -> float:
    """The share of the way at ``share`` of the time, both 0 to 1; some curves overshoot.

    Raises:
        KeyError: there is no curve of this ``number``.
    """
    return share if number == LINEAR else CURVES[number](share)


def _bounce_out(t: float, height: float = 1.0) -> float:
    if t == 1:
        return height
    if t < 4 / 11:
        return height * 7.5625 * t * t
    middle, floor = (6, 0.75) if t < 8 / 11 else (9, 0.9375) if t < 10 / 11 else (10.5, 0.984375)
    return height - (1 - (7.5625 * (t - middle / 11) ** 2 + floor))


def _elastic_in(t: float, height: float = 1.0) -> float:
    if t in (0.0, 1.0):
        return height * t
    return -(2 ** (10 * (t - 1))) * _swing(t - 1, height)


def _elastic_out(t: float, height: float = 1.0) -> float:
    if t in (0.0, 1.0):
        return height * t
    return float(2 ** (-10 * t)) * _swing(t, height) + height


def _swing(t: float, height: float) -> float:
    shift = _PERIOD / (2 * math.pi) * math.asin(height)
    return math.sin((t - shift) * 2 * math.pi / _PERIOD)


def _back_in(t: float, overshoot: float = _OVERSHOOT) -> float:
    return t * t * ((overshoot + 1) * t - overshoot)


def _power(exponent: int) -> Curve:
    return lambda t: float(t**exponent)


def _out(curve: Curve) -> Curve:
    return lambda t: 1 - curve(1 - t)


def _in_out(curve: Curve) -> Curve:
    return lambda t: curve(2 * t) / 2 if t < 0.5 else 1 - curve(2 - 2 * t) / 2


def _out_in(first: Curve, second: Curve) -> Curve:
    return lambda t: first(2 * t) / 2 if t < 0.5 else 0.5 + second(2 * t - 1) / 2


def _expo_in(t: float) -> float:
    return t if t in (0.0, 1.0) else float(2 ** (10 * (t - 1))) - 0.001


def _expo_out(t: float) -> float:
    return 1.0 if t == 1 else 1.001 * (1 - float(2 ** (-10 * t)))


def _expo_in_out(t: float) -> float:
    if t in (0.0, 1.0):
        return t
    if t < 0.5:
        return float(2 ** (10 * (2 * t - 1))) / 2 - 0.0005
    return 0.5 * 1.0005 * (2 - float(2 ** (-10 * (2 * t - 1))))


_IN: tuple[Curve, ...] = (
    _power(2),
    _power(3),
    _power(4),
    _power(5),
    lambda t: 1 - math.cos(t * math.pi / 2),
    _expo_in,
    lambda t: 1 - math.sqrt(max(0.0, 1 - t * t)),
    _elastic_in,
    _back_in,
    lambda t: 1 - _bounce_out(1 - t),
)
"""Quad, Cubic, Quart, Quint, Sine, Expo, Circ, Elastic, Back, Bounce."""


def _elastic_out_in(t: float) -> float:
    """Qt halves the way, but not the swing."""
    return _elastic_out(2 * t, 0.5) if t < 0.5 else 0.5 + _elastic_in(2 * t - 1, 0.5)


def _bounce_out_in(t: float) -> float:
    """Qt halves the way, but not the bounces."""
    return _bounce_out(2 * t, 0.5) if t < 0.5 else 1 - _bounce_out(2 - 2 * t, 0.5)


def _curves() -> dict[int, Curve]:
    """Four of each: in, out, in-out, out-in."""
    curves: dict[int, Curve] = {}
    for index, curve in enumerate(_IN):
        out = _expo_out if curve is _expo_in else _out(curve)
        in_out = _in_out(curve)
        if curve is _expo_in:
            in_out = _expo_in_out
        elif curve is _back_in:
            in_out = _in_out(lambda t: _back_in(t, 1.525 * _OVERSHOOT))
        for place, one in enumerate((curve, out, in_out, _out_in(out, curve))):
            curves[4 * index + place + 1] = one
    return curves | {32: _elastic_out_in, 40: _bounce_out_in}


CURVES = _curves()
