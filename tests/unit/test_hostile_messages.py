"""The messages that the worker is pestered with are worth its while."""

from __future__ import annotations

import random

from lampblack.protocol import ProtocolError, decode
from support.hostile import hostile


def test_most_hostile_messages_get_past_json() -> None:
    early = {"bad_json", "not_lampblack", "bad_frame_count", "header_too_large", "plane_too_large"}
    past = 0
    for frames in hostile(random.Random(7), 1000):
        try:
            decode(frames, "client")
            past += 1
        except ProtocolError as error:
            past += error.code.value not in early
    assert past > 500
