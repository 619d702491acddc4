"""Checks that a page shows what Candela renders."""
import base64

import scenes
from generated import SMALL_WINDOW, TWO_STEPS, Generated, PageTest
from pictures import Picture

CANVAS = "document.querySelector('canvas')"


class Picturing(PageTest):
    window = SMALL_WINDOW

    def test_loads_and_is_right(self):
        for name, text in (("perspective", scenes.PERSPECTIVE), ("orthographic", scenes.ORTHOGRAPHIC)):
            generated = Generated(name, text)
            self.browser.open(generated.address)
            self.assert_alike(self.picture(generated), generated.render(), name)
            self.assertEqual(self.browser.errors(), [])
            self.assertEqual(self.browser.run("return performance.getEntriesByType('resource').map((e) => e.name)"), [])

    def test_other_sizes(self):
        generated = Generated("sizes", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        # A slow machine draws coarser pictures first.
        self.browser.wait_for(f"{CANVAS}.style.width === {CANVAS}.width + 'px'")
        shown = self.browser.run(f"return [{CANVAS}.width, {CANVAS}.height, {CANVAS}.style.width]")
        for width, height in ((1, 1), (97, 61), (61, 97)):
            reference = generated.render("--width", width, "--height", height)
            self.assert_alike(self.browser.picture(width, height), reference, f"{width} x {height}")
        self.browser.wait_for(f"[{CANVAS}.width, {CANVAS}.height, {CANVAS}.style.width].join() === values[0].join()", shown)
        for width, height in ((0, 10), (10, 1.5), (1 << 20, 10)):
            with self.assertRaises(AssertionError):
                self.browser.picture(width, height)

    def test_sample_positions(self):
        """Next to edges, where samples matter, they must be at Candela's positions."""
        for name, text in (("perspective", scenes.PERSPECTIVE), ("orthographic", scenes.ORTHOGRAPHIC)):
            for samples in (4, 8, 16):
                many = "--samples", samples
                generated = Generated(f"samples-{name}-{samples}", text, "phong", many)
                self.browser.open(generated.address)
                reference, coarse = generated.render(*many), generated.render("--samples", 1)
                differences = zip(self.picture(generated).differences(reference), coarse.differences(reference))
                beside_edges = [wrong for wrong, change in differences if change > 8]
                self.assertGreater(len(beside_edges), 100)
                wrong = sum(d > TWO_STEPS for d in beside_edges)
                self.assertLess(wrong, 0.15 * len(beside_edges), f"{name}, {samples} samples: {wrong} of {len(beside_edges)}")

    def test_verification(self):
        generated = Generated("verification", scenes.PERSPECTIVE)
        self.browser.load(generated.address + "#verify")
        href = self.browser.text("#picture")
        prefix = "data:image/png;base64,"
        self.assertTrue(href.startswith(prefix))
        self.assert_alike(Picture.of_png(base64.b64decode(href[len(prefix):])), generated.render(), "#verify")

    def test_every_pair_of_models(self):
        generated = Generated("pairs", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.assertGreater(len(generated.scene["shading_models"]), 1)
        self.assertGreater(len(generated.scene["reflection_models"]), 1)
        for shading in generated.scene["shading_models"]:
            self.browser.enter("[data-path=shading] select", shading)
            for reflection in generated.scene["reflection_models"]:
                self.browser.enter("[data-path=reflection] select", reflection)
                reference = generated.render("--shading", shading, "--reflection", reflection)
                self.assert_alike(self.picture(generated), reference, f"{shading}, {reflection}")
        lines = self.browser.run("return [...document.querySelectorAll('.formula-line')].map((line) => line.title)")
        for line in generated.scene["reflection_models"][reflection]["formula"].split("\n"):
            self.assertIn(line.strip(), lines)
        self.assertEqual(self.browser.errors(), [])

    def test_defaults_of_other_models(self):
        """Values that a scene omits are the new model's defaults, not those of the scene's model."""
        text = scenes.PERSPECTIVE.replace("kd = 0.55\nks = 0.4\n", "")
        generated = Generated("defaults", text)
        self.browser.open(generated.address)
        self.browser.enter("[data-path=reflection] select", "ashikhmin-shirley")
        self.assert_alike(self.picture(generated), generated.render("--reflection", "ashikhmin-shirley"), "ashikhmin-shirley")
