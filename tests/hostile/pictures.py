"""Mutants of pictures, as environments and as what `candela diff` compares: none may end a program with a signal, keep
it busy for more than ten seconds, or make it print what is not UTF-8 or controls a terminal.

    pictures.py CANDELA [--count N] [--kind png|ppm|pfm|hdr|exr|…] [--seed S] [--keep FOLDER] [--jobs J]

N mutants of each format, made from small pictures that Candela itself draws.
"""
import functools
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import hostile

KINDS = ["png", "ppm", "pfm", "hdr", "exr", "jpg", "tif", "bmp", "tga"]
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
environment = "a.{}"
[shading]
model = "phong"
[reflection]
model = "phong"
[[light]]
type = "ambient"
[[object]]
type = "cube"
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
        sound = drawn(candela, kind)
    (directory / f"a.{kind}").write_bytes(hostile.mutated(chance.choice(sound), list(sound), chance, WORDS))
    if index % 2 == 0:
        (directory / "scene.toml").write_text(SCENE.format(kind))
        done, wrong = hostile.run([candela, "render", "scene.toml", "-o", "out.png"], directory, codes=(0, 1, 3))
        return wrong or ("exit code and picture disagree"
                         if (done.returncode == 0) != (directory / "out.png").exists() else "")
    (directory / f"b.{kind}").write_bytes(sound[0])
    done, wrong = hostile.run([candela, "diff", f"a.{kind}", f"b.{kind}", "-o", "heat.png"], directory, codes=(0, 1))
    return wrong or ("exit code and heat-map disagree"
                     if (done.returncode == 0) != (directory / "heat.png").exists() else "")


if __name__ == "__main__":
    sys.exit(hostile.sweep(__doc__, 60, KINDS, problem_of))
