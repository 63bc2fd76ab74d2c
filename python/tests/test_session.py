"""Sessions make frames, finished reliefs and pictures, and leak no memory over 10,000 frames."""

import os
import resource
import unittest

import numpy as np
import relievo
from support import InFolder, scan, still_life

FRAMES = int(os.environ.get("RELIEVO_FRAMES", 10_000))


def resident_mb():
    """Returns the memory that the process uses now."""
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 1e6


def least_growth_mb(parts, run):
    """Calls run() `parts` times, and returns the least growth of memory in a call, as a leak occurs in every call."""
    growths = []
    for _ in range(parts):
        before = resident_mb()
        run()
        growths.append(resident_mb() - before)
    return min(growths)


class Frames(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.session = relievo.Session(scan(), width_mm=80)

    def test_have_a_height_for_each_point(self):
        frame = self.session.frame(height_mm=4)
        self.assertEqual(frame.heights.shape, (len(self.session.points),))
        self.assertEqual(frame.normals.shape, self.session.points.shape)
        self.assertEqual(self.session.is_inside.shape, (len(self.session.triangles),))
        self.assertAlmostEqual(frame.height_mm, 4, delta=0.004)
        self.assertAlmostEqual(float(np.ptp(np.append(frame.heights, 0))), 4, delta=0.004)
        np.testing.assert_allclose(np.linalg.norm(frame.normals, axis=1), 1, atol=1e-5)
        self.assertTrue(frame.is_height_met)
        self.assertFalse(self.session.frame(height_mm=1000).is_height_met)
        self.assertAlmostEqual(np.ptp(self.session.points[:, :2], axis=0).max() * frame.mm_per_unit, 80)

    def test_grow_with_the_width_and_follow_the_options(self):
        paper = relievo.Session(scan(), width_mm=80, method="paper")
        small, large = paper.frame(width_mm=40, alpha=3), paper.frame(alpha=3)
        np.testing.assert_allclose(small.heights * 2, large.heights, rtol=1e-5, atol=1e-6)
        self.assertGreater(paper.frame(alpha=1, saturation=2).height_mm, paper.frame(alpha=9, saturation=2).height_mm)
        tones = [self.session.frame(height_mm=3, tone=t).heights for t in ([(0, 1), (1, 1)], [(0, 1), (1, 0.2)])]
        self.assertGreater(np.abs(tones[0] - tones[1]).max(), 0.01)

    def test_are_arrays_that_stay(self):
        kept = [self.session.frame(height_mm=h).heights for h in (2, 5)]
        copies = [heights.copy() for heights in kept]
        for height in range(1, 20):
            self.session.frame(height_mm=height)
        for heights, copy in zip(kept, copies):
            self.assertTrue(np.array_equal(heights, copy))
            with self.assertRaises(ValueError):
                heights[0] = 1

    def test_can_be_drawn(self):
        frame = self.session.frame(height_mm=4)
        picture = self.session.picture(frame, width=120, height=90, yaw_deg=30, material="silver")
        self.assertEqual((picture.shape, picture.dtype), ((90, 120, 4), np.uint8))
        self.assertEqual(picture[:, :, 3].max(), 255)
        for wrong in [{"width": 0}, {"zoom": float("nan")}, {"material": "jelly"}, {"pitch_deg": 91}]:
            with self.assertRaises(relievo.Error):
                self.session.picture(frame, **wrong)
        other = relievo.Session(still_life()).frame()
        with self.assertRaises(relievo.Error):
            self.session.picture(other)

    def test_refuse_what_is_prepared_or_is_no_shape(self):
        with self.assertRaisesRegex(TypeError, "'view': a session prepares it once"):
            self.session.make(view="left")
        with self.assertRaisesRegex(TypeError, "'draft_deg': make\\(\\) takes it"):
            self.session.frame(draft_deg=15)
        with self.assertRaisesRegex(TypeError, "the nearest is 'height_mm'"):
            self.session.frame(height=4)
        with self.assertRaisesRegex(TypeError, "'method': a session prepares it once"):
            self.session.frame(height_mm=4, method="paper")
        with self.assertRaises(relievo.Error):
            relievo.Session(still_life(), method="gradient").frame(height_mm=4)
        with self.assertRaises(relievo.Error):
            self.session.frame(height_mm=-4)

    def test_and_reliefs_replace_options_of_the_session(self):
        points = scan()
        session = relievo.Session(points, plate="80x60", height_mm=3, resolution_mm=1)
        relief, coin = session.make(), session.make(diameter_mm=40)
        self.assertEqual(relief.to_bytes("stl"),
                         relievo.make(points, plate="80x60", height_mm=3, resolution_mm=1).to_bytes("stl"))
        self.assertEqual(coin.to_bytes("stl"),
                         relievo.make(points, diameter_mm=40, height_mm=3, resolution_mm=1).to_bytes("stl"))
        self.assertEqual(session.make(plate=None, width_mm=50).to_bytes("stl"),
                         relievo.make(points, width_mm=50, height_mm=3, resolution_mm=1).to_bytes("stl"))

    def test_and_reliefs_keep_the_method_and_replace_the_base(self):
        points, image = scan(), np.linspace(0, 1, 400, dtype=np.float32).reshape(20, 20)
        session = relievo.Session(points, alpha=3, base_image=image, resolution_mm=1)
        self.assertEqual(session.make(height_mm=2, base="dome:height=4").to_bytes("stl"),
                         relievo.make(points, method="paper", height_mm=2, base="dome:height=4", resolution_mm=1).to_bytes("stl"))
        self.assertEqual(session.make().to_bytes("stl"),
                         relievo.make(points, alpha=3, base_image=image, resolution_mm=1).to_bytes("stl"))
        dome = relievo.Session(points, base="dome:height=4", resolution_mm=1)
        self.assertEqual(dome.make(base_image=image).to_bytes("stl"),
                         relievo.make(points, base_image=image, resolution_mm=1).to_bytes("stl"))

    def test_leak_nothing(self):
        session = relievo.Session(relievo.sample("shell", points=1000))
        sweep = [{"height_mm": 2 + i / 10, "saturation": i / 5} for i in range(10)]

        def run(frames):
            for i in range(frames):
                session.frame(**sweep[i % 10]).heights[0]

        run(500)
        # If each of the 10,000 frames leaked a hundred bytes, the memory would grow by 0.2 MB in each fifth of them.
        self.assertLess(least_growth_mb(5, lambda: run(FRAMES // 5)), 0.15)

    def test_and_reliefs_leak_nothing(self):
        points = np.array(relievo.sample("shell", points=2000).points)

        def run(reliefs):
            for i in range(reliefs):
                relievo.make(points, height_mm=2, resolution_mm=2).report["height_mm"]
                with self.assertRaises(relievo.Error):
                    relievo.make(points, width_mm=-1)

        run(4)
        self.assertLess(least_growth_mb(4, lambda: run(5)), 1)


class Finished(InFolder):
    def test_reliefs_are_those_of_make(self):
        session = relievo.Session("scan.ply", resolution_mm=0.5, width_mm=60, denoise=0.1)
        for options in [{"height_mm": 3}, {"height_mm": 2, "outline": "circle", "rim_mm": 1}, {}]:
            one, other = session.make(**options), relievo.make("scan.ply", resolution_mm=0.5, width_mm=60, denoise=0.1, **options)
            self.assertEqual(one.to_bytes("ply"), other.to_bytes("ply"))
            self.assertEqual(one.report["models"], other.report["models"])
            self.assertEqual(one.remarks, other.remarks)
