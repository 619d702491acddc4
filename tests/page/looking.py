"""Keys, mouse and fingers on the picture."""
import base64
import time

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.remote.command import Command

import scenes
from generated import MOST_DIFFERENT, TWO_STEPS, Generated, PageTest, options_for
from pictures import Picture


class Looking(PageTest):
    def setUp(self):
        self.generated = Generated("looking", scenes.PERSPECTIVE)
        self.browser.open(self.generated.address)
        self.browser.unfold_all()
        self.own = self.picture(self.generated)
        self.canvas = self.browser.one("canvas")

    def observer(self):
        return self.browser.run("""
            return [...document.querySelectorAll('[data-path="observer.position"] input[type=number]')].map((i) => Number(i.value));""")

    def assert_moved(self, what):
        page = self.picture(self.generated)
        reference = self.generated.render(*options_for("observer.position", self.observer()))
        self.assert_alike(page, reference, what, before=self.own)

    def assert_back(self):
        self.assertEqual(self.picture(self.generated).pixels, self.own.pixels)

    def test_keyboard(self):
        back = ["0", Keys.HOME]
        for i, key in enumerate((Keys.ARROW_LEFT, Keys.ARROW_RIGHT, Keys.ARROW_UP, Keys.ARROW_DOWN, "+", "-")):
            self.canvas.send_keys(key)
            self.assert_moved(f"key {i}")
            self.canvas.send_keys(back[i % 2])
            self.assert_back()

    def test_over_the_poles(self):
        for _ in range(40):
            self.canvas.send_keys(Keys.ARROW_UP)
        self.assert_moved("up to the pole")

    def test_mouse(self):
        ActionChains(self.browser.driver).drag_and_drop_by_offset(self.canvas, 120, -40).perform()
        self.assert_moved("drag")
        self.browser.click("reset-view")
        self.assert_back()
        ActionChains(self.browser.driver).scroll_from_origin(ScrollOrigin.from_element(self.canvas), 0, -240).perform()
        self.assert_moved("wheel")
        self.browser.click("reset-view")
        self.assert_back()

    def touch(self, *fingers):
        """Each moves straight from one place to another, relative to the picture's centre."""
        at = self.browser.run("const r = arguments[0].getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]", self.canvas)
        there = lambda place: {"x": round(at[0] + place[0]), "y": round(at[1] + place[1])}
        self.browser.driver.execute(Command.W3C_ACTIONS, {"actions": [
            {"type": "pointer", "id": f"finger {i}", "parameters": {"pointerType": "touch"}, "actions": [
                {"type": "pointerMove", "duration": 0, **there(begin)}, {"type": "pointerDown", "button": 0},
                {"type": "pointerMove", "duration": 50, **there(end)}, {"type": "pointerUp", "button": 0}]}
            for i, (begin, end) in enumerate(fingers)]})

    def test_fingers(self):
        self.touch(((0, 0), (60, 20)))
        self.assert_moved("one finger")
        self.browser.click("reset-view")
        self.touch(((-40, 0), (-90, 0)), ((40, 0), (90, 0)))
        self.assert_moved("pinch")
        nearer, own = self.observer(), self.generated.scene["observer"]["position"]
        self.assertLess(abs(nearer[2]), abs(own[2]))

    def turn(self):
        """Presses a key, and waits until a draft has been drawn and timed."""
        self.browser.driver.execute_async_script("""
            const done = arguments[0], { readings } = clock;
            const wait = () => (clock.readings >= readings + 2 ? done() : setTimeout(wait, 5));
            document.querySelector("canvas").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
            wait();""")

    def rest_with(self, width):
        self.browser.driver.execute_async_script("""
            const [width, done] = arguments;
            const wait = () => (document.querySelector("canvas").width === width ? done() : setTimeout(wait, 20));
            wait();""", width)

    def test_slow_frames_are_coarser(self):
        """With a fake clock by which a draft takes a second, it has fewer pixels while the picture is turned, and all once it rests; with
        one by which it takes no time, it always has all."""
        self.addCleanup(self.browser.driver.run_before_pages("""
            window.clock = { time: 0, step: 1000, readings: 0 };
            performance.now = () => { clock.readings += 1; return (clock.time += clock.step); };"""))
        self.browser.open(self.generated.address)
        self.turn()
        whole = self.browser.run("return parseInt(document.querySelector('canvas').style.width)")
        self.rest_with(whole)
        self.browser.run("""
            const canvas = document.querySelector("canvas");
            window.widths = [];
            new MutationObserver(() => widths.push(canvas.width)).observe(canvas, { attributes: true, attributeFilter: ["width"] });""")
        for _ in range(4):
            self.turn()
        self.assertLess(min(self.browser.run("return widths")), 0.2 * whole)
        self.rest_with(whole)
        self.browser.run("clock.step = 0")
        for _ in range(4):
            self.turn()
        self.rest_with(whole)
        self.browser.run("widths.length = 0")
        for _ in range(4):
            self.turn()
        self.assertEqual(self.browser.run("return widths"), [])

    def test_orthographic_zoom(self):
        generated = Generated("zoom", scenes.ORTHOGRAPHIC)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        self.browser.one("canvas").send_keys("+")
        height = float(self.browser.one('[data-path="observer.height"] input').get_attribute("value"))
        self.assertLess(height, 2.6)
        self.assert_alike(self.picture(generated), generated.render("--set", f"observer.height={height}"), "zoom", before=own)

    def test_canvas_shows_it(self):
        """The screen shows the picture, once it no longer changes."""
        self.browser.click("show-lights")  # which lie over it
        deadline = time.monotonic() + 60
        while True:
            self.browser.rest()
            screen = Picture.of_png(base64.b64decode(self.canvas.screenshot_as_base64))
            reference = self.generated.render("--width", screen.width, "--height", screen.height)
            different = sum(d > TWO_STEPS for d in screen.differences(reference))  # the corners are rounded
            if different < MOST_DIFFERENT * screen.width * screen.height or time.monotonic() > deadline:
                break
        self.assertLess(different, MOST_DIFFERENT * screen.width * screen.height)
