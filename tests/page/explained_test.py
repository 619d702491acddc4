"""The byte that an explained pixel ends with is the byte of the PNG: pixels of scenes with every shipped model, by `candela view` and by
`candela explain`.

By hand: CANDELA=build/release/bin/candela python3 tests/page/explained_test.py [PIXELS]
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

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "targets"))
import scenes

from pictures import Picture

GLASS = pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "glass.toml"
COMMAND = os.environ.get("CANDELA_TEST_COMMAND") or os.environ["CANDELA"]
# Without a compiler, kernels are not run as well: only the renderer's account matters, and there are many pixels.
ENVIRONMENT = dict(os.environ, PATH="/nonexistent", CXX="", CANDELA_PLUGIN_PATH="", XDG_DATA_HOME="/nonexistent")


def by_view(file, pixels):
    server = subprocess.Popen([COMMAND, "view", "--no-open", "--quiet", str(file)], env=ENVIRONMENT, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, text=True)
    try:
        address = server.stdout.readline().strip()
        for x, y in pixels:
            with urllib.request.urlopen(f"{address}explanation.json?pixel={x}%2C{y}", timeout=60) as answer:
                yield json.load(answer)["bytes"]
    finally:
        server.send_signal(signal.SIGINT)
        server.wait(60)


def by_explain(file, pixels):
    asked = "".join(f"{x},{y}\n" for x, y in pixels)
    said = subprocess.run([COMMAND, "explain", "--quiet", "--json", "--pixel", "-", file], env=ENVIRONMENT, input=asked, capture_output=True,
                          text=True, check=True)
    for line in said.stdout.splitlines():
        yield json.loads(line)["bytes"]


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 500
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
            subprocess.run([COMMAND, "render", "--quiet", file, "-o", folder / "scene.png"], env=ENVIRONMENT, check=True)
            picture = Picture.of_png((folder / "scene.png").read_bytes())
            pixels = [(chance.randrange(picture.width), chance.randrange(picture.height))
                      for _ in range(count // len(chosen))]  # of the ten, and as many of glass
            for way in (by_view, by_explain):
                for (x, y), said in zip(pixels, way(file, pixels), strict=True):
                    at = 3 * (y * picture.width + x)
                    is_there = list(picture.pixels[at:at + 3])
                    asked += 1
                    if said != is_there:
                        wrong += 1
                        print(f"scene {number}, pixel {x},{y}: explained as {said} {way.__name__}, it is {is_there}")
    finally:
        shutil.rmtree(folder)
    print(f"{asked} explanations of pixels of {len(files)} scenes, {wrong} of them wrong")
    return 1 if wrong or asked < 2 * len(files) else 0


if __name__ == "__main__":
    sys.exit(main())
