"""The stable error codes, and the exception that decoding raises."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from ..errors import LampblackError


class ErrorCode(StrEnum):
    """Codes of errors. A code never changes its meaning (``CATALOGUE``)."""

    BAD_FRAME_COUNT = "bad_frame_count"
    HEADER_TOO_LARGE = "header_too_large"
    PLANE_TOO_LARGE = "plane_too_large"
    NOT_LAMPBLACK = "not_lampblack"
    VERSION_MISMATCH = "version_mismatch"
    BAD_JSON = "bad_json"
    TOO_DEEP = "too_deep"
    BAD_NUMBER = "bad_number"
    UNKNOWN_TYPE = "unknown_type"
    WRONG_DIRECTION = "wrong_direction"
    BAD_FIELD = "bad_field"
    BAD_VALUE = "bad_value"
    BAD_SCENE = "bad_scene"
    BAD_PLANE_COUNT = "bad_plane_count"
    BAD_PLANE = "bad_plane"
    IMAGE_TOO_LARGE = "image_too_large"
    PLANE_SIZE_MISMATCH = "plane_size_mismatch"
    DIGEST_MISMATCH = "digest_mismatch"
    NOT_GREETED = "not_greeted"
    TOO_MANY_CLIENTS = "too_many_clients"
    STALE_REVISION = "stale_revision"
    STALE_REQUEST = "stale_request"
    NO_SCENE = "no_scene"
    UNKNOWN_FRAME = "unknown_frame"
    TOO_MANY_FRAMES = "too_many_frames"
    TOO_MANY_JOBS = "too_many_jobs"
    DRAWING_UNUSABLE = "drawing_unusable"
    NOTHING_DRAWN = "nothing_drawn"
    DRAWING_WARNING = "drawing_warning"
    RENDER_RESTARTED = "render_restarted"
    RENDER_SLOW = "render_slow"
    RENDER_FAILED = "render_failed"
    OUTPUT_FAILED = "output_failed"
    OUT_OF_MEMORY = "out_of_memory"
    INTERNAL = "internal"


@dataclass(frozen=True)
class Entry:
    """One line of the catalogue.

    Attributes:
        meaning: what happened.
        remedy: what the person should do.
        fatal: the session is over; the sender closes it after this error.
        decoding: found while a message is decoded, so that either side can find it and the
            vectors prove it; the others arise in the life of a session.
    """

    meaning: str
    remedy: str
    fatal: bool = False
    decoding: bool = False


_REPORT = "Report it, with the details: one of the two programs is at fault."
_UPDATE = "Update Lampblack and the plugin together."

CATALOGUE: dict[ErrorCode, Entry] = {
    ErrorCode.BAD_FRAME_COUNT: Entry(
        "The message has no frame, or more than a header and 20 planes.", _REPORT, decoding=True
    ),
    ErrorCode.HEADER_TOO_LARGE: Entry(
        "The header is longer than 262,144 bytes.",
        "Give fewer colours a material of their own.",
        decoding=True,
    ),
    ErrorCode.PLANE_TOO_LARGE: Entry(
        "A pixel plane is longer than 268,435,456 bytes.",
        "Use a drawing of at most 40 megapixels.",
        decoding=True,
    ),
    ErrorCode.NOT_LAMPBLACK: Entry(
        "The header does not begin as a Lampblack header does.",
        "Connect the plugin to a Lampblack worker, and nothing else.",
        decoding=True,
    ),
    ErrorCode.VERSION_MISMATCH: Entry(
        "The two programs speak different major versions of the protocol.",
        _UPDATE,
        fatal=True,
        decoding=True,
    ),
    ErrorCode.BAD_JSON: Entry(
        "The header is not JSON in the form that the specification asks for.",
        _REPORT,
        decoding=True,
    ),
    ErrorCode.TOO_DEEP: Entry(
        "The header nests objects and arrays more than 32 deep.",
        "Remove the part of the scene that is nested so deep.",
        decoding=True,
    ),
    ErrorCode.BAD_NUMBER: Entry(
        "A number is too large (2^53 or more), or too close to zero.",
        "Correct the number.",
        decoding=True,
    ),
    ErrorCode.UNKNOWN_TYPE: Entry(
        "This version does not know a message of that type.", _UPDATE, decoding=True
    ),
    ErrorCode.WRONG_DIRECTION: Entry(
        "A message of that type is only sent the other way.", _REPORT, decoding=True
    ),
    ErrorCode.BAD_FIELD: Entry(
        "A field is missing, of the wrong type or out of its range.",
        "Correct the value that the details name.",
        decoding=True,
    ),
    ErrorCode.BAD_VALUE: Entry(
        "Each field is valid, but they do not fit together.",
        "Correct the value that the details name.",
        decoding=True,
    ),
    ErrorCode.BAD_SCENE: Entry(
        "The scene is malformed, out of range or of an unknown version.",
        "Correct the setting that the details name, or start from a fresh scene.",
        decoding=True,
    ),
    ErrorCode.BAD_PLANE_COUNT: Entry(
        "The header announces another number of planes than came with it.", _REPORT, decoding=True
    ),
    ErrorCode.BAD_PLANE: Entry(
        "A plane has a role, format, size or stride that its message does not allow.",
        _REPORT,
        decoding=True,
    ),
    ErrorCode.IMAGE_TOO_LARGE: Entry(
        "A plane is more than 16,384 pixels a side, or more than 40 megapixels.",
        "Use a smaller drawing.",
        decoding=True,
    ),
    ErrorCode.PLANE_SIZE_MISMATCH: Entry(
        "A plane is not stride times height bytes long.", _REPORT, decoding=True
    ),
    ErrorCode.DIGEST_MISMATCH: Entry(
        "The pixels do not have the digest that they were announced under.",
        _REPORT,
        decoding=True,
    ),
    ErrorCode.NOT_GREETED: Entry("A message came before hello.", _REPORT),
    ErrorCode.TOO_MANY_CLIENTS: Entry(
        "The worker cannot serve more programs.",
        "Close a drawing program that uses this worker.",
        fatal=True,
    ),
    ErrorCode.STALE_REVISION: Entry(
        "The scene's revision is not above the one the worker holds; it was ignored.", _REPORT
    ),
    ErrorCode.STALE_REQUEST: Entry(
        "The request's number is not above the last one; it was ignored.", _REPORT
    ),
    ErrorCode.NO_SCENE: Entry("There is no scene yet, so nothing can be lit.", "Set a light."),
    ErrorCode.UNKNOWN_FRAME: Entry(
        "No drawing was announced for that frame.", "Draw something in it."
    ),
    ErrorCode.TOO_MANY_FRAMES: Entry(
        "The worker has no memory for more drawings.",
        "Work on a shorter range, or on smaller drawings.",
    ),
    ErrorCode.TOO_MANY_JOBS: Entry(
        "Too many render jobs are waiting.", "Wait for one to end, or cancel one."
    ),
    ErrorCode.DRAWING_UNUSABLE: Entry(
        "The drawing of a frame cannot be lit.", "Do what the message says."
    ),
    ErrorCode.NOTHING_DRAWN: Entry(
        "The frame is blank: there is no character to light.", "Draw one."
    ),
    ErrorCode.DRAWING_WARNING: Entry("The frame was lit, with a warning.", "Read the message."),
    ErrorCode.RENDER_RESTARTED: Entry(
        "The renderer stopped and was started again. Nothing is lost.", "Go on working."
    ),
    ErrorCode.RENDER_SLOW: Entry(
        "The renderer hardly gets to work: the machine is busy, or short of memory.",
        "Wait, or close other programs.",
    ),
    ErrorCode.RENDER_FAILED: Entry(
        "The renderer failed on this frame, also after a new start.",
        "Simplify the scene or lower the quality; copy the details into a report.",
    ),
    ErrorCode.OUTPUT_FAILED: Entry(
        "A finished frame could not be written. The frames before it are kept.",
        "Free some space or choose another folder. Then render again: finished frames are kept.",
    ),
    ErrorCode.OUT_OF_MEMORY: Entry(
        "There was not enough memory for the request.",
        "Close other programs, or use smaller drawings.",
    ),
    ErrorCode.INTERNAL: Entry(
        "The worker has an error of its own.", "Copy the details into a report."
    ),
}


class ProtocolError(LampblackError):
    """A message that must not be acted upon.

    Args:
        code: its stable code; what happened and what to do come from ``CATALOGUE``.
        details: what exactly, for a report.

    Attributes:
        about: the message's type, as far as it was read.
        request: the message's request number, as far as it was read.
    """

    def __init__(self, code: ErrorCode, details: str = "") -> None:
        entry = CATALOGUE[code]
        super().__init__(entry.meaning, entry.remedy, details)
        self.code = code
        self.about = ""
        self.request: int | None = None
