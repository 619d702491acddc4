"""Formulas edited in a page: drawn, refused, compared with the shipped ones, kept, built, and rendered with."""
import json
import os
import shutil
import subprocess

from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

import scenes
from generated import COMMAND, ENVIRONMENT, MOST_DIFFERENT, SCRATCH, SMALL_WINDOW, TWO_STEPS, Generated, PageTest, candela
from pictures import Picture
from served import OWN_KERNEL
from viewing import Viewing

EDITOR = "document.querySelector('#formula-body .CodeMirror').CodeMirror"
# Blinn's highlight in Phong's kernel (Blinn 1977).
BLINN = (("vec3 r = 2.0f * n_dot_l * s.normal - to_light;", "vec3 h = normalize(to_light + s.to_observer);"), ("dot(r, s.to_observer)", "dot(s.normal, h)"))


class Editing:
    """Operations on a page's editor."""

    def open_editor(self, model="reflection/phong"):
        self.browser.enter("#formula-model", model)
        self.browser.click("formula-open")

    def write(self, text):
        """Replaces the kernel's text, and waits until the page has reacted."""
        self.browser.run(f"{EDITOR}.setValue(arguments[0])", text)
        self.browser.rest(0.8)

    def kernel(self):
        return self.browser.run(f"return {EDITOR}.getValue()")

    def replace(self, old, new):
        text = self.kernel()
        self.assertIn(old, text)
        self.write(text.replace(old, new))
        return text

    def write_blinns_formula(self):
        shipped = text = self.kernel()
        for old, new in BLINN:
            self.assertIn(old, text)
            text = text.replace(old, new)
        self.write(text)
        return shipped

    def messages(self):
        return self.browser.text("#formula-body .editor-problems")


class Formulas(Editing, PageTest):
    window = SMALL_WINDOW

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.generated = Generated("formulas", scenes.PERSPECTIVE)

    def setUp(self):
        self.browser.open(self.generated.address)
        self.browser.enter("#models [data-path=reflection] select", "phong")
        self.width, self.height = self.generated.size

    def assert_shows(self, *options):
        reference = self.generated.render(*options)
        differences = self.browser.picture(self.width, self.height).differences(reference)
        self.assertLessEqual(sum(d > TWO_STEPS for d in differences), MOST_DIFFERENT * len(differences))

    def test_an_edited_formula_is_drawn(self):
        self.open_editor()
        self.assert_shows("--reflection", "phong")
        shipped = self.write_blinns_formula()
        self.assertEqual(self.messages(), "")
        self.assert_shows("--reflection", "blinn-phong", *self.phong_values())
        self.assertRegex(self.browser.text("#formula-status"), r"[1-9]\d* of \d+ pixels differ")
        # The shipped one again, first for comparison, then permanently.
        self.browser.enter("#formula-showing", "shipped")
        self.assert_shows("--reflection", "phong")
        self.browser.enter("#formula-showing", "difference")
        self.browser.rest(0.8)
        self.assertTrue(self.browser.run("return !document.getElementById('formula-canvas').hidden"))
        self.browser.click("formula-reset")
        self.browser.rest(0.8)
        self.assertEqual(self.kernel(), shipped)
        self.assert_shows("--reflection", "phong")

    def phong_values(self):
        """The objects' values for Phong, given to a model that has parameters of the same names."""
        options = []
        for i, each in enumerate(self.generated.scene["objects"]):
            for name, value in each["materials"]["phong"].items():
                options += ["--set", f"object.{i}.material.{name}={json.dumps(value)}"]
        return options

    def test_what_does_not_compile_is_said_at_its_line_and_the_last_formula_stays(self):
        self.open_editor()
        self.write_blinns_formula()
        before = self.browser.picture(self.width, self.height)
        text = self.kernel()
        self.write(text.replace("float highlight = ", "float highlight = nonsense * "))
        line = next(i for i, each in enumerate(text.split("\n"), 1) if "float highlight" in each)
        self.assertIn(f"Line {line}: ", self.messages())
        self.assertIn("nonsense", self.messages())
        self.assertEqual(max(before.differences(self.browser.picture(self.width, self.height))), 0)
        self.write(text)
        self.assertEqual(self.messages(), "")

    def test_an_edited_formula_may_call_what_no_other_does(self):
        self.open_editor()
        self.replace("m.kd * s.color", "m.kd * s.color * fresnel_schlick(max(dot(s.normal, s.to_observer), 0.0f), 1.5f)")
        self.assertEqual(self.messages(), "")

    def test_lights_and_shading_models_are_edited_likewise(self):
        light = next(iter(self.generated.scene["light_models"]))
        for model in (f"light/{light}", "shading/phong"):
            with self.subTest(model):
                self.open_editor(model)
                before = self.browser.picture(self.width, self.height)
                shipped = self.replace("return ", "return nonsense ")
                self.assertIn("Line ", self.messages())
                self.assertEqual(max(before.differences(self.browser.picture(self.width, self.height))), 0)
                self.write(shipped + "\n// edited\n")
                self.assertEqual(self.messages(), "")

    def test_a_formula_that_nothing_in_the_picture_uses_is_compiled_all_the_same(self):
        self.open_editor("reflection/ggx")
        self.assertIn("Nothing in the picture uses this model", self.browser.text("#formula-status"))
        shipped = self.replace("return ", "return nonsense ")
        self.browser.wait_for("document.querySelector('#formula-body .editor-problems').textContent.includes('Line ')")
        self.write(shipped + "\n// edited\n")
        self.browser.wait_for("document.getElementById('formula-status').textContent.includes('It compiles. Nothing in the picture uses')")
        self.assertEqual(self.messages(), "")
        # Until something does.
        self.browser.enter("#models [data-path=reflection] select", "ggx")
        self.browser.wait_for("document.getElementById('formula-status').textContent.includes('picture is identical to that of the shipped')")

    def test_the_keyboard_gets_in_and_out(self):
        self.addCleanup(self.browser.resize, *self.window)
        self.browser.resize(1200, 900)
        self.open_editor()
        keys = lambda *words: ActionChains(self.browser.driver).send_keys(*words).perform()
        in_editor = "return document.activeElement.closest('.editor') !== null"
        self.assertTrue(self.browser.run(in_editor))
        self.assertNotEqual(self.browser.run("return document.activeElement.getAttribute('aria-label')"), None)
        text = self.kernel()
        keys(Keys.TAB)
        self.assertFalse(self.browser.run(in_editor))
        self.assertEqual(self.kernel(), text)
        keys(Keys.SHIFT, Keys.TAB)
        self.browser.run(f"{EDITOR}.focus()")
        keys("// x")
        self.assertTrue(self.kernel().startswith("// x"))

    def test_a_page_from_a_file_downloads_what_is_kept_and_says_the_command(self):
        self.open_editor()
        self.browser.enter("#formula-name", "No Name")
        self.browser.click("formula-keep")
        self.assertIn("lower-case", self.browser.text("#formula-kept"))
        self.browser.enter("#formula-name", "my-phong")
        self.browser.click("formula-keep")
        self.browser.rest(0.3)
        self.assertIn("candela plugin new reflection my-phong --from reflection/phong --kernel my-phong.kernel", self.browser.text("#formula-kept"))

    def test_a_kernel_file_is_called_by_its_path_in_commands(self):
        folder = SCRATCH / "own-kernel"
        folder.mkdir(parents=True, exist_ok=True)
        folder.joinpath("own.kernel").write_text(OWN_KERNEL)
        generated = Generated("own-kernel", scenes.PERSPECTIVE, options=("--reflection", folder / "own.kernel"))
        path = generated.scene["reflection_models"]["own"]["id"]
        self.assertTrue(path.endswith("own-kernel/own.kernel"), path)
        self.browser.open(generated.address)
        self.open_editor("reflection/own")
        self.browser.click("formula-keep")
        self.browser.rest(0.3)
        self.assertIn(f"--from {path} --kernel my-model.kernel", self.browser.text("#formula-kept"))
        for model, name in (("own", path), ("ggx", "ggx")):
            self.browser.enter("#models [data-path=reflection] select", model)
            options = self.browser.driver.execute_async_script("""
                const done = arguments[0];
                navigator.clipboard.writeText = (text) => { done(text); return Promise.resolve(); };
                document.getElementById("copy-options").click();""")
            self.assertEqual(options, f"--reflection {name}")


class Keeping(Editing, Viewing):
    """Only new tests; those of Viewing itself are not among these."""

    def view(self):
        # "Keep it" creates the folder where candela view was started.
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            super().view()
        finally:
            os.chdir(before)
        self.wait_until_shown(1)

    def keep(self, name):
        self.browser.enter("#formula-name", name)
        self.browser.click("formula-keep")
        self.wait_for("!document.getElementById('formula-keep').disabled && document.getElementById('formula-kept').textContent !== ''")
        return self.browser.text("#formula-kept")

    def test_what_is_kept_is_a_project_in_a_new_folder(self):
        self.view()
        self.open_editor()
        self.write_blinns_formula()
        self.assertIn("Kept in", self.keep("my-blinn"))
        project = self.folder / "my-blinn"
        kernel = project.joinpath("my-blinn.kernel").read_text()
        self.assertIn("normalize(to_light + s.to_observer)", kernel)
        self.assertIn("my_blinn_reflect(MyBlinnMaterial m", kernel)
        self.assertNotIn("phong_", kernel)
        self.assertTrue(project.joinpath("CMakeLists.txt").exists())
        self.assertIn("already exists", self.keep("my-blinn"))
        for name in ("../outside", "/tmp/outside", "a/b"):
            status = self.browser.driver.execute_async_script(
                "fetch(`keep?model=reflection%2Fphong&name=${encodeURIComponent(arguments[0])}`, { method: 'POST', body: 'x' }).then((r) => arguments[1](r.status))", name)
            self.assertEqual(status, 422)
        self.assertEqual(sorted(each.name for each in self.folder.iterdir() if each.is_dir()), ["my-blinn", "tmp"])

    def test_a_saved_scene_is_drawn_with_the_edited_formula_and_takes_no_focus(self):
        self.view()
        self.browser.enter("#models [data-path=reflection] select", "phong")
        self.open_editor()
        self.write_blinns_formula()
        edited = self.kernel()
        self.browser.run("document.getElementById('reset-view').focus()")
        self.changed("[200, 60, 40]", "[40, 60, 200]")
        self.wait_until_shown(2)
        self.assertEqual(self.kernel(), edited)
        self.assertEqual(self.browser.run("return document.activeElement.id"), "reset-view")
        self.assertEqual(self.messages(), "")
        values = [option for i, each in enumerate(self.scene_objects()) for name, value in each["materials"]["phong"].items()
                  for option in ("--set", f"object.{i}.material.{name}={json.dumps(value)}")]
        self.assert_shows("--reflection", "blinn-phong", *values)

    def scene_objects(self):
        return self.browser.run("return JSON.parse(document.getElementById('scene').textContent).objects")

    def test_a_formula_is_edited_kept_built_and_rendered_with(self):
        self.view()
        self.open_editor()
        self.write_blinns_formula()
        self.keep("my-blinn")
        project, build = self.folder / "my-blinn", self.folder / "build"
        prefix = self.folder / "prefix"
        subprocess.run(["cmake", "--install", os.path.dirname(os.path.dirname(COMMAND)), "--prefix", prefix], check=True, capture_output=True)
        installed = [name for name in ("clang++-22", "clang++-19") if shutil.which(name)]
        compiler = {"CXX": installed[0]} if installed else {}
        for words in (["cmake", "-B", build, "-S", project, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={prefix}"],
                      ["cmake", "--build", build], ["ctest", "--test-dir", build, "--output-on-failure"]):
            done = subprocess.run(list(map(str, words)), env={**ENVIRONMENT, **compiler}, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        own, shipped = self.folder / "own.ppm", self.folder / "blinn.ppm"
        candela("render", "--plugin-dir", build, "--reflection", "my-blinn", "-o", own)
        candela("render", "--reflection", "blinn-phong", "-o", shipped)
        self.assertLessEqual(max(Picture.of_ppm(own).differences(Picture.of_ppm(shipped))), 1)


# They are inherited, and would run a second time.
for _name in [name for name in dir(Viewing) if name.startswith("test_")]:
    setattr(Keeping, _name, None)
