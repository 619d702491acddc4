"""Fails if a program or library was built without one of the protections that distributions require.

    hardening.py COMPILE-COMMANDS FILE-OR-FOLDER...
"""
import json
import pathlib
import platform
import re
import subprocess
import sys


def is_elf(path):
    with open(path, "rb") as file:
        return file.read(4) == b"\x7fELF"


def readelf(option, path):
    return subprocess.run(["readelf", "--wide", option, path], capture_output=True, text=True, check=True).stdout


def missing(path):
    """The protections that a file lacks."""
    segments, dynamic, header = readelf("--segments", path), readelf("--dynamic", path), readelf("--file-header", path)
    if "GNU_RELRO" not in segments or "NOW" not in dynamic:
        yield "full RELRO (-z relro -z now)"
    if re.search(r"GNU_STACK.* RWE ", segments):
        yield "a non-executable stack"
    if re.search(r"Type:\s+EXEC", header):
        yield "position independence (-pie)"


def unprotected(commands):
    """The sources that are compiled without options that leave no trace in every binary."""
    for entry in json.loads(pathlib.Path(commands).read_text()):
        options = ["-fstack-protector-strong", "-fstack-clash-protection"]
        # The linker marks a file with it only if the C library's own objects have it, and Debian 12's do not.
        if platform.machine() == "x86_64":
            options.append("-fcf-protection")
        # Units that import modules cannot have it (sdk/cmake/CandelaPlugin.cmake).
        if "-DCANDELA_PLUGIN_NAME=" in entry["command"] and "/plugins/" in entry["file"]:
            options.append("-D_FORTIFY_SOURCE=")
        for option in options:
            if f" {option}" not in entry["command"]:
                yield f"{entry['file']}: compiled without {option}"


def files(arguments):
    for argument in map(pathlib.Path, arguments):
        yield from sorted(p for p in (argument.rglob("*") if argument.is_dir() else [argument])
                          if p.is_file() and not p.is_symlink() and is_elf(p))


def main():
    checked = faults = 0
    for fault in unprotected(sys.argv[1]):
        faults += 1
        print(fault)
    for path in files(sys.argv[2:]):
        checked += 1
        for protection in missing(path):
            faults += 1
            print(f"{path}: without {protection}")
    print(f"{checked} programs and libraries, {faults} protections missing")
    return 1 if faults or checked == 0 else 0


sys.exit(main())
