#!/usr/bin/env python3
"""Checks that imports and includes point down: api < util < plugins < scene < geometry < raster < shading < render < embedding < core
< sdk, apps.

Plugins, and the parts of the SDK that are built into plugins, include headers of core/include and of the SDK, and nothing else; any
compiler builds them, so they do not import modules. The module candela.api exports everything that those headers declare. No two
headers are installed under one name. A page's scripts import from their own folder scripts/ and from sdk/web, which is self-contained.
    layering.py ROOT
"""
import pathlib
import re
import sys

LAYERS = ["include", "api", "util", "plugins", "scene", "geometry", "raster", "shading", "render", "embedding", "core"]
SOURCES = {".cpp", ".cppm", ".h", ".kernel"}
# The parts that are compiled into plugins, as opposed to the SDK's programs.
SDK_OF_PLUGINS = ("sdk/include/", "sdk/mesh_io/", "sdk/target/", "sdk/templates/", "sdk/kernel/lexer.cpp",
                  "sdk/kernel/include/candela/kernel_language/lexer.h")
HEADERS, MODULE = "core/include/candela/", "core/api/api.cppm"
# Headers that no module exports: macros, kernels, templates, headers that only tests of plugins include, and those about
# memory or files only.
HEADERS_ALONE = {"plugin/abi.h", "plugin/export.h", "plugin/instances.h", "file_descriptor.h", "large_pages.h"}
# A declaration at the beginning of a line, where clang-format puts the members of a namespace: a type, an alias, a function,
# a constant.
DECLARATION = re.compile(
    r"^(?:template <.*> )?(?:enum class |struct |class )(?:CANDELA_EXPORT )?(?P<type>\w+)[^;\n]*\{(?:.*\};)?$"
    r"|^using (?P<alias>\w+) = .*;$"
    r"|^(?:CANDELA_EXPORT |inline |constexpr )+(?:[\w:<>,*& ]|\[\[.*?\]\])*?(?P<function>operator[^\w\s(]+|\w+)\("
    r"|^inline constexpr [\w:<>]+ (?P<constant>\w+) = ", re.MULTILINE)


def sources(root):
    for top in ("core", "sdk", "plugins", "apps"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SOURCES and path.is_file():
                yield path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")


def layer_of(path):
    """The layer of a core file: its folder below core/, or "core" for the module that re-exports all of them."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else "core"


def below(path):
    """The layers that a file may import."""
    if path.startswith("core/"):
        return LAYERS[: LAYERS.index(layer_of(path)) + 1]
    return ["include"] if of_plugins(path) else LAYERS


def of_plugins(path):
    return path.startswith(("plugins/",) + SDK_OF_PLUGINS) and not path.endswith("_test.cpp")


def declared(text):
    """The declarations of a header in namespace candela, and the unrecognised lines."""
    names, unknown = set(), []
    inside = text.split("namespace candela {\n", 1)[1]
    for line in inside.splitlines():
        if not re.match(r"[A-Za-z\[]", line) or line.startswith("template <") or line == "namespace candela {":
            continue
        found = DECLARATION.match(line)
        if found:
            names.add(found["type"] or found["alias"] or found["function"] or found["constant"])
        else:
            unknown.append(line)
    return names, unknown


def export_findings(files):
    """Declarations of headers that candela.api does not export. Plugins see the headers; the core and programs see the module."""
    if MODULE not in files:
        yield f"{MODULE}, which should export the headers' declarations, is missing"
        return
    exported = set(re.findall(r"^\s*using candela::([^;]+);", files[MODULE], re.MULTILINE))
    for path, text in files.items():
        name = path.removeprefix(HEADERS)
        if name == path or not name.endswith(".h") or name.startswith("kernel/") or name in HEADERS_ALONE:
            continue
        names, unknown = declared(text)
        for line in unknown:
            yield f"{path}: unrecognised declaration '{line}'"
        for missing in sorted(names - exported):
            yield f"{MODULE}: {missing} is declared in {name} and not exported"


def script_findings(root):
    web = root / "sdk/web"
    for top in ("sdk", "plugins", "apps"):
        for path in sorted((root / top).rglob("*.js")):
            own = next((folder for folder in path.parents if folder == web or folder.name == "scripts"), path.parent)
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                imported = re.search(r'\b(?:from|import) "(\.[^"]+)"', line)
                if imported is None:
                    continue
                to = (path.parent / imported[1]).resolve()
                if not to.is_file():
                    yield f"{path.relative_to(root)}:{number}: there is no {imported[1]}"
                elif not to.is_relative_to(own) and not to.is_relative_to(web):
                    yield f"{path.relative_to(root)}:{number}: {imported[1]} is neither next to it nor in sdk/web"


def findings(root):
    root = root.resolve()
    files = dict(sources(root))
    yield from export_findings(files)
    yield from script_findings(root)
    modules = {}
    for path, text in files.items():
        for name in re.findall(r"^export module (candela\.\w+);", text, re.MULTILINE):
            modules.setdefault(name, path)
    headers = {}
    for path in files:
        if "/include/candela/" not in path:
            continue
        first = headers.setdefault(path.split("/include/")[1], path)
        if first != path:
            yield f"{path}: {first} is installed under the same name"
    for path, text in files.items():
        for number, line in enumerate(text.splitlines(), 1):
            imported = re.match(r"\s*(?:export )?import (candela\.\w+)", line)
            included = re.match(r'\s*#include "([^"]+)"', line)
            to = None
            if imported and of_plugins(path):
                yield f"{path}:{number}: plugins are built without modules; include the header instead of {imported[1]}"
                continue
            if imported:
                to = modules.get(imported[1])
                if to is None:
                    yield f"{path}:{number}: no source file exports {imported[1]}"
                    continue
            elif included and included[1].startswith("candela/"):
                to = headers.get(included[1])
                if to is None:
                    yield f"{path}:{number}: neither core/include nor the SDK has a header {included[1]}"
                    continue
            elif included and ".." in included[1]:
                yield f"{path}:{number}: {included[1]} leaves its folder"
                continue
            if to is None:
                continue
            if to.startswith("core/"):
                allowed = layer_of(to) in below(path)
            else:
                # The SDK's and the command's own modules and headers.
                allowed = to.split("/")[0] == path.split("/")[0] or (
                    to.startswith("sdk/") and not path.startswith("core/"))
            if not allowed:
                yield f"{path}:{number}: {line.strip()} points up, to {to}"


def main():
    found = list(findings(pathlib.Path(sys.argv[1])))
    for finding in found:
        print(finding)
    print(f"layering: {len(found)} findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
