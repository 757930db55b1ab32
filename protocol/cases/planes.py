"""Messages to refuse for their planes."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .case import Case, Tree, patched
from .samples import DRAWING, LAYERS, MASK, PICTURE, PIXELS, first_image, padded, plane, put_frame


def rejected_planes() -> Iterator[Case]:
    """Planes that are not what they are said to be."""
    data = PIXELS.tobytes()
    pixels, mask = plane("pixels", PIXELS), plane("mask", MASK)

    def put(
        name: str, planes: list[Tree], parts: tuple[bytes, ...], code: str, **limits: int
    ) -> Case:
        tree = patched(put_frame(DRAWING), planes=planes)
        return Case(f"planes-{name}", "client", tree, parts, code, limits)

    yield put("one-missing", [pixels, mask], (data,), "bad_plane_count")
    yield put("one-more", [pixels], (data, MASK.tobytes()), "bad_plane_count")
    yield put("unannounced", [], (data,), "bad_plane_count")
    yield Case("planes-on-bye", "client", {"type": "bye"}, (data,), "bad_plane_count")
    image, _ = first_image()
    yield Case("image-without-picture", "worker", {**image, "planes": []}, (), "bad_plane")
    parts = tuple(p.tobytes() for p in (PIXELS, *(p for _, p in LAYERS)))
    layered = put_frame(DRAWING, LAYERS)

    def put_layers(name: str, code: str, parts: tuple[bytes, ...], **changes: object) -> Case:
        return Case(f"layers-{name}", "client", patched(layered, **changes), parts, code)

    described = layered["planes"]
    yield put_layers("fewer-names", "bad_plane", parts, layers=["body"])
    yield put_layers("more-names", "bad_plane", parts, layers=["body", "arm", "hat"])
    yield put_layers("announced-without-planes", "bad_plane", (), planes=[])
    yield put_layers("without-pixels", "bad_plane", parts[1:], planes=described[1:])
    yield put_layers("before-pixels", "bad_plane", parts, planes=described[::-1])
    yield put_layers("of-one-channel", "bad_plane", (*parts[:2], MASK.tobytes()),
                     planes=[*described[:2], {**plane("mask", MASK), "role": "layer"}])  # fmt: skip
    yield put_layers("renamed", "digest_mismatch", parts, layers=["body", "arm"])
    yield put_layers("swapped", "digest_mismatch", (parts[0], parts[2], parts[1]))
    large = [{**each, "width": 8000, "height": 5000, "stride": 32000} for each in described[:2]]
    yield put_layers("too-many-pixels-together", "image_too_large", (b"",) * 4,
                     planes=[*large, *large[1:] * 2], layers=["a", "b", "c"])  # fmt: skip
    yield put("mask-alone", [mask], (MASK.tobytes(),), "bad_plane")
    yield put("mask-first", [mask, pixels], (MASK.tobytes(), data), "bad_plane")
    yield put("twice", [pixels, pixels], (data, data), "bad_plane")
    yield put("picture-from-client", [PICTURE], (data,), "bad_plane")
    yield put("premultiplied", [{**pixels, "format": "rgba8_premultiplied"}], (data,), "bad_plane")
    wide = np.zeros((3, 5, 4), np.uint8)
    yield put(
        "mask-of-four-channels",
        [pixels, {**plane("mask", wide), "format": "rgba8"}],
        (data, data),
        "bad_plane",
    )
    yield put("stride-short", [{**pixels, "stride": 19}], (data[:57],), "bad_plane")
    yield put(
        "mask-of-other-size",
        [pixels, plane("mask", MASK[:2])],
        (data, MASK[:2].tobytes()),
        "bad_plane",
    )
    yield put("too-wide", [{**pixels, "width": 16385, "stride": 65540}], (data,), "image_too_large")
    yield put("too-high", [{**pixels, "height": 16385}], (data,), "image_too_large")
    yield put(
        "too-many-pixels",
        [{**pixels, "width": 8000, "height": 5001, "stride": 32000}],
        (data,),
        "image_too_large",
    )
    yield put(
        "width-overflows-32-bits",
        [{**pixels, "width": 1 << 30, "height": 1, "stride": 60}],
        (data,),
        "image_too_large",
    )
    yield put("short-by-one", [pixels], (data[:-1],), "plane_size_mismatch")
    yield put("long-by-one", [pixels], (data + b"\0",), "plane_size_mismatch")
    yield put("empty", [pixels], (b"",), "plane_size_mismatch")
    yield put("padding-missing-in-last-row", [plane("pixels", PIXELS, 24)],
              (padded(PIXELS, 24)[:-4],), "plane_size_mismatch")  # fmt: skip
    yield put(
        "payload-overflows-32-bits",
        [{**pixels, "width": 1, "height": 16384, "stride": 1 << 18}],
        (b"",),
        "plane_size_mismatch",
    )
    yield put("changed-by-one-bit", [pixels], (data[:-1] + bytes([data[-1] ^ 1]),),
              "digest_mismatch")  # fmt: skip
    turned = {**pixels, "width": 3, "height": 5, "stride": 12}
    yield put("other-shape-same-bytes", [turned], (data,), "digest_mismatch")
    yield put("mask-not-in-digest", [pixels, mask], (data, MASK.tobytes()), "digest_mismatch")
