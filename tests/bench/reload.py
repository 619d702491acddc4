"""From a saved mesh to the screen: `candela view` in a browser against f3d, in turns. Medians, and that of the rounds' ratios.

    /usr/bin/python3 tests/bench/reload.py BUILD [--rows N] [--rounds N]       N rows: 2 x N x N triangles

Debian 12's f3d has no --watch: its reload key is pressed at the moment of the save, so that the time to notice a save is not counted. Its
clock ends with the last change of its window; the page's when the graphics have finished the first frame of the new scene. Both draw on the
CPU.
"""
import argparse
import mmap
import os
import pathlib
import shutil
import signal
import statistics
import struct
import subprocess
import sys
import tempfile
import time

import large_mesh
from view import DRAWS_BY_ITSELF, SHOWN, Browser

SIZE = (840, 400)
RIPPLES = (0.005, 0.02)
LONGEST = 60  # seconds
REST = 2  # seconds without a change
SCENE = f"""version = 1
observer = {{position = [0, 1, 1.6], look_at = [0, 0, 0]}}
image = {{width = {SIZE[0]}, height = {SIZE[1]}, samples = 1}}
shading = {{model = "phong"}}
reflection = {{model = "phong"}}
light = [{{type = "directional", direction = [-1, -2, -3]}}]
object = [{{type = "mesh", file = "mesh.ply"}}]
"""


class Window:
    """f3d in its own display, whose pixels can be read from a file."""

    def __init__(self, mesh, folder):
        self.folder = folder
        number, write_end = os.pipe()
        self.display = subprocess.Popen(["Xvfb", "-displayfd", str(write_end), "-screen", "0", "{}x{}x24".format(*SIZE), "-fbdir", folder,
                                         "-nolisten", "tcp"], pass_fds=[write_end], stderr=subprocess.DEVNULL)
        os.close(write_end)
        with os.fdopen(number) as said:
            self.environment = dict(os.environ, DISPLAY=":" + said.readline().strip())
        screen = open(pathlib.Path(folder) / "Xvfb_screen0", "rb")
        self.screen = mmap.mmap(screen.fileno(), 0, access=mmap.ACCESS_READ)
        # The xwd format: the header's size, and as its 20th number how many 12-byte colours follow.
        header = struct.unpack(">25I", self.screen[:100])
        self.begin = header[0] + 12 * header[19]
        empty = self.pixels()
        self.program = subprocess.Popen(["f3d", mesh, "--resolution={},{}".format(*SIZE)], env=self.environment,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.last_change(empty)

    def pixels(self):
        """The middle half of the rows."""
        row = 4 * SIZE[0]
        return self.screen[self.begin + row * SIZE[1] // 4:self.begin + row * SIZE[1] * 3 // 4]

    def last_change(self, pixels):
        """The time of their last change."""
        end, changed = time.time() + LONGEST, None
        while changed is None or time.time() < changed + REST:
            now = self.pixels()
            if now != pixels:
                pixels, changed = now, time.time()
            if time.time() > end:
                sys.exit("reload: f3d's window did not change")
            time.sleep(0.001)
        return changed

    def read_again(self):
        subprocess.run(["xdotool", "key", "Up"], env=self.environment, check=True)

    def end(self):
        for one in (self.program, self.display):
            one.terminate()
            one.wait()


def main():
    options = argparse.ArgumentParser()
    options.add_argument("build", type=pathlib.Path)
    options.add_argument("--rows", type=int, default=150)
    options.add_argument("--rounds", type=int, default=9)
    options = options.parse_args()
    for program in ("f3d", "xdotool", "Xvfb"):
        if not shutil.which(program):
            sys.exit(f"reload: {program} is missing; scripts/setup.sh --programs installs it")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.toml").write_text(SCENE)
        versions = []
        for ripple in RIPPLES:
            versions.append(folder / f"ripple-{ripple}.ply")
            large_mesh.write(versions[-1], options.rows, ripple)
        meshes = [folder / "mesh.ply", folder / "f3d" / "mesh.ply"]
        meshes[1].parent.mkdir()

        def save(mesh, round_number):
            draft = mesh.with_suffix(".draft")
            shutil.copy(versions[round_number % 2], draft)
            begin = time.time()
            os.replace(draft, mesh)
            return begin

        for mesh in meshes:
            save(mesh, 0)
        browser = Browser(*DRAWS_BY_ITSELF)
        window = Window(meshes[1], name)
        server = subprocess.Popen([options.build / "bin" / "candela", "view", "--no-open", "--quiet", folder / "scene.toml"],
                                  stdout=subprocess.PIPE, text=True)
        rounds = []
        try:
            browser.open(server.stdout.readline().strip())
            browser.driver.execute_async_script(SHOWN, 1)
            for i in range(1, options.rounds + 1):
                time.sleep(2)
                begin = save(meshes[0], i)
                ours = browser.driver.execute_async_script(SHOWN, i + 1) / 1000 - begin
                time.sleep(2)
                before = window.pixels()
                begin = save(meshes[1], i)
                window.read_again()
                rounds.append((ours, window.last_change(before) - begin))
        finally:
            browser.close()
            server.send_signal(signal.SIGINT)
            server.wait()
            window.end()
    print(f"{2 * options.rows ** 2} triangles: candela view {1000 * statistics.median(ours for ours, _ in rounds):.0f} ms, "
          f"f3d {1000 * statistics.median(theirs for _, theirs in rounds):.0f} ms, "
          f"ratio {statistics.median(ours / theirs for ours, theirs in rounds):.2f}")


if __name__ == "__main__":
    main()
