"""Write the conformance cases of ``vectors/``, the same bytes each time.

Run as ``python protocol/make_vectors.py [FOLDER] [--every-fault]``. A case is one message that
every implementation must accept, and understand alike, or refuse with one code (SPEC.md,
section 9). Of the faults that a field can have, one is committed; ``--every-fault`` writes all.
"""

from __future__ import annotations

import argparse
import json
import shutil
from pathlib import Path

from cases.accepted import accepted
from cases.case import Case, Tree, compact
from cases.fields import rejected_fields
from cases.planes import rejected_planes
from cases.values import rejected_scenes, rejected_values
from cases.wire import rejected_frames, rejected_json, rejected_types

from lampblack.protocol import decode
from lampblack.protocol.conformance import understood
from lampblack.scene import Scene, decode_scene, encode_scene
from lampblack.timeline import scene_at


def write(folder: Path, *, every_fault: bool = False) -> None:
    """Write every case, and remove those that are no more."""
    kinds = {
        "accept": [*accepted()],
        "reject": [
            *rejected_frames(),
            *rejected_json(),
            *rejected_types(),
            *rejected_fields(every_fault),
            *rejected_scenes(),
            *rejected_values(),
            *rejected_planes(),
        ],
    }
    for kind, cases in kinds.items():
        shutil.rmtree(folder / kind, ignore_errors=True)
        for case in cases:
            place = folder / kind / case.name
            place.mkdir(parents=True)  # fails on a name used twice
            write_case(place, case)


def write_case(place: Path, case: Case) -> None:
    """Write one case's frames and what is expected of them."""
    frames: list[bytes] = []
    if case.header is not None:
        header = case.header if isinstance(case.header, bytes) else compact(case.header)
        (place / "header.json").write_bytes(header)
        frames = [header, *case.planes]
    for index, payload in enumerate(case.planes):
        (place / f"plane{index}.bin").write_bytes(payload)
    expected: Tree = {"sender": case.sender}
    if case.code:
        expected["code"] = case.code
        if case.limits:
            expected["limits"] = case.limits
    else:
        expected |= understood(decode(frames, case.sender))
    write_json(place / "expected.json", expected)
    if case.frames:
        scene = decode_scene(json.dumps(expected["message"]["scene"]).encode())
        write_json(place / "scene_at.json", [at(scene, frame) for frame in case.frames])


def at(scene: Scene, frame: int) -> Tree:
    """Lights and floor of ``scene`` as they are at ``frame``."""
    still = json.loads(encode_scene(scene_at(scene, frame)))
    return {"frame": frame, "lights": still["lights"], "floor": still["floor"]}


def write_json(path: Path, value: object) -> None:
    path.write_text(json.dumps(value, indent=2) + "\n", encoding="utf-8")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Write the conformance cases.")
    parser.add_argument("folder", type=Path, nargs="?", default=Path(__file__).parent / "vectors")
    parser.add_argument("--every-fault", action="store_true")
    options = parser.parse_args()
    write(options.folder, every_fault=options.every_fault)
