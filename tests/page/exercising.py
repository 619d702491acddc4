"""The page of an exercise: how far a formula is off, where, and in which term."""
import json
import pathlib
import unittest

from browser import DRAWS_BY_ITSELF, Browser
from generated import SCRATCH, candela

PHONG = """float n_dot_l = dot(s.normal, to_light);
vec3 r = 2.0 * n_dot_l * s.normal - to_light;
float highlight = clamped_power(dot(r, s.to_observer), m.shininess);
return Reflected(m.kd * s.color * max(n_dot_l, 0.0), m.ks * (n_dot_l > 0.0 ? highlight : 0.0));"""


class Exercising(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(*DRAWS_BY_ITSELF)
        cls.addClassCleanup(cls.browser.close)
        SCRATCH.mkdir(parents=True, exist_ok=True)

    def open(self, model="phong", function="reflect"):
        page = SCRATCH / f"{model}-{function}.html"
        candela("exercise", "new", model, "--blank", function, "-o", page)
        self.browser.load(page.as_uri())
        self.assertEqual(self.browser.errors(), [])

    def write(self, text):
        self.browser.run("candelaExercise.editor.text = arguments[0]", text)
        self.browser.rest(0.6)

    def verdict(self):
        return self.browser.text("#verdict")

    def shares(self):
        rows = self.browser.run("return [...document.querySelectorAll('#differences tbody tr')].map((row) => [...row.children].map((cell) => cell.textContent))")
        return {row[0]: row[1:] for row in rows}

    def test_a_right_formula_matches(self):
        self.open()
        self.assertEqual(self.verdict(), "Nothing written yet.")
        self.write(PHONG)
        self.assertEqual(self.verdict(), "It matches the model.")
        self.assertEqual({row[0] for row in self.shares().values()}, {"0 %"})

    def test_half_of_the_diffuse_light_is_half_of_it_off(self):
        self.open()
        self.write(PHONG.replace("m.kd * s.color", "0.5 * m.kd * s.color"))
        self.assertEqual(self.verdict(), "It differs from the model: diffuse.")
        self.assertEqual(self.shares()["diffuse"][1], "50 %")
        self.assertEqual(self.shares()["specular"][0], "0 %")
        # It differs where the light falls: from the upper left, so not at the lower right edge.
        def heat(x, y):
            return self.browser.run("const c = document.getElementById('where'); return [...c.getContext('2d').getImageData(arguments[0], arguments[1], 1, 1).data].slice(0, 3)", x, y)
        self.assertGreater(sum(heat(28, 26)), 100)
        self.assertEqual(heat(64, 60), [0, 0, 0])

    def test_what_does_not_compile_keeps_the_last_picture_and_says_its_line(self):
        self.open()
        self.write(PHONG)
        self.write(PHONG.replace("clamped_power", "clamped_powr"))
        self.assertIn("Line 3: ", self.browser.text(".editor-problems"))
        self.assertIn("the results below are from the last version that did", self.verdict())
        self.write("#define x\n" + PHONG)
        self.assertIn("Line 1: the kernel language has no preprocessor", self.browser.text(".editor-problems"))

    def test_an_answer_is_saved_as_grade_reads_it_and_loaded_again(self):
        self.open()
        self.write(PHONG)
        # The content that the button would download.
        text = self.browser.driver.execute_async_script("""
            const done = arguments[0], own = URL.createObjectURL;
            URL.createObjectURL = (blob) => { blob.text().then(done); return own.call(URL, blob); };
            document.getElementById("save-answer").click();""")
        file = SCRATCH / "saved.answer"
        file.write_text(text)
        candela("exercise", "grade", file)  # exit code 0: it matches
        self.assertEqual(json.loads(text)["answer"], PHONG.split("\n"))
        self.browser.click("clear-answer")
        self.browser.one("#answer-file").send_keys(str(file))
        self.browser.rest(0.8)
        self.assertEqual(self.verdict(), "It matches the model.")

    def test_every_control_has_a_name(self):
        self.open()
        for control in self.browser.all("canvas, input, select, button, textarea, pre[tabindex]"):
            if control.is_displayed():
                self.assertNotEqual(control.accessible_name.strip(), "", control.get_attribute("outerHTML"))

    def test_other_models_are_given_by_their_own_kernels(self):
        """Compares the graphics processor with the renderer, using the shipped text as the answer."""
        for model in ("ggx", "ward", "oren-nayar", "toon"):
            with self.subTest(model):
                self.open(model)
                text = pathlib.Path(__file__).parents[2].joinpath("plugins/reflection", f"{model}.kernel").read_text()
                prefix = model.replace("-", "_")
                begin = text.index("{", text.index(f" {prefix}_reflect(")) + 1
                self.write(text[begin:text.index("\n}", begin)].strip("\n"))
                self.assertEqual(self.verdict(), "It matches the model.", self.browser.text(".editor-problems"))
