"""Measured reflection: the binary format of the MERL BRDF database.

Matusik, Pfister, Brand, McMillan (2003), A data-driven reflectance model, ACM Transactions on Graphics 22(3).
"""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike

from .errors import Error

# How much of each channel's numbers a measured unit is, as the database's own reader has it.
_SCALE = np.array([1.0, 1.15, 1.66]) / 1500
_MOST_VALUES = 1 << 26


def half_angles(normals: ArrayLike, to_observer: ArrayLike, to_light: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rusinkiewicz's (1998) coordinates of an isotropic BRDF, in radians: the angle of the half vector from the normal, 0 to pi/2; that
    of the light from the half vector, 0 to pi/2; and the light's angle about the half vector, 0 to pi, with which the BRDF of a
    reciprocal surface repeats itself. Unit vectors of shape (..., 3)."""
    n, v, l = np.broadcast_arrays(*(np.asarray(each, np.float64) for each in (normals, to_observer, to_light)))
    half = l + v
    size = np.linalg.norm(half, axis=-1, keepdims=True)
    half = np.where(size > 1e-12, half / np.maximum(size, 1e-12), n)
    cos_half = np.clip(np.sum(n * half, axis=-1), -1, 1)
    cos_difference = np.clip(np.sum(l * half, axis=-1), -1, 1)
    # Across the plane of the normal and the half vector, and in it: the normal seen from the half vector is at angle pi.
    across = np.cross(n, half)
    along = np.cross(across, half)
    size = np.linalg.norm(across, axis=-1)
    is_aligned = size < 1e-9
    phi = np.arctan2(np.sum(l * across, axis=-1), np.sum(l * along, axis=-1))
    phi = np.where(is_aligned, 0.0, phi) % np.pi
    return np.arccos(cos_half), np.arccos(cos_difference), phi


class MeasuredBrdf:
    """An isotropic BRDF by a table over Rusinkiewicz's coordinates. Made by `read_merl`.

    `table` has the shape (H, D, P, 3): the half vector's angle, finer near the normal (its index goes with the square root), the
    difference's angle, and half a turn about the half vector; in 1/sr, red, green and blue; negative where nothing was measured.
    """

    def __init__(self, table: ArrayLike) -> None:
        self.table = np.asarray(table, np.float64)
        if self.table.ndim != 4 or self.table.shape[-1] != 3 or 0 in self.table.shape:
            raise ValueError(f"the table has the shape {self.table.shape}; it is (H, D, P, 3)")

    def evaluate(self, normals: ArrayLike, to_observer: ArrayLike, to_light: ArrayLike) -> np.ndarray:
        """What Candela's reflection models evaluate to, for a white object and ``light=1``: the BRDF times pi times N.L, of shape
        (..., 3); zero below the horizon, NaN where nothing was measured. The table's nearest entry is taken, as its authors' reader
        does."""
        half, difference, phi = half_angles(normals, to_observer, to_light)
        sizes = np.array(self.table.shape[:3])
        at_half = np.sqrt(np.maximum(half, 0) / (np.pi / 2)) * sizes[0]
        indices = [np.clip(at.astype(int), 0, size - 1) for at, size in
                   ((at_half, sizes[0]), (difference / (np.pi / 2) * sizes[1], sizes[1]), (phi / np.pi * sizes[2], sizes[2]))]
        brdf = self.table[tuple(indices)]
        brdf = np.where(brdf < 0, np.nan, brdf)
        n, v, l = np.broadcast_arrays(*(np.asarray(each, np.float64) for each in (normals, to_observer, to_light)))
        cosine = np.sum(n * l, axis=-1, keepdims=True)
        is_above = (cosine > 0) & (np.sum(n * v, axis=-1, keepdims=True) > 0)
        return np.where(is_above, np.pi * brdf * cosine, 0.0)


def read_merl(path: str | os.PathLike[str]) -> MeasuredBrdf:
    """Reads a ``.binary`` file of the MERL BRDF database: three little-endian ``int32`` with the numbers of angles, then for red, green and
    blue as many ``float64``. Raises Error for what is no such file, and OSError where it cannot be read."""
    with open(path, "rb") as file:
        sizes = np.frombuffer(file.read(12), "<i4")
        if sizes.size != 3 or (sizes <= 0).any() or int(np.prod(sizes.astype(object))) > _MOST_VALUES:
            raise Error(f"'{os.fspath(path)}' is no file of the MERL format: it does not begin with three sizes")
        count = 3 * int(np.prod(sizes.astype(object)))
        values = np.frombuffer(file.read(8 * count + 1), np.uint8)
    if values.size != 8 * count:
        raise Error(f"'{os.fspath(path)}' is no file of the MERL format: after the sizes {sizes.tolist()} there should be {8 * count} "
                    f"bytes, and there are {'more' if values.size > 8 * count else values.size}")
    numbers = values.view("<f8").reshape(3, *sizes)
    if not np.isfinite(numbers).all():
        raise Error(f"'{os.fspath(path)}' has values that are no numbers")
    return MeasuredBrdf(np.moveaxis(numbers, 0, -1) * _SCALE)
