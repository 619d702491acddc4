"""Pictures of `candela view`, for the documentation: the renderer's own picture over the page's, and an error in the file; an explained
pixel; panes with different models, and the scene from outside.

    /usr/bin/python3 tests/page/view_picture.py CANDELA SCENE PICTURE.png EXPLANATION.png PANES.png
"""
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

from browser import DRAWS_BY_ITSELF, Browser

command, scene, picture, explanation, panes = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(shutil.copy(scene, folder))
    # Each sample of a picture with shadows takes some ten seconds without a graphics card.
    file.write_text(re.sub(r"(?m)^samples( *)=.*", r"samples\1= 4", file.read_text()))
    server = subprocess.Popen([command, "view", "--no-open", "--quiet", file.name], cwd=folder, stdout=subprocess.PIPE, text=True)
    browser = Browser(*DRAWS_BY_ITSELF)
    try:
        browser.resize(1400, 900)
        browser.open(server.stdout.readline().strip())
        browser.enter("#explanation-x", "270")
        browser.enter("#explanation-y", "265")
        browser.one("#explanation-form button").click()
        while not browser.all("#explanation-result .bytes"):
            time.sleep(0.5)
        # Chooses the lamp among the lights.
        browser.run("""
            const lights = [...document.querySelectorAll("#explanation-result select")].at(-1);
            lights.value = "1";
            lights.dispatchEvent(new Event("change"));""")
        browser.wait_for_pictures()
        browser.driver.save_screenshot(explanation)
        browser.one("#explanation-close").click()
        browser.enter("#panes-layout", "two")
        browser.enter('[data-path="pane.1.reflection"] select', "ggx")
        for name in ("room", "observer"):
            browser.click(f"show-{name}")
        browser.wait_for_pictures()
        browser.driver.save_screenshot(panes)
        browser.click("reset-all")
        browser.enter("#reference-mode", "wipe")
        browser.wait_for("!document.getElementById('reference-canvas').hidden")
        text = file.read_text()
        file.write_text(text.replace("intensity", "intensty", 1))
        browser.wait_for("document.getElementById('scene-problems-text').textContent !== ''")
        browser.wait_for_pictures()  # in the place that is left
        browser.driver.save_screenshot(picture)
    finally:
        browser.close()
        server.send_signal(signal.SIGINT)
        server.wait()
