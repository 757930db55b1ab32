"""The graphics cards of this machine, and what came of a test picture on each.

``survey`` runs ``python -m lampblack.render.survey MEMORY`` in a child process, because a broken
driver may end it.
"""

from __future__ import annotations

import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import msgspec

from ..errors import RenderError
from .device import DRIVERS, Card, Memory, Verdict, judge, memory_path

MAX_CRASHES = 8
"""Each crash is blamed on one card, so that the next run gets further."""
SECONDS = 300
COMMAND = (sys.executable, "-I", "-m", "lampblack.render.survey")


class Found(msgspec.Struct, frozen=True):
    """A card, and whether it is used."""

    card: Card
    verdict: Verdict


def survey() -> list[Found]:
    """Every card of this machine by every way to it, tried anew; the verdicts are remembered.

    Raises:
        RenderError: they cannot be listed.
    """
    path = memory_path()
    with suppress(OSError):
        path.unlink()
    details = ""
    for _ in range(MAX_CRASHES):
        try:
            done = subprocess.run(
                [*COMMAND, str(path)], capture_output=True, timeout=SECONDS, check=False
            )
        except subprocess.TimeoutExpired:
            details = f"no answer in {SECONDS} seconds"
            continue
        details = done.stderr.decode(errors="replace").strip()[-500:]
        if done.returncode == 0:
            return msgspec.json.decode(done.stdout.rpartition(b"\n")[2], type=list[Found])
        searched = Memory(path).verdict(DRIVERS)
        if searched is None or searched.outcome == "trying":
            break
    raise RenderError(
        "The graphics cards could not be listed.", "Renew the card's driver.", details
    )


def main() -> None:
    """List the cards on stdout."""
    from .cards import find_cards
    from .trial import try_card

    memory = Memory(Path(sys.argv[1]))
    memory.remember(DRIVERS, Verdict("trying"))
    cards = find_cards()
    memory.remember(DRIVERS, Verdict("right"))
    found = [Found(card, judge(card, try_card, memory)) for card in cards]
    sys.stdout.write("\n")
    sys.stdout.flush()
    sys.stdout.buffer.write(msgspec.json.encode(found))


if __name__ == "__main__":
    main()
