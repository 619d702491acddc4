"""Checks that `candela explain` computes the same as plugins with tables, matrices, places, texture coordinates and prepared constants.

    explained.py CANDELA PLUGINS SCENE X,Y...
"""
import json
import subprocess
import sys

candela, plugins, scene, *pixels = sys.argv[1:]
for pixel in pixels:
    done = subprocess.run([candela, "explain", scene, "--plugin-dir", plugins, "--pixel", pixel, "--json"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    pixel_of = json.loads(done.stdout)
    assert pixel_of["fragments"], f"{pixel}: no object is visible"
    assert "note" not in pixel_of or not pixel_of["note"], pixel_of["note"]
    difference = pixel_of["kernel_difference"]
    assert difference is not None and difference < 1e-5, f"{pixel}: kernels and plugins differ by {difference}"
    print(f"{pixel}: {difference:.2g}")
