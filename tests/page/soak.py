"""Runs `candela view` for a long time: saves without a pause, half of them broken, in several browsers; SIGINT in the middle.

    CANDELA=build/release/bin/candela /usr/bin/python3 tests/page/soak.py [--minutes 20] [--browsers chromium,chromium,firefox,firefox]

Every few seconds the saves pause, and all pages must show the last good version, and the errors of the last save if it is broken. The
server and its largest child must not use ever more memory, files or threads.
"""
import argparse
import itertools
import json
import os
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import threading
import time

from browser import DRAWS_BY_ITSELF, Browser
from pictures import Picture
from served import COMMAND, ENVIRONMENT, LONGEST, View, children_of, status_of

SIZE = (64, 48)
WINDOW = (320, 240)  # each pixel on the screen is drawn by the processor
SECONDS_OF_SAVES = 6  # between two checks of the pages
MOST_GROWTH = {"server, kB": 2048, "threads": 1, "open files": 8, "children, kB": 2048}  # plus a twentieth of values in kB
SETTLED = 0.2  # of the time: caches fill until then


class Memory:
    """The resources of the server and its children over time: the maximum of each second."""

    def __init__(self, server):
        self.server = server
        self.series = {name: [] for name in MOST_GROWTH}
        self.ending = threading.Event()
        self.thread = threading.Thread(target=self.watch)
        self.thread.start()

    def watch(self):
        while not self.ending.is_set():
            most = dict.fromkeys(self.series, 0)
            for _ in range(50):  # children live for some tens of milliseconds
                children = [state[0] for state in map(status_of, children_of(self.server)) if state]
                for name, value in zip(self.series, (*(status_of(self.server) or ()), max(children, default=0)), strict=False):
                    most[name] = max(most[name], value)
                if self.ending.wait(0.02):
                    return
            for name, value in most.items():
                self.series[name].append(value)

    def end(self):
        self.ending.set()
        self.thread.join()

    @staticmethod
    def early_and_late(series):
        settled = series[int(SETTLED * len(series)):]
        part = max(len(settled) // 3, 1)
        return statistics.median(settled[:part]), statistics.median(settled[-part:])

    def report(self):
        """A line for each, and whether all are flat."""
        is_flat = True
        for name, series in self.series.items():
            early, late = self.early_and_late(series)
            grows = late > early + MOST_GROWTH[name] + (early / 20 if "kB" in name else 0)
            is_flat = is_flat and not grows
            print(f"{name}: {early:.0f} early, {late:.0f} late, {max(series)} at most" + (": IT GROWS" if grows else ""))
        return is_flat


class Soak:
    def __init__(self, browsers, rate, seed):
        self.view = View("soak")
        self.rate = rate
        self.chance = random.Random(seed)
        self.saves = self.broken = self.looks = 0
        self.colors = itertools.count()
        self.good = self.view.file.read_text()
        self.browsers, self.memory = [], None
        for name in browsers:
            self.browsers.append(Browser(*DRAWS_BY_ITSELF, name=name))
            self.browsers[-1].resize(*WINDOW)
            self.browsers[-1].load(self.view.address)
        self.save_and_look(SECONDS_OF_SAVES)  # until every series has an entry
        self.memory = Memory(self.view.process.pid)

    def save(self, is_broken):
        color = next(self.colors)
        good = self.view.text(color % 256, color // 256 % 256)
        text = good.replace("cube", f"cub{color}") if is_broken else good
        if self.chance.random() < 0.3:
            self.view.file.write_text(text)  # in place, as some editors do
        else:
            self.view.replace(text)
        self.saves += 1
        self.broken += is_broken
        if not is_broken:
            self.good = good
        return f"cub{color}" if is_broken else None

    def save_for(self, seconds):
        """Saves at the given rate, or as fast as possible; the last save is good."""
        begin = time.monotonic()
        for i in range(max(round(seconds * self.rate), 1)):
            time.sleep(max(begin + i / self.rate - time.monotonic(), 0))
            self.save(self.chance.random() < 0.5)
        self.save(False)

    def expected(self):
        file, picture = self.view.folder / "expected.toml", self.view.folder / "expected.ppm"
        file.write_text(self.good)
        subprocess.run([COMMAND, "render", "--quiet", file, "-o", picture], env=ENVIRONMENT, check=True)
        return Picture.of_ppm(picture)

    def look(self, wrong):
        """Checks that no page has lost an update."""
        expected = self.expected()
        middle = 3 * (SIZE[1] // 2 * SIZE[0] + SIZE[0] // 2)
        for number, browser in enumerate(self.browsers):
            end = time.monotonic() + LONGEST
            while True:
                shown = browser.picture(*SIZE)
                said = browser.run("const box = document.getElementById('scene-problems'); return box.hidden ? '' : box.textContent;")
                differing = sum(d > 2 for d in shown.differences(expected))
                if differing < 0.02 * SIZE[0] * SIZE[1] and (wrong in said if wrong else said == ""):
                    break
                assert time.monotonic() < end, (
                    f"browser {number} ({browser.name}) shows {list(shown.pixels[middle:middle + 3])}, not {list(expected.pixels[middle:middle + 3])}, "
                    f"and shows {said!r} although the last save {'has ' + wrong if wrong else 'is good'}")
                time.sleep(0.05)
        if not wrong:
            answer = self.view.get(f"/{self.view.token}/explanation.json?pixel={SIZE[0] // 2}%2C{SIZE[1] // 2}")
            said = json.loads(answer.split(b"\r\n\r\n", 1)[1])["bytes"]
            assert said == list(expected.pixels[middle:middle + 3]), f"the explanation ends with {said}"
        self.looks += 1

    def save_and_look(self, seconds):
        self.save_for(seconds)
        self.look(None)
        # Versions that exist for less time than it takes to read them may be missed; this one has been seen.
        if self.chance.random() < 0.5:
            self.look(self.save(True))

    def run(self, minutes):
        end = time.monotonic() + 60 * minutes
        while time.monotonic() < end:
            self.save_and_look(min(SECONDS_OF_SAVES, max(end - time.monotonic(), 0)))
        for browser in self.browsers:
            problems = [text for text in browser.errors() if "favicon" not in text]
            assert not problems, f"{browser.name}: {problems[:3]}"

    def end(self):
        """Ends the server in the middle of a save."""
        self.save(False)
        time.sleep(self.chance.random() * 0.05)
        code = self.view.end(signal.SIGINT)
        assert code == 0, f"exit code {code}"
        left = self.view.left_behind()
        assert not left, f"left behind: {left}"
        mark = f"TMPDIR={self.view.temporary}".encode()
        for process in filter(str.isdigit, os.listdir("/proc")):
            try:
                environment = pathlib.Path(f"/proc/{process}/environ").read_bytes().split(b"\0")
            except OSError:
                continue
            assert mark not in environment, f"process {process} is still running"

    def close(self):
        if self.memory:
            self.memory.end()
        for browser in self.browsers:
            browser.close()
        if self.view.process.poll() is None:
            self.view.process.kill()


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--minutes", type=float, default=1)
    options.add_argument("--browsers", default="chromium,chromium,firefox,firefox")
    options.add_argument("--rate", type=float, default=5, help="saves a second")
    options.add_argument("--seed", type=int, default=17)
    options = options.parse_args()
    soak = Soak(options.browsers.split(","), options.rate, options.seed)
    try:
        soak.run(options.minutes)
        soak.memory.end()
        is_flat = soak.memory.report()
        soak.end()
    finally:
        soak.close()
    print(f"{soak.saves} saves, {soak.broken} of them broken; {len(soak.browsers)} browsers looked at {soak.looks} times: no update was lost")
    return 0 if is_flat else 1


if __name__ == "__main__":
    sys.exit(main())
