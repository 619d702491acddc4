"""Threads, and memory."""
import concurrent.futures
import pathlib
import sys
import threading
import unittest

import numpy as np

import candela

BALL = {
    "observer": {"position": [0, 0, 4], "look_at": [0, 0, 0]},
    "image": {"width": 96, "height": 64},
    "shading": {"model": "phong"},
    "reflection": {"model": "phong"},
    "light": [{"name": "lamp", "type": "point", "position": [2, 2, 3], "intensity": 10}],
    "object": [{"name": "ball", "type": "sphere"}],
}


def resident():
    """The memory of this process in bytes."""
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096


class Threads(unittest.TestCase):
    def test_pictures_of_many_threads_are_those_of_one(self):
        scene = candela.Scene.from_dict(BALL)
        renderer = candela.Renderer(scene)
        expected = scene.render()
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            of_scene = [pool.submit(scene.render) for _ in range(40)]
            of_renderer = [pool.submit(renderer.render) for _ in range(40)]
            of_others = [pool.submit(lambda: candela.Scene.from_dict(BALL).render()) for _ in range(20)]
            for picture in of_scene + of_renderer + of_others:
                np.testing.assert_array_equal(picture.result(), expected)

    def test_another_thread_runs_while_a_picture_is_rendered(self):
        scene = candela.Scene.from_dict(BALL, settings={"image.width": 800, "image.height": 800})
        gate, seen = threading.Semaphore(0), []

        def other():
            gate.acquire()
            seen.append(True)

        thread = threading.Thread(target=other)
        thread.start()
        interval = sys.getswitchinterval()
        # From here on, a thread gets Python's lock only if another releases it.
        sys.setswitchinterval(1000)
        try:
            gate.release()
            # The system decides whether the other thread runs during a particular picture.
            for _ in range(1000):
                scene.render()
                if seen:
                    break
            self.assertTrue(seen)
        finally:
            sys.setswitchinterval(interval)
            thread.join()


class Memory(unittest.TestCase):
    def test_a_thousand_pictures_leave_no_memory_behind(self):
        scene = candela.Scene.from_dict(BALL)
        renderer = candela.Renderer(scene)
        size = scene.render(floats=True).nbytes
        for _ in range(100):
            scene.render(floats=True), renderer.render(floats=True)
        before = resident()
        for _ in range(1000):
            scene.render(floats=True), renderer.render(floats=True)
        # Leaking pictures would add up to 2000 of them.
        self.assertLess(resident() - before, 100 * size)


if __name__ == "__main__":
    unittest.main()
