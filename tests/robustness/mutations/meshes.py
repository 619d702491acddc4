"""Mutants of mesh files: none may end Candela with a signal, keep it busy for more than ten seconds, or make it print
invalid UTF-8 or terminal control characters.

    meshes.py CANDELA [--count N] [--kind ply|stl|obj|gltf|glb] [--seed S] [--keep FOLDER] [--jobs J]

N mutants of each format, made from the files of tests/robustness/samples, and drawn with the shadows that they cast.
"""
import sys
from pathlib import Path

import mutation

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "samples"))
import files  # noqa: E402

SCENE = """version = 1
[observer]
position = [0, 0, 4]
look_at = [0, 0, 0]
[shading]
model = "phong"
[reflection]
model = "ward"
[room]
width = 1e6
height = 1e6
depth = 1e6
[image]
width = 32
height = 24
[shadows]
enabled = true
[[light]]
type = "ambient"
ambient_occlusion_rays = 4
[[light]]
type = "directional"
direction = [-1, -2, -3]
[[object]]
type = "mesh"
file = "{}"
"""

WORDS = [b"vertex", b"face", b"tristrips", b"property list char double x", b"end_header", b"format ascii 1.0",
         b"format binary_big_endian 1.0", b"element face 1000000000", b"facet normal", b"endloop", b"solid", b"endsolid",
         b"f", b"v", b"vn", b"vt", b"s 1", b"s off", b"mtllib /dev/zero", b"\\", b"#", b"/", b"//", b"{", b"}", b"[", b"]",
         b'"count":', b'"byteOffset":', b'"sparse":', b'"uri":"/dev/zero"', b'"bufferView":', b"\xff\xfe", b"\xc3",
         b"\x1b[31m", b"\xe2\x80\xae", b"\xc2\x9b", b"\0", b"\r", b"\n", b"\r\n"]


def seeds_by_format() -> dict:
    seeds = {}
    for case in files.cases():
        name, content = next(iter(case.files.items()))
        if len(content) < 20_000:
            seeds.setdefault(Path(name).suffix[1:], []).append(content)
    return seeds


SEEDS = seeds_by_format()


def problem_of(candela: str, directory: Path, form: str, chance, _index: int) -> str:
    name = f"a.{form}"
    (directory / name).write_bytes(mutation.mutated(chance.choice(SEEDS[form]), SEEDS[form], chance, WORDS))
    (directory / "scene.toml").write_text(SCENE.format(name))
    return mutation.run([candela, "render", "scene.toml", "-o", "a.ppm"], directory, codes=(0, 1, 3))[1]


if __name__ == "__main__":
    sys.exit(mutation.sweep(__doc__, 200, sorted(SEEDS), problem_of))
