"""Checks that each file in files.py is read as intended: its triangles, its picture, and reports of everything left out.

    real_test.py CANDELA [NAME...]      NAME: only cases whose names contain it
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import files

SCENE = """version = 1
room = { width = 10, height = 10, depth = 10 }
[observer]
position = [1.7, 1.3, 2.4]
look_at = [0, 0, 0]
[image]
width = 96
height = 96
[shading]
model = "phong"
[reflection]
model = "lambert"
[[light]]
type = "directional"
direction = [-1, -2, -3]
[[object]]
"""


def run(candela: str, *words, directory: Path) -> subprocess.CompletedProcess:
    return subprocess.run([candela, *words], cwd=directory, capture_output=True, timeout=60, check=False)


def picture(candela: str, scene: str, directory: Path) -> bytes:
    (directory / "scene.toml").write_text(scene)
    done = run(candela, "render", "scene.toml", "-o", "a.ppm", directory=directory)
    if done.returncode != 0:
        raise AssertionError(done.stderr.decode())
    return (directory / "a.ppm").read_bytes()


def problems(candela: str, case: files.Case, cubes: dict, directory: Path):
    for name, content in case.files.items():
        (directory / name).write_bytes(content)
    scene = SCENE + f'type = "mesh"\nfile = "{next(iter(case.files))}"\n{case.options}\n'
    (directory / "scene.toml").write_text(scene)
    done = run(candela, "check", "--json", "scene.toml", directory=directory)
    if done.returncode < 0:
        yield f"a signal: {-done.returncode}"
        return
    report = json.loads(done.stdout)
    said = [d["message"] for d in report["diagnostics"]]
    if case.error:
        if done.returncode == 0 or not any(case.error in message for message in said):
            yield f"it should be refused with '{case.error}', but: exit code {done.returncode}, {said}"
        return
    if done.returncode != 0:
        yield f"it is refused: {said}"
        return
    found = report["scene"]["objects"][0]
    if found["triangles"] != case.triangles:
        yield f"{found['triangles']} triangles instead of {case.triangles}"
    if found["closed"] != case.closed:
        yield "it is " + ("closed" if found["closed"] else "open")
    for part in case.says:
        if not any(part in message for message in said):
            yield f"no message contains '{part}': {said}"
    if case.silent and said:
        yield f"unexpected message: {said}"
    if case.like == "cube":
        seen = picture(candela, scene, directory)
        if case.color not in cubes:
            cubes[case.color] = picture(candela, SCENE + f'type = "cube"\ncolor = {list(case.color)}\n', directory)
        worst = max(abs(a - b) for a, b in zip(seen, cubes[case.color], strict=True))
        if worst > 1:
            yield f"it looks unlike a cube, by up to {worst} of 255"


def main() -> int:
    candela, parts = str(Path(sys.argv[1]).resolve()), sys.argv[2:]
    wrong = tried = 0
    with tempfile.TemporaryDirectory() as scratch:
        root = Path(scratch)
        cubes = {}
        for case in files.cases():
            if parts and not any(part in case.name for part in parts):
                continue
            tried += 1
            directory = root / case.name / "scene"
            directory.mkdir(parents=True)
            for problem in problems(candela, case, cubes, directory):
                wrong += 1
                print(f"{case.name}: {problem}")
    print(f"{tried} files, {wrong} problems")
    return 1 if wrong or not tried else 0


if __name__ == "__main__":
    sys.exit(main())
