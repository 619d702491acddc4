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
    """How a pixel gets its colour, as `candela explain --json` has it: triangles that are seen, N, V, L, R, H, what arrives and what is
    reflected of each light, every value that the models' kernels compute on the way, the sum, and the bytes. Printed, it is text for a
    person; see docs/explaining.md.
    """

    def __init__(self, json_text: str, text: str) -> None:
        super().__init__(json.loads(json_text))
        self.text = text

    def __str__(self) -> str:
        return self.text


class Scene:
    """A scene, read and checked, with its triangles: rendered as often as one likes. Immutable; any thread.

    Made by `load`, `parse` or `from_dict`, all of which raise SceneError, with all that is wrong, and take

    settings
        Values that override those of the files, by path: ``{"image.width": 640, "light.lamp.intensity": 3.5}``.
    shading, reflection
        Names of models for every object.
    frame
        Of an animated scene.
    defaults
        Use Phong's models where the scene names none, instead of raising SceneError.
    threads
        How many threads read and render it; 0: all cores, or one for a small picture.
    registry
        Where models come from.
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
        """A scene file, or several that together are one; none: the default scene, a cube and a point light."""
        registry = registry or default_registry()
        files = [os.fspath(path) for path in paths]
        return cls(_candela.Scene.load(registry.core, files, _settings(settings), shading, reflection, frame, defaults,
                                       threads), registry)

    @classmethod
    def parse(cls, text: str, *, name: str = "scene", settings: Mapping[str, Any] = {}, shading: str | None = None,
              reflection: str | None = None, frame: int = 0, defaults: bool = False, threads: int = 0,
              registry: Registry | None = None) -> Scene:
        """The text of a scene file. `name` stands for the file in messages; paths in the text are relative to the working
        directory."""
        registry = registry or default_registry()
        return cls(_candela.Scene.parse(registry.core, text, name, _settings(settings), shading, reflection, frame, defaults,
                                        threads), registry)

    @classmethod
    def from_dict(cls, values: Mapping[str, Any], *, name: str = "scene", settings: Mapping[str, Any] = {},
                  shading: str | None = None, reflection: str | None = None, frame: int = 0, defaults: bool = False,
                  threads: int = 0, registry: Registry | None = None) -> Scene:
        """A dictionary with the keys of a scene file; ``version`` may be left out. Numbers and arrays of NumPy are values like
        any other. Lines in messages are those of the file that it would be: `document`."""
        return cls.parse(document(values), name=name, settings=settings, shading=shading, reflection=reflection, frame=frame,
                         defaults=defaults, threads=threads, registry=registry)

    def changed(self, settings: Mapping[str, Any]) -> Scene:
        """The same scene with other values, by path as in `settings`. Reads its files again."""
        return Scene(self.core.changed(_settings(settings)), self._registry)

    def frame(self, number: int) -> Scene:
        """A frame of an animated scene, from 0."""
        return Scene(self.core.frame(number), self._registry)

    def render(self, *, floats: bool = False) -> Picture:
        """The picture, of shape (height, width, 3): the bytes that the command writes, or intensities as ``float32``. It is in
        the memory in which it was rendered. Other threads of Python run meanwhile."""
        return Picture(self.core.render(floats), self.core.is_srgb)

    def terms(self, *names: str) -> dict[str, Picture]:
        """What the picture is the sum of, and what it was computed from, as ``float32`` by name: ``"ambient"``, ``"diffuse"``,
        ``"specular"``, ``"light.lamp"`` and the like, of shape (height, width, 3) and linear; ``"normal"``, ``"position"``, ``"depth"``
        and so on, with one number (height, width), two or three for each pixel. Without names: all. See docs/terms.md."""
        return {name: Picture(array, self.core.is_srgb) for name, array in _candela.terms(self.core, names or ["all"]).items()}

    def explain(self, x: int, y: int) -> Explanation:
        """How pixel (x, y), counted from the top left one, gets its colour: see Explanation. Raises IndexError if there is no such
        pixel. The first one compiles the models' kernels, if there is a compiler, which takes seconds."""
        if self._explainer is None:
            self._explainer = _candela.Explainer(self.core)
        return Explanation(*self._explainer.explain(x, y))

    def text(self) -> str:
        """The scene as one file, which reads back as the same scene: all defaults filled in, absolute paths."""
        return self.core.text()

    @property
    def width(self) -> int:
        """Pixels."""
        return self.core.width

    @property
    def height(self) -> int:
        """Pixels."""
        return self.core.height

    @property
    def frame_count(self) -> int:
        """1 where the scene is not animated."""
        return self.core.frame_count

    @property
    def warnings(self) -> list[Diagnostic]:
        """What reading the scene has to say that is no error."""
        return diagnostics_from(self.core.warnings)

    def _repr_png_(self) -> bytes | None:
        return self.render()._repr_png_()

    def __repr__(self) -> str:
        counts = [sum(kind == wanted for kind, _ in self.core.labels) for wanted in ("light", "object")]
        return f"<candela.Scene {self.width}x{self.height}, lights: {counts[0]}, objects: {counts[1]}>"


class Renderer:
    """Renders a scene again and again, with changes between the pictures, each of which is that of `Scene.render`.

    What a change leaves as it was is kept: triangles, and which of them is visible where; so another light, colour or model
    only costs shading. One picture at a time, from any thread.
    """

    def __init__(self, scene: Scene, *, threads: int = 0) -> None:
        self._core = _candela.Renderer(scene.core, threads)
        self._is_srgb = scene.core.is_srgb

    def set(self, path: str, value: Any) -> None:
        """Changes a value: ``renderer.set("light.lamp.intensity", 30)``. Raises SceneError if it is wrong, and then the scene is
        what it was."""
        self.update({path: value})

    def update(self, settings: Mapping[str, Any]) -> None:
        """Changes several values at once."""
        self._core.set(_settings(settings))

    def render(self, *, floats: bool = False) -> Picture:
        """As `Scene.render`."""
        return Picture(self._core.render(floats), self._is_srgb)

    @property
    def warnings(self) -> list[Diagnostic]:
        """As `Scene.warnings`, of the scene as it is now."""
        return diagnostics_from(self._core.warnings)


def document(values: Mapping[str, Any]) -> str:
    """A dictionary as the text of a scene file: what `Scene.from_dict` reads."""
    return _candela.document_text({"version": 1, **values})
