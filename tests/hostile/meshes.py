"""Mutants of mesh files: none may end Candela with a signal, keep it busy for more than ten seconds, or make it print
what is not UTF-8.

    meshes.py CANDELA [--count N] [--seed S] [--format ply|stl|obj|gltf|glb] [--keep FOLDER] [--jobs J]

N mutants (default 200) of each format, made from the files of tests/real with fixed seeds: mutant I of a format is the
same for every N and on every machine. Those that fail are kept in FOLDER.
"""
import argparse
import concurrent.futures
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "real"))
import files  # noqa: E402

LIMIT = 10  # seconds of processor time
PATIENCE = 60  # seconds of any time, on a busy machine

SCENE = """version = 1
[observer]
position = [0, 0, 4]
look_at = [0, 0, 0]
[shading]
model = "phong"
[reflection]
model = "ward"
[[light]]
type = "ambient"
[[object]]
type = "mesh"
file = "{}"
"""

NUMBERS = [b"0", b"-1", b"1", b"255", b"256", b"65535", b"65536", b"2147483647", b"2147483648", b"4294967295",
           b"4294967296", b"18446744073709551615", b"99999999999999999999", b"1e9", b"1e38", b"1e39", b"1e-46", b"nan",
           b"inf", b"-inf", b".", b"-", b"0x10", b"1e999999999", b""]
WORDS = [b"vertex", b"face", b"tristrips", b"property list char double x", b"end_header", b"format ascii 1.0",
         b"format binary_big_endian 1.0", b"element face 1000000000", b"facet normal", b"endloop", b"solid", b"endsolid",
         b"f", b"v", b"vn", b"vt", b"s 1", b"s off", b"mtllib /dev/zero", b"\\", b"#", b"/", b"//", b"{", b"}", b"[", b"]",
         b'"count":', b'"byteOffset":', b'"sparse":', b'"uri":"/dev/zero"', b'"bufferView":', b"\xff\xfe", b"\xc3",
         b"\x1b[31m", b"\xe2\x80\xae", b"\xc2\x9b", b"\0", b"\r", b"\n", b"\r\n"]


def spans_of_digits(data: bytes):
    spans, begin = [], None
    for i, c in enumerate(data + b" "):
        if 48 <= c <= 57:
            begin = i if begin is None else begin
        elif begin is not None:
            spans.append((begin, i))
            begin = None
    return spans


def mutated(data: bytes, others: list, chance: random.Random) -> bytes:
    for _ in range(chance.choice((1, 1, 1, 2, 3, 6))):
        kind = chance.randrange(10)
        at = chance.randrange(len(data) + 1)
        size = min(chance.choice((1, 1, 2, 4, 4, 8, 50, 200)), len(data) - at)
        if kind == 0:  # a bit
            if at < len(data):
                data = data[:at] + bytes([data[at] ^ 1 << chance.randrange(8)]) + data[at + 1:]
        elif kind == 1:  # bytes
            data = data[:at] + chance.randbytes(size) + data[at + size:]
        elif kind == 2:  # extreme ones
            data = data[:at] + bytes([chance.choice((0, 0x7F, 0x80, 0xFF))]) * size + data[at + size:]
        elif kind == 3:  # less
            data = data[:at] + data[at + size:]
        elif kind == 4:  # twice
            data = data[:at] + data[at:at + size] * chance.choice((2, 2, 3, 50)) + data[at + size:]
        elif kind == 5:  # cut off
            data = data[:at]
        elif kind in (6, 7):  # a number
            spans = spans_of_digits(data)
            if spans:
                begin, end = chance.choice(spans)
                data = data[:begin] + chance.choice(NUMBERS) + data[end:]
        elif kind == 8:  # a word
            data = data[:at] + b" " * chance.randrange(2) + chance.choice(WORDS) + b" " * chance.randrange(2) + data[at:]
        else:  # of another file
            other = chance.choice(others)
            begin = chance.randrange(len(other) + 1)
            data = data[:at] + other[begin:begin + 10 * size] + data[at + size:]
    return data


def seeds_by_format() -> dict:
    seeds = {}
    for case in files.cases():
        name, content = next(iter(case.files.items()))
        if len(content) < 20_000:
            seeds.setdefault(Path(name).suffix[1:], []).append(content)
    return seeds


def mutant(seeds: list, form: str, seed: int, index: int) -> bytes:
    chance = random.Random(f"{form} {seed} {index}")
    return mutated(chance.choice(seeds), seeds, chance)


def problem_of(candela: str, form: str, content: bytes, directory: Path) -> str:
    name = f"a.{form}"
    (directory / name).write_bytes(content)
    (directory / "scene.toml").write_text(SCENE.format(name))
    try:
        done = subprocess.run(["prlimit", f"--cpu={LIMIT}", candela, "check", "scene.toml"], cwd=directory,
                              capture_output=True, timeout=PATIENCE,
                              stdin=subprocess.DEVNULL, check=False)
    except subprocess.TimeoutExpired:
        return f"it takes more than {PATIENCE} s"
    if done.returncode < 0 or done.returncode > 4:
        return f"exit code {done.returncode}: {done.stderr[-300:]!r}"
    try:
        (done.stdout + done.stderr).decode()
    except UnicodeDecodeError as problem:
        return f"its output is not UTF-8: {problem}"
    if done.returncode != 0 and not done.stderr:
        return "it fails and says nothing"
    return ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("candela", type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--format", action="append", choices=["ply", "stl", "obj", "gltf", "glb"])
    parser.add_argument("--keep", type=Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()

    seeds = seeds_by_format()
    failed = 0
    with tempfile.TemporaryDirectory() as scratch:
        def tried(form: str, index: int):
            directory = Path(scratch) / f"{form}-{index}"
            directory.mkdir()
            content = mutant(seeds[form], form, options.seed, index)
            problem = problem_of(options.candela, form, content, directory)
            for file in directory.iterdir():
                file.unlink()
            directory.rmdir()
            return index, content, problem

        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for form in options.format or sorted(seeds):
                wrong = 0
                for index, content, problem in pool.map(lambda i, f=form: tried(f, i), range(options.count)):
                    if not problem:
                        continue
                    wrong += 1
                    print(f"{form} {index}: {problem}", flush=True)
                    if options.keep:
                        options.keep.mkdir(parents=True, exist_ok=True)
                        (options.keep / f"{index}.{form}").write_bytes(content)
                failed += wrong
                print(f"{form}: {options.count} mutants of {len(seeds[form])} files, {wrong} failed", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
