"""gltf_files.py CANDELA SCRATCH VALIDATOR: checks GLB files of many scenes with Khronos' glTF-Validator, which scripts/gltf-validator.sh
fetches; exit code 77 without it."""

import pathlib
import shutil
import subprocess
import sys

import scenes

SKIPPED = 77


def main():
    candela, scratch, validator = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    if not (validator / "index.js").exists() or not shutil.which("node"):
        print("glTF-Validator is missing; scripts/gltf-validator.sh fetches it")
        return SKIPPED
    catalogue = scenes.Catalogue(candela)
    scratch.mkdir(parents=True, exist_ok=True)
    (scratch / "icosahedron.obj").write_text(scenes.OBJ)
    examples = pathlib.Path(__file__).parents[2] / "docs/examples"
    inputs = [examples / "cube.toml", examples / "still-life.toml"]
    for number, choices in enumerate(scenes.scenes(catalogue, 4)):
        file = scratch / f"{number}.toml"
        file.write_text(scenes.scene_text(catalogue, choices, number))
        inputs.append(file)
    made = []
    for file in inputs:
        folder = scratch / file.stem
        subprocess.run([candela, "generate", file, "--target", "gltf", "--approximate", "--quiet", "-o", folder], check=True)
        made.append(folder / "scene.glb")
    script = pathlib.Path(__file__).with_name("gltf_validator.js")
    return subprocess.run(["node", script, validator, *made], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
