"""verify_scenes.py CANDELA SCRATCH NUMBER [TARGET]: runs `candela verify` on one of the scenes of scenes.py.
verify_scenes.py CANDELA SCRATCH textures-NUMBER [TARGET]: the same for texture_scenes.py.
verify_scenes.py CANDELA SCRATCH shadows-NUMBER [TARGET]: the same for shadow_scenes.py.
verify_scenes.py CANDELA SCRATCH opacity-NUMBER [TARGET]: the same for opacity_scenes.py.
verify_scenes.py CANDELA SCRATCH NUMBER TARGET exact: only what a target expresses with its own models, to within 1/255.
verify_scenes.py CANDELA SCRATCH NUMBER three own: only what three.js draws itself, without kernels.
verify_scenes.py CANDELA SCRATCH pairs: checks that the scenes of scenes.py cover all pairs."""

import json
import os
import pathlib
import re
import subprocess
import sys

import opacity_scenes
import scenes
import shadow_scenes
import texture_scenes

SKIPPED = 77  # as CTest is told
OWN_OF_THREE = {
    "light": ["ambient", "directional", "distributed", "point", "spot"],
    "reflection": ["lambert"],
    "shading": ["angle-weighted", "area-weighted", "max-weighted", "phong"],
}


def uncovered(catalogue):
    chosen = scenes.scenes(catalogue)
    missing = scenes.all_pairs({k: v for k, v in catalogue.factors().items()})
    for scene in chosen:
        missing -= scenes.pairs_in(scene)
    # Pairs of the frame's own factors come from whole scenes.
    for pair in sorted(map(str, missing)):
        print("not covered:", pair)
    print(len(chosen), "scenes,", len(missing), "pairs missing")
    objects = sum(len(scene["objects"]) for scene in chosen)
    return missing or objects < 96


def scene_of(catalogue, what, is_exact):
    """The text of a scene, and the files that it names."""
    if what.startswith("shadows-"):
        number = int(what.removeprefix("shadows-"))
        return shadow_scenes.scene_text(catalogue.factors(), number, is_exact), shadow_scenes.files()
    if what.startswith("textures-"):
        number = int(what.removeprefix("textures-"))
        return texture_scenes.scene_text(catalogue.factors()["reflection"], number), texture_scenes.files()
    if what.startswith("opacity-"):
        return opacity_scenes.scene_text(int(what.removeprefix("opacity-"))), opacity_scenes.files()
    number = int(what)
    return scenes.scene_text(catalogue, scenes.scenes(catalogue)[number], number), {"icosahedron.obj": scenes.OBJ.encode()}


def has_kernels(page):
    """Whether an object of a page with three.js has a material other than three.js's own."""
    scene = json.loads(re.search(r'id="scene">(.*?)</script>', page.read_text(), re.S)[1])
    return any(thing["lambert"] is None for thing in scene["objects"])


def main():
    candela, scratch, what = sys.argv[1:4]
    target = sys.argv[4] if len(sys.argv) > 4 else "all"
    is_exact, is_own = sys.argv[5:] == ["exact"], sys.argv[5:] == ["own"]
    catalogue = scenes.Catalogue(candela)
    # Tests of several targets run at the same time.
    scratch = pathlib.Path(scratch, *sys.argv[4:])
    if is_exact:
        catalogue = catalogue.exact_of(target)
    if is_own:
        catalogue = catalogue.limited_to(OWN_OF_THREE)
    if what == "pairs":
        return 1 if uncovered(catalogue) else 0
    folder = scratch / f"scene-{what}"
    folder.mkdir(parents=True, exist_ok=True)
    text, files = scene_of(catalogue, what, is_exact)
    for name, content in files.items():
        # Vertex colours only if all targets support them.
        (folder / name).write_bytes(re.sub(rb"(?m)^(v( \S+){3}).*", rb"\1", content) if is_exact or is_own else content)
    file = folder / "scene.toml"
    # three.js does not have light that fades by distance plus an offset either.
    file.write_text(text.replace('"offset-linear"', '"inverse-square"') if is_own else text)
    tolerance = ["--tolerance", "1"] if is_exact or is_own else []
    result = subprocess.run([candela, "verify", str(file), "--target", target, "--report", str(folder / "report"), *tolerance],
                            env={**os.environ, "CXXFLAGS": "-Werror"}, capture_output=True, text=True, check=False)
    print(result.stdout, result.stderr, sep="")
    if "three.js is missing" in result.stderr:
        return SKIPPED
    if is_own and has_kernels(folder / "report/three/scene.html"):
        print("three.js does not have all of this itself")
        return 1
    return 1 if result.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
