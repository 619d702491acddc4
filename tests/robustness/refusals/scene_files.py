"""Broken, huge and misleading files under every key of a scene that names one."""
import struct
import sys
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "assets"))
import pictures  # noqa: E402
from pictures import PNG_BEGIN, chunk, png_header  # noqa: E402

BOMB = "bomb.png"  # 900 million pixels in 100 kB
EVERYWHERE = (BOMB, "cut.png", "huge.png", "cut.jpg", "not-a-number.pfm")  # under every key, not only under color


def broken_pictures():
    """(file name, content, part of the message)."""
    sound = pictures.colorful().file
    jpeg = pictures.photograph().file
    data, end = chunk(b"IDAT", zlib.compress(bytes(8 * 25))), chunk(b"IEND", b"")
    yield "empty.png", b"", "cannot be read as a picture"
    yield "text.png", b"brown\n", "cannot be read as a picture"
    yield "cut.png", sound[:len(sound) // 2], "it is cut off"
    yield "checksum.png", sound.replace(b"IDAT", b"IDAT\x01", 1), "cannot be read as a picture"
    yield "none.png", PNG_BEGIN + png_header(0, 8) + data + end, "cannot be read as a picture"
    # A few bytes that declare 900 million pixels.
    yield "huge.png", PNG_BEGIN + png_header(30000, 30000) + data + end, "it is too small for its pixels"
    yield "largest.png", PNG_BEGIN + png_header(2**31 - 1, 2**31 - 1) + data + end, "cannot be read as a picture"
    yield "palette-16.png", PNG_BEGIN + png_header(8, 8, 16, 3) + data + end, "cannot be read as a picture"
    yield "palette-missing.png", PNG_BEGIN + png_header(8, 8, 8, 3) + data + end, "cannot be read as a picture"
    yield "cut.jpg", jpeg[:len(jpeg) // 2], "cannot be read as a picture"
    yield "huge.jpg", jpeg.replace(struct.pack(">HH", 16, 16), struct.pack(">HH", 65500, 65500)), "it is too small for its pixels"
    yield "animated.gif", b"GIF89a\x02\0\x02\0\0\0\0;", "has a format that no image plugin reads"
    yield "moving.avi", b"RIFF\x10\0\0\0AVI LIST", "has a format that no image plugin reads"
    rows = zlib.compressobj(9)
    yield BOMB, (PNG_BEGIN + png_header(30000, 30000, 1, 0) + chunk(b"IDAT", b"".join(rows.compress(bytes(3751 * 1000)) for _ in range(30)) + rows.flush()) +
                 end), "a picture of 30000 x 30000 pixels needs 10.8 GB of memory"
    yield "not-a-number.pfm", b"PF\n1 1\n-1.0\n" + struct.pack("<3f", 0, float("nan"), 0), "a pixel is non-finite"
    yield "infinite.pfm", b"PF\n1 1\n-1.0\n" + struct.pack("<3f", 0, float("-inf"), 0), "a pixel is non-finite"
    yield "huge.pfm", b"PF\n30000 30000\n-1.0\nabc", "it ends before its last pixel"


def broken_photometry():
    """(file name, content, part of the message or None if it is accepted)."""
    sound = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 50 0\n"
    change = lambda old, new: sound.replace(old, new).encode()
    yield "sound.ies", sound.encode(), None
    yield "empty.ies", b"", "the file ends here"
    yield "text.ies", b"lamp\n", "expected a line 'TILT=NONE'"
    yield "binary.ies", bytes(range(256)), "expected a line 'TILT=NONE'"
    yield "cut.ies", sound[:-12].encode(), "cut.ies:5: the file ends here"
    yield "many-angles.ies", change("1 1000 1 3 1", "1 1000 1 2000000000 2000000000"), "expected 1 to 3601"
    yield "minus-angles.ies", change("1 1000 1 3 1", "1 1000 1 -3 1"), "is -3; expected 1 to 3601"
    yield "not-a-number.ies", change("100 50 0", "100 nan 0"), "'nan' is not a number"
    yield "negative.ies", change("100 50 0", "100 -50 0"), "candela value 2 is -50"
    yield "descending.ies", change("0 45 90", "0 90 45"), "expected ascending ones"
    yield "tilted.ies", change("TILT=NONE", "TILT=lamp.txt"), None
    yield "long-line.ies", change("TILT=NONE", "[A] " + "x" * 3_000_000 + "\nTILT=NONE"), None


# Where a scene names a picture: the lines of [image], of a light and of the object, with its material.
PLACES = {
    "environment": ('environment = "{}"', "", ""),
    "light": ("", '[[light]]\ntype = "environment"\npicture = "{}"', ""),
    "color": ("", "", 'color = {{ texture = "{}" }}'),
    "normal_map": ("", "", 'normal_map = {{ texture = "{}" }}'),
    "bump_map": ("", "", 'bump_map = {{ texture = "{}", height = 0.01 }}'),
    "roughness": ("", "", '[object.material]\nroughness = {{ texture = "{}", channel = "g" }}'),
    "opacity": ("", "", '[object.material]\nopacity = {{ texture = "{}", channel = "a" }}'),
    "emission": ("", "", '[object.material]\nemission = {{ texture = "{}" }}'),
    "occlusion": ("", "", '[object.material]\nocclusion = {{ texture = "{}", channel = "r" }}'),
    "ies": ("", '[[light]]\ntype = "ies"\nfile = "{}"\nposition = [0, 2, 0]\ndirection = [0, -1, 0]', ""),
}
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
model = "metallic-roughness"
[[light]]
type = "directional"
direction = [0, 0, -1]
{}
[[object]]
name = "ball"
type = "sphere"
{}
"""


def scene(place: str, name: str) -> str:
    return SCENE.format(*(part.format(name) for part in PLACES[place]))
