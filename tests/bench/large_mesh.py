"""Writes a closed surface of 2 x N x N triangles, a torus with ripples, as a binary PLY file.

    large_mesh.py FILE [N]      N = 2237: 10,008,338 triangles, 190 MB
"""
import array
import math
import struct
import sys


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


def face_rows(n: int):
    two = struct.Struct("<BIIIBIII")
    for j in range(n):
        here, there = j * n, (j + 1) % n * n
        yield b"".join(
            two.pack(3, here + i, here + k, there + k, 3, here + i, there + k, there + i)
            for i, k in ((i, (i + 1) % n) for i in range(n))
        )


def write(file, n: int = 2237, ripple: float = 0.01) -> None:
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {n * n}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {2 * n * n}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    with open(file, "wb") as out:
        out.write(header.encode())
        for part in (*position_rows(n, ripple), *face_rows(n)):
            out.write(part)


if __name__ == "__main__":
    write(sys.argv[1], *map(int, sys.argv[2:]))
