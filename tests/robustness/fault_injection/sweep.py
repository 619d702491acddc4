#!/usr/bin/env python3
"""Fails every call that the command makes, one per run, as SQLite's tests do.

Whatever fails, the command ends with exit code 0 and the whole result, or with exit code 1, a message, the old file,
and nothing else; never by a signal. The preloaded library makes the nth call fail (failing_calls.cpp).

    sweep.py --candela build/release/bin/candela --library FAILING_CALLS.so          a part, in seconds
    sweep.py --candela … --library … --all                                          all of it, in a quarter of an hour
"""
import argparse
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SCENE = """version = 1
include = ["more.toml"]
[observer]
position = [0.5, 1.5, 4.0]
look_at = [0.0, 0.0, 0.0]
[image]
width = 40
height = 30
samples = 4
[shading]
model = "phong"
[reflection]
model = "blinn-phong"
[[object]]
type = "sphere"
segments = 16
"""
MORE = """[[light]]
name = "lamp"
type = "point"
position = [2.6, 2.6, 2.6]
intensity = 20.5
[[object]]
type = "mesh"
file = "wedge.ply"
position = [2.0, 0.0, 0.0]
"""
PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""

CALLS = ["malloc", "open", "read", "write", "close", "fsync", "fchmod", "linkat", "rename"]
OLD = b"what was there before"


class Case:
    """A command line, the file or folder that it makes (none: standard output is the result), and the files that exist before."""

    def __init__(self, name, words, result=None, old=None):
        self.name, self.words, self.result, self.old = name, words, result, old


CASES = [
    Case("render, a new picture", ["render", "scene.toml", "-o", "out/a.png"], "out/a.png"),
    Case("render, replacing one", ["render", "scene.toml", "-o", "out/a.ppm"], "out/a.ppm", old=OLD),
    Case("check", ["check", "scene.toml"]),
    Case("check --json", ["check", "--json", "scene.toml"]),
    Case("new", ["new", "out/new.toml"], "out/new.toml"),
    Case("compare", ["compare", "scene.toml", "--reflection", "phong,lambert", "-o", "out/sheet.png"], "out/sheet.png"),
    Case("edit", ["edit", "out/scene.toml", "--change", "image.width=41"], "out/scene.toml",
         old=SCENE.replace('include = ["more.toml"]\n', "").encode()),
    Case("generate", ["generate", "scene.toml", "--target", "cpp", "-o", "out/program"], "out/program"),
]


class Run:
    """One run in a folder of its own."""

    def __init__(self, options, case, call, number):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="candela-sweep-", dir=options.scratch))
        for name, text in {"scene.toml": SCENE, "more.toml": MORE, "wedge.ply": PLY}.items():
            (self.folder / name).write_text(text)
        (self.folder / "out").mkdir()
        if case.old is not None:
            (self.folder / case.result).write_bytes(case.old)
        count = self.folder / "count"
        environment = dict(os.environ, LD_PRELOAD=str(options.library), CANDELA_FAIL_CALL=call,
                           CANDELA_FAIL_AT=str(number), CANDELA_FAIL_COUNT=str(count))
        environment.pop("CANDELA_PLUGIN_PATH", None)
        done = subprocess.run([options.candela, *case.words], cwd=self.folder, env=environment,
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=120)
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr
        self.calls = int(count.read_text()) if count.exists() else 0
        self.files = {str(path.relative_to(self.folder)): path.read_bytes()
                      for path in sorted((self.folder / "out").rglob("*")) if path.is_file()}
        shutil.rmtree(self.folder)


def complaint(case, call, run, whole):
    """The problem of a run in which a call failed; None if it is correct."""
    if run.code not in (0, 1):
        return f"exit code {run.code}"
    try:
        message = run.err.decode()
    except UnicodeDecodeError:
        return "a message that is not UTF-8"
    if run.code == 1:
        if "error: " not in message and b'"severity": "error"' not in run.out:
            return "exit code 1 without a message"
        old = {} if case.old is None else {case.result: case.old}
        return None if run.files == old else "exit code 1, but there are files: " + ", ".join(run.files)
    if run.files != whole.files:
        return "exit code 0, but not the whole result"
    return None if run.out == whole.out else "exit code 0, but not the whole output"


def points(calls, most):
    """At most `most` numbers from 1 to `calls`, evenly spread; the first and the last few are always among them."""
    if calls <= most:
        return list(range(1, calls + 1))
    chosen = {1 + round(i * (calls - 1) / (most - 1)) for i in range(most)}
    return sorted(chosen | {calls - 1, calls})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--candela", type=pathlib.Path, required=True)
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--all", action="store_true", help="every call, not a sample")
    parser.add_argument("--part", type=int, default=12, help="at most this many failures of each call per command")
    parser.add_argument("--scratch", type=pathlib.Path, help="working folder; default: the folder for temporary files")
    options = parser.parse_args()
    options.candela, options.library = options.candela.resolve(), options.library.resolve()

    failures = runs = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for case in CASES:
            for call in CALLS:
                whole = Run(options, case, call, 0)
                if whole.code != 0:
                    sys.exit(f"{case.name}: without any failure, exit code {whole.code}: {whole.err.decode()}")
                if call == "malloc" and whole.calls == 0:
                    sys.exit(f"{case.name}: no call is counted; is {options.library} loaded?")
                numbers = points(whole.calls, whole.calls if options.all else options.part)
                for number, run in zip(numbers, pool.map(lambda n: Run(options, case, call, n), numbers)):
                    runs += 1
                    wrong = complaint(case, call, run, whole)
                    if wrong is None:
                        continue
                    failures += 1
                    last = run.err.decode(errors="replace").strip().splitlines()[-1:]
                    print(f"{case.name}: {call} number {number} of {whole.calls} fails: {wrong} {last}")
    print(f"{runs} runs, {failures} wrong")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
