"""The page that `candela generate --target webgl` writes, in a browser, beside what `candela render` makes of the same scene.

Run by ctest, which says where things are; by hand: CANDELA=build/release/bin/candela /usr/bin/python3 tests/page/page_test.py
"""
import base64
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.actions.wheel_input import ScrollOrigin
from selenium.webdriver.common.keys import Keys

import scenes
from browser import DRAWS_BY_ITSELF, Browser, scene_of, with_scene
from pictures import Picture

COMMAND = os.environ.get("CANDELA_TEST_COMMAND") or os.environ["CANDELA"]
SCRATCH = pathlib.Path(os.environ.get("CANDELA_TEST_SCRATCH") or tempfile.mkdtemp(prefix="candela-page-")).absolute()
ENVIRONMENT = dict(os.environ, XDG_DATA_HOME=str(SCRATCH / "nothing"), CANDELA_PLUGIN_PATH="")

MOST_DIFFERENT = 0.02  # of the pixels, those beside edges, may differ by more than two steps of 255
TWO_STEPS = 2


def candela(*arguments):
    done = subprocess.run([COMMAND, *map(str, arguments)], env=ENVIRONMENT, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"candela {arguments}: exit code {done.returncode}\n{done.stderr}")


def toml(value):
    return json.dumps(value) if not isinstance(value, bool) else str(value).lower()


class Generated:
    """A scene's file and page."""

    def __init__(self, name, text, models="all", options=()):
        folder = SCRATCH / name
        folder.mkdir(parents=True, exist_ok=True)
        self.file = folder / f"{name}.toml"
        self.file.write_text(text)
        candela("generate", self.file, "--target", "webgl", "--models", models, "-o", folder / "page", *options)
        [self.page] = (folder / "page").glob("*.html")
        self.address = self.page.as_uri()
        self.scene = scene_of(self.page)
        self.size = self.scene["image"]["width"], self.scene["image"]["height"]
        self.rendered = {}

    def render(self, *options):
        if options not in self.rendered:
            path = self.file.with_suffix(".ppm")
            candela("render", self.file, "-o", path, *options)
            self.rendered[options] = Picture.of_ppm(path)
        return self.rendered[options]


def options_for(path, value):
    """The command line that says what a control does."""
    kind, *rest = path.split(".")
    if kind in ("shading", "reflection"):
        return [f"--{kind}", value]
    if kind == "light" and rest[1] == "on":
        return [] if value else ["--set", f"light.{rest[0]}.intensity=0"]
    if kind == "light":
        return ["--set", f"light.{rest[0]}.{rest[2]}={toml(value)}"]
    if kind == "object" and rest[1] in ("material", "shading"):
        return ["--set", f"object.{rest[0]}.{rest[1]}.{rest[3]}={toml(value)}"]
    return ["--set", f"{path}={toml(value)}"]


def another(number, least, most):
    """A number of the same kind that is allowed, and far enough away to be seen."""
    for candidate in (number * 0.5, number * 1.6, number + 0.4, least):
        if least <= candidate <= most and abs(candidate - number) > 1e-3:
            return candidate
    raise AssertionError(f"no other number than {number} from {least} to {most}")


class PageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(*DRAWS_BY_ITSELF)
        cls.addClassCleanup(cls.browser.close)

    def picture(self, generated):
        return self.browser.picture(*generated.size)

    def assert_alike(self, page, reference, what, before=None):
        """`before`: the page's picture before a change; what has become different must be right for the most part."""
        differences = page.differences(reference)
        wrong = sum(d > TWO_STEPS for d in differences)
        self.assertLessEqual(wrong, MOST_DIFFERENT * len(differences), f"{what}: {wrong} of {len(differences)} pixels differ")
        if before is None:
            return
        changed = [wrong for wrong, change in zip(differences, page.differences(before)) if change > 0]
        self.assertTrue(changed, f"{what}: the picture has not changed")
        wrong = sum(d > TWO_STEPS for d in changed)
        self.assertLessEqual(wrong, 0.5 * len(changed), f"{what}: {wrong} of the {len(changed)} pixels that have changed differ")


class Picturing(PageTest):
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
        self.browser.rest()
        shown = self.browser.run("const c = document.querySelector('canvas'); return [c.width, c.height, c.style.width]")
        for width, height in ((1, 1), (97, 61), (61, 97)):
            reference = generated.render("--width", width, "--height", height)
            self.assert_alike(self.browser.picture(width, height), reference, f"{width} x {height}")
        self.assertEqual(
            self.browser.run("const c = document.querySelector('canvas'); return [c.width, c.height, c.style.width]"), shown)
        for width, height in ((0, 10), (10, 1.5), (1 << 20, 10)):
            with self.assertRaises(AssertionError):
                self.browser.picture(width, height)

    def test_sample_positions(self):
        """Beside edges, where samples count, they must be where Candela's are."""
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
        self.assertIn(generated.scene["reflection_models"][reflection]["formula"], self.browser.text("#formulas"))
        self.assertEqual(self.browser.errors(), [])

    def test_defaults_of_other_models(self):
        """What a scene leaves out is another model's default, not that of the scene's own."""
        text = scenes.PERSPECTIVE.replace("kd = 0.55\nks = 0.4\n", "")
        generated = Generated("defaults", text)
        self.browser.open(generated.address)
        self.browser.enter("[data-path=reflection] select", "ashikhmin-shirley")
        self.assert_alike(self.picture(generated), generated.render("--reflection", "ashikhmin-shirley"), "ashikhmin-shirley")


class Controls(PageTest):
    """Each control is driven as a person would, then all is reset."""

    def settings(self):
        return self.browser.run("return [...document.querySelectorAll('.setting')].map((s) => s.dataset.path)")

    def value_shown(self, path):
        return self.browser.run("""
            const setting = document.querySelector(`[data-path="${arguments[0]}"]`);
            const numbers = [...setting.querySelectorAll("input[type=number]")].map((input) => Number(input.value));
            if (numbers.length > 0) return numbers.length === 1 ? numbers[0] : numbers;
            const input = setting.querySelector("input, select");
            if (input.type === "color") return [1, 3, 5].map((at) => parseInt(input.value.slice(at, at + 2), 16));
            return input.type === "checkbox" ? input.checked : input.value;""", path)

    def try_input(self, generated, own, path, selector, value, models=()):
        what = f"{path}, {selector.split('] ')[-1]} = {value}"
        self.browser.enter(selector, value)
        shown = self.value_shown(path)
        page = self.picture(generated)
        self.assert_alike(page, generated.render(*models, *options_for(path, shown)), f"{what}, shown as {shown}", before=own)
        self.assertTrue(self.browser.run("return document.querySelector(arguments[0]).classList.contains('changed')", f'[data-path="{path}"]'), what)

    def inputs(self, path):
        """(selector, type, value, least, most) of a setting's inputs."""
        described = self.browser.run("""
            const setting = document.querySelector(`[data-path="${arguments[0]}"]`);
            return [...setting.querySelectorAll("input, select")].map((input, i) => {
                input.dataset.test = i;
                const options = input.options ? [...input.options].map((option) => option.value) : [];
                return [i, input.type, input.value, input.min, input.max, options];
            });""", path)
        for i, kind, value, least, most, options in described:
            yield f'[data-path="{path}"] [data-test="{i}"]', kind, value, least, most, options

    def new_values(self, path, kind, value, least, most, options):
        if kind == "checkbox":
            return [False]
        if kind == "color":
            return ["#c86414"]
        if kind == "select-one":
            return [option for option in options if option not in ("", value, self.own_model.get(path))]
        if path.endswith(("position", "look_at", "direction", "up", "edge_u", "edge_v")):
            return [float(value) + (0.35 if kind == "number" or float(value) + 0.35 <= float(most) else -0.35)]
        least, most = float(least or "-inf"), float(most or "inf")
        number = another(float(value), least, most)
        return [int(number) if path.endswith(("samples_u", "samples_v", "bands")) else number]

    def try_setting(self, generated, own, path, undo, models=(), kinds=None):
        for selector, kind, value, least, most, options in list(self.inputs(path)):
            if kinds is not None and kind not in kinds:
                continue
            for new in self.new_values(path, kind, value, least, most, options):
                undo()
                list(self.inputs(path))  # these may be made anew, too
                self.try_input(generated, own, path, selector, new, models)

    def reset(self):
        self.browser.click("reset-all")
        self.browser.unfold_all()

    def check_all(self, generated):
        self.browser.open(generated.address)
        self.browser.unfold_all()
        self.own_model = {kind: generated.scene["objects"][-1][kind] for kind in ("shading", "reflection")}
        own = self.picture(generated)
        paths = self.settings()
        expected = {f"object.{i}.color" for i in range(len(generated.scene["objects"]))}
        for i, light in enumerate(generated.scene["lights"]):
            names = [p["name"] for p in generated.scene["light_models"][light["model"]]["parameters"]]
            expected |= {f"light.{i}.on", *(f"light.{i}.value.{name}" for name in names)}
        for i, thing in enumerate(generated.scene["objects"]):
            names = [p["name"] for p in generated.scene["reflection_models"][thing["reflection"]]["parameters"]]
            expected |= {f"object.{i}.material.{thing['reflection']}.{name}" for name in names}
        self.assertLessEqual(expected | {"shading", "reflection"}, set(paths))
        for path in paths:
            with self.subTest(path):
                self.try_setting(generated, own, path, self.reset)
            self.reset()
            self.assertEqual(self.picture(generated).pixels, own.pixels, f"{path}: reset")
        self.assertEqual(self.browser.errors(), [])

    def test_perspective(self):
        self.check_all(Generated("controls-perspective", scenes.PERSPECTIVE))

    def test_orthographic(self):
        self.check_all(Generated("controls-orthographic", scenes.ORTHOGRAPHIC))

    def test_materials_of_other_models(self):
        generated = Generated("materials", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        for model in generated.scene["reflection_models"]:
            def choose():
                self.browser.click("reset-all")
                self.browser.enter("[data-path=reflection] select", model)
                self.browser.unfold_all()
            choose()
            self.own_model = {}
            own = self.picture(generated)
            for path in [p for p in self.settings() if p.startswith(f"object.1.material.{model}.")]:
                with self.subTest(path):
                    self.try_setting(generated, own, path, choose, ("--reflection", model), ("number", "select-one"))

    def test_one_channel(self):
        generated = Generated("channels", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        path = "object.0.material.lambert.kd"
        self.assertEqual(self.value_shown(path), 0.7)
        self.browser.run("document.querySelector(arguments[0]).click()", f'[data-path="{path}"] .split')
        self.assertEqual(self.picture(generated).pixels, own.pixels)
        selector = [s for s, kind, *_ in self.inputs(path) if kind == "number"][1]
        self.try_input(generated, own, path, selector, 0.2)
        self.assertEqual(self.value_shown(path), [0.7, 0.2, 0.7])

    def test_wrong_input(self):
        generated = Generated("wrong", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        own = self.picture(generated)
        wrong = {
            "object.0.material.lambert.kd": ["", "-0.1", "1.1", "1e99"],
            "light.0.value.intensity": ["-1", ""],
            "light.1.value.inner_angle": ["90", "-5"],
            "observer.fov": ["0", "180", "-20"],
        }
        for path, values in wrong.items():
            for value in values:
                selector = [s for s, kind, *_ in self.inputs(path) if kind == "number"][0]
                self.browser.enter(selector, value)
                self.assertEqual(self.picture(generated).pixels, own.pixels, f"{path} = {value}")
                self.assertNotEqual(self.browser.text(f'[data-path="{path}"] .wrong'), "", f"{path} = {value}")
                self.assertEqual(self.browser.one(selector).get_attribute("aria-invalid"), "true")
            self.reset()
        self.assertEqual(self.browser.errors(), [])


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

    def touch(self, kind, *points):
        at = self.browser.run("const r = arguments[0].getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2]", self.canvas)
        places = [{"x": at[0] + x, "y": at[1] + y, "id": i} for i, (x, y) in enumerate(points)]
        self.browser.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": kind, "touchPoints": places})

    def test_fingers(self):
        self.touch("touchStart", (0, 0))
        self.touch("touchMove", (60, 20))
        self.touch("touchEnd")
        self.assert_moved("one finger")
        self.browser.click("reset-view")
        self.touch("touchStart", (-40, 0), (40, 0))
        self.touch("touchMove", (-90, 0), (90, 0))
        self.touch("touchEnd")
        self.assert_moved("pinch")
        nearer, own = self.observer(), self.generated.scene["observer"]["position"]
        self.assertLess(abs(nearer[2]), abs(own[2]))

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
        """What is on the screen is the picture, once it has come to rest."""
        self.browser.rest()
        png = base64.b64decode(self.canvas.screenshot_as_base64)
        screen = Picture.of_png(png)
        reference = self.generated.render("--width", screen.width, "--height", screen.height)
        differences = screen.differences(reference)  # the corners are rounded
        self.assertLess(sum(d > TWO_STEPS for d in differences), MOST_DIFFERENT * len(differences))


class Links(PageTest):
    def link(self, entries, version=1):
        packed = base64.urlsafe_b64encode(json.dumps({"version": version, "set": entries}).encode()).decode().rstrip("=")
        return "#s=" + packed

    def notice(self):
        return self.browser.run("const n = document.getElementById('notice'); return n.hidden ? '' : n.textContent")

    def test_round_trip(self):
        generated = Generated("links", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        own = self.picture(generated)
        self.browser.unfold_all()
        self.browser.enter("[data-path=shading] select", "flat")
        self.browser.enter("[data-path=reflection] select", "oren-nayar")
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.1.material.oren-nayar.form"] select', "fujii")
        self.browser.enter('[data-path="light.1.value.color"] input', "#ff8040")
        self.browser.enter('[data-path="light.0.on"] input', False)
        self.browser.enter('[data-path="object.2.color"] input', "#102030")
        self.browser.one("canvas").send_keys(Keys.ARROW_LEFT, "-")
        changed = self.picture(generated)
        self.assertNotEqual(changed.pixels, own.pixels)
        self.browser.click("copy-link")
        self.browser.rest(0.1)
        self.assertIn("link", self.browser.text("#status"))
        address = self.browser.driver.current_url
        self.assertIn("#s=", address)
        self.browser.open(address)
        self.assertEqual(self.picture(generated).pixels, changed.pixels)
        self.assertEqual(self.notice(), "")
        self.browser.unfold_all()
        self.assertEqual(self.browser.one("[data-path=shading] select").get_attribute("value"), "flat")
        self.browser.click("reset-all")
        self.assertEqual(self.picture(generated).pixels, own.pixels)
        self.assertNotIn("#", self.browser.driver.current_url)
        # In the page that is open.
        self.browser.run("location.hash = arguments[0]", address[address.index("#"):])
        self.browser.rest(0.1)
        self.assertEqual(self.picture(generated).pixels, changed.pixels)
        self.browser.run("location.hash = ''")
        self.browser.rest(0.1)
        self.assertEqual(self.picture(generated).pixels, own.pixels)

    def test_wrong_links(self):
        generated = Generated("wrong-links", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        own = self.picture(generated)
        for fragment in ("#s=", "#s=!!!", "#s=AAAA", "#s=bnVsbA", self.link({}, version=2), self.link(None)):
            self.browser.open(generated.address + fragment)
            self.assertEqual(self.picture(generated).pixels, own.pixels, fragment)
            self.assertIn("cannot be read", self.notice(), fragment)
        refused = {
            "light.0.value.intensity": -5, "light.7.on": False, "light.0.value.toString": 1, "object.__proto__.color": [1, 2, 3],
            "__proto__": 1, "constructor.prototype.x": 1, "object.0.color": "red", "object.1.material.blinn-phong.kd": [0, 0],
            "shading": "<img>", "reflection": None, "light.1.value.direction": [0, 0, 0], "observer.fov": 360,
            "observer.position": [0, -0.1, 0], "object.0.material.lambert.kd": 1e40, "light.length.on": False, "": 3,
        }
        for path, value in refused.items():
            self.browser.open(generated.address + self.link({path: value}))
            self.assertEqual(self.picture(generated).pixels, own.pixels, path)
            self.assertIn("left out", self.notice(), path)
        self.browser.open(generated.address + self.link({"light.0.value.intensity": -5, "object.0.color": [1, 2, 3]}))
        self.assert_alike(self.picture(generated), generated.render("--set", "object.0.color=[1,2,3]"), "what is left", before=own)
        self.assertEqual(self.browser.errors(), [])


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
        """Whatever stands in the data is text."""
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
        """The page goes on working, and says what is wrong for as long as it is."""
        def spoil(scene):
            scene["reflection_models"]["toon"]["glsl"] += "\nfloat oops = nonsense;"
        generated = Generated("chosen", scenes.PERSPECTIVE)
        self.browser.open(with_scene(generated.page, SCRATCH / "chosen.html", spoil))
        self.browser.enter("[data-path=reflection] select", "toon")
        self.browser.rest(0.8)
        self.assertIn("Toon", self.browser.one("#problem-text").text)
        self.browser.enter("[data-path=reflection] select", "phong")
        self.browser.rest(0.8)
        self.assertFalse(self.browser.one("#problem-box").is_displayed())
        self.assert_alike(self.picture(generated), generated.render("--reflection", "phong"), "afterwards")

    def test_too_many_lights(self):
        lights = "".join(f'[[light]]\ntype = "point"\nposition = [{i / 1000:.4f}, 2.0, 2.0]\n' for i in range(3000))
        generated = Generated("lights", scenes.PERSPECTIVE.replace("[[object]]", lights + "[[object]]", 1), "phong")
        self.browser.load(generated.address)
        self.assertIn("cannot compile", self.browser.problem())
        self.assertTrue(self.browser.one("#problem-text").is_displayed())

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
        browser = Browser("--disable-3d-apis")
        self.addCleanup(browser.close)
        browser.load(generated.address)
        self.assertIn("WebGL 2", browser.problem())
        self.assertTrue(browser.one("#problem-text").is_displayed())
        self.assertIn("WebGL 2", browser.text("#problem"))


class Access(PageTest):
    def test_phone(self):
        generated = Generated("phone", scenes.PERSPECTIVE)
        self.addCleanup(self.browser.resize, 1280, 800)
        for width, height in ((390, 844), (320, 568), (844, 390)):
            self.browser.resize(width, height, is_phone=True)
            self.browser.open(generated.address)
            self.browser.unfold_all()
            self.assertLessEqual(self.browser.run("return document.documentElement.scrollWidth"), width)
            cut = self.browser.run("""
                return [...document.querySelectorAll("aside *")].filter((e) => e.getBoundingClientRect().right > innerWidth + 0.5).length;""")
            self.assertEqual(cut, 0)
            top, bottom = self.browser.run("const r = document.querySelector('canvas').getBoundingClientRect(); return [r.top, r.bottom]")
            self.assertGreaterEqual(top, 0)
            self.assertLessEqual(bottom, height)

    def test_names(self):
        generated = Generated("names", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.browser.unfold_all()
        controls = self.browser.all("canvas, input, select, button, summary")
        self.assertGreater(len(controls), 50)
        for control in controls:
            if control.is_displayed():
                self.assertNotEqual(control.accessible_name.strip(), "", control.get_attribute("outerHTML"))
        self.assertIn("arrows", self.browser.text("#" + self.browser.one("canvas").get_attribute("aria-describedby")))
        self.assertEqual(self.browser.run("return new Set([...document.querySelectorAll('[id]')].map((e) => e.id)).size"),
                         len(self.browser.all("[id]")))

    def test_focus_order(self):
        generated = Generated("focus", scenes.ORTHOGRAPHIC)
        self.browser.open(generated.address)
        expected = self.browser.run("""
            const all = [...document.querySelectorAll("canvas, input, select, button, summary")].filter((e) => e.checkVisibility());
            all.forEach((e, i) => (e.dataset.order = i));
            return all.length;""")
        seen = []
        for _ in range(expected):
            ActionChains(self.browser.driver).send_keys(Keys.TAB).perform()
            seen.append(self.browser.run("return document.activeElement.dataset.order ?? document.activeElement.outerHTML"))
        self.assertEqual(seen, [str(i) for i in range(expected)])
        self.assertEqual(self.browser.run("return document.querySelector('[data-order=\"0\"]').tagName"), "CANVAS")


if __name__ == "__main__":
    unittest.main()
