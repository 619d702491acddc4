"""From a save to pixels on the screen, in a browser that `candela view` serves: the median over some saves.

    python3 tests/bench/view.py BUILD [--saves N] [SCENE]       default: docs/examples/still-life.toml

The clock begins when the file is renamed to its place, and ends when the graphics have finished the page's first frame of the new scene.
"""
import argparse
import os
import pathlib
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

SHOWN = """
    const [generation, done] = arguments;
    const look = () => {
        if (location.search !== `?live=${generation}`) return setTimeout(look, 1);
        // One frame is drawn at the next chance, and has been once the one after that begins.
        requestAnimationFrame(() => requestAnimationFrame(() => {
            const gl = document.getElementById("picture-canvas").getContext("webgl2");
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
            done(Date.now());
        }));
    };
    look();"""


def main():
    options = argparse.ArgumentParser()
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("scene", nargs="?", type=pathlib.Path, default=ROOT / "docs" / "examples" / "still-life.toml")
    options.add_argument("--saves", type=int, default=15)
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
            time.sleep(3)  # until the picture is at rest
            milliseconds = []
            for i in range(options.saves):
                draft = scene.with_suffix(".draft")
                draft.write_text(text.replace(colors[-1], f"color = [{i}, 90, 200]"))
                begin = time.time()
                os.replace(draft, scene)
                milliseconds.append(browser.driver.execute_async_script(SHOWN, i + 2) - 1000 * begin)
                time.sleep(1)
        finally:
            browser.close()
            server.send_signal(signal.SIGINT)
            server.wait()
    print(f"from a save to the screen: median {statistics.median(milliseconds):.0f} ms, "
          f"{min(milliseconds):.0f} to {max(milliseconds):.0f} ms, {len(milliseconds)} saves of {options.scene.name}")


if __name__ == "__main__":
    main()
