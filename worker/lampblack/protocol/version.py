"""The protocol's version, which is not the package's, and the bytes every header begins with."""

from __future__ import annotations

MAJOR = 1
MINOR = 0

MAGIC = b'{"lampblack":'
PREFIX = MAGIC + str(MAJOR).encode() + b","
"""A header begins with exactly these bytes: whom it is for is known before it is parsed."""
