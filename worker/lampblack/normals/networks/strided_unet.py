"""The network of Hudon 2018: a U-Net of seven strided convolutions on three scales of ink.

Unlike the paper's network it has strides instead of dilations, and no mask as input. The widths
are chosen so that it has about the 4.7 million parameters of the original.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

WIDTHS = (32, 64, 96, 160, 192, 224, 224)


class StridedUNet(nn.Module):
    """Tiles of ``tiles.py`` without their mask in, a normal map out."""

    def __init__(self) -> None:
        super().__init__()
        self.leaky = nn.LeakyReLU(0.3)
        before = (3, *WIDTHS[:-1])
        self.down = nn.ModuleList(
            nn.Conv2d(i, o, 4, stride=2, padding=1) for i, o in zip(before, WIDTHS, strict=True)
        )
        self.up = nn.ModuleList(
            nn.Conv2d(below + skip, skip, 3, padding=1)
            for below, skip in zip(WIDTHS[:0:-1], WIDTHS[-2::-1], strict=True)
        )
        self.unfold = nn.Conv2d(WIDTHS[0], 32, 3, padding=1)
        self.out = nn.Conv2d(8 + 3, 3, 3, padding=1)
        for module in self.modules():
            if isinstance(module, nn.Conv2d):
                nn.init.kaiming_normal_(module.weight, a=0.3)
                nn.init.zeros_(module.bias)  # type: ignore[arg-type]
        with torch.no_grad():
            self.out.weight.mul_(0.2)

    @property
    def heads(self) -> tuple[nn.Conv2d]:
        """The last layer."""
        return (self.out,)

    def forward(self, tiles: Tensor) -> Tensor:
        """(B, 4, 256, 256) float -> (B, 3, 256, 256) unit normals, 0 off the mask."""
        drawing, mask = tiles[:, :3], tiles[:, 3:4]
        skips = []
        deep = drawing
        for layer in self.down:
            deep = self.leaky(layer(deep))
            skips.append(deep)
        for layer, skip in zip(self.up, skips[-2::-1], strict=True):
            wide = nn.functional.interpolate(deep, scale_factor=2.0, mode="nearest")
            deep = self.leaky(layer(torch.cat([wide, skip], dim=1)))
        fine = nn.functional.pixel_shuffle(self.leaky(self.unfold(deep)), 2)
        normals = torch.tanh(self.out(torch.cat([fine, drawing], dim=1)))
        return nn.functional.normalize(normals.float(), dim=1) * mask
