"""Reads model files independently of Candela: triangles with their corners' attributes, by material.

Supports only the features of povray_test.py's files. Everything is in arrays of (triangles, corners, components)."""
import json
import struct
from pathlib import Path

import numpy as np


class Part:
    def __init__(self, positions, normals=None, colors=None, material=""):
        self.positions = np.asarray(positions, float)
        self.normals = None if normals is None else np.asarray(normals, float)
        self.colors = None if colors is None else np.asarray(colors, float)
        self.material = material


def fan(corners):
    """A convex polygon's triangles."""
    return [(corners[0], corners[i], corners[i + 1]) for i in range(1, len(corners) - 1)]


def read_obj(path):
    vertices, colors, normals, faces, material = [], [], [], {}, ""
    for line in path.read_text("latin-1").splitlines():
        word, *rest = line.split() or [""]
        if word == "v":
            vertices.append([float(x) for x in rest[:3]])
            colors.append([float(x) for x in rest[3:6]])
        elif word == "vn":
            normals.append([float(x) for x in rest])
        elif word == "usemtl":
            material = " ".join(rest)
        elif word == "f":
            corners = [[int(x) if x else 0 for x in corner.split("/")] for corner in rest]
            faces.setdefault(material, []).extend(fan(corners))
    for name, triangles in faces.items():
        def at(values, which):
            return [[values[corner[which] - 1] for corner in triangle] for triangle in triangles]
        yield Part(at(vertices, 0), at(normals, 2) if normals else None, at(colors, 0) if all(colors) else None, name)


def read_mtl(path):
    """Each material's statements: numbers by the first word of their line."""
    materials, current = {}, {}
    for line in path.read_text("latin-1").splitlines():
        word, *rest = line.split() or [""]
        if word == "newmtl":
            current = materials.setdefault(" ".join(rest), {})
        elif word in ("Ka", "Kd", "Ks", "Ns"):
            current[word] = [float(x) for x in rest]
    return materials


def read_ply(path):
    header, _, body = path.read_text().partition("end_header\n")
    count = {line.split()[1]: int(line.split()[2]) for line in header.splitlines() if line.startswith("element ")}
    names = [line.split()[2] for line in header.splitlines() if line.startswith("property ") and "list" not in line]
    lines = body.splitlines()
    vertices = np.array([[float(x) for x in line.split()] for line in lines[:count["vertex"]]])
    faces = [[int(x) for x in line.split()[1:]] for line in lines[count["vertex"]:count["vertex"] + count["face"]]]
    indices = np.array([triangle for face in faces for triangle in fan(face)])

    def of(*wanted):
        return vertices[:, [names.index(name) for name in wanted]][indices] if wanted[0] in names else None
    yield Part(of("x", "y", "z"), of("nx", "ny", "nz"), of("red", "green", "blue"))


def read_stl(path):
    data = path.read_bytes()
    facets = np.frombuffer(data[84:], np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attributes", "<u2")]),
                           struct.unpack("<I", data[80:84])[0])
    x, y, z = np.moveaxis(facets["corners"], -1, 0)
    yield Part(np.stack([x, z, -y], axis=-1))  # z is up in the file, y in the scene


def node_matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"]).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    matrix = np.eye(4)
    matrix[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    matrix[:3, :3] *= node.get("scale", (1, 1, 1))
    matrix[:3, 3] = node.get("translation", (0, 0, 0))
    return matrix


def read_gltf(path):
    data = path.read_bytes()
    if data[:4] == b"glTF":
        length = struct.unpack("<I", data[12:16])[0]
        gltf, buffer = json.loads(data[20:20 + length]), data[28 + length:]
    else:
        gltf = json.loads(data)
        buffer = (path.parent / gltf["buffers"][0]["uri"]).read_bytes()

    def accessed(index):
        accessor = gltf["accessors"][index]
        view = gltf["bufferViews"][accessor["bufferView"]]
        kind = np.dtype({5121: "<u1", 5123: "<u2", 5125: "<u4", 5126: "<f4"}[accessor["componentType"]])
        components = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        stride = view.get("byteStride", components * kind.itemsize)
        return np.ndarray((accessor["count"], components), kind, buffer, start, (stride, kind.itemsize))

    def visit(index, above):
        node = gltf["nodes"][index]
        matrix = above @ node_matrix(node)
        for primitive in gltf["meshes"][node["mesh"]]["primitives"] if "mesh" in node else ():
            indices = accessed(primitive["indices"]).reshape(-1, 3)
            positions = accessed(primitive["attributes"]["POSITION"]) @ matrix[:3, :3].T + matrix[:3, 3]
            normals = accessed(primitive["attributes"]["NORMAL"]) @ np.linalg.inv(matrix[:3, :3])
            yield Part(positions[indices], normals[indices], None, primitive["material"])
        for child in node.get("children", ()):
            yield from visit(child, matrix)
    for root in gltf["scenes"][gltf["scene"]]["nodes"]:
        yield from visit(root, np.eye(4))


def base_colors(path):
    """The colour of each material of a glTF file, linear, and its metalness."""
    data = path.read_bytes()
    gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]] if data[:4] == b"glTF" else data)
    settings = [material["pbrMetallicRoughness"] for material in gltf["materials"]]
    return [(setting["baseColorFactor"][:3], setting["metallicFactor"]) for setting in settings]


def read(path):
    path = Path(path)
    return list({".obj": read_obj, ".ply": read_ply, ".stl": read_stl, ".gltf": read_gltf, ".glb": read_gltf}[path.suffix](path))
