"""An asset: a model's files, and what must be seen of them."""
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import evaluator

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "robustness/samples"))
from files import BYTE, FLOAT, SHORT, UBYTE, UINT, USHORT, Gltf  # noqa: E402, F401

WRAPS = {"repeat": 10497, "clamp": 33071, "mirror": 33648}
FORWARD = [(0, 0, 1)] * 4


@dataclass
class Asset:
    name: str
    files: dict  # the first is the model
    scene: evaluator.Scene
    says: tuple = ()  # parts of all notes
    levels: float = 0.5  # of 255, that a pixel may differ
    lights: str = "test"  # the test's; or the file's; or the imported scene's, with those that import adds
    own_camera: bool = False
    only_ratios: bool = False  # pixels are compared up to a common factor


@dataclass
class Square:
    """A square as evaluator.Quad's defaults are, as a glTF file."""
    material: dict = field(default_factory=dict)
    gltf: Gltf = field(default_factory=Gltf)
    more_files: dict = field(default_factory=dict)

    def __post_init__(self):
        self.material.setdefault("doubleSided", True)
        self.gltf.json["materials"] = [self.material]
        self.attributes = {}
        self.primitive = {"attributes": self.attributes, "material": 0}
        self.gltf.mesh(**self.primitive)
        self.primitive = self.gltf.json["meshes"][0]["primitives"][0]
        self.positions([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
        self.attribute("NORMAL", FORWARD)
        self.attribute("TEXCOORD_0", [(0, 1), (1, 1), (1, 0), (0, 0)])
        self.primitive["indices"] = self.gltf.accessor(USHORT, (0, 1, 2, 0, 2, 3))

    def positions(self, rows, kind=FLOAT, **more):
        bounds = {"min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]}
        self.attributes["POSITION"] = self.gltf.accessor(kind, rows, **bounds, **more)

    def attribute(self, name, rows, kind=FLOAT, **more):
        if kind == UBYTE and len(rows[0]) == 3:  # elements start at multiples of four bytes
            view = self.gltf.view(b"".join(bytes(r) + b"\0" for r in rows), byteStride=4)
            more["view"] = view
        self.attributes[name] = self.gltf.accessor(kind, rows, **more)

    def texture(self, picture, wraps=None, uri=None, **info):
        """A texture's reference with more members."""
        json = self.gltf.json
        image = {"uri": uri} if uri else {"bufferView": self.gltf.view(picture.file), "mimeType": picture.mime}
        json.setdefault("images", []).append(image)
        texture = {"source": len(json["images"]) - 1}
        if wraps:
            json.setdefault("samplers", []).append({"wrapS": WRAPS[wraps[0]], "wrapT": WRAPS[wraps[1]]})
            texture["sampler"] = len(json["samplers"]) - 1
        json.setdefault("textures", []).append(texture)
        return {"index": len(json["textures"]) - 1, **info}

    def extension(self, name, of=None, **members):
        (self.material if of is None else of).setdefault("extensions", {})[name] = members
        used = self.gltf.json.setdefault("extensionsUsed", [])
        if name not in used:
            used.append(name)

    def matt(self, color=(1, 1, 1, 1), **pbr):
        """Without a mirrored part only Lambert's is left."""
        self.material["pbrMetallicRoughness"] = {"metallicFactor": 0, "baseColorFactor": list(color), **pbr}
        self.extension("KHR_materials_specular", specularFactor=0)
        return self

    def rough(self, **pbr):
        self.material["pbrMetallicRoughness"] = pbr
        return self

    def files(self, text=False):
        model = {"a.gltf": self.gltf.text()} if text else {"a.glb": self.gltf.binary()}
        return model | self.more_files


def transform(scale=(1, 1), rotation=0, offset=(0, 0)):
    """KHR_texture_transform's matrix, translation times rotation times scale."""
    c, s = math.cos(rotation), math.sin(rotation)
    return lambda uv: (c * scale[0] * uv[0] + s * scale[1] * uv[1] + offset[0],
                       -s * scale[0] * uv[0] + c * scale[1] * uv[1] + offset[1])


def lit(material, lights=None, camera=None, **quad):
    """A scene of one square."""
    scene = evaluator.Scene([evaluator.Quad(material, **quad)])
    if lights:
        scene.lights = lights
    if camera:
        scene.camera = camera
    return scene


def matt(color, **more):
    """Lambert's with a function of the point."""
    import formulas
    return evaluator.Material(lambda p, to_light: formulas.lambert(color(p), p, to_light), **more)
