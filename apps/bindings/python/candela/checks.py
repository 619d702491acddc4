"""The conformance kit's checks of a model."""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
from typing import Any, NamedTuple

from . import _candela
from .errors import Error
from .registry import Registry, default_registry, split_id


class Check(NamedTuple):
    """The result of one of the kit's checks."""

    name: str
    outcome: str
    """``"passed"``, ``"warning"``, ``"skipped"``, ``"failed"``, ``"crashed"`` or ``"timed out"``."""
    messages: list[str]


def conformance(name: str | os.PathLike[str], /, *, registry: Registry | None = None, **values: Any) -> list[Check]:
    """Checks a model, by its id, such as ``"reflection/ggx"``, or by the path of its kernel file, with the conformance kit: everything
    that Candela relies on, and the properties that the model declares. Runs in a process of its own, like ``candela plugin test``.

    `values` set parameters, in particular those without a default. Raises Error if there is no such model, or if the kit, which is in the
    package candela-dev, is not installed.
    """
    registry = registry or default_registry()
    library = registry.core.library(*split_id(name))
    kit = pathlib.Path(registry.search_path[-1]).parent / "candela-conformance"
    if not kit.exists():
        raise Error(f"the conformance kit is not installed: '{kit}' does not exist (package candela-dev, or a build with tests)")
    settings = [f"--set={key}={_candela.value_text(value)}" for key, value in values.items()]
    ended = subprocess.run([kit, "--json", *settings, library], capture_output=True, text=True)
    if ended.returncode not in (0, 4):
        raise Error(ended.stderr.strip() or f"the conformance kit exited with code {ended.returncode}")
    report, = json.loads(ended.stdout)
    return [Check(check["check"], check["outcome"], check["messages"]) for check in report["checks"]]
