"""Metallic-roughness and its extensions, lit and seen along the normal and from the side; normal maps; emission and occlusion."""
import math

import formulas
import pictures
from asset import FLOAT, Asset, Square, lit, matt, transform
from evaluator import Camera, Light, Material, add, linear, mul, unit

COPPER = tuple(linear(c / 255) for c in (240, 160, 120))
# From the side: N.L is 0.73, N.V 0.77.
AWAY, ASIDE = Light(direction=(-0.6, -0.5, -0.85)), Camera((-2.2, 1.1, 3))
# Towards grazing angles, almost in the direction of the mirror image.
LOW, GRAZING = Light(direction=(3, 0.1, -1)), Camera((3.2, 0.3, 1.4), height=1)


def reflecting(name, square, values, light=AWAY, camera=ASIDE, levels=0.5):
    """`values`: the arguments of formulas.metallic_roughness() for a point."""
    material = Material(lambda p, to_light: formulas.metallic_roughness(p, to_light, **values(p)))
    return Asset(name, square.files(), lit(material, [light], camera), levels=levels)


def plain():
    views = {"along-the-normal": (Light(), Camera()), "from-the-side": (AWAY, ASIDE), "at-grazing-angles": (LOW, GRAZING)}
    for view, (light, camera) in views.items():
        for kind, metallic, roughness in (("dielectric", 0, 0.6), ("metal", 1, 0.45), ("mixture", 0.4, 0.5)):
            # B.3.2 has a separable G, KHR_materials_anisotropy and Candela one that is not: further apart at grazing angles.
            square = Square().rough(metallicFactor=metallic, roughnessFactor=roughness, baseColorFactor=[*COPPER, 1])
            yield reflecting(f"{kind}-{view}", square, lambda p, m=metallic, r=roughness: {"color": COPPER, "metallic": m, "roughness": r},
                             light, camera, 3 if view == "at-grazing-angles" else 0.5)
    picture = pictures.colorful()
    square = Square()
    square.rough(metallicFactor=0.8, roughnessFactor=0.9, metallicRoughnessTexture=square.texture(picture, ("mirror", "clamp")),
                 baseColorTexture=square.texture(picture))
    square.extension("KHR_texture_transform", square.material["pbrMetallicRoughness"]["metallicRoughnessTexture"], scale=[1.5, 2],
                     rotation=0.4, offset=[-0.3, 0.2])
    move = transform((1.5, 2), 0.4, (-0.3, 0.2))

    def values(p):
        texel = picture.at(move(p.uv[0]), False, ("mirror", "clamp"))
        return {"color": picture.at(p.uv[0], True)[:3], "metallic": 0.8 * texel[2], "roughness": 0.9 * texel[1]}
    yield reflecting("metallic-roughness-texture", square, values)


def extended(name, extension, members, values, light=AWAY, camera=ASIDE, metallic=0.0, roughness=0.5, color=COPPER, textures=None, levels=0.5):
    square = Square().rough(metallicFactor=metallic, roughnessFactor=roughness, baseColorFactor=[*color, 1])
    square.extension(extension, **members)
    picture = pictures.colorful()
    for key in textures or ():
        square.material["extensions"][extension][key] = square.texture(picture)
    base = {"color": color, "metallic": metallic, "roughness": roughness}
    at = lambda p, srgb=False: picture.at(p.uv[0], srgb)
    return reflecting(name, square, lambda p: base | (values(p, at) if callable(values) else values), light, camera, levels)


def extensions():
    yield extended("ior", "KHR_materials_ior", {"ior": 2.2}, {"ior": 2.2})
    yield extended("specular", "KHR_materials_specular", {"specularFactor": 0.5, "specularColorFactor": [4, 2, 0.5]},
                   {"specular": 0.5, "tint": (4, 2, 0.5)})
    yield extended("specular-textures", "KHR_materials_specular", {"specularFactor": 0.9, "specularColorFactor": [8, 3, 1]},
                   lambda p, at: {"specular": 0.9 * at(p)[3], "tint": [a * b for a, b in zip((8, 3, 1), at(p, True))]},
                   textures=("specularTexture", "specularColorTexture"))
    for view, light, camera in (("", AWAY, ASIDE), ("-at-grazing-angles", LOW, GRAZING)):
        yield extended("clearcoat" + view, "KHR_materials_clearcoat", {"clearcoatFactor": 0.8, "clearcoatRoughnessFactor": 0.3},
                       {"coat": 0.8, "coat_roughness": 0.3}, light, camera, roughness=0.6, levels=3 if view else 0.5)
    yield extended("clearcoat-textures", "KHR_materials_clearcoat", {"clearcoatFactor": 0.9, "clearcoatRoughnessFactor": 0.7},
                   lambda p, at: {"coat": 0.9 * at(p)[0], "coat_roughness": 0.7 * at(p)[1]},
                   textures=("clearcoatTexture", "clearcoatRoughnessTexture"))
    yield extended("sheen", "KHR_materials_sheen", {"sheenColorFactor": [0.8, 0.6, 0.3], "sheenRoughnessFactor": 0.5},
                   {"sheen": (0.8, 0.6, 0.3), "sheen_roughness": 0.5})
    yield extended("sheen-at-grazing-angles", "KHR_materials_sheen", {"sheenColorFactor": [0.5, 0.5, 0.9], "sheenRoughnessFactor": 0.7},
                   {"sheen": (0.5, 0.5, 0.9), "sheen_roughness": 0.7}, LOW, GRAZING, roughness=1, levels=3)
    for degrees in (0, 50):
        angle = math.radians(degrees)
        yield extended(f"anisotropy-{degrees}", "KHR_materials_anisotropy", {"anisotropyStrength": 0.7, "anisotropyRotation": angle},
                       {"strength": 0.7, "rotation": angle}, metallic=1, roughness=0.35)
    for kind, metallic in (("dielectric", 0), ("metal", 1)):
        yield extended(f"iridescence-on-a-{kind}", "KHR_materials_iridescence",
                       {"iridescenceFactor": 1, "iridescenceIor": 1.7, "iridescenceThicknessMaximum": 420}, {"film": (1.7, 420)},
                       metallic=metallic, roughness=0.4)
    yield extended("iridescence-textures", "KHR_materials_iridescence",
                   {"iridescenceFactor": 1, "iridescenceThicknessMinimum": 150, "iridescenceThicknessMaximum": 550},
                   lambda p, at: {"film": (1.3, 150 + 400 * at(p)[1])}, metallic=1, textures=("iridescenceThicknessTexture",))


def older():
    diffuse = tuple(linear(c / 255) for c in (90, 120, 200))
    picture = pictures.colorful()
    for name, specular, gloss in (("specular-glossiness-matt", (0, 0, 0), 0.2), ("specular-glossiness", (0.4, 0.25, 0.1), 0.45)):
        square = Square()
        square.extension("KHR_materials_pbrSpecularGlossiness", diffuseFactor=[*diffuse, 1], specularFactor=list(specular),
                         glossinessFactor=gloss)
        material = Material(lambda p, l, s=specular, g=gloss: formulas.specular_glossiness(p, l, diffuse, s, g))
        yield Asset(name, square.files(), lit(material, [AWAY], ASIDE))
    square = Square()
    square.extension("KHR_materials_pbrSpecularGlossiness", specularFactor=[0.5, 0.25, 0.5], glossinessFactor=0.6,
                     diffuseTexture=square.texture(picture), specularGlossinessTexture=square.texture(picture))

    def reflected(p, to_light):
        color = picture.at(p.uv[0], True)
        return formulas.specular_glossiness(p, to_light, color[:3], (0.5 * color[0], 0.25 * color[1], 0.5 * color[2]), 0.6 * color[3])
    yield Asset("specular-glossiness-textures", square.files(), lit(Material(reflected), [AWAY], ASIDE))
    square = Square()
    square.extension("KHR_materials_unlit")
    square.material["pbrMetallicRoughness"] = {"baseColorFactor": [*COPPER, 1], "baseColorTexture": square.texture(picture)}
    shown = Material(lambda p, to_light: (0, 0, 0), emission=lambda p: [a * b for a, b in zip(COPPER, picture.at(p.uv[0], True))])
    yield Asset("unlit", square.files(), lit(shown), lights="imported")


# ---- normal maps

def tilted(picture, scale=1, at=lambda uv: uv):
    def normal(p):
        x, y, z = (2 * v - 1 for v in picture.at(at(p.uv[0]))[:3])
        return unit(add(mul(scale * x, p.tangent), add(mul(scale * y, p.bitangent), mul(z, p.normal))))
    return normal


def normals():
    picture = pictures.slopes()
    mirrored = ((1, 0), (0, 0), (0, 1), (1, 1))
    flipped = ((1, 1), (0, 1), (0, 0), (1, 0))
    tangents = ((0, 1, 0, -1),) * 4
    for name, scale, quad in (("normal-map", 1, {}), ("normal-map-scale", 0.4, {}), ("normal-map-steep", 2.5, {}),
                              ("normal-map-turned", 1, {"uv": (mirrored,)}), ("normal-map-mirrored", 1, {"uv": (flipped,)}),
                              ("normal-map-with-tangents", 1, {"tangents": tangents})):
        square = Square().matt()
        if "uv" in quad:
            square.attribute("TEXCOORD_0", list(quad["uv"][0]))
        if "tangents" in quad:
            square.attribute("TANGENT", list(tangents), FLOAT)
        square.material["normalTexture"] = square.texture(picture, scale=scale)
        yield Asset(name, square.files(), lit(matt(lambda p: (1, 1, 1), tilt=tilted(picture, scale)), [AWAY], **quad))
    square = Square().rough(metallicFactor=1, roughnessFactor=0.5, baseColorFactor=[*COPPER, 1])
    square.material["normalTexture"] = square.texture(picture)
    shiny = Material(lambda p, to_light: formulas.metallic_roughness(p, to_light, COPPER, 1, 0.5), tilt=tilted(picture))
    yield Asset("normal-map-on-a-metal", square.files(), lit(shiny, [AWAY], ASIDE))


def glows():
    picture = pictures.colorful()
    glow = tuple(linear(c / 255) for c in (255, 120, 40))
    none = lambda p, to_light: (0, 0, 0)
    for name, strength, textured in (("emission", 1, False), ("emission-strength", 6, False), ("emission-texture", 2.5, True)):
        square = Square().matt((0, 0, 0, 1))
        square.material["emissiveFactor"] = list(glow)
        if strength != 1:
            square.extension("KHR_materials_emissive_strength", emissiveStrength=strength)
        if textured:
            square.material["emissiveTexture"] = square.texture(picture)
        emission = lambda p, s=strength, t=textured: mul(s, [g * (c if t else 1) for g, c in zip(glow, picture.at(p.uv[0], True))])
        yield Asset(name, square.files(), lit(Material(none, emission=emission)))
    # How much ambient light there is without occlusion is not in the text.
    square = Square().matt()
    square.material["occlusionTexture"] = square.texture(picture, strength=0.7)
    occluded = Material(none, ambient=lambda p: (1 + 0.7 * (picture.at(p.uv[0])[0] - 1),) * 3)
    scene = lit(occluded, [Light(direction=(0, 0, 1))])
    scene.ambient = 1
    yield Asset("occlusion", square.files(), scene, only_ratios=True)
    square = Square().matt()
    square.material["occlusionTexture"] = square.texture(picture)
    yield Asset("occlusion-of-no-direct-light", square.files(), lit(matt(lambda p: (1, 1, 1))))


def assets():
    for family in (plain, extensions, older, normals, glows):
        yield from family()
