"""Imports each asset, renders it, and compares every pixel with the evaluation of the formats' texts.

    assets_test.py CANDELA [NAME...]      NAME: only assets whose names contain it
"""
import array
import subprocess
import sys
import tempfile
from pathlib import Path

import geometry
import materials
import mtl
import textures
from evaluator import encoded

SIZE = 24


def run(candela: str, *words, directory: Path) -> str:
    done = subprocess.run([candela, *words], cwd=directory, capture_output=True, timeout=60, check=False)
    if done.returncode != 0:
        raise AssertionError(f"exit code {done.returncode}: {done.stderr.decode()}")
    return done.stderr.decode()


def staged(scene: str, asset) -> str:
    """The imported scene under the test's lights and camera, unless the file's are meant."""
    tables = scene.split("\n\n")
    of = lambda *heads: [t for t in tables if t.startswith(heads)]
    seen = asset.scene.camera
    text = ["version = 1", f"image = {{ width = {SIZE}, height = {SIZE}, samples = 1, background = [0, 0, 0] }}",
            "room = { width = 20, height = 20, depth = 20 }", 'shading = { model = "phong" }', 'constraints = { overlap = "allow" }']
    if asset.own_camera:
        text += of("[observer]")
    else:
        text += ["[observer]", *(f"{k} = {list(v)}" for k, v in (("position", seen.position), ("look_at", seen.look_at),
                                                                 ("up", seen.up))),
                 'projection = "orthographic"', f"height = {seen.height}"]
    text += of("[reflection]")
    if asset.lights != "test":
        text += [t for t in of("[[light]]") if asset.lights == "imported" or '"sky"' not in t]
    else:
        text += [f'[[light]]\ntype = "directional"\ndirection = {list(light.direction)}\nintensity = {light.color[0]}'
                 for light in asset.scene.lights]
    if asset.scene.ambient:
        text.append(f'[[light]]\ntype = "ambient"\nintensity = {asset.scene.ambient}')
    text += of("[[object]]", "[object.")
    return "\n".join(text)


def problems(candela: str, asset, directory: Path):
    for name, content in asset.files.items():
        (directory / name).write_bytes(content)
    notes = run(candela, "import", next(iter(asset.files)), "-o", "a.toml", directory=directory)
    scene = (directory / "a.toml").read_text()
    said = [line for line in scene.splitlines() if line.startswith("# Note")]
    for part in asset.says:
        if part not in notes:
            yield f"no note contains '{part}': {said}"
    if len(said) != len(asset.says):
        yield f"there are {len(said)} notes: {said}"
    (directory / "staged.toml").write_text(staged(scene, asset))
    run(candela, "render", "staged.toml", "-o", "a.pfm", directory=directory)
    values = array.array("f", (directory / "a.pfm").read_bytes()[-12 * SIZE * SIZE:])
    factor, compared, worst = None, 0, (0, "")
    for i, wanted in enumerate(asset.scene.picture(SIZE)):
        if wanted is None:
            continue
        compared += 1
        seen = values[3 * i:3 * i + 3]
        if asset.only_ratios:
            factor = factor or seen[0] / wanted[0]
            wanted = [factor * w for w in wanted]
        off = max(abs(255 * (encoded(s) - encoded(w))) for s, w in zip(seen, wanted))
        worst = max(worst, (off, f"at ({i % SIZE}, {i // SIZE}) {list(seen)} instead of {list(wanted)}"))
    if compared < SIZE * SIZE / 3:
        yield f"only {compared} pixels can be compared"
    if worst[0] > asset.levels:
        yield f"{worst[0]:.2f} levels {worst[1]}"


def main() -> int:
    candela, parts = str(Path(sys.argv[1]).resolve()), sys.argv[2:]
    wrong, names = 0, []
    with tempfile.TemporaryDirectory() as scratch:
        for asset in (a for topic in (textures, materials, geometry, mtl) for a in topic.assets()):
            if parts and not any(part in asset.name for part in parts):
                continue
            directory = Path(scratch) / asset.name
            directory.mkdir()  # fails for a name that there is already
            names.append(asset.name)
            try:
                found = list(problems(candela, asset, directory))
            except AssertionError as failure:
                found = [str(failure)]
            wrong += bool(found)
            for problem in found:
                print(f"{asset.name}: {problem}")
    print(f"{len(names)} assets, {wrong} of them wrong")
    return 1 if wrong or not names else 0


if __name__ == "__main__":
    sys.exit(main())
