"""Converts a scene's dump (scene_dump.h) to a POV-Ray scene."""

import array
import math
import struct


def vector(v):
    return f"<{v[0]:.7g},{v[1]:.7g},{v[2]:.7g}>"


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def scaled(v, to):
    length = math.sqrt(sum(x * x for x in v))
    return [x * to / length for x in v]


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def get(self, layout):
        values = struct.unpack_from("<" + layout, self.data, self.at)
        self.at += struct.calcsize("<" + layout)
        return values

    def triples(self, code, count):
        """Rows of three floats ('f') or unsigned integers ('I')."""
        values = array.array(code)
        values.frombytes(self.data[self.at:self.at + 12 * count])
        self.at += 12 * count
        return list(zip(values[::3], values[1::3], values[2::3]))


def camera(eye, look_at, up, fov):
    forward = scaled([a - b for a, b in zip(look_at, eye)], 1)
    right = cross(forward, up)
    height = 2 * math.tan(math.radians(fov) / 2)
    return (f"camera {{ perspective location {vector(eye)} direction {vector(forward)} "
            f"right {vector(scaled(right, height))} * image_width / image_height up {vector(scaled(cross(right, forward), height))} }}\n")


def light(position, color):
    # POV-Ray fades by 2 / (1 + (r/d)^2), which is 2 d^2 / r^2 if d is far less than any r.
    d = 1e-3
    return (f"light_source {{ {vector(position)} rgb {vector([c / (2 * d * d) for c in color])} "
            f"fade_distance {d} fade_power 2 }}\n")


def mesh(reader):
    vertices, triangles, _, *rest = reader.get("3I7f")
    diffuse, specular, shininess = rest[:3], rest[3:6], rest[6]
    if max(specular) - min(specular) > 1e-6:
        raise ValueError("POV-Ray's phong highlights have the light's colour")
    position, normal = reader.triples("f", vertices), reader.triples("f", vertices)
    corners = reader.triples("I", triangles)
    return "\n".join([f"mesh2 {{ vertex_vectors {{ {vertices}", *map(vector, position),
                      f"}} normal_vectors {{ {vertices}", *map(vector, normal),
                      f"}} face_indices {{ {triangles}", *("<%d,%d,%d>" % c for c in corners),
                      f"}} pigment {{ rgb {vector(diffuse)} }} finish {{ ambient 0 diffuse 1 "
                      f"phong {specular[0]:.7g} phong_size {shininess:.7g} }} }}\n"])


def pov(dump):
    reader = Reader(dump)
    lights, objects = reader.get("2I")
    eye, look_at, up = reader.get("3f"), reader.get("3f"), reader.get("3f")
    fov, = reader.get("f")
    background = reader.get("3f")
    parts = ["#version 3.7;\nglobal_settings { assumed_gamma 1 }\n", f"background {{ rgb {vector(background)} }}\n",
             camera(eye, look_at, up, fov)]
    parts += [light(reader.get("3f"), reader.get("3f")) for _ in range(lights)]
    parts += [mesh(reader) for _ in range(objects)]
    return "".join(parts)
