"""Messages to refuse before their fields are looked at: frames, first bytes, JSON, types."""

from __future__ import annotations

from collections.abc import Iterator

from lampblack.protocol import Sender
from lampblack.protocol.messages import BY_SENDER

from .case import Case
from .samples import DRAWING, PIXELS, SAMPLES, payloads, put_frame

CANCEL = b'{"lampblack":1,"type":"cancel","request":5}'


def rejected_frames() -> Iterator[Case]:
    """Sizes and first bytes."""
    yield Case("no-frames", "client", None, code="bad_frame_count")
    yield Case("22-frames", "client", put_frame(DRAWING), (b"x",) * 21, "bad_frame_count")
    yield Case(
        "header-too-large", "client", CANCEL + b" ", (), "header_too_large", {"header_bytes": 43}
    )
    yield Case(
        "plane-too-large",
        "client",
        put_frame(DRAWING),
        (PIXELS.tobytes(),),
        "plane_too_large",
        {"plane_bytes": 59},
    )
    for name, header in {
        "header-empty": b"",
        "header-blank-first": b" " + CANCEL,
        "header-byte-order-mark": b"\xef\xbb\xbf" + CANCEL,
        "header-utf-16": CANCEL.decode().encode("utf-16-le"),
        "header-array": b"[1]",
        "header-without-magic": b'{"type":"cancel","request":5}',
        "header-magic-not-first": b'{"type":"cancel","request":5,"lampblack":1}',
        "header-binary": bytes(range(64)),
    }.items():
        yield Case(name, "client", header, code="not_lampblack")
    for name, header in {
        "version-0": CANCEL.replace(b":1,", b":0,"),
        "version-2": CANCEL.replace(b":1,", b":2,"),
        "version-10": CANCEL.replace(b":1,", b":10,"),
        "version-with-minor": CANCEL.replace(b":1,", b":1.0,"),
        "version-unparsable-after": b'{"lampblack":2,\xff\xfe[[[',
        "version-missing": b'{"lampblack":',
    }.items():
        yield Case(name, "client", header, code="version_mismatch")


def rejected_json() -> Iterator[Case]:
    """What some parser takes for JSON."""

    def raw(name: str, rest: bytes, code: str) -> Case:
        return Case(name, "client", b'{"lampblack":1,' + rest, code=code)

    cancel = b'"type":"cancel","request":5'
    for name, rest in {
        "json-cut-short": cancel,
        "json-trailing-bytes": cancel + b"} x",
        "json-trailing-nul": cancel + b"}\0",
        "json-second-document": cancel + b"}{}",
        "json-trailing-comma": cancel + b",}",
        "json-no-members": b"}",
        "json-comment": cancel + b"/* */}",
        "json-single-quotes": b"'type':'cancel','request':5}",
        "json-form-feed-between": b"\x0c" + cancel + b"}",
        "json-nan": b'"type":"cancel","request":NaN}',
        "json-infinity": cancel + b',"x":-Infinity}',
        "json-leading-zero": b'"type":"cancel","request":05}',
        "json-plus-sign": b'"type":"cancel","request":+5}',
        "json-no-digit-before-point": cancel + b',"x":.5}',
        "json-no-digit-after-point": cancel + b',"x":5.}',
        "json-no-digit-after-minus": cancel + b',"x":-.5}',
        "json-hexadecimal": b'"type":"cancel","request":0x5}',
        "json-true-capital": cancel + b',"x":True}',
        "json-string-line-feed": b'"type":"bye","reason":"a\nb"}',
        "json-string-nul": b'"type":"bye","reason":"a\0b"}',
        "json-string-unknown-escape": b'"type":"bye","reason":"\\x41"}',
        "json-string-short-escape": b'"type":"bye","reason":"\\u00e"}',
        "json-string-unended": b'"type":"bye","reason":"a}',
        "json-lone-high-surrogate": b'"type":"bye","reason":"\\ud800"}',
        "json-lone-low-surrogate": b'"type":"bye","reason":"\\udc00\\ud800"}',
        "json-lone-surrogate-before-escape": b'"type":"bye","reason":"\\ud83d\\n"}',
        "json-lone-surrogate-in-key": cancel + b',"\\ud800":1}',
        "json-utf8-invalid": b'"type":"bye","reason":"\xff"}',
        "json-utf8-overlong": b'"type":"bye","reason":"\xc0\x80"}',
        "json-utf8-surrogate": b'"type":"bye","reason":"\xed\xa0\x80"}',
        "json-utf8-cut-short": b'"type":"bye","reason":"\xe2\x82"}',
    }.items():
        yield raw(name, rest, "bad_json")
    yield raw("json-33-levels", cancel + b',"x":' + b"[" * 32 + b"]" * 32 + b"}", "too_deep")
    yield raw("json-levels-never-closed", b'"x":' + b"[" * 4000, "too_deep")
    yield raw("json-levels-of-objects", b'"x":' + b'{"":' * 2000, "too_deep")
    for name, number in {
        "number-2-to-the-53": b"9007199254740992",
        "number-2-to-the-53-negative": b"-9007199254740992",
        "number-beyond-64-bits": b"18446744073709551616",
        "number-of-5000-digits": b"9" * 5000,
        "number-large-real": b"1e30",
        "number-overflows": b"1e999",
        "number-vanishes": b"1e-999",
    }.items():
        yield raw(name, cancel + b',"x":[{"y":' + number + b"}]}", "bad_number")
    yield raw("number-in-id", b'"type":"cancel","request":9007199254740993}', "bad_number")
    yield raw(
        "number-vanishes-in-dropped-key",
        b'"type":"cancel","request":1e-999,"request":5}',
        "bad_number",
    )


def rejected_types() -> Iterator[Case]:
    """Types that there are not, and types from the wrong side."""
    for name, tree in {
        "type-missing": {"request": 5},
        "type-null": {"type": None, "request": 5},
        "type-number": {"type": 7, "request": 5},
        "type-unknown": {"type": "telepathy", "request": 5},
        "type-capital": {"type": "Cancel", "request": 5},
        "type-empty": {"type": ""},
        "type-object": {"type": {"type": "cancel"}, "request": 5},
    }.items():
        yield Case(name, "client", tree, code="unknown_type")
    other: dict[Sender, Sender] = {"client": "worker", "worker": "client"}
    for sender, trees in SAMPLES.items():
        for tree in trees:
            if tree["type"] not in BY_SENDER[other[sender]]:
                yield Case(
                    f"direction-{tree['type']}-from-{other[sender]}",
                    other[sender],
                    tree,
                    payloads(tree),
                    "wrong_direction",
                )
