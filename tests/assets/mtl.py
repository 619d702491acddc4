"""OBJ files with MTL materials. Their texture coordinates have v upwards, which Quad.uv has downwards."""
import math

import formulas
import pictures
from asset import Asset, lit, matt
from evaluator import Camera, Light, Material, Quad, Scene, add, dot, encoded, linear, mul, unit
from materials import ASIDE, AWAY, tilted

SQUARE = """mtllib a.mtl
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl m
f 1/1/1 2/2/1 3/3/1 4/4/1
"""
BEHIND = """v -2 -2 -1
v 2 -2 -1
v 2 2 -1
v -2 2 -1
usemtl behind
f 5/1/1 6/2/1 7/3/1 8/4/1
"""
BLUE = (0.1, 0.2, 0.7)


def files(lines, **textures):
    return {"a.obj": SQUARE.encode(), "a.mtl": f"newmtl m\n{lines}\n".encode()} | {
        name + (".png" if p.mime == "image/png" else ".jpg"): p.file for name, p in textures.items()}


def asset(name, lines, material, light=AWAY, camera=ASIDE, says=(), **textures):
    return Asset(name, files(lines, **textures), lit(material, [light], camera), says)


def matt_asset(name, lines, color, **more):
    return asset(name, lines, matt(color), **more)


def phong(kd, ks, shininess):
    def reflected(p, to_light):
        mirrored = add(mul(2 * dot(p.normal, to_light), p.normal), mul(-1, to_light))
        shine = max(dot(mirrored, p.to_observer), 0) ** shininess
        return add(formulas.lambert(kd, p, to_light), mul(shine, ks))
    return Material(reflected)


def colors():
    kd = (0.6, 0.3, 0.1)
    yield matt_asset("mtl-kd", "Kd 0.6 0.3 0.1", lambda p: kd)
    yield matt_asset("mtl-kd-one-number", "Kd 0.4", lambda p: (0.4, 0.4, 0.4))
    yield matt_asset("mtl-illum-1", "Kd 0.6 0.3 0.1\nKs 0.4 0.4 0.4\nNs 20\nillum 1", lambda p: kd)
    yield asset("mtl-highlight", "Kd 0.6 0.3 0.1\nKs 0.2 0.3 0.4\nNs 12\nillum 2", phong(kd, (0.2, 0.3, 0.4), 12), Light(), Camera())
    shone = Light(direction=(-0.5, 0.1, -1)), Camera((-2, 0.8, 3))
    yield asset("mtl-highlight-from-the-side", "Kd 0.6 0.3 0.1\nKs 0.2 0.3 0.4\nNs 12\nillum 2", phong(kd, (0.2, 0.3, 0.4), 12), *shone)
    yield asset("mtl-highlight-without-exponent", "Kd 0.6 0.3 0.1\nKs 0.4 0.4 0.4\nNs 0", matt(lambda p: kd),
                says=("highlights without an exponent",))
    red, blue = (tuple(linear(c) for c in rgb) for rgb in ((0.9, 0.2, 0.1), (0.1, 0.3, 0.8)))
    of_vertices = SQUARE
    for old, new in (("v -1 -1 0", "v -1 -1 0 0.9 0.2 0.1"), ("v 1 -1 0", "v 1 -1 0 0.1 0.3 0.8"), ("v 1 1 0", "v 1 1 0 0.1 0.3 0.8"),
                     ("v -1 1 0", "v -1 1 0 0.9 0.2 0.1")):
        of_vertices = of_vertices.replace(old + "\n", new + "\n")
    made = matt_asset("obj-vertex-colors", "Kd 0.5 0.5 0.5", lambda p: mul(0.5, p.color[:3]))
    made.files["a.obj"] = of_vertices.encode()
    made.scene.quads[0].colors = tuple((*c, 1) for c in (red, blue, blue, red))
    yield made


def textures():
    picture = pictures.colorful()
    times = lambda kd, texel: tuple(k * t for k, t in zip(kd, texel))
    yield matt_asset("mtl-map-kd", "Kd 0.9 0.5 0.7\nmap_Kd c.png", lambda p: times((0.9, 0.5, 0.7), picture.at(p.uv[0], True)), c=picture)
    yield matt_asset("mtl-map-kd-and-black", "Kd 0 0 0\nmap_Kd c.png", lambda p: picture.at(p.uv[0], True)[:3], c=picture)
    # vt is s vt + o, with v upwards.
    placed = lambda s, o: lambda uv: (s[0] * uv[0] + o[0], 1 - (s[1] * (1 - uv[1]) + o[1]))
    for name, options, s, o, wrap in (("scale", "-s 1.5 0.5 1", (1.5, 0.5), (0, 0), "repeat"), ("offset", "-o 0.3 -0.2 0", (1, 1), (0.3, -0.2), "repeat"),
                                      ("scale-and-offset", "-s 1.5 2 1 -o 0.25 -0.4 0", (1.5, 2), (0.25, -0.4), "repeat"),
                                      ("clamp", "-clamp on -s 1.5 2 1 -o 0.25 -0.4 0", (1.5, 2), (0.25, -0.4), "clamp")):
        yield matt_asset(f"mtl-map-kd-{name}", f"Kd 1 1 1\nmap_Kd {options} c.png",
                         lambda p, at=placed(s, o), w=wrap: picture.at(at(p.uv[0]), True, (w, w))[:3], c=picture)
    photograph = pictures.photograph()
    made = matt_asset("mtl-map-kd-jpeg", "Kd 1 1 1\nmap_Kd c.jpg", lambda p: photograph.at(p.uv[0], True)[:3], c=photograph)
    made.levels = 1
    yield made
    none = lambda p, to_light: (0, 0, 0)
    yield asset("mtl-ke", "Kd 0 0 0\nKe 3 1.5 0", Material(none, emission=lambda p: (3, 3 * linear(188 / 255), 0)))
    yield asset("mtl-map-ke", "Kd 0 0 0\nKe 2 1 0.5\nmap_Ke c.png",
                Material(none, emission=lambda p: times((2, 1, 0.5), picture.at(p.uv[0], True))), c=picture)


def opacities():
    color, grey = pictures.colorful(), pictures.grey(8)
    kd = (0.2, 0.7, 0.3)
    for name, line, opacity in (("mtl-d", "d 0.3", lambda p: 0.3), ("mtl-tr", "Tr 0.3", lambda p: 0.7), ("mtl-d-and-tr", "Tr 0.9\nd 0.6", lambda p: 0.6),
                                ("mtl-map-d-alpha", "map_d c.png", lambda p: color.at(p.uv[0])[3]),
                                ("mtl-map-d-grey", "d 0.8\nmap_d g.png", lambda p: 0.8 * grey.at(p.uv[0])[0])):
        made = files(f"Kd 0.2 0.7 0.3\n{line}\nnewmtl behind\nKd 0.1 0.2 0.7", c=color, g=grey)
        made["a.obj"] += BEHIND.encode()
        behind = Quad(matt(lambda p: BLUE), corners=((-2, -2, -1), (2, -2, -1), (2, 2, -1), (-2, 2, -1)))
        yield Asset(name, made, Scene([Quad(matt(lambda p: kd, opacity=opacity)), behind], [AWAY]))


def physical():
    kd, picture = (0.8, 0.5, 0.3), pictures.colorful()

    color = tuple(linear(round(255 * encoded(c)) / 255) for c in kd)  # an object's has 8 bits

    def made(name, lines, values, **maps):
        of = values if callable(values) else lambda p: values
        return asset(name, "Kd 0.8 0.5 0.3\n" + lines,
                     Material(lambda p, to_light: formulas.metallic_roughness(p, to_light, color, **of(p))), **maps)
    yield made("mtl-pr", "Pr 0.45", {"roughness": 0.45})
    yield made("mtl-pr-pm", "Pr 0.5\nPm 1", {"roughness": 0.5, "metallic": 1})
    yield made("mtl-pc", "Pr 0.6\nPc 0.8\nPcr 0.3", {"roughness": 0.6, "coat": 0.8, "coat_roughness": 0.3})
    yield made("mtl-ps", "Pr 0.6\nPs 0.7", {"roughness": 0.6, "sheen": (0.7, 0.7, 0.7), "sheen_roughness": 0.5})
    yield made("mtl-aniso", "Pr 0.4\nPm 1\naniso 0.7\nanisor 0.125",
               {"roughness": 0.4, "metallic": 1, "strength": 0.7, "rotation": math.pi / 4})
    yield made("mtl-map-pr-pm", "Pr 0.9\nPm 0.8\nmap_Pr -imfchan g c.png\nmap_Pm c.png",
               lambda p: {"roughness": 0.9 * picture.at(p.uv[0])[1], "metallic": 0.8 * picture.at(p.uv[0])[0]}, c=picture)


def relief():
    slopes = pictures.slopes()
    white = lambda p: (0.9, 0.9, 0.9)
    yield asset("mtl-norm", "Kd 0.9 0.9 0.9\nnorm n.png", matt(white, tilt=tilted(slopes)), n=slopes)
    yield asset("mtl-map-bump-of-normals", "Kd 0.9 0.9 0.9\nmap_bump -bm 0.6 n.png", matt(white, tilt=tilted(slopes, 0.6)), n=slopes)
    # A ramp along u: docs/user/meshes.md makes white -bm hundredths of the picture's side, which is 2.
    ramp = pictures.rgba(8, 8, lambda x, y: (20 * x, 20 * x, 20 * x, 255))
    slope = 40 * 0.01 * 2 * (20 / 255) / (2 / 8)
    leaning = matt(white, tilt=lambda p: unit((-slope, 0, 1)) if 0.2 < p.uv[0][0] < 0.8 else None)
    leaning.opacity = lambda p: 1 if p.normal else None  # not where the ramp begins again
    yield asset("mtl-map-bump", "Kd 0.9 0.9 0.9\nmap_bump -bm 40 h.png", leaning, h=ramp)


def assets():
    for family in (colors, textures, opacities, physical, relief):
        yield from family()
