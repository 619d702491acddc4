"""Mutants of scenes: none may end `candela check` with a signal, keep it busy for more than ten seconds, or make it
print invalid UTF-8 or terminal control characters; and every error has a place: file, line and column, or only the file if it
concerns the whole file.

    scenes.py CANDELA [--count N] [--seed S] [--keep FOLDER] [--jobs J]

N mutants, made from the scenes of docs/examples and of the fuzzing corpus.
"""
import re
import sys
from pathlib import Path

import mutation

PLACE = re.compile(r"\S.*?(:\d+:\d+)?: error: ")
ROOT = Path(__file__).resolve().parents[3]
WORDS = [b"[[object]]", b"[[light]]", b"[observer]", b"[image]", b"[room]", b"[constraints]", b"[shading]", b"[reflection]",
         b"[object.material]", b'include = ["scene.toml"]', b'include = ["/etc/passwd"]', b'include = ["/dev/zero"]',
         b'include = ["no\xc2\x9b.toml"]', b'environment = "scene.toml"', b'type = "mesh"\nfile = "scene.toml"',
         b'type = "torus"', b'type = "teapot"', b"segments = 4096", b"rings = 4096", b"width = 65536", b"samples = 64",
         b"color = [256, 0, -1]", b"position = [1e10, nan, inf]", b"scale = [1e-45, 0, 1e38]", b"rotation = [1e300, 0, 0]",
         b"= ", b"true", b"[[", b"]]", b"{", b"}", b'"""', b"'''", b'"\\u202e"', b'"\\u0000"', b"\xff\xfe", b"\xc3", b"\xed\xa0\x80",
         b"\x1b[31m", b"\xe2\x80\xae", b"\xc2\x9b", b"\0", b"\r", b"\n", b"\r\n", b"1979-05-27T07:32:00Z", b"0x1F", b"1_000"]


def seeds() -> list:
    corpus = ROOT / "tests/robustness/fuzz/corpus/scene"
    found = sorted((ROOT / "docs" / "examples").glob("*.toml")) + sorted(path for path in corpus.rglob("*") if path.is_file())
    contents = [path.read_bytes() for path in found]
    # Mutants of a thousandfold nesting show nothing new.
    return [content for content in contents if 0 < len(content) < 20_000]


SEEDS = seeds()


def problem_of(candela: str, directory: Path, _kind: str, chance, _index: int) -> str:
    (directory / "scene.toml").write_bytes(mutation.mutated(chance.choice(SEEDS), SEEDS, chance, WORDS))
    done, wrong = mutation.run([candela, "check", "scene.toml"], directory, codes=(0, 1, 2, 3))
    if wrong or done.returncode == 0:
        return wrong
    # An error about a file as a whole has no line; its place is the file.
    placed = [line for line in done.stderr.decode().splitlines() if PLACE.match(line)]
    bare = [line for line in done.stderr.decode().splitlines() if line.startswith("candela: error: ")]
    return "" if placed and not bare else f"an error has no place: {done.stderr[-300:]!r}"


if __name__ == "__main__":
    mutation.fail_without(SEEDS, "scenes")
    sys.exit(mutation.sweep(__doc__, 200, ["scene"], problem_of))
