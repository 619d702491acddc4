"""Pictures made up byte by byte: nearly valid headers, of any size, in every format that a texture may have."""
import random
import struct
import zlib

SIZES = (0, 1, 2, 3, 7, 16, 255, 256, 1000, 4096, 16383, 20000, 32768, 65535, 65536, 1 << 24, (1 << 31) - 1, 1 << 31, (1 << 32) - 1)
SMALL = (1, 2, 3, 7, 16, 33)


def size(chance: random.Random) -> int:
    return chance.choice(SMALL if chance.random() < 0.6 else SIZES)


def body(chance: random.Random) -> bytes:
    """Pixel data, or a substitute: mostly too few."""
    count = chance.choice((0, 1, 10, 100, 1000, 5000))
    kind = chance.randrange(3)
    if kind == 0:
        return bytes([chance.choice((0, 0x7F, 0x80, 0xFF))]) * count
    return chance.randbytes(count) if kind == 1 else zlib.compress(bytes(50 * count), 9)


def tiff(chance: random.Random) -> bytes:
    order = chance.choice("<>")
    is_big = chance.random() < 0.15
    tags = {256: size(chance), 257: size(chance), 258: chance.choice((1, 2, 4, 8, 8, 8, 16, 24, 32, 64)),
            259: chance.choice((1, 1, 2, 3, 4, 5, 5, 6, 7, 8, 8, 32773, 32773, 32946, 34661, 34676, 34712, 34887, 34925, 50000, 50001)),
            262: chance.choice((0, 1, 1, 2, 2, 2, 3, 4, 5, 6, 8, 32844, 32845)),
            277: chance.choice((1, 1, 3, 3, 3, 4, 2, 5, 1000, 65535)), 284: chance.choice((1, 1, 2)),
            317: chance.choice((1, 2, 3)), 339: chance.choice((1, 1, 2, 3, 6))}
    data = body(chance)
    if chance.random() < 0.5:
        tags |= {322: chance.choice((16, 32, 256, size(chance))), 323: chance.choice((16, 32, 256, size(chance))),
                 324: 8, 325: chance.choice((len(data), size(chance)))}
    else:
        tags |= {278: chance.choice((1, 8, size(chance))), 273: 8, 279: chance.choice((len(data), size(chance)))}
    for tag in chance.sample(sorted(tags), chance.choice((0, 0, 0, 1, 2))):
        del tags[tag]
    count_at = chance.choice(sorted(tags)) if tags and chance.random() < 0.2 else None
    offset = (16 if is_big else 8) + len(data)
    entries = b""
    for tag, value in sorted(tags.items()):
        count = chance.choice((0, 2, 1000, size(chance))) if tag == count_at else 1
        entries += (struct.pack(order + "HHQQ", tag, 4, count, value) if is_big
                    else struct.pack(order + "HHII", tag, 4, count, value & 0xFFFFFFFF))
    if is_big:
        head = (b"II+\0" if order == "<" else b"MM\0+") + struct.pack(order + "HHQ", 8, 0, offset)
        return head + data + struct.pack(order + "Q", len(tags)) + entries + bytes(8)
    head = (b"II*\0" if order == "<" else b"MM\0*") + struct.pack(order + "I", offset)
    return head + data + struct.pack(order + "H", len(tags)) + entries + bytes(4)


def png(chance: random.Random) -> bytes:
    def chunk(name: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))
    width, height = size(chance), size(chance)
    head = struct.pack(">IIBBBBB", width, height, chance.choice((1, 2, 4, 8, 8, 8, 16, 3)), chance.choice((0, 2, 2, 3, 4, 6, 1)), 0, 0,
                       chance.choice((0, 0, 1)))
    rows = zlib.compress(bytes(min(3 * width + 1, 3000) * min(height, 100)), 9)
    chunks = [chunk(b"IHDR", head), chunk(b"IDAT", chance.choice((rows, body(chance)))), chunk(b"IEND", b"")]
    for _ in range(chance.choice((0, 0, 1, 3))):
        chunks.insert(chance.randrange(1, 3), chunk(chance.choice((b"PLTE", b"tRNS", b"gAMA", b"iCCP", b"zTXt", b"acTL", b"eXIf", b"IDAT")),
                                                    body(chance)[:800]))
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def jpeg(chance: random.Random) -> bytes:
    def segment(kind: int, content: bytes) -> bytes:
        return struct.pack(">BBH", 0xFF, kind, len(content) + 2) + content
    parts = chance.choice((1, 3, 3, 4))
    frame = struct.pack(">BHHB", chance.choice((8, 8, 12)), size(chance) & 0xFFFF, size(chance) & 0xFFFF, parts)
    frame += b"".join(bytes([i + 1, chance.choice((0x11, 0x22, 0x44, 0x14)), 0]) for i in range(parts))
    huffman = bytes([0]) + bytes([0, 1] + [0] * 14) + bytes([0]) + bytes([0x10]) + bytes([0, 1] + [0] * 14) + bytes([0])
    result = b"\xff\xd8" + segment(0xDB, bytes(1) + bytes([1]) * 64) + segment(0xC4, huffman)
    result += segment(chance.choice((0xC0, 0xC2, 0xC2, 0xC9, 0xC3)), frame)
    for _ in range(chance.choice((1, 1, 2, 200, 2000))):  # a progressive one may have any number of scans
        scan = bytes([parts]) + b"".join(bytes([i + 1, 0]) for i in range(parts)) + bytes([0, chance.choice((0, 63)), 0])
        result += segment(0xDA, scan) + body(chance)[:chance.choice((0, 1, 10))].replace(b"\xff", b"")
    return result + b"\xff\xd9"


def bmp(chance: random.Random) -> bytes:
    bits = chance.choice((1, 4, 8, 16, 24, 32))
    info = struct.pack("<IiiHHIIiiII", chance.choice((40, 12, 108, 124)), min(size(chance), (1 << 31) - 1),
                       chance.choice((1, -1)) * min(size(chance), (1 << 31) - 1), 1, bits, chance.choice((0, 0, 1, 2, 3)), 0, 0, 0,
                       chance.choice((0, 2, 256, size(chance))), 0)
    return b"BM" + struct.pack("<IHHI", 54, 0, 0, chance.choice((54, 26, 1078, size(chance)))) + info + body(chance)


def targa(chance: random.Random) -> bytes:
    return struct.pack("<BBBHHBHHHHBB", chance.choice((0, 0, 26, 255)), chance.choice((0, 1)), chance.choice((1, 2, 2, 3, 9, 10, 10, 11, 32)),
                       0, size(chance) & 0xFFFF, chance.choice((0, 16, 24, 32)), 0, 0, size(chance) & 0xFFFF, size(chance) & 0xFFFF,
                       chance.choice((8, 16, 24, 32)), chance.choice((0, 8, 0x20, 0x30))) + body(chance)


def radiance(chance: random.Random) -> bytes:
    return (b"#?RADIANCE\n" + chance.choice((b"FORMAT=32-bit_rle_rgbe\n", b"FORMAT=32-bit_rle_xyze\n", b"", b"EXPOSURE=1e999\n")) +
            b"\n" + f"{chance.choice('-+')}Y {size(chance)} {chance.choice('-+')}X {size(chance)}\n".encode() + body(chance))


def pixmap(chance: random.Random) -> bytes:
    kind = chance.choice(("P1", "P2", "P3", "P4", "P5", "P6", "PF", "Pf", "P7"))
    most = chance.choice(("255", "65535", "0", "-1.0", "1e-39", "nan"))
    return f"{kind}\n{size(chance)} {size(chance)}\n{most}\n".encode() + body(chance)


def webp(chance: random.Random) -> bytes:
    width, height = max(size(chance), 1), max(size(chance), 1)
    name = chance.choice((b"VP8L", b"VP8 ", b"VP8X"))
    if name == b"VP8L":
        content = b"/" + struct.pack("<I", (width - 1 & 0x3FFF) | (height - 1 & 0x3FFF) << 14) + body(chance)
    elif name == b"VP8 ":
        content = b"\x10\0\0\x9d\x01\x2a" + struct.pack("<HH", width & 0x3FFF, height & 0x3FFF) + body(chance)
    else:
        content = bytes([chance.choice((0, 2, 0x10, 0x3E)), 0, 0, 0]) + struct.pack("<I", width - 1 & 0xFFFFFF)[:3]
        content += struct.pack("<I", height - 1 & 0xFFFFFF)[:3] + b"ANMF" + struct.pack("<I", size(chance)) + body(chance)
    content = name + struct.pack("<I", chance.choice((len(content), size(chance) & 0xFFFFFFFF))) + content
    return b"RIFF" + struct.pack("<I", len(content) + 4) + b"WEBP" + content


def exr(chance: random.Random) -> bytes:
    def attribute(name: str, kind: str, content: bytes) -> bytes:
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(content)) + content
    channel = b"".join(name + b"\0" + struct.pack("<IIii", chance.choice((0, 1, 2)), 0, 1, 1)
                       for name in chance.choice(((b"B", b"G", b"R"), (b"Y",), (b"A", b"B", b"G", b"R"))))
    wide, high = min(size(chance), (1 << 31) - 1) - 1, min(size(chance), (1 << 31) - 1) - 1
    window = struct.pack("<iiii", 0, 0, wide, high)
    is_tiled = chance.random() < 0.4
    head = attribute("channels", "chlist", channel + b"\0") + attribute("compression", "compression", bytes([chance.randrange(11)]))
    head += attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window)
    head += attribute("lineOrder", "lineOrder", bytes([chance.randrange(3)])) + attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    head += attribute("screenWindowCenter", "v2f", bytes(8)) + attribute("screenWindowWidth", "float", struct.pack("<f", 1))
    if is_tiled:
        head += attribute("tiles", "tiledesc", struct.pack("<IIB", min(size(chance), 0xFFFFFFFF), min(size(chance), 0xFFFFFFFF),
                                                           chance.choice((0, 1, 2))))
    flags = 0x200 if is_tiled else 0
    return b"v/1\x01" + struct.pack("<I", 2 | flags) + head + b"\0" + body(chance)


def gif(chance: random.Random) -> bytes:
    return (b"GIF89a" + struct.pack("<HHBBB", size(chance) & 0xFFFF, size(chance) & 0xFFFF, 0x80, 0, 0) + bytes(6) + b"," +
            struct.pack("<HHHHB", 0, 0, size(chance) & 0xFFFF, size(chance) & 0xFFFF, 0) + b"\x02" + body(chance) + b"\0;")


MAKERS = {"png": png, "ppm": pixmap, "pfm": pixmap, "pnm": pixmap, "hdr": radiance, "exr": exr, "jpg": jpeg, "tif": tiff, "bmp": bmp,
          "tga": targa, "webp": webp, "gif": gif}


def made(kind: str, chance: random.Random) -> bytes:
    """A picture of that kind, or sometimes of another, like files with wrong names."""
    return MAKERS[chance.choice(sorted(MAKERS)) if chance.random() < 0.1 else kind](chance)
