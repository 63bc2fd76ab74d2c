"""An independent reference of Nie et al., "Bas-relief Generation from Point Clouds Based on Normal Space
Compression with Real-time Adjustment on CPU", written from the text of the paper alone, in double precision.

The text leaves some points open. This file interprets it as follows:

 1. rho is the median over all points of sqrt(pi r_8^2 / 8), where r_8 is the distance in space to the 8th nearest
    other point.
 2. The viewer looks down -z. Points and normals are in view coordinates.
    Normals point outward and are scaled to length 1 first; a zero normal stays zero, so its point is dropped by 3.
 3. Grid cells have the side 2 rho and start at the minimum x and y of all points. A point is visible if its z is at
    least its cell's greatest z minus 2 rho and its normal has n_z > 0.
 4. In (2), Q is the set of all points of the cloud within 3 h of x, x included; theta = exp(-|y - q|^2 / h^2) and
    h = 3 rho. n(x) is the normalised theta-weighted mean of the normals of Q. It depends on x, so its derivatives
    count. Q is constant under differentiation. (3) is evaluated at the point itself, not at its projection, with
    the opposite sign, so that convex is positive. Where the gradient or the mean normal is 0, k is 0.
 5. |k| is clipped at its 99th percentile over the visible points and divided by it. If that percentile is below
    1e-9 / rho, the surface is flat up to rounding and k is 0. delta is the population standard deviation of |k|.
 6. P_b consists of the corners of Delaunay triangles with a circumradius above 3 rho, the corners of the convex hull's
    edges, and the points in no triangle (of points that coincide in the plane, Qhull leaves out all but one).
 7. In the exact mode every visible point is a control point.
 8. Q of (8) consists of the six nearest other points in the view plane; the k-d tree decides ties. Each row is
    divided by the z of the expected normal: z_p - z_q = s_p . ((x, y)_p - (x, y)_q), where |s| is at most 4. Each
    boundary point adds the row z_p = 0 with weight 1.
 9. A height span is max - min, where 0 counts as a height. In the second (9), the detail, h is the span without detail.
10. The defaults are alpha 4, beta 0.01 and gamma 0.02.
11. In (6), w_k is 1 everywhere at alpha = 0; at alpha, beta > 0 it is 0 where k is 0; at beta = 0 < alpha it is
    1 - 1/e everywhere. If delta is 0, the limit of small delta is taken: 1 where k is not 0.
"""
from dataclasses import dataclass

import numpy as np
from scipy.spatial import Delaunay, QhullError, cKDTree

NEIGHBOURS = 6          # Section 3.4 takes six neighbours for each control point.
STEEPEST = 4.0          # Reading 8 limits slopes to this length.
TOLERANCE = 1e-12       # This relative residual makes heights exact to 1e-10 of their span.
PAIRS_AT_ONCE = 60_000  # This limits the memory of the curvature: a jet of so many pairs takes 6 MB.


@dataclass
class Relief:
    """The result. All arrays have one entry per visible point."""

    index: np.ndarray     # The indices of the visible points in the input, ascending.
    z: np.ndarray         # The heights above the base, including the detail.
    k: np.ndarray         # The normalised mean curvature, positive where the surface is convex.
    delta: float          # The standard deviation of |k|, see (6).
    boundary: np.ndarray  # True for the points in P_b.
    rho: float            # The sampling distance of the cloud, see reading 1.
    height: float         # The height span of z, see reading 9.


# ---------------------------------------------------------------- Section 3.2: visible points and their curvature


def sampling_density(points):
    """Section 3.2, reading 1: returns rho, the side of the square that one point stands for."""
    r8 = cKDTree(points).query(points, k=9)[0][:, 8]
    return float(np.median(np.sqrt(np.pi * r8**2 / 8)))


def visible_points(points, normals, rho):
    """Section 3.2, reading 3: returns the ascending indices of the visible points."""
    cell = np.floor((points[:, :2] - points[:, :2].min(axis=0)) / (2 * rho)).astype(np.int64)
    cell = cell[:, 0] * (cell[:, 1].max() + 1) + cell[:, 1]
    cell = np.unique(cell, return_inverse=True)[1]
    top = np.full(cell.max() + 1, -np.inf)
    np.maximum.at(top, cell, points[:, 2])
    return np.flatnonzero((points[:, 2] >= top[cell] - 2 * rho) & (normals[:, 2] > 0))


class Jet:
    """A function's Taylor expansion up to second order at N points: value (N), gradient (3, N), Hessian (3, 3, N)."""

    def __init__(self, value, gradient, hessian):
        self.value, self.gradient, self.hessian = value, gradient, hessian

    def parts(self, function):
        """Applies a linear function to the value, the gradient and the Hessian."""
        return Jet(function(self.value), function(self.gradient), function(self.hessian))

    def __add__(self, other):
        return Jet(self.value + other.value, self.gradient + other.gradient, self.hessian + other.hessian)

    def __mul__(self, other):
        """Computes the product of two jets by the product rule."""
        cross = self.gradient[:, None] * other.gradient[None]
        return Jet(self.value * other.value,
                   self.value * other.gradient + other.value * self.gradient,
                   self.value * other.hessian + other.value * self.hessian + cross + cross.swapaxes(0, 1))

    def through(self, f, df, ddf):
        """Computes f(self) by the chain rule, where f, df and ddf are f and its derivatives at the value."""
        square = self.gradient[:, None] * self.gradient[None]
        return Jet(f, df * self.gradient, df * self.hessian + ddf * square)


def mls_jet(x, q, q_normals, starts, h):
    """Equation (2): returns the jet of g at points of the cloud (h is the width of theta).

    The arrays x, q and q_normals (3, pairs) list each point with all of its neighbours Q; `starts` are the indices at
    which each point's list begins. In (2), n is constant in the derivative of e by y, and the derivative of theta is
    -2 (y - q) theta / h^2. As |n| = 1, g(x) = sum 2 d theta (1 - d^2 / h^2) with d = (x - q) . n(x).
    """
    sizes = np.diff(np.append(starts, x.shape[1]))
    offset = x - q
    squared = np.einsum("cn,cn->n", offset, offset)
    identity = np.eye(3)[:, :, None]
    theta = np.exp(-squared / h**2)
    theta = Jet(squared, 2 * offset, 2 * identity).through(theta, -theta / h**2, theta / h**4)
    mean = [theta.parts(lambda a, c=c: np.add.reduceat(a * q_normals[c], starts, axis=-1)) for c in range(3)]
    length2 = mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]
    root = np.sqrt(length2.value)
    inverse_length = length2.through(1 / root, -0.5 / root**3, 0.75 / root**5)
    terms = []
    for c in range(3):
        n_c = (mean[c] * inverse_length).parts(lambda a: np.repeat(a, sizes, axis=-1))
        offset_c = Jet(offset[c], identity[c] * np.ones_like(offset[c]), np.zeros((3, 3, 1)))
        terms.append(offset_c * n_c)
    d = terms[0] + terms[1] + terms[2]
    inner = (d * d).parts(lambda a: -a / h**2)
    inner.value += 1
    g = d * theta * inner
    return g.parts(lambda a: 2 * np.add.reduceat(a, starts, axis=-1))


def curvature_of_jet(g):
    """Equation (3) with the opposite sign: returns twice the mean curvature, positive where convex."""
    length = np.sqrt(np.einsum("in,in->n", g.gradient, g.gradient))
    along = np.einsum("in,ijn,jn->n", g.gradient, g.hessian, g.gradient)
    k = (length**2 * np.einsum("iin->n", g.hessian) - along) / length**3
    return np.where(np.isfinite(k), k, 0.0)


def mean_curvature(points, normals, index, rho):
    """Equations (2) and (3): returns twice the mean curvature at the points of the given indices."""
    h = 3 * rho
    tree = cKDTree(points)
    sizes = tree.query_ball_point(points[index], 3 * h, return_length=True)
    parts = np.cumsum(sizes) // PAIRS_AT_ONCE
    result = []
    for part in np.split(index, np.flatnonzero(np.diff(parts)) + 1):
        lists = tree.query_ball_point(points[part], 3 * h)
        counts = np.array([len(one) for one in lists])
        q = np.concatenate(lists).astype(np.int64)
        starts = np.cumsum(counts) - counts
        with np.errstate(divide="ignore", invalid="ignore"):  # curvature_of_jet() turns NaN and infinity into 0.
            g = mls_jet(np.repeat(points[part], counts, axis=0).T, points[q].T, normals[q].T, starts, h)
            result.append(curvature_of_jet(g))
    return np.concatenate(result)


def normalised_curvature(k, rho):
    """Section 3.3, reading 5: returns k within -1 .. 1 and delta, the standard deviation of |k|."""
    limit = np.percentile(np.abs(k), 99)
    if limit * rho < 1e-9:
        return np.zeros_like(k), 0.0
    k = np.clip(k, -limit, limit) / limit
    return k, float(np.std(np.abs(k)))


# ---------------------------------------------------------------- Section 3.3: normal space compression


def boundary_points(xy, rho):
    """Section 3.3, reading 6: returns for each point whether it belongs to P_b."""
    xy = xy - xy.mean(axis=0)
    try:
        mesh = Delaunay(xy)
    except (QhullError, ValueError):  # All points are collinear, or there are fewer than three: none is inside.
        return np.ones(len(xy), bool)
    a, b, c = (xy[mesh.simplices[:, i]] for i in range(3))
    area4 = 2 * np.abs((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0]))
    sides = [np.linalg.norm(e, axis=1) for e in (b - a, c - b, a - c)]
    with np.errstate(divide="ignore", invalid="ignore"):
        inside = sides[0] * sides[1] * sides[2] / area4 <= 3 * rho
    boundary = np.ones(len(xy), bool)
    boundary[mesh.simplices] = False
    boundary[mesh.simplices[~inside]] = True
    boundary[mesh.convex_hull] = True
    return boundary


def curvature_weight(k, delta, alpha, beta):
    """Equation (6): returns w_k."""
    if alpha == 0:
        return np.ones_like(k)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        ratio = np.where(k == 0, 0.0, np.abs(k) / (alpha * delta))
        return 1 - np.exp(-(ratio**beta))


def boundary_weight(xy, boundary, rho):
    """Equation (7): returns w_b, where dist is the distance in the plane to the nearest point of P_b."""
    dist = cKDTree(xy[boundary]).query(xy)[0]
    return 1 - np.exp(-((dist / (2 * rho)) ** 2))


def expected_normals(normals, weight):
    """Equation (5): returns the expected normals for weight = w_k w_b; their length does not matter."""
    return weight[:, None] * normals + (1 - weight)[:, None] * np.array([0.0, 0.0, 1.0])


def slopes(expected):
    """Reading 8: returns the slopes (dz/dx, dz/dy) that belong to the expected normals, limited to STEEPEST."""
    divisor = np.maximum(expected[:, 2], np.linalg.norm(expected[:, :2], axis=1) / STEEPEST)
    return -expected[:, :2] / np.maximum(divisor, 1e-300)[:, None]  # The maximum makes the slope 0 / 0 equal 0.


# ---------------------------------------------------------------- Section 3.4: solution of the heights


class HeightSystem:
    """Equation (9), the least squares system A z = b, in which only b depends on the expected normals.

    It is solved by conjugate gradients on A^T A z = A^T b with the diagonal as preconditioner.
    """

    def __init__(self, xy, boundary):
        self.n, k = len(xy), min(NEIGHBOURS, len(xy) - 1)
        near = cKDTree(xy).query(xy, k=np.arange(1, k + 2))[1]
        itself_last = np.argsort(near == np.arange(self.n)[:, None], axis=1, kind="stable")
        self.q = np.take_along_axis(near, itself_last, axis=1)[:, :k].ravel()
        self.p = np.repeat(np.arange(self.n), k)
        self.offset = xy[self.p] - xy[self.q]
        self.boundary = boundary
        self.diagonal = np.bincount(self.p, minlength=self.n) + np.bincount(self.q, minlength=self.n) + boundary

    def transposed_times(self, rows):
        """Returns A^T b. `rows` is the part of b for the rows of (8); the part for the rows of the boundary is 0."""
        return np.bincount(self.p, rows, self.n) - np.bincount(self.q, rows, self.n)

    def normal_times(self, z):
        """Returns A^T A z."""
        return self.transposed_times(z[self.p] - z[self.q]) + self.boundary * z

    def solve(self, slope):
        """Solves the first equation (9): returns the heights that fit the slopes of all points best."""
        residual = self.transposed_times(np.einsum("ij,ij->i", slope[self.p], self.offset))
        goal = TOLERANCE * np.linalg.norm(residual)
        z, direction, energy = np.zeros(self.n), np.zeros(self.n), 1.0
        for _ in range(20 * self.n):
            if np.linalg.norm(residual) <= goal:
                return z
            scaled = residual / self.diagonal
            last, energy = energy, residual @ scaled
            direction = scaled + energy / last * direction
            change = self.normal_times(direction)
            step = energy / (direction @ change)
            z += step * direction
            residual -= step * change
        raise ArithmeticError("the conjugate gradients do not converge")


def span(z):
    """Reading 9: returns the height of a relief, where the base at 0 counts as a height."""
    return float(max(z.max(), 0) - min(z.min(), 0))


# ---------------------------------------------------------------- Section 3.5: height mapping and detail


def add_detail(z, k, gamma):
    """The second equation (9): returns the heights with gamma k h added."""
    return z + gamma * k * span(z)


# ---------------------------------------------------------------- the whole method


class Front:
    """The visible part of a cloud: everything that does not depend on alpha, beta and gamma."""

    def __init__(self, points, normals):
        points, normals = np.asarray(points, float), np.asarray(normals, float)
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = normals / np.where(length > 0, length, 1.0)
        self.rho = sampling_density(points)
        self.index = visible_points(points, normals, self.rho)
        self.xy, self.normals = points[self.index, :2], normals[self.index]
        self.k, self.delta = normalised_curvature(mean_curvature(points, normals, self.index, self.rho), self.rho)
        self.boundary = boundary_points(self.xy, self.rho)
        self.w_b = boundary_weight(self.xy, self.boundary, self.rho)
        self.system = HeightSystem(self.xy, self.boundary)

    def slope(self, alpha, beta):
        """Equations (5) to (7): returns the expected slopes at all visible points."""
        w_k = curvature_weight(self.k, self.delta, alpha, beta)
        return slopes(expected_normals(self.normals, w_k * self.w_b))

    def exact_heights(self, alpha, beta):
        """The first equation (9) on all visible points: returns the heights before the detail."""
        return self.system.solve(self.slope(alpha, beta))

    def relief(self, z, gamma):
        """Returns the result for heights before the detail."""
        z = add_detail(z, self.k, gamma)
        return Relief(self.index, z, self.k, self.delta, self.boundary, self.rho, span(z))


def relief(points, normals, alpha=4.0, beta=0.01, gamma=0.02):
    """Computes the relief of a cloud with all visible points as control points."""
    front = Front(points, normals)
    return front.relief(front.exact_heights(alpha, beta), gamma)
