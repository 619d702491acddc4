"""Draws a few quadrilaterals by the texts of glTF 2.0 and MTL: a ray for each pixel, doubles, nothing of Candela's.

Light is in Candela's unit, in which a white matt surface that faces an intensity of 1 sends 1: pi times what the texts call f.
"""
import math
from dataclasses import dataclass, field


def add(a, b):
    return tuple(x + y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def mul(k, a):
    return tuple(k * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return mul(1 / math.sqrt(dot(a, a)), a)


def linear(c):
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def encoded(c):
    """sRGB, continued beyond 1."""
    return 12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055


def mixed(weights, values):
    return tuple(sum(w * v[k] for w, v in zip(weights, values)) for k in range(len(values[0])))


@dataclass
class Point:
    normal: tuple
    tangent: tuple  # along u, of length 1 and perpendicular to the normal
    bitangent: tuple  # along v as glTF's normal maps have it: upwards in the picture
    uv: tuple  # sets of (u, v)
    color: tuple
    to_observer: tuple


@dataclass
class Material:
    """Functions of a point; `reflected` takes the direction to the light as well, and includes the cosine."""
    reflected: object
    emission: object = lambda p: (0, 0, 0)
    opacity: object = lambda p: 1
    ambient: object = lambda p: (0, 0, 0)
    tilt: object = None  # the normal of a point
    double_sided: bool = True


@dataclass
class Quad:
    """Two triangles, 0 1 2 and 0 2 3; the default is the square of a GltfSquare."""
    material: Material
    corners: tuple = ((-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0))
    uv: tuple = (((0, 1), (1, 1), (1, 0), (0, 0)),)
    colors: tuple = ((1, 1, 1, 1),) * 4
    normals: tuple = ()  # the triangles' own if empty
    tangents: tuple = ()  # with the sign of the bitangent; along u if empty

    def placed(self, matrix):
        """By a matrix of three rows of four."""
        at = lambda p: tuple(dot(row[:3], p) + row[3] for row in matrix)
        return Quad(self.material, tuple(map(at, self.corners)), self.uv, self.colors, self.normals, self.tangents)


@dataclass
class Light:
    kind: str = "directional"
    color: tuple = (1, 1, 1)  # times the intensity
    direction: tuple = (0, 0, -1)
    position: tuple = (0, 0, 0)
    inner: float = 0
    outer: float = math.pi / 4

    def arriving(self, position):
        """The direction to the light, and what arrives; None between the cones of a spotlight."""
        if self.kind == "directional":
            return unit(mul(-1, self.direction)), self.color
        way = sub(self.position, position)
        to_light = unit(way)
        share = 1
        if self.kind == "spot":
            angle = math.acos(max(-1, min(1, -dot(to_light, unit(self.direction)))))
            if abs(angle - self.inner) < 0.01 or abs(angle - self.outer) < 0.01 or self.inner < angle < self.outer:
                return None
            share = angle < self.inner
        return to_light, mul(share / dot(way, way), self.color)


@dataclass
class Camera:
    position: tuple = (0, 0, 4)
    look_at: tuple = (0, 0, 0)
    up: tuple = (0, 1, 0)
    height: float = 2  # of an orthographic picture
    yfov: float = 0  # in radians, of a perspective one

    def ray(self, x, y):
        """Its origin and direction; x and y from -1 to 1, y upwards."""
        ahead = unit(sub(self.look_at, self.position))
        right = unit(cross(ahead, self.up))
        up = cross(right, ahead)
        if self.yfov:
            k = math.tan(self.yfov / 2)
            return self.position, unit(add(ahead, add(mul(k * x, right), mul(k * y, up))))
        k = self.height / 2
        return add(self.position, add(mul(k * x, right), mul(k * y, up))), ahead


@dataclass
class Scene:
    quads: list
    lights: list = field(default_factory=lambda: [Light()])
    ambient: float = 0
    camera: Camera = field(default_factory=Camera)

    def hits(self, origin, direction):
        """(distance, quad, triangle, weights), from near to far."""
        found = []
        for q, quad in enumerate(self.quads):
            for t, (i, j, k) in enumerate(((0, 1, 2), (0, 2, 3))):
                a, b, c = quad.corners[i], quad.corners[j], quad.corners[k]
                n = cross(sub(b, a), sub(c, a))
                facing = -dot(n, direction)
                if facing == 0 or (facing < 0 and not quad.material.double_sided):
                    continue
                distance = dot(n, sub(a, origin)) / dot(n, direction)
                p = add(origin, mul(distance, direction))
                v = dot(cross(sub(p, a), sub(c, a)), n) / dot(n, n)
                w = dot(cross(sub(b, a), sub(p, a)), n) / dot(n, n)
                if distance > 0 and min(v, w, 1 - v - w) > -1e-9:  # also on the edge of both
                    found.append((distance, q, t, (1 - v - w, v, w)))
        # The triangles of a quad share an edge.
        found.sort(key=lambda hit: hit[0])
        return [h for i, h in enumerate(found) if i == 0 or h[1] != found[i - 1][1]]

    def point(self, hit, direction):
        _, q, t, weights = hit
        quad = self.quads[q]
        corners = (0, 1, 2) if t == 0 else (0, 2, 3)
        of = lambda values: mixed(weights, [values[i] for i in corners])
        a, b, c = (quad.corners[i] for i in corners)
        normal = unit(of(quad.normals)) if quad.normals else unit(cross(sub(b, a), sub(c, a)))
        uv = tuple(of(values) for values in quad.uv)
        tangent, sign = (1, 0, 0), 1
        if quad.tangents:
            *tangent, sign = of(quad.tangents)
        elif uv:
            (ua, va), (ub, vb), (uc, vc) = (quad.uv[0][i] for i in corners)
            area = (ub - ua) * (vc - va) - (uc - ua) * (vb - va)
            if area:
                tangent = mul(1 / area, sub(mul(vc - va, sub(b, a)), mul(vb - va, sub(c, a))))
                sign = -1 if area > 0 else 1  # v points downwards
        tangent = unit(sub(tangent, mul(dot(tangent, normal), normal)))
        bitangent = mul(sign, cross(normal, tangent))
        p = Point(normal, tangent, bitangent, uv, of(quad.colors), mul(-1, direction))
        if quad.material.tilt:
            p.normal = quad.material.tilt(p)
        if p.normal and dot(cross(sub(b, a), sub(c, a)), direction) > 0:
            p.normal = mul(-1, p.normal)
        return p

    def color(self, x, y):
        """None where an edge or a penumbra is too near for an exact value."""
        origin, direction = self.camera.ray(x, y)
        total, left = (0, 0, 0), 1.0
        for hit in self.hits(origin, direction):
            p, material = self.point(hit, direction), self.quads[hit[1]].material
            opacity = material.opacity(p)
            if opacity is None:
                return None
            sent = add(material.emission(p), mul(self.ambient, material.ambient(p)))
            for light in self.lights:
                arrives = light.arriving(add(origin, mul(hit[0], direction)))
                if arrives is None:
                    return None
                to_light, intensity = arrives
                if dot(to_light, p.normal) > 0:
                    sent = add(sent, tuple(i * r for i, r in zip(intensity, material.reflected(p, to_light))))
            total = add(total, mul(left * opacity, sent))
            left *= 1 - opacity
            if left == 0:
                break
        return total

    def picture(self, size):
        """Rows from the bottom, as in PFM files."""
        at = lambda i: (2 * i + 1) / size - 1
        seen = lambda x, y: [h[1] for h in self.hits(*self.camera.ray(x, y))]
        for j in range(size):
            for i in range(size):
                x, y, half = at(i), at(j), 0.999 / size
                around = [seen(x + dx, y + dy) for dx in (-half, half) for dy in (-half, half)]
                yield self.color(x, y) if all(each == around[0] for each in around) else None
