"""A browser with a generated page."""
import base64
import json
import os
import pathlib
import re
import tempfile

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By

from firefox import Firefox
from pictures import Picture

# Wide enough for the layout of desktops, and no larger: each pixel on the screen is drawn by the processor.
WINDOW = (840, 400)
DRAWS_BY_ITSELF = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")

WITHOUT_WEBGL = ("--disable-3d-apis",)


class Chromium(webdriver.Chrome):
    def __init__(self, *options):
        chrome = webdriver.ChromeOptions()
        for option in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", *options):
            chrome.add_argument(option)
        chrome.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        # It leaves a socket there when the driver kills it.
        self.scratch = tempfile.TemporaryDirectory(prefix="candela-chromium-", ignore_cleanup_errors=True)
        service = Service("/usr/bin/chromedriver", env={**os.environ, "TMPDIR": self.scratch.name})
        super().__init__(service=service, options=chrome)

    def quit(self):
        super().quit()
        self.scratch.cleanup()

    def resize(self, width, height, is_phone=False):
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": is_phone}
        self.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)

    def run_before_pages(self, source):
        """Runs before the scripts of every page that is loaded from now on; returns a function that ends that."""
        script = self.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": source})
        return lambda: self.execute_cdp_cmd("Page.removeScriptToEvaluateOnNewDocument", script)


class Browser:
    """Chromium, started with these options, or Firefox: `name`, or the value of CANDELA_TEST_BROWSER."""

    def __init__(self, *options, name=None):
        self.name = name or os.environ.get("CANDELA_TEST_BROWSER", "chromium")
        self.driver = Chromium(*options) if self.name == "chromium" else Firefox(has_webgl=not set(WITHOUT_WEBGL) & set(options))
        self.driver.set_script_timeout(120)
        self.resize(*WINDOW)

    def close(self):
        self.driver.quit()

    def resize(self, width, height, **phone):
        self.driver.resize(width, height, **phone)

    def load(self, address):
        """A page of its own, not another fragment of the open one."""
        self.driver.get("about:blank")
        self.errors()
        self.driver.get(address)

    def open(self, address):
        """Loads a page that is expected to work."""
        self.load(address)
        problem = self.problem()
        assert problem is None, f"{address}: {problem}"

    def problem(self):
        """The error of candela.ready; none if all is well."""
        return self.driver.execute_async_script(
            "const done = arguments[0]; candela.ready.then(() => done(null), (error) => done(error.message));")

    def errors(self):
        """The console's messages since the last call."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] == "SEVERE"]

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.run("return document.querySelector(arguments[0]).textContent", selector)

    def picture(self, width, height):
        encoded = self.driver.execute_async_script("""
            const [width, height, done] = arguments;
            candela.render(width, height).then((rows) => {
                let text = "";
                for (let at = 0; at < rows.length; at += 8192) text += String.fromCharCode(...rows.subarray(at, at + 8192));
                done(btoa(text));
            }, (error) => done("!" + error.message));""", width, height)
        assert not encoded.startswith("!"), encoded
        return Picture.of_rgba(width, height, base64.b64decode(encoded))

    def wait_for(self, condition, *arguments):
        """Waits until a JavaScript expression is true. (The page's own policy does not allow compiling one in the page.)"""
        self.driver.execute_async_script(f"""
            const [values, done] = arguments;
            const look = () => (({condition}) ? done() : setTimeout(look, 20));
            look();""", list(arguments))

    def rest(self, seconds=2):
        """Waits for asynchronous effects: the picture on the screen, the clipboard, a new fragment."""
        self.driver.execute_async_script("setTimeout(arguments[1], 1000 * arguments[0])", seconds)

    def wait_for_pictures(self, most_seconds=600):
        """Waits until the page shows whole pictures in place of drafts, which are coarser where they take long, as with shadows."""
        self.rest(1)
        self.driver.set_script_timeout(most_seconds)
        self.wait_for("""[...document.querySelectorAll("#picture-canvas, #outside-canvas, .pane")].every(
            ({ width, style }) => width === Math.round(parseFloat(style.width) * devicePixelRatio))""")

    def unfold_all(self):
        """Opens all parts; their contents are made by an event that comes later."""
        self.driver.execute_async_script("""
            for (const part of document.querySelectorAll("details")) part.open = true;
            setTimeout(arguments[0], 50);""")

    def enter(self, selector, value):
        """Enters a value as a person would: the value, then its events."""
        self.run("""
            const [selector, value] = arguments;
            const input = document.querySelector(selector);
            if (input.type === "checkbox") input.checked = value;
            else input.value = value;
            input.dispatchEvent(new Event("input", { bubbles: true }));
            input.dispatchEvent(new Event("change", { bubbles: true }));""", selector, value)

    def click(self, identifier):
        self.run("document.getElementById(arguments[0]).click()", identifier)


def scene_of(page):
    """The JSON within a page."""
    return json.loads(re.search(r'id="scene">(.*?)</script>', pathlib.Path(page).read_text(), re.S)[1])


def with_scene(page, other, change):
    """A copy of a page with changed JSON."""
    text = pathlib.Path(page).read_text()
    scene = scene_of(page)
    change(scene)
    put_in = json.dumps(scene).replace("<", "\\u003c")
    pathlib.Path(other).write_text(re.sub(r'(id="scene">).*?(</script>)', lambda m: m[1] + put_in + m[2], text, flags=re.S))
    return pathlib.Path(other).as_uri()
