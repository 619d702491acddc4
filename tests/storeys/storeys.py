#!/usr/bin/env python3
"""Checks that imports and includes point down: api < base < host < scene < render < core < sdk, apps.

Plugins, and the parts of the SDK that are built into plugins, see api and the SDK's headers, and nothing else.
    storeys.py ROOT
"""
import pathlib
import re
import sys

STOREYS = ["api", "base", "host", "scene", "render", "core"]
SOURCES = {".cpp", ".cppm", ".h", ".kernel"}
# What is compiled into plugins, as opposed to the SDK's programs.
SDK_OF_PLUGINS = ("sdk/include/", "sdk/target/", "sdk/templates/")


def sources(root):
    for top in ("core", "sdk", "plugins", "apps"):
        for path in sorted((root / top).rglob("*")):
            if path.suffix in SOURCES and path.is_file():
                yield path.relative_to(root).as_posix(), path.read_text(encoding="utf-8")


def storey_of(path):
    """The storey of a core file: its folder below core/, or "core" for what re-exports all of them."""
    parts = path.split("/")
    return parts[1] if len(parts) > 2 else "core"


def below(path):
    """The storeys that a file may import."""
    if path.startswith("core/"):
        return STOREYS[: STOREYS.index(storey_of(path)) + 1]
    if path.startswith("plugins/") or path.startswith(SDK_OF_PLUGINS):
        return STOREYS if path.endswith("_test.cpp") else ["api"]
    return STOREYS


def findings(root):
    files = dict(sources(root))
    modules = {}
    for path, text in files.items():
        for name in re.findall(r"^export module (candela\.\w+);", text, re.MULTILINE):
            modules[name] = path
    headers = {path.split("/include/")[1]: path for path in files if "/include/candela/" in path}
    for path, text in files.items():
        for number, line in enumerate(text.splitlines(), 1):
            imported = re.match(r"\s*(?:export )?import (candela\.\w+)", line)
            included = re.match(r'\s*#include "([^"]+)"', line)
            to = None
            if imported:
                to = modules.get(imported[1])
                if to is None:
                    yield f"{path}:{number}: no source file exports {imported[1]}"
                    continue
            elif included and included[1].startswith("candela/"):
                to = headers.get(included[1])
                if to is None:
                    yield f"{path}:{number}: neither core/api nor the SDK has a header {included[1]}"
                    continue
            elif included and ".." in included[1]:
                yield f"{path}:{number}: {included[1]} leaves its folder"
                continue
            if to is None:
                continue
            if to.startswith("core/"):
                allowed = storey_of(to) in below(path)
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
    print(f"storeys: {len(found)} imports or includes point up")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
