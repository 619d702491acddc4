"""Frames with textures on all objects against the same frames without, 1920 x 1080, in turns: the ratio of their times. The scenes of
tests/bench/scenes, with a texture of the colour, and with one more for each of the four parameters of Phong's material; and two that
textures fill.

textures.py <build folder> <work folder> [--frames N] [--rounds N] [--threads N]
"""
import argparse
import random
import re

from harness import HERE, figures, folders, ratio

parser = argparse.ArgumentParser()
parser.add_argument("--frames", type=int, default=30)
parser.add_argument("--rounds", type=int, default=7)
parser.add_argument("--threads", type=int, default=0)
arguments = folders(parser, "build", "work")
command = arguments.build / "bin/candela"

HEAD = """version = 1
[observer]
position = [0.0, 1.7, 4.0]
look_at = [0.0, 0.2, 0.0]
[image]
width = 1920
height = 1080
[constraints]
overlap = "allow"
[shading]
model = "phong"
[reflection]
model = "{model}"
[[light]]
type = "point"
position = [-2.0, 4.0, 3.0]
intensity = 25.0
[[light]]
type = "directional"
direction = [-1.0, -1.0, -0.5]
[[light]]
type = "ambient"
color = [60, 60, 70]
"""
# A floor seen at a shallow angle, so that all levels are used, and a teapot of small triangles in front of it; or a wall that
# fills the picture, whose texels are pixels.
SCENES = {
    "floor": """[[object]]
type = "mesh"
file = "floor.obj"
{texture}
[[object]]
type = "teapot"
position = [0.0, 0.5, 1.0]
{texture}
""",
    "wall": """[[object]]
type = "mesh"
file = "floor.obj"
rotation = [90.0, 0.0, 0.0]
{texture}
""",
}


def median_ms(scene):
    return figures(command, scene, 1920, 1080, arguments.frames, "--threads", arguments.threads, "--quiet", cwd=arguments.work)["frame_ms"]


size = 4096
texture = arguments.work / "texture.ppm"
if not texture.exists():
    row = random.Random(1).randbytes(3 * size * 64)
    texture.write_bytes(b"P6\n%d %d\n255\n" % (size, size) + row * (size // 64))
(arguments.work / "floor.obj").write_text(
    "v -4.9 0 4.9\nv 4.9 0 4.9\nv 4.9 0 -4.9\nv -4.9 0 -4.9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")


def compare(name, plain, textured):
    for kind, text in (("plain", plain), ("textured", textured)):
        (arguments.work / f"{kind}.toml").write_text(text)
    ratios = []
    for _ in range(arguments.rounds):
        plain_ms, textured_ms = median_ms("plain.toml"), median_ms("textured.toml")
        ratios.append(textured_ms / plain_ms)
    print(f"{name:15} textured / plain: median {ratio(ratios, 2)} "
          f"(the last {textured_ms:.2f} and {plain_ms:.2f} ms)", flush=True)


def with_textures(scene, color, material=""):
    """A texture for each object, and textures in its material."""
    textured = []
    for table in re.split(r"(?m)^(?=\[)", scene):
        if table.startswith("[[object]]"):
            plain = re.sub(r"(?m)^color *=.*\n", "", table)
            table = f"{plain.rstrip()}\n{color}\n" + (f"[object.material]\n{material}\n" if material else "")
        if not (material and table.startswith("[object.material]")):
            textured.append(table)
    return "".join(textured)


TEXTURE = 'color = { texture = "texture.ppm" }'
PARAMETERS = {"ka": 'scale = 0.1', "kd": 'scale = 0.7', "ks": 'scale = 0.3', "shininess": "scale = 60, offset = 2"}
MATERIAL = "\n".join(f'{name} = {{ texture = "{name}.ppm", {mapping} }}' for name, mapping in PARAMETERS.items())
for name in PARAMETERS:
    if not (arguments.work / f"{name}.ppm").exists():
        (arguments.work / f"{name}.ppm").write_bytes(texture.read_bytes())
for file in sorted((HERE / "scenes").glob("*.toml")):
    compare(file.stem, file.read_text(), with_textures(file.read_text(), TEXTURE))
    compare(f"{file.stem}, five", file.read_text(), with_textures(file.read_text(), TEXTURE, MATERIAL))
for name, objects in SCENES.items():
    for model in ("lambert", "phong", "ggx"):
        compare(f"{name} {model}", *(HEAD.format(model=model) + objects.format(texture=key) for key in ("", TEXTURE)))
