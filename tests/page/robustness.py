"""Hostile names and data, broken shaders and devices."""
import scenes
from browser import WINDOW, WITHOUT_WEBGL, Browser, with_scene
from generated import SCRATCH, Generated, PageTest


class Robustness(PageTest):
    def test_hostile_names(self):
        generated = Generated("it's <b>bold<b> & \"loud\"", scenes.hostile())
        self.browser.open(generated.address)
        self.browser.unfold_all()
        self.assert_alike(self.picture(generated), generated.render(), "hostile names")
        self.assertIsNone(self.browser.run("return window.hacked ?? null"))
        self.assertEqual(self.browser.run("return document.querySelectorAll('img, svg, b, aside script').length"), 0)
        self.assertEqual(self.browser.errors(), [])
        titles = self.browser.run("return [...document.querySelectorAll('#lights .title')].map((t) => t.textContent)")
        self.assertEqual(len(titles), len(scenes.HOSTILE_NAMES))
        self.assertTrue(titles[0].startswith("<img src=x"))
        self.assertIn("漢字", "".join(titles))
        self.assertEqual(self.browser.text("h1"), generated.file.stem)
        self.assertEqual(self.browser.driver.title, generated.file.stem)

    def test_hostile_values(self):
        """All data are text."""
        def spoil(scene):
            script = "<img src=x onerror=window.hacked=1>"
            scene["title"] = script
            for models in (scene["light_models"], scene["reflection_models"], scene["shading_models"]):
                for model in models.values():
                    for part in ("title", "summary", "formula", "reference"):
                        model[part] = script
                    for parameter in model["parameters"]:
                        parameter["meaning"] = parameter["unit"] = script
        generated = Generated("values", scenes.PERSPECTIVE, "phong")
        self.browser.open(with_scene(generated.page, SCRATCH / "values.html", spoil))
        self.browser.unfold_all()
        self.assertIsNone(self.browser.run("return window.hacked ?? null"))
        self.assertEqual(self.browser.run("return document.querySelectorAll('img').length"), 0)

    def test_broken_shader(self):
        def spoil(scene):
            scene["reflection_models"]["lambert"]["glsl"] += "\nfloat oops = nonsense;"
        generated = Generated("shader", scenes.PERSPECTIVE)
        self.browser.load(with_scene(generated.page, SCRATCH / "shader.html", spoil))
        self.assertIn("Lambert", self.browser.problem())
        self.assertIn("nonsense", self.browser.text("#problem-detail"))
        self.assertIn("nonsense", self.browser.text("#problem"))
        self.assertTrue(self.browser.one("#problem-text").is_displayed())

    def test_broken_shader_that_is_chosen(self):
        """The page keeps working, and shows an error for as long as it persists."""
        def spoil(scene):
            scene["reflection_models"]["toon"]["glsl"] += "\nfloat oops = nonsense;"
        generated = Generated("chosen", scenes.PERSPECTIVE)
        self.browser.open(with_scene(generated.page, SCRATCH / "chosen.html", spoil))
        box = self.browser.one("#problem-box")

        def wait_until_shown(is_shown):
            for _ in range(40):  # frames of a busy machine
                self.browser.rest(0.5)
                if box.is_displayed() == is_shown:
                    return
        self.browser.enter("[data-path=reflection] select", "toon")
        wait_until_shown(True)
        self.assertIn("Toon", self.browser.one("#problem-text").text)
        self.browser.enter("[data-path=reflection] select", "phong")
        wait_until_shown(False)
        self.assertFalse(box.is_displayed())
        self.assert_alike(self.picture(generated), generated.render("--reflection", "phong"), "afterwards")

    def test_a_thousand_lights(self):
        """As many as graphics memory can hold, not uniform variables."""
        lights = "".join(f'[[light]]\ntype = "point"\nposition = [{i / 400:.4f}, 2.0, 2.0]\nintensity = 0.004\n' for i in range(1000))
        text = scenes.PERSPECTIVE.replace("[[object]]", lights + "[[object]]", 1).replace("samples = 4", "samples = 1")
        generated = Generated("lights", text, "phong")
        self.addCleanup(self.browser.resize, *WINDOW)
        self.browser.resize(200, 150)  # all of those lights take a while
        self.browser.open(generated.address)
        self.assert_alike(self.picture(generated), generated.render(), "a thousand lights")
        self.assertEqual(self.browser.errors(), [])

    def test_lost_graphics(self):
        generated = Generated("lost", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        own = self.picture(generated)
        self.browser.run("""
            window.lose = document.querySelector("canvas").getContext("webgl2").getExtension("WEBGL_lose_context");
            lose.loseContext();""")
        self.browser.rest(0.8)
        self.assertIn("interrupted", self.browser.one("#problem-text").text)
        self.browser.run("lose.restoreContext()")
        self.browser.rest(0.8)
        self.assertFalse(self.browser.one("#problem-box").is_displayed())
        self.assertEqual(self.picture(generated).pixels, own.pixels)

    def test_without_webgl(self):
        generated = Generated("without", scenes.PERSPECTIVE)
        browser = Browser(*WITHOUT_WEBGL)
        self.addCleanup(browser.close)
        browser.load(generated.address)
        self.assertIn("WebGL 2", browser.problem())
        self.assertTrue(browser.one("#problem-text").is_displayed())
        self.assertIn("WebGL 2", browser.text("#problem"))
        headings = [heading.text for heading in browser.all("h1") if heading.is_displayed()]
        self.assertEqual(headings, [generated.file.stem])
