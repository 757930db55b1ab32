"""The conformance program of the Python decoder, and the runner that compares any program.

``python tests/support/conformance.py decode CASE...`` prints one line of JSON for each case folder:
what the decoder made of it, ``{"code": ...}`` or ``{"message": ..., "planes": ...}``.

``python tests/support/conformance.py compare [PROGRAM...]`` runs PROGRAM (this one if left out) on
every case of ``protocol/vectors`` and compares its lines with what is expected.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from lampblack.protocol import Limits, ProtocolError, decode
from lampblack.protocol.conformance import understood

VECTORS = Path(__file__).parents[2] / "protocol" / "vectors"


def cases(folder: Path = VECTORS) -> list[Path]:
    """Every case folder, accepted ones first."""
    return [*sorted((folder / "accept").iterdir()), *sorted((folder / "reject").iterdir())]


def frames_of(case: Path) -> list[bytes]:
    """The frames of a case's message."""
    files = [
        case / "header.json",
        *sorted(case.glob("plane*.bin"), key=lambda file: (len(file.name), file.name)),
    ]
    return [file.read_bytes() for file in files if file.exists()]


def expectation(case: Path) -> dict[str, Any]:
    """What ``expected.json`` says."""
    expected: dict[str, Any] = json.loads((case / "expected.json").read_text(encoding="utf-8"))
    return expected


def verdict(case: Path) -> dict[str, Any]:
    """What the decoder makes of a case."""
    expected = expectation(case)
    limits = Limits(**expected.get("limits", {}))
    try:
        return understood(decode(frames_of(case), expected["sender"], limits))
    except ProtocolError as error:
        return {"code": error.code.value}


def differs(case: Path, found: dict[str, Any]) -> str:
    """One sentence if ``found`` is not what was expected."""
    expected = expectation(case)
    wanted = {k: expected[k] for k in ("code", "message", "planes") if k in expected}
    if found == wanted:
        return ""
    return f"{case.parent.name}/{case.name}: {json.dumps(found)}, not {json.dumps(wanted)}"


def compare(program: Sequence[str]) -> int:
    """Run a conformance program on every case; how many it fails."""
    every = cases()
    ran = subprocess.run([*program, *map(str, every)], check=False, stdout=subprocess.PIPE)
    lines = ran.stdout.splitlines()
    faults = [
        fault
        for case, line in zip(every, lines, strict=False)
        if (fault := differs(case, json.loads(line)))
    ]
    faults += [f"{case.parent.name}/{case.name}: no answer" for case in every[len(lines) :]]
    sys.stdout.write("".join(f"{fault}\n" for fault in faults))
    sys.stdout.write(f"{len(every) - len(faults)} of {len(every)} cases as expected\n")
    return len(faults)


def main(arguments: Sequence[str]) -> int:
    """See the module's text."""
    match arguments:
        case ["decode", *folders]:
            for folder in folders:
                sys.stdout.write(json.dumps(verdict(Path(folder))) + "\n")
            return 0
        case ["compare", *program]:
            return min(1, compare(program or [sys.executable, __file__, "decode"]))
    sys.stderr.write(__doc__ or "")
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
