"""Long calls leave other threads running, can be watched and ended, and may be made by several threads."""

import multiprocessing
import os
import signal
import threading
import time
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import relievo
from support import scan


def heights_of_a_frame(height):
    """Makes a relief in a new process."""
    return round(relievo.make(scan(), height_mm=height, resolution_mm=0.5).report["height_mm"], 12)


class Calls(unittest.TestCase):
    def test_are_watched(self):
        seen = []
        relievo.make(scan(), height_mm=3, resolution_mm=0.5, progress=lambda stage, fraction: seen.append((stage, fraction)))
        stages, fractions = zip(*seen)
        self.assertEqual((stages[-1], fractions[-1]), ("done", 1.0))
        self.assertEqual(list(fractions), sorted(fractions))
        self.assertIn("curvature", stages)

    def test_end_with_what_the_callback_raises(self):
        class Enough(Exception):
            pass

        def stop(stage, fraction):
            if fraction > 0.1:
                raise Enough(stage)

        for call in [relievo.make, relievo.Session]:
            with self.assertRaises(Enough):
                call(scan(), progress=stop)
        with self.assertRaises(TypeError):
            relievo.make(scan(), progress=lambda: None)
        relievo.make(scan(), height_mm=3, resolution_mm=0.5)  # the library works as before

    def test_end_with_ctrl_c(self):
        # A shell that starts the tests in the background makes them ignore SIGINT, so the test sets the usual handler.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        large = relievo.sample("shell", points=300_000)
        begun = threading.Event()

        def interrupt():
            begun.wait()
            os.kill(os.getpid(), signal.SIGINT)

        thread = threading.Thread(target=interrupt)
        thread.start()
        seen = []

        def watch(stage, fraction):
            seen.append(fraction)
            begun.set()

        with self.assertRaises(KeyboardInterrupt):
            relievo.make(large, height_mm=3, resolution_mm=0.5, progress=watch)
        thread.join()
        self.assertLess(max(seen), 0.9)

    def test_leave_other_threads_running(self):
        counted = []

        def count():
            while not done.is_set():
                counted.append(time.perf_counter())
                time.sleep(0.001)

        done = threading.Event()
        thread = threading.Thread(target=count)
        thread.start()
        begin = time.perf_counter()
        relievo.make(scan(), height_mm=3, resolution_mm=0.5)
        end = time.perf_counter()
        done.set()
        thread.join()
        self.assertGreater(sum(begin < at < end for at in counted), 5)

    def test_give_the_same_in_several_threads(self):
        heights = [2, 3, 4, 5]
        alone = [relievo.make(scan(), height_mm=h, resolution_mm=0.5).to_bytes("stl") for h in heights]
        # These frames need not meet a height. Otherwise the search for u would start from the last frame, and a frame
        # would depend on the order of frames.
        session = relievo.Session(scan(), method="paper")
        frames = [session.frame(saturation=h).heights.copy() for h in heights]
        with ThreadPoolExecutor(4) as pool:
            together = list(pool.map(lambda h: relievo.make(scan(), height_mm=h, resolution_mm=0.5).to_bytes("stl"), heights))
            swept = list(pool.map(lambda h: session.frame(saturation=h).heights, heights * 20))
        self.assertEqual(together, alone)
        for i, heights_ in enumerate(swept):
            self.assertTrue(np.array_equal(heights_, frames[i % 4]))

    def test_give_the_same_with_any_number_of_library_threads(self):
        before = relievo.threads()
        try:
            made = []
            for number in (1, 3):
                relievo.set_threads(number)
                self.assertEqual(relievo.threads(), number)
                made.append(relievo.make(scan(), height_mm=3, resolution_mm=0.5).to_bytes("stl"))
            self.assertEqual(made[0], made[1])
            for wrong in (-1, 257):
                with self.assertRaises(ValueError):
                    relievo.set_threads(wrong)
            with self.assertRaises(RuntimeError):
                relievo.make(scan(), progress=lambda stage, fraction: relievo.set_threads(2))
        finally:
            relievo.set_threads(before)

    @unittest.skipIf("LD_PRELOAD" in os.environ, "a sanitizer's processes cannot be forked with threads")
    def test_work_in_forked_and_spawned_processes(self):
        relievo.make(scan(), height_mm=3, resolution_mm=0.5)
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(2) as pool:
                self.assertEqual(pool.map(heights_of_a_frame, [2, 3, 4]), [2, 3, 4])
        self.assertEqual(heights_of_a_frame(3), 3)
