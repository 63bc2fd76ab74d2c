"""Recognises the inputs of a relief: paths, bytes, arrays, and objects that have arrays."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from . import _native
from ._errors import Error


def sources_of(source: Any, normals: Any, colours: Any, faces: Any) -> list[Any]:
    """Returns the inputs for the native module: texts, (bytes, name) tuples and models."""
    extras = (normals, colours, faces)
    if isinstance(source, (list, tuple)) and not _is_rows(source):
        if any(extra is not None for extra in extras):
            raise TypeError("normals, colours and faces belong to one array of points, not to a list of inputs")
        if not source:
            raise Error("input", "source", "", "expected at least one input, found an empty list")
        return [_source(each, None, None, None) for each in source]
    return [_source(source, *extras)]


def _is_rows(source: Sequence[Any]) -> bool:
    """Returns whether a sequence consists of rows of numbers, which are points; otherwise it is a list of inputs."""
    return len(source) > 0 and all(
        isinstance(row, (list, tuple)) and row and all(isinstance(x, (int, float)) for x in row) for row in source
    )


def _source(source: Any, normals: Any, colours: Any, faces: Any) -> Any:
    has_extras = any(extra is not None for extra in (normals, colours, faces))
    if isinstance(source, (str, os.PathLike, bytes, bytearray, memoryview)):
        if has_extras:
            raise TypeError("normals, colours and faces belong to an array of points, not to a file")
        if isinstance(source, (str, os.PathLike)):
            return os.fsdecode(source)
        return bytes(source), "bytes"
    if isinstance(source, np.ndarray) or _is_array(source) or isinstance(source, (list, tuple)):
        return _array(source, normals, colours, faces)
    if has_extras:
        raise TypeError("normals, colours and faces belong to an array of points, not to an object that has its own")
    return _object(source)


def _is_array(source: Any) -> bool:
    return hasattr(source, "__array__") and not hasattr(source, "points") and not hasattr(source, "vertices")


def _array(source: Any, normals: Any, colours: Any, faces: Any) -> Any:
    points = numbers("points", source)
    if points.ndim == 2 and points.shape[0] == 3 and points.shape[1] != 3:
        raise Error("input", "points", "shape", f"expected (N, 3), found {points.shape}; the transposed array, .T, has rows of points")
    if points.ndim == 2 and points.shape[1] != 3 and normals is None and colours is None and faces is None:
        return _native.depth_model(points)
    return _array_model(points, normals, colours, faces)


def numbers(name: str, given: Any) -> Any:
    """Returns the array, with NaN for masked values; None for None."""
    if given is None:
        return None
    if isinstance(given, np.ma.MaskedArray):
        return np.ma.filled(given.astype(float), np.nan)
    try:
        array = np.asarray(given)
    except ValueError as error:
        raise Error("input", name, "", f"expected rows of numbers, found {error}") from None
    if array.ndim == 0:
        raise Error("input", name, "shape", f"expected rows of numbers, found {type(given).__name__}")
    return array


def _object(source: Any) -> Any:
    """Returns the model in a cloud or mesh object of another package, such as Open3D or trimesh."""
    points = _first(source, "vertices", "points")
    if points is None:
        raise TypeError(
            "expected a path, bytes, an array, or an object with points, or with vertices and faces, found "
            + type(source).__name__
        )
    faces = _first(source, "faces", "triangles")
    normals = None if faces is not None else _first(source, "normals")
    return _array_model(points, normals, _colours(source), faces)


def _array_model(points: Any, normals: Any, colours: Any, faces: Any) -> Any:
    """Returns the model. Without faces, which would index the points, leaves out points that are not finite."""
    given = [numbers("points", points), numbers("normals", normals), numbers("colours", colours)]
    kept = _finite_rows(given[0]) if faces is None else None
    if kept is not None:
        rows = [array if array is None or len(array) != len(kept) else array[kept] for array in given]
        return _native.array_model(*rows, None, missing=len(kept) - int(kept.sum()))
    return _native.array_model(*given, numbers("faces", faces))


def _finite_rows(points: Any) -> Any:
    """Returns for each row whether it is finite, or None if all rows are or none is."""
    if points.ndim != 2 or points.dtype.kind != "f":
        return None
    kept = np.isfinite(points).all(axis=1)
    return None if kept.all() or not kept.any() else kept


def _first(source: Any, *names: str) -> Any:
    """Returns the first attribute of these names that exists and is not empty."""
    for name in names:
        value = getattr(source, name, None)
        if value is not None and not callable(value) and len(value) > 0:
            return value
    # An empty attribute is returned, too, because the later check of the points reports it.
    return next((getattr(source, n) for n in names if n in ("points", "vertices") and hasattr(source, n)), None)


def _colours(source: Any) -> Any:
    colours = _first(source, "colours", "colors", "vertex_colors")
    if colours is None:
        visual = getattr(source, "visual", None)
        if getattr(visual, "kind", None) == "vertex":
            colours = getattr(visual, "vertex_colors", None)
    return colours
