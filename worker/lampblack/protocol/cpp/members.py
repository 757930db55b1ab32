"""From a field of a Python type to a member of a C++ struct and the call that handles it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin

from msgspec import Meta

from ..limits import MAX_NUMBER
from ..planes import MAX_INT32
from .fields import REQUIRED, Field, is_struct, unwrapped
from .text import camel, pascal

Words = tuple[str, ...]


@dataclass(frozen=True)
class Form:
    """A Qt type that represents a Python type; the conversion is in field_forms.h.

    Attributes:
        hint: the Python type.
        type: the Qt type.
        initial: makes an initializer of the Qt type from a Python value.
    """

    hint: Any
    type: str
    initial: Callable[[Any], str]


@dataclass(frozen=True)
class Member:
    """A member of a struct.

    Attributes:
        declaration: its type, name and default.
        note: its meaning and its range.
        call: the statement that reads or writes the member of ``value``.
    """

    declaration: str
    note: str
    call: str


@dataclass(frozen=True)
class _Rule:
    """The C++ representation of a type, and its checks.

    Attributes:
        type: C++ type.
        method: method of JsonReader and JsonWriter.
        arguments: further arguments of the method, after name and value.
        blank: initializer without a default.
        range: range, for people.
    """

    type: str
    method: str
    arguments: tuple[str, ...] = ()
    blank: str = "{}"
    range: str = ""


@dataclass
class Translator:
    """Translates the types of one library.

    Attributes:
        enums: names of enumerations, by their JSON words.
        forms: types that are Qt types in C++.
        patterns: names of the regular expressions so far.
        choices: lists with a part of an enumeration's words so far, by name.
    """

    enums: Mapping[Words, str]
    forms: tuple[Form, ...] = ()
    patterns: dict[str, str] = field(default_factory=dict)
    choices: dict[str, tuple[str, Words]] = field(default_factory=dict)

    def member(self, owner: str, field: Field) -> Member:
        """The member for a field of the struct ``owner``."""
        name = camel(field.name)
        if field.name == "extra":
            return Member("QJsonObject extra = {};", "", "fields.rest(value.extra);")
        rule = self._rule(field.hint, owner, name)
        form = next((form for form in self.forms if _is(field.hint, form.hint)), None)
        optional = field.default is not REQUIRED and not rule.type.startswith("std::optional")
        arguments = [f'"{field.wire}"', f"value.{name}", *rule.arguments]
        arguments += ["Need::Optional"] if optional and rule.method != "listIfAny" else []
        if form:
            rule = replace(rule, type=form.type, blank="{}")
            call = f"{rule.method}(fields, {', '.join(arguments)});"
        else:
            call = f"fields.{rule.method}({', '.join(arguments)});"
        if field.default is REQUIRED:
            initial = rule.blank
        else:
            initial = form.initial(field.default) if form else self._initial(field)
        said = unwrapped(field.hint)[1].description
        note = ", ".join(filter(None, (said, rule.range)))
        return Member(f"{rule.type} {name} = {initial};", note, call)

    def _rule(self, hint: Any, owner: str, name: str) -> _Rule:
        base, meta = unwrapped(hint)
        origin, inner = get_origin(base), get_args(base)
        if base is bool:
            return _Rule("bool", "boolean", blank="false")
        if base in (int, float):
            return _number(base, meta)
        if base is str:
            return _Rule("QString", "text", self._lengths(meta, name))
        if origin is Literal:
            choices = self._choices(inner, owner, name)
            return _Rule(self._enum(inner), "choice", (choices,), self._word(inner, inner[0]))
        if origin in (Union, UnionType) and type(None) in inner:
            (some,) = (option for option in inner if option is not type(None))
            rule = self._rule(some, owner, name)
            if rule.method in ("integer", "object"):
                return replace(rule, type=f"std::optional<{rule.type}>", blank="{}")
        if origin is tuple:
            return self._sequence(inner, meta, owner, name)
        if origin is dict:
            pattern, most = self._lengths(unwrapped(inner[0])[1], name)[2], str(meta.max_length)
            return _Rule(f"QMap<QString, {inner[1].__name__}>", "map", (most, pattern))
        if is_struct(base):
            return _Rule(struct_name(base), "object")
        raise TypeError(f"{owner}.{name}: there is no C++ for {hint}")

    def _sequence(self, inner: Any, meta: Meta, owner: str, name: str) -> _Rule:
        if inner[-1] is not Ellipsis:
            _, low, high = inner[0], *_number(*unwrapped(inner[0])).arguments
            return _Rule(f"std::array<double, {len(inner)}>", "reals", (low, high))
        item, most = self._rule(inner[0], owner, name), str(meta.max_length)
        if item.type == "double":
            return _Rule("QVector<double>", "reals", (most, *item.arguments), range=item.range)
        if item.type == "QString":
            return _Rule("QStringList", "texts", (most, *item.arguments[1:]))
        method = "listIfAny" if name == "keys" else "list"
        return _Rule(f"QVector<{item.type}>", method, (most,), range=f"{most} at most")

    def _lengths(self, meta: Meta, name: str) -> tuple[str, ...]:
        """Shortest and longest length, and the regular expression if there is one."""
        lengths = (str(meta.min_length or 0), str(meta.max_length))
        if meta.pattern is None:
            return lengths
        # $ also matches before a final line feed.
        expression = meta.pattern.removesuffix(r"(?!\n)") + r"(?!\n)"
        return (*lengths, f"patterns().{self.patterns.setdefault(expression, name)}")

    def _enum(self, words: Words) -> str:
        """The enumeration with exactly these words, or with these and others."""
        names = [name for known, name in self.enums.items() if {*words} <= {*known}]
        if not names:
            raise TypeError(f"Literal{[*words]} needs a name: Name = Literal[...] in its module")
        return self.enums.get(words, names[0])

    def _choices(self, words: Words, owner: str, name: str) -> str:
        enum = self._enum(words)
        if words in self.enums:
            return f"{enum}Choices"
        choices = f"{owner}{pascal(name)}Choices"
        self.choices[choices] = (enum, words)
        return choices

    def _word(self, words: Words, word: str) -> str:
        return f"{self._enum(words)}::{pascal(word)}"

    def _initial(self, field: Field) -> str:
        value, base = field.default, unwrapped(field.hint)[0]
        if get_origin(base) is Literal:
            return self._word(get_args(base), value)
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, int | float):
            return number(value)
        if value in (None, "", (), {}) or (is_struct(base) and value == base()):
            return "{}"
        raise TypeError(f"{field.name}: there is no C++ for the default {value!r}")


def struct_name(kind: type) -> str:
    """Its name in C++: ``ErrorMessage`` is ``Error``, as on the wire."""
    return kind.__name__.removesuffix("Message")


def number(value: float) -> str:
    """A C++ literal."""
    if value == MAX_NUMBER:
        return "MaxNumber"
    return str(int(value)) if value == int(value) else repr(value)


def _number(base: type, meta: Meta) -> _Rule:
    low, high = meta.ge, meta.le
    if low is None or high is None:
        raise TypeError("a number needs a range: Annotated[..., Meta(ge=..., le=...)]")
    if base is float:
        kind, method = "double", "real"
    else:
        kind, method = ("int" if high <= MAX_INT32 else "quint64"), "integer"
    within = "" if high == MAX_NUMBER else f"{number(low)} to {number(high)}"
    blank = number(min(max(0, low), high))
    return _Rule(kind, method, (number(low), number(high)), blank, within)


def _is(hint: Any, form: Any) -> bool:
    """Whether ``hint`` is the type ``form``, or an ``Annotated`` of it."""
    metadata = getattr(form, "__metadata__", ())
    same = getattr(hint, "__metadata__", ())[: len(metadata)] == metadata
    return same and unwrapped(hint)[0] == unwrapped(form)[0]
