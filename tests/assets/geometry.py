"""Accessors, nodes, lights and cameras of glTF files."""
import math
import struct

import formulas
import pictures
from asset import BYTE, FLOAT, FORWARD, SHORT, UBYTE, UINT, USHORT, Asset, Square, lit, matt
from evaluator import Camera, Light, Material, Quad, Scene, linear, mul, unit
from materials import AWAY, tilted

GREEN = tuple(linear(c / 255) for c in (50, 200, 90))
KITE = ((-0.8, -0.9, 0), (0.9, -0.7, 0), (0.6, 0.9, 0), (-0.9, 0.5, 0))


def seen(name, square, quads, lit_by=(AWAY,), **more):
    return Asset(name, square.files(), Scene(quads, list(lit_by)), **more)


def green(**quad):
    return Quad(matt(lambda p: GREEN), **quad)


def accessors():
    plain = lambda: Square().matt((*GREEN, 1))
    # Two corners are elsewhere until they are replaced.
    square = plain()
    g = square.gltf
    square.positions([KITE[0], (0, 0, 0), (0, 0, 0), KITE[3]], sparse={
        "count": 2, "indices": {"bufferView": g.view(struct.pack("<2H", 1, 2)), "componentType": USHORT},
        "values": {"bufferView": g.view(struct.pack("<6f", *KITE[1], *KITE[2]))}})
    accessor = g.json["accessors"][square.attributes["POSITION"]]
    accessor["min"], accessor["max"] = [min(c) for c in zip(*KITE)], [max(c) for c in zip(*KITE)]
    yield seen("sparse-positions", square, [green(corners=KITE)])
    # Zeros without a view, of which three are replaced.
    square = plain()
    normals = [unit(n) for n in ((0.3, 0, 1), (0, -0.4, 1), (-0.2, 0.2, 1))]
    g = square.gltf
    g.json["accessors"].append({"componentType": FLOAT, "count": 4, "type": "VEC3", "sparse": {
        "count": 4, "indices": {"bufferView": g.view(bytes(range(4))), "componentType": UBYTE},
        "values": {"bufferView": g.view(struct.pack("<12f", *normals[0], *normals[1], *normals[2], *normals[0]))}}})
    square.attributes["NORMAL"] = len(g.json["accessors"]) - 1
    yield seen("sparse-normals-and-smooth", square, [green(normals=(*normals, normals[0]))])

    square = plain()
    square.positions([tuple(round(32767 * x) for x in p) for p in KITE], SHORT, normalized=True)
    accessor = square.gltf.json["accessors"][square.attributes["POSITION"]]
    square.gltf.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    square.gltf.json["extensionsUsed"].append("KHR_mesh_quantization")
    yield seen("quantized-positions", square, [green(corners=KITE)])
    square = plain()
    view = square.gltf.view(b"".join(struct.pack("<3bx", *n) for n in ((38, 0, 120), (0, -47, 118), (-30, 30, 120), (0, 0, 127))),
                            byteStride=4)
    square.attribute("NORMAL", [(0, 0, 1)] * 4, BYTE, view=view, normalized=True)
    square.gltf.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    square.gltf.json["extensionsUsed"].append("KHR_mesh_quantization")
    yield seen("quantized-normals", square, [green(normals=tuple(unit(n) for n in ((38, 0, 120), (0, -47, 118), (-30, 30, 120), (0, 0, 127))))])
    picture = pictures.colorful()
    for name, kind, most in (("ubyte", UBYTE, 255), ("ushort", USHORT, 65535)):
        square = Square()
        rows = [tuple(round(most * x) for x in uv) for uv in ((0.1, 0.9), (0.8, 1), (0.9, 0.2), (0, 0.1))]
        view = square.gltf.view(b"".join(struct.pack("<2Bxx" if kind == UBYTE else "<2H", *r) for r in rows), byteStride=4)
        square.attribute("TEXCOORD_0", rows, kind, view=view, normalized=True)
        square.matt(baseColorTexture=square.texture(picture))
        uv = tuple(tuple(x / most for x in r) for r in rows)
        yield seen(f"texture-coordinates-{name}", square, [Quad(matt(lambda p: picture.at(p.uv[0], True)), uv=(uv,))])
    square = plain()
    square.primitive |= {"mode": 5, "indices": square.gltf.accessor(UINT, (0, 1, 3, 2))}
    yield seen("triangle-strip", square, [green()])
    square = plain()
    del square.attributes["NORMAL"]
    square.positions([(-1, -1, 0.4), (1, -1, 0.4), (1, 1, -0.4), (-1, 1, -0.4)])
    yield seen("flat-without-normals", square, [green(corners=((-1, -1, 0.4), (1, -1, 0.4), (1, 1, -0.4), (-1, 1, -0.4)))])


def turn_y(angle, scale=(1, 1, 1), at=(0, 0, 0)):
    c, s = math.cos(angle), math.sin(angle)
    return ((c * scale[0], 0, s * scale[2], at[0]), (0, scale[1], 0, at[1]), (-s * scale[0], 0, c * scale[2], at[2]))


def nodes():
    turned = {"rotation": [0, math.sin(0.35), 0, math.cos(0.35)]}
    square = Square().matt((*GREEN, 1))
    square.gltf.json["nodes"] = [{"mesh": 0, **turned, "translation": [0.2, -0.1, 0.5], "scale": [0.7, 0.9, 1]}]
    yield seen("node-placed", square, [green().placed(turn_y(0.7, (0.7, 0.9, 1), (0.2, -0.1, 0.5)))])
    square = Square().matt((*GREEN, 1))
    square.gltf.json["nodes"] = [{"children": [1, 2], **turned}, {"mesh": 0, "translation": [-0.6, 0, 0], "scale": [0.5, 0.5, 0.5]},
                                 {"mesh": 0, "translation": [0.6, 0.2, 0], "scale": [0.4, 0.6, 1]}]
    c, s = math.cos(0.7), math.sin(0.7)
    yield seen("node-with-two-children", square, [green().placed(turn_y(0.7, (k, l, 1), (c * x, y, -s * x)))
                                                  for k, l, x, y in ((0.5, 0.5, -0.6, 0), (0.4, 0.6, 0.6, 0.2))])
    # Normals of a surface that is stretched are those of the inverse transpose.
    square = Square().matt((*GREEN, 1))
    normals = [unit(n) for n in ((0.5, 0, 1), (0.5, 0, 1), (-0.5, 0.3, 1), (-0.5, 0.3, 1))]
    square.attribute("NORMAL", normals)
    square.gltf.json["nodes"] = [{"mesh": 0, "matrix": [0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, 3, 0, 0, 0, 0, 1]}]
    stretched = tuple(unit((n[0] / 0.5, n[1], n[2] / 3)) for n in normals)
    quad = green(normals=stretched).placed(((0.5, 0, 0, 0), (0, 1, 0, 0), (0, 0, 3, 0)))
    yield seen("node-stretches-normals", square, [quad])
    # A mirrored picture on the front.
    for name, scale, uv in (("node-mirrored", [-1, 1, 1], ((1, 1), (0, 1), (0, 0), (1, 0))),
                            ("node-mirrored-along-y", [1, -1, 1], ((0, 0), (1, 0), (1, 1), (0, 1)))):
        square, picture, slopes = Square({"doubleSided": False}), pictures.colorful(), pictures.slopes()
        square.matt(baseColorTexture=square.texture(picture))
        square.material["normalTexture"] = square.texture(slopes)
        square.gltf.json["nodes"] = [{"mesh": 0, "scale": scale}]
        material = matt(lambda p, picture=picture: picture.at(p.uv[0], True), tilt=tilted(slopes), double_sided=False)
        yield seen(name, square, [Quad(material, uv=(uv,))])


# ---- KHR_lights_punctual: a white matt surface sends E / pi

def lamp(square, light, **node):
    json = square.gltf.json
    json.setdefault("extensions", {}).setdefault("KHR_lights_punctual", {"lights": []})["lights"].append(light)
    if "KHR_lights_punctual" not in json["extensionsUsed"]:
        json["extensionsUsed"].append("KHR_lights_punctual")
    lights = len(json["extensions"]["KHR_lights_punctual"]["lights"])
    json["nodes"].append({"extensions": {"KHR_lights_punctual": {"light": lights - 1}}, **node})
    json["scenes"][0]["nodes"].append(len(json["nodes"]) - 1)


def lights():
    amber = tuple(linear(c / 255) for c in (255, 190, 80))
    per_pi = lambda k, color=(1, 1, 1): mul(k / math.pi, color)
    point = Light("point", per_pi(6, amber), position=(0.4, -0.3, 1.5))
    # Turned by 0.5 about y: its -z axis is (-sin 0.5, 0, -cos 0.5).
    towards = (-math.sin(0.5), 0, -math.cos(0.5))
    turned = [0, math.sin(0.25), 0, math.cos(0.25)]
    spot = Light("spot", per_pi(9), towards, (0.7, 0.1, 1.6), 0.2, 0.3)
    sun = Light("directional", per_pi(2.5), towards)
    smooth = "between a spotlight's cones"
    files = {"point": ({"type": "point", "intensity": 6, "color": list(amber)}, {"translation": [0.4, -0.3, 1.5]}),
             "spot": ({"type": "spot", "intensity": 9, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.3}},
                      {"translation": [0.7, 0.1, 1.6], "rotation": turned}),
             "directional": ({"type": "directional", "intensity": 2.5}, {"rotation": turned})}
    for name, used, says in (("light-point", (point,), ()), ("light-spot", (spot,), (smooth,)), ("light-directional", (sun,), ()),
                             ("lights-of-all-kinds", (point, spot, sun), (smooth,))):
        square = Square().matt((*GREEN, 1))
        for light in used:
            lamp(square, files[light.kind][0], **files[light.kind][1])
        asset = seen(name, square, [green()], used, lights="file")
        asset.says = says
        yield asset
    # A metal, so that the direction to a near light counts at each point.
    square = Square().rough(metallicFactor=1, roughnessFactor=0.5, baseColorFactor=[*GREEN, 1])
    square.gltf.json["extensionsUsed"] = []
    lamp(square, files["point"][0], **files["point"][1])
    metal = Material(lambda p, to_light: formulas.metallic_roughness(p, to_light, GREEN, 1, 0.5))
    yield seen("light-point-on-a-metal", square, [Quad(metal)], [point], lights="file")


def cameras():
    back = (math.sin(0.4), 0, math.cos(0.4))
    place, rotation = (1.5, 0.2, 3), [0, math.sin(0.2), 0, math.cos(0.2)]
    ahead = tuple(a - b for a, b in zip(place, back))
    picture = pictures.colorful()
    for name, camera, seen_by in (
            ("camera-perspective", {"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 1, "znear": 0.1}},
             Camera(place, ahead, yfov=0.8)),
            ("camera-orthographic", {"type": "orthographic", "orthographic": {"xmag": 1.2, "ymag": 1.2, "znear": 0.1, "zfar": 9}},
             Camera(place, ahead, height=2.4))):
        square = Square()
        square.matt(baseColorTexture=square.texture(picture))
        square.gltf.json["cameras"] = [camera]
        square.gltf.json["nodes"].append({"camera": 0, "translation": list(place), "rotation": rotation})
        square.gltf.json["scenes"][0]["nodes"].append(1)
        scene = lit(matt(lambda p: picture.at(p.uv[0], True)), [AWAY], seen_by)
        yield Asset(name, square.files(), scene, own_camera=True)


def assets():
    for family in (accessors, nodes, lights, cameras):
        yield from family()
