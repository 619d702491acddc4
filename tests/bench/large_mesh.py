"""Writes a closed surface of 2 x N x N triangles, a torus with ripples, in the format of the file's extension: .ply and .stl (binary),
.obj or .glb.

    large_mesh.py FILE [N]      N = 2237: 10,008,338 triangles, 190 MB as a PLY file
"""
import array
import json
import math
import struct
import sys
from pathlib import Path


def position_rows(n: int, ripple: float):
    angles = [2 * math.pi * i / n for i in range(n)]
    around = [(math.cos(a), math.sin(a)) for a in angles]
    for j, (c, s) in enumerate(around):
        tube = 0.2 + ripple * math.sin(40 * angles[j])
        ring, height = 0.5 + tube * c, tube * s
        row = array.array("f")
        for cu, su in around:
            row.extend((ring * cu, height, -ring * su))
        yield row.tobytes()


def triangle_rows(n: int):
    """The vertices of the triangles of each row, six for each pair."""
    for j in range(n):
        here, there = j * n, (j + 1) % n * n
        yield [v for i, k in ((i, (i + 1) % n) for i in range(n))
               for v in (here + i, here + k, there + k, here + i, there + k, there + i)]


def write_ply(out, n: int, ripple: float) -> None:
    out.write(("ply\nformat binary_little_endian 1.0\n"
               f"element vertex {n * n}\nproperty float x\nproperty float y\nproperty float z\n"
               f"element face {2 * n * n}\nproperty list uchar int vertex_indices\nend_header\n").encode())
    for row in position_rows(n, ripple):
        out.write(row)
    two = struct.Struct("<BIIIBIII")
    for row in triangle_rows(n):
        out.write(b"".join(two.pack(3, *row[i:i + 3], 3, *row[i + 3:i + 6]) for i in range(0, len(row), 6)))


def write_stl(out, n: int, ripple: float) -> None:
    """Facet normals are zero: readers compute them."""
    points = [row[i:i + 12] for row in position_rows(n, ripple) for i in range(0, len(row), 12)]
    out.write(bytes(80) + struct.pack("<I", 2 * n * n))
    normal, attribute = bytes(12), bytes(2)
    for row in triangle_rows(n):
        out.write(b"".join(normal + points[row[i]] + points[row[i + 1]] + points[row[i + 2]] + attribute for i in range(0, len(row), 3)))


def write_obj(out, n: int, ripple: float) -> None:
    for row in position_rows(n, ripple):
        values = array.array("f", row)
        out.write("".join(f"v {x:.7g} {y:.7g} {z:.7g}\n" for x, y, z in zip(values[::3], values[1::3], values[2::3])).encode())
    for row in triangle_rows(n):
        out.write("".join(f"f {row[i] + 1} {row[i + 1] + 1} {row[i + 2] + 1}\n" for i in range(0, len(row), 3)).encode())


def write_glb(out, n: int, ripple: float) -> None:
    """Without normals, so that each triangle is flat."""
    positions, indices = 12 * n * n, 24 * n * n
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": n * n, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                      {"bufferView": 1, "componentType": 5125, "count": 6 * n * n, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": positions, "target": 34962},
                        {"buffer": 0, "byteOffset": positions, "byteLength": indices, "target": 34963}],
        "buffers": [{"byteLength": positions + indices}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    out.write(b"glTF" + struct.pack("<II", 2, 28 + len(text) + positions + indices) + struct.pack("<I", len(text)) + b"JSON" + text)
    out.write(struct.pack("<I", positions + indices) + b"BIN\0")
    for row in position_rows(n, ripple):
        out.write(row)
    for row in triangle_rows(n):
        out.write(array.array("I", row).tobytes())


WRITERS = {".ply": write_ply, ".stl": write_stl, ".obj": write_obj, ".glb": write_glb}


def write(file, n: int = 2237, ripple: float = 0.01) -> None:
    with open(file, "wb") as out:
        WRITERS[Path(file).suffix](out, n, ripple)


if __name__ == "__main__":
    write(sys.argv[1], *map(int, sys.argv[2:]))
