"""Random scenes of surfaces that something is seen through, one behind the other and crossing: with opacity from a number, a picture by the first
or the second texture coordinates, or the vertices; with and without a cutoff; lit per pixel, at vertices and for faces; some with shadows."""

import base64
import json
import math
import random
import struct

SCENES = 8
SHADINGS = ["phong", "gouraud", "flat"]  # one for each rate at which light is evaluated
SIDE = 6  # vertices of the bulge in a row


def bulge():
    """A curved square as glTF, with two sets of texture coordinates, colours with an alpha, and a further number of each vertex."""
    grid = [(column / (SIDE - 1), row / (SIDE - 1)) for row in range(SIDE) for column in range(SIDE)]
    attributes = {
        "POSITION": [(1.1 * (s - 0.5), 1.1 * (t - 0.5), 0.3 - 0.5 * ((s - 0.5) ** 2 + (t - 0.5) ** 2)) for s, t in grid],
        "TEXCOORD_0": [(s, 1 - t) for s, t in grid],
        "TEXCOORD_1": [(0.3 + 1.9 * t + 0.2 * s, 1.4 * s - 0.4 * t) for s, t in grid],
        "COLOR_0": [(1 - 0.3 * s, 0.7 + 0.3 * t, 0.9, 0.3 + 0.6 * s) for s, t in grid],
        "_WEAR": [(0.5 + 0.5 * math.sin(5 * (s - 0.5) + 3 * (t - 0.5)),) for s, t in grid],
    }
    corners = [row * SIDE + column + k for row in range(SIDE - 1) for column in range(SIDE - 1) for k in (0, 1, SIDE + 1, 0, SIDE + 1, SIDE)]
    data, views, accessors = b"", [], []
    for numbers in [*attributes.values(), [(corner,) for corner in corners]]:
        is_index, size = numbers[0][0].__class__ is int, len(numbers[0])
        part = b"".join(struct.pack("<I" if is_index else f"<{size}f", *each) for each in numbers)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        accessors.append({"bufferView": len(views) - 1, "componentType": 5125 if is_index else 5126, "count": len(numbers),
                          "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[size]})
        data += part
    accessors[0] |= {"min": [min(axis) for axis in zip(*attributes["POSITION"])], "max": [max(axis) for axis in zip(*attributes["POSITION"])]}
    primitive = {"attributes": {name: i for i, name in enumerate(attributes)}, "indices": len(attributes)}
    return json.dumps({
        "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [primitive]}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": views, "accessors": accessors,
    })


def soft():
    """A picture whose values change by a few steps from texel to texel."""
    return b"P6\n16 16\n255\n" + bytes(
        value for y in range(16) for x in range(16) for value in (90 + 8 * abs(x - 8), 200 - 9 * abs(y - 8), 110 + 5 * abs(x - y)))


def files():
    return {"bulge.gltf": bulge().encode(), "soft.ppm": soft()}


SHAPES = {
    "bulge": 'type = "mesh"\nfile = "bulge.gltf"\nscale = 1.4\n',
    "sphere": 'type = "sphere"\nradius = 0.6\nsegments = 24\n',
    "torus": 'type = "torus"\nmajor_radius = 0.5\nminor_radius = 0.2\nsegments = 24\n',
    "cube": 'type = "cube"\nsize = 0.8\n',
}
ATTRIBUTES = ['attribute = "_WEAR"', 'attribute = "color", channel = "a"', 'attribute = "color", channel = "b"']


def opacity_of(chance, shape, turn):
    """Keys of a material; every source of an opacity has its turn."""
    scale, offset = chance.uniform(0.3, 1), chance.uniform(0, 0.3)
    numbers = f"scale = {scale:.3f}, offset = {offset:.3f}"
    placed = (f'wrap = "{chance.choice(["repeat", "clamp", "mirror"])}", transform = {{ scale = [{chance.uniform(0.5, 2):.2f}, {chance.uniform(0.5, 2):.2f}], '
              f"rotation = {chance.randrange(180)}, offset = [{chance.random():.2f}, {chance.random():.2f}] }}")
    picture = f'texture = "soft.ppm", channel = "{chance.choice("rgb")}", {numbers}, {placed}'
    sources = [f"{{ {picture} }}", f"{scale:.3f}"]
    if shape == "bulge":
        sources = [f"{{ {chance.choice(ATTRIBUTES)}, {numbers} }}", f"{{ {picture}, uv = 1 }}", *sources]
    cutoff = f"opacity_cutoff = {chance.uniform(0.3, 0.6):.3f}\n" if chance.random() < 0.3 else ""
    return f"opacity = {sources[turn % len(sources)]}\n{cutoff}"


def object_text(chance, number, turn):
    shape = ["bulge", "sphere", "bulge", "torus", "bulge", "cube"][turn % 6]
    place = [chance.uniform(-1, 1), chance.uniform(-0.6, 0.6), chance.uniform(-1, 0.7)]
    turns = [chance.randint(-40, 40), chance.randint(-60, 60), chance.randint(0, 90)]
    color = "[230, 120, 90]" if chance.random() < 0.5 else '{ texture = "soft.ppm", transform = { rotation = 30 } }'
    text = (f'[[object]]\nname = "{shape} {number}"\n{SHAPES[shape]}position = {[round(c, 3) for c in place]}\nrotation = {turns}\n'
            f'shading = "{SHADINGS[(turn + number) % 3]}"\nreflection = "{chance.choice(["lambert", "phong", "ggx"])}"\ncolor = {color}\n[object.material]\n')
    if shape == "bulge" and chance.random() < 0.4:
        text += 'emission = { attribute = "color", scale = 0.1 }\nocclusion = { attribute = "color", channel = "g" }\n'
    return text + opacity_of(chance, shape, turn // 2)


def scene_text(number):
    """The TOML of a scene; every fourth has shadows."""
    chance, has_shadows = random.Random(number), number % 4 == 3
    width, height = (160, 100) if has_shadows else (240, 150)
    view = 'projection = "orthographic"\nheight = 3' if number % 3 == 1 else "fov = 40"
    text = (f"version = 1\n[observer]\nposition = [{chance.uniform(-1.5, 1.5):.2f}, {chance.uniform(0, 1.5):.2f}, 4.5]\nlook_at = [0, 0, 0]\n{view}\n"
            f"[image]\nwidth = {width}\nheight = {height}\nsamples = {4 if number % 4 == 1 else 1}\nbackground = [40, 60, 90]\n"
            f"[shadows]\nenabled = {str(has_shadows).lower()}\n"
            '[constraints]\noverlap = "allow"\n[[light]]\ntype = "ambient"\nintensity = 0.6\n[[light]]\ntype = "point"\nposition = [-2, 4, 3]\nintensity = 18\n'
            '[[object]]\nname = "wall"\ntype = "cube"\nsize = 3\nposition = [0, -0.5, -3]\nshading = "phong"\nreflection = "lambert"\n')
    return text + "".join(object_text(chance, i, 5 * number + i) for i in range(5))
