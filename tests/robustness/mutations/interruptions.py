"""Interrupted commands: SIGINT, SIGTERM or SIGHUP at a random moment leaves the old files or the complete new result, nothing
else, no temporary file and no process, within ten seconds. For jobs and animations, this holds for each picture.

    interruptions.py CANDELA [--count N] [--kind render-over|check|verify-over|...] [--seed S] [--keep FOLDER] [--jobs J]

N signals for each kind of command.
"""
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import mutation

UNFINISHED = ".candela-"  # and a number
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
LIMIT = 10  # seconds from the signal to the end
SETTLED = 2  # seconds after the end until everything is gone: a killed program may have to finish a system call

SCENE = """version = 1
[observer]
position = [0.5, 1.5, 4.0]
look_at = [0.0, 0.0, 0.0]
[image]
width = {size}
height = {size}
samples = 4
[shading]
model = "phong"
[reflection]
model = "blinn-phong"
[[light]]
type = "point"
position = [2.6, 2.6, 2.6]
intensity = 20
[[object]]
type = "torus"
color = {color}
segments = {segments}
"""
COLORS = {"old": "[40, 90, 235]", "new": "[235, 90, 40]"}
LARGE = {"size": 700, "segments": 150}
SMALL = {"size": 120, "segments": 16}


@dataclass
class Kind:
    words: list  # after `candela`, in a folder with scene.toml, a.ppm, b.ppm and out/, where all results go
    replaces: bool = False  # there is output of an earlier run
    scene: dict = None
    piped: bool = False  # the scene comes from a pipe, and the picture goes to a pipe
    codes: tuple = (0,)
    reproducible: bool = True  # two runs write the same bytes
    piecewise: bool = False  # each picture by itself is old or new, and .candela/ is of this run
    more: str = ""  # of the scene


FILM = """[animation]
frames = 6
fps = 12
[animation.orbit]
"""
MEDIUM = {"size": 200, "segments": 40}
JOB = {"scene": MEDIUM, "piecewise": True, "more": FILM}

KINDS = {
    "render-new": Kind(["render", "scene.toml", "-o", "out/a.png"], scene=LARGE),
    "render-over": Kind(["render", "scene.toml", "-o", "out/a.png"], replaces=True, scene=LARGE),
    "render-exr": Kind(["render", "scene.toml", "-o", "out/a.exr"], replaces=True, scene=LARGE),
    "render-pipe": Kind(["render", "-", "-o", "-"], scene=LARGE, piped=True),
    "check": Kind(["check", "scene.toml"], scene={"size": 100, "segments": 250}),
    "generate-new": Kind(["generate", "scene.toml", "--target", "opengl", "-o", "out/program"], scene=SMALL),
    "generate-over": Kind(["generate", "scene.toml", "--target", "webgl", "-o", "out/program"], replaces=True, scene=SMALL),
    "verify": Kind(["verify", "scene.toml", "--target", "cpp"], scene=SMALL),
    "verify-new": Kind(["verify", "scene.toml", "--target", "cpp", "--report", "out/report"], scene=SMALL,
                       reproducible=False),
    "verify-over": Kind(["verify", "scene.toml", "--target", "webgl", "--report", "out/report"], replaces=True, scene=SMALL,
                        reproducible=False),
    "plugin-new": Kind(["plugin", "new", "reflection", "cel", "out/cel"]),
    "plugin-test": Kind(["plugin", "test", "{plugins}/reflection-phong.so"]),
    "new": Kind(["new", "out/begin.toml"]),
    "animate-film": Kind(["animate", "scene.toml", "-o", "out/film.mp4"], scene=MEDIUM, more=FILM),
    "animate-over": Kind(["animate", "scene.toml", "-o", "out/%04d.png", "-o", "out/film.mp4"], replaces=True, **JOB),
    "submit-new": Kind(["submit", "scene.toml", "-o", "out/%04d.png", "-o", "out/film.mp4", "--chunk", "2", "--jobs", "2"], **JOB),
    "submit-over": Kind(["submit", "scene.toml", "-o", "out/%04d.png", "-o", "out/film.webm", "--chunk", "1", "--jobs", "3"],
                        replaces=True, **JOB),
    "submit-parts": Kind(["submit", "scene.toml", "-o", "out/a.png", "--parts", "4", "--jobs", "2"], scene=MEDIUM, replaces=True,
                         piecewise=True),
    "diff": Kind(["diff", "a.ppm", "b.ppm", "-o", "out/heat.png"], codes=(0, 1), scene=SMALL),
}


def contents_of(folder: Path) -> dict:
    return {str(p.relative_to(folder)): p.read_bytes() if p.is_file() else None for p in sorted(folder.rglob("*"))}


def processes_in(temporary: str) -> list:
    """The processes that have inherited this folder for temporary files."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and os.fsencode(temporary) in (entry / "environ").read_bytes():
                found.append(f"{entry.name} ({(entry / 'comm').read_text().strip()})")
        except OSError:
            pass  # it has ended
    return found


class Bench:
    """A folder to run a kind of command in, with its input files."""

    def __init__(self, candela: str, kind: Kind, folder: Path, scene: str):
        self.folder, self.kind, self.out = folder, kind, folder / "out"
        self.out.mkdir(parents=True, exist_ok=True)
        self.text = SCENE.format(color=COLORS[scene], **(kind.scene or SMALL)) + kind.more
        (folder / "scene.toml").write_text(self.text)
        plugins = Path(candela).parent.parent / "lib" / "candela" / "plugins"
        self.command = [candela, *(word.format(plugins=plugins) for word in kind.words)]
        # Not in the folder, whose path may be too long for a browser's sockets.
        self.temporary = tempfile.mkdtemp(prefix="interrupted-")
        self.environment = {**os.environ, "TMPDIR": self.temporary}

    def prepare_pictures(self, candela: str) -> None:
        if "a.ppm" in self.kind.words:
            for name, color in (("a.ppm", "old"), ("b.ppm", "new")):
                (self.folder / "scene.toml").write_text(SCENE.format(color=COLORS[color], **self.kind.scene))
                subprocess.run([candela, "render", "scene.toml", "-o", name], cwd=self.folder, check=True, capture_output=True)

    def start(self) -> subprocess.Popen:
        process = subprocess.Popen(self.command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE,
                                   stdin=subprocess.PIPE if self.kind.piped else subprocess.DEVNULL)
        return process

    def close(self) -> None:
        shutil.rmtree(self.temporary, ignore_errors=True)


@dataclass
class Reference:
    old: dict  # the content of out/ after an earlier run, or nothing
    new: dict  # its content after this run
    seconds: float  # that a run takes
    folder: Path


references: dict = {}
lock = threading.Lock()


def reference_for(candela: str, name: str, scratch: Path) -> Reference:
    """The results of uninterrupted runs; made once."""
    with lock:
        if name in references:
            return references[name]
        kind = KINDS[name]
        folder = Path(tempfile.mkdtemp(prefix=f"{name}-", dir=scratch))
        seconds = 0.0
        trees = [{}]
        for scene in ("old", "new") if kind.replaces else ("new",):
            bench = Bench(candela, kind, folder, scene)
            bench.prepare_pictures(candela)
            begin = time.monotonic()
            process = bench.start()
            _, said = process.communicate(bench.text.encode() if kind.piped else None)
            seconds = time.monotonic() - begin
            if process.returncode not in kind.codes:
                sys.exit(f"{' '.join(bench.command)} ends with {process.returncode}: {said.decode(errors='replace')}")
            if scene == "old":
                shutil.copytree(bench.out, folder / "old")
            trees.append(contents_of(bench.out))
            bench.close()
        references[name] = Reference(trees[-2], trees[-1], seconds, folder)
        return references[name]


def is_own(path: str) -> bool:
    """Whether it is a record, a plan, a journal or a part, which the next run needs."""
    return any(part == ".candela" or part.endswith(".parts") for part in Path(path).parts)


def wrong_pieces(found: dict, reference: Reference) -> str:
    """Files that are neither old results nor new ones, file by file."""
    for path, content in found.items():
        if UNFINISHED in path:
            return f"it leaves {path}"
        if is_own(path):
            continue
        if path not in reference.old and path not in reference.new:
            return f"it leaves {path}"
        if content not in [result[path] for result in (reference.old, reference.new) if path in result]:
            return f"{path} is neither old nor new"
    missing = sorted(path for path in reference.old if path not in found and not is_own(path))
    return f"it has lost {', '.join(missing[:5])}" if missing else ""


def is_whole_new(kind: Kind, found: dict, reference: Reference) -> bool:
    if not kind.piecewise:
        return found == reference.new
    return all(found.get(path) == content for path, content in reference.new.items() if not is_own(path))


def wrong_with(name: str, found: dict, reference: Reference) -> str:
    """The problem of a result that is neither the old one nor the complete new one."""
    if found in (reference.old, reference.new):
        return ""
    kind = KINDS[name]
    if kind.piecewise:
        return wrong_pieces(found, reference)
    if not kind.reproducible and set(found) == set(reference.new):
        # A report of this run: its page is written last.
        return ""
    strange = sorted(set(found) - set(reference.old) - set(reference.new))
    if strange:
        return f"it leaves {', '.join(strange[:5])}"
    missing = sorted(set(reference.old or reference.new) - set(found))
    return f"a result is neither old nor new: {len(found)} files, without {', '.join(missing[:5]) or 'any missing'}"


def left_by(bench: Bench) -> str:
    """The programs and temporary files that remain after a while."""
    until = time.monotonic() + SETTLED
    while True:
        if alive := processes_in(bench.temporary):
            problem = f"it leaves {', '.join(alive)} running"
        elif left := os.listdir(bench.temporary):
            problem = f"it leaves {', '.join(left)} among the temporary files"
        else:
            return ""
        if time.monotonic() > until:
            return problem
        time.sleep(0.02)


def problem_of(candela: str, directory: Path, name: str, chance, _index: int) -> str:
    kind = KINDS[name]
    reference = reference_for(candela, name, directory.parent)
    bench = Bench(candela, kind, directory, "new")
    for picture in reference.folder.glob("*.ppm"):
        shutil.copy(picture, directory)
    if kind.replaces:
        shutil.copytree(reference.folder / "old", bench.out, dirs_exist_ok=True)
    number = chance.choice(SIGNALS)
    moment = chance.uniform(0, 1.1 * reference.seconds)
    # Films are encoded last, by a separate program, which a random moment would rarely hit.
    while_encoding = bool(kind.more) and chance.randrange(2) == 0
    process = bench.start()
    ended = threading.Event()
    sent = []

    def interrupt() -> None:
        if while_encoding:
            while not any(bench.out.glob(f"{UNFINISHED}*/**/frames")) and not ended.wait(0.005):
                pass
        if not ended.wait(moment / 10 if while_encoding else moment):
            sent.append(time.monotonic())
            process.send_signal(number)

    interrupter = threading.Thread(target=interrupt)
    interrupter.start()
    try:
        said = process.communicate(bench.text.encode() if kind.piped else None,
                                   timeout=moment + LIMIT + 10 * reference.seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        return f"it does not end after signal {number}, sent after {moment:.3f} s"
    finally:
        end = time.monotonic()
        ended.set()
        interrupter.join()
    problem = ""
    what = f"signal {number.name} after {moment:.3f} of {reference.seconds:.3f} s{' or while encoding' if while_encoding else ''}: "
    if process.returncode not in (*kind.codes, -number):
        problem = f"exit code {process.returncode}: {said[1][-300:]!r}"
    elif process.returncode == -number and end - sent[0] > LIMIT:
        problem = f"it ends {end - sent[0]:.1f} s after the signal"
    elif wrong := mutation.unprintable((b"" if kind.piped else said[0]) + said[1]):
        problem = wrong
    elif process.returncode in kind.codes and kind.reproducible and not is_whole_new(kind, contents_of(bench.out), reference):
        problem = "it succeeds, but its result is not the complete new one"
    else:
        problem = wrong_with(name, contents_of(bench.out), reference)
    problem = problem or left_by(bench)
    with lock:
        outcomes[process.returncode == -number] += 1
    bench.close()
    return what + problem if problem else ""


outcomes = {True: 0, False: 0}

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background jobs ignore it, and so would the commands
    code = mutation.sweep(__doc__, 64, sorted(KINDS), problem_of)
    print(f"{outcomes[True]} ended by the signal, {outcomes[False]} were done before it")
    sys.exit(code)
