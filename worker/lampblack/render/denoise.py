"""Intel Open Image Denoise for any array, through the library in Blender.

Cycles denoises only its Combined pass, but here light is denoised without the albedo.
"""

from __future__ import annotations

import ctypes
from pathlib import Path
from typing import Literal

import bpy
import numpy as np
from numpy.typing import NDArray

from ..choices import DeviceKind
from .spent import spent_on

FLOAT3 = 3
MARGIN = 8  # mirrored around the image, whose borders the network otherwise gets wrong
DenoiseQuality = Literal["fast", "high"]
QUALITY = {"fast": 4, "high": 6}
DEVICE_TYPES: dict[DeviceKind, int] = {
    "cpu": 1, "oneapi": 2, "cuda": 3, "optix": 3, "hip": 4, "metal": 5
}  # fmt: skip


class Denoiser:
    """One device, reused for all images.

    Args:
        threads: of the processor.
        kind: the processor, or a graphics card.

    Raises:
        RuntimeError: the library's own message: it cannot use that device.
    """

    def __init__(self, threads: int, kind: DeviceKind = "cpu") -> None:
        self._lib = _load()
        self._device = self._lib.oidnNewDevice(DEVICE_TYPES[kind])
        if not self._device:
            raise RuntimeError(f"Open Image Denoise: it has no device for {kind}")
        self._on_card = kind != "cpu"
        if not self._on_card:
            self._lib.oidnSetDeviceInt(self._device, b"numThreads", threads)
        self._lib.oidnCommitDevice(self._device)
        self._check()

    def denoise(self, image: NDArray[np.float32], quality: DenoiseQuality) -> NDArray[np.float32]:
        """Denoise an (h, w, 3) scene-linear image.

        Normals and albedo are not used as guides: on light without albedo and silhouette they
        improve almost nothing, as measured.

        Raises:
            RuntimeError: the library's own message.
        """
        noisy = np.pad(image, ((MARGIN, MARGIN), (MARGIN, MARGIN), (0, 0)), "symmetric")
        output = np.zeros_like(noisy)
        height, width = output.shape[:2]
        lib = self._lib
        rt = lib.oidnNewFilter(self._device, b"RT")
        buffers = [lib.oidnNewBuffer(self._device, noisy.nbytes) for _ in range(2 * self._on_card)]
        try:
            if self._on_card:  # a card does not see this process's memory
                lib.oidnWriteBuffer(buffers[0], 0, noisy.nbytes, noisy.ctypes.data)
                for name, buffer in zip((b"color", b"output"), buffers, strict=True):
                    lib.oidnSetFilterImage(rt, name, buffer, FLOAT3, width, height, 0, 0, 0)
            else:
                for name, array in ((b"color", noisy), (b"output", output)):
                    lib.oidnSetSharedFilterImage(
                        rt, name, array.ctypes.data, FLOAT3, width, height, 0, 0, 0
                    )
            lib.oidnSetFilterBool(rt, b"hdr", True)
            lib.oidnSetFilterInt(rt, b"quality", QUALITY[quality])
            lib.oidnCommitFilter(rt)
            with spent_on("denoiser"):
                lib.oidnExecuteFilter(rt)
            self._check()
            if self._on_card:
                lib.oidnReadBuffer(buffers[1], 0, output.nbytes, output.ctypes.data)
                self._check()
        finally:
            lib.oidnReleaseFilter(rt)
            for buffer in buffers:
                lib.oidnReleaseBuffer(buffer)
        return output[MARGIN:-MARGIN, MARGIN:-MARGIN]

    def _check(self) -> None:
        message = ctypes.c_char_p()
        if self._lib.oidnGetDeviceError(self._device, ctypes.byref(message)):
            raise RuntimeError(f"Open Image Denoise: {(message.value or b'').decode()}")


def _load() -> ctypes.CDLL:
    for folder in Path(bpy.__file__).resolve().parents:
        for pattern in (
            "libOpenImageDenoise.so*",
            "libOpenImageDenoise*.dylib",
            "OpenImageDenoise.dll",
        ):
            for path in sorted(folder.glob(f"lib/{pattern}")) + sorted(folder.glob(pattern)):
                return _declare(ctypes.CDLL(str(path)))
    raise RuntimeError("Blender came without Open Image Denoise")


def _declare(lib: ctypes.CDLL) -> ctypes.CDLL:
    handle, text, size = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t
    signatures: dict[str, tuple[object, list[object]]] = {
        "oidnNewDevice": (handle, [ctypes.c_int]),
        "oidnSetDeviceInt": (None, [handle, text, ctypes.c_int]),
        "oidnCommitDevice": (None, [handle]),
        "oidnGetDeviceError": (ctypes.c_int, [handle, ctypes.POINTER(text)]),
        "oidnNewFilter": (handle, [handle, text]),
        "oidnSetSharedFilterImage": (
            None,
            [handle, text, handle, ctypes.c_int, size, size, size, size, size],
        ),
        "oidnSetFilterImage": (
            None,
            [handle, text, handle, ctypes.c_int, size, size, size, size, size],
        ),
        "oidnNewBuffer": (handle, [handle, size]),
        "oidnWriteBuffer": (None, [handle, size, size, handle]),
        "oidnReadBuffer": (None, [handle, size, size, handle]),
        "oidnReleaseBuffer": (None, [handle]),
        "oidnSetFilterBool": (None, [handle, text, ctypes.c_bool]),
        "oidnSetFilterInt": (None, [handle, text, ctypes.c_int]),
        "oidnCommitFilter": (None, [handle]),
        "oidnExecuteFilter": (None, [handle]),
        "oidnReleaseFilter": (None, [handle]),
    }
    for name, (result, arguments) in signatures.items():
        function = getattr(lib, name)
        function.restype, function.argtypes = result, arguments
    return lib
