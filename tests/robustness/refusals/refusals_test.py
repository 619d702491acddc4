"""Checks the answers to broken, huge and endless files: the exit code, the message with its place, the time and the memory.

    refusals_test.py CANDELA [--address-space BYTES] [NAME...]      NAME: only cases whose names contain it
"""
import argparse
import concurrent.futures
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "mutations"))
import mutation  # noqa: E402

import gltf_files  # noqa: E402
import scene_files  # noqa: E402

MOST_MEMORY = 512 << 20
SMALL = ["--width", "8", "--height", "6", "--threads", "1"]


def render(candela: str, file: str, directory: Path):
    """The exit code, what was said, and what is wrong with any input."""
    (directory / "out.png").unlink(missing_ok=True)
    done, wrong = mutation.run([candela, "render", file, "-o", "out.png", *SMALL], directory, codes=(0, 1, 3), most_memory=MOST_MEMORY)
    if wrong:
        return None, "", wrong
    if (done.returncode == 0) != (directory / "out.png").exists():
        wrong = "exit code and picture disagree"
    return done.returncode, done.stderr.decode(), wrong


def scene_cases():
    for place in scene_files.PLACES:
        for name, content, part in scene_files.broken_photometry() if place == "ies" else scene_files.broken_pictures():
            if place in ("color", "ies") or name in scene_files.EVERYWHERE:
                yield f"{place}-{name}", place, name, content, part


def scene_problem(candela: str, place: str, name: str, content: bytes, part, directory: Path) -> str:
    (directory / name).write_bytes(content)
    (directory / "scene.toml").write_text(scene_files.scene(place, name))
    code, said, wrong = render(candela, "scene.toml", directory)
    # The opacity of a PFM is 1, whatever its colours are.
    if part is None or (place == "opacity" and "non-finite" in part):
        return wrong or ("" if code == 0 else f"it is refused: {said}")
    if wrong or code != 1:
        return wrong or f"exit code {code}: {said}"
    if not said.startswith("scene.toml:") or name not in said or part not in said:
        return f"expected scene.toml:…, '{name}' and '{part}' in: {said}"
    return "" if said.count(" error: ") == 1 else f"there is more than one error: {said}"


def model_problem(candela: str, square, code: int, part: str, directory: Path) -> str:
    (directory / "a.glb").write_bytes(square if isinstance(square, bytes) else square.files()["a.glb"])
    found, said, wrong = render(candela, "a.glb", directory)
    if wrong or found != code:
        return wrong or f"exit code {found}: {said}"
    return "" if part in said else f"expected '{part}' in: {said}"


def raw_problem(candela: str, content: bytes, part: str, directory: Path) -> str:
    (directory / "a.gltf").write_bytes(content)
    code, said, wrong = render(candela, "a.gltf", directory)
    return wrong or ("" if code == 1 and "a.gltf'" in said and part in said else f"exit code {code}: {said}")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("candela", type=lambda path: str(Path(path).resolve()))
    parser.add_argument("--address-space", default=str(4 << 30), help="bytes, or 'unlimited'; default: %(default)s")
    parser.add_argument("names", nargs="*")
    options = parser.parse_args()
    mutation.address_space = options.address_space
    trials = [(name, scene_problem, rest) for name, *rest in scene_cases()]
    trials += [(name, model_problem, rest) for name, *rest in gltf_files.cases()]
    trials += [(name, raw_problem, rest) for name, *rest in gltf_files.raw()]
    trials = [t for t in trials if not options.names or any(part in t[0] for part in options.names)]
    if options.address_space == "unlimited":
        trials = [t for t in trials if scene_files.BOMB not in t[0]]  # it may fit
    wrong = 0
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        def problem(number: int) -> str:
            _, problem_of, rest = trials[number]
            directory = Path(scratch) / str(number)
            directory.mkdir()
            return problem_of(options.candela, *rest, directory)

        for (name, *_), found in zip(trials, pool.map(problem, range(len(trials)))):
            if found:
                wrong += 1
                print(f"{name}: {found[:600]}")
    print(f"{len(trials)} files, {wrong} problems")
    return 1 if wrong or not trials else 0


if __name__ == "__main__":
    sys.exit(main())
