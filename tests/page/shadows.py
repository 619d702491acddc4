"""Shadows of a page: the same as Candela's while the view, the lights and the models change; and switched off."""
import shlex

from selenium.webdriver.common.keys import Keys

import scenes
from generated import SMALL_WINDOW, Generated, PageTest, options_for

SHADOWS = "\n[shadows]\nenabled = true\n"


class Shadows(PageTest):
    window = SMALL_WINDOW

    def load(self, name, text):
        self.generated = Generated(name, text)
        self.browser.open(self.generated.address)
        self.browser.unfold_all()
        return self.picture(self.generated)

    def observer(self):
        return self.browser.run("""
            return [...document.querySelectorAll('[data-path="observer.position"] input[type=number]')].map((i) => Number(i.value));""")

    def test_shadows_are_right_after_every_change(self):
        for name, text in (("shadows", scenes.PERSPECTIVE + SHADOWS), ("shadows-of-a-rectangle", scenes.ORTHOGRAPHIC + SHADOWS)):
            before = self.load(name, text)
            self.assert_alike(before, self.generated.render(), name)
            self.browser.one("canvas").send_keys(Keys.ARROW_LEFT)
            turned = options_for("observer.position", self.observer())
            self.assert_alike(self.picture(self.generated), self.generated.render(*turned), f"{name}, turned", before=before)
            light, values = (1, ["1.1", "2.0", "1.5"]) if name == "shadows" else (0, ["-0.9", "1.9", "0.7"])
            for axis, value in zip("xyz", values):
                self.browser.enter(f'[data-path="light.{light}.value.position"] .line.{axis} input[type=number]', value)
            moved = [*turned, "--set", f"light.{light}.position=[{','.join(values)}]"]
            self.assert_alike(self.picture(self.generated), self.generated.render(*moved), f"{name}, its light moved", before=before)
            for kind, model in (("reflection", "half-lambert"), ("shading", "gouraud")):
                self.browser.enter(f"[data-path={kind}] select", model)
                moved += options_for(kind, model)
                self.assert_alike(self.picture(self.generated), self.generated.render(*moved), f"{name}, {model}", before=before)
            self.assertEqual(self.browser.errors(), [])

    def test_shadows_can_be_switched_off_and_on(self):
        with_shadows = self.load("switched", scenes.PERSPECTIVE + SHADOWS)
        self.browser.click("show-shadows")
        off = self.picture(self.generated)
        self.assert_alike(off, self.generated.render("--no-shadows"), "without shadows", before=with_shadows)
        options = self.browser.driver.execute_async_script("""
            const done = arguments[0];
            navigator.clipboard.writeText = (text) => { done(text); return Promise.resolve(); };
            document.getElementById("copy-options").click();""")
        self.assertEqual(shlex.split(options), ["--set", "shadows.enabled=false"])
        self.browser.click("copy-link")
        self.browser.rest(0.1)
        self.browser.open(self.browser.driver.current_url)
        self.assertEqual(self.picture(self.generated).pixels, off.pixels)
        self.assertFalse(self.browser.one("#show-shadows").is_selected())
        self.browser.click("show-shadows")
        self.assertEqual(self.picture(self.generated).pixels, with_shadows.pixels)

    def test_a_scene_without_shadows_has_no_switch(self):
        self.load("without-shadows", scenes.PERSPECTIVE)
        self.assertFalse(self.browser.one("#show-shadows").is_displayed())
        self.assertTrue(self.browser.one("#show-lights").is_displayed())
