"""The scene in C++: structs, their equality, their fields in JSON, and interpolation of keys."""

from __future__ import annotations

from typing import get_args

from ... import choices as words
from ... import scene, timeline
from ...looks import PRESETS, preset
from ...scene import Colour, Rig, Scene, Style, encode_style
from . import declarations as cpp
from .fields import fields_of, structs_in, unwrapped
from .members import Form, Translator
from .text import camel, heading, pascal

SOURCE = "worker/lampblack/scene/"
NAMESPACE = "lampblack"
CONSTANTS = ("MAX_LIGHTS", "MAX_KEYS", "MAX_JSON_BYTES")

COLOUR = Form(Colour, "QColor", lambda colour: f"QColor(0x{colour[1:]})")
STRUCTS = structs_in([Scene, Rig, Style])
ENUMS = {
    words: name
    for words, name in cpp.enums_in([words]).items()
    if any(words == get_args(unwrapped(f.hint)[0]) for kind in STRUCTS for f in fields_of(kind))
}


def files() -> dict[str, str]:
    """Every generated file of the library, by its path in the plugin's folder."""
    return {
        "scene/generated/scene_types.h": _types(),
        "scene/generated/scene_types.cpp": _equality(),
        "scene/generated/scene_fields.h": _fields(),
        "scene/generated/scene_keys.h": _keys(),
        "scene/generated/style_presets.h": _styles(),
    }


def _translator() -> Translator:
    return Translator(ENUMS, (COLOUR,))


def _types() -> str:
    names = [kind.__name__ for kind in STRUCTS]
    parts = [
        "\n".join(f"constexpr int {pascal(n)} = {getattr(scene, n)};" for n in CONSTANTS) + "\n",
        *(cpp.enum(name, words) for words, name in ENUMS.items()),
        *(cpp.struct(kind, _translator()) for kind in STRUCTS),
        "\n".join(f"bool operator==(const {name}& a, const {name}& b);" for name in names) + "\n",
    ]
    includes = [f"#include <{name}>" for name in ("QColor", "QJsonObject", "QMap", "QString")]
    includes += ["#include <QVector>", "", "#include <optional>"]
    return cpp.header(heading(SOURCE, scene.__doc__ or ""), includes, NAMESPACE, parts)


def _equality() -> str:
    parts = []
    for kind in STRUCTS:
        name, members = kind.__name__, [camel(field.name) for field in fields_of(kind)]
        sides = (f"std::tie({', '.join(f'{side}.{m}' for m in members)})" for side in "ab")
        head = f"bool operator==(const {name}& a, const {name}& b)"
        parts.append(f"{head}\n{{\n    return {' == '.join(sides)};\n}}\n")
    return f"""{heading(SOURCE, "Scenes are equal if every field is.")}
#include "scene/generated/scene_types.h"

#include <tuple>

namespace {NAMESPACE}
{{

{chr(10).join(parts)}
}} // namespace {NAMESPACE}
"""


def _fields() -> str:
    translator = _translator()
    described = [cpp.describe(kind, translator) for kind in STRUCTS]
    parts = [
        *(cpp.choices(f"{name}Choices", name, words) for words, name in ENUMS.items()),
        cpp.patterns(translator),
        *described,
    ]
    includes = ["field_forms.h", "generated/scene_types.h", "json_reader.h"]
    doc = "The scene's fields and their ranges, once for reading, writing and clamping."
    return cpp.header(
        heading(SOURCE, doc), [f'#include "scene/{name}"' for name in includes], NAMESPACE, parts
    )


def _styles() -> str:
    doc = "The styles that come with Lampblack, as JSON."
    names = ", ".join(f'"{name}"' for name in PRESETS)
    texts = ",\n".join(f'R"({encode_style(preset(name)).decode().strip()})"' for name in PRESETS)
    count = len(PRESETS)
    parts = [
        f"constexpr std::array<const char*, {count}> StyleNames = {{{{{names}}}}};\n",
        f"constexpr std::array<const char*, {count}> StyleTexts = {{{{\n{texts}}}}};\n",
    ]
    return cpp.header(heading(SOURCE, doc), ["#include <array>"], NAMESPACE, parts)


def _keys() -> str:
    doc = (
        "What keys change: `Keyed<AreaLight>::each(visit, a, b)` calls `visit(a.x, b.x)` and so on."
    )
    parts = ["template <class Thing> struct Keyed;\n"]
    for kind in STRUCTS:
        hints = {field.name: field.hint for field in fields_of(kind)}
        if "keys" in hints:
            key = get_args(unwrapped(hints["keys"])[0])[0]
            parts.append(_keyed(kind, key, hints))
    includes = ['#include "scene/generated/scene_types.h"']
    return cpp.header(heading(SOURCE, doc), includes, NAMESPACE, parts)


def _keyed(kind: type, key: type, hints: dict[str, object]) -> str:
    fields = [field for field in fields_of(key) if field.name in timeline.KEYED_FIELDS[key]]
    for field in fields:
        if unwrapped(hints[field.name]) != unwrapped(field.hint):
            raise TypeError(f"{kind.__name__}.{field.name} has another type than its key's")
    visits = "\n".join(f"visit(values.{camel(field.name)}...);" for field in fields)
    return f"""template <> struct Keyed<{kind.__name__}>
{{
    using Key = {key.__name__};

    template <class Visit, class... Values> static void each(const Visit& visit, Values&... values)
    {{
        {visits}
    }}
}};
"""
