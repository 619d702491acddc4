"""Writes vase.obj, vase.mtl and glaze.ppm into a folder: a model for the documentation's picture of `candela render model.obj`."""
import math
import pathlib
import sys

folder = pathlib.Path(sys.argv[1])
PROFILE = [(0.0, 0.0), (0.42, 0.0), (0.45, 0.03), (0.66, 0.35), (0.74, 0.62), (0.66, 0.95), (0.4, 1.25), (0.27, 1.42), (0.27, 1.58),
           (0.38, 1.74), (0.36, 1.75), (0.24, 1.58), (0.24, 1.42), (0.0, 1.2)]
AROUND = 96


def smooth(points, steps=8):
    """The Catmull-Rom spline through the points."""
    dense = []
    for i in range(len(points) - 1):
        a, b, c, d = (points[min(max(i + k, 0), len(points) - 1)] for k in (-1, 0, 1, 2))
        for s in range(steps):
            t = s / steps
            dense.append(tuple(0.5 * (2 * b[k] + (c[k] - a[k]) * t + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * t * t
                                      + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * t ** 3) for k in range(2)))
    return [(max(r, 0.0), y) for r, y in dense + [points[-1]]]


profile = smooth(PROFILE)
text = ["mtllib vase.mtl"]
for j, (r, y) in enumerate(profile):
    for i in range(AROUND + 1):
        angle = 2 * math.pi * i / AROUND
        text.append(f"v {r * math.cos(angle):.5f} {y:.5f} {-r * math.sin(angle):.5f}")
        text.append(f"vt {4 * i / AROUND:.5f} {y / 1.75 * 3:.5f}")
text.append("s 1\nusemtl glaze")
for j in range(len(profile) - 1):
    for i in range(AROUND):
        a = j * (AROUND + 1) + i + 1
        corners = [a, a + 1, a + AROUND + 2, a + AROUND + 1]
        text.append("f " + " ".join(f"{k}/{k}" for k in corners))
first = len(profile) * (AROUND + 1)
for x, y, z in ((-1, -0.1, 1), (1, -0.1, 1), (1, -0.1, -1), (-1, -0.1, -1), (-1, -0.001, 1), (1, -0.001, 1), (1, -0.001, -1), (-1, -0.001, -1)):
    text.append(f"v {x} {y} {z}")
text.append("s off\nusemtl slate")
for face in ((4, 3, 2, 1), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8)):
    text.append("f " + " ".join(str(first + k) for k in face))
(folder / "vase.obj").write_text("\n".join(text) + "\n")
(folder / "vase.mtl").write_text("newmtl glaze\nKa 0.3 0.3 0.3\nKd 0.72 0.72 0.72\nKs 0.28 0.28 0.28\nNs 60\nmap_Kd glaze.ppm\n"
                                 "newmtl slate\nKa 0.1 0.1 0.12\nKd 0.16 0.17 0.2\nKs 0.2 0.2 0.2\nNs 20\n")
SIZE = 256
pixels = bytearray()
for y in range(SIZE):
    for x in range(SIZE):
        u, v = x / SIZE, y / SIZE
        wave = 0.5 + 0.18 * math.sin(2 * math.pi * u)
        ring = math.hypot((u - 0.25) * 2, (v - 0.12) * 2.2)
        if abs(v - wave) < 0.05 or ring < 0.11:
            pixels += bytes((38, 70, 128))
        elif abs(v - wave) < 0.08 or 0.14 < ring < 0.17:
            pixels += bytes((198, 120, 60))
        else:
            pixels += bytes((236, 230, 216))
(folder / "glaze.ppm").write_bytes(b"P6\n%d %d\n255\n" % (SIZE, SIZE) + pixels)
