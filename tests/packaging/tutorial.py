#!/usr/bin/env python3
"""Follows docs/plugins/tutorial.md with only an installed Candela.

    tutorial.py BUILD_DIR SCRATCH_DIR CMAKE DOCUMENT

A block fenced with ```LANGUAGE FILE is written to FILE; ```sh is run, all such blocks in one shell; ```text is the last one's
expected output: these lines in this order, where … stands for anything within a line, or for any lines on a line of its own.
Exit code 77: it cannot run here; it prints the reason.
"""

import difflib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

LINES_OF_ITS_OWN = 15  # that the model may have in addition to the template's


def fail(message):
    sys.exit(f"FAILED: {message}")


def blocks(text):
    """(language, file, content, line) of each fenced block."""
    found = []
    for match in re.finditer(r"^```([a-z]+)(?: (\S+))?\n(.*?)^```$", text, re.M | re.S):
        found.append((match[1], match[2], match[3], text.count("\n", 0, match.start()) + 1))
    # An unrecognised fence would silently be skipped.
    fences = len(re.findall(r"^\s*(?:```|~~~)", text, re.M))
    if fences != 2 * len(found):
        fail(f"{fences} fences make {len(found)} blocks")
    return found


def matches(expected, printed):
    """The first line of `expected` that is not printed where it should be; None if all are."""
    rest = printed.splitlines()
    anywhere = False
    for line in expected.splitlines():
        if line == "…":
            anywhere = True
            continue
        pattern = re.compile(".*".join(map(re.escape, line.split("…"))))
        at = next((i for i, candidate in enumerate(rest) if pattern.fullmatch(candidate)), None)
        if at is None or (at > 0 and not anywhere):
            return line
        rest = rest[at + 1 :]
        anywhere = False
    return None if anywhere or not rest else f"(end of output expected, but found:) {rest[0]}"


class Shell:
    """One shell for all blocks, so that `cd` persists."""

    END = "end-of-block-7f3a"

    def __init__(self, directory, environment):
        self.process = subprocess.Popen(
            ["bash", "--norc"], cwd=directory, env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip

    def run(self, commands):
        """Runs commands; returns their output and the first non-zero exit code."""
        # No command of a block may read the following blocks.
        script = f"{{ set -e\n{commands}\n}} </dev/null\nprintf '\\n%s\\n' {self.END}; pwd\n"
        self.process.stdin.write(script)
        self.process.stdin.flush()
        printed = []
        for line in self.process.stdout:
            if line.rstrip("\n") == self.END:
                self.directory = Path(self.process.stdout.readline().rstrip("\n"))
                return "".join(printed).removesuffix("\n")
            printed.append(line)
        fail(f"a command failed:\n{commands}\n{''.join(printed)}")


def own_lines(template, text):
    """Lines that the template does not have, except comments and empty ones."""
    def code(of):
        return [line for line in map(str.strip, of.splitlines()) if line and not line.startswith("//")]

    return [line[2:] for line in difflib.ndiff(code(template), code(text)) if line.startswith("+ ")]


def main():
    build, scratch, cmake, document = map(Path, sys.argv[1:])
    for tool in ("bash", "c++", "make"):
        if not shutil.which(tool):
            print(f"SKIPPED: {tool} is not installed")
            sys.exit(77)
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "home").mkdir(parents=True)
    prefix = scratch / "prefix"
    subprocess.run([cmake, "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("CANDELA_", "XDG_", "CMAKE_"))}
    environment |= {"HOME": str(scratch / "home"), "PATH": f"{prefix}/bin:{cmake.parent}:{os.environ['PATH']}", "LC_ALL": "C.UTF-8"}

    shell = Shell(scratch, environment)
    shell.run("true")
    templates, counts, printed = {}, {"file": 0, "sh": 0, "text": 0}, None
    for language, file, content, line in blocks(document.read_text()):
        place = f"{document.name}:{line}"
        if file:
            target = shell.directory / file
            if target.exists():
                templates[file] = target.read_text()
            target.write_text(content)
            counts["file"] += 1
        elif language == "sh":
            print(f"== {place}\n{content}", end="", flush=True)
            printed = shell.run(content)
            print("\n".join(f"    {output}" for output in printed.splitlines()), flush=True)
            counts["sh"] += 1
        elif language == "text" and printed is not None:
            if (missing := matches(content, printed)) is not None:
                fail(f"{place}: not printed: {missing}")
            printed = None
            counts["text"] += 1
        else:
            fail(f"{place}: a block that is neither a file nor commands nor output")
    if counts["file"] < 3 or min(counts["sh"], counts["text"]) < 4:
        fail(f"the tutorial has lost its blocks: {counts}")

    own = []
    for file, template in templates.items():
        if file.endswith((".kernel", ".cpp")) and not file.endswith("_test.cpp"):
            own += own_lines(template, (shell.directory / file).read_text())
    print(f"== {len(own)} lines of the model's own:", *own, sep="\n    ")
    if not 0 < len(own) <= LINES_OF_ITS_OWN:
        fail(f"{len(own)} lines, {LINES_OF_ITS_OWN} are allowed")
    if f"changes {len(own)} of its lines" not in document.read_text():
        fail(f"{document.name} does not state {len(own)} changed lines")

    pictures = {name: (shell.directory / name).read_bytes() for name in ("cel.png", "two.png", "installed.png")}
    if pictures["cel.png"] != pictures["installed.png"] or pictures["cel.png"] == pictures["two.png"]:
        fail("the pictures do not match the scene")
    left = [str(path) for path in (scratch / "home").rglob("*") if path.is_file()]
    if left or (shell.directory / "none.png").exists():
        fail(f"left behind: {left}")
    print("== all well")


main()
