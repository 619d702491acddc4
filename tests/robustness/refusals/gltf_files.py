"""glTF files whose materials, textures and vertices are wrong, huge or endless."""
import json

import scene_files  # noqa: F401  (finds the modules of tests/assets)
import pictures
from asset import FLOAT, UBYTE, Square

EXTENSIONS = ("ior", "specular", "clearcoat", "sheen", "anisotropy", "iridescence", "unlit", "pbrSpecularGlossiness", "emissive_strength",
              "transmission")
FACTORS = {"KHR_materials_ior": ("ior",), "KHR_materials_specular": ("specularFactor", "specularColorFactor"),
           "KHR_materials_clearcoat": ("clearcoatFactor", "clearcoatRoughnessFactor"),
           "KHR_materials_sheen": ("sheenColorFactor", "sheenRoughnessFactor"),
           "KHR_materials_anisotropy": ("anisotropyStrength", "anisotropyRotation"),
           "KHR_materials_iridescence": ("iridescenceFactor", "iridescenceIor", "iridescenceThicknessMinimum", "iridescenceThicknessMaximum"),
           "KHR_materials_pbrSpecularGlossiness": ("diffuseFactor", "specularFactor", "glossinessFactor"),
           "KHR_materials_emissive_strength": ("emissiveStrength",)}
TEXTURES = {"KHR_materials_specular": ("specularTexture", "specularColorTexture"),
            "KHR_materials_clearcoat": ("clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"),
            "KHR_materials_sheen": ("sheenColorTexture", "sheenRoughnessTexture"), "KHR_materials_anisotropy": ("anisotropyTexture",),
            "KHR_materials_iridescence": ("iridescenceTexture", "iridescenceThicknessTexture"),
            "KHR_materials_pbrSpecularGlossiness": ("diffuseTexture", "specularGlossinessTexture")}
DEEP = json.loads("[" * 25 + "]" * 25)
WRONG = {"array": [], "text": "x", "null": None, "true": True, "huge": 1e308, "minus-huge": -1e308, "minus": -1, "tiny": 5e-324,
         "integer": 2**63, "nested": DEEP, "texts": ["x", None, {}], "huges": [1e308] * 4, "minuses": [-1e308] * 4, "many": [1] * 5000}


def wrong_values():
    """(name, Square, exit code, part of a message)."""
    for extension in EXTENSIONS:
        square = Square()
        for number, value in enumerate(WRONG.values()):
            square.gltf.json["materials"].append({"extensions": {f"KHR_materials_{extension}": value}})
            square.gltf.json["meshes"][0]["primitives"].append(square.primitive | {"material": number + 1})
        yield f"{extension}-of-wrong-types", square, 0, ""
    for kind, value in WRONG.items():
        square = Square()
        for extension, names in FACTORS.items():
            square.gltf.json["materials"].append({"emissiveFactor": value, "alphaMode": value, "alphaCutoff": value, "doubleSided": value,
                                                  "pbrMetallicRoughness": dict.fromkeys(("baseColorFactor", "metallicFactor", "roughnessFactor"), value),
                                                  "extensions": {extension: dict.fromkeys(names, value)}})
            square.gltf.json["meshes"][0]["primitives"].append(square.primitive | {"material": len(square.gltf.json["materials"]) - 1})
        yield f"factors-{kind}", square, 0, ""
        square = Square()
        for extension, names in TEXTURES.items():
            for index in ({"index": value}, value, {"index": 0, "texCoord": value, "scale": value, "strength": value,
                                                    "extensions": {"KHR_texture_transform": value}},
                          {"index": 0, "extensions": {"KHR_texture_transform": dict.fromkeys(("scale", "rotation", "offset", "texCoord"), value)}}):
                square.gltf.json["materials"].append({"normalTexture": index, "occlusionTexture": index, "emissiveTexture": index,
                                                      "emissiveFactor": [1, 1, 1], "extensions": {extension: dict.fromkeys(names, index)},
                                                      "pbrMetallicRoughness": {"baseColorTexture": index, "metallicRoughnessTexture": index}})
                square.gltf.json["meshes"][0]["primitives"].append(square.primitive | {"material": len(square.gltf.json["materials"]) - 1})
        square.texture(pictures.slopes())
        yield f"textures-{kind}", square, 0, ""
        square = Square()
        square.rough(baseColorTexture=square.texture(pictures.colorful(), ("clamp", "mirror")))
        square.gltf.json["samplers"][0] = {"wrapS": value, "wrapT": value}
        square.gltf.json["textures"].append({"source": value, "sampler": value, "extensions": {"EXT_texture_webp": {"source": value}}})
        square.material["normalTexture"] = {"index": 1}
        yield f"samplers-and-sources-{kind}", square, 0, "the picture of a texture of material 0 is missing"


def indices():
    for name, index in (("beyond", 9), ("minus", -1), ("half", 0.5), ("huge", 2**64 - 1)):
        square = Square()
        square.rough(baseColorTexture={"index": index})
        square.texture(pictures.colorful())
        yield f"texture-{name}", square, 0, "the picture of a texture of material 0 is missing"
        square = Square()
        square.rough(baseColorTexture=square.texture(pictures.colorful()))
        square.gltf.json["textures"][0]["source"] = index
        yield f"image-{name}", square, 0, "the picture of a texture of material 0 is missing"
        square = Square()
        square.rough(baseColorTexture=square.texture(pictures.colorful()))
        square.gltf.json["images"][0]["bufferView"] = index
        yield f"view-{name}", square, 0, "a texture of material 0 is left out"


def images():
    for name, content, part in scene_files.broken_pictures():
        square = Square()
        square.rough(metallicRoughnessTexture=square.texture(pictures.Picture(1, 1, [], content or b" ")))
        square.material["normalTexture"] = {"index": 0}
        yield f"embedded-{name}", square, 0, "a texture of material 0 is left out"
    for name, uri in (("base64", "data:image/png;base64,!!!!"), ("base64-cut", "data:image/png;base64,iVBORw0KGgo"), ("no-comma", "data:image/png;base64"),
                      ("long", "data:image/png;base64," + "A" * 3_000_000), ("nothing", "data:,"), ("folder", "."), ("device", "/dev/zero"),
                      ("elsewhere", "../../etc/passwd"), ("percent", "%zz%"), ("nul", "a%00.png"), ("scheme", "http://localhost/a.png")):
        square = Square()
        square.rough(baseColorTexture=square.texture(pictures.colorful(), uri=uri))
        yield f"uri-{name}", square, 0, "a texture of material 0 is left out"


def many():
    square = Square()
    reference = square.texture(pictures.colorful())
    square.gltf.json["textures"] *= 20000
    square.rough(baseColorTexture=reference, metallicRoughnessTexture={"index": 19999})
    yield "textures-20000-of-one-image", square, 0, ""
    square = Square()
    for number in range(2000):
        square.gltf.json["materials"].append({"pbrMetallicRoughness": {"baseColorTexture": square.texture(pictures.colorful())}})
        if number < 500:
            square.gltf.json["meshes"][0]["primitives"].append(square.primitive | {"material": number + 1})
    yield "materials-500-with-textures", square, 0, ""
    square = Square()
    inside = {"index": 0}
    for _ in range(20):
        inside = {"index": 0, "extensions": {"KHR_texture_transform": inside}}
    square.texture(pictures.colorful())
    square.rough(baseColorTexture=inside)
    yield "transforms-within-transforms", square, 0, ""


def vertices():
    nan, inf = float("nan"), float("inf")
    for name, attribute, rows, kind, code, part in (
            ("colors-of-two", "COLOR_0", [(1, 1)] * 4, FLOAT, 1, "whose type does not fit its use"), ("colors-not-numbers", "COLOR_0", [(nan, inf, -inf, nan)] * 4, FLOAT, 0, ""),
            ("colors-huge", "COLOR_0", [(3e38, -3e38, 1)] * 4, FLOAT, 0, ""), ("colors-too-few", "COLOR_0", [(1, 1, 1)] * 3, FLOAT, 1, "4 positions and 3 colours"),
            ("uv-of-three", "TEXCOORD_0", [(0, 0, 0)] * 4, FLOAT, 1, "whose type does not fit its use"), ("uv-not-numbers", "TEXCOORD_0", [(nan, inf)] * 4, FLOAT, 0, ""),
            ("uv-huge", "TEXCOORD_0", [(0, 0), (3e38, 0), (3e38, 3e38), (0, -3e38)], FLOAT, 0, ""),
            ("uv-all-the-same", "TEXCOORD_0", [(0.5, 0.5)] * 4, FLOAT, 0, ""), ("uv1-too-few", "TEXCOORD_1", [(0, 0)] * 2, FLOAT, 1, "TEXCOORD_1"),
            ("uv1-of-bytes", "TEXCOORD_1", [(0, 1, 2, 3)] * 4, UBYTE, 1, "whose type does not fit its use"),
            ("tangents-of-three", "TANGENT", [(1, 0, 0)] * 4, FLOAT, 0, ""), ("tangents-not-numbers", "TANGENT", [(nan, 0, inf, 1)] * 4, FLOAT, 0, ""),
            ("tangents-along-the-normal", "TANGENT", [(0, 0, 1, 1)] * 4, FLOAT, 0, ""), ("tangents-zero", "TANGENT", [(0, 0, 0, 0)] * 4, FLOAT, 0, "")):
        square = Square({"alphaMode": "BLEND"})
        square.attribute(attribute, rows, kind)
        info = square.texture(pictures.slopes(), texCoord=int(attribute == "TEXCOORD_1"))
        square.rough(baseColorTexture=info)
        square.material["normalTexture"] = info
        yield name, square, code, part


def cases():
    for family in (wrong_values, indices, images, many, vertices):
        yield from family()


def raw():
    """(name, file, part of the message): texts that are not JSON."""
    text = Square().files(text=True)["a.gltf"].decode()
    for name, value in (("nan", "NaN"), ("infinity", "Infinity"), ("plus", "+1"), ("comment", "1 /* one */")):
        yield f"number-{name}", text.replace('"doubleSided": true', f'"alphaCutoff": {value}').encode(), "is not valid JSON from byte"
    yield "number-beyond-doubles", text.replace('"doubleSided": true', '"alphaCutoff": -1e999').encode(), "beyond the range of doubles: '-1e999'"
