"""The messages in C++: their structs, their fields in JSON, error codes and limits."""

from __future__ import annotations

import dataclasses
import re

from ...composite.apart import LAYERS
from .. import job, limits, planes, preview, session, version
from .. import messages as catalogue
from ..connection import Connection
from ..errors import CATALOGUE
from ..fields import Crop, Digest
from ..frames import Affine
from ..limits import Limits
from ..messages import BY_SENDER, MESSAGES
from . import declarations as cpp
from . import scene
from .fields import structs_in
from .members import Form, Translator, number, struct_name
from .text import camel, heading

SOURCE = "worker/lampblack/protocol"
NAMESPACE = "lampblack::protocol"
IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)

FORMS = (
    Form(Digest, "QByteArray", lambda digest: f'QByteArray("{digest}")'),
    Form(Crop, "QRectF", lambda crop: f"QRectF({crop.x}, {crop.y}, {crop.width}, {crop.height})"),
    Form(Affine, "QTransform", lambda affine: f"QTransform({_columns(affine)})"),
)
STRUCTS = [
    kind for kind in structs_in([Connection, *MESSAGES.values()]) if kind not in scene.STRUCTS
]
NAMED = cpp.enums_in([planes, preview, job, session, catalogue])
ENUMS = {words: name for words, name in NAMED.items() if words not in scene.ENUMS}


def files() -> dict[str, str]:
    """Every generated file of the library, by its path in the plugin's folder."""
    return {
        "protocol/generated/messages.h": _types(),
        "protocol/generated/message_fields.h": _fields(),
        "protocol/generated/error_code.h": _error_codes(),
        "protocol/generated/limits.h": _limits(),
        "protocol/generated/apart_layers.h": _apart_layers(),
    }


def _columns(affine: tuple[float, ...]) -> str:
    a, b, c, d, e, f = map(number, affine)
    return "" if affine == IDENTITY else f"{a}, {d}, {b}, {e}, {c}, {f}"


def _translator() -> Translator:
    return Translator({**ENUMS, **scene.ENUMS}, FORMS)


def _types() -> str:
    alternatives = ", ".join(struct_name(kind) for kind in MESSAGES.values())
    parts = [
        f"constexpr int Major = {version.MAJOR};\nconstexpr int Minor = {version.MINOR};\n",
        *(cpp.enum(name, words) for words, name in ENUMS.items()),
        *(cpp.struct(kind, _translator()) for kind in STRUCTS),
        f"using Message = std::variant<{alternatives}>;\n",
    ]
    qt = ("QByteArray", "QRectF", "QStringList", "QTransform", "QVector")
    includes = ['#include "scene/generated/scene_types.h"', ""]
    includes += [*(f"#include <{name}>" for name in qt), "", "#include <variant>"]
    doc = "Every message, as SPEC 8 has them. The decoder checks ranges; who encodes owes them."
    return cpp.header(heading(SOURCE, doc), includes, NAMESPACE, parts)


def _apart_layers() -> str:
    doc = "The folders of layers that a frame is taken apart into, lowest first."
    names = ", ".join(f'"{name}"' for name, _ in LAYERS)
    parts = [f"constexpr std::array<const char*, {len(LAYERS)}> ApartLayers = {{{{{names}}}}};\n"]
    source = "worker/lampblack/composite/apart.py"
    return cpp.header(heading(source, doc), ["#include <array>"], NAMESPACE, parts)


def _fields() -> str:
    translator = _translator()
    described = [cpp.describe(kind, translator) for kind in STRUCTS]
    types = ", ".join(
        f'{{"{name}", {", ".join(str(name in kinds).lower() for kinds in BY_SENDER.values())}}}'
        for name in MESSAGES
    )
    parts = [
        *(cpp.choices(f"{name}Choices", name, words) for words, name in ENUMS.items()),
        *(cpp.choices(name, *some) for name, some in translator.choices.items()),
        cpp.patterns(translator),
        *described,
        "struct MessageType\n{\nconst char* name;\nbool fromClient;\nbool fromWorker;\n};\n",
        "/// In the order of Message's alternatives.\n"
        f"constexpr std::array<MessageType, {len(MESSAGES)}> MessageTypes = {{{{{types}}}}};\n",
    ]
    includes = ["protocol/field_forms.h", "protocol/generated/messages.h"]
    includes += ["scene/generated/scene_fields.h", "scene/json_text.h"]
    doc = "The fields of every message and their ranges (SPEC 8), once for reading and for writing."
    return cpp.header(
        heading(SOURCE, doc), [f'#include "{name}"' for name in includes], NAMESPACE, parts
    )


def _error_codes() -> str:
    decoding = [code.value for code, entry in CATALOGUE.items() if entry.decoding]
    names = ", ".join(f'"{code}"' for code in decoding)
    parts = [
        cpp.enum("ErrorCode", tuple(decoding)),
        f"""/// The code's name on the wire, such as "bad_field".
inline QString name(ErrorCode code)
{{
    static constexpr std::array<const char*, {len(decoding)}> Names = {{{names}}};
    return QLatin1String(Names.at(static_cast<std::size_t>(code)));
}}
""",
    ]
    includes = ["#include <QString>", "", "#include <array>"]
    doc = "Why a message is refused (protocol/ERRORS.md): the codes that decoding can give."
    return cpp.header(heading(f"{SOURCE}/errors.py", doc), includes, NAMESPACE, parts)


def _limits() -> str:
    said = dict(re.findall(r"^ +(\w+): (.*)$", Limits.__doc__ or "", re.MULTILINE))
    members = (
        f"qint64 {camel(field.name)} = {field.default}; ///< {said[field.name]}"
        for field in dataclasses.fields(Limits)
    )
    struct = "\n".join(["struct Limits", "{", *members, "};", ""])
    doc = limits.__doc__ or ""
    source = f"{SOURCE}/limits.py"
    return cpp.header(heading(source, doc), ["#include <QtGlobal>"], NAMESPACE, [struct])
