"""Measured reflection: the binary format of the MERL BRDF database.

Matusik, Pfister, Brand, McMillan (2003), A data-driven reflectance model, ACM Transactions on Graphics 22(3).
"""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike

from .errors import Error

# The scale of each channel's numbers, as in the database's own reader.
_SCALE = np.array([1.0, 1.15, 1.66]) / 1500
_MOST_VALUES = 1 << 26


def half_angles(normals: ArrayLike, to_observer: ArrayLike, to_light: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rusinkiewicz's (1998) coordinates of an isotropic BRDF, in radians: the angle between the half vector and the normal, 0 to pi/2; the
    angle between the light and the half vector, 0 to pi/2; and the light's angle about the half vector, 0 to pi, the period of a
    reciprocal BRDF. Takes unit vectors of shape (..., 3)."""
    n, v, l = np.broadcast_arrays(*(np.asarray(each, np.float64) for each in (normals, to_observer, to_light)))
    half = l + v
    size = np.linalg.norm(half, axis=-1, keepdims=True)
    half = np.where(size > 1e-12, half / np.maximum(size, 1e-12), n)
    cos_half = np.clip(np.sum(n * half, axis=-1), -1, 1)
    cos_difference = np.clip(np.sum(l * half, axis=-1), -1, 1)
    # Perpendicular to the plane of the normal and the half vector, and in it; the normal is at angle pi about the half vector.
    across = np.cross(n, half)
    along = np.cross(across, half)
    size = np.linalg.norm(across, axis=-1)
    is_aligned = size < 1e-9
    phi = np.arctan2(np.sum(l * across, axis=-1), np.sum(l * along, axis=-1))
    phi = np.where(is_aligned, 0.0, phi) % np.pi
    return np.arccos(cos_half), np.arccos(cos_difference), phi


class MeasuredBrdf:
    """An isotropic BRDF as a table over Rusinkiewicz's coordinates. Made by `read_merl`.

    `table` has the shape (H, D, P, 3): the half vector's angle, finer near the normal (its index is proportional to the square root), the
    difference angle, and half a turn about the half vector; red, green and blue in 1/sr; negative where nothing was measured.
    """

    def __init__(self, table: ArrayLike) -> None:
        self.table = np.asarray(table, np.float64)
        if self.table.ndim != 4 or self.table.shape[-1] != 3 or 0 in self.table.shape:
            raise ValueError(f"the table has the shape {self.table.shape}; expected (H, D, P, 3)")

    def evaluate(self, normals: ArrayLike, to_observer: ArrayLike, to_light: ArrayLike) -> np.ndarray:
        """The same quantity as Candela's reflection models, for a white object and ``light=1``: the BRDF times pi times N.L, of shape
        (..., 3); zero below the horizon, NaN where nothing was measured. Uses the table's nearest entry, like the reader by its
        authors."""
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
    """Reads a ``.binary`` file of the MERL BRDF database: three little-endian ``int32`` with the numbers of angles, then ``float64`` values
    for all angles of red, green and blue. Raises Error if the file is not in this format, and OSError if it cannot be read."""
    with open(path, "rb") as file:
        sizes = np.frombuffer(file.read(12), "<i4")
        if sizes.size != 3 or (sizes <= 0).any() or int(np.prod(sizes.astype(object))) > _MOST_VALUES:
            raise Error(f"'{os.fspath(path)}' is not a MERL file: it does not begin with three sizes")
        count = 3 * int(np.prod(sizes.astype(object)))
        values = np.frombuffer(file.read(8 * count + 1), np.uint8)
    if values.size != 8 * count:
        raise Error(f"'{os.fspath(path)}' is not a MERL file: expected {8 * count} bytes after the sizes {sizes.tolist()}, found "
                    f"{'more' if values.size > 8 * count else values.size}")
    numbers = values.view("<f8").reshape(3, *sizes)
    if not np.isfinite(numbers).all():
        raise Error(f"'{os.fspath(path)}' contains non-finite values")
    return MeasuredBrdf(np.moveaxis(numbers, 0, -1) * _SCALE)
