"""cycles.py BUILD OUT [--samples 256] [--blender PROGRAM]: light/environment against Blender's Cycles.

An orthographic sphere, matt or of metal, under a picture of a few soft lamps over grey. Prints the difference of the means and the mean
difference, in percent of Cycles' mean, within the outline. Fails above 1.5 %, except for roughness 0.7: there Cycles of Blender 3.4,
which masks and shadows separately, is 1.1 % darker than Candela, which correlates them by height. scripts/setup.sh does not install Blender."""
import argparse
import array
import math
import pathlib
import subprocess
import sys

SIZE, HEIGHT, OUTLINE, MOST = 120, 2.1, 0.98, 1.5
SURFACES = [("matt", 0), ("metal", 0.1), ("metal", 0.3), ("metal", 0.5), ("metal", 0.7)]
# Direction, concentration, intensity, colour.
LAMPS = [((0.4, 0.55, 0.75), 40, 6, (1, 0.9, 0.8)), ((-0.9, 0.1, 0.4), 15, 2, (0.6, 0.8, 1)), ((0.2, -0.8, 0.5), 6, 0.6, (0.9, 1, 0.7)),
         ((0.3, 0.2, -0.9), 25, 3, (1, 0.5, 0.4))]
SCENE = """version = 1
observer = {{position = [0, 0, 5], look_at = [0, 0, 0], projection = "orthographic", height = {height}}}
image = {{width = {size}, height = {size}, color_management = "none", samples = 16, background = [0, 0, 0]}}
shading = {{model = "phong"}}
[[light]]
type = "environment"
picture = "lamps.hdr"
samples = {samples}
[[object]]
type = "sphere"
radius = 1
segments = 256
color = [255, 255, 255]
"""
MATERIALS = {"matt": 'reflection = "lambert"\nmaterial = {{ka = 0, kd = 1}}\n',
             "metal": 'reflection = "metallic-roughness"\nmaterial = {{ka = 0, metallic = 1, roughness = {}}}\n'}


def rgbe(color):
    largest, exponent = math.frexp(max(color))
    return bytes(int(256 * largest / max(color) * channel) for channel in color) + bytes([exponent + 128])


def write_lamps(file, width=1024, height=512):
    """An equirectangular picture, its centre towards -z, in Radiance's format without compression."""
    lamps = [([x / math.hypot(*to) for x in to], *rest) for to, *rest in LAMPS]
    with open(file, "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for row in range(height):
            polar = math.pi * (row + 0.5) / height
            for column in range(width):
                turn = 2 * math.pi * ((column + 0.5) / width - 0.5)
                d = math.sin(polar) * math.sin(turn), math.cos(polar), -math.sin(polar) * math.cos(turn)
                color = [0.3, 0.3, 0.3]
                for to, concentration, intensity, tint in lamps:
                    share = intensity * math.exp(concentration * (sum(a * b for a, b in zip(d, to)) - 1))
                    color = [c + share * t for c, t in zip(color, tint)]
                out.write(rgbe(color))


def floats(data):
    numbers = array.array("f")
    numbers.frombytes(data)
    return numbers


def drawn_by_cycles(blender, out, kind, roughness):
    file = out / f"{kind}-{roughness}.floats"
    subprocess.run([blender, "-b", "-noaudio", "--python-exit-code", "1", "--python", pathlib.Path(__file__).with_name("cycles_scene.py"), "--",
                    out / "lamps.hdr", file, kind, str(roughness), str(SIZE), str(HEIGHT), "512"], check=True, stdout=subprocess.DEVNULL)
    numbers = floats(file.read_bytes())
    return [numbers[4 * i:4 * i + 3] for i in range(SIZE * SIZE)]


def drawn_by_candela(candela, out, kind, roughness, samples):
    file = out / f"{kind}-{roughness}.toml"
    file.write_text(SCENE.format(size=SIZE, height=HEIGHT, samples=samples) + MATERIALS[kind].format(roughness))
    subprocess.run([candela, "render", "--quiet", file, "-o", file.with_suffix(".pfm")], check=True)
    numbers = floats(file.with_suffix(".pfm").read_bytes()[-12 * SIZE * SIZE:])  # rows from the bottom as well
    return [numbers[3 * i:3 * i + 3] for i in range(SIZE * SIZE)]


def main():
    options = argparse.ArgumentParser()
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("out", type=pathlib.Path)
    options.add_argument("--samples", default="256")
    options.add_argument("--blender", default="blender")
    asked = options.parse_args()
    out = asked.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    write_lamps(out / "lamps.hdr")
    middle = 0.5 * (SIZE - 1)
    inside = [i for i in range(SIZE * SIZE) if math.hypot(i % SIZE - middle, i // SIZE - middle) * HEIGHT / SIZE < OUTLINE]
    failed = False
    print("surface      mean difference  difference of means")
    for kind, roughness in SURFACES:
        theirs = drawn_by_cycles(asked.blender, out, kind, roughness)
        ours = drawn_by_candela(asked.build / "bin/candela", out, kind, roughness, asked.samples)
        mean = sum(sum(theirs[i]) for i in inside)
        apart = 100 * sum(abs(a - b) for i in inside for a, b in zip(ours[i], theirs[i])) / mean
        brighter = 100 * (sum(sum(ours[i]) for i in inside) / mean - 1)
        print(f"{kind:5} {roughness:3}   {apart:12.2f} % {brighter:+18.2f} %")
        failed = failed or (apart > MOST and roughness < 0.7)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
