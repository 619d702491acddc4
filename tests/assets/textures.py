"""Base colours: textures with their transforms, wraps, coordinates and encodings; colours of vertices; opacity; sides."""
import pictures
from asset import FLOAT, FORWARD, UBYTE, USHORT, Asset, Square, lit, matt, transform
from evaluator import Camera, Light, Quad, Scene, linear

RED, GREEN, BLUE = (tuple(linear(c / 255) for c in rgb) for rgb in ((230, 60, 40), (50, 200, 90), (60, 90, 220)))
TURNED = ((0.5, 1), (0.5, 0.5), (0, 0.5), (0, 1))  # half the size, turned by 90 degrees


def times(a, b):
    return tuple(x * y for x, y in zip(a, b))


def based(name, square, color, levels=0.5, text=False, **quad):
    return Asset(name, square.files(text), lit(matt(color), **quad), levels=levels)


def factors():
    yield based("base-color-factor", Square().matt((*RED, 1)), lambda p: RED)
    picture = pictures.colorful()
    square = Square()
    square.matt((0.9, 0.5, 0.7, 1), baseColorTexture=square.texture(picture))
    yield based("base-color-texture-and-factor", square, lambda p: times((0.9, 0.5, 0.7), picture.at(p.uv[0], True)))


def transforms():
    picture = pictures.colorful()
    for name, placing in (("offset", {"offset": [0.3, -0.2]}), ("rotation", {"rotation": 0.7}), ("scale", {"scale": [1.5, -0.5]}),
                          ("all", {"offset": [-0.4, 0.9], "rotation": -2.1, "scale": [0.75, 1.25]})):
        square = Square()
        info = square.texture(picture)
        square.extension("KHR_texture_transform", info, **placing)
        square.matt(baseColorTexture=info)
        move = transform(**placing)
        yield based(f"texture-transform-{name}", square, lambda p, move=move: picture.at(move(p.uv[0]), True))
    for name, is_overridden in (("texcoord-1", False), ("texture-transform-texcoord", True)):
        square = Square()
        square.attribute("TEXCOORD_1", list(TURNED))
        info = square.texture(picture, texCoord=0 if is_overridden else 1)
        if is_overridden:
            square.extension("KHR_texture_transform", info, texCoord=1, scale=[1.5, 1.5])
        square.matt(baseColorTexture=info)
        move = transform((1.5, 1.5) if is_overridden else (1, 1))
        yield based(name, square, lambda p, move=move: picture.at(move(p.uv[1]), True), uv=(Quad.uv[0], TURNED))


def wraps():
    picture = pictures.colorful()
    for s, t in (("repeat", "repeat"), ("clamp", "clamp"), ("mirror", "mirror"), ("clamp", "repeat"), ("mirror", "clamp"),
                 ("repeat", "mirror")):
        square = Square()
        outside = ((-0.5, 1.4), (1.6, 1.4), (1.6, -0.7), (-0.5, -0.7))
        square.attribute("TEXCOORD_0", list(outside))
        square.matt(baseColorTexture=square.texture(picture, (s, t)))
        yield based(f"wrap-{s}-{t}", square, lambda p, s=s, t=t: picture.at(p.uv[0], True, (s, t)), uv=(outside,))


def encodings():
    cases = {"png-grey-1": pictures.grey(1), "png-grey-2": pictures.grey(2), "png-grey-4": pictures.grey(4), "png-grey-8": pictures.grey(8),
             "png-grey-16": pictures.grey(16), "png-grey-alpha": pictures.grey(8, True), "png-rgb-16": pictures.deep(),
             "png-palette-1": pictures.palette(1), "png-palette-2": pictures.palette(2), "png-palette-8": pictures.palette(8),
             "jpeg": pictures.photograph(), "jpeg-grey": pictures.photograph(1)}
    for name, picture in cases.items():
        square = Square()
        square.matt(baseColorTexture=square.texture(picture))
        yield based(name, square, lambda p, picture=picture: picture.at(p.uv[0], True), 1 if name == "jpeg" else 0.5)  # decoders round
    import base64
    picture = pictures.colorful()
    for name, uri in (("picture-in-a-data-uri", "data:image/png;base64," + base64.b64encode(picture.file).decode()),
                      ("picture-in-a-file", "a%20picture.png")):
        square = Square(more_files={"a picture.png": picture.file})
        square.matt(baseColorTexture=square.texture(picture, uri=uri))
        yield based(name, square, lambda p: picture.at(p.uv[0], True), text=True)


def vertex_colors():
    corners = ((1, 0, 0.25, 1), (0.5, 1, 0, 1), (0, 0.5, 1, 1), (1, 1, 0.75, 1))
    whole = lambda most, n: [tuple(round(most * v) for v in c[:n]) for c in corners]
    for name, rows, kind in (("float-vec3", [c[:3] for c in corners], FLOAT), ("float-vec4", list(corners), FLOAT),
                             ("ubyte-vec3", whole(255, 3), UBYTE), ("ubyte-vec4", whole(255, 4), UBYTE),
                             ("ushort-vec3", whole(65535, 3), USHORT), ("ushort-vec4", whole(65535, 4), USHORT)):
        square = Square().matt((*GREEN, 1))
        square.attribute("COLOR_0", rows, kind, **({} if kind == FLOAT else {"normalized": True}))
        yield based(f"vertex-colors-{name}", square, lambda p: times(p.color, GREEN), colors=corners)
    picture = pictures.colorful()
    square = Square()
    square.matt((0.9, 0.5, 0.7, 1), baseColorTexture=square.texture(picture))
    square.attribute("COLOR_0", list(corners))
    yield based("vertex-colors-and-texture", square, lambda p: times(times(p.color, (0.9, 0.5, 0.7)), picture.at(p.uv[0], True)),
                colors=corners)


# ---- opacity: the square in front of an opaque one that is larger

def before(square, color, opacity):
    """The files and the scene."""
    wide = [(-2, -2, -1), (2, -2, -1), (2, 2, -1), (-2, 2, -1)]
    json = square.gltf.json
    json["materials"].append({"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [*BLUE, 1]},
                              "extensions": {"KHR_materials_specular": {"specularFactor": 0}}})
    json["meshes"][0]["primitives"].append({"attributes": {"POSITION": square.gltf.accessor(FLOAT, wide),
                                                           "NORMAL": square.gltf.accessor(FLOAT, FORWARD)},
                                            "indices": square.primitive["indices"], "material": 1})
    behind = Quad(matt(lambda p: BLUE, double_sided=False), corners=tuple(wide))
    return square.files(), [Quad(matt(color, opacity=opacity)), behind]


def cut(alpha, cutoff):
    return None if abs(alpha - cutoff) < 0.01 else float(alpha >= cutoff)


def opacities():
    picture = pictures.colorful()
    for name, mode, cutoff, factor in (("alpha-opaque", "OPAQUE", None, 0.3), ("alpha-mask", "MASK", None, 1),
                                       ("alpha-mask-cutoff", "MASK", 0.25, 0.6), ("alpha-mask-cutoff-above-1", "MASK", 1.5, 1),
                                       ("alpha-blend-texture", "BLEND", None, 0.8)):
        square = Square()
        square.material["alphaMode"] = mode
        if cutoff is not None:
            square.material["alphaCutoff"] = cutoff
        square.matt((*GREEN, factor), baseColorTexture=square.texture(picture))
        alpha = lambda p, factor=factor: factor * picture.at(p.uv[0])[3]
        opacity = {"OPAQUE": lambda p: 1, "BLEND": alpha,
                   "MASK": lambda p, alpha=alpha, cutoff=cutoff: cut(alpha(p), 0.5 if cutoff is None else cutoff)}[mode]
        files, quads = before(square, lambda p: times(GREEN, picture.at(p.uv[0], True)), opacity)
        yield Asset(name, files, Scene(quads))
    square = Square({"alphaMode": "BLEND"}).matt((*GREEN, 0.25))
    files, quads = before(square, lambda p: GREEN, lambda p: 0.25)
    yield Asset("alpha-blend-factor", files, Scene(quads))
    fading = ((1, 1, 1, 0), (1, 1, 1, 1), (1, 1, 1, 0.5), (1, 1, 1, 0.25))
    square = Square({"alphaMode": "BLEND"}).matt((*GREEN, 0.75))
    square.attribute("COLOR_0", list(fading))
    files, quads = before(square, lambda p: GREEN, lambda p: 0.75 * p.color[3])
    quads[0].colors = fading
    yield Asset("alpha-of-vertices", files, Scene(quads))
    shown = pictures.palette(2, (255, 0, 128))
    square = Square({"alphaMode": "BLEND"})
    square.matt(baseColorTexture=square.texture(shown))
    files, quads = before(square, lambda p: shown.at(p.uv[0], True)[:3], lambda p: shown.at(p.uv[0])[3])
    yield Asset("alpha-of-a-palette", files, Scene(quads))


def sides():
    # Seen and lit from behind.
    for name, double_sided in (("single-sided-from-behind", False), ("double-sided-from-behind", True)):
        square = Square({"doubleSided": double_sided}).matt((*RED, 1))
        files, quads = before(square, lambda p: RED, lambda p: 1)
        quads[0].material.double_sided = double_sided
        yield Asset(name, files, Scene(quads, [Light(direction=(0, 0, 1))], camera=Camera((0, 0, -4))))


def assets():
    for family in (factors, transforms, wraps, encodings, vertex_colors, opacities, sides):
        yield from family()
