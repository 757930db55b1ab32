"""Lampblack's network: predicts the normals of a whole character as a correction to Lumo's.

A residual U-Net. Its first level has a quarter of the canvas's resolution (pixels are folded
into channels). Its deepest has a thirty-second, with attention between all cells. The output
is added to Lumo's normals, so an untrained network equals that baseline. Training also predicts
the confidence of the normals (angular von Mises-Fisher, Bae 2021), depth, occlusion edges
with the side that is in front, and which ink is a mark that is no edge.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

from ..character import COARSE, COARSE_CHANNELS, FINE_CHANNELS, LUMO

WIDTHS = (64, 128, 224, 256)
ATTENTION_LAYERS = 4
HEADS = 4


class Residual(nn.Module):
    """Two convolutions with a residual connection."""

    def __init__(self, width: int, dilation: int = 1) -> None:
        super().__init__()
        self.body = nn.Sequential(
            nn.Conv2d(width, width, 3, padding=dilation, dilation=dilation, bias=False),
            nn.BatchNorm2d(width),
            nn.ReLU(inplace=True),
            nn.Conv2d(width, width, 3, padding=1, bias=False),
            nn.BatchNorm2d(width),
        )
        nn.init.zeros_(self.body[4].weight)  # type: ignore[arg-type]

    def forward(self, x: Tensor) -> Tensor:
        joined: Tensor = nn.functional.relu(x + self.body(x))
        return joined


class Attention(nn.Module):
    """A transformer layer over the cells of the deepest level."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.before = nn.LayerNorm(width)
        self.query_key_value = nn.Linear(width, 3 * width)
        self.joined = nn.Linear(width, width)
        self.between = nn.LayerNorm(width)
        self.wide = nn.Linear(width, 3 * width)
        self.narrow = nn.Linear(3 * width, width)
        for layer in (self.joined, self.narrow):
            nn.init.zeros_(layer.weight)
            nn.init.zeros_(layer.bias)

    def forward(self, cells: Tensor) -> Tensor:
        batch, count, width = cells.shape
        parts = self.query_key_value(self.before(cells))
        q, k, v = parts.view(batch, count, 3, HEADS, width // HEADS).permute(2, 0, 3, 1, 4)
        seen = nn.functional.scaled_dot_product_attention(q, k, v)
        cells = cells + self.joined(seen.transpose(1, 2).reshape(batch, count, width))
        hidden = nn.functional.gelu(self.wide(self.between(cells)))
        after: Tensor = cells + self.narrow(hidden)
        return after


def _convolution(before: int, after: int, kernel: int = 3, stride: int = 1) -> nn.Sequential:
    return nn.Sequential(
        nn.Conv2d(before, after, kernel, stride, (kernel - 1) // 2, bias=False),
        nn.BatchNorm2d(after),
        nn.ReLU(inplace=True),
    )


class CharacterNet(nn.Module):
    """See the module docstring. Named ``figure-net`` in cards and on the command line."""

    def __init__(self) -> None:
        super().__init__()
        first, second, third, deep = WIDTHS
        folded = FINE_CHANNELS * COARSE * COARSE + COARSE_CHANNELS
        self.stem = nn.Sequential(_convolution(folded, first), _convolution(first, first))
        self.down2 = nn.Sequential(_convolution(first, second, 4, 2), Residual(second))
        self.down3 = nn.Sequential(
            _convolution(second, third, 4, 2),
            Residual(third),
            Residual(third, 2),
            Residual(third, 4),
        )
        self.down4 = _convolution(third, deep, 2, 2)
        self.attention = nn.Sequential(*(Attention(deep) for _ in range(ATTENTION_LAYERS)))
        self.up3, self.joined3 = nn.Conv2d(deep, third, 1), Residual(third)
        self.up2, self.joined2 = nn.Conv2d(third, second, 1), Residual(second)
        self.up1, self.joined1 = nn.Conv2d(second, first, 1), _convolution(first, first)
        self.normals = nn.Conv2d(first, 4 * COARSE * COARSE, 3, padding=1)
        self.auxiliary = nn.Conv2d(first, 4, 1)
        for module in self.modules():
            if isinstance(module, nn.Conv2d):
                nn.init.kaiming_normal_(module.weight, nonlinearity="relu")
        nn.init.zeros_(self.normals.weight)
        nn.init.zeros_(self.normals.bias)  # type: ignore[arg-type]

    @property
    def heads(self) -> tuple[nn.Conv2d, nn.Conv2d]:
        """The last layers."""
        return self.normals, self.auxiliary

    def forward(self, fine: Tensor, coarse: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Args:
            fine: (B, 2, H, W), coarse: (B, 11, H/4, W/4); see ``character.py``.

        Returns:
            (B, 3, H, W) normals, not yet unit; (B, 1, H, W) logarithm of their concentration;
            (B, 4, H/4, W/4) depth, the logits of the near and far side of an occlusion, and that of
            ink being a mark.
        """
        raw, auxiliary = self.correction(fine, coarse)
        # Double precision: in single, the last bit depends on the number of threads.
        lumo = nn.functional.interpolate(
            coarse[:, LUMO].double(), scale_factor=COARSE, mode="bilinear", align_corners=False
        )
        return lumo.float() + raw[:, :3], raw[:, 3:], auxiliary

    def correction(self, fine: Tensor, coarse: Tensor) -> tuple[Tensor, Tensor]:
        """(B, 4, H, W): what is added to Lumo's normals, and the logarithm of their concentration;
        and (B, 4, H/4, W/4), as in ``forward``. This is the graph that ONNX Runtime runs."""
        folded = nn.functional.pixel_unshuffle(fine, COARSE)
        first = self.stem(torch.cat([folded, coarse], dim=1))
        second = self.down2(first)
        third = self.down3(second)
        deep = self.down4(third)
        cells = self.attention(deep.flatten(2).transpose(1, 2))
        deep = cells.transpose(1, 2).reshape(deep.shape)
        third = self.joined3(third + _wider(self.up3(deep)))
        second = self.joined2(second + _wider(self.up2(third)))
        first = self.joined1(first + _wider(self.up1(second)))
        if self.training:
            head = self.normals(first).float()
        else:  # bf16 would show as bands in smooth light
            with torch.autocast("cpu", enabled=False):
                head = self.normals(first.float())
        return nn.functional.pixel_shuffle(head, COARSE), self.auxiliary(first).float()


def _wider(features: Tensor) -> Tensor:
    return nn.functional.interpolate(features, scale_factor=2.0, mode="nearest")
