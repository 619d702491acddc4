"""From a save to pixels on the screen, and from a click to an explanation, in a browser that `candela view` serves: medians.

    /usr/bin/python3 tests/bench/view.py BUILD [--saves N] [--clicks N] [SCENE]       default: docs/examples/still-life.toml

The clock of a save starts when the file is renamed to its final name, and ends when the graphics have finished the page's first frame of
the new scene. That of a click begins with the browser's own event and ends when the page shows the bytes of that pixel; the first click,
three seconds after the page is up, is one of them.
"""
import argparse
import os
import pathlib
import random
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "page"))

from browser import DRAWS_BY_ITSELF, Browser  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402

SHOWN = """
    const [generation, done] = arguments;
    const look = () => {
        if (location.search !== `?live=${generation}`) return setTimeout(look, 1);
        // The frame is drawn at the next opportunity, and is complete once the one after it begins.
        requestAnimationFrame(() => requestAnimationFrame(() => {
            const gl = document.getElementById("picture-canvas").getContext("webgl2");
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
            done(Date.now());
        }));
    };
    look();"""

CLICKED = """
    const canvas = document.getElementById("picture-canvas"), result = document.getElementById("explanation-result");
    window.explained = [];
    canvas.addEventListener("click", () => {
        const begin = performance.now(), before = result.querySelector(".bytes");
        const look = () => {
            const bytes = result.querySelector(".bytes");
            if (bytes && bytes !== before) explained.push(performance.now() - begin);
            else setTimeout(look, 1);
        };
        look();
    }, true);"""

ALL_EXPLAINED = """
    const [count, done] = arguments;
    const look = () => (explained.length === count ? done(explained) : setTimeout(look, 5));
    look();"""


def clicked(browser, count, chance):
    """The milliseconds of `count` clicks in the middle half of the picture."""
    browser.run(CLICKED)
    canvas = browser.one("#picture-canvas")
    for i in range(count):
        offset = [round((chance.random() - 0.5) * canvas.size[side] / 2) for side in ("width", "height")]
        ActionChains(browser.driver).move_to_element_with_offset(canvas, *offset).click().perform()
        milliseconds = browser.driver.execute_async_script(ALL_EXPLAINED, i + 1)
    return milliseconds


def report(what, milliseconds, of):
    print(f"{what}: median {statistics.median(milliseconds):.0f} ms, {min(milliseconds):.0f} to {max(milliseconds):.0f} ms, "
          f"{milliseconds[0]:.0f} ms the first, {len(milliseconds)} {of}")


def main():
    options = argparse.ArgumentParser()
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("scene", nargs="?", type=pathlib.Path, default=ROOT / "docs" / "examples" / "still-life.toml")
    options.add_argument("--saves", type=int, default=15)
    options.add_argument("--clicks", type=int, default=20)
    options = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder) / "scene.toml"
        shutil.copy(options.scene, scene)
        text = scene.read_text()
        colors = re.findall(r"^color\s*=\s*\[\d+, *\d+, *\d+\]", text, re.M)
        command = [options.build / "bin" / "candela", "view", "--no-open", "--quiet", scene]
        server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        browser = Browser(*DRAWS_BY_ITSELF)
        try:
            browser.open(server.stdout.readline().strip())
            browser.driver.execute_async_script(SHOWN, 1)
            time.sleep(3)  # until the picture no longer changes
            clicks = clicked(browser, options.clicks, random.Random(17))
            milliseconds = []
            for i in range(options.saves):
                draft = scene.with_suffix(".draft")
                draft.write_text(text.replace(colors[-1], f"color = [{i}, 90, 200]"))
                begin = time.time()
                os.replace(draft, scene)
                milliseconds.append(browser.driver.execute_async_script(SHOWN, i + 2) - 1000 * begin)
                time.sleep(3)  # as above
        finally:
            browser.close()
            server.send_signal(signal.SIGINT)
            server.wait()
    report("from a save to the screen", milliseconds, f"saves of {options.scene.name}")
    report("from a click to its explanation", clicks, f"clicks on {options.scene.name}")


if __name__ == "__main__":
    main()
