"""Pictures: arrays that show themselves."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _candela
from .registry import default_registry


def _in_color(pixels: np.ndarray) -> np.ndarray:
    return np.repeat(pixels[:, :, np.newaxis], 3, axis=2) if pixels.ndim == 2 else pixels


class Picture(np.ndarray):
    """A picture: a NumPy array of shape (height, width, 3), rows from the top, red, green, blue.

    Values of type ``uint8`` are clamped and encoded as in the files that the command writes. Values of type ``float32`` are
    intensities: linear (unless the scene's ``image.color_management`` is ``"none"``), not clamped, and with 1 for a byte of 255.
    A notebook displays the picture.
    """

    is_srgb: bool
    """Whether bytes are encoded as sRGB and floats are linear."""

    def __new__(cls, values: Any, is_srgb: bool = True) -> Picture:
        picture = np.asarray(values).view(cls)
        picture.is_srgb = is_srgb
        return picture

    def __array_finalize__(self, source: Any) -> None:
        self.is_srgb = getattr(source, "is_srgb", True)

    def to_bytes(self) -> Picture:
        """The picture as ``uint8``: floats are clamped to 0 to 1 and encoded. A grey picture, of shape (height, width), gets three
        equal channels."""
        if self.dtype == np.uint8:
            return self
        values = np.asarray(self, np.float32)
        return Picture(_candela.encode(_in_color(values), self.is_srgb), self.is_srgb)

    def png(self) -> bytes:
        """The contents of a PNG file of the picture, after `to_bytes`."""
        return _candela.png(default_registry().core, _in_color(np.asarray(self.to_bytes())))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a PNG file. (``candela render`` writes all other formats.)"""
        data = self.png()
        temporary = f"{os.fspath(path)}.{os.getpid()}.part"
        try:
            with open(temporary, "wb") as file:
                file.write(data)
            os.replace(temporary, path)
        except BaseException:
            if os.path.exists(temporary):
                os.unlink(temporary)
            raise

    def _repr_png_(self) -> bytes | None:
        is_picture = self.ndim == 2 or (self.ndim == 3 and self.shape[2] == 3)
        return self.png() if is_picture and self.size else None
