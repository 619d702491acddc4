"""A picture of a generated page, for the documentation.

    /usr/bin/python3 tests/page/page_picture.py PAGE.html PICTURE.png
"""
import pathlib
import sys

from browser import DRAWS_BY_ITSELF, Browser

page, picture = sys.argv[1:]
browser = Browser(*DRAWS_BY_ITSELF, "--hide-scrollbars")
try:
    browser.resize(1400, 900)
    browser.open(pathlib.Path(page).resolve().as_uri())
    browser.wait_for_pictures()
    browser.driver.save_screenshot(picture)
finally:
    browser.close()
