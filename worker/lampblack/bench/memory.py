"""Peak memory of this process and of the children it has waited for."""

from __future__ import annotations

import resource


def peak_gib() -> float:
    """Upper bound on memory held at once, GiB: this process's peak plus the largest child's."""
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    child = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    return round((own + child) / 2**20, 2)
