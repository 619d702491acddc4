"""Folders of jobs, frames and parts filled by an attacker: links to other users' files and folders, hard links,
pipes, sockets, folders in place of files, endless files, lying plans and journals, and odd names. None may end `submit`,
`animate`, `status`, `render --part` or `assemble` with a signal, keep it busy for more than ten seconds or make it use more than
4 GB, make it print invalid UTF-8 or terminal control characters, change files outside, leave unfinished files, or make it report
unfinished work as done.

    job_folders.py CANDELA [--count N] [--seconds S] [--kind links|files|values|names] [--seed S] [--keep FOLDER] [--jobs J]

N folders of each kind. Links lead to this run's own folder, whose files are compared afterwards.
"""
import json
import os
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import films
import mutation
from films import SCENE, UNFINISHED, WORDS, made

# Files that Candela names; links named by -o itself are followed.
OWNED = [f"f/{name}" for name in (".candela", ".candela/jobs", ".candela/0000.png", ".candela/0002.png", "0000.png", "0001.png")]
OWNED += [f"f/.candela/jobs/%04d.png{name}" for name in ("", "/plan.json", "/tasks", "/tasks.sh", "/finish.sh", "/0..0.json", "/0..2.json",
                                                         "/2..2.json", "/finish.json", "/1.log", "/finish.log")]
OWNED += [f"p.tif.parts{name}" for name in ("", "/picture.json", "/1-of-2.pixels", "/.candela", "/.candela/2-of-2.pixels")]
OWNED += [".candela", ".candela/p.tif", ".candela/jobs", ".candela/jobs/p.tif", ".candela/jobs/p.tif/plan.json"]
COMMANDS = [line.split() for line in (
    "status f", "status f --json", "status .", "submit scene.toml -o f/%04d.png --chunk 3 --jobs 1 --quiet",
    "submit scene.toml -o f/%04d.png --chunk 3 --engine slurm --quiet", "submit scene.toml -o f/%04d.png --engine print --chunk 1",
    "submit scene.toml -o p.tif --parts 2 --jobs 1 --quiet", "animate scene.toml -o f/%04d.png --threads 1 --quiet",
    "render scene.toml -o p.tif --part 1/2 --threads 1 --quiet", "assemble p.tif --quiet", "assemble p.tif --keep-parts --quiet")]
NAMES = [b"a\nb", b"\n#SBATCH --wrap=touch", b"\xff", b"\xc3", b"\xe2\x80\xae", b"\x1b[31m", b"\xc2\x9b", b"-x", b" ", b"'", b'"', b"\\",
         b"$(touch touched)", b"`touch touched`", b";touch touched;", b"&touch touched&", b"#", b"%s", b"~", b"*", b"{}", b"\t", b"=", b"x" * 200]
EXTREME = [None, True, 0, -1, 1, 1.5, 1 << 31, 1 << 40, -(1 << 63), (1 << 64) - 1, 1e308, "", "x" * 100_000, "../../victims/file", "/", ".", "..",
           "\n", "\x1b[31m", "\u202e", [], {}, [[]], "running", "done", "failed", "finish", "%04d", "0..2"]
OPTIONS = ("--job-name=", "--array=", "--cpus-per-task=", "--requeue", "--output=", "--partition=")
TEMPLATE = Path(tempfile.mkdtemp())
ENVIRONMENT = dict(os.environ, PATH=f"{TEMPLATE / 'bin'}:{os.environ['PATH']}")


def make_template(candela: str) -> None:
    """A job and a picture's parts, and as victims copies of all files that Candela would recognise in them."""
    work, victims = TEMPLATE / "made" / "work", TEMPLATE / "made" / "victims"
    work.mkdir(parents=True)
    victims.mkdir()
    made(candela, work)
    subprocess.run([candela, *"submit scene.toml -o p.tif --parts 2 --engine print".split()], cwd=work, check=True, capture_output=True)
    (victims / "file").write_text("nobody may touch this\n")
    (victims / "file").chmod(0o640)
    shutil.copytree(work / "f", victims / "f")
    shutil.copytree(work / "p.tif.parts", victims / "p.tif.parts")
    shutil.copytree(work / ".candela", victims / ".candela")
    (victims / "empty").mkdir()
    (TEMPLATE / "bin").mkdir()
    (TEMPLATE / "bin" / "sbatch").write_text("#!/bin/sh\necho 41\n")
    (TEMPLATE / "bin" / "sbatch").chmod(0o755)
    (TEMPLATE / "scene.toml").write_text(SCENE)
    for words in ("render scene.toml -o right.tif --quiet", "animate scene.toml -o %04d.png --quiet"):
        subprocess.run([candela, *words.split()], cwd=TEMPLATE, check=True)


def state_of(folder: Path) -> dict:
    """The state of a folder that a command could change, without the bytes of endless files."""
    result = {}
    for path in sorted(folder.rglob("*")):
        status = path.lstat()
        small = stat.S_ISREG(status.st_mode) and status.st_size < 1 << 20
        content = path.read_bytes() if small else os.readlink(path) if path.is_symlink() else status.st_size
        result[path.relative_to(folder)] = (status.st_mode, content if not stat.S_ISDIR(status.st_mode) else None)
    return result


def remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


def cleared(work: Path, name: str):
    """A path to put something at, or nothing if an earlier change is in the way."""
    path = work / name
    for parent in list(path.relative_to(work).parents)[-2::-1]:
        if (work / parent).is_symlink() or not (work / parent).is_dir():
            if os.path.lexists(work / parent):
                return None
            (work / parent).mkdir()
    remove(path)
    return path


def put_link(work: Path, chance) -> None:
    name = chance.choice(OWNED)
    path = cleared(work, name)
    victims = work.parent / "victims"
    if path is None:
        return
    alike = victims / name
    target = chance.choice((victims / "file", victims / "file", victims, victims / "empty", victims / "new", alike, alike, path, Path("..")))
    if target == victims / "file" and chance.randrange(3) == 0:
        os.link(target, path)
    else:
        path.symlink_to(os.path.relpath(target, path.parent) if chance.randrange(2) and target.is_absolute() else target)


def put_socket(path: Path) -> None:
    """Under a short name: a socket's is limited to 107 characters."""
    folder = os.open(path.parent, os.O_PATH)
    try:
        with socket.socket(socket.AF_UNIX) as made_here:
            made_here.bind(f"/proc/self/fd/{folder}/{path.name}")
    finally:
        os.close(folder)


def put_file(work: Path, chance) -> None:
    """Puts something else in place of a file."""
    name = chance.choice(OWNED)
    kind = chance.randrange(8)
    if kind >= 6:
        path = work / name
        if path.is_file() and not path.is_symlink() and path.stat().st_size < 1 << 20:
            path.write_bytes(mutation.mutated(path.read_bytes(), [b"{}", b"inputs x\nbytes 0\n"], chance, WORDS))
        return
    path = cleared(work, name)
    if path is None:
        return
    if kind == 0:
        os.mkfifo(path)
    elif kind == 1:
        put_socket(path)
    elif kind == 2:
        path.mkdir()
        if chance.randrange(2):
            (path / "x").write_text("x")
    elif kind == 3:
        path.write_bytes(b"{" if chance.randrange(2) else b"")
        os.truncate(path, chance.choice((1 << 16, 1 << 27, 1 << 40)))
    elif kind == 4:
        path.write_bytes(chance.choice((b"[" * 100_000, b'{"a":' * 50_000, b"\0" * 5000, b"\xff" * 5000, b"[" + b"0," * 1_000_000 + b"0]")))
    elif chance.randrange(2):
        path.write_bytes(b"")
        os.utime(path, ns=(chance.choice((0, 1 << 62, 9_000_000_000 * 10**9)),) * 2)


def places_in(value, found: list) -> list:
    for key in value if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ():
        found.append((value, key))
        places_in(value[key], found)
    return found


def put_value(work: Path, chance) -> None:
    """Changes the content of a plan, a journal or a description."""
    found = sorted(path for path in work.rglob("*.json") if path.is_file() and not path.is_symlink())
    path = chance.choice(found)
    try:
        content = json.loads(path.read_bytes()) if path.stat().st_size < 1 << 20 else None
    except ValueError:
        return
    if isinstance(content, dict) and path.parent.name == "%04d.png" and path.name != "plan.json" and chance.randrange(2):
        content["state"] = "running"
        (work / "f" / "0001.png").unlink(missing_ok=True)
        if chance.randrange(2):
            content["machine"] = "elsewhere"
    places = places_in(content, [])
    for _ in range(chance.choice((1, 1, 2, 5))):
        if places:
            parent, key = chance.choice(places)
            extreme = chance.choice([*EXTREME, str(work.parent / "victims" / "file"), os.getpid()])
            if isinstance(parent, dict) and key in parent or isinstance(parent, list):
                parent[key] = extreme
    if isinstance(content, dict) and isinstance(content.get("tasks"), list) and chance.randrange(8) == 0:
        content["tasks"] = content["tasks"][:1] * 20_000
    path.write_text(json.dumps(content))
    if chance.randrange(3) == 0:
        offset = chance.choice((-10**9, -100, 100, 10**6, 10**9))
        os.utime(path, (time.time() + offset,) * 2)


def put_name(work: Path, chance) -> None:
    """Puts an entry with an odd name among the jobs."""
    jobs = work / "f" / ".candela" / "jobs"
    path = jobs / os.fsdecode(chance.choice(NAMES))
    if not jobs.is_dir() or os.path.lexists(path):
        return
    if chance.randrange(3):
        shutil.copytree(jobs / "%04d.png", path)
    else:
        chance.choice((path.mkdir, path.touch, lambda: os.mkfifo(path)))()


def strange_line_of(script: Path) -> str:
    """A line of a job script that Candela does not write."""
    is_small = stat.S_ISREG(script.lstat().st_mode) and script.lstat().st_size < 1 << 20
    for line in script.read_bytes().split(b"\n") if is_small else ():
        if line.startswith(b"#SBATCH ") and not os.fsdecode(line[8:]).startswith(OPTIONS):
            return f"a job script has the line {line!r}"
    return ""


def wrong_after(words: list, code: int, work: Path) -> str:
    """Work that a command reported as done but is not."""
    if code == 0 and words[0] in ("animate", "submit") and "p.tif" not in words and "slurm" not in words and "print" not in words:
        frames = Path(os.fsdecode(words[words.index("-o") + 1])).parent
        for i in range(3):
            frame = work / frames / f"{i:04}.png"
            if frame.is_symlink() or not frame.is_file() or frame.read_bytes() != (TEMPLATE / f"{i:04}.png").read_bytes():
                return f"{frame.name} is not the frame"
    if code == 0 and words[0] == "assemble" and (work / "p.tif").read_bytes() != (TEMPLATE / "right.tif").read_bytes():
        return "p.tif is not the picture"
    return ""


KINDS = {"links": put_link, "files": put_file, "values": put_value, "names": put_name}


def problem_of(candela: str, directory: Path, kind: str, chance, _index: int) -> str:
    shutil.copytree(TEMPLATE / "made", directory, dirs_exist_ok=True)
    work = directory / "work"
    folder = "f"
    for _ in range(chance.choice((1, 2, 3, 6, 12))):
        KINDS[kind](work, chance)
    if kind == "names" and chance.randrange(2):
        folder = os.fsdecode(chance.choice(NAMES))
        (work / "f").rename(work / folder)
    if kind == "names" and chance.randrange(2):
        work = work.rename(directory / os.fsdecode(chance.choice(NAMES)))
    victims = state_of(directory / "victims")
    for _ in range(chance.choice((1, 2, 3, 4))):
        words = [word.replace("f/", folder + "/") if word.startswith("f/") else folder if word == "f" else word
                 for word in chance.choice(COMMANDS)]
        if folder.startswith("-"):
            words = [word.replace(folder, "./" + folder, 1) if word.startswith(folder) else word for word in words]
        before = state_of(work) if words[0] == "status" else None
        done, wrong = mutation.run([candela, *words], work, (0, 1, 2, 3, 4), ENVIRONMENT)
        if not wrong and state_of(directory / "victims") != victims:
            wrong = "it has changed files outside"
        if not wrong and before is not None and state_of(work) != before:
            wrong = "it has written a file"
        if not wrong:
            wrong = wrong_after(words, done.returncode, work)
        wrong = wrong or next(filter(None, (strange_line_of(script) for script in work.rglob("*.sh"))), "")
        left = [path.name for path in directory.rglob("*") if path.name.startswith(UNFINISHED) or path.name == "touched"]
        if wrong or left:
            return f"{' '.join(words)!r}: {wrong or f'it leaves {left[0]} behind'}"
    return ""


if __name__ == "__main__":
    try:
        mutation.address_space = str(4 << 30)
        command = str(Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
        if command:
            make_template(command)
        sys.exit(mutation.sweep(__doc__, 100, list(KINDS), problem_of))
    finally:
        shutil.rmtree(TEMPLATE)
        shutil.rmtree(films.TEMPLATE)
