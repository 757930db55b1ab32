"""Where things are in the checkout and in its build."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).parents[2]
BUILD = Path(os.environ.get("LAMPBLACK_BUILD", ROOT / "build" / "dev"))
