"""The state in the address."""
import base64
import json

from selenium.webdriver.common.keys import Keys

import scenes
from generated import Generated, PageTest


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
