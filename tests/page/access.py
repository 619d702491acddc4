"""Phones, names for screen readers, the keyboard."""
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.keys import Keys

import scenes
from browser import WINDOW
from generated import Generated, PageTest


class Access(PageTest):
    def test_phone(self):
        generated = Generated("phone", scenes.PERSPECTIVE)
        self.addCleanup(self.browser.resize, *WINDOW)
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

    def test_names_begin_with_what_is_seen(self):
        """Voice control uses the visible labels of buttons: WCAG 2.5.3."""
        generated = Generated("spoken", scenes.PERSPECTIVE, "all")
        self.browser.open(generated.address)
        self.browser.unfold_all()
        named = [button for button in self.browser.all("button, summary") if button.is_displayed() and button.text.strip()]
        self.assertGreater(len(named), 10)
        for button in named:
            spoken, seen = (" ".join(text.split()).lower() for text in (button.accessible_name, button.text))
            self.assertIn(seen, spoken)

    def test_forced_colors(self):
        generated = Generated("forced", scenes.PERSPECTIVE)
        self.browser.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [{"name": "forced-colors", "value": "active"}]})
        self.addCleanup(self.browser.driver.execute_cdp_cmd, "Emulation.setEmulatedMedia", {"features": []})
        self.browser.open(generated.address)
        adjusted = self.browser.run("return [...document.querySelectorAll('.swatch')].map((s) => getComputedStyle(s).forcedColorAdjust)")
        self.assertGreater(len(adjusted), 1)
        self.assertEqual(set(adjusted), {"none"})

    def test_copy_link_is_seen(self):
        generated = Generated("copied", scenes.PERSPECTIVE)
        self.browser.open(generated.address)
        before = self.browser.text("#copy-link")
        self.browser.click("copy-link")
        self.browser.rest(0.3)
        self.assertIn("Link", self.browser.text("#copy-link"))
        self.assertNotEqual(self.browser.text("#copy-link"), before)
        self.browser.rest(3)
        self.assertEqual(self.browser.text("#copy-link"), before)

    def test_focus_order(self):
        generated = Generated("focus", scenes.ORTHOGRAPHIC)
        self.browser.open(generated.address)
        expected = self.browser.run("""
            const all = [...document.querySelectorAll("canvas, input, select, button, summary, .formula")].filter((e) => e.checkVisibility());
            all.forEach((e, i) => (e.dataset.order = i));
            return all.length;""")
        seen = []
        for _ in range(expected):
            ActionChains(self.browser.driver).send_keys(Keys.TAB).perform()
            seen.append(self.browser.run("return document.activeElement.dataset.order ?? document.activeElement.outerHTML"))
        self.assertEqual(seen, [str(i) for i in range(expected)])
        self.assertEqual(self.browser.run("return document.querySelector('[data-order=\"0\"]').tagName"), "CANVAS")
