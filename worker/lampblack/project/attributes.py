"""Attributes of a project's XML, checked against bounds: they are untrusted input."""

from __future__ import annotations

import math
import warnings
from collections.abc import Collection
from xml.etree.ElementTree import Element, ParseError

from defusedxml import DefusedXmlException
from defusedxml.ElementTree import fromstring

from ..drawing.load import MAX_PIXELS, MAX_SIDE
from ..errors import LampblackWarning, ProjectError

AGAIN = "Open it in its own program and save it again; if that fails, restore a backup."
"""What to do with a file that is whole, but says something that makes no sense."""
MAX_PLACE = 1_000_000
MAX_TAGS, MAX_ATTRIBUTES = 600_000, 1_500_000
"""Of a description. Parsed, each takes many times its bytes of memory."""


def sound_xml(xml: bytes, name: str) -> Element:
    """The root of ``xml``; ``name`` is for the errors.

    Raises:
        ProjectError: the XML is malformed, declares entities or has too many parts.
    """
    if xml.count(b"<") > MAX_TAGS or xml.count(b"=") > MAX_ATTRIBUTES:
        raise ProjectError(
            f"The description in {name} has more parts than can be read.",
            "Save the drawings as several projects.",
        )
    try:
        root: Element = fromstring(xml, forbid_entities=True)
    except (ParseError, DefusedXmlException, ValueError, LookupError, RecursionError) as error:
        raise ProjectError(
            f"The description in {name} is not valid XML.",
            AGAIN,
            str(error),
        ) from error
    return root


def check_size(width: int, height: int, subject: str) -> None:
    """Refuse a picture that is empty or too large to be lit."""
    if not (0 < width <= MAX_SIDE and 0 < height <= MAX_SIDE and width * height <= MAX_PIXELS):
        raise ProjectError(
            f"{subject} is {width} x {height} pixels.",
            f"Give it a size of 1 to {MAX_SIDE} a side, and {MAX_PIXELS // 1_000_000} megapixels "
            "at most.",
        )


UNKNOWN_BLENDS = "have blend modes that Lampblack does not know; they are shown as if they had none"


def tell_of_layers(names: Collection[str], file: str, what: str) -> None:
    """Warn of layers of ``file``, if there are any."""
    if names:
        named = ", ".join(map(repr, sorted(names)[:8])) + (", ..." if len(names) > 8 else "")
        warnings.warn(f"{file}: {named} {what}.", LampblackWarning, stacklevel=3)


def whole(element: Element | None, name: str, default: int) -> int:
    """An attribute that is a whole number.

    Raises:
        ProjectError: it is not whole, or see ``number``.
    """
    value = number(element, name, default)
    if value != int(value):
        raise _nonsense(name, str(value))
    return int(value)


def number(element: Element | None, name: str, default: float) -> float:
    """An attribute that is a number; ``default`` if it is absent.

    Raises:
        ProjectError: it is not a number, not finite, or out of bounds.
    """
    text = None if element is None else element.get(name)
    if text is None:
        return default
    try:
        value = float(text)
    except ValueError as error:
        raise _nonsense(name, text) from error
    if not math.isfinite(value) or abs(value) > MAX_PLACE:
        raise _nonsense(name, text)
    return value


def _nonsense(name: str, text: str) -> ProjectError:
    return ProjectError(
        f"The project says {name} = {text[:40]!r}, which is not possible.",
        AGAIN,
    )
