"""The installed plugins and their descriptions."""

from __future__ import annotations

import functools
import json
import os
import warnings
from typing import Any, NamedTuple, Sequence

from . import _candela
from .errors import RequestError, diagnostics_from


class Parameter(NamedTuple):
    """A parameter of a model, as declared in its manifest."""

    name: str
    type: str
    """``"real"``, ``"integer"``, ``"boolean"``, ``"choice"``, ``"text"``, ``"file"``, ``"vector"``, ``"point"``,
    ``"direction"``, ``"color"`` (three integers 0 to 255), ``"rgb"`` (a number, or one per channel), ``"matrix"``,
    ``"numbers"``."""
    unit: str
    """``"m"``, ``"deg"``, or empty."""
    default: Any
    """None: a value is required."""
    minimum: float | None
    maximum: float | None
    choices: tuple[str, ...]
    meaning: str


class Model(NamedTuple):
    """The description of a plugin: a light, a reflection or shading model, a shape, a picture format or a target."""

    kind: str
    name: str
    title: str
    summary: str
    formula: str
    reference: str
    """Where it was published."""
    parameters: tuple[Parameter, ...]
    properties: dict[str, str]
    """Declared facts, such as ``{"reciprocal": "true"}``."""
    presets: dict[str, dict[str, Any]]
    """Named sets of values, such as those of a material."""

    @property
    def id(self) -> str:
        """``"reflection/ggx"``."""
        return f"{self.kind}/{self.name}"


def _parameter(manifest: dict[str, Any]) -> Parameter:
    return Parameter(
        manifest["name"], manifest["type"], manifest.get("unit", ""), manifest.get("default"), manifest.get("minimum"),
        manifest.get("maximum"), tuple(manifest.get("choices", ())), manifest.get("meaning", ""))


def _model(manifest: dict[str, Any]) -> Model:
    return Model(
        manifest["kind"], manifest["name"], manifest["title"], manifest["summary"], manifest["formula"],
        manifest["reference"], tuple(_parameter(parameter) for parameter in manifest["parameters"]),
        dict(manifest.get("properties", {})),
        {preset["name"]: preset["values"] for preset in manifest.get("presets", ())})


def split_id(name: str | os.PathLike[str]) -> tuple[str, str]:
    """``("reflection", "ggx")`` from ``"reflection/ggx"``; no kind and the path from that of a kernel file."""
    name = os.fspath(name)
    if name.endswith(".kernel"):
        return "", name
    kind, slash, plain = name.partition("/")
    if not slash:
        raise RequestError(f"'{name}' is not a model's id; expected KIND/NAME, such as 'reflection/ggx', or the path of a kernel file")
    return kind, plain


class Registry:
    """The plugins of a search path: `folders`, then ``CANDELA_PLUGIN_PATH``, the user's own and the installed ones.

    Functions that take a registry share a default one if none is given. A registry reads a kernel file only once: after an edit,
    use a new one. Any thread.
    """

    core: _candela.Registry
    """For the package's own use."""

    def __init__(self, folders: Sequence[str | os.PathLike[str]] = ()) -> None:
        self.core = _candela.Registry([os.fspath(folder) for folder in folders])
        self._warned = 0

    @property
    def search_path(self) -> list[str]:
        """The folders, in search order."""
        return [str(folder) for folder in self.core.search_path]

    def models(self, kind: str | None = None) -> list[Model]:
        """All models of a kind (``"light"``, ``"reflection"``, ``"shading"``, ``"shape"``, ``"image"``, ``"target"``),
        or of all kinds, sorted by kind and name. Does not load any plugin."""
        found = json.loads(self.core.manifests(kind or ""))
        self.warn_of_replaced()
        return [_model(manifest) for manifest in found]

    def model(self, name: str | os.PathLike[str]) -> Model:
        """One model, by its id, ``"reflection/ggx"``, or by the path of its kernel file. Raises Error, with a suggestion, if there is
        none."""
        return self.described(*split_id(name))

    def described(self, kind: str, name: str) -> Model:
        """For the package's own use: the model of that kind and name; without a kind, `name` is that of a kernel file."""
        found = _model(json.loads(self.core.manifest(kind, name)))
        self.warn_of_replaced()
        return found

    def warn_of_replaced(self) -> None:
        """Warns, once each, about plugins that are used instead of refused ones."""
        replaced = diagnostics_from(self.core.replaced)
        for diagnostic in replaced[self._warned:]:
            warnings.warn(f"{diagnostic.message}; {diagnostic.suggestion}", stacklevel=3)
        self._warned = len(replaced)


@functools.lru_cache(maxsize=None)
def default_registry() -> Registry:
    """The registry that is used if none is given."""
    return Registry()


def models(kind: str | None = None, registry: Registry | None = None) -> list[Model]:
    """All installed models of a kind, or of all: see `Registry.models`."""
    return (registry or default_registry()).models(kind)


def model(name: str | os.PathLike[str], registry: Registry | None = None) -> Model:
    """One model by its id, ``"reflection/ggx"``, or by the path of its kernel file: see `Registry.model`."""
    return (registry or default_registry()).model(name)
