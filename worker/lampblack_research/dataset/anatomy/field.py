"""The signed distance field of blended parts, and the mesh of its zero level.

Round cones and ellipsoids as in Quilez, "Distance functions"; their cubic smooth union leaves no
crease where its radius is large. The surface is found by naive surface nets (Gibson 1998), and
every vertex is then moved onto the zero of the field, whose gradient is its normal.

A part is a row of 18: kind, sign, blend, then a cone's ends and radii or an ellipsoid's centre,
radii and axes. A wave is a row of 5: frequency, phase, amplitude.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lampblack.compiled import compiled

Vector = NDArray[np.float64]

CONE, ELLIPSOID = 0, 1
BLOCK = 8
"""Cells along the side of a block. The same parts affect all of them."""

_SLACK = 1.25  # an ellipsoid's distance is an estimate
_FAR, _UNKNOWN = 1e3, 1e2


@compiled
def _part_distance(part: Vector, x: float, y: float, z: float) -> float:
    if part[0] == ELLIPSOID:
        x, y, z = x - part[3], y - part[4], z - part[5]
        u = (part[9] * x + part[10] * y + part[11] * z) / part[6]
        v = (part[12] * x + part[13] * y + part[14] * z) / part[7]
        w = (part[15] * x + part[16] * y + part[17] * z) / part[8]
        inside = np.sqrt(u * u + v * v + w * w)
        slope = np.sqrt((u / part[6]) ** 2 + (v / part[7]) ** 2 + (w / part[8]) ** 2)
        # In the middle of a flat one the estimate is too deep.
        deepest = -min(part[6], part[7], part[8]) * (1 - inside / 2)
        return float(max(inside * (inside - 1) / max(slope, 1e-9), deepest))
    bx, by, bz = part[7] - part[3], part[8] - part[4], part[9] - part[5]
    px, py, pz = x - part[3], y - part[4], z - part[5]
    r1, r2 = part[6], part[10]
    fall = r1 - r2
    long2 = bx * bx + by * by + bz * bz
    side2 = long2 - fall * fall
    along = px * bx + py * by + pz * bz
    beyond = along - long2
    qx, qy, qz = px * long2 - bx * along, py * long2 - by * along, pz * long2 - bz * along
    across2 = qx * qx + qy * qy + qz * qz
    k = fall * abs(fall) * across2
    if np.sign(beyond) * side2 * beyond * beyond * long2 > k:
        return float(np.sqrt(across2 + beyond * beyond * long2) / long2 - r2)
    if np.sign(along) * side2 * along * along * long2 < k:
        return float(np.sqrt(across2 + along * along * long2) / long2 - r1)
    return float((np.sqrt(across2 * side2 / long2) + along * fall) / long2 - r1)


@compiled
def _distance(
    parts: Vector,
    waves: Vector,
    near: NDArray[np.int16],
    count: int,
    x: float,
    y: float,
    z: float,
) -> float:
    total = _FAR
    for n in range(count):
        part = parts[near[n]]
        here, blend = _part_distance(part, x, y, z), part[2]
        if part[1] > 0:
            mixed = max(blend - abs(total - here), 0.0) / blend
            total = min(total, here) - mixed**3 * blend / 6
        else:
            mixed = max(blend - abs(total + here), 0.0) / blend
            total = max(total, -here) + mixed**3 * blend / 6
    for n in range(len(waves)):
        wave = waves[n]
        angle = wave[0] * x + wave[1] * y + wave[2] * z + wave[3]
        total -= wave[4] * np.sin(angle)
    return total


@compiled
def fill(
    parts: Vector, waves: Vector, swell: float, low: Vector, cell: float, blocks: NDArray[np.int64]
) -> tuple[Vector, NDArray[np.int16], NDArray[np.int64]]:
    """Compute the field in blocks near the surface, and which parts affect each block."""
    sides = blocks * BLOCK + 1
    field = np.full((sides[0], sides[1], sides[2]), _FAR)
    near = np.zeros((blocks[0], blocks[1], blocks[2], len(parts)), np.int16)
    counts = np.zeros((blocks[0], blocks[1], blocks[2]), np.int64)
    reach = _SLACK * cell * BLOCK * np.sqrt(3.0) / 2
    alone = np.empty(len(parts))
    later = parts[:, 2].copy()
    for n in range(len(parts) - 2, -1, -1):
        later[n] = max(later[n], later[n + 1])
    for i in range(blocks[0]):
        for j in range(blocks[1]):
            for k in range(blocks[2]):
                x = low[0] + (i + 0.5) * BLOCK * cell
                y = low[1] + (j + 0.5) * BLOCK * cell
                z = low[2] + (k + 0.5) * BLOCK * cell
                least = _FAR
                for n in range(len(parts)):
                    alone[n] = _part_distance(parts[n], x, y, z)
                    if parts[n, 1] > 0:
                        least = min(least, alone[n])
                felt = near[i, j, k]
                count = 0
                for n in range(len(parts)):
                    limit = least if parts[n, 1] > 0 else swell
                    if alone[n] < limit + later[n] + 2 * reach:
                        felt[count] = n
                        count += 1
                counts[i, j, k] = count
                middle = _distance(parts, waves, felt, count, x, y, z)
                active = abs(middle) < reach + swell
                a, b, c = i * BLOCK, j * BLOCK, k * BLOCK
                for di in range(BLOCK + 1):
                    for dj in range(BLOCK + 1):
                        for dk in range(BLOCK + 1):
                            if abs(field[a + di, b + dj, c + dk]) < _UNKNOWN:
                                continue
                            if not active:
                                field[a + di, b + dj, c + dk] = _FAR * np.sign(middle)
                                continue
                            field[a + di, b + dj, c + dk] = _distance(
                                parts,
                                waves,
                                felt,
                                count,
                                low[0] + (a + di) * cell,
                                low[1] + (b + dj) * cell,
                                low[2] + (c + dk) * cell,
                            )
    return field, near, counts


@compiled
def net(
    field: Vector, low: Vector, cell: float
) -> tuple[Vector, NDArray[np.int64], NDArray[np.int64]]:
    """Surface nets: one vertex in every cell that the surface crosses; a quad around every edge."""
    width, height, depth = field.shape
    index = np.full((width, height, depth), -1, np.int32)
    count = 0
    for i in range(width - 1):
        for j in range(height - 1):
            for k in range(depth - 1):
                inside = 0
                for c in range(8):
                    inside += field[i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)] < 0
                if 0 < inside < 8:
                    index[i, j, k] = count
                    count += 1
    vertices = np.empty((count, 3))
    block_of = np.empty((count, 3), np.int64)
    faces = np.empty((count * 8, 3), np.int64)
    quads = 0
    step = np.eye(3).astype(np.int64)
    for i in range(width - 1):
        for j in range(height - 1):
            for k in range(depth - 1):
                own = index[i, j, k]
                if own < 0:
                    continue
                middle, crossings = np.zeros(3), 0
                for axis in range(3):
                    for corner in range(8):
                        if corner >> axis & 1:
                            continue
                        p, q, r = corner & 1, corner >> 1 & 1, corner >> 2
                        here = field[i + p, j + q, k + r]
                        s = step[axis]
                        there = field[i + p + s[0], j + q + s[1], k + r + s[2]]
                        if (here < 0) == (there < 0):
                            continue
                        share = here / (here - there)
                        middle += np.array(
                            [i + p + s[0] * share, j + q + s[1] * share, k + r + s[2] * share]
                        )
                        crossings += 1
                vertices[own] = low + middle / crossings * cell
                block_of[own] = np.array([i, j, k]) // BLOCK
                for axis in range(3):
                    s, t, u = step[axis], step[(axis + 1) % 3], step[(axis + 2) % 3]
                    here, there = field[i, j, k], field[i + s[0], j + s[1], k + s[2]]
                    if (here < 0) == (there < 0):
                        continue
                    across = index[i - t[0], j - t[1], k - t[2]]
                    far = index[i - t[0] - u[0], j - t[1] - u[1], k - t[2] - u[2]]
                    down = index[i - u[0], j - u[1], k - u[2]]
                    if min(across, far, down) < 0:
                        continue
                    if here < 0:
                        across, down = down, across
                    faces[quads] = own, down, far
                    faces[quads + 1] = own, far, across
                    quads += 2
    return vertices, faces[:quads], block_of


@compiled
def settle(
    parts: Vector,
    waves: Vector,
    vertices: Vector,
    block_of: NDArray[np.int64],
    near: NDArray[np.int16],
    counts: NDArray[np.int64],
    cell: float,
) -> Vector:
    """Move ``vertices`` onto the surface by Newton's method; return their normals."""
    normals = np.empty_like(vertices)
    h = 0.05 * cell
    for n in range(len(vertices)):
        i, j, k = block_of[n]
        felt, count = near[i, j, k], counts[i, j, k]
        x, y, z = vertices[n]
        gx, gy, gz, steep = 0.0, 0.0, 1.0, 1.0
        for _ in range(2):
            # Four corners of a tetrahedron give the gradient, and their mean the value.
            p = _distance(parts, waves, felt, count, x + h, y - h, z - h)
            q = _distance(parts, waves, felt, count, x - h, y - h, z + h)
            r = _distance(parts, waves, felt, count, x - h, y + h, z - h)
            s = _distance(parts, waves, felt, count, x + h, y + h, z + h)
            gx = (p - q - r + s) / (4 * h)
            gy = (r + s - p - q) / (4 * h)
            gz = (q + s - p - r) / (4 * h)
            steep = gx * gx + gy * gy + gz * gz + 1e-12
            away = (p + q + r + s) / 4 / steep
            away = min(max(away, -0.7 * cell), 0.7 * cell)
            x, y, z = x - away * gx, y - away * gy, z - away * gz
        vertices[n] = x, y, z
        normals[n] = gx, gy, gz
        normals[n] /= np.sqrt(steep)
    return normals
