"""The MERL format."""
import pathlib
import struct
import tempfile
import unittest

import numpy as np

import candela


def write_merl(path, brdf):
    """A file of the format from a table (H, D, P, 3) in 1/sr, as the database's authors describe it."""
    scale = np.array([1.0, 1.15, 1.66]) / 1500
    numbers = np.moveaxis(np.asarray(brdf) / scale, -1, 0).astype("<f8")
    pathlib.Path(path).write_bytes(struct.pack("<3i", *brdf.shape[:3]) + numbers.tobytes())


class Measured(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name, "paint.binary")

    def test_a_constant_brdf_is_lambert(self):
        write_merl(self.path, np.broadcast_to(np.array([0.2, 0.4, 0.6]) / np.pi, (9, 9, 18, 3)))
        n = np.array([0, 1, 0])
        l = np.array([[0.6, 0.8, 0], [0, 0.6, 0.8], [0, -1, 0]])
        measured = candela.read_merl(self.path).evaluate(n, [0.0, 0.8, 0.6], l)
        np.testing.assert_allclose(measured, np.array([[0.8], [0.6], [0]]) * [0.2, 0.4, 0.6], atol=1e-12)

    def test_entries_are_found_by_rusinkiewicz_s_angles(self):
        sizes = (4, 3, 4)
        numbers = np.arange(np.prod(sizes), dtype=float).reshape(sizes)
        write_merl(self.path, np.repeat(numbers[..., np.newaxis], 3, axis=-1))
        brdf = candela.read_merl(self.path)
        for index in np.ndindex(*sizes):
            # The centre of each cell, in a frame whose pole is the half vector: Rusinkiewicz (1998).
            h = (np.pi / 2) * ((index[0] + 0.5) / sizes[0]) ** 2
            d = (np.pi / 2) * (index[1] + 0.5) / sizes[1]
            p = np.pi * (index[2] + 0.5) / sizes[2]
            about_half = np.array([np.sin(d) * np.cos(p), np.sin(d) * np.sin(p), np.cos(d)])
            turn = np.array([[np.cos(h), 0, np.sin(h)], [0, 1, 0], [-np.sin(h), 0, np.cos(h)]])
            l, half = turn @ about_half, np.array([np.sin(h), 0, np.cos(h)])
            v = 2 * (half @ l) * half - l
            if l[2] <= 0.01 or v[2] <= 0.01:
                continue
            value = brdf.evaluate([0, 0, 1], v, l)[0] / (np.pi * l[2])
            self.assertAlmostEqual(value, numbers[index], places=9, msg=str(index))

    def test_what_was_not_measured_is_nan(self):
        write_merl(self.path, np.full((2, 2, 2, 3), -1.0))
        self.assertTrue(np.isnan(candela.read_merl(self.path).evaluate([0, 0, 1], [0, 0, 1], [0, 0, 1])).all())

    def test_what_is_no_such_file_is_refused(self):
        for content, said in ((b"", "does not begin with three sizes"), (b"P6 12 12 255", "does not begin|expected"),
                              (struct.pack("<3i", 90, 90, 180) + b"abc", "found 3"),
                              (struct.pack("<3i", 1, 1, 1) + bytes(25), "found more"),
                              (struct.pack("<3i", 1, 1, 1) + struct.pack("<3d", 1, 2, float("nan")), "non-finite values"),
                              (struct.pack("<3i", 2**30, 2**30, 2**30), "does not begin with three sizes")):
            self.path.write_bytes(content)
            with self.assertRaisesRegex(candela.Error, said):
                candela.read_merl(self.path)
        with self.assertRaises(OSError):
            candela.read_merl(self.path.with_name("none"))


if __name__ == "__main__":
    unittest.main()
