"""Pictures of the same view next to one another."""
import base64

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

import scenes
from generated import MOST_DIFFERENT, TWO_STEPS, Generated, PageTest
from pictures import Picture

TINY = (840, 330)  # the panes' pictures are drawn on the CPU


class Panes(PageTest):
    window = TINY

    def setUp(self):
        self.generated = Generated("panes", scenes.PERSPECTIVE.replace("samples = 4", "samples = 1"))
        self.browser.open(self.generated.address)

    def choose(self, layout):
        self.browser.enter("#panes-layout", layout)

    def boxes(self):
        return self.browser.run("""
            return [document.getElementById("picture-canvas"), ...document.querySelectorAll("canvas.pane")].map((canvas) => {
                const { x, y, width, height } = canvas.getBoundingClientRect();
                return [x, y, width, height];
            });""")

    def pane(self, index):
        """The picture on the screen, once it no longer changes."""
        encoded = self.browser.driver.execute_async_script("""
            const [index, done] = arguments, canvas = document.querySelectorAll("canvas.pane")[index];
            let last = "";
            const look = () => {
                const now = canvas.toDataURL(), isWhole = canvas.width === parseInt(canvas.style.width);
                if (isWhole && now === last) done(now.split(",")[1]);
                else setTimeout(look, 400);
                last = now;
            };
            look();""", index)
        return Picture.of_png(base64.b64decode(encoded))

    def assert_pane_shows(self, index, *options):
        pane = self.pane(index)
        reference = self.generated.render("--width", pane.width, "--height", pane.height, *options)
        different = sum(d > TWO_STEPS for d in pane.differences(reference))
        self.assertLessEqual(different, MOST_DIFFERENT * pane.width * pane.height, f"pane {index}")
        return pane

    def test_each_pane_has_its_own_model_and_values_and_one_camera(self):
        own = self.picture(self.generated).pixels
        self.choose("three")
        self.browser.enter('[data-path="pane.1.reflection"] select', "toon")
        self.browser.enter('[data-path="pane.2.reflection"] select', "blinn-phong")
        self.browser.enter('[data-path="pane.2.shading"] select', "flat")
        self.browser.unfold_all()
        self.browser.enter('[data-path="pane.2.object.1.material.blinn-phong.shininess"] input', "4")
        self.browser.enter('[data-path="pane.2.object.1.color"] input', "#20c040")
        self.browser.one("#picture-canvas").send_keys(Keys.ARROW_LEFT)
        position = self.browser.run("""
            return [...document.querySelectorAll('[data-path="observer.position"] input[type=number]')].map((i) => Number(i.value));""")
        view = ("--set", f"observer.position={position}")
        toon = self.assert_pane_shows(0, "--reflection", "toon", *view)
        flat = self.assert_pane_shows(1, "--reflection", "blinn-phong", "--shading", "flat", "--set", "object.1.material.shininess=4",
                                      "--set", "object.1.color=[32,192,64]", *view)
        self.assertNotEqual(toon.pixels, flat.pixels)
        # The first has stayed the same, except for the view.
        self.browser.click("reset-view")
        self.assertEqual(self.picture(self.generated).pixels, own)
        # They are next to one another, and none covers another.
        boxes = self.boxes()
        self.assertEqual(len({(w, h) for _, _, w, h in boxes}), 1)
        for i, (x, y, w, h) in enumerate(boxes):
            self.assertTrue(all(abs(x - u) >= w or abs(y - v) >= h for u, v, _, _ in boxes[:i]))
        names = [canvas.accessible_name for canvas in self.browser.all("canvas.pane")]
        self.assertTrue(names[0].startswith("Pane B: Toon"), names)
        self.assertIn("shininess 4", names[1])
        self.assertEqual(self.browser.errors(), [])

    def test_a_pane_follows_the_first_in_what_is_not_its_own(self):
        self.choose("two")
        self.browser.enter('[data-path="pane.1.reflection"] select', "lambert")
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.1.color"] input', "#2040c0")
        self.browser.enter('[data-path="light.2.on"] input', False)
        self.assert_pane_shows(0, "--reflection", "lambert", "--set", "object.1.color=[32,64,192]", "--set", "light.2.intensity=0")
        # Dragging in the pane turns both.
        before = self.picture(self.generated).pixels
        ActionChains(self.browser.driver).drag_and_drop_by_offset(self.browser.one("canvas.pane"), 60, 10).perform()
        self.assertNotEqual(self.picture(self.generated).pixels, before)

    def test_a_pane_that_opens_has_another_model(self):
        self.choose("four")
        names = [canvas.accessible_name for canvas in self.browser.all("canvas.pane")]
        models = [name.split(": ")[1].split(" · ")[0] for name in names]
        self.assertEqual(len(set(models)), 3)
        self.choose("one")
        self.assertEqual(self.browser.all("canvas.pane"), [])
        self.assertTrue(self.browser.run("return document.getElementById('panes').hidden"))

    def test_a_wipe_shows_the_second_over_a_part_of_the_first(self):
        self.choose("wipe")
        self.browser.rest(0.5)
        first, second = self.boxes()
        for a, b in zip(first, second):
            self.assertLess(abs(a - b), 1)
        clip = lambda: self.browser.run("return document.querySelector('canvas.pane').style.clipPath")
        self.assertIn("50%", clip())
        self.browser.enter("#panes-share", "25")
        self.assertIn("75%", clip())

    def test_panes_are_in_the_link_and_not_in_the_options(self):
        self.choose("two")
        self.browser.enter('[data-path="pane.1.reflection"] select', "ggx")
        self.browser.unfold_all()
        self.browser.enter('[data-path="pane.1.object.1.material.ggx.roughness"] input', "0.6")
        # A pane with the scene's own model, while the first has another.
        self.browser.enter('[data-path="reflection"] select', "toon")
        self.browser.enter("#panes-layout", "three")
        self.browser.enter('[data-path="pane.2.reflection"] select', "")
        options = self.browser.driver.execute_async_script("""
            const done = arguments[0];
            navigator.clipboard.writeText = (text) => { done(text); return Promise.resolve(); };
            document.getElementById("copy-options").click();""")
        self.assertEqual(options, "--reflection toon")
        self.browser.click("copy-link")
        self.browser.rest(0.1)
        self.browser.open(self.browser.driver.current_url)
        second, third = [canvas.accessible_name for canvas in self.browser.all("canvas.pane")]
        self.assertIn("GGX", second)
        self.assertIn("roughness 0.6", second)
        self.assertIn("Lambert, Blinn-Phong", third)
        self.browser.click("reset-all")
        self.assertEqual(self.browser.all("canvas.pane"), [])
