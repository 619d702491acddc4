"""Reflection by the texts of glTF 2.0 (appendix B), its extensions and MTL: pi f cos, per channel."""
import functools
import math

from evaluator import add, dot, mul, unit


def mix(a, b, t):
    return (1 - t) * a + t * b


def schlick(f0, f90, cosine):
    return f0 + (f90 - f0) * (1 - abs(cosine)) ** 5


def lambert(color, p, to_light):
    return mul(max(dot(p.normal, to_light), 0), color)


class Angles:
    def __init__(self, p, to_light):
        self.half = unit(add(to_light, p.to_observer))
        self.nl, self.nv = dot(p.normal, to_light), dot(p.normal, p.to_observer)
        self.nh, self.vh = dot(p.normal, self.half), dot(p.to_observer, self.half)


def microfacets(a, alpha):
    """D G / (4 N.L N.V), with the separable G of B.3.2."""
    a2 = alpha * alpha
    d = a2 / (math.pi * (a.nh * a.nh * (a2 - 1) + 1) ** 2)
    return d / math.prod(c + math.sqrt(a2 + (1 - a2) * c * c) for c in (a.nl, a.nv))


def anisotropic_microfacets(a, p, to_light, tangent, bitangent, roughness, strength):
    """KHR_materials_anisotropy."""
    ab = roughness * roughness
    at = mix(ab, 1, strength * strength)
    th, bh = dot(tangent, a.half), dot(bitangent, a.half)
    f = (ab * th, at * bh, at * ab * a.nh)
    d = at * ab * (at * ab / sum(x * x for x in f)) ** 2 / math.pi
    smith = lambda w, c: math.sqrt((at * dot(tangent, w)) ** 2 + (ab * dot(bitangent, w)) ** 2 + c * c)
    return d * 0.5 / (a.nl * smith(p.to_observer, a.nv) + a.nv * smith(to_light, a.nl))


# ---- KHR_materials_sheen

def sheen_lambda(cosine, alpha):
    t = (1 - alpha) ** 2
    a, b, c = mix(21.5473, 25.3245, t), mix(3.82987, 3.32435, t), mix(0.19823, 0.16801, t)
    d, e = mix(-1.97760, -1.27393, t), mix(-4.32054, -4.85967, t)
    curve = lambda x: a / (1 + b * x ** c) + d * x + e
    return math.exp(curve(cosine) if cosine < 0.5 else 2 * curve(0.5) - curve(1 - cosine))


def fibres(nl, nv, nh, alpha):
    d = (2 + 1 / alpha) * max(1 - nh * nh, 0) ** (0.5 / alpha) / (2 * math.pi)
    return d / ((1 + sheen_lambda(nv, alpha) + sheen_lambda(nl, alpha)) * 4 * nv * nl)


@functools.cache
def sheen_albedo(cosine, alpha):
    """The integral of white fibres over all directions to the light."""
    v = (math.sqrt(1 - cosine * cosine), 0, cosine)
    total, steps = 0, 120
    for i in range(steps):
        nl = (i + 0.5) / steps
        for j in range(steps):
            phi = math.pi * (j + 0.5) / steps
            s = math.sqrt(1 - nl * nl)
            h = unit(add(v, (s * math.cos(phi), s * math.sin(phi), nl)))
            total += fibres(nl, cosine, h[2], alpha) * nl
    return total * 2 * math.pi / steps ** 2


# ---- KHR_materials_iridescence

def film_fresnel(f0, cosine, ior, thickness):
    """Its reflectance in three channels, after Belcour and Barla (2017); nanometres."""
    sensitivity_peaks = ((5.4856e-13, 1.6810e6, 4.3278e9), (4.4201e-13, 1.7953e6, 9.3046e9), (5.2481e-13, 2.2084e6, 6.6121e9))
    ratio = lambda n, m: ((n - m) / (n + m)) ** 2

    def sensitivity(difference, shift):
        phase = 2 * math.pi * difference * 1e-9
        gauss = lambda value, position, variance: (value * math.sqrt(2 * math.pi * variance) *
                                                   math.cos(position * phase + shift) * math.exp(-phase * phase * variance))
        x, y, z = (gauss(*peak) / 1.0685e-7 for peak in sensitivity_peaks)
        x += gauss(9.7470e-14, 2.2399e6, 4.5282e9) / 1.0685e-7
        return (3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                0.0556434 * x - 0.2040259 * y + 1.0572252 * z)

    ior = mix(1, ior, min(thickness / 0.03, 1))
    below = math.sqrt(1 - (1 - cosine * cosine) / (ior * ior))
    outer = schlick(ratio(ior, 1), 1, cosine)
    result = []
    for channel, reflectance in enumerate(f0):
        root = math.sqrt(min(reflectance, 0.9999))
        base = (1 + root) / (1 - root)
        inner = schlick(ratio(base, ior), 1, below)
        shift = math.pi + (math.pi if base < ior else 0)
        product = min(max(outer * inner, 1e-5), 0.9999)
        sum_of_all = (1 - outer) ** 2 * inner / (1 - product)
        value, amplitude = outer + sum_of_all, sum_of_all - (1 - outer)
        for m in (1, 2):
            amplitude *= math.sqrt(product)
            value += 2 * amplitude * sensitivity(m * 2 * ior * thickness * below, m * shift)[channel]
        result.append(max(value, 0))
    return result


def metallic_roughness(p, to_light, color, metallic=0, roughness=1, ior=1.5, specular=1, tint=(1, 1, 1), coat=0,
                       coat_roughness=0, sheen=(0, 0, 0), sheen_roughness=0, strength=0, rotation=0, film=None):
    """Appendix B.2 with the extensions; `film` is (index, thickness), over all of the surface."""
    a = Angles(p, to_light)
    if a.nl <= 0:
        return (0, 0, 0)
    lobe = microfacets(a, roughness * roughness)
    if strength:
        c, s = math.cos(rotation), math.sin(rotation)
        t, b = add(mul(c, p.tangent), mul(s, p.bitangent)), add(mul(-s, p.tangent), mul(c, p.bitangent))
        lobe = anisotropic_microfacets(a, p, to_light, t, b, roughness, strength)
    f0 = [min(((ior - 1) / (ior + 1)) ** 2 * t, 1) * specular for t in tint]
    dielectric = [schlick(f, specular, a.vh) for f in f0]
    metal = [schlick(c, 1, a.vh) for c in color]
    if film:
        dielectric, metal = film_fresnel(f0, a.nv, *film), film_fresnel(color, a.nv, *film)
    through = 1 - max(dielectric)
    f = [mix(through * color[k] / math.pi + dielectric[k] * lobe, metal[k] * lobe, metallic) for k in range(3)]
    if max(sheen) > 0:
        alpha = sheen_roughness ** 2
        left = 1 - max(sheen) * max(sheen_albedo(a.nl, alpha), sheen_albedo(a.nv, alpha))
        f = [left * f[k] + sheen[k] * fibres(a.nl, a.nv, a.nh, alpha) for k in range(3)]
    if coat:
        weight = coat * schlick(0.04, 1, a.nv)
        f = [mix(f[k], microfacets(a, coat_roughness ** 2), weight) for k in range(3)]
    return mul(math.pi * a.nl, f)


def specular_glossiness(p, to_light, color, specular, gloss):
    a = Angles(p, to_light)
    lobe = microfacets(a, (1 - gloss) ** 2)
    through = 1 - max(specular)
    return mul(math.pi * a.nl, [through * c / math.pi + schlick(s, 1, a.vh) * lobe for c, s in zip(color, specular)])
