"""Every state of the pages, by axe-core: no violation of WCAG 2.2's levels A and AA."""
import os
import pathlib
import unittest

from selenium.webdriver.common.keys import Keys

import scenes
from browser import DRAWS_BY_ITSELF, WINDOW, WITHOUT_WEBGL, Browser
from exercising import PHONG, Exercising
from formulas import Editing
from generated import Generated, PageTest
from three_pages import needs_three
from viewing import Viewing

LEVELS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa"]
PHONE = (390, 844)


def emulate(browser, **features):
    """Sets the results of media queries: the preferred appearance, forced colours."""
    values = [{"name": name.replace("_", "-"), "value": value} for name, value in features.items()]
    browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": values})


class Inspected:
    """Inspects a page's state."""

    @classmethod
    def setUpClass(cls):
        axe = pathlib.Path(os.environ["CANDELA_TEST_AXE"])
        if not axe.exists():
            raise unittest.SkipTest("axe-core is missing; scripts/axe-core.sh fetches it")
        cls.axe = axe.read_text()
        super().setUpClass()

    def tearDown(self):
        emulate(self.browser)
        self.browser.resize(*WINDOW)
        super().tearDown()

    def inspect(self, state, browser=None):
        """In light and in dark."""
        browser = browser or self.browser
        for appearance in ("light", "dark"):
            with self.subTest(f"{state}, {appearance}"):
                emulate(browser, prefers_color_scheme=appearance)
                browser.rest(0.3)
                if not browser.run("return typeof axe === 'object'"):
                    browser.run(self.axe)
                found = browser.driver.execute_async_script("""
                    const [levels, done] = arguments;
                    axe.run(document, { runOnly: levels, resultTypes: ["violations"] }).then(
                        ({ violations, passes }) => done([passes.length, violations.map(({ id, help, nodes }) =>
                            [`${id}: ${help}`, ...nodes.slice(0, 5).map((node) => `${node.html.slice(0, 160)} ${node.any.map((a) => a.message).join("; ")}`)].join("\\n    "))]),
                        (error) => done([0, [String(error)]]));""", LEVELS)
                checked, violations = found
                self.assertEqual(violations, [], "\n".join(violations))
                self.assertGreater(checked, 5)  # rules: it has checked something


class Accessible(Inspected, Editing, PageTest):
    def test_a_page_from_a_file(self):
        generated = Generated("accessible", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.inspect("as it opens")
        self.browser.unfold_all()
        self.inspect("unfolded")
        self.browser.enter('[data-path="light.0.value.intensity"] input', "-1")
        self.inspect("a value that is refused")
        self.browser.click("reset-all")
        for layout in ("two", "three", "four", "wipe"):
            self.browser.enter("#panes-layout", layout)
            self.browser.unfold_all()
            self.inspect(f"panes: {layout}")
        self.browser.enter("#panes-layout", "one")
        self.browser.resize(*PHONE, is_phone=True)
        self.inspect("on a phone")

    def test_formulas_that_are_edited(self):
        generated = Generated("accessible-formulas", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        self.open_editor()
        self.inspect("an editor")
        text = self.replace("m.kd * s.color", "m.kd * nonsense")
        self.browser.wait_for("document.querySelector('#formula-body .editor-problems').textContent.includes('nonsense')")
        self.inspect("a formula that does not compile")
        self.write(text.replace("m.kd * s.color", "0.5f * m.kd * s.color"))
        self.browser.enter("#formula-showing", "difference")
        self.browser.rest(0.8)
        self.inspect("a difference")
        self.browser.enter("#formula-name", "No Name")
        self.browser.click("formula-keep")
        self.inspect("a name that is refused")

    def test_failures(self):
        generated = Generated("accessible-failures", scenes.PERSPECTIVE)
        browser = Browser(*WITHOUT_WEBGL)
        self.addCleanup(browser.close)
        browser.load(generated.address)
        self.assertIn("WebGL 2", browser.problem())
        self.inspect("without WebGL", browser)
        self.browser.open(generated.address)
        self.browser.run("document.querySelector('canvas').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()")
        self.browser.rest(0.8)
        self.inspect("lost graphics")


@needs_three
class AccessibleThree(Inspected, PageTest):
    def test_a_page_with_three(self):
        generated = Generated("accessible-three", scenes.PERSPECTIVE, "phong", target="three")
        self.browser.open(generated.address)
        self.inspect("as it opens")
        self.browser.resize(*PHONE, is_phone=True)
        self.inspect("on a phone")


class AccessibleView(Inspected, Editing, Viewing):
    """Only new tests; those of Viewing itself are not among these."""

    def test_what_candela_view_shows(self):
        self.browser.resize(*WINDOW)
        self.view()
        self.wait_until_shown(1)
        self.inspect("as it opens")
        self.browser.unfold_all()
        self.inspect("unfolded")
        for mode in ("wipe", "difference"):
            self.compare(mode)
            self.inspect(f"reference render: {mode}")
        self.browser.enter("#explanation-x", "54")
        self.browser.enter("#explanation-y", "60")
        self.browser.one("#explanation-y").send_keys(Keys.ENTER)
        self.explained()
        self.browser.unfold_all()
        self.inspect("a pixel that is explained")
        self.changed("[[light]]", "[[lihgt]]")
        self.problems()
        self.inspect("a broken scene")

    def test_a_scene_that_is_broken_at_first(self):
        self.file.write_text("version = 1\nrooom = 3\n")
        self.view()
        self.wait_for("document.getElementById('scene-problems-text').textContent.includes('rooom')")
        self.inspect("nothing to be shown yet")

    def test_what_is_shown_without_webgl(self):
        self.browser = Browser(*WITHOUT_WEBGL)
        self.addCleanup(self.browser.close)
        self.view()
        self.wait_until_shown(1)
        self.inspect("the renderer's own picture")


class AccessibleExercise(Inspected, Exercising):
    """Only new tests; those of Exercising itself are not among these."""

    def test_an_exercise(self):
        self.open()
        self.inspect("nothing is written")
        self.write(PHONG.replace("m.kd * s.color", "0.5 * m.kd * s.color"))
        self.inspect("an answer that differs")
        self.write(PHONG.replace("clamped_power", "clamped_powr"))
        self.browser.wait_for("document.querySelector('.editor-problems').textContent.includes('Line 3: ')")
        self.inspect("an answer that does not compile")


# They are inherited, and would run a second time.
for _class, _base in ((AccessibleView, Viewing), (AccessibleExercise, Exercising)):
    for _name in [name for name in dir(_base) if name.startswith("test_")]:
        setattr(_class, _name, None)
