"""The protocol's version, independent of the package's, and the first bytes of every header."""

from __future__ import annotations

MAJOR = 1
MINOR = 4

MAGIC = b'{"lampblack":'
PREFIX = MAGIC + str(MAJOR).encode() + b","
"""A header begins with exactly these bytes, so its version is known before parsing."""
