"""Hostile pictures as textures, as environments and as input of `candela diff`: none may end a program with a signal, keep it busy
for more than ten seconds, take more than half a gigabyte, or make it print invalid UTF-8 or terminal control characters.

    pictures.py CANDELA [--count N | --seconds T] [--kind png|ppm|pfm|hdr|exr|…] [--seed S] [--keep FOLDER] [--jobs J]

N of each format: mutants of small pictures that Candela itself draws, and files made up by made_pictures.py.
"""
import functools
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import mutation
import made_pictures

DRAWN = ["png", "ppm", "pfm", "hdr", "exr", "jpg", "tif", "bmp", "tga", "webp"]
KINDS = sorted(made_pictures.MAKERS)
MOST_MEMORY = 512 << 20  # bytes; a texture of four million pixels takes 200 MiB with its levels, OpenImageIO's libraries 130
WORDS = [b"IHDR", b"IDAT", b"IEND", b"PLTE", b"tRNS", b"iCCP", b"tEXt", b"P6", b"P3", b"P5", b"PF", b"Pf", b"#?RADIANCE",
         b"FORMAT=32-bit_rle_rgbe", b"-Y 4 +X 4", b"-Y 65536 +X 65536", b"channels", b"compression", b"dataWindow", b"tiles",
         b"\xff\xd8", b"\xff\xd9", b"\xff\xc0", b"\xff\xda", b"II*\0", b"MM\0*", b"\xff\xff\xff\xff", b"\x7f\xff\xff\xff", b"\0\0\0\0",
         b"\x1b[31m", b"\xc2\x9b", b"\n", b" "]
SCENE = """version = 1
[observer]
position = [0, 0, 4]
look_at = [0, 0, 0]
[image]
width = 8
height = 6
samples = 1
{}
[shading]
model = "phong"
[reflection]
model = "phong"
[[light]]
type = "ambient"
[[object]]
type = "sphere"
{}
"""
ONE_AT_A_TIME = threading.Lock()


@functools.lru_cache(maxsize=None)
def drawn(candela: str, kind: str) -> tuple:
    with tempfile.TemporaryDirectory() as folder:
        result = []
        for width, height in ((16, 8), (5, 3)):
            picture = Path(folder) / f"{width}.{kind}"
            subprocess.run([candela, "render", "--quiet", "--width", str(width), "--height", str(height), "--samples", "1",
                            "-o", str(picture)], check=True, stdin=subprocess.DEVNULL)
            result.append(picture.read_bytes())
        return tuple(result)


def problem_of(candela: str, directory: Path, kind: str, chance, index: int) -> str:
    with ONE_AT_A_TIME:
        sound = drawn(candela, kind if kind in DRAWN else chance.choice(DRAWN))
    (directory / f"a.{kind}").write_bytes(made_pictures.made(kind, chance) if index % 2 or kind not in DRAWN else
                                          mutation.mutated(chance.choice(sound), list(sound), chance, WORDS))
    if index % 5 < 4:
        used = (f'environment = "a.{kind}"', "") if index % 5 == 0 else ("", f'color = {{ texture = "a.{kind}" }}')
        (directory / "scene.toml").write_text(SCENE.format(*used))
        done, wrong = mutation.run([candela, "render", "scene.toml", "-o", "out.png", "--threads", "2"], directory, codes=(0, 1, 3),
                                  most_memory=MOST_MEMORY)
        return wrong or ("exit code and picture disagree"
                         if (done.returncode == 0) != (directory / "out.png").exists() else "")
    (directory / "b.png").write_bytes(sound[0])
    done, wrong = mutation.run([candela, "diff", f"a.{kind}", "b.png", "-o", "heat.png"], directory, codes=(0, 1))
    return wrong or ("exit code and heat-map disagree"
                     if (done.returncode == 0) != (directory / "heat.png").exists() else "")


if __name__ == "__main__":
    sys.exit(mutation.sweep(__doc__, 60, KINDS, problem_of))
