"""verify_scenes.py CANDELA SCRATCH NUMBER [TARGET]: `candela verify` of one of the scenes of scenes.py.
verify_scenes.py CANDELA SCRATCH pairs: whether they cover what they are there for."""

import os
import pathlib
import subprocess
import sys

import scenes


def main():
    candela, scratch, what = sys.argv[1:4]
    targets = sys.argv[4:] or ["all"]
    catalogue = scenes.Catalogue(candela)
    chosen = scenes.scenes(catalogue)
    if what == "pairs":
        missing = scenes.all_pairs({k: v for k, v in catalogue.factors().items()})
        for scene in chosen:
            missing -= scenes.pairs_in(scene)
        # Pairs of the frame's own factors come from whole scenes.
        for pair in sorted(map(str, missing)):
            print("not covered:", pair)
        print(len(chosen), "scenes,", len(missing), "pairs missing")
        objects = sum(len(scene["objects"]) for scene in chosen)
        return 1 if missing or objects < 96 else 0
    number = int(what)
    folder = pathlib.Path(scratch) / f"scene-{number}"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "icosahedron.obj").write_text(scenes.OBJ)
    file = folder / "scene.toml"
    file.write_text(scenes.scene_text(catalogue, chosen[number], number))
    failed = 0
    for target in targets:
        result = subprocess.run([candela, "verify", str(file), "--target", target, "--report", str(folder / "report")],
                                env={**os.environ, "CXXFLAGS": "-Werror"}, capture_output=True, text=True, check=False)
        print(result.stdout, result.stderr, sep="")
        failed += result.returncode != 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
