"""Pictures as rows of RGB bytes, and the differences between two."""
import pathlib
import struct
import zlib


class Picture:
    def __init__(self, width, height, pixels):
        self.width, self.height, self.pixels = width, height, bytes(pixels)
        assert len(self.pixels) == 3 * width * height, "not that many pixels"

    @classmethod
    def of_rgba(cls, width, height, rgba):
        pixels = bytearray(3 * width * height)
        for channel in range(3):
            pixels[channel::3] = rgba[channel::4]
        assert set(rgba[3::4]) <= {255}, "the picture is transparent"
        return cls(width, height, pixels)

    @classmethod
    def of_ppm(cls, path):
        data = pathlib.Path(path).read_bytes()
        kind, width, height, most = data.split(maxsplit=4)[:4]
        assert (kind, most) == (b"P6", b"255"), f"{path} is not an 8-bit PPM"
        count = 3 * int(width) * int(height)
        return cls(int(width), int(height), data[-count:])

    @classmethod
    def of_png(cls, data):
        """8 bits, RGB or RGBA, not interlaced."""
        assert data[:8] == b"\x89PNG\r\n\x1a\n", "not a PNG"
        at, packed = 8, b""
        while at < len(data):
            size, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + size]
            if kind == b"IHDR":
                width, height, bits, color = struct.unpack(">IIBB", body[:10])
            if kind == b"IDAT":
                packed += body
            at += 12 + size
        assert bits == 8 and color in (2, 6), "another kind of PNG"
        channels = 3 if color == 2 else 4
        rows = unfiltered(zlib.decompress(packed), width * channels, height, channels)
        return cls(width, height, rows) if channels == 3 else cls.of_rgba(width, height, rows)

    def differences(self, other):
        """For each pixel: the largest difference of a channel."""
        assert (self.width, self.height) == (other.width, other.height), "the pictures have different sizes"
        channels = [abs(a - b) for a, b in zip(self.pixels, other.pixels)]
        return [max(pixel) for pixel in zip(channels[0::3], channels[1::3], channels[2::3])]


def unfiltered(data, stride, height, step):
    """PNG, section 9.2."""
    result, above = bytearray(), bytearray(stride)
    for y in range(height):
        kind, *row = data[y * (stride + 1):(y + 1) * (stride + 1)]
        for i in range(stride):
            left, up, corner = row[i - step] if i >= step else 0, above[i], above[i - step] if i >= step else 0
            estimate = left + up - corner
            nearest = min((abs(estimate - left), 0, left), (abs(estimate - up), 1, up), (abs(estimate - corner), 2, corner))
            row[i] = (row[i] + (0, left, up, (left + up) // 2, nearest[2])[kind]) & 255
        above = row
        result += bytes(row)
    return bytes(result)
