"""Errors for people: what happened, what to do, and details to copy."""

from __future__ import annotations


class LampblackError(Exception):
    """A fault of the input or the machine, shown to the artist without a traceback.

    Args:
        what: one sentence: what happened.
        remedy: one sentence: what to do about it.
        details: text to copy into a report (a path, a library's message).
    """

    def __init__(self, what: str, remedy: str = "", details: str = "") -> None:
        super().__init__(what)
        self.what = what
        self.remedy = remedy
        self.details = details

    def __str__(self) -> str:
        return " ".join(part for part in (self.what, self.remedy) if part)


class DrawingError(LampblackError):
    """The picture cannot be read, or nothing in it can be lit."""


class NothingDrawnError(DrawingError):
    """The picture is blank: there is no character to light."""


class ProjectError(DrawingError):
    """A Pencil2D project cannot be read."""


class SceneError(LampblackError):
    """The scene is malformed, out of range or of an unknown version."""


class RenderError(LampblackError):
    """The render process failed or ended."""


class RenderRestartedError(RenderError):
    """The render child went away and was started again; nothing is lost."""


class OutputError(LampblackError):
    """A result cannot be written: the disk is full, or the folder is not writable."""


class LampblackWarning(UserWarning):
    """Something the artist should know although the frame was rendered."""
