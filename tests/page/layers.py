"""Surfaces of a page that something may be seen through: the same as Candela's while the view and the models change."""
import base64
import time

from selenium.webdriver.common.keys import Keys

from generated import MOST_DIFFERENT, SCRATCH, SMALL_WINDOW, TWO_STEPS, Generated, PageTest, options_for
from pictures import Picture

SCENE = """
version = 1
[observer]
position = [0.0, 1.0, 5.0]
look_at = [0.0, 0.0, 0.0]
[image]
width = 160
height = 100
samples = 4
background = [40, 50, 70]
[constraints]
overlap = "allow"
[shading]
model = "phong"
[reflection]
model = "phong"
[[light]]
type = "point"
position = [-2.0, 4.0, 3.0]
intensity = 20.0
[[light]]
type = "ambient"
intensity = 0.5
[[object]]
name = "red"
type = "sphere"
position = [-0.6, 0.0, 0.0]
color = [250, 60, 40]
[object.material]
opacity = 0.4
[[object]]
name = "blue"
type = "sphere"
position = [0.6, 0.0, 0.2]
color = [40, 60, 250]
[object.material]
opacity = { texture = "steps.ppm" }
opacity_cutoff = 0.5
[[object]]
name = "green"
type = "cube"
size = 0.8
position = [0.0, 0.1, -1.0]
color = [60, 200, 80]
[object.material]
opacity = 0.7
"""
# Eight by eight texels, opaque and clear in turn.
STEPS = b"P6\n8 8\n255\n" + b"".join(bytes([255 * ((x + y) % 2)] * 3) for y in range(8) for x in range(8))
OPAQUE = "\n".join(line for line in SCENE.splitlines() if not line.startswith("opacity"))


def generated(name, text):
    (SCRATCH / name).mkdir(parents=True, exist_ok=True)
    (SCRATCH / name / "steps.ppm").write_bytes(STEPS)
    return Generated(name, text)


class Layers(PageTest):
    window = SMALL_WINDOW

    def test_layers_are_right_after_every_change(self):
        page, opaque = generated("layers", SCENE), generated("without-layers", OPAQUE)
        self.browser.open(page.address)
        self.browser.unfold_all()
        before = self.picture(page)
        self.assert_alike(before, page.render(), "layers", before=opaque.render())
        self.browser.one("canvas").send_keys(Keys.ARROW_LEFT)
        position = self.browser.run("""
            return [...document.querySelectorAll('[data-path="observer.position"] input[type=number]')].map((i) => Number(i.value));""")
        options = options_for("observer.position", position)
        self.assert_alike(self.picture(page), page.render(*options), "turned", before=before)
        for shading in ("gouraud", "flat"):
            self.browser.enter("[data-path=shading] select", shading)
            changed = [*options, *options_for("shading", shading)]
            self.assert_alike(self.picture(page), page.render(*changed), shading, before=before)
        self.assertEqual(self.browser.errors(), [])

    def test_the_screen_shows_them(self):
        page = generated("layers-on-the-screen", SCENE)
        self.browser.open(page.address)
        self.browser.click("show-lights")  # which lie over the picture
        deadline = time.monotonic() + 60
        while True:
            self.browser.rest()
            screen = Picture.of_png(base64.b64decode(self.browser.one("canvas").screenshot_as_base64))
            reference = page.render("--width", screen.width, "--height", screen.height)
            different = sum(d > TWO_STEPS for d in screen.differences(reference))  # the corners are rounded
            if different < MOST_DIFFERENT * screen.width * screen.height or time.monotonic() > deadline:
                break
        self.assertLess(different, MOST_DIFFERENT * screen.width * screen.height)
