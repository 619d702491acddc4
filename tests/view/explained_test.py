"""The byte that an explained pixel ends with is the byte of the picture: pixels of scenes with every shipped model, by `candela view`.

By hand: CANDELA=build/release/bin/candela python3 tests/view/explained_test.py [PIXELS]
"""
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "generate"))
import scenes

GLASS = pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "glass.toml"
COMMAND = os.environ.get("CANDELA_TEST_COMMAND") or os.environ["CANDELA"]
# Without a compiler, kernels are not run beside: what is asked for is the renderer's account, and there are many pixels.
ENVIRONMENT = dict(os.environ, PATH="/nonexistent", CXX="", CANDELA_PLUGIN_PATH="", XDG_DATA_HOME="/nonexistent")


def explained(file, picture, width, height, pixels, chance):
    """Where the explanation and the picture differ."""
    server = subprocess.Popen([COMMAND, "view", "--no-open", "--quiet", str(file)], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().strip()
        differing = []
        for _ in range(pixels):
            x, y = chance.randrange(width), chance.randrange(height)
            with urllib.request.urlopen(f"{address}explanation.json?pixel={x}%2C{y}", timeout=60) as answer:
                said = bytes(json.load(answer)["bytes"])
            at = 3 * (y * width + x)
            if said != picture[at:at + 3]:
                differing.append((x, y, said, picture[at:at + 3]))
        return differing
    finally:
        server.send_signal(signal.SIGINT)
        server.wait(60)


def main():
    pixels = int(sys.argv[1]) if len(sys.argv) > 1 else 500
    catalogue = scenes.Catalogue(COMMAND)
    chosen = scenes.scenes(catalogue)[:10]
    seen = {(kind, thing[kind]) for scene in chosen for thing in scene["objects"] for kind in ("shading", "reflection")}
    missing = [(kind, name) for kind in ("shading", "reflection") for name in catalogue.names(kind)
               if (kind, name) not in seen and name != "dielectric"]  # which is in the last scene
    assert not missing, f"no scene has {missing}"
    chance, wrong, asked = random.Random(17), 0, 0
    folder = pathlib.Path(tempfile.mkdtemp(prefix="candela-explained-"))
    try:
        (folder / "icosahedron.obj").write_text(scenes.OBJ)
        files = [GLASS]
        for number, scene in enumerate(chosen):
            files.insert(number, folder / f"scene-{number}.toml")
            files[number].write_text(scenes.scene_text(catalogue, scene, number))
        for number, file in enumerate(files):
            picture = folder / f"scene-{number}.ppm"
            subprocess.run([COMMAND, "render", "--quiet", file, "-o", picture], env=ENVIRONMENT, check=True)
            width, height = map(int, picture.read_bytes().split(maxsplit=3)[1:3])
            count = pixels // len(chosen)  # of the ten, and as many of glass
            differing = explained(file, picture.read_bytes()[-3 * width * height:], width, height, count, chance)
            asked += count
            wrong += len(differing)
            for x, y, said, is_there in differing:
                print(f"scene {number}, pixel {x},{y}: explained as {list(said)}, it is {list(is_there)}")
    finally:
        shutil.rmtree(folder)
    print(f"{asked} pixels of {len(files)} scenes, {wrong} explained as others")
    return 1 if wrong or asked < 10 else 0


if __name__ == "__main__":
    sys.exit(main())
