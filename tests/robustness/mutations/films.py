"""Mutants of command lines and records of frames and parts of pictures: none may end a verb with a signal, keep it busy for more
than ten seconds, make it print invalid UTF-8 or terminal control characters, leave an unfinished file behind, or be mistaken for
something else.

    films.py CANDELA [--count N] [--seed S] [--kind KIND] [--keep FOLDER] [--jobs J]

N mutants of each kind: command lines of animate, render --part, assemble, submit and status; the plan and journals of a job, read
by status; the records of frames, read by animate; the description and records of a picture's parts, read by assemble.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import mutation

SCENE = """version = 1
image = { width = 16, height = 8 }
observer = { position = [0, 1, 4], look_at = [0, 0, 0] }
shading = { model = "flat" }
reflection = { model = "lambert" }
light = [{ name = "l", type = "point", position = [0, 3, 1] }]
object = [{ name = "b", type = "cube" }]
[animation]
frames = 3
fps = 10
[[animation.track]]
path = "light.l.intensity"
keys = [[0.0, 1.0], [0.2, 3.0]]
"""

COMMANDS = [line.split() for line in (
    "animate scene.toml -o f/%04d.png --frames 0..2 --step 1 --threads 1",
    "animate scene.toml -o f/%02d.ppm --frames 1 --force --set light.l.intensity=3",
    "render scene.toml -o p.tif --part 1/4 --frame 2",
    "render scene.toml -o p.png --part 3/3 --width 24 --height 12 --samples 4",
    "assemble p.tif --keep-parts --threads 2",
    "submit scene.toml -o f/%04d.png --engine print --chunk 2 --frames 0..2 --step 2",
    "submit scene.toml -o f/%04d.png --engine slurm --dry-run --slurm=--partition=render --threads 2 --jobs 2",
    "submit scene.toml -o p.tif --parts 4 --engine print --width 20",
    "submit scene.toml -o p.exr --parts 2 --engine slurm --dry-run --frame 1",
    "--task j.json animate scene.toml -o f/%02d.ppm --frames 0 --threads 1",
    "status f --json", "status . --quiet")]
WORDS = [b"%04d", b"%d", b"%%", b"%s", b"%n", b"%099d", b"..", b"0..2", b"2..0", b"-1..1", b"1/4", b"4/1", b"0/0", b"-1/2", b"1/", b"/1",
         b"1/9999999999", b"--part", b"--parts", b"--frames", b"--step", b"--chunk", b"--jobs", b"-o", b"=", b".png", b".tif", b".exr",
         b".gif", b"-", b"'", b'"', b"$(id)", b";", b"`", b"\\", b"\n", b"\x1b[31m", b"\xc2\x9b", b"\xe2\x80\xae", b"\xff", b"\xc3",
         b"null", b"{}", b"[]", b"true", b"\"done\"", b"\"../..\"", b"version", b"inputs", b"bytes"]
UNFINISHED = ".candela-"  # and a number


def made(candela: str, directory: Path) -> None:
    """A scene, its frames with their records, the job that made them, and a picture's two parts."""
    (directory / "scene.toml").write_text(SCENE)
    for words in ("submit scene.toml -o f/%04d.png --chunk 1 --jobs 1 --quiet", "render scene.toml -o p.tif --part 1/2 --quiet",
                  "render scene.toml -o p.tif --part 2/2 --quiet"):
        subprocess.run([candela, *words.split()], cwd=directory, check=True, stdin=subprocess.DEVNULL)


def files_below(directory: Path) -> dict:
    return {path.relative_to(directory): path.read_bytes() for path in directory.rglob("*") if path.is_file()}


TEMPLATE = Path(tempfile.mkdtemp())
SEEDS = [word.encode() for words in COMMANDS for word in words[1:]]


def argument_of(word: str, chance) -> str:
    """A mutant that does not name files elsewhere, nor a film, which would test ffmpeg."""
    mutant = mutation.mutated(word.encode("utf-8", "surrogateescape"), SEEDS, chance, WORDS).replace(b"\0", b"")[:300]
    while b"../" in mutant or mutant.startswith(b"/"):
        mutant = mutant.replace(b"../", b"").lstrip(b"/")
    for film in (b".mp4", b".webm", b".gif"):
        mutant = mutant.replace(film, b".png")
    if mutant.startswith((b"--output=/", b"-o/")):
        return word
    return mutant.decode("utf-8", "surrogateescape")


def arguments(candela: str, directory: Path, chance) -> str:
    words = list(chance.choice(COMMANDS))
    for _ in range(chance.choice((1, 1, 2, 3))):
        at = chance.randrange(1, len(words))
        kind = chance.randrange(4)
        if kind == 0:
            del words[at]
        elif kind == 1:
            words.insert(at, chance.choice(chance.choice(COMMANDS)[1:]))
        else:
            words[at] = argument_of(words[at], chance)
        if len(words) == 1:
            break
    (directory / "command.txt").write_text(repr(words))
    _, wrong = mutation.run([candela, *words], directory, codes=(0, 1, 2, 3))
    return wrong and f"{words}: {wrong}"


def change_one(directory: Path, pattern: str, chance) -> Path:
    found = sorted(path for path in directory.glob(pattern) if path.is_file())
    changed = chance.choice(found)
    contents = [path.read_bytes() for path in found]
    changed.write_bytes(mutation.mutated(changed.read_bytes(), contents, chance, WORDS))
    return changed


def jobs(candela: str, directory: Path, chance) -> str:
    changed = change_one(directory, "f/.candela/jobs/*/*.json", chance)
    before = files_below(directory)
    for options in ([], ["--json"]):
        _, wrong = mutation.run([candela, "status", "f", *options], directory, codes=(0, 1, 2))
        if wrong:
            return f"{changed.name}: {wrong}"
    return "" if files_below(directory) == before else f"{changed.name}: status has written a file"


def frames(candela: str, directory: Path, chance) -> str:
    """Whatever a record contains, the frames are those of the scene."""
    pictures = {path: path.read_bytes() for path in directory.glob("f/*.png")}
    changed = change_one(directory, "f/.candela/*.png", chance)
    if chance.randrange(2):
        changed = directory / "f" / changed.name
        changed.write_bytes(mutation.mutated(changed.read_bytes(), list(pictures.values()), chance, WORDS))
    _, wrong = mutation.run([candela, "animate", "scene.toml", "-o", "f/%04d.png", "--threads", "1"], directory, codes=(0,))
    if wrong:
        return f"{changed.name}: {wrong}"
    return "" if all(path.read_bytes() == content for path, content in pictures.items()) else f"{changed.name}: a frame is wrong"


def parts(candela: str, directory: Path, chance) -> str:
    """A wrong description or record does not make a wrong picture."""
    changed = change_one(directory, chance.choice(("p.tif.parts/*.json", "p.tif.parts/.candela/*", "p.tif.parts/*.pixels")), chance)
    done, wrong = mutation.run([candela, "assemble", "p.tif", "--keep-parts"], directory, codes=(0, 1, 2))
    if wrong:
        return f"{changed.name}: {wrong}"
    picture = directory / "p.tif"
    if done.returncode != 0:
        return f"{changed.name}: there is a picture despite exit code {done.returncode}" if picture.exists() else ""
    return "" if picture.read_bytes() == RIGHT.read_bytes() else f"{changed.name}: the picture is wrong"


RIGHT = TEMPLATE / "right.tif"
KINDS = {"arguments": arguments, "jobs": jobs, "frames": frames, "parts": parts}


def problem_of(candela: str, directory: Path, kind: str, chance, _index: int) -> str:
    shutil.copytree(TEMPLATE / "made", directory, dirs_exist_ok=True)
    problem = KINDS[kind](candela, directory, chance)
    left = [path for path in directory.rglob("*") if path.name.startswith(UNFINISHED)]
    return problem or (f"it leaves {left[0].name} behind" if left else "")


if __name__ == "__main__":
    try:
        command = str(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
        if command:
            (TEMPLATE / "made").mkdir()
            made(command, TEMPLATE / "made")
            subprocess.run([command, "render", "made/scene.toml", "-o", RIGHT.name, "--quiet"], cwd=TEMPLATE, check=True)
        sys.exit(mutation.sweep(__doc__, 100, list(KINDS), problem_of))
    finally:
        shutil.rmtree(TEMPLATE)
