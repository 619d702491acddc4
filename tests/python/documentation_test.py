"""The code of docs/user/python.md, one block after another, as a reader would type it."""
import contextlib
import io
import os
import pathlib
import re
import tempfile
import unittest

import candela

DOCUMENTATION = pathlib.Path(__file__).resolve().parents[2] / "docs"
PAGE = DOCUMENTATION / "user/python.md"

SCENE = {
    "observer": {"position": [0, 0, 4], "look_at": [0, 0, 0]},
    "image": {"width": 64, "height": 48},
    "shading": {"model": "phong"},
    "reflection": {"model": "phong"},
    "light": [{"name": "lamp", "type": "point", "position": [2, 2, 3]}],
    "object": [{"name": "ball", "type": "sphere"}],
}


class Documentation(unittest.TestCase):
    def test_every_block_of_the_page_runs(self):
        text = PAGE.read_text(encoding="utf-8")
        blocks = [(text[: match.start()].count("\n") + 2, match[1]) for match in re.finditer(r"^```python\n(.*?)^```", text, re.M | re.S)]
        self.assertGreater(len(blocks), 5)
        names, before = {"__name__": "__main__"}, os.getcwd()
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
            os.chdir(folder)
            try:
                pathlib.Path("scene.toml").write_text(candela.document(SCENE), encoding="utf-8")
                velvet = re.search(r"^```glsl\n(.*?)^```", (DOCUMENTATION / "plugins/adding-a-model.md").read_text("utf-8"), re.M | re.S)
                pathlib.Path("velvet.kernel").write_text(velvet[1], encoding="utf-8")
                for line, block in blocks:
                    exec(compile("\n" * (line - 1) + block, str(PAGE), "exec"), names)
                self.assertTrue(pathlib.Path("scene.png").read_bytes().startswith(b"\x89PNG"))
            finally:
                os.chdir(before)
        self.assertEqual(names["picture"].shape, (512, 512, 3))
        self.assertEqual(names["lobe"].shape, (1000, 3))


if __name__ == "__main__":
    unittest.main()
