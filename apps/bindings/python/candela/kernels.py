"""Reflection models compiled at run time from the text of a kernel."""

from __future__ import annotations

import functools
import pathlib
import re
import shutil
import tempfile
import weakref
from typing import Any

from . import _candela
from .errors import RequestError
from .instances import Reflection, reflection
from .registry import Registry

_READS = {"tangent": "reads_tangent", "position": "reads_position", "uv": "reads_uv"}


class _Kernel:
    """The declarations of a kernel, as the plugin around it needs them."""

    def __init__(self, source: str, file: str) -> None:
        declared = _candela.kernel_declarations(source, file)  # rejects text that is not in the language
        function = next(((name, types) for result, name, types in declared.functions
                         if result == "Reflected" and name.endswith("_reflect") and "Surface" in types[:2]), None)
        if not function:
            raise RequestError("the kernel of a reflection model needs a function 'KERNEL Reflected NAME_reflect(Material m, Surface s, "
                               "vec3 to_light)', where Material is its struct of parameters; without parameters, omit the first "
                               "argument")
        self.prefix = function[0].removesuffix("_reflect")
        self.struct = function[1][0] if function[1][0] != "Surface" else None
        if not re.fullmatch(r"[a-z][a-z0-9_]*", self.prefix):
            raise RequestError(f"the name '{self.prefix}' of '{self.prefix}_reflect' is invalid; expected lower-case letters, digits and _")
        self.members: list[tuple[str, str]] = []
        if self.struct:
            if self.struct not in declared.structs:
                raise RequestError(f"{self.prefix}_reflect takes a '{self.struct}', which is not a struct in the kernel")
            self.members = declared.structs[self.struct]
            for kind, name in self.members:
                if kind not in ("float", "int", "vec3"):
                    raise RequestError(f"'{kind} {name};' in struct {self.struct}: expected members of type float, int or vec3")
        self.has_ambient = any(name == f"{self.prefix}_reflect_ambient" for _, name, _ in declared.functions)
        self.reads = [flag for member, flag in _READS.items() if member in declared.members_read]

    @property
    def name(self) -> str:
        return self.prefix.replace("_", "-")

    def field(self, kind: str, name: str) -> str:
        member = f"&{self.struct}::{name}, "
        if kind == "vec3":
            return f'three({member}ParamType::rgb, "{name}", vec3(0.0f), "of the kernel").required()'
        return f'{"real" if kind == "float" else "integer"}({member}"{name}", 0, "of the kernel").required()'

    def kernel(self, source: str) -> str:
        """The kernel with its optional functions added."""
        if self.has_ambient:
            return source
        material = f"{self.struct} m, " if self.struct else ""
        return f"{source}\nKERNEL vec3 {self.prefix}_reflect_ambient({material}Surface s) {{\n    return vec3(0.0f);\n}}\n"

    def plugin(self) -> str:
        struct = f"candela::kernel::{self.struct}" if self.struct else "NoParams"
        fields = f"fields({', '.join(self.field(*member) for member in self.members)})" if self.members else "k_no_fields"
        using = f"using {struct};\n" if self.struct else ""
        reads = " | ".join(["reads_no_more", *self.reads])
        return (f'#include "candela/reflection_plugin.h"\n\nnamespace candela::kernel {{\n#include "{self.name}.inc"\n}}\n\n'
                f"using namespace candela;\nusing namespace candela::sdk;\n{using}\n"
                f"static constexpr auto k_the_fields = {fields};\n\n"
                f"CANDELA_REFLECTION_PLUGIN_READING({reads}, {self.prefix}, {self.struct or 'NoParams'}, k_the_fields,\n"
                f'    {{.title = "{self.name}", .summary = "A kernel compiled on the spot."}})\n')


@functools.lru_cache(maxsize=64)
def _compiled(source: str) -> tuple[str, Registry]:
    """The name of a kernel's model, and a registry that contains it."""
    named = re.search(r"\b(\w+?)_reflect\b", source)
    file = f"{named[1].replace('_', '-')}.kernel" if named else "kernel"
    kernel = _Kernel(source, file)
    text = kernel.kernel(source)
    # The translated text is compiled; programs are generated from the original text.
    compiled = _candela.kernel_as_cpp(text, file)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="candela-kernel-"))
    try:
        (folder / f"{kernel.name}.kernel").write_text(text, encoding="utf-8")
        (folder / f"{kernel.name}.inc").write_text(compiled, encoding="utf-8")
        (folder / f"{kernel.name}.cpp").write_text(kernel.plugin(), encoding="utf-8")
        (folder / "plugin.map").write_text("{ global: candela_*; local: *; };\n", encoding="utf-8")
        _candela.compile_plugin(kernel.name, folder)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    registry = Registry([folder])
    weakref.finalize(registry, shutil.rmtree, folder, ignore_errors=True)
    return kernel.name, registry


def kernel_reflection(source: str, **values: Any) -> Reflection:
    """A reflection model from the text of a kernel, compiled by a compiler on this machine.

    source
        A struct of parameters (``float``, ``int``, ``vec3``), a function ``KERNEL Reflected NAME_reflect(Material m, Surface s, vec3
        to_light)``, and, if it reflects ambient light, ``KERNEL vec3 NAME_reflect_ambient(Material m, Surface s)``, in the language of
        docs/plugins/kernel-language.md, like the ``.kernel`` file of a plugin.
    values
        The values of all parameters.

    The model is as fast as an installed one; pass its `registry` to scenes that name it. Raises RequestError, with the position, if the
    text is not in the kernel language, and Error if no compiler or no headers of Candela (package candela-dev) are installed. A text
    is compiled only once. The compiled code can only compute, and always ends.
    """
    name, registry = _compiled(source)
    return reflection(name, registry=registry, **values)
