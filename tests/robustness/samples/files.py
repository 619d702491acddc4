"""Small mesh files of the kinds that programs write, each with the expected result.

Every case is one file (and its companions) with the number of triangles that it describes, whether they are closed,
and the words that the warning about contents left out must contain. A case whose `like` is "cube" must look like the cube
from which it was written by hand here: eight corners, six faces, an edge of one metre, flat.
"""
import base64
import json
import math
import struct
from dataclasses import dataclass, field


@dataclass
class Case:
    name: str
    files: dict  # name -> bytes; the first is the mesh
    triangles: int = 12
    closed: bool = True
    like: str = "cube"
    color: tuple = (200, 200, 200)  # of what it looks like
    says: tuple = ()  # parts of the warnings
    silent: bool = False  # no warning at all
    error: str = ""  # a part of the message, where the file must be refused
    options: str = ""  # further lines of the object


CORNERS = [(x, y, z) for z in (-0.5, 0.5) for y in (-0.5, 0.5) for x in (-0.5, 0.5)]
# Counter-clockwise from outside.
FACES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
NORMALS = [(0, 0, -1), (0, 0, 1), (0, -1, 0), (0, 1, 0), (-1, 0, 0), (1, 0, 0)]
TRIANGLES = [t for f in FACES for t in ((f[0], f[1], f[2]), (f[0], f[2], f[3]))]


def lines(*parts) -> bytes:
    return ("\n".join(parts) + "\n").encode()


# ---- PLY

KINDS = {"char": "b", "uchar": "B", "short": "h", "ushort": "H", "int": "i", "uint": "I", "float": "f", "double": "d"}


def ply(elements, form="ascii", end="\n", extra=("comment made by hand", "obj_info none")) -> bytes:
    """`elements`: (name, [(property, type) or (property, length type, type)], rows)."""
    header = ["ply", f"format {form} 1.0", *extra]
    for name, properties, rows in elements:
        header.append(f"element {name} {len(rows)}")
        for p in properties:
            header.append(f"property {p[1]} {p[0]}" if len(p) == 2 else f"property list {p[1]} {p[2]} {p[0]}")
    data = end.join([*header, "end_header", ""]).encode()
    order = ">" if "big" in form else "<"
    for _, properties, rows in elements:
        for row in rows:
            if form == "ascii":
                words = []
                for p, value in zip(properties, row):
                    words += [value] if len(p) == 2 else [len(value), *value]
                data += (" ".join(f"{w:g}" for w in words) + end).encode()
                continue
            for p, value in zip(properties, row):
                if len(p) == 2:
                    data += struct.pack(order + KINDS[p[1]], value)
                else:
                    data += struct.pack(order + KINDS[p[1]], len(value))
                    data += struct.pack(order + str(len(value)) + KINDS[p[2]], *value)
    return data


XYZ = [(c, "float") for c in "xyz"]


def ply_cube(form="ascii", length="uchar", index="int", faces=FACES, coordinate="float", **more) -> bytes:
    return ply([("vertex", [(c, coordinate) for c in "xyz"], CORNERS),
                ("face", [("vertex_indices", length, index)], [(f,) for f in faces])], form, **more)


def ply_cases():
    for form in ("ascii", "binary_little_endian", "binary_big_endian"):
        short = form.replace("binary_", "")
        yield Case(f"ply-{short}-quads", {"a.ply": ply_cube(form)}, silent=True)
        yield Case(f"ply-{short}-triangles", {"a.ply": ply_cube(form, faces=TRIANGLES)}, silent=True)
        yield Case(f"ply-{short}-doubles", {"a.ply": ply_cube(form, coordinate="double")}, silent=True)
        for kind in ("char", "uchar", "short", "ushort", "int", "uint"):
            yield Case(f"ply-{short}-list-{kind}", {"a.ply": ply_cube(form, kind, kind, TRIANGLES)}, silent=True)
        # The same corners once for each face, with its normal and texture coordinates, and a colour.
        own = [(*CORNERS[c], *n, u, v, 255, 0, 255) for f, n in zip(FACES, NORMALS)
               for c, (u, v) in zip(f, ((0, 0), (1, 0), (1, 1), (0, 1)))]
        for names in (("s", "t"), ("u", "v"), ("texture_u", "texture_v")):
            properties = XYZ + [("nx", "float"), ("ny", "float"), ("nz", "float"), (names[0], "float"),
                                (names[1], "float"), ("red", "uchar"), ("green", "uchar"), ("blue", "uchar")]
            faces = [(tuple(range(4 * i, 4 * i + 4)), 7) for i in range(6)]
            yield Case(f"ply-{short}-all-{names[0]}",
                       {"a.ply": ply([("vertex", properties, own),
                                      ("face", [("vertex_index", "uchar", "uint"), ("quality", "int")], faces)], form)},
                       color=(200, 0, 200), says=("the face property 'quality'",))
        for kind, most in (("uchar", 255), ("ushort", 65535), ("float", 1), ("double", 1)):
            for names in (("red", "green", "blue"), ("diffuse_red", "diffuse_green", "diffuse_blue"), ("r", "g", "b")):
                yield Case(f"ply-{short}-{names[0]}-{kind}",
                           {"a.ply": ply([("vertex", XYZ + [(n, kind) for n in names],
                                           [(*c, 0, most, most) for c in CORNERS]),
                                          ("face", [("vertex_indices", "uchar", "int")], [(f,) for f in FACES])], form)},
                           color=(0, 200, 200), silent=True)
        for alpha, says in ((255, ()), (9, ("the opacity of vertices",))):
            yield Case(f"ply-{short}-alpha-{alpha}",
                       {"a.ply": ply([("vertex", XYZ + [(n, "uchar") for n in ("red", "green", "blue", "alpha")],
                                       [(*c, 255, 255, 255, alpha) for c in CORNERS]),
                                      ("face", [("vertex_indices", "uchar", "int")], [(f,) for f in FACES])], form)},
                       says=says, silent=not says)
        strip = [4, 5, 6, 7, 2, 3, 0, 1, 4, 5, -1, 0, 4, 2, 6, -1, 1, 3, 5, 7]
        yield Case(f"ply-{short}-tristrips",
                   {"a.ply": ply([("vertex", XYZ, CORNERS), ("tristrips", [("vertex_indices", "int", "int")],
                                                             [(strip,)])], form)}, silent=True)
        yield Case(f"ply-{short}-other-elements",
                   {"a.ply": ply([("camera", [("view", "float"), ("lens", "uchar", "float")], [(1, (1, 2)), (2, ())]),
                                  ("vertex", XYZ + [("weights", "uchar", "float")],
                                   [(*c, (0.5,) * (i % 3)) for i, c in enumerate(CORNERS)]),
                                  ("face", [("vertex_indices", "uchar", "int"), ("texcoord", "uchar", "float")],
                                   [(f, (0, 1) * 4) for f in FACES]),
                                  ("edge", [("vertex1", "int"), ("vertex2", "int")], [(0, 1), (1, 3)])], form)},
                   says=("2 elements 'camera'", "'weights'", "2 elements 'edge'"))
    for name, end in (("crlf", "\r\n"), ("cr", "\r")):
        for form in ("ascii", "binary_little_endian"):
            yield Case(f"ply-{name}-{form[:6]}", {"a.ply": ply_cube(form, end=end)}, silent=True)
    blanks = ply_cube("binary_little_endian").replace(b"end_header\n", b"end_header \t\n").replace(b"ply\n", b"ply \n")
    yield Case("ply-blanks", {"a.ply": blanks.replace(b"obj_info none\n", b"\ncomment\n")}, silent=True)
    # Values need not keep to lines.
    head, _, body = ply_cube().partition(b"end_header\n")
    yield Case("ply-line-feeds", {"a.ply": head + b"end_header\n\n" + body.replace(b" ", b"  \n")}, silent=True)
    yield Case("ply-point-cloud", {"a.ply": ply([("vertex", XYZ, CORNERS)])}, error="Candela draws surfaces, and points alone have none")
    huge = b"ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\n" \
        b"property float x\nproperty float y\nproperty float z\nelement face 1\n" \
        b"property list uchar int vertex_indices\nend_header\n"
    yield Case("ply-declares-much", {"a.ply": huge + b"\0" * 12}, error="declares 1000000000 elements 'vertex'")
    yield Case("ply-cut", {"a.ply": ply_cube("binary_big_endian")[:-9]}, error="ends within its")
    turned = [tuple(reversed(f)) for f in FACES]
    yield Case("ply-inside-out", {"a.ply": ply_cube(faces=turned)}, says=("wound inside out",))
    yield Case("ply-inside-out-with-normals",
               {"a.ply": ply([("vertex", XYZ + [("nx", "float"), ("ny", "float"), ("nz", "float")],
                               [(*CORNERS[c], *(-x for x in n)) for f, n in zip(turned, NORMALS) for c in f]),
                              ("face", [("vertex_indices", "uchar", "int")],
                               [(tuple(range(4 * i, 4 * i + 4)),) for i in range(6)])])}, says=("wound inside out",))


# ---- STL

def stl_ascii(triangles=TRIANGLES, normals=True, end="\n", upper=False) -> bytes:
    text = ["solid cube made by hand"]
    for i, t in enumerate(triangles):
        n = NORMALS[i // 2] if normals else (0, 0, 0)
        text.append("  facet normal {:e} {:e} {:e}".format(*n))
        text.append("    outer loop")
        text += ["      vertex {:e} {:e} {:e}".format(*CORNERS[c]) for c in t]
        text += ["    endloop", "  endfacet"]
    text.append("endsolid cube")
    joined = end.join([*text, ""])
    return (joined.upper() if upper else joined).encode()


def stl_binary(header=b"made by hand", triangles=TRIANGLES, normals=True, attribute=0) -> bytes:
    data = header.ljust(80, b"\0") + struct.pack("<I", len(triangles))
    for i, t in enumerate(triangles):
        n = NORMALS[i // 2] if normals else (0, 0, 0)
        data += struct.pack("<12fH", *n, *(x for c in t for x in CORNERS[c]), attribute)
    return data


def stl_cases():
    yield Case("stl-ascii", {"a.stl": stl_ascii()}, silent=True)
    yield Case("stl-ascii-crlf", {"a.stl": stl_ascii(end="\r\n")}, silent=True)
    yield Case("stl-ascii-upper-case", {"a.stl": stl_ascii(upper=True)}, silent=True)
    yield Case("stl-ascii-without-normals", {"a.stl": stl_ascii(normals=False)}, silent=True)
    halves = stl_ascii(TRIANGLES[:6]) + stl_ascii().replace(stl_ascii(TRIANGLES[:6])[:-len(b"endsolid cube\n")], b"solid two\n")
    yield Case("stl-ascii-two-solids", {"a.stl": halves}, silent=True)
    yield Case("stl-binary", {"a.stl": stl_binary()}, silent=True)
    yield Case("stl-binary-without-normals", {"a.stl": stl_binary(normals=False)}, silent=True)
    yield Case("stl-binary-begins-with-solid", {"a.stl": stl_binary(b"solid but binary")}, silent=True)
    yield Case("stl-binary-colours", {"a.stl": stl_binary(attribute=0x801F)}, says=("attributes of facets",))
    yield Case("stl-binary-longer", {"a.stl": stl_binary() + b"tail"}, says=("4 bytes after the last facet",))
    yield Case("stl-binary-cut", {"a.stl": stl_binary()[:-1]}, error="declares 12 facets")
    yield Case("stl-inside-out", {"a.stl": stl_binary(triangles=[(a, c, b) for a, b, c in TRIANGLES])},
               says=("wound inside out",))


# ---- OBJ

V = [f"v {x:g} {y:g} {z:g}" for x, y, z in CORNERS]
F = ["f " + " ".join(str(c + 1) for c in f) for f in FACES]


def obj_cases():
    yield Case("obj-quads", {"a.obj": lines("# by hand", "o cube", *V, "g sides", *F)}, silent=True)
    yield Case("obj-crlf", {"a.obj": lines(*V, *F).replace(b"\n", b"\r\n")}, silent=True)
    yield Case("obj-without-last-newline", {"a.obj": lines(*V, *F)[:-1]}, silent=True)
    short = [f"v {x:+.1f} {y:.1f} {z:.1f}".replace("0.5", ".5").replace(".5", "5.e-1", 1) for x, y, z in CORNERS]
    yield Case("obj-short-numbers", {"a.obj": lines(*short, *F)}, silent=True)
    yield Case("obj-point-five", {"a.obj": lines(*(v.replace("0.5", ".05e1") for v in V), *F)}, silent=True)
    yield Case("obj-w", {"a.obj": lines(*(v + " 1" for v in V), *F)}, silent=True)
    yield Case("obj-w-not-one", {"a.obj": lines(*(v + " 2" for v in V), *F)}, says=("weights of vertices",))
    yield Case("obj-colours", {"a.obj": lines(*(v + " 1 0 1" for v in V), *F)}, color=(200, 0, 200), silent=True)
    yield Case("obj-w-and-colours", {"a.obj": lines(*(v + " 1 1 0 1" for v in V), *F)}, color=(200, 0, 200), silent=True)
    yield Case("obj-colours-unused", {"a.obj": lines(*(v + " 1 0 1" for v in V), *F)}, silent=True,
               options="vertex_colors = false")
    yield Case("obj-colours-of-some", {"a.obj": lines(*V[:5], *(v + " 1 1 1" for v in V[5:]), *F)}, silent=True)
    yield Case("obj-colours-too-large", {"a.obj": lines(*(v + " 2 0 1e9" for v in V), *F)}, color=(200, 0, 200),
               says=("vertex colours outside 0 to 1",))
    back = ["f " + " ".join(str(c - 8) for c in f) for f in FACES]
    yield Case("obj-negative-indices", {"a.obj": lines(*V, *back)}, silent=True)
    yield Case("obj-continued-lines", {"a.obj": lines(*V, *(f[:4] + " \\\n" + f[4:] if f[3] == " " else f for f in F))},
               silent=True)
    yield Case("obj-faces-first", {"a.obj": lines(*F, *V)}, silent=True)
    vn = [f"vn {x} {y} {z}" for x, y, z in NORMALS]
    yield Case("obj-normals", {"a.obj": lines(*V, *vn, *("f " + " ".join(f"{c + 1}//{i + 1}" for c in f)
                                                         for i, f in enumerate(FACES)))}, silent=True)
    vt = ["vt 0 0", "vt 1 0", "vt 1 1 0", "vt 0 1"]
    yield Case("obj-all", {"a.obj": lines(*V, *vt, *vn, *("f " + " ".join(f"{c + 1}/{k + 1}/{i + 1}"
                                                                         for k, c in enumerate(f))
                                                          for i, f in enumerate(FACES)))}, silent=True)
    yield Case("obj-smoothing-off", {"a.obj": lines(*V, "s off", *F)}, silent=True, options="crease_angle = 180")
    groups = [part for i, f in enumerate(F) for part in (f"s {i + 1}", f)]
    yield Case("obj-smoothing-groups", {"a.obj": lines(*V, *groups)}, silent=True, options="crease_angle = 180")
    yield Case("obj-broken-mtl", {"a.obj": lines("mtllib a.mtl", *V, "usemtl red", *F), "a.mtl": b"newmtl\nKd red\n\0\xff"},
               says=("a material library", "a use of a material"))
    yield Case("obj-missing-mtl", {"a.obj": lines("mtllib nowhere.mtl", *V, *F)}, says=("a material library",))
    yield Case("obj-points-and-lines", {"a.obj": lines(*V, "p 1 2", "l 1 2", "l 3 4", *F)}, says=("points", "2 lines"))
    # Two sides with a notch: concave from above.
    u = [(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)]
    yield Case("obj-concave", {"a.obj": lines(*(f"v {x} {y} 0" for x, y in u), "f 1 2 3 4 5 6 7 8")}, 6, False, like="",
               says=("not closed",))
    n = 300
    ring = [f"v {math.cos(2 * math.pi * i / n):.7f} {math.sin(2 * math.pi * i / n):.7f} 0" for i in range(n)]
    yield Case("obj-300-corners", {"a.obj": lines(*ring, "f " + " ".join(str(i + 1) for i in range(n)))}, n - 2, False,
               like="")
    yield Case("obj-index-0", {"a.obj": lines(*V, "f 0 1 2")}, error="line 9: '0' is not a valid index")
    yield Case("obj-index-9", {"a.obj": lines(*V, *F, "f 1 2 9")}, error="line 15: vertex 9 of a face is out of range")
    yield Case("obj-index-huge", {"a.obj": lines(*V, "f 1 2 99999999999999999999")}, error="line 9")
    yield Case("obj-index-minus-9", {"a.obj": lines(*V, "f 1 2 -9")}, error="line 9: '-9' is out of range")


# ---- glTF

FLOAT, UBYTE, USHORT, UINT, SHORT, BYTE = 5126, 5121, 5123, 5125, 5122, 5120


class Gltf:
    """Puts accessors into one buffer."""

    def __init__(self):
        self.data = b""
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                     "meshes": [], "accessors": [], "bufferViews": [], "buffers": []}

    def view(self, data: bytes, **more) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **more})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, kind: int, rows, view=None, **more) -> int:
        letter = {FLOAT: "f", UBYTE: "B", USHORT: "H", UINT: "I", SHORT: "h", BYTE: "b"}[kind]
        flat = [r if isinstance(r, tuple) else (r,) for r in rows]
        if view is None:
            view = self.view(b"".join(struct.pack(f"<{len(r)}{letter}", *r) for r in flat))
        self.json["accessors"].append({"bufferView": view, "componentType": kind, "count": len(flat),
                                       "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}[len(flat[0])], **more})
        return len(self.json["accessors"]) - 1

    def mesh(self, **primitive) -> int:
        self.json["meshes"].append({"primitives": [primitive]})
        return len(self.json["meshes"]) - 1

    def text(self, uri=None) -> bytes:
        uri = uri or "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.json["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        return json.dumps(self.json).encode()

    def binary(self, pad=True, count_padding=True) -> bytes:
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json).encode()
        text += b" " * ((1 - len(text)) % 4)  # never a multiple of four by chance
        padded = text + b" " * (-len(text) % 4) if pad else text
        data = self.data + b"\0" * (-len(self.data) % 4)
        chunk = struct.pack("<II", len(padded) if count_padding else len(text), 0x4E4F534A) + padded
        rest = struct.pack("<II", len(data), 0x004E4942) + data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunk) + len(rest)) + chunk + rest


def gltf_cube(index=USHORT, mode=None, **more) -> Gltf:
    g = Gltf()
    position = g.accessor(FLOAT, CORNERS)
    indices = g.accessor(index, [c for t in TRIANGLES for c in t])
    g.mesh(attributes={"POSITION": position}, indices=indices, **more)
    return g


def gltf_cases():
    yield Case("gltf-data-uri", {"a.gltf": gltf_cube().text()}, silent=True)
    g = gltf_cube()
    yield Case("gltf-external-buffer", {"a.gltf": g.text("a%20b.bin"), "a b.bin": g.data}, silent=True)
    yield Case("gltf-buffer-elsewhere", {"a.gltf": gltf_cube().text("../a.bin")}, error="outside its own folder")
    yield Case("gltf-buffer-absolute", {"a.gltf": gltf_cube().text("/etc/hostname")}, error="outside its own folder")
    yield Case("gltf-buffer-missing", {"a.gltf": gltf_cube().text("no.bin")}, error="names 'no.bin'")
    yield Case("glb", {"a.glb": gltf_cube().binary()}, silent=True)
    yield Case("glb-unpadded-json", {"a.glb": gltf_cube().binary(pad=False, count_padding=False)}, silent=True)
    yield Case("glb-uncounted-padding", {"a.glb": gltf_cube().binary(count_padding=False)}, silent=True)
    for name, kind in (("ubyte", UBYTE), ("uint", UINT)):
        yield Case(f"glb-indices-{name}", {"a.glb": gltf_cube(kind).binary()}, silent=True)

    # A parent that moves, a child that turns by 90 degrees about z, a grandchild of half the size, twice as large again.
    g = gltf_cube()
    half = math.sqrt(0.5)
    g.json["nodes"] = [{"translation": [-3, 0, 0], "children": [1]}, {"rotation": [0, 0, half, half], "children": [2]},
                       {"scale": [0.5, 0.5, 0.5], "children": [3]},
                       {"mesh": 0, "matrix": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, -3, 0, 1]}]
    # The last one's -3 along y is halved and turned to +1.5 along x.
    g.json["nodes"][0]["translation"] = [-1.5, 0, 0]
    yield Case("glb-nodes", {"a.glb": g.binary()}, silent=True)
    g = gltf_cube()
    g.json["nodes"] = [{"mesh": 0, "scale": [-1, 1, 1]}]
    yield Case("glb-mirrored", {"a.glb": g.binary()}, silent=True)
    g = gltf_cube()
    g.json["nodes"] = [{"mesh": 0, "children": [0]}]
    yield Case("glb-node-in-itself", {"a.glb": g.binary()}, error="has a node 0 that has two parents or contains itself")

    # Sparse: two corners are at the origin until they are replaced.
    g = Gltf()
    changed = [c if i not in (2, 7) else (0, 0, 0) for i, c in enumerate(CORNERS)]
    position = g.accessor(FLOAT, changed, sparse={
        "count": 2, "indices": {"bufferView": g.view(struct.pack("<2H", 2, 7)), "componentType": USHORT},
        "values": {"bufferView": g.view(struct.pack("<6f", *CORNERS[2], *CORNERS[7]))}})
    g.json["accessors"][position]["bufferView"] = 2
    g.mesh(attributes={"POSITION": position}, indices=g.accessor(USHORT, [c for t in TRIANGLES for c in t]))
    yield Case("glb-sparse", {"a.glb": g.binary()}, silent=True)

    # Interleaved, and normalized bytes for normals.
    g = Gltf()
    rows = [(CORNERS[c], n) for f, n in zip(FACES, NORMALS) for c in f]
    view = g.view(b"".join(struct.pack("<3f3bx", *p, *(127 * x for x in n)) for p, n in rows), byteStride=16)
    position = g.accessor(FLOAT, [p for p, _ in rows], view)
    normal = g.accessor(BYTE, [n for _, n in rows], view, byteOffset=12, normalized=True)
    corners = [4 * i + k for i in range(6) for k in (0, 1, 2, 0, 2, 3)]
    g.mesh(attributes={"POSITION": position, "NORMAL": normal}, indices=g.accessor(USHORT, corners))
    yield Case("glb-interleaved", {"a.glb": g.binary()}, silent=True)

    # Quantized positions: corners at -1 and 1, of half size.
    g = Gltf()
    position = g.accessor(SHORT, [tuple(int(2 * x) * 32767 for x in c) for c in CORNERS], normalized=True)
    g.mesh(attributes={"POSITION": position}, indices=g.accessor(USHORT, [c for t in TRIANGLES for c in t]))
    g.json["nodes"] = [{"mesh": 0, "scale": [0.5, 0.5, 0.5]}]
    g.json["extensionsRequired"] = g.json["extensionsUsed"] = ["KHR_mesh_quantization"]
    yield Case("glb-quantized", {"a.glb": g.binary()}, silent=True)

    # One strip around four sides, and two fans for the others.
    g = Gltf()
    position = g.accessor(FLOAT, CORNERS)
    parts = ((5, [4, 5, 6, 7, 2, 3, 0, 1, 4, 5]), (6, [0, 4, 6, 2]), (6, [1, 3, 7, 5]))
    g.json["meshes"] = [{"primitives": [{"attributes": {"POSITION": position}, "mode": mode,
                                         "indices": g.accessor(USHORT, corners)} for mode, corners in parts]}]
    yield Case("glb-strips-and-fans", {"a.glb": g.binary()}, silent=True)
    g = Gltf()
    g.mesh(attributes={"POSITION": g.accessor(FLOAT, [CORNERS[c] for t in TRIANGLES for c in t])})
    yield Case("glb-without-indices", {"a.glb": g.binary()}, silent=True)

    # Colours, with opacity and without.
    for name, kind, colors in (("vec3", FLOAT, [(1, 0, 1)] * 8), ("bytes", UBYTE, [(255, 0, 255, 255)] * 8),
                               ("opacity", UBYTE, [(255, 0, 255, 128)] * 8)):
        g = Gltf()
        position = g.accessor(FLOAT, CORNERS)
        g.mesh(attributes={"POSITION": position, "COLOR_0": g.accessor(kind, colors, normalized=kind != FLOAT)},
               indices=g.accessor(USHORT, [c for t in TRIANGLES for c in t]))
        says = ("the opacity of vertices",) if name == "opacity" else ()
        yield Case(f"glb-colours-{name}", {"a.glb": g.binary()}, color=(200, 0, 200), says=says, silent=not says)

    # Everything that is left out.
    g = gltf_cube(targets=[{"POSITION": 0}])
    g.json |= {"materials": [{}, {}], "textures": [{"source": 0}], "images": [{"uri": "no.png"}],
               "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}],
               "animations": [{"channels": [], "samplers": []}], "skins": [{"joints": [0]}],
               "extensionsUsed": ["KHR_lights_punctual", "EXT_of_ours"],
               "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}},
               "extras": {"deep": {"deeper": [1, 2]}}}
    g.json["nodes"] = [{"mesh": 0, "skin": 0, "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}]
    g.json["scenes"].append({"nodes": [0]})
    g.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_1"] = 0
    g.json["meshes"][0]["primitives"] += [{"attributes": {"POSITION": 0}, "mode": 0},
                                          {"attributes": {"POSITION": 0}, "mode": 1}]
    yield Case("gltf-everything", {"a.gltf": g.text()},
               says=("2 materials", "1 texture", "1 image", "1 camera", "1 animation", "1 light",
                     "1 set of points", "1 set of lines", "further vertex colours", "1 other scene",
                     "the extension 'EXT_of_ours'"))

    for name in ("EXT_of_ours",):
        g = gltf_cube()
        g.json["extensionsRequired"] = g.json["extensionsUsed"] = [name]
        yield Case(f"glb-needs-{name.lower()}", {"a.glb": g.binary()}, error=f"needs the glTF extension '{name}'")
    # Not required, but nothing can be read without it.
    g = gltf_cube(extensions={"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}})
    for accessor in g.json["accessors"]:
        del accessor["bufferView"]
    yield Case("glb-draco-only", {"a.glb": g.binary()}, error="whose bytes are not a mesh compressed by Draco")
    g = gltf_cube()
    text = json.loads(g.text())
    for view in text["bufferViews"]:
        view["extensions"] = {"EXT_meshopt_compression": {"buffer": 0, "byteLength": 1, "count": 1, "byteStride": 1}}
        view["buffer"] = 1
    text["buffers"].append({"byteLength": len(g.data), "extensions": {"EXT_meshopt_compression": {"fallback": True}}})
    yield Case("gltf-meshopt-fallback", {"a.gltf": json.dumps(text).encode()}, error="compressed by meshoptimizer in a mode")

    g = gltf_cube()
    del g.json["accessors"][0]["bufferView"]
    g.json["accessors"][0]["count"] = 350_000_000
    yield Case("glb-declares-much", {"a.glb": g.binary()}, error="declares 350000000 elements")
    yield Case("glb-cut", {"a.glb": gltf_cube().binary()[:-1]}, error="is cut off")
    yield Case("gltf-nested", {"a.gltf": b'{"asset":{"version":"2.0"},"extras":' + b"[" * 100000}, error="nested more than")
    g = gltf_cube()
    g.json["asset"]["version"] = "1.0"
    yield Case("gltf-version-1", {"a.gltf": g.text()}, error="is glTF '1.0'")


def cases():
    for family in (ply_cases, stl_cases, obj_cases, gltf_cases):
        yield from family()
