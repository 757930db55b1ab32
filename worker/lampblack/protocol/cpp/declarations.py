"""C++ declarations: enumerations, structs, and functions that describe a struct's fields."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from types import ModuleType
from typing import Literal, get_args, get_origin

from .fields import fields_of
from .members import Translator, Words, struct_name
from .text import comment, pascal


def enums_in(modules: Iterable[ModuleType]) -> dict[Words, str]:
    """The named ``Literal`` types of modules, by their words."""
    return {
        get_args(value): name.removesuffix("Name")
        for module in modules
        for name, value in vars(module).items()
        if get_origin(value) is Literal
    }


def enum(name: str, words: Words) -> str:
    """An enumeration with a value for each word."""
    return f"enum class {name}\n{{\n{', '.join(map(pascal, words))}\n}};\n"


def choices(name: str, enum: str, words: Words) -> str:
    """The JSON words of an enumeration's values."""
    pairs = ", ".join(f'{{"{word}", {enum}::{pascal(word)}}}' for word in words)
    return f"constexpr std::array<Choice<{enum}>, {len(words)}> {name} = {{{{{pairs}}}}};\n"


def struct(kind: type, translator: Translator) -> str:
    """A struct with a member for each field."""
    return "\n".join([comment(kind.__doc__ or ""), *_struct(kind, translator), ""])


def _struct(kind: type, translator: Translator) -> Iterator[str]:
    name = struct_name(kind)
    yield f"struct {name}\n{{"
    for field in fields_of(kind):
        member = translator.member(name, field)
        yield member.declaration + (f" ///< {member.note}" if member.note else "")
    yield "};"


def describe(kind: type, translator: Translator) -> str:
    """The function that visits a struct's fields, to read, write or change them."""
    name = struct_name(kind)
    calls = [translator.member(name, field).call for field in fields_of(kind)]
    head = f"template <class Fields> void describe(Fields& fields, {name}& value)"
    return "\n".join([head, "{", *calls, "}", ""])


def patterns(translator: Translator) -> str:
    """All regular expressions of a library, each compiled once."""
    members = (
        f'QRegularExpression {name}{{QStringLiteral(R"({expression})")}};'
        for expression, name in translator.patterns.items()
    )
    return f"""struct Patterns
{{
{chr(10).join(members)}
}};

inline const Patterns& patterns()
{{
    static const Patterns all;
    return all;
}}
"""


def header(heading: str, includes: Iterable[str], namespace: str, parts: Iterable[str]) -> str:
    """A complete header file."""
    return f"""{heading}
#pragma once

{chr(10).join(includes)}

namespace {namespace}
{{

{chr(10).join(parts)}
}} // namespace {namespace}
"""
