"""The golden vectors: what they expect, that every check is needed, that they are reproducible."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from types import FunctionType
from typing import Any

import msgspec
import pytest

from lampblack.protocol import CATALOGUE, Limits, Message, checks, codec, decode, encode, header
from lampblack.scene import default_scene
from support import conformance
from support.conformance import VECTORS, cases, compare, differs, frames_of, verdict

ACCEPT = [case for case in cases() if case.parent.name == "accept"]
REJECT = [case for case in cases() if case.parent.name == "reject"]


@pytest.mark.parametrize("case", cases(), ids=lambda case: f"{case.parent.name}/{case.name}")
def test_case(case: Path) -> None:
    assert not differs(case, verdict(case))


def test_there_are_enough() -> None:
    assert len(ACCEPT) >= 25
    assert len(REJECT) >= 40


def test_every_code_of_decoding_is_refused_somewhere() -> None:
    proven = {json.loads((case / "expected.json").read_text())["code"] for case in REJECT}
    assert proven == {code.value for code, entry in CATALOGUE.items() if entry.decoding}


def test_every_message_is_accepted_somewhere() -> None:
    types = {json.loads((c / "expected.json").read_text())["message"]["type"] for c in ACCEPT}
    assert types == set(codec.MESSAGES)


@pytest.mark.parametrize("case", ACCEPT, ids=lambda case: case.name)
def test_round_trip(case: Path) -> None:
    sender = json.loads((case / "expected.json").read_text())["sender"]
    message, planes, layers = decode(frames_of(case), sender)
    frames = encode(message, planes, layers)
    again = decode(frames, sender)
    assert encode(*again) == frames
    assert untied(again.message) == untied(message)
    assert {role: p.tolist() for role, p in again.planes.items()} == {
        role: p.tolist() for role, p in planes.items()
    }
    assert [p.tolist() for p in again.layers] == [p.tolist() for p in layers]


def untied(message: Message) -> Message:
    """The message without its strides: padding is not sent on."""
    planes = tuple(
        msgspec.structs.replace(plane, stride=plane.row_bytes)
        for plane in getattr(message, "planes", ())
    )
    return msgspec.structs.replace(message, planes=planes) if planes else message


def test_regenerating_gives_the_same_bytes(tmp_path: Path) -> None:
    make_vectors(str(tmp_path))
    assert contents(tmp_path) == contents(VECTORS)


def test_every_fault_of_every_field_is_refused(tmp_path: Path) -> None:
    make_vectors(str(tmp_path), "--every-fault")
    every = cases(tmp_path)
    assert sum(case.name.startswith("field-") for case in every) > 400
    assert [fault for case in every if (fault := differs(case, verdict(case)))] == []


def make_vectors(*arguments: str) -> None:
    program = VECTORS.parent / "make_vectors.py"
    subprocess.run([sys.executable, str(program), *arguments], check=True, timeout=120)


def contents(folder: Path) -> dict[str, bytes]:
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def test_the_runner_compares(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("support.conformance.cases", lambda: ACCEPT[:2])
    assert compare([sys.executable, conformance.__file__, "decode"]) == 0
    assert compare([sys.executable, "-c", "print('{}'); print('{}')"]) == 2
    assert "0 of 2" in capsys.readouterr().out


def lenient_json(text: bytes) -> dict[str, Any]:
    tree: dict[str, Any] = json.loads(text.decode(errors="replace"), strict=False)
    return tree


def unchecked(tree: dict[str, Any], kind: type[Message]) -> Message:
    return kind(**{f: tree[f] for f in kind.__struct_fields__ if f in tree})


STAGES: dict[str, tuple[str, Any]] = {
    "json": ("parse_header", lenient_json),
    "numbers that vanish": ("_PARSER", msgspec.json.Decoder()),
    "fields": ("read_message", unchecked),
    "scene": ("read_scene", lambda tree: default_scene(8, 8)),
}


@pytest.mark.parametrize("check", [check.__name__ for check in checks.CHECKS])
def test_every_check_is_needed(check: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checks, check, lambda *arguments: None)
    assert some_case_is_misjudged()


@pytest.mark.parametrize("stage", STAGES)
def test_every_stage_is_needed(stage: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(header, *STAGES[stage])
    assert some_case_is_misjudged()


def some_case_is_misjudged() -> bool:
    def misjudged(case: Path) -> bool:
        try:
            return bool(differs(case, verdict(case)))
        except Exception:
            return True

    return any(map(misjudged, REJECT))


def test_every_check_is_called_and_listed() -> None:
    called = [name for name in codec.__dict__["_read"].__code__.co_names if hasattr(checks, name)]
    called += [name for name in codec.decode.__code__.co_names if hasattr(checks, name)]
    listed = {check.__name__ for check in checks.CHECKS}
    assert listed == {n for n, f in vars(checks).items() if is_own_function(f)}
    assert listed <= set(called)


def is_own_function(value: object) -> bool:
    return isinstance(value, FunctionType) and value.__module__ == checks.__name__


def test_the_header_may_be_exactly_as_long_as_allowed() -> None:
    (text,) = frames_of(VECTORS / "accept" / "cancel-from-client")
    limit = Limits().header_bytes
    decode([text.ljust(limit)], "client")
    with pytest.raises(codec.ProtocolError) as refused:
        decode([text.ljust(limit + 1)], "client")
    assert refused.value.code == codec.ErrorCode.HEADER_TOO_LARGE
