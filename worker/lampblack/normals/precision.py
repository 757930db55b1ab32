"""The number format of inference and training: bf16 where the processor has it, else float32."""

from __future__ import annotations

from functools import cache

import torch


@cache
def has_bf16() -> bool:
    """Whether the processor multiplies bf16. Emulated bf16 (AVX2 only) is 3 to 6 times slower than
    float32 in prediction, and 11 to 14 times in training."""
    can = torch.cpu.get_capabilities()
    return bool(can.get("avx512_bf16") or can.get("amx_bf16"))


def fast_arithmetic() -> torch.autocast:
    """A context in which convolutions and matrix products use the faster format."""
    return torch.autocast("cpu", torch.bfloat16, enabled=has_bf16())
