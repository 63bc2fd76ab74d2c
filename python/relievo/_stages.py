"""Stages of the library as functions of arrays."""

from __future__ import annotations

import operator
import os
from typing import Any, Callable, Optional, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._inputs import numbers
from ._options import text_of
from ._relief import Path

Function = TypeVar("Function", bound=Callable[..., Any])


def _documented(name: str) -> Callable[[Function], Function]:
    """Puts the comment of the library's header before the docstring, which describes the differences in Python."""

    def decorate(function: Function) -> Function:
        function.__doc__ = f"{_native.header_docs[name]}\n\nIn Python: {function.__doc__}"
        return function

    return decorate


@_documented("visible_points")
def visible_points(points: Any, normals: Any = None, *, view: Any = "front", up: Any = "") -> NDArray[np.uint32]:
    """points is (N, 3) in the frame of the scan; view and up are as in make(). Without normals they are estimated."""
    return _native.visible_points(numbers("points", points), numbers("normals", normals), text_of(view), text_of(up))


@_documented("mean_curvature")
def mean_curvature(points: Any, normals: Any, queries: Any = None, *, scale: float = 2.0) -> NDArray[np.float64]:
    """points and normals are (N, 3). queries are indices of points; None means all. scale: CurvatureOptions::scale."""
    return _native.mean_curvature(
        numbers("points", points), numbers("normals", normals), numbers("queries", queries), scale
    )


@_documented("estimate_normals")
def estimate_normals(points: Any, neighbours: int = 16) -> NDArray[np.float32]:
    """points is (N, 3); returns the normals, (N, 3)."""
    return _native.estimate_normals(numbers("points", points), neighbours)


@_documented("delaunay")
def triangulate(points: Any) -> NDArray[np.uint32]:
    """points is (N, 2); returns the triangles, (M, 3). Raises Error where the library returns none."""
    return _native.triangulate(numbers("points", points))


@_documented("HeightSystem")
class HeightSystem:
    """points is (N, 2). rho is the sampling distance, which decides which triangles are too wide to be inside. If rho
    is None, it is measured. weights is (N,), or None. Raises Error for points that enclose no area.
    """

    def __init__(self, points: Any, *, rho: Optional[float] = None, weights: Any = None) -> None:
        self._native = _native.height_system(numbers("points", points), rho, numbers("weights", weights))

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """The Delaunay triangles of the points, (M, 3). Not a copy."""
        return self._native.triangles()

    @property
    def is_boundary(self) -> NDArray[np.bool_]:
        """For each point, whether it is on the boundary, where the height is 0. Not a copy."""
        return self._native.is_boundary()

    def solve(self, slopes: Any) -> NDArray[np.float64]:
        """Returns the height of each point from the slopes (dz/dx, dz/dy), (N, 2). Rows of float64 are not copied."""
        return self._native.solve(numbers("slopes", slopes))


def solve_heights(points: Any, slopes: Any, *, rho: Optional[float] = None, weights: Any = None) -> NDArray[np.float64]:
    """Returns the surface over (N, 2) points that fits (N, 2) slopes best, 0 at the boundary: see HeightSystem."""
    return HeightSystem(points, rho=rho, weights=weights).solve(slopes)


class Cloud:
    """Points, with normals and colours if there are any, in a form that make() and Session accept."""

    def __init__(self, points: Any, normals: Any = None, colours: Any = None) -> None:
        self.points: NDArray[Any] = np.asarray(points)
        self.normals: Optional[NDArray[Any]] = None if normals is None else np.asarray(normals)
        self.colours: Optional[NDArray[Any]] = None if colours is None else np.asarray(colours)

    def save(self, path: Path) -> None:
        """Writes the points as a PLY file."""
        model = _native.array_model(self.points, self.normals, self.colours, None)
        _native.write_cloud(model, os.fsdecode(path), "relievo")

    def __len__(self) -> int:
        return len(self.points)

    def __repr__(self) -> str:
        extras = [name for name in ("normals", "colours") if getattr(self, name) is not None]
        return f"<relievo.Cloud {len(self)} points{' with ' + ' and '.join(extras) if extras else ''}>"


@_documented("make_sample")
def sample(name: str, *, points: int = 300_000, noise: float = 0.15) -> Cloud:
    """The options are keywords."""
    if operator.index(points) < 0:
        raise ValueError(f"points: expected a number of 0 or more, found {points}")
    return Cloud(*_native.sample(name, points, noise))
