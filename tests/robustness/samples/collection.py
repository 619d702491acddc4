"""Renders every model file below some folders, and counts pictures, refusals by reason, and pictures that look wrong.

    collection.py CANDELA FOLDER... [--out RESULT.json] [--before RESULT.json] [--pictures FOLDER] [--jobs J]

Give it collections of other people's files; none is part of this project. Each file is rendered alone, with limits on time
and memory. A crash, a time-out, or a refusal without a message is a failure (exit code 1). With --before, files that made a picture then
and are refused now are listed. --pictures keeps the pictures for inspection.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

FORMATS = {".obj", ".ply", ".stl", ".gltf", ".glb"}
SECONDS = 60  # of processor time
PATIENCE = 240  # seconds of any time, on a busy machine
MEMORY = 8 << 30  # bytes
WIDTH, HEIGHT = 300, 300


def model_files(folders: list) -> list:
    """Each distinct file once: collections copy from one another."""
    found, seen = [], set()
    for folder in folders:
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() not in FORMATS or not path.is_file():
                continue
            # Small glTF or OBJ files may differ only in their companion files, so only self-contained files are compared.
            if path.suffix.lower() in (".glb", ".stl", ".ply"):
                digest = hashlib.sha256(path.read_bytes()).digest()
                if digest in seen:
                    continue
                seen.add(digest)
            found.append(path)
    return found


def limited() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def looks_of(picture: bytes) -> list:
    """Problems that are visible at a glance."""
    header = b"P6\n%d %d\n255\n" % (WIDTH, HEIGHT)
    if not picture.startswith(header):
        return ["unreadable"]
    pixels = picture[len(header):]
    rows = [pixels[3 * WIDTH * y:3 * WIDTH * (y + 1)] for y in range(HEIGHT)]
    background = pixels[:3]
    looks = []
    if any(row[:3] != background or row[-3:] != background for row in rows):
        looks.append("touches the left or right edge")
    if any(row != background * WIDTH for row in (rows[0], rows[-1])):
        looks.append("touches the upper or lower edge")
    seen = [pixels[i:i + 3] for i in range(0, len(pixels), 3) if pixels[i:i + 3] != background]
    if not seen:
        looks.append("empty")
    else:
        if 5 * sum(pixel == b"\xff\xff\xff" for pixel in seen) > len(seen):
            looks.append("a fifth is white")
        if 2 * sum(max(pixel) == 0 for pixel in seen) > len(seen):
            looks.append("half is black")
    return looks


def reason_of(message: str) -> str:
    """A message without file-specific parts, so that reasons can be counted."""
    message = re.sub(r"'[^']*'|\"[^\"]*\"", "'…'", message)
    return re.sub(r"\d[\d.,e+-]*", "#", message)[:160]


def rendered(candela: str, path: Path, pictures: Path, index: int) -> dict:
    with tempfile.TemporaryDirectory() as scratch:
        output = Path(scratch) / "a.ppm"
        command = [candela, "render", str(path.resolve()), "-o", str(output), "--width", str(WIDTH), "--height", str(HEIGHT)]
        try:
            with subprocess.Popen(command, cwd=scratch, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, preexec_fn=limited) as process:
                _, said = process.communicate(timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            return {"kind": "time-out"}
        lines = said.decode(errors="replace").splitlines()
        errors = [line for line in lines if "error" in line]
        result = {"code": process.returncode,
                  "notes": [line for line in lines if "warning" in line or "note" in line]}
        if process.returncode == 0:
            picture = output.read_bytes()
            result |= {"kind": "picture", "looks": looks_of(picture)}
            if pictures:
                kept = pictures / f"{index:05}-{re.sub(r'[^A-Za-z0-9._-]', '_', path.name)}.ppm"
                kept.write_bytes(picture)
                result["picture"] = kept.name
        elif process.returncode in (1, 3) and errors:
            result |= {"kind": "refusal", "reason": errors[0]}
        else:
            result |= {"kind": "crash", "reason": said.decode(errors="replace")[-300:]}
        return result


def report(results: dict, before: dict) -> int:
    kinds = collections.Counter(result["kind"] for result in results.values())
    for kind in ("picture", "refusal", "time-out", "crash"):
        was = f" (before: {sum(r['kind'] == kind for r in before.values())})" if before else ""
        print(f"{kinds[kind]:6} {kind}{was}")
    print("\nrefusals by reason")
    reasons = collections.defaultdict(list)
    for name, result in results.items():
        if result["kind"] == "refusal":
            reasons[reason_of(result["reason"].split("error: ", 1)[-1])].append(name)
    for reason, names in sorted(reasons.items(), key=lambda item: -len(item[1])):
        print(f"{len(names):6} {reason}\n         such as {names[0]}")
    print("\nlooks of pictures")
    looks = collections.Counter(look for result in results.values() for look in result.get("looks", []))
    was = collections.Counter(look for result in before.values() for look in result.get("looks", []))
    for look, count in looks.most_common():
        print(f"{count:6} {look}" + (f" (before: {was[look]})" if before else ""))
    failed = [name for name, result in results.items() if result["kind"] in ("crash", "time-out")]
    for name in failed:
        print(f"FAILED {name}: {results[name]}")
    lost = [name for name, result in results.items()
            if result["kind"] != "picture" and before.get(name, {}).get("kind") == "picture"]
    for name in lost:
        print(f"a picture before: {name}: {results[name].get('reason', results[name]['kind'])}")
    return 1 if failed or lost else 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("candela", type=lambda path: str(Path(path).resolve()))
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--before", type=Path)
    parser.add_argument("--pictures", type=Path)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    if options.pictures:
        options.pictures.mkdir(parents=True, exist_ok=True)
    files = model_files(options.folders)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        done = list(pool.map(lambda item: rendered(options.candela, item[1], options.pictures, item[0]), enumerate(files)))
    results = {str(path): result for path, result in zip(files, done)}
    if options.out:
        options.out.write_text(json.dumps(results, indent=1))
    return report(results, json.loads(options.before.read_text()) if options.before else {})


if __name__ == "__main__":
    sys.exit(main())
