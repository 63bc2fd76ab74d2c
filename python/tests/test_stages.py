"""Stages agree with closed forms and identities."""

import unittest

import numpy as np
import relievo


def sphere(radius, points=4000):
    """Returns evenly spaced points on a sphere, and their normals."""
    i = np.arange(points) + 0.5
    z, turn = 1 - 2 * i / points, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    normals = np.column_stack([r * np.cos(turn), r * np.sin(turn), z])
    return radius * normals, normals


def grid(n):
    """Returns the points of a jittered lattice over a square of side 2 around the origin."""
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n))
    inside = (abs(x) < 1) & (abs(y) < 1)
    noise = np.random.default_rng(1).normal(0, 0.1 / n, x.shape)
    return np.column_stack([(x + noise * inside).ravel(), (y - noise * inside).ravel()])


class Stages(unittest.TestCase):
    def test_half_of_a_sphere_is_visible(self):
        points, normals = sphere(3)
        for given in [(points, normals), (points,)]:
            seen = relievo.visible_points(*given, view="right")
            self.assertAlmostEqual(len(seen) / len(points), 0.5, delta=0.03)
            self.assertGreater(points[seen, 0].min(), -0.3)
        self.assertTrue(np.array_equal(relievo.visible_points(points, normals, view=(1, 0, 0)), relievo.visible_points(points, normals, view="right")))

    def test_a_sphere_has_the_curvature_of_its_radius(self):
        points, normals = sphere(4)
        np.testing.assert_allclose(relievo.mean_curvature(points, normals), 0.25, rtol=0.02)
        np.testing.assert_allclose(relievo.mean_curvature(points, -normals, [5, 2], scale=3), -0.25, rtol=0.02)

    def test_normals_of_a_sphere_point_along_its_radii(self):
        points, normals = sphere(4)
        along = np.einsum("ij,ij->i", relievo.estimate_normals(points), normals)
        self.assertGreater(abs(along).min(), 0.99)

    def test_triangles_cover_the_convex_hull(self):
        points = np.random.default_rng(2).random((500, 2))
        points[:4] = [[0, 0], [1, 0], [0, 1], [1, 1]]
        a, b, c = (points[corner] for corner in relievo.triangulate(points).T)
        areas = np.cross(b - a, c - a) / 2
        self.assertGreater(areas.min(), 0)
        self.assertAlmostEqual(areas.sum(), 1)

    def test_heights_fit_the_slopes_of_a_surface(self):
        points = grid(60)
        x, y = points.T
        heights = (1 - x * x) * (1 - y * y)
        slopes = np.column_stack([-2 * x * (1 - y * y), -2 * y * (1 - x * x)])
        np.testing.assert_allclose(relievo.solve_heights(points, slopes), heights, atol=0.01)
        system = relievo.HeightSystem(points, weights=np.ones(len(points)))
        solved = system.solve(slopes)
        np.testing.assert_allclose(solved, heights, atol=0.01)
        self.assertTrue((solved[system.is_boundary] == 0).all() and system.is_boundary.sum() >= 4 * 59)
        self.assertEqual(system.triangles.shape[1], 3)
        for other in [np.asfortranarray(slopes), slopes.tolist(), np.repeat(slopes, 2, axis=0)[::2]]:
            self.assertTrue(np.array_equal(system.solve(other), solved))
        np.testing.assert_allclose(system.solve(3 * slopes), 3 * solved, rtol=1e-9, atol=1e-12)

    def test_refuse_wrong_arrays(self):
        points, normals = sphere(1, 100)
        system = relievo.HeightSystem(grid(5))
        nothing = np.full((25, 2), np.nan)
        calls = [
            lambda: relievo.visible_points(points[:, :2]),
            lambda: relievo.visible_points(points * 0),
            lambda: relievo.visible_points(points, view="below"),
            lambda: relievo.mean_curvature(points, normals[:5]),
            lambda: relievo.mean_curvature(points, normals, [100]),
            lambda: relievo.mean_curvature(points, normals, [[1]]),
            lambda: relievo.mean_curvature(points, normals, [0.5]),
            lambda: relievo.mean_curvature(points, normals, scale=float("nan")),
            lambda: relievo.estimate_normals(points[:2]),
            lambda: relievo.estimate_normals(points, 1),
            lambda: relievo.triangulate(points),
            lambda: relievo.triangulate(np.zeros((0, 2))),
            lambda: relievo.triangulate([[0, 0], [1, 1], [2, 2]]),
            lambda: relievo.triangulate([[0, 0], [1, np.nan], [2, 2]]),
            lambda: relievo.triangulate([[0, 0], [1e80, 0], [0, 1e80]]),
            lambda: relievo.HeightSystem(grid(5), rho=-1),
            lambda: relievo.HeightSystem(grid(5), weights=[1]),
            lambda: relievo.HeightSystem(grid(5), weights=np.zeros(25)),
            lambda: system.solve(nothing),
            lambda: system.solve(nothing[:3]),
            lambda: system.solve(np.zeros((25, 3))),
            lambda: relievo.sample("teapot"),
            lambda: relievo.sample("shell", points=1),
        ]
        for i, call in enumerate(calls):
            with self.subTest(i), self.assertRaises(relievo.Error):
                call()
        self.assertEqual(len(relievo.HeightSystem([[0, 0], [1, 0], [0, 1]]).solve(np.ones((3, 2)))), 3)
