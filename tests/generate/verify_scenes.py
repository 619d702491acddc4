"""verify_scenes.py CANDELA SCRATCH NUMBER [TARGET]: `candela verify` of one of the scenes of scenes.py.
verify_scenes.py CANDELA SCRATCH textures-NUMBER [TARGET]: likewise of texture_scenes.py.
verify_scenes.py CANDELA SCRATCH NUMBER TARGET exact: of what a target with models of its own expresses, to a level of 1/255.
verify_scenes.py CANDELA SCRATCH pairs: whether those of scenes.py cover what they are there for."""

import os
import pathlib
import re
import subprocess
import sys

import scenes
import texture_scenes


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


def scene_of(catalogue, what):
    """The text of a scene, and the files that it names."""
    if what.startswith("textures-"):
        number = int(what.removeprefix("textures-"))
        return texture_scenes.scene_text(catalogue.factors()["reflection"], number), texture_scenes.files()
    number = int(what)
    return scenes.scene_text(catalogue, scenes.scenes(catalogue)[number], number), {"icosahedron.obj": scenes.OBJ.encode()}


def main():
    candela, scratch, what = sys.argv[1:4]
    target = sys.argv[4] if len(sys.argv) > 4 else "all"
    is_exact = sys.argv[5:] == ["exact"]
    catalogue = scenes.Catalogue(candela)
    if is_exact:
        scratch = pathlib.Path(scratch) / target
        catalogue = catalogue.exact_of(target)
    if what == "pairs":
        return 1 if uncovered(catalogue) else 0
    folder = pathlib.Path(scratch) / f"scene-{what}"
    folder.mkdir(parents=True, exist_ok=True)
    text, files = scene_of(catalogue, what)
    for name, content in files.items():
        # Vertex colours only where all targets have them.
        (folder / name).write_bytes(re.sub(rb"(?m)^(v( \S+){3}).*", rb"\1", content) if is_exact else content)
    file = folder / "scene.toml"
    file.write_text(text)
    tolerance = ["--tolerance", "1"] if is_exact else []
    result = subprocess.run([candela, "verify", str(file), "--target", target, "--report", str(folder / "report"), *tolerance],
                            env={**os.environ, "CXXFLAGS": "-Werror"}, capture_output=True, text=True, check=False)
    print(result.stdout, result.stderr, sep="")
    return 1 if result.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
