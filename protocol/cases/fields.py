"""Messages to refuse for one field, derived from the schema: a new field brings its own."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

from lampblack.protocol.documents import message_schema
from lampblack.protocol.messages import BY_SENDER

from .case import Case, Tree
from .samples import SAMPLES, payloads


def rejected_fields(every_fault: bool) -> Iterator[Case]:
    """For each field of each message: left out if it must be there, null, of another type, and
    just past either end of its range; of these the last one, or all."""
    definitions = message_schema()["$defs"]
    for sender, trees in SAMPLES.items():
        for tree in trees:
            name = tree["type"]
            if name == "bye" and sender == "worker":
                continue
            definition = definitions[BY_SENDER[sender][name].__name__]
            cases = {}
            for path, why, wrong in field_faults(tree, definition, definitions, ()):
                label = "-".join(["field", name, *map(str, path)])
                key = f"{label}-{why}" if every_fault else label
                cases[key] = Case(f"{label}-{why}", sender, wrong, payloads(tree), code="bad_field")
            yield from cases.values()


Path_ = tuple[str | int, ...]


def field_faults(
    tree: Tree, definition: Tree, definitions: Tree, path: Path_
) -> Iterator[tuple[Path_, str, Tree]]:
    """Where, why, and the tree with this one fault."""
    here: Any = tree
    for step in path:
        here = here[step]
    for name, schema in definition["properties"].items():
        if name in ("lampblack", "type", "scene"):
            continue
        if name in definition["required"]:
            yield (*path, name), "missing", without(tree, (*path, name))
        for why, value in faults(schema, here.get(name)):
            yield (*path, name), why, with_value(tree, (*path, name), value)
        nested = schema if "$ref" in schema else schema.get("items") or {}
        if nested and "$ref" in nested and here.get(name):
            inner = definitions[nested["$ref"].rsplit("/", 1)[-1]]
            step: Path_ = (name,) if nested is schema else (name, 0)
            yield from field_faults(tree, inner, definitions, (*path, *step))


def faults(schema: Tree, value: Any) -> Iterator[tuple[str, Any]]:
    """Values that a field must not have, and why not."""
    if "anyOf" in schema:
        schema = next(option for option in schema["anyOf"] if option.get("type") != "null")
    else:
        yield "null", None
    kind = schema.get("type", "string" if "enum" in schema else "object")
    yield "type", {"string": 5, "integer": "5", "number": True}.get(kind, "x")
    if kind == "integer":
        yield "fraction", schema["minimum"] + 0.5
    if "minimum" in schema:
        yield "below", schema["minimum"] - (1 if kind == "integer" else 0.001)
        if schema["maximum"] < 9007199254740991:
            yield "above", schema["maximum"] + 1
    if "enum" in schema:
        yield "unknown", "telepathic"
    if "maxLength" in schema:
        fitting = value if isinstance(value, str) and value else "a"
        yield "long", fitting + fitting[-1] * (schema["maxLength"] + 1 - len(fitting))
    if "pattern" in schema:
        yield "pattern", "\n" + value
        yield "line-feed", value + "\n"
    if schema.get("minLength"):
        yield "short", ""
    if kind == "array":
        yield "items", [value[0]] * (schema["maxItems"] + 1)
        item = schema.get("items") or schema["prefixItems"][0]
        for why, wrong in faults(item, value[0]) if "$ref" not in item else ():
            yield f"item-{why}", [wrong, *value[1:]]


def with_value(tree: Tree, path: Path_, value: Any) -> Tree:
    """A deep copy with one value replaced."""
    tree = copy.deepcopy(tree)
    here: Any = tree
    for step in path[:-1]:
        here = here[step]
    here[path[-1]] = value
    return tree


def without(tree: Tree, path: Path_) -> Tree:
    """A deep copy with one member left out."""
    tree = with_value(tree, path, None)
    here: Any = tree
    for step in path[:-1]:
        here = here[step]
    del here[path[-1]]
    return tree
