"""Scenes, and pictures of them."""

from __future__ import annotations

import json
import os
from typing import Any, Mapping

from . import _candela
from .errors import Diagnostic, diagnostics_from
from .picture import Picture
from .registry import Registry, default_registry


def _settings(values: Mapping[str, Any]) -> list[tuple[str, str]]:
    return [(path, _candela.value_text(value)) for path, value in values.items()]


class Explanation(dict[str, Any]):
    """How a pixel gets its colour, as in `candela explain --json`: the visible triangles, N, V, L, R, H, the arriving and the reflected
    light of each light, every value that the models' kernels compute on the way, the sum, and the bytes. Printing it gives readable text;
    see docs/user/explaining.md.
    """

    def __init__(self, json_text: str, text: str) -> None:
        super().__init__(json.loads(json_text))
        self.text = text

    def __str__(self) -> str:
        return self.text


class Scene:
    """A scene, read and checked, with its triangles. It can be rendered any number of times. Immutable; any thread.

    Made by `load`, `parse` or `from_dict`, all of which raise SceneError, listing all errors, and take

    settings
        Values that override those of the files, by path: ``{"image.width": 640, "light.lamp.intensity": 3.5}``.
    shading, reflection
        Names of models for every object.
    frame
        The frame of an animated scene.
    defaults
        Use Phong's models if the scene names none, instead of raising SceneError.
    threads
        The number of threads that read and render it; 0: all cores, or one for a small picture.
    registry
        The registry of its models.
    """

    def __init__(self, core: _candela.Scene, registry: Registry) -> None:
        self.core = core
        self._registry = registry
        self._explainer: _candela.Explainer | None = None
        registry.warn_of_replaced()

    @classmethod
    def load(cls, *paths: str | os.PathLike[str], settings: Mapping[str, Any] = {}, shading: str | None = None,
             reflection: str | None = None, frame: int = 0, defaults: bool = False, threads: int = 0,
             registry: Registry | None = None) -> Scene:
        """Reads one scene file or several that form one scene; without arguments, the default scene: a cube and a point light."""
        registry = registry or default_registry()
        files = [os.fspath(path) for path in paths]
        return cls(_candela.Scene.load(registry.core, files, _settings(settings), shading, reflection, frame, defaults,
                                       threads), registry)

    @classmethod
    def parse(cls, text: str, *, name: str = "scene", settings: Mapping[str, Any] = {}, shading: str | None = None,
              reflection: str | None = None, frame: int = 0, defaults: bool = False, threads: int = 0,
              registry: Registry | None = None) -> Scene:
        """Reads the text of a scene file. `name` stands for the file in messages; paths in the text are relative to the working
        directory."""
        registry = registry or default_registry()
        return cls(_candela.Scene.parse(registry.core, text, name, _settings(settings), shading, reflection, frame, defaults,
                                        threads), registry)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any], *, name: str = "scene", settings: Mapping[str, Any] = {},
                  shading: str | None = None, reflection: str | None = None, frame: int = 0, defaults: bool = False,
                  threads: int = 0, registry: Registry | None = None) -> Scene:
        """Reads a dictionary with the keys of a scene file; ``version`` may be left out. NumPy numbers and arrays are allowed as
        values. Line numbers in messages refer to the equivalent file: see `document`."""
        return cls.parse(document(values), name=name, settings=settings, shading=shading, reflection=reflection, frame=frame,
                         defaults=defaults, threads=threads, registry=registry)

    def changed(self, settings: Mapping[str, Any]) -> Scene:
        """The same scene with other values, by path as in `settings`. Reads its files again."""
        return Scene(self.core.changed(_settings(settings)), self._registry)

    def frame(self, number: int) -> Scene:
        """A frame of an animated scene, counted from 0."""
        return Scene(self.core.frame(number), self._registry)

    def render(self, *, floats: bool = False) -> Picture:
        """The picture, of shape (height, width, 3): the bytes that the command writes, or intensities as ``float32``. The
        array uses the memory that was rendered to. Other Python threads run meanwhile."""
        return Picture(self.core.render(floats), self.core.is_srgb)

    def terms(self, *names: str) -> dict[str, Picture]:
        """The terms that add up to the picture, and the values it was computed from, as ``float32`` by name: ``"ambient"``,
        ``"diffuse"``, ``"specular"``, ``"light.lamp"`` and the like, linear and of shape (height, width, 3); ``"normal"``, ``"position"``,
        ``"depth"``, ``"luminance"`` and so on, with one number (height, width), two or three for each pixel. Without names: all. See
        docs/user/explaining.md."""
        return {name: Picture(array, self.core.is_srgb) for name, array in _candela.terms(self.core, names or ["all"]).items()}

    def explain(self, x: int, y: int) -> Explanation:
        """Explains how pixel (x, y), counted from the top left one, gets its colour: see Explanation. Raises IndexError if there is no
        such pixel. The first call compiles the models' kernels, if a compiler is installed, which takes seconds."""
        if self._explainer is None:
            self._explainer = _candela.Explainer(self.core)
        return Explanation(*self._explainer.explain(x, y))

    def text(self) -> str:
        """The scene as the text of one file, with all defaults filled in and absolute paths. Reading it gives the same scene."""
        return self.core.text()

    @property
    def width(self) -> int:
        """In pixels."""
        return self.core.width

    @property
    def height(self) -> int:
        """In pixels."""
        return self.core.height

    @property
    def frame_count(self) -> int:
        """1 if the scene is not animated."""
        return self.core.frame_count

    @property
    def warnings(self) -> list[Diagnostic]:
        """The warnings from reading the scene."""
        return diagnostics_from(self.core.warnings)

    def _repr_png_(self) -> bytes | None:
        return self.render()._repr_png_()

    def __repr__(self) -> str:
        counts = [sum(kind == wanted for kind, _ in self.core.labels) for wanted in ("light", "object")]
        return f"<candela.Scene {self.width}x{self.height}, lights: {counts[0]}, objects: {counts[1]}>"


class Renderer:
    """Renders a scene repeatedly, with changes between the pictures; each picture equals that of `Scene.render`.

    Triangles and visibility are kept if a change does not affect them, so another light, colour or model costs only shading. One
    picture at a time, from any thread.
    """

    def __init__(self, scene: Scene, *, threads: int = 0) -> None:
        self._core = _candela.Renderer(scene.core, threads)
        self._is_srgb = scene.core.is_srgb

    def set(self, path: str, value: Any) -> None:
        """Changes a value: ``renderer.set("light.lamp.intensity", 30)``. Raises SceneError if it is invalid, and leaves the
        scene unchanged."""
        self.update({path: value})

    def update(self, settings: Mapping[str, Any]) -> None:
        """Changes several values at once."""
        self._core.set(_settings(settings))

    def render(self, *, floats: bool = False) -> Picture:
        """Like `Scene.render`."""
        return Picture(self._core.render(floats), self._is_srgb)

    @property
    def warnings(self) -> list[Diagnostic]:
        """Like `Scene.warnings`, for the current scene."""
        return diagnostics_from(self._core.warnings)


def document(values: Mapping[str, Any]) -> str:
    """The text of a scene file for a dictionary, as read by `Scene.from_dict`."""
    return _candela.document_text({"version": 1, **values})
