"""Pages generated from scenes, and helpers for their tests."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

from browser import DRAWS_BY_ITSELF, WINDOW, Browser, scene_of
from pictures import Picture

COMMAND = os.environ.get("CANDELA_TEST_COMMAND") or os.environ["CANDELA"]
SCRATCH = pathlib.Path(os.environ.get("CANDELA_TEST_SCRATCH") or tempfile.mkdtemp(prefix="candela-page-")).absolute()
ENVIRONMENT = dict(os.environ, XDG_DATA_HOME=str(SCRATCH / "nothing"), XDG_CACHE_HOME=str(SCRATCH / "cache"), CANDELA_PLUGIN_PATH="")

# For tests that request pictures and ignore the screen, where drawing them a second time would take most of the time.
SMALL_WINDOW = (320, 240)

MOST_DIFFERENT = 0.02  # of the pixels, those next to edges, may differ by more than two steps of 255
TWO_STEPS = 2


def candela(*arguments):
    done = subprocess.run([COMMAND, *map(str, arguments)], env=ENVIRONMENT, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"candela {arguments}: exit code {done.returncode}\n{done.stderr}")


def toml(value):
    return json.dumps(value) if not isinstance(value, bool) else str(value).lower()


class Generated:
    """A scene's file and page."""

    def __init__(self, name, text, models="all", options=(), target="webgl"):
        folder = SCRATCH / name
        folder.mkdir(parents=True, exist_ok=True)
        self.file = folder / f"{name}.toml"
        self.file.write_text(text)
        candela("generate", self.file, "--target", target, "--models", models, "-o", folder / "page", *options)
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
    """The command line that corresponds to a control."""
    kind, *rest = path.split(".")
    if kind in ("shading", "reflection"):
        return [f"--{kind}", value]
    if kind == "light" and rest[1] == "on":
        return [] if value else ["--set", f"light.{rest[0]}.intensity=0"]
    if kind == "light":
        return ["--set", f"light.{rest[0]}.{rest[2]}={toml(value)}"]
    if path == "image.exposure":
        return ["--set", f"observer.exposure={toml(value)}"]
    if kind == "object" and rest[1] == "common":
        return ["--set", f"object.{rest[0]}.material.{rest[2]}={toml(value)}"]
    if kind == "object" and rest[1] in ("material", "shading"):
        return ["--set", f"object.{rest[0]}.{rest[1]}.{rest[3]}={toml(value)}"]
    return ["--set", f"{path}={toml(value)}"]


class PageTest(unittest.TestCase):
    window = WINDOW

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(*DRAWS_BY_ITSELF)
        cls.addClassCleanup(cls.browser.close)
        cls.browser.resize(*cls.window)

    def picture(self, generated):
        return self.browser.picture(*generated.size)

    def assert_alike(self, page, reference, what, before=None):
        """`before`: the page's picture before a change; most of the changed pixels must be correct."""
        differences = page.differences(reference)
        wrong = sum(d > TWO_STEPS for d in differences)
        self.assertLessEqual(wrong, MOST_DIFFERENT * len(differences), f"{what}: {wrong} of {len(differences)} pixels differ")
        if before is None:
            return
        changed = [wrong for wrong, change in zip(differences, page.differences(before)) if change > 0]
        self.assertTrue(changed, f"{what}: the picture has not changed")
        wrong = sum(d > TWO_STEPS for d in changed)
        self.assertLessEqual(wrong, 0.5 * len(changed), f"{what}: {wrong} of the {len(changed)} pixels that have changed differ")
