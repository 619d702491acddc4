"""The page that `candela generate --target webgl` writes, in a browser, compared with `candela render` of the same scene.

Run by ctest, which sets the paths; by hand: CANDELA=build/release/bin/candela /usr/bin/python3 tests/page/page_test.py
"""
import unittest

from access import Access
from accessible import Accessible, AccessibleExercise, AccessibleThree, AccessibleView
from controls import Controls
from exercising import Exercising
from formulas import Formulas, Keeping
from layers import Layers
from lights import Lights
from links import Links
from looking import Looking
from panes import Panes
from picturing import Picturing
from robustness import Robustness
from shadows import Shadows
from three_pages import Three
from typesetting import Typesetting
from viewing import Viewing

__all__ = ["Access", "Accessible", "AccessibleExercise", "AccessibleThree", "AccessibleView", "Controls", "Exercising", "Formulas", "Keeping", "Layers", "Lights", "Links", "Looking", "Panes", "Picturing", "Robustness",
           "Shadows", "Three", "Typesetting", "Viewing"]

if __name__ == "__main__":
    unittest.main()
