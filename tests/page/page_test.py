"""The page that `candela generate --target webgl` writes, in a browser, beside what `candela render` makes of the same scene.

Run by ctest, which says where things are; by hand: CANDELA=build/release/bin/candela /usr/bin/python3 tests/page/page_test.py
"""
import unittest

from access import Access
from controls import Controls
from links import Links
from looking import Looking
from picturing import Picturing
from robustness import Robustness
from viewing import Viewing

__all__ = ["Access", "Controls", "Links", "Looking", "Picturing", "Robustness", "Viewing"]

if __name__ == "__main__":
    unittest.main()
