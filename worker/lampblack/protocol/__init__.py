"""The live protocol: messages between a drawing program and the worker (protocol/SPEC.md)."""

from .codec import Received, decode, encode
from .digest import frame_digest
from .errors import CATALOGUE, ErrorCode, ProtocolError
from .fields import Crop, Message
from .frames import (
    DropFrame,
    GetOverlaps,
    GetPalette,
    NeedFrame,
    Overlap,
    OverlapPoint,
    Overlaps,
    Palette,
    PutFrame,
    Swatch,
)
from .job import Cancel, Done, FrameDone, Progress, Render
from .limits import LIMITS, Limits
from .messages import FromClient, FromWorker, Sender
from .normals import GetNormals, Normals
from .planes import Pixels, Plane, Role
from .preview import Image, Preview, SetScene, View
from .rigs import GetRigs, Rigs
from .session import Bye, ErrorMessage, Hello, Status, Welcome, answer_to, error_message
from .version import MAJOR, MINOR

__all__ = [
    "CATALOGUE",
    "LIMITS",
    "MAJOR",
    "MINOR",
    "Bye",
    "Cancel",
    "Crop",
    "Done",
    "DropFrame",
    "ErrorCode",
    "ErrorMessage",
    "FrameDone",
    "FromClient",
    "FromWorker",
    "GetNormals",
    "GetOverlaps",
    "GetPalette",
    "GetRigs",
    "Hello",
    "Image",
    "Limits",
    "Message",
    "NeedFrame",
    "Normals",
    "Overlap",
    "OverlapPoint",
    "Overlaps",
    "Palette",
    "Pixels",
    "Plane",
    "Preview",
    "Progress",
    "ProtocolError",
    "PutFrame",
    "Received",
    "Render",
    "Rigs",
    "Role",
    "Sender",
    "SetScene",
    "Status",
    "Swatch",
    "View",
    "Welcome",
    "answer_to",
    "decode",
    "encode",
    "error_message",
    "frame_digest",
]
