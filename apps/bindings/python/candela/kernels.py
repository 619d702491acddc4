"""Reflection models compiled at run time from the text of a kernel."""

from __future__ import annotations

import functools
import re
from typing import Any

from . import _candela
from .errors import RequestError
from .instances import Reflection, reflection
from .registry import Registry


@functools.lru_cache(maxsize=64)
def _compiled(source: str) -> tuple[str, Registry]:
    """The name of a kernel's model, and a registry that contains it."""
    named = re.search(r"\b([a-z][a-z0-9_]*)_reflect\b", source)
    if not named:
        raise RequestError("the kernel of a reflection model needs a function 'KERNEL Reflected NAME_reflect(Material m, Surface s, "
                           "vec3 to_light)', where Material is its struct of parameters; without parameters, omit the first "
                           "argument")
    name = named[1].replace("_", "-")
    return name, Registry([_candela.compile_model(source, name)])


def kernel_reflection(source: str, **values: Any) -> Reflection:
    """A reflection model from the text of a kernel, compiled by a compiler on this machine.

    source
        The text of a model's ``.kernel`` file: a struct of parameters, a function ``KERNEL Reflected NAME_reflect(Material m,
        Surface s, vec3 to_light)``, and, if it reflects ambient light, ``KERNEL vec3 NAME_reflect_ambient(Material m, Surface s)``,
        in the language of docs/plugins/kernel-language.md. Comments may declare the parameters (docs/plugins/adding-a-model.md).
    values
        The values of its parameters; those without a declared default are required.

    The model is as fast as an installed one; pass its `registry` to scenes that name it. Raises RequestError, with the position, if the
    text is not in the kernel language, and Error if no compiler or no headers of Candela (package candela-dev) are installed. A text
    is compiled only once: the result stays in the user's cache. The compiled code can only compute, and always ends.
    """
    name, registry = _compiled(source)
    return reflection(name, registry=registry, **values)
