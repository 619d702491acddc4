"""Checks the pages of the shipped models, docs/models.

    models_test.py ROOT CANDELA
"""
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, CANDELA = Path(sys.argv.pop(1)).resolve(), Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(ROOT / "scripts"))
import models  # noqa: E402

LARGEST_PICTURE = 15_000
AGAIN = "run: python3 scripts/models.py build/release/bin/candela"
SHIPPED = models.shipped(CANDELA)


class Pages(unittest.TestCase):
    def test_every_kernel_has_a_page(self):
        kernels = {f"{path.parent.name}-{path.stem}.md" for path in (ROOT / "plugins").glob("*/*.kernel")}
        for kind in ("light", "reflection", "shading"):  # models with C++ in addition
            kernels |= {f"{kind}-{path.stem}.md" for path in (ROOT / "plugins" / kind).glob("*/*.kernel")}
        self.assertGreaterEqual(len(kernels), 26)
        self.assertEqual({path.name for path in models.PAGES.iterdir()}, kernels | {"README.md"}, AGAIN)

    def test_pages_are_those_that_the_script_writes(self):
        for name, text in models.texts(SHIPPED).items():
            with self.subTest(name):
                self.assertEqual((models.PAGES / name).read_text(encoding="utf-8"), text, AGAIN)

    def test_the_page_of_the_language_has_the_whole_prelude(self):
        text = models.LANGUAGE_PAGE.read_text(encoding="utf-8")
        self.assertEqual(text, models.language_page(), AGAIN)
        prelude = models.PRELUDE.read_text(encoding="utf-8")
        for name in re.findall(r"^struct (\w+)|^KERNEL \w+ (\w+)\(", prelude, re.MULTILINE):
            self.assertRegex(text, rf"\| `(\w+ )?{''.join(name)}[`(]")
        self.assertIn("| | `vec3 to_observer` | V |", text)

    def test_every_kernel_says_when_to_choose_the_model(self):
        for model in SHIPPED:
            with self.subTest(model.file):
                self.assertGreater(len(model.kernel.paragraphs), 1, "the comment has no paragraph after its first sentence")
                self.assertTrue(model.kernel.equations)

    def test_every_page_has_small_pictures(self):
        wanted = {name for model in SHIPPED for name in model.pictures()}
        self.assertEqual({path.name for path in models.PICTURES.iterdir()}, wanted, AGAIN + " --pictures")
        for name in sorted(wanted):
            self.assertLess((models.PICTURES / name).stat().st_size, LARGEST_PICTURE, name)

    def test_the_scene_of_every_page_is_valid(self):
        with tempfile.TemporaryDirectory() as scratch:
            for model in SHIPPED:
                page = (models.PAGES / f"{model.file}.md").read_text(encoding="utf-8")
                parts = re.findall(r"^```toml\n(.*?)^```$", page, re.DOTALL | re.MULTILINE)
                with self.subTest(model.file):
                    self.assertEqual(len(parts), 1)
                    self.assertIn(f'"{model.name}"', parts[0])
                    scene = Path(scratch) / f"{model.file}.toml"
                    scene.write_text(model.scene(parts[0]), encoding="utf-8")
                    checked = subprocess.run([CANDELA, "check", scene], capture_output=True, text=True, check=False)
                    warnings = [line for line in checked.stderr.splitlines() if "warning:" in line and "not closed" not in line]
                    self.assertEqual((checked.returncode, warnings), (0, []), checked.stderr)


unittest.main()
