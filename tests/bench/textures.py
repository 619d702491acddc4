"""Frames with a texture against the same without, 1920 x 1080, in turns: the ratio of their times.

textures.py <build folder> <work folder> [--frames N] [--rounds N] [--threads N]
"""
import argparse
import json
import pathlib
import random
import statistics
import subprocess

parser = argparse.ArgumentParser()
parser.add_argument("build", type=pathlib.Path)
parser.add_argument("work", type=pathlib.Path)
parser.add_argument("--frames", type=int, default=30)
parser.add_argument("--rounds", type=int, default=7)
parser.add_argument("--threads", type=int, default=0)
arguments = parser.parse_args()
command = arguments.build.resolve() / "bin" / "candela"
arguments.work.mkdir(parents=True, exist_ok=True)

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
# A floor seen at a shallow angle, so that all levels are, and a teapot of small triangles before it; or a wall that fills the picture,
# whose texels are pixels.
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
    words = [command, "bench", scene, "--frames", str(arguments.frames), "--threads", str(arguments.threads), "--json", "--quiet"]
    return json.loads(subprocess.run(words, cwd=arguments.work, check=True, capture_output=True).stdout)["frame_ms"]


size = 4096
texture = arguments.work / "texture.ppm"
if not texture.exists():
    row = random.Random(1).randbytes(3 * size * 64)
    texture.write_bytes(b"P6\n%d %d\n255\n" % (size, size) + row * (size // 64))
(arguments.work / "floor.obj").write_text(
    "v -4.9 0 4.9\nv 4.9 0 4.9\nv 4.9 0 -4.9\nv -4.9 0 -4.9\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n")
for name, objects in SCENES.items():
    for model in ("lambert", "phong", "ggx"):
        for kind, key in (("plain", ""), ("textured", 'color_texture = "texture.ppm"')):
            (arguments.work / f"{kind}.toml").write_text(HEAD.format(model=model) + objects.format(texture=key))
        ratios = []
        for _ in range(arguments.rounds):
            plain, textured = median_ms("plain.toml"), median_ms("textured.toml")
            ratios.append(textured / plain)
        print(f"{name:6} {model:8} textured / plain: median {statistics.median(ratios):.2f} "
              f"({min(ratios):.2f} to {max(ratios):.2f}; the last {textured:.2f} and {plain:.2f} ms)", flush=True)
