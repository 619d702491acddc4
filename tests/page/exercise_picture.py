"""A picture of an exercise's page, for the documentation: an answer that forgets that R.V may be negative.

    /usr/bin/python3 tests/page/exercise_picture.py CANDELA PICTURE.png
"""
import pathlib
import subprocess
import sys
import tempfile
import time

from browser import DRAWS_BY_ITSELF, Browser

command, picture = sys.argv[1:]
ANSWER = """float n_dot_l = dot(s.normal, to_light);
vec3 r = 2.0 * n_dot_l * s.normal - to_light;
float highlight = pow(abs(dot(r, s.to_observer)), m.shininess);
return Reflected(m.kd * s.color * max(n_dot_l, 0.0), m.ks * highlight);"""

with tempfile.TemporaryDirectory() as folder:
    page = pathlib.Path(folder) / "exercise.html"
    subprocess.run([command, "exercise", "new", "phong", "--blank", "reflect", "-o", str(page)], check=True, stderr=subprocess.DEVNULL)
    browser = Browser(*DRAWS_BY_ITSELF)
    try:
        browser.resize(1400, 760)
        browser.load(page.as_uri())
        browser.run("candelaExercise.editor.text = arguments[0]", ANSWER)
        browser.enter("#case", "1")
        time.sleep(2)
        browser.driver.save_screenshot(picture)
    finally:
        browser.close()
