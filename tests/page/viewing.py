"""The page that `candela view` serves, in a browser, while its scene's files are saved."""
import base64
import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import unittest

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

import scenes
from browser import DRAWS_BY_ITSELF, Browser
from generated import COMMAND, ENVIRONMENT, MOST_DIFFERENT, SCRATCH, SMALL_WINDOW, TWO_STEPS, candela, options_for
from pictures import Picture

LONGEST = 20  # seconds, on a busy machine


# The picture twice along each side.
TEXTURED_SQUARE = """mtllib square.mtl
v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0
vt 0 0\nvt 2 0\nvt 2 2\nvt 0 2
usemtl tiles
f 1/1 2/2 3/3 4/4
"""


def tiles_ppm(red, step):
    """Eight by eight pixels."""
    colors = [(red, (step * x) % 256, (step * y) % 256) for y in range(8) for x in range(8)]
    return b"P6\n8 8\n255\n" + b"".join(map(bytes, colors))


def save(file, text):
    """Saves like editors do: writes a temporary file, then renames it."""
    draft = file.with_suffix(".draft")
    draft.write_text(text)
    os.replace(draft, file)


class Viewing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(*DRAWS_BY_ITSELF)
        cls.addClassCleanup(cls.browser.close)
        cls.browser.resize(*SMALL_WINDOW)

    def setUp(self):
        self.folder = SCRATCH / "viewing" / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.file = self.folder / "scene.toml"
        self.file.write_text(scenes.PERSPECTIVE)
        self.folder.joinpath("tmp").mkdir()

    def view(self):
        environment = dict(ENVIRONMENT, TMPDIR=str(self.folder / "tmp"))
        with open(self.folder / "log.txt", "w") as log:
            server = subprocess.Popen([COMMAND, "view", "--no-open", str(self.file)], env=environment, stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=log, text=True)
        self.addCleanup(self.end, server)
        self.server = server
        self.address = server.stdout.readline().strip()
        # Connections of the previous test's page end with it.
        self.browser.load(self.address)

    def end(self, server):
        if server.poll() is None:
            server.send_signal(signal.SIGINT)
        self.assertEqual(server.wait(LONGEST), 0)
        server.stdout.close()
        self.assertEqual(list(self.folder.joinpath("tmp").iterdir()), [])

    def wait_for(self, condition, *arguments):
        self.browser.wait_for(condition, *arguments)

    def wait_until_shown(self, generation):
        self.wait_for("document.readyState === 'complete' && window.candela && location.search === `?live=${values[0]}`", generation)
        self.assertIsNone(self.browser.problem())

    def assert_shows(self, *options):
        """Checks that the page's picture matches the renderer's."""
        reference = self.folder / "reference.ppm"
        candela("render", self.file, "-o", reference, *options)
        reference = Picture.of_ppm(reference)
        page = self.browser.picture(reference.width, reference.height)
        differences = page.differences(reference)
        self.assertLessEqual(sum(d > TWO_STEPS for d in differences), MOST_DIFFERENT * len(differences))

    def problems(self):
        self.wait_for("!document.getElementById('scene-problems').hidden")
        return self.browser.text("#scene-problems-text")

    def changed(self, old, new, file=None):
        file = file or self.file
        text = file.read_text()
        self.assertIn(old, text)
        save(file, text.replace(old, new))

    def test_what_is_saved_is_on_the_screen(self):
        self.view()
        self.wait_until_shown(1)
        self.assert_shows()
        self.changed(self.scene_color(), "color = [10, 200, 30]")
        self.wait_until_shown(2)
        self.assert_shows()
        # In place, as some editors write, and a comment without effect.
        self.file.write_text("# Another colour.\n" + self.file.read_text().replace("[10, 200, 30]", "[10, 20, 230]"))
        self.wait_until_shown(3)
        self.assert_shows()
        self.assertEqual(self.browser.errors(), [])

    def test_objects_become_see_through_and_opaque_again(self):
        """Films for scenes with layers are of another kind."""
        self.view()
        self.wait_until_shown(1)
        self.browser.wait_for_pictures()
        for generation, (old, new) in enumerate((("kd = 0.6\n", "kd = 0.6\nopacity = 0.5\n"), ("opacity = 0.5\n", "")), start=2):
            self.changed(old, new)
            self.wait_until_shown(generation)
            self.browser.wait_for_pictures()
            self.assertIsNone(self.browser.problem())
            self.assert_shows()
        self.assertEqual(self.browser.errors(), [])

    def scene_color(self):
        text = self.file.read_text()
        object_at = text.index("[[object]]")
        begin = text.index("color = ", object_at)
        return text[begin:text.index("]", begin) + 1]

    def test_a_broken_save_leaves_the_last_good_picture_and_says_why(self):
        self.view()
        self.wait_until_shown(1)
        before = self.browser.picture(64, 48).pixels
        good = self.file.read_text()
        save(self.file, good.replace("[[light]]", "[[lihgt]]", 1))
        text = self.problems()
        self.assertIn("scene.toml:", text)
        self.assertIn("lihgt", text)
        self.assertEqual(self.browser.picture(64, 48).pixels, before)
        save(self.file, good)
        self.wait_for("document.getElementById('scene-problems').hidden")
        self.changed(self.scene_color(), "color = [200, 20, 30]")
        self.wait_until_shown(2)
        self.assert_shows()

    def test_a_scene_that_is_broken_at_first_is_shown_once_it_is_mended(self):
        good = self.file.read_text()
        self.file.write_text("version = 1\nrooom = 3\n")
        self.view()
        self.wait_for("document.getElementById('scene-problems-text').textContent.includes('rooom')")
        save(self.file, good)
        self.wait_until_shown(1)
        self.assert_shows()

    def test_a_model_is_shown_with_its_texture_which_is_followed_too(self):
        self.file = self.folder / "square.obj"
        self.file.write_text(TEXTURED_SQUARE)
        (self.folder / "square.mtl").write_text("newmtl tiles\nKd 1 1 1\nmap_Kd tiles.ppm\n")
        tiles = self.folder / "tiles.ppm"
        tiles.write_bytes(tiles_ppm(200, 60))
        self.view()
        self.wait_until_shown(1)
        self.assert_shows()
        first = self.browser.picture(64, 48).pixels
        tiles.write_bytes(tiles_ppm(30, 120))
        self.wait_until_shown(2)
        self.assert_shows()
        self.assertNotEqual(self.browser.picture(64, 48).pixels, first)
        self.assertEqual(self.browser.errors(), [])

    def test_the_view_and_what_was_changed_in_the_page_stay(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.one("canvas").send_keys("+")
        position = self.browser.run("""
            return [...document.querySelectorAll('[data-path="observer.position"] input[type=number]')].map((i) => Number(i.value));""")
        self.changed(self.scene_color(), "color = [30, 40, 220]")
        self.wait_until_shown(2)
        self.assert_shows(*options_for("observer.position", position))
        # Open parts are still open.
        self.assertTrue(self.browser.all('[data-path="observer.position"]'))

    def test_included_files_are_followed_too_and_deleted_ones_are_missed(self):
        included = self.folder / "lights" / "more.toml"
        included.parent.mkdir()
        light = '[[light]]\ntype = "ambient"\ncolor = [255, 255, 255]\nintensity = 0.5\n'
        included.write_text(light)
        self.file.write_text('include = ["lights/more.toml"]\n' + self.file.read_text())
        self.view()
        self.wait_until_shown(1)
        save(included, light.replace("0.5", "2.5"))
        self.wait_until_shown(2)
        self.assert_shows()
        included.unlink()
        self.assertIn("more.toml", self.problems())
        included.write_text(light)
        self.wait_until_shown(3)
        self.assert_shows()

    def compare(self, mode):
        """The page's text about the reference render."""
        self.browser.enter("#reference-mode", mode)
        self.wait_for("!document.getElementById('reference-canvas').hidden")
        return self.browser.text("#reference-text")

    def test_candelas_own_picture_stands_beside_the_pages_with_what_was_changed_in_it(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.one("canvas").send_keys("+")
        self.browser.enter('[data-path="reflection"] select', "half-lambert")
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        text = self.compare("difference")
        differing, of = map(int, re.match(r"(\d+) of (\d+) pixels differ", text).groups())
        self.assertLessEqual(differing, MOST_DIFFERENT * of, text)
        heat = self.browser.run("""
            const canvas = document.getElementById("reference-canvas"), data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
            return [canvas.width, canvas.height, data.reduce((sum, value, i) => sum + (i % 4 < 3 && value > 0 ? 1 : 0), 0)];""")
        self.assertEqual(heat[0] * heat[1], of)
        self.assertLess(heat[2], 3 * 0.2 * of)
        # The picture itself: the one that candela render makes of these options.
        options = self.browser.driver.execute_async_script("""
            const done = arguments[0];
            navigator.clipboard.writeText = (text) => { done(text); return Promise.resolve(); };
            document.getElementById("copy-options").click();""")
        self.assertIn("--reflection half-lambert", options)
        reference = self.folder / "reference.ppm"
        candela("render", self.file, "-o", reference, *shlex.split(options))
        reference = Picture.of_ppm(reference)
        self.compare("wipe")
        shown = self.browser.run("""
            const canvas = document.getElementById("reference-canvas");
            return [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data];""")
        shown = bytes(value for i, value in enumerate(shown) if i % 4 < 3)
        self.assertEqual(shown, bytes(reference.pixels))
        self.assertIn("inset(", self.browser.run("return document.getElementById('reference-canvas').style.clipPath"))
        # Messages take room from the picture; the two stay aligned.
        self.changed("[[light]]", "[[lihgt]]")
        self.problems()
        self.wait_for("""(() => {
            const [a, b] = ["picture-canvas", "reference-canvas"].map((id) => document.getElementById(id).getBoundingClientRect());
            return ["left", "top", "width", "height"].every((side) => Math.abs(a[side] - b[side]) < 1);
        })()""")

    def test_a_term_of_the_picture_is_shown_in_its_place(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        self.compare("wipe")
        sky = self.browser.run('return [...document.querySelectorAll("#reference-term option")].find((o) => o.value === "light.0").textContent')
        self.assertEqual(sky, "sky alone")
        for term in ("diffuse", "light.0", "depth"):
            with self.subTest(term):
                self.browser.enter("#reference-term", term)
                self.wait_for("!document.getElementById('reference-canvas').hidden")
                picture = self.folder / "picture.ppm"
                candela("render", self.file, "-o", picture, "--terms", term, "--set", "object.0.color=[32,192,64]")
                expected = Picture.of_ppm(self.folder / f"picture.{term}.ppm")
                shown = self.browser.run("""
                    const canvas = document.getElementById("reference-canvas");
                    return [...canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data];""")
                self.assertEqual(bytes(value for i, value in enumerate(shown) if i % 4 < 3), bytes(expected.pixels))
        # Differences are computed only for whole pictures.
        self.assertIn("pixels differ", self.compare("difference"))
        self.assertFalse(self.browser.one("#reference-term").is_displayed())

    def explained(self):
        self.wait_for("document.querySelector('#explanation-result .bytes') || document.querySelector('.plain-problem')")
        return [int(byte) for byte in self.browser.text("#explanation-result .bytes").split(",")]

    def test_a_pixel_that_is_clicked_is_explained_down_to_its_byte(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        reference = self.folder / "reference.ppm"
        candela("render", self.file, "-o", reference, "--set", "object.0.color=[32,192,64]")
        reference = Picture.of_ppm(reference)
        byte = lambda x, y: list(reference.pixels[3 * (y * reference.width + x):][:3])
        canvas = self.browser.one("#picture-canvas")
        # Somewhere on the object that is green now.
        greens = [(x, y) for y in range(reference.height) for x in range(reference.width) if byte(x, y)[1] > 2 * max(byte(x, y)[0], byte(x, y)[2], 20)]
        aim = greens[len(greens) // 2]
        size = self.browser.run("const box = arguments[0].getBoundingClientRect(); return [box.width, box.height];", canvas)
        offset = [(aim[0] + 0.5) / reference.width * size[0] - size[0] / 2, (aim[1] + 0.5) / reference.height * size[1] - size[1] / 2]

        def click():
            self.browser.run("arguments[0].scrollIntoView()", canvas)
            ActionChains(self.browser.driver).move_to_element_with_offset(canvas, *map(round, offset)).click().perform()

        click()
        bytes_shown = self.explained()
        x, y = (int(self.browser.run(f"return document.getElementById('explanation-{axis}').value")) for axis in "xy")
        self.assertLessEqual(abs(x - aim[0]) + abs(y - aim[1]), 4)
        self.assertEqual(bytes_shown, byte(x, y))
        # Its point and vectors are drawn in the picture where the pixel is.
        names = self.browser.run("return [...document.querySelectorAll('#arrows text')].map((e) => e.textContent)")
        self.assertEqual(names[:2], ["N", "V"])
        off = self.browser.run("""
            const origin = document.querySelector(".arrow-origin").getBoundingClientRect(), canvas = document.getElementById("picture-canvas").getBoundingClientRect();
            return [origin.x + origin.width / 2 - canvas.x - canvas.width / 2, origin.y + origin.height / 2 - canvas.y - canvas.height / 2];""")
        self.assertLess(max(abs(a - b) for a, b in zip(off, offset)), 6)
        # Another one by keyboard; Escape ends it, and so does a change.
        self.browser.enter("#explanation-x", "3")
        self.browser.enter("#explanation-y", "2")
        self.browser.one("#explanation-y").send_keys(Keys.ENTER)
        self.assertEqual(self.explained(), byte(3, 2))
        self.assertIn("background", self.browser.text("#explanation-result"))
        self.browser.one("#explanation-y").send_keys(Keys.ESCAPE)
        self.assertEqual(self.browser.text("#explanation-result"), "")
        click()
        self.explained()
        canvas.send_keys(Keys.ARROW_LEFT)
        self.assertEqual(self.browser.text("#explanation-result"), "")
        self.assertEqual(self.browser.errors(), [])

    def test_a_pixel_of_another_pane_is_explained_with_what_that_pane_shows(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.enter("#panes-layout", "two")
        self.browser.enter('[data-path="pane.1.reflection"] select', "toon")
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        # Once both are drawn, they have their sizes and no longer move.
        self.wait_for("""(() => {
            const [a, b] = ["#picture-canvas", "canvas.pane"].map((name) => document.querySelector(name).getBoundingClientRect());
            return a.width === b.width && a.height === b.height && a.width < innerWidth / 2;
        })()""")
        pictures = []
        for options in ((), ("--reflection", "toon")):
            candela("render", self.file, "-o", self.folder / "pane.ppm", "--set", "object.0.color=[32,192,64]", *options)
            pictures.append(Picture.of_ppm(self.folder / "pane.ppm"))
        byte = lambda picture, x, y: list(picture.pixels[3 * (y * picture.width + x):][:3])
        one, toon = pictures
        different = [(x, y) for y in range(one.height) for x in range(one.width) if byte(one, x, y) != byte(toon, x, y)]
        aim = different[len(different) // 2]
        for index, selector, picture in ((1, "canvas.pane", toon), (0, "#picture-canvas", one)):
            canvas = self.browser.one(selector)
            size = self.browser.run("const box = arguments[0].getBoundingClientRect(); return [box.width, box.height];", canvas)
            offset = [(at + 0.5) / whole * side - side / 2 for at, whole, side in zip(aim, (picture.width, picture.height), size)]
            self.browser.run("arguments[0].scrollIntoView()", canvas)
            ActionChains(self.browser.driver).move_to_element_with_offset(canvas, *map(round, offset)).click().perform()
            shown = self.explained()
            x, y = (int(self.browser.run(f"return document.getElementById('explanation-{axis}').value")) for axis in "xy")
            self.assertEqual(shown, byte(picture, x, y), f"pane {index}")
            self.assertIn(f"Pane {'AB'[index]}, pixel {x}, {y}", self.browser.text("#explanation-result"))
            off = self.browser.run("""
                const origin = document.querySelector(".arrow-origin").getBoundingClientRect(), canvas = arguments[0].getBoundingClientRect();
                return [origin.x + origin.width / 2 - canvas.x - canvas.width / 2, origin.y + origin.height / 2 - canvas.y - canvas.height / 2];""", canvas)
            self.assertLess(max(abs(a - b) for a, b in zip(off, offset)), 6)
        # Also by keyboard.
        self.browser.enter("#explanation-pane", "1")
        for axis, at in zip("xy", aim):
            self.browser.enter(f"#explanation-{axis}", str(at))
        self.browser.one("#explanation-y").send_keys(Keys.ENTER)
        self.assertEqual(self.explained(), byte(toon, *aim))
        # With one picture, there is no other to choose.
        self.browser.enter("#panes-layout", "one")
        self.assertFalse(self.browser.one("#explanation-pane").is_displayed())
        self.assertEqual(self.browser.errors(), [])

    def test_lobes_are_what_the_model_reflects_of_a_light_in_all_directions(self):
        self.file.write_text(scenes.PERSPECTIVE.replace("blinn-phong", "phong"))
        x, y = 54, 60

        def sun_on_ball(*options):
            text = subprocess.check_output([COMMAND, "explain", self.file, "--pixel", f"{x},{y}", "--json", "--quiet", *options], env=ENVIRONMENT)
            fragment = json.loads(text)["fragments"][0]
            self.assertEqual(fragment["object"], "'ball'")
            point = fragment["points"][0]
            return point, next(light for light in point["lights"] if light["light"] == "'sun'")

        point, light = sun_on_ball()
        self.view()
        self.wait_until_shown(1)
        self.browser.enter("#explanation-x", str(x))
        self.browser.enter("#explanation-y", str(y))
        self.browser.one("#explanation-form button").click()
        self.explained()
        lights = self.browser.run('return [...document.querySelectorAll("#explanation-result label")].find((e) => e.textContent === "Light").htmlFor')
        option = self.browser.run("return [...document.getElementById(arguments[0]).options].find((o) => o.textContent === 'sun').value", lights)
        self.browser.enter(f"#{lights}", option)

        # Phong (1975) for the ball's kd, ks and shininess, over the angles of the plane of incidence.
        luminance = lambda color: 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]
        n_dot_l = light["N.L"]
        diffuse = 0.6 * n_dot_l * luminance([c * i for c, i in zip(point["C_o"], light["diffuse"])])
        specular = 0.35 * luminance(light["specular"])
        phong = lambda angle: diffuse + specular * max(0.0, math.cos(angle - math.acos(n_dot_l))) ** 20
        peak = phong(math.acos(n_dot_l))
        curve = lambda i: [[float(c) for c in xy.split(",")] for xy in self.browser.run(
            "return document.querySelectorAll('.lobe-diagram .curve')[arguments[0]].getAttribute('points')", i).split()[1:]]
        self.assertGreater(len(curve(0)), 180)
        for right, down in curve(0):
            self.assertAlmostEqual(math.hypot(right, down) / 100, phong(math.atan2(right, -down)) / peak, delta=2e-3)
        numbers = lambda: [float(x) for x in re.findall(r"(?:at most|observer:) ([0-9.e-]+)", self.browser.text(".lobe figcaption"))]
        towards_observer = luminance([d + s for d, s in zip(light["I_d"], light["I_s"])])
        for shown, expected in zip(numbers(), (peak, towards_observer), strict=True):
            self.assertAlmostEqual(shown, expected, delta=2e-3 * peak)
        # Lambert's is the same in all directions: a part of a circle.
        self.browser.enter(".lobe-choices select", "lambert")
        lambert = luminance(sun_on_ball("--reflection", "lambert")[1]["I_d"])
        self.assertAlmostEqual(numbers()[1], lambert, delta=2e-3 * lambert)
        for right, down in curve(1):
            self.assertAlmostEqual(math.hypot(right, down) / 100, lambert / max(lambert, peak), delta=2e-3)
        # With four decades, a hundredth is half as far out.
        self.browser.one(".lobe-choices input").click()
        for right, down in curve(0):
            share = phong(math.atan2(right, -down)) / max(lambert, peak)
            self.assertAlmostEqual(math.hypot(right, down) / 100, 1 + math.log10(share) / 4, delta=2e-3)

        # The page's picture is still there.
        seen = Picture.of_png(self.browser.one("#picture-canvas").screenshot_as_png)
        beside_it = 3 * (seen.width * (seen.height // 2) + 10)
        self.assertEqual(list(seen.pixels[beside_it:beside_it + 3]), [30, 40, 60])

        # The surface is at the point, above the ball, and disappears with the explanation.
        covered = lambda: self.browser.run("""
            const canvas = document.getElementById("lobe-canvas"), { width, height } = canvas;
            const alphas = canvas.getContext("2d").getImageData(0, 0, width, height).data.filter((_, i) => i % 4 === 3);
            return [...alphas.keys()].filter((i) => alphas[i] > 100).map((i) => [i % width, Math.floor(i / width)]);""")
        places = covered()
        self.assertGreater(len(places), 50)
        self.assertTrue(all(abs(px - x) < 40 and abs(py - y) < 40 for px, py in places))
        self.assertLess(min(abs(px - x) + abs(py - y) for px, py in places), 4)
        self.browser.one("#explanation-close").click()
        self.assertEqual(covered(), [])
        self.assertEqual(self.browser.errors(), [])
        self.assert_shows()

    def test_an_explanations_formulas_have_the_numbers_of_its_point(self):
        self.file.write_text(scenes.PERSPECTIVE.replace("blinn-phong", "phong"))
        text = subprocess.check_output([COMMAND, "explain", self.file, "--pixel", "54,60", "--json", "--quiet"], env=ENVIRONMENT)
        explained = json.loads(text)
        point = explained["fragments"][0]["points"][0]
        light = next(light for light in point["lights"] if light["light"] == "'sun'")
        self.view()
        self.wait_until_shown(1)
        self.browser.enter("#explanation-x", "54")
        self.browser.enter("#explanation-y", "60")
        self.browser.one("#explanation-form button").click()
        self.explained()
        lights = self.browser.run('return [...document.querySelectorAll("#explanation-result label")].find((e) => e.textContent === "Light").htmlFor')
        option = self.browser.run("return [...document.getElementById(arguments[0]).options].find((o) => o.textContent === 'sun').value", lights)
        self.browser.enter(f"#{lights}", option)
        # Each line of a formula: the formula, with numbers, its value.
        lines = self.browser.run("""
            return [...document.querySelectorAll("#explanation-result .formula-steps")].map((line) =>
                [...line.querySelectorAll("math")].map((math) => math.textContent));""")
        numbers = lambda said: [float(x.replace("−", "-")) for x in re.findall(r"[0-9.]+(?:e[-+]?\d+)?", said)]
        named = lambda name: next(line for line in lines if line[0].startswith(name + "="))
        dot = lambda a, b: sum(x * y for x, y in zip(a, b))

        def assert_near(said, expected):
            self.assertEqual(len(said), len(expected), said)
            for a, b in zip(said, expected):
                self.assertAlmostEqual(a, b, delta=6e-4 * abs(b) + 1e-6)

        # Phong (1975): ks I_L max(R.V, 0)^shininess.
        _, with_numbers, value = named("Is")
        magnitude = abs(dot(light["R"], point["V"]))
        assert_near(numbers(with_numbers), [0.35, *light["specular"], magnitude, 0, 20])
        assert_near(numbers(value), light["I_s"] if len(set(light["I_s"])) > 1 else light["I_s"][:1])
        _, with_numbers, value = named("Id")
        assert_near(numbers(with_numbers), [0.6, *point["C_o"], *light["diffuse"], light["N.L"], 0])
        assert_near(numbers(value), light["I_d"])
        # The sum, and the bytes with the curve of IEC 61966-2-1.
        _, with_numbers, value = named("I")
        assert_near(numbers(value), point["I"])
        curves = self.browser.run("""
            return [...document.querySelectorAll("#explanation-result .formula:not(:has(.formula-steps)) math:last-child")].map((math) => math.textContent)""")
        self.assertEqual([int(curve.split("→")[1]) for curve in curves], explained["bytes"])
        self.assertEqual(self.browser.errors(), [])

    def save_changes(self):
        self.browser.one("#save-scene").click()
        self.wait_for("!document.getElementById('save-scene').disabled")

    def test_what_was_changed_in_the_page_is_saved_to_the_file_and_the_file_has_changed_only_there(self):
        before = "# A comment.\n" + self.file.read_text()
        self.file.write_text(before)
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        self.browser.enter('[data-path="light.0.value.intensity"] input', "0.875")
        self.save_changes()
        self.wait_until_shown(2)
        after = self.file.read_text()
        self.assertIn("color = [32, 192, 64]", after)
        self.assertIn("intensity = 0.875", after)
        old, new = before.splitlines(), after.splitlines()
        self.assertLessEqual(len([line for line in new if line not in old]), 2)
        self.assertLessEqual(len([line for line in old if line not in new]), 2)
        # The page has nothing left to save, and shows the file.
        self.assertEqual(self.browser.run("return document.getElementById('notice').hidden"), True)
        self.assert_shows()
        self.browser.one("#save-scene").click()
        self.wait_for("document.getElementById('save-scene').textContent === 'No changes to save'")
        self.assertEqual(self.file.read_text(), after)

    def test_a_light_is_dragged_and_saved_and_the_file_has_changed_only_there(self):
        before = "# A comment.\n" + self.file.read_text()
        self.file.write_text(before)
        self.view()
        self.wait_until_shown(1)
        lamp = next(m for m in self.browser.all(".marker.position") if m.get_attribute("aria-label").startswith("lamp,"))
        ActionChains(self.browser.driver).drag_and_drop_by_offset(lamp, 12, 9).perform()
        self.save_changes()
        self.wait_until_shown(2)
        after = self.file.read_text()
        old, new = before.splitlines(), after.splitlines()
        [changed] = [i for i, (a, b) in enumerate(zip(old, new, strict=True)) if a != b]
        self.assertEqual(old[changed], "position = [-1.5, 2.4, 2.0]")
        moved = json.loads(new[changed].removeprefix("position = "))
        self.assertNotEqual(moved, [-1.5, 2.4, 2.0])
        # In the plane through the lamp that faces the observer.
        forward = [a - b for a, b in zip((0.0, -0.1, 0.0), (0.4, 1.1, 3.6))]
        away = sum(f * (a - b) for f, a, b in zip(forward, moved, (-1.5, 2.4, 2.0))) / math.hypot(*forward)
        self.assertLess(abs(away), 0.1 * math.dist(moved, (-1.5, 2.4, 2.0)))
        self.assert_shows()

    def test_a_light_that_was_switched_off_is_off_in_the_file(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.one('[data-path="light.0.on"] input').click()
        self.save_changes()
        self.wait_until_shown(2)
        self.assertIn("intensity = 0\n", self.file.read_text())
        self.assert_shows()
        self.browser.one("#save-scene").click()
        self.wait_for("document.getElementById('save-scene').textContent === 'No changes to save'")

    def test_what_cannot_be_saved_is_said_and_the_changes_stay(self):
        self.view()
        self.wait_until_shown(1)
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        before = self.file.read_text()
        broken = before.replace("[[light]]", "[[lihgt]]", 1)
        save(self.file, broken)
        self.problems()
        self.save_changes()
        self.assertIn("lihgt", self.browser.text("#notice"))
        self.assertEqual(self.file.read_text(), broken)
        save(self.file, before)
        self.wait_for("document.getElementById('scene-problems').hidden")
        self.save_changes()
        self.wait_until_shown(2)
        self.assertIn("color = [32, 192, 64]", self.file.read_text())

    def test_a_formula_that_draws_otherwise_is_seen_in_the_difference(self):
        self.view()
        self.wait_until_shown(1)
        # Simulates a broken driver that dims the page's lights.
        self.browser.run("""
            const own = WebGL2RenderingContext.prototype.texSubImage2D;
            WebGL2RenderingContext.prototype.texSubImage2D = function (...words) {
                const data = words.at(-1);
                if (data instanceof Int32Array) new Float32Array(data.buffer).forEach((value, i, all) => { all[i] = value * 0.8; });
                return own.apply(this, words);
            };""")
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c041")
        text = self.compare("difference")
        differing, of = map(int, re.match(r"(\d+) of (\d+) pixels differ", text).groups())
        self.assertGreater(differing, 0.05 * of, text)

    def test_without_webgl_the_renderers_own_picture_is_shown_and_follows(self):
        self.browser = Browser("--disable-3d-apis")
        self.addCleanup(self.browser.close)
        self.browser.resize(*SMALL_WINDOW)
        self.view()
        self.wait_until_shown(1)
        self.assertTrue(self.browser.one("#without-graphics").is_displayed())
        reference = self.folder / "reference.ppm"

        def assert_is_rendered(*options):
            candela("render", self.file, "-o", reference, *options)
            expected = Picture.of_ppm(reference)
            # It appears on the screen eventually, and exactly.
            self.browser.driver.execute_async_script("""
                const [expected, done] = arguments, canvas = document.getElementById("picture-canvas");
                const look = () => {
                    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
                    let text = "";
                    data.forEach((byte, i) => { if (i % 4 < 3) text += String.fromCharCode(byte); });
                    btoa(text) === expected ? done() : setTimeout(look, 50);
                };
                look();""", base64.b64encode(expected.pixels).decode())
            self.assertEqual(self.browser.picture(expected.width, expected.height).pixels, expected.pixels)

        assert_is_rendered()
        self.browser.unfold_all()
        self.browser.enter('[data-path="object.0.color"] input', "#20c040")
        self.browser.one("#picture-canvas").send_keys("+")
        position = self.browser.run("""
            return [...document.querySelectorAll('[data-path="observer.position"] input[type=number]')].map((i) => Number(i.value));""")
        assert_is_rendered("--set", "object.0.color=[32,192,64]", *options_for("observer.position", position))
        # Lights can be moved there as well, a pixel is explained, and a saved scene appears by itself.
        self.assertTrue(self.browser.all(".marker"))
        self.browser.enter("#explanation-x", "3")
        self.browser.enter("#explanation-y", "2")
        self.browser.one("#explanation-y").send_keys(Keys.ENTER)
        self.assertEqual(self.explained(), [30, 40, 60])
        self.browser.click("reset-all")
        self.changed(self.scene_color(), "color = [200, 20, 30]")
        self.wait_until_shown(2)
        assert_is_rendered()
        self.assertFalse([e for e in self.browser.errors() if "WebGL" not in e])

    def test_all_browsers_see_the_same(self):
        self.view()
        self.wait_until_shown(1)
        driver = self.browser.driver
        first = driver.current_window_handle
        driver.switch_to.new_window("tab")
        second = driver.current_window_handle
        driver.get(self.address)
        self.wait_until_shown(1)
        self.changed(self.scene_color(), "color = [220, 220, 20]")
        for handle in (first, second):
            driver.switch_to.window(handle)
            self.wait_until_shown(2)
            self.assert_shows()
        driver.close()
        driver.switch_to.window(first)

    def test_the_end_of_the_server_is_said(self):
        self.view()
        self.wait_until_shown(1)
        self.server.send_signal(signal.SIGTERM)
        self.wait_for("document.getElementById('notice').textContent.includes('candela view has ended')")
        self.assertEqual(self.server.wait(LONGEST), 0)  # before end() asks again
