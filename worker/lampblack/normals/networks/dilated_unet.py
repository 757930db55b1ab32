"""The network of section 3.1: a U-Net whose five last encoder layers are dilated.

The paper's text does not give all of its figure 4. What it gives is kept: input 256 x 256 x 4,
five dilated layers instead of strides, LeakyReLU of slope 0.3, tanh, output times mask. The
widths are chosen for a processor without a GPU.
"""

from __future__ import annotations

import torch
from torch import Tensor, nn

DILATIONS = (2, 4, 8, 4, 2)


class DilatedUNet(nn.Module):
    """Four channels in (three scales of the drawing and the mask), a normal map out."""

    def __init__(self, widths: tuple[int, int, int] = (32, 96, 224)) -> None:
        super().__init__()
        first, second, deep = widths
        self.leaky = nn.LeakyReLU(0.3)
        self.down1 = nn.Conv2d(4, first, 4, stride=2, padding=1)
        self.down2 = nn.Conv2d(first, second, 4, stride=2, padding=1)
        self.down3 = nn.Conv2d(second, deep, 4, stride=2, padding=1)
        self.dilated = nn.ModuleList(
            nn.Conv2d(deep, deep, 3, padding=d, dilation=d) for d in DILATIONS
        )
        self.up2 = nn.Conv2d(deep + second, second, 3, padding=1)
        self.up1 = nn.Conv2d(second + first, first, 3, padding=1)
        self.unshuffle = nn.Conv2d(first, 32, 3, padding=1)
        self.out = nn.Conv2d(8 + 4, 3, 3, padding=1)
        for module in self.modules():
            if isinstance(module, nn.Conv2d):
                nn.init.kaiming_normal_(module.weight, a=0.3)
                nn.init.zeros_(module.bias)  # type: ignore[arg-type]
        with torch.no_grad():
            for layer in self.dilated:
                layer.weight.mul_(0.5)  # type: ignore[operator]  # keeps the residual sum near unit variance
            self.out.weight.mul_(0.2)

    @property
    def heads(self) -> tuple[nn.Conv2d]:
        """The last layer."""
        return (self.out,)

    def forward(self, tiles: Tensor) -> Tensor:
        """(B, 4, 256, 256) float, see ``tiles.py`` -> (B, 3, 256, 256) normals, not yet unit."""
        half = self.leaky(self.down1(tiles))
        quarter = self.leaky(self.down2(half))
        deep = self.leaky(self.down3(quarter))
        for layer in self.dilated:
            deep = deep + self.leaky(layer(deep))
        wide = nn.functional.interpolate(deep, scale_factor=2.0, mode="nearest")
        wide = self.leaky(self.up2(torch.cat([wide, quarter], dim=1)))
        wide = nn.functional.interpolate(wide, scale_factor=2.0, mode="nearest")
        wide = self.leaky(self.up1(torch.cat([wide, half], dim=1)))
        fine = nn.functional.pixel_shuffle(self.leaky(self.unshuffle(wide)), 2)
        normals = torch.tanh(self.out(torch.cat([fine, tiles], dim=1)))
        return normals * tiles[:, 3:4]
