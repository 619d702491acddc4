"""Lights in the picture: their positions, whether something hides them, and that they can be grabbed."""
import json
import math
import shlex

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

import scenes
from generated import Generated, PageTest

# Two point lights, a spot and a direction, all in the picture; the ball hides one of them.
ROOM = """
version = 1
[observer]
position = [0.0, 0.0, 4.0]
look_at = [0.0, 0.0, 0.0]
fov = 60.0
[image]
width = 160
height = 120
[shading]
model = "phong"
[reflection]
model = "lambert"
[[light]]
name = "near"
type = "point"
position = [-0.8, 0.6, 1.0]
[[light]]
name = "back"
type = "point"
position = [0.0, 0.0, -2.0]
[[light]]
name = "spot"
type = "spot"
position = [1.2, 0.9, 0.0]
direction = [-0.6, -0.8, 0.0]
outer_angle = 30.0
[[light]]
name = "sun"
type = "directional"
direction = [0.0, -1.0, 0.0]
[[light]]
name = "sky"
type = "ambient"
[[object]]
type = "sphere"
radius = 0.5
segments = 32
"""


class Lights(PageTest):
    def load(self, text=ROOM, name="lights"):
        self.generated = Generated(name, text, "lambert")
        self.browser.open(self.generated.address)

    def marker(self, name, part="position"):
        return next(m for m in self.browser.all(f".marker.{part}") if m.accessible_name.startswith(name + ","))

    def center(self, element):
        """In CSS pixels from the middle of the picture, to the right and down."""
        return self.browser.run("""
            const [element, canvas] = [arguments[0], document.getElementById("picture-canvas")].map((e) => e.getBoundingClientRect());
            return [element.x + element.width / 2 - canvas.x - canvas.width / 2, element.y + element.height / 2 - canvas.y - canvas.height / 2];""", element)

    def height(self):
        return self.browser.run("return document.getElementById('picture-canvas').getBoundingClientRect().height")

    def value(self, path):
        self.browser.unfold_all()
        return self.browser.run("""
            return [...document.querySelectorAll(`[data-path="${arguments[0]}"] input[type=number]`)].map((input) => Number(input.value));""", path)

    def test_lights_stand_where_a_pinhole_camera_sees_them(self):
        self.load()
        scale = self.height() / (2 * math.tan(math.radians(30)))
        for name, (x, y, z) in (("near", (-0.8, 0.6, 1.0)), ("back", (0, 0, -2)), ("spot", (1.2, 0.9, 0.0))):
            expected = [scale * x / (4 - z), -scale * y / (4 - z)]
            for a, b in zip(self.center(self.marker(name)), expected):
                self.assertLess(abs(a - b), 1.5, name)
        # The sun is above the ball, and the sky has no position.
        x, y = self.center(self.marker("sun", "direction"))
        self.assertLess(abs(x), 1.5)
        self.assertLess(y, 0)
        self.assertEqual([m for m in self.browser.all(".marker") if m.accessible_name.startswith("sky")], [])
        # The spot's cone: 30 degrees to each side of its axis, so its rulings' ends are as far from the tip as the circle's.
        self.assertGreater(len(self.browser.all(".markers line.light")), 30)
        self.assertEqual(self.browser.errors(), [])

    def test_a_light_behind_an_object_is_told_from_one_that_is_seen(self):
        self.load()
        self.browser.driver.execute_async_script("""
            const done = arguments[0], wait = () => (document.querySelector(".marker.behind") ? done() : setTimeout(wait, 20));
            wait();""")
        hidden = [m.accessible_name.split(",")[0] for m in self.browser.all(".marker.behind")]
        self.assertEqual(hidden, ["back"])
        self.assertIn("behind an object", self.marker("back").accessible_name)

    def test_a_dragged_light_stays_in_its_plane_and_the_picture_is_right(self):
        self.load()
        before = self.picture(self.generated)
        right, down = 40, 25
        ActionChains(self.browser.driver).drag_and_drop_by_offset(self.marker("near"), right, down).perform()
        scale = self.height() / (2 * math.tan(math.radians(30))) / 3
        moved = self.value("light.0.value.position")
        for a, b in zip(moved, (-0.8 + right / scale, 0.6 - down / scale, 1.0)):
            self.assertAlmostEqual(a, b, delta=1.5 / scale)
        self.assertEqual(moved[2], 1)
        self.assert_alike(self.picture(self.generated), self.generated.render("--set", f"light.0.position={json.dumps(moved)}"), "dragged", before=before)
        # It is a change like any other: options, link, and undo.
        options = self.browser.driver.execute_async_script("""
            const done = arguments[0];
            navigator.clipboard.writeText = (text) => { done(text); return Promise.resolve(); };
            document.getElementById("copy-options").click();""")
        option, value = shlex.split(options)
        self.assertEqual(option, "--set")
        self.assertEqual(json.loads(value.removeprefix("light.0.position=")), moved)
        self.browser.click("reset-all")
        self.assertEqual(self.picture(self.generated).pixels, before.pixels)

    def test_a_light_is_moved_by_keys_and_a_direction_is_aimed(self):
        self.load()
        self.marker("near").send_keys(Keys.ARROW_RIGHT)
        x, y, z = self.value("light.0.value.position")
        step = 2 * 3 * math.tan(math.radians(30)) / 50
        self.assertAlmostEqual(x, -0.8 + step, delta=step / 10)
        self.assertEqual([y, z], [0.6, 1])
        self.marker("near").send_keys(Keys.PAGE_UP)
        self.assertLess(self.value("light.0.value.position")[2], 1)
        self.assertIn("near: position", self.browser.text("#status"))
        # To the right of the ball, the sun shines to the left.
        ActionChains(self.browser.driver).drag_and_drop_by_offset(self.marker("sun", "direction"), 60, 40).perform()
        x, y, z = self.value("light.3.value.direction")
        self.assertLess(x, -0.2)
        self.assertAlmostEqual(math.hypot(x, y, z), 1, delta=0.01)
        # Towards the right, the spot shines past the ball.
        before = self.value("light.2.value.direction")
        self.marker("spot", "direction").send_keys(Keys.ARROW_RIGHT)
        self.assertGreater(self.value("light.2.value.direction")[0], before[0])
        self.assertEqual(self.value("light.2.value.position"), [1.2, 0.9, 0])

    def test_a_finger_moves_a_light_and_not_the_view(self):
        self.load()
        at = self.browser.run("const r = arguments[0].getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]", self.marker("near"))
        for kind, points in (("touchStart", [at]), ("touchMove", [[at[0] + 20, at[1]]]), ("touchMove", [[at[0] + 30, at[1] + 10]]), ("touchEnd", [])):
            self.browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [{"x": x, "y": y} for x, y in points]})
        self.assertGreater(self.value("light.0.value.position")[0], -0.75)
        self.assertEqual(self.value("observer.position"), [0, 0, 4])

    def test_what_is_shown_can_be_chosen_and_is_in_the_link(self):
        self.load()
        own = self.picture(self.generated).pixels
        shown = lambda selector: len(self.browser.all(selector))
        self.assertEqual(shown(".markers .room"), 0)
        for name in ("room", "axes", "lights"):
            self.browser.click(f"show-{name}")
        self.assertEqual(shown(".marker"), 0)
        self.assertEqual(shown(".markers line.room"), 8)  # the other four edges are behind the observer
        self.assertEqual(shown(".markers line[class^=axis]"), 3)
        # None of it appears in the picture or in the options.
        self.assertEqual(self.picture(self.generated).pixels, own)
        self.browser.click("copy-options")
        self.assertEqual(self.browser.text("#copy-options"), "No changes to copy")
        self.browser.click("copy-link")
        self.browser.rest(0.1)
        self.browser.open(self.browser.driver.current_url)
        self.assertEqual((shown(".marker"), shown(".markers line[class^=axis]")), (0, 3))

    def test_from_outside_the_observer_and_all_lights_are_in_the_picture(self):
        self.load(scenes.PERSPECTIVE, "outside")
        self.assertIn("outside the picture", self.marker("lamp").accessible_name)
        self.browser.click("show-observer")
        self.browser.rest(0.5)
        names = [m.accessible_name for m in self.browser.all("#outside-canvas + .markers .marker")]
        self.assertEqual([name.split(",")[0] for name in names], ["lamp", "lamp", "sun"])
        self.assertFalse([name for name in names if "outside" in name])
        self.assertIn("0.4, 1.1, 3.6", self.browser.one("#outside-canvas").accessible_name)
        self.assertGreaterEqual(len(self.browser.all("#outside-canvas + .markers line.observer")), 8)
        self.browser.click("show-observer")
        self.assertEqual(self.browser.all("#outside-canvas"), [])
        self.assertEqual(self.browser.errors(), [])
