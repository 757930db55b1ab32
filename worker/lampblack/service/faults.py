"""What went wrong, as the protocol says it: the one way from exceptions to error codes."""

from __future__ import annotations

from ..errors import (
    LampblackError,
    NothingDrawnError,
    OutputError,
    RenderError,
    RenderRestartedError,
)
from ..protocol import ErrorCode, ErrorMessage, error_message

_CODES: tuple[tuple[type[Exception], ErrorCode], ...] = (
    (NothingDrawnError, ErrorCode.NOTHING_DRAWN),
    (OutputError, ErrorCode.OUTPUT_FAILED),
    (RenderRestartedError, ErrorCode.RENDER_RESTARTED),
    (RenderError, ErrorCode.RENDER_FAILED),
    (LampblackError, ErrorCode.DRAWING_UNUSABLE),
    (MemoryError, ErrorCode.OUT_OF_MEMORY),
)
"""The first kind that fits counts."""


def error_code(error: Exception) -> ErrorCode:
    """The code of an error met while a drawing is prepared, lit or written."""
    return next((code for kind, code in _CODES if isinstance(error, kind)), ErrorCode.INTERNAL)


def fault_message(
    error: Exception, *, request: int | None = None, frame: int | None = None
) -> ErrorMessage:
    """The message that reports ``error``; it has words of its own only if it is for people."""
    code = error_code(error)
    if isinstance(error, LampblackError):
        return error_message(
            code, what=error.what, remedy=error.remedy, details=error.details,
            request=request, frame=frame,
        )  # fmt: skip
    details = repr(error) if code is ErrorCode.INTERNAL else ""
    return error_message(code, details=details, request=request, frame=frame)
