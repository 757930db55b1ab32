"""From exceptions to error codes and error messages of the protocol."""

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
"""The first matching type counts."""


def error_code(error: Exception) -> ErrorCode:
    """The code of an error that occurred while a drawing was prepared, lit or written."""
    return next((code for kind, code in _CODES if isinstance(error, kind)), ErrorCode.INTERNAL)


def fault_message(
    error: Exception, *, request: int | None = None, frame: int | None = None
) -> ErrorMessage:
    """The message that reports ``error``. Its text is that of a ``LampblackError``, or the
    catalogue's."""
    code = error_code(error)
    if isinstance(error, LampblackError):
        return error_message(
            code, what=error.what, remedy=error.remedy, details=error.details,
            request=request, frame=frame,
        )  # fmt: skip
    details = repr(error) if code is ErrorCode.INTERNAL else ""
    return error_message(code, details=details, request=request, frame=frame)
