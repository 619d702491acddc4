"""The page that `candela generate --target three` writes."""
import pathlib
import unittest

import scenes
from generated import COMMAND, SMALL_WINDOW, Generated, PageTest

LIBRARY = pathlib.Path(COMMAND).resolve().parent.parent / "lib/candela/plugins/target-three"
needs_three = unittest.skipUnless(LIBRARY.exists(), "three.js is missing; scripts/three.sh fetches it")


@needs_three
class Three(PageTest):
    window = SMALL_WINDOW

    def generated(self, name, text):
        generated = Generated(f"three-{name}", text, "phong", target="three")
        self.browser.open(generated.address)
        return generated

    def test_loads_and_is_right(self):
        for name, text in (("perspective", scenes.PERSPECTIVE), ("orthographic", scenes.ORTHOGRAPHIC)):
            generated = self.generated(name, text)
            self.assert_alike(self.picture(generated), generated.render(), name)
            self.assertEqual(self.browser.errors(), [])

    def test_keys_turn_and_reset_it(self):
        generated = self.generated("keys", scenes.PERSPECTIVE)
        before = self.picture(generated)
        self.press("ArrowRight", "ArrowUp", "+")
        position = self.browser.driver.execute_async_script(
            "const done = arguments[0]; candela.page.then((page) => done(page.observer().position));")
        turned = generated.render("--set", f"observer.position={position}")
        self.assert_alike(self.picture(generated), turned, "turned", before)
        self.press("0")
        self.assertEqual(self.picture(generated).pixels, before.pixels)

    def press(self, *keys):
        self.browser.run("""
            const canvas = document.querySelector("canvas");
            for (const key of arguments[0]) canvas.dispatchEvent(new KeyboardEvent("keydown", { key }));""", list(keys))

    def test_hostile_names(self):
        generated = self.generated("names", scenes.hostile())
        self.assert_alike(self.picture(generated), generated.render(), "hostile names")
        self.assertIsNone(self.browser.run("return window.hacked ?? null"))
        self.assertEqual(self.browser.errors(), [])
