"""Pictures in many encodings, written and sampled here."""
import math
import struct
import zlib

from evaluator import linear, mixed


PNG_BEGIN = b"\x89PNG\r\n\x1a\n"


def chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png_header(width: int, height: int, depth: int = 8, kind: int = 2) -> bytes:
    """`kind`: the colour type."""
    return chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, 0))


def png(width, height, depth, kind, rows, more=()):
    """`rows` of samples; `kind` is the colour type, `more` chunks before the data."""
    data = b""
    for row in rows:
        data += b"\0"
        if depth < 8:
            bits = "".join(format(v, f"0{depth}b") for v in row)
            bits += "0" * (-len(bits) % 8)
            data += bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8))
        else:
            data += struct.pack(f">{len(row)}{'B' if depth == 8 else 'H'}", *row)
    return (PNG_BEGIN + png_header(width, height, depth, kind) +
            b"".join(chunk(*each) for each in more) + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))


def jpeg(width, height, blocks, channels=3):
    """A baseline file of 8 x 8 blocks of one value each, Y or (Y, Cb, Cr)."""
    segment = lambda marker, data: bytes([0xFF, marker]) + struct.pack(">H", len(data) + 2) + data
    bits, before = "", [128] * channels
    for block in blocks:
        for c in range(channels):
            step = 8 * (block[c] - before[c])
            before[c] = block[c]
            size = abs(step).bit_length()
            bits += format(size, "04b") + (format(step if step > 0 else step + (1 << size) - 1, f"0{size}b") if size else "") + "0"
    bits += "1" * (-len(bits) % 8)
    scan = b"".join(b"\xFF\0" if b == 255 else bytes([b]) for b in (int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)))
    components = b"".join(bytes([c + 1, 0x11, 0]) for c in range(channels))
    return (b"\xFF\xD8" + segment(0xE0, b"JFIF\0\1\1\0\0\1\0\1\0\0") + segment(0xDB, b"\0" + b"\1" * 64) +
            segment(0xC0, struct.pack(">BHHB", 8, height, width, channels) + components) +
            segment(0xC4, b"\0" + bytes([0, 0, 0, 12] + [0] * 12) + bytes(range(12))) +
            segment(0xC4, b"\x10" + bytes([1] + [0] * 15) + b"\0") +
            segment(0xDA, bytes([channels]) + b"".join(bytes([c + 1, 0]) for c in range(channels)) + b"\0\x3F\0") + scan + b"\xFF\xD9")


class Picture:
    """Texels from 0 to 1 as stored, four channels; its file."""

    def __init__(self, width, height, texels, file, mime="image/png"):
        self.width, self.height, self.texels, self.file, self.mime = width, height, texels, file, mime

    def texel(self, x, y, wraps, is_srgb):
        inside = lambda i, n, wrap: {"repeat": i % n, "clamp": min(max(i, 0), n - 1),
                                     "mirror": min(i % (2 * n), 2 * n - 1 - i % (2 * n))}[wrap]
        texel = self.texels[self.width * inside(y, self.height, wraps[1]) + inside(x, self.width, wraps[0])]
        return tuple(map(linear, texel[:3])) + texel[3:] if is_srgb else texel

    def at(self, uv, is_srgb=False, wraps=("repeat", "repeat")):
        """Bilinear, with v downwards."""
        x, y = uv[0] * self.width - 0.5, uv[1] * self.height - 0.5
        i, j = math.floor(x), math.floor(y)
        s, t = x - i, y - j
        return mixed([(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t],
                     [self.texel(i + k % 2, j + k // 2, wraps, is_srgb) for k in range(4)])


def rgba(width, height, texel):
    texels = [texel(x, y) for y in range(height) for x in range(width)]
    rows = [[v for t in texels[width * y:width * (y + 1)] for v in t] for y in range(height)]
    return Picture(width, height, [tuple(v / 255 for v in t) for t in texels], png(width, height, 8, 6, rows))


def colorful():
    """8 x 8 texels; each channel has its own pattern."""
    return rgba(8, 8, lambda x, y: (40 + 25 * x, 190 + 8 * y, 10 * (x + y) + 9 * y, 60 + 20 * abs(x - y)))


def slopes():
    """A normal map with slopes in both directions."""
    return rgba(8, 8, lambda x, y: (90 + 10 * x, 170 - 9 * y, 200 + 3 * x, 255))


def grey(depth, alpha=False):
    """A ramp of `depth` bits."""
    most, n = (1 << depth) - 1, 8 if depth > 2 else 1 << depth
    value = lambda x, y: round(most * ((x + 2 * y) % n + 0.25) / n) if depth > 1 else (x + y) % 2
    width = 8
    rows = [[v for x in range(width) for v in ((value(x, y), most - value(x, y)) if alpha else (value(x, y),))] for y in range(8)]
    texels = [(value(x, y) / most,) * 3 + ((1 - value(x, y) / most) if alpha else 1,) for y in range(8) for x in range(width)]
    return Picture(width, 8, texels, png(width, 8, depth, 4 if alpha else 0, rows))


def deep():
    """16 bits per channel, whose lower bytes alone differ by half a level of 8 bits or more."""
    texel = lambda x, y: (0x2000 + 0x1580 * x, 0xB0FF - 0x0F80 * y, 0x0480 * (x + y) + 0x80)
    rows = [[v for x in range(8) for v in texel(x, y)] for y in range(8)]
    return Picture(8, 8, [tuple(v / 65535 for v in texel(x, y)) + (1,) for y in range(8) for x in range(8)], png(8, 8, 16, 2, rows))


def palette(depth, opacities=()):
    colors = [(250, 30, 20), (20, 200, 60), (40, 80, 240), (230, 220, 90)]
    index = lambda x, y: (x // 2 + 2 * (y // 2)) % (1 << min(depth, 2))
    more = [(b"PLTE", bytes(v for c in colors[:1 << depth] for v in c))]
    if opacities:
        more.append((b"tRNS", bytes(opacities)))
    alpha = lambda i: opacities[i] / 255 if i < len(opacities) else 1
    texels = [tuple(v / 255 for v in colors[index(x, y)]) + (alpha(index(x, y)),) for y in range(8) for x in range(8)]
    return Picture(8, 8, texels, png(8, 8, depth, 3, [[index(x, y) for x in range(8)] for y in range(8)], more))


def photograph(channels=3):
    """A JPEG of four blocks."""
    blocks = [(200, 110, 150), (120, 160, 100), (60, 128, 128), (150, 90, 120)]
    def color(y, cb, cr):
        if channels == 1:
            return (y / 255,) * 3 + (1,)
        cb, cr = cb - 128, cr - 128
        return tuple(min(max(v / 255, 0), 1) for v in (y + 1.402 * cr, y - 0.344136 * cb - 0.714136 * cr, y + 1.772 * cb)) + (1,)
    texels = [color(*blocks[2 * (y // 8) + x // 8]) for y in range(16) for x in range(16)]
    return Picture(16, 16, texels, jpeg(16, 16, blocks, channels), "image/jpeg")
