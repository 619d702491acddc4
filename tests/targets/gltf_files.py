"""gltf_files.py CANDELA SCRATCH VALIDATOR: checks GLB files of many scenes with Khronos' glTF-Validator, which scripts/gltf-validator.sh
fetches; exit code 77 without it."""

import pathlib
import shutil
import subprocess
import sys

import scenes

SKIPPED = 77

# Numbers of vertices become colours with an alpha, and attributes of one number and of three.
WORN_PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float wear
property uchar red
property uchar green
property uchar blue
property uchar alpha
element face 1
property list uchar int vertex_indices
end_header
-1 -1 0 0 255 255 255 255
1 -1 0 1 255 0 255 51
1 1 0 0.5 255 255 255 102
3 0 1 2
"""
WORN = """version = 1
shading = { model = "phong" }
reflection = { model = "metallic-roughness" }
observer = { position = [0, 0, 4], look_at = [0, 0, 0] }
[[light]]
type = "directional"
direction = [0, 0, -1]
[[object]]
type = "mesh"
file = "worn.ply"
[object.material]
opacity = { attribute = "color", channel = "a" }
roughness = { attribute = "wear" }
emission = { attribute = "color", scale = 0.5 }
"""


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
    (scratch / "worn.ply").write_text(WORN_PLY)
    (scratch / "worn.toml").write_text(WORN)
    inputs.append(scratch / "worn.toml")
    made = []
    for file in inputs:
        folder = scratch / file.stem
        subprocess.run([candela, "generate", file, "--target", "gltf", "--approximate", "--quiet", "-o", folder], check=True)
        made.append(folder / "scene.glb")
    script = pathlib.Path(__file__).with_name("gltf_validator.js")
    return subprocess.run(["node", script, validator, *made], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
