"""The codec beyond its vectors: documents, digests, limits, and that nothing slips through."""

from __future__ import annotations

import copy
import hashlib
import json
import random
import re
from typing import Any

import numpy as np
import pytest

from lampblack.drawing.load import MAX_PIXELS, MAX_SIDE
from lampblack.protocol import (
    CATALOGUE,
    LIMITS,
    MAJOR,
    MINOR,
    Bye,
    ErrorCode,
    ErrorMessage,
    Image,
    Limits,
    NeedFrame,
    ProtocolError,
    PutFrame,
    SetScene,
    answer_to,
    decode,
    encode,
    error_message,
    frame_digest,
)
from lampblack.protocol.documents import documents
from lampblack.scene import Material, default_scene
from support.conformance import VECTORS, expectation, frames_of
from support.paths import ROOT

PROTOCOL = VECTORS.parent
ACCEPT = sorted((VECTORS / "accept").iterdir())


def test_what_is_committed_is_what_the_types_generate() -> None:
    """Schemas, tables, the error catalogue and the plugin's C++. ``make schema`` writes them."""
    written = documents(ROOT)
    stale = [path for path, text in written.items() if path.read_text(encoding="utf-8") != text]
    assert stale == []
    assert {*ROOT.glob("pencil2d_plugin/*/generated/*")} <= {*written}


def test_the_specification_names_its_version() -> None:
    title = (PROTOCOL / "SPEC.md").read_text(encoding="utf-8").splitlines()[0]
    assert title == f"# The Lampblack protocol, version {MAJOR}.{MINOR}"


def test_the_catalogue_knows_every_code() -> None:
    assert list(CATALOGUE) == list(ErrorCode)
    for code, entry in CATALOGUE.items():
        assert re.fullmatch("[a-z0-9_]{1,40}", code.value)
        assert entry.meaning.endswith(".")
        assert entry.remedy.endswith(".")
        (message,) = encode(error_message(code, details="x" * 9000))
        read = decode([message], "worker").message
        assert isinstance(read, ErrorMessage)
        assert (read.code, read.fatal) == (code.value, entry.fatal)


def test_planes_may_be_as_large_as_drawings() -> None:
    assert (LIMITS.side, LIMITS.pixels) == (MAX_SIDE, MAX_PIXELS)
    assert LIMITS.plane_bytes >= 4 * MAX_PIXELS
    assert LIMITS.frame_pixels >= 3 * MAX_PIXELS


def test_the_token_expression_of_the_specification() -> None:
    """What C++ must test before QJsonDocument: all we accept, and none of what only Qt takes."""
    text = (PROTOCOL / "SPEC.md").read_text(encoding="utf-8")
    (expression,) = re.findall(r"```\n(\(\?s\).*)\n```", text)
    tokens = re.compile(expression.encode())
    for case in ACCEPT:
        assert tokens.fullmatch(frames_of(case)[0]), case.name
    for name in (
        "json-no-digit-before-point",
        "json-no-digit-after-point",
        "json-no-digit-after-minus",
        "json-string-line-feed",
        "json-string-unknown-escape",
        "json-lone-high-surrogate",
        "json-lone-low-surrogate",
        "json-lone-surrogate-before-escape",
        "json-lone-surrogate-in-key",
    ):
        assert not tokens.fullmatch(frames_of(VECTORS / "reject" / name)[0]), name


def test_digest_is_what_the_specification_says() -> None:
    pixels = np.arange(24, dtype=np.uint8).reshape(2, 3, 4)
    mask = np.arange(6, dtype=np.uint8).reshape(2, 3)
    said = b"pixels rgba8 3x2\n" + bytes(range(24)) + b"mask a8 3x2\n" + bytes(range(6))
    expected = hashlib.blake2b(said, digest_size=20).hexdigest()
    assert frame_digest({"mask": mask, "pixels": pixels}) == expected
    assert frame_digest({"mask": mask, "pixels": pixels[:, ::-1][:, ::-1]}) == expected


def test_planes_come_as_read_only_views_the_right_way_round() -> None:
    pixels = np.arange(3 * 5 * 4, dtype=np.uint8).reshape(3, 5, 4)
    first, payload = encode(
        PutFrame(frame=1, digest=frame_digest({"pixels": pixels})), {"pixels": pixels}
    )
    writable = bytearray(payload)
    received = decode([memoryview(first), memoryview(writable)], "client")
    view = received.planes["pixels"]
    assert np.array_equal(view, pixels)
    assert np.shares_memory(view, np.frombuffer(writable, np.uint8))
    assert not view.flags.writeable


def test_encode_refuses_what_a_role_does_not_allow() -> None:
    grey = np.zeros((4, 4), np.uint8)
    with pytest.raises(ValueError, match="pixels"):
        encode(PutFrame(frame=1, digest="0" * 40), {"pixels": grey})
    with pytest.raises(ValueError, match="carries no planes"):
        encode(Bye(), {"mask": grey})


def test_a_scene_too_large_for_a_header_is_refused_by_its_sender() -> None:
    sheen = Material(glossy=True, extra={"note": 80 * "-"})
    many = {f"#{i:06x}": sheen for i in range(4000)}
    scene = SetScene(
        revision=1,
        scene=default_scene(8, 8).__class__(canvas=default_scene(8, 8).canvas, materials=many),
    )
    with pytest.raises(ProtocolError) as refused:
        encode(scene)
    assert refused.value.code == ErrorCode.HEADER_TOO_LARGE


def test_a_refusal_names_the_message_it_answers() -> None:
    with pytest.raises(ProtocolError) as refused:
        decode([b'{"lampblack":1,"type":"view","request":41,"frame":-1}'], "client")
    answer = answer_to(refused.value)
    assert (answer.code, answer.about, answer.request) == ("bad_field", "view", 41)
    assert "frame" in answer.details
    assert decode(encode(answer), "worker").message == answer


def test_limits_hold_before_anything_is_parsed() -> None:
    huge = memoryview(b"[" * 600_000)
    with pytest.raises(ProtocolError) as refused:
        decode([huge, b"x" * 9], "client", Limits(plane_bytes=8))
    assert refused.value.code == ErrorCode.HEADER_TOO_LARGE


NASTY: list[Any] = [
    None, True, False, 0, -1, 0.5, -0.0, 1e5, 1e30, -(1 << 53), (1 << 53) - 1, 1 << 64, "", "\0",
    "#ffffff", "#ffffff\n", "a" * 600, "é\U0001f58c", "\ud800", "NaN", "1-3", "9-1", "/a.%04d.png",
    "mask", "a8", "picture", 20_000, 1, [0] * 6,
    [], [[]], [0] * 7, [None], {}, {"x": {}}, {"type": "bye"}, float("nan"), float("inf"),
]  # fmt: skip


def test_mutated_messages_are_read_or_refused_and_nothing_else() -> None:
    """4,000 messages with a few mutations each: most still parse as JSON."""
    chance = random.Random(1952)
    samples = [(frames_of(case), expectation(case)["sender"]) for case in ACCEPT]
    parsed = read = 0
    refusals: set[ErrorCode] = set()
    for _ in range(4000):
        sample, sender = chance.choice(samples)
        frames = mutate(sample, chance)
        sender = "client" if chance.random() < 0.05 else sender
        parsed += parses(frames[0])
        try:
            received = decode(frames, sender)
        except ProtocolError as refused:
            refusals.add(refused.code)
            encode(answer_to(refused))
        else:
            read += 1
            decode(encode(*received), sender)
    assert parsed > 2000
    assert read > 400
    assert len(refusals) >= 11


def parses(header: bytes) -> bool:
    try:
        return isinstance(json.loads(header), dict)
    except (ValueError, RecursionError):
        return False


def mutate(frames: list[bytes], chance: random.Random) -> list[bytes]:
    header, *planes = frames
    if planes and chance.random() < 0.3:
        which = chance.randrange(len(planes))
        planes[which] = planes[which][chance.randrange(2) :][::-1]
    if chance.random() < 0.05:
        planes = [*planes, b"x"] * chance.randrange(4)
    if chance.random() < 0.25:
        data = bytearray(header)
        for _ in range(chance.randint(1, 3)):
            at = chance.randrange(15, len(data))
            data[at : at + chance.randrange(3)] = chance.choice(
                [b"", b"{", b"]", b'"', b",", b"\\", b"\0", b"\xff", b"9" * 20, b"e9", b"[" * 40]
            )
        return [bytes(data), *planes]
    tree = json.loads(header)
    for _ in range(chance.randint(0, 3)):
        shake(tree, chance)
    tree.pop("lampblack", None)
    return [b'{"lampblack":1,' + json.dumps(tree).encode()[1:], *planes]


def shake(tree: Any, chance: random.Random) -> None:
    """Change one value somewhere in the tree."""
    keys = list(tree) if isinstance(tree, dict) else list(range(len(tree)))
    if not keys:
        return
    key = chance.choice(keys)
    if isinstance(tree[key], dict | list) and chance.random() < 0.7:
        shake(tree[key], chance)
    elif chance.random() < 0.2:
        del tree[key]
    elif isinstance(tree, dict) and chance.random() < 0.2:
        tree[chance.choice(["type", "x", "request", "frame", "planes", "extra", ""])] = (
            copy.deepcopy(tree[key])
        )
    else:
        tree[key] = copy.deepcopy(chance.choice(NASTY))


def test_messages_cannot_be_changed() -> None:
    message = NeedFrame(frame=1, digest="0" * 40)
    with pytest.raises(AttributeError):
        message.frame = 2  # type: ignore[misc]


def test_an_image_needs_its_picture() -> None:
    planes = {"picture": np.zeros((2, 2, 4), np.uint8)}
    case = VECTORS / "accept" / "image-from-worker"
    image = decode(frames_of(case), "worker").message
    assert isinstance(image, Image)
    assert decode(encode(image, planes), "worker").planes["picture"].shape == (2, 2, 4)  # type: ignore[arg-type]
    with pytest.raises(ProtocolError, match="role"):
        decode(encode(image), "worker")
