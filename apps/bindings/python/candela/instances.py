"""Lights, reflection and shading models, called on arrays.

Points, directions and intensities are the last axis of arrays, of length 3. The axes before it are broadcast against one another by
NumPy's rules, so ``normals`` of shape (480, 640, 3) can be combined with one ``to_light`` of shape (3,). Computations use ``float32``;
arrays of other types are converted. Arrays with contiguous channels, such as ``np.empty((3, n), np.float32).T``, are read in place.
"""

from __future__ import annotations

import os
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _candela
from .registry import Model, Registry, default_registry


class _Points:
    """Arrays of vectors with the same leading axes, each in the shape (N, 3) that the module expects."""

    def __init__(self, **arrays: ArrayLike | None) -> None:
        vectors = {}
        for name, given in arrays.items():
            if given is None:
                continue
            array = np.require(np.asarray(given, np.float32), requirements="A")
            if array.ndim == 0:
                array = np.broadcast_to(array, 3)
            if array.shape[-1] != 3:
                raise ValueError(f"{name} has the shape {array.shape}; the last axis of an array of vectors must have length 3")
            vectors[name] = array
        try:
            self.axes = np.broadcast_shapes(*(array.shape[:-1] for array in vectors.values()))
        except ValueError:
            shapes = ", ".join(f"{name} {array.shape}" for name, array in vectors.items())
            raise ValueError(f"these shapes cannot be broadcast against one another: {shapes}") from None
        self._vectors = vectors

    def __getitem__(self, name: str) -> np.ndarray:
        array = np.broadcast_to(self._vectors[name], (*self.axes, 3))
        return array if array.ndim == 2 else array.reshape(-1, 3)

    def get(self, name: str) -> np.ndarray | None:
        return self[name] if name in self._vectors else None

    def shaped(self, result: np.ndarray) -> np.ndarray:
        return result.reshape(*self.axes, 3)


def _with_third(pairs: ArrayLike | None, name: str) -> np.ndarray | None:
    """Texture coordinates, of length 2, as vectors."""
    if pairs is None:
        return None
    array = np.asarray(pairs, np.float32)
    if array.ndim == 0 or array.shape[-1] != 2:
        raise ValueError(f"{name} has the shape {array.shape}; the last axis of texture coordinates must have length 2")
    return np.concatenate([array, np.zeros((*array.shape[:-1], 1), np.float32)], axis=-1)


class _Instance:
    """A model with values."""

    _kind = ""
    _core: Any

    def __init__(self, core: Any, registry: Registry) -> None:
        self._core = core
        self._registry = registry
        registry.warn_of_replaced()

    @property
    def name(self) -> str:
        """The model's name."""
        return self._core.name

    @property
    def registry(self) -> Registry:
        """The registry that it comes from."""
        return self._registry

    @property
    def values(self) -> dict[str, Any]:
        """The values of all its parameters, as in a scene file: those given, and defaults for the others."""
        return self._core.values

    @property
    def model(self) -> Model:
        """The plugin's description of itself."""
        return self._registry.described(self._kind, self.name)

    def __repr__(self) -> str:
        return f"candela.{self._kind}({', '.join([repr(self.name), *(f'{k}={v!r}' for k, v in self.values.items())])})"


class Reflected(NamedTuple):
    """The light reflected by a surface, in parts; each has shape (..., 3)."""

    diffuse: np.ndarray
    specular: np.ndarray


class Reflection(_Instance):
    """A reflection model with values: a material. Made by `reflection`. Immutable; any thread."""

    _kind = "reflection"

    @property
    def reads_tangents(self) -> bool:
        """Whether it is anisotropic, and needs `tangents`."""
        return self._core.reads_tangents

    @property
    def reads_uv(self) -> bool:
        """Whether it needs `uv`."""
        return self._core.reads_uv

    @property
    def shows_surroundings(self) -> bool:
        """Whether it also mirrors or refracts its surroundings, which exist only in scenes."""
        return self._core.shows_surroundings

    def evaluate(self, normals: ArrayLike, to_observer: ArrayLike, to_light: ArrayLike, *, color: ArrayLike = 1.0,
                 light: ArrayLike = 1.0, tangents: ArrayLike | None = None, positions: ArrayLike = 0.0,
                 uv: ArrayLike | None = None, threads: int = 0) -> np.ndarray:
        """The reflected intensity, of shape (..., 3): linear, per channel, diffuse and specular together.

        normals, to_observer, to_light
            N, V and L: unit vectors, away from the surface, shape (..., 3).
        color
            C_o, the object's colour: linear, 0 to 1; a number, or of shape (..., 3).
        light
            I_L, the arriving intensity: a number, or of shape (..., 3).
        tangents
            Unit vectors along dp/du, orthogonal to N, for models with `reads_tangents`.
        positions
            In metres, for models with procedural textures.
        uv
            Texture coordinates, shape (..., 2), for models with `reads_uv`.
        threads
            0: all cores, if that pays off.

        The result includes the cosine N.L, but not 1/pi: with ``light=1``, dividing it by pi gives the radiometric BRDF times N.L.
        """
        points = self._points(normals, to_observer, color, tangents, positions, uv, to_light=to_light, light=light)
        return points.shaped(self._core.evaluate(*self._arguments(points, "to_light", "light"), threads))

    __call__ = evaluate

    def evaluate_parts(self, normals: ArrayLike, to_observer: ArrayLike, to_light: ArrayLike, *, color: ArrayLike = 1.0,
                       light: ArrayLike = 1.0, tangents: ArrayLike | None = None, positions: ArrayLike = 0.0,
                       uv: ArrayLike | None = None, threads: int = 0) -> Reflected:
        """Like `evaluate`, with separate I_d and I_s."""
        points = self._points(normals, to_observer, color, tangents, positions, uv, to_light=to_light, light=light)
        diffuse, specular = self._core.evaluate_parts(*self._arguments(points, "to_light", "light"), threads)
        return Reflected(points.shaped(diffuse), points.shaped(specular))

    def ambient(self, normals: ArrayLike, to_observer: ArrayLike, *, color: ArrayLike = 1.0, ambient: ArrayLike = 1.0,
                tangents: ArrayLike | None = None, positions: ArrayLike = 0.0, uv: ArrayLike | None = None,
                threads: int = 0) -> np.ndarray:
        """I_a, the reflection of light that comes from everywhere with the intensity `ambient`; otherwise the arguments of `evaluate`."""
        points = self._points(normals, to_observer, color, tangents, positions, uv, ambient=ambient)
        return points.shaped(self._core.ambient(
            points["normals"], points["to_observer"], points["color"], points["ambient"], points.get("tangents"),
            points["positions"], points.get("uv"), threads))

    @staticmethod
    def _points(normals: ArrayLike, to_observer: ArrayLike, color: ArrayLike, tangents: ArrayLike | None, positions: ArrayLike,
                uv: ArrayLike | None, **light: ArrayLike) -> _Points:
        return _Points(normals=normals, to_observer=to_observer, color=color, tangents=tangents, positions=positions,
                       uv=_with_third(uv, "uv"), **light)

    @staticmethod
    def _arguments(points: _Points, to_light: str, light: str) -> tuple[Any, ...]:
        return (points["normals"], points["to_observer"], points[to_light], points["color"], points[light],
                points.get("tangents"), points["positions"], points.get("uv"))


class Incident(NamedTuple):
    """The light of one sample that arrives at points; each array has shape (..., 3)."""

    to_light: np.ndarray
    """L: unit vectors from the point to the light."""
    diffuse: np.ndarray
    """I_L: linear intensity per channel, attenuated."""
    specular: np.ndarray
    """Like `diffuse`, for highlights."""


class Light(_Instance):
    """A light with values. Made by `light`. Immutable; any thread."""

    _kind = "light"

    @property
    def sample_count(self) -> int:
        """The number of directions from which it reaches a point: 1 for a point light, 0 for ambient light, more for area lights."""
        return self._core.sample_count

    @property
    def has_ambient(self) -> bool:
        """Whether it also comes from everywhere."""
        return self._core.has_ambient

    def illuminate(self, points: ArrayLike, normals: ArrayLike = (0.0, 1.0, 0.0), *, sample: int = 0,
                   threads: int = 0) -> Incident:
        """The light of one sample that arrives at points; the samples add up.

        points
            World space, metres, shape (..., 3).
        normals
            Unit vectors, shape (..., 3), for lights that depend on them.
        sample
            0 to `sample_count` - 1; otherwise raises IndexError.
        """
        given = _Points(points=points, normals=normals)
        return Incident(*map(given.shaped, self._core.illuminate(given["points"], given["normals"], sample, threads)))

    __call__ = illuminate

    def ambient(self, points: ArrayLike, normals: ArrayLike = (0.0, 1.0, 0.0), *, threads: int = 0) -> np.ndarray:
        """The intensity that comes from everywhere, shape (..., 3); zero for lights without such a part."""
        given = _Points(points=points, normals=normals)
        return given.shaped(self._core.ambient(given["points"], given["normals"], threads))


class Shading(_Instance):
    """A shading model with values, which determines normals. Made by `shading`. Immutable; any thread."""

    _kind = "shading"

    @property
    def rate(self) -> str:
        """Where light is evaluated: once per ``"face"``, per ``"vertex"``, or per ``"fragment"``."""
        return self._core.rate

    def normals(self, triangles: ArrayLike, barycentrics: ArrayLike, *, vertex_normals: ArrayLike | None = None,
                uv: ArrayLike | None = None, dpdu: ArrayLike | None = None, dpdv: ArrayLike | None = None,
                threads: int = 0) -> np.ndarray:
        """The unit normals, of shape (..., 3), for lighting points on triangles.

        triangles
            The corners' positions, shape (..., 3, 3): corner by corner, counter-clockwise as seen from outside.
        barycentrics
            The corners' weights at the point, shape (..., 3).
        vertex_normals
            Unit normals at the corners, shape (..., 3, 3); if omitted, the triangle's own.
        uv, dpdu, dpdv
            Texture coordinates, (..., 2), and partial derivatives of position, (..., 3), for models that read them.
        """
        corners = np.asarray(triangles, np.float32)
        if corners.shape[-2:] != (3, 3):
            raise ValueError(f"triangles has the shape {corners.shape}; its last two axes must be three corners of three numbers")
        if vertex_normals is None:
            across = np.cross(corners[..., 1, :] - corners[..., 0, :], corners[..., 2, :] - corners[..., 0, :])
            size = np.linalg.norm(across, axis=-1, keepdims=True)
            vertex_normals = np.repeat((across / np.where(size > 0, size, 1))[..., np.newaxis, :], 3, axis=-2)
        at_corners = np.asarray(vertex_normals, np.float32)
        if at_corners.shape[-2:] != (3, 3):
            raise ValueError(f"vertex_normals has the shape {at_corners.shape}; its last two axes must be like those of triangles")
        points = _Points(**{f"corner {i}": corners[..., i, :] for i in range(3)},
                         **{f"normal {i}": at_corners[..., i, :] for i in range(3)},
                         barycentrics=barycentrics, uv=_with_third(uv, "uv"), dpdu=dpdu, dpdv=dpdv)
        return points.shaped(self._core.normals(
            [points[f"corner {i}"] for i in range(3)], [points[f"normal {i}"] for i in range(3)], points["barycentrics"],
            points.get("uv"), points.get("dpdu"), points.get("dpdv"), threads))

    def vertex_normals(self, positions: ArrayLike, triangles: ArrayLike) -> np.ndarray:
        """The unit normals of a mesh's vertices, shape (V, 3).

        positions
            The vertices' positions in metres, shape (V, 3).
        triangles
            Indices of vertices, shape (T, 3), counter-clockwise as seen from outside; raises IndexError if one is out of range.
        """
        return self._core.vertex_normals(positions, triangles)


def reflection(name: str | os.PathLike[str], /, *, color_management: str = "srgb", registry: Registry | None = None,
               **values: Any) -> Reflection:
    """A reflection model by its name, or by the path of its kernel file, with values for its parameters as in a scene file:
    ``reflection("ggx", roughness=0.2)``.

    Raises RequestError, listing all invalid values, or Error if there is no such model. A kernel file is compiled when it is first named
    (see `kernel_reflection`); RequestError says what is wrong in it, and where. `color_management` is the encoding of parameters
    that are colours (0 to 255): ``"srgb"`` or ``"none"``.
    """
    registry = registry or default_registry()
    return Reflection(_candela.Reflection(registry.core, os.fspath(name), values, color_management), registry)


def light(name: str | os.PathLike[str], /, *, color_management: str = "srgb", registry: Registry | None = None,
          **values: Any) -> Light:
    """A light by the name of its type, or by the path of its kernel file, with values as in a scene file:
    ``light("point", position=(0, 2, 0), intensity=20)``. Raises like `reflection`."""
    registry = registry or default_registry()
    return Light(_candela.Light(registry.core, os.fspath(name), values, color_management), registry)


def shading(name: str | os.PathLike[str], /, *, color_management: str = "srgb", registry: Registry | None = None,
            **values: Any) -> Shading:
    """A shading model by its name, or by the path of its kernel file, with values as in a scene file: ``shading("phong")``. Raises
    like `reflection`."""
    registry = registry or default_registry()
    return Shading(_candela.Shading(registry.core, os.fspath(name), values, color_management), registry)
