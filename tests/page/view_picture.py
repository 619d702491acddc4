"""Pictures of `candela view`, for the documentation: the renderer's own picture over the page's, and an error in the file; an explained
pixel; panes with different models, and the scene from outside.

    /usr/bin/python3 tests/page/view_picture.py CANDELA SCENE PICTURE.png EXPLANATION.png PANES.png
"""
import pathlib
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
    server = subprocess.Popen([command, "view", "--no-open", "--quiet", file.name], cwd=folder, stdout=subprocess.PIPE, text=True)
    browser = Browser(*DRAWS_BY_ITSELF)
    try:
        browser.resize(1400, 900)
        browser.open(server.stdout.readline().strip())
        time.sleep(20)
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
        browser.driver.save_screenshot(explanation)
        browser.one("#explanation-close").click()
        browser.enter("#panes-layout", "two")
        browser.enter('[data-path="pane.1.reflection"] select', "ggx")
        for name in ("room", "observer"):
            browser.click(f"show-{name}")
        time.sleep(60)
        browser.driver.save_screenshot(panes)
        browser.click("reset-all")
        browser.enter("#reference-mode", "wipe")
        time.sleep(20)  # until both pictures are at rest
        text = file.read_text()
        file.write_text(text.replace("intensity", "intensty", 1))
        time.sleep(20)
        browser.driver.save_screenshot(picture)
    finally:
        browser.close()
        server.send_signal(signal.SIGINT)
        server.wait()
