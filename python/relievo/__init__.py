"""Relievo turns a 3D scan into a bas-relief: relievo.make("scan.ply", height_mm=3).save("relief.stl").

An option of the command line is a keyword of the same name, with underscores. If the option is a length or an angle,
the keyword ends in its unit: --rim-height is rim_height_mm, --draft is draft_deg.
"""

import operator as _operator
import os as _os

from . import _native
from ._errors import Error, OutOfMemory
from ._relief import Relief, make, png
from ._session import Frame, Session
from ._stages import (
    Cloud,
    HeightSystem,
    estimate_normals,
    mean_curvature,
    sample,
    solve_heights,
    triangulate,
    visible_points,
)

__version__: str = _native.__version__

__all__ = [
    "Cloud",
    "Error",
    "OutOfMemory",
    "Frame",
    "HeightSystem",
    "Relief",
    "Session",
    "estimate_normals",
    "make",
    "mean_curvature",
    "png",
    "sample",
    "set_threads",
    "solve_heights",
    "threads",
    "triangulate",
    "visible_points",
]


def threads() -> int:
    """Returns the number of threads that the library uses."""
    return _native.threads()


def set_threads(number: int) -> None:
    """Sets the number of the library's threads, at most 256; 0 means one per processor. Waits for running calls."""
    try:
        _native.set_threads(_operator.index(number))
    except TypeError:
        raise TypeError(f"set_threads() expected a whole number, found {type(number).__name__}") from None


# A forked process has only the thread that called fork(), so the library's threads are ended before a fork.
_os.register_at_fork(
    before=_native.begin_fork,
    after_in_parent=_native.end_fork_in_parent,
    after_in_child=_native.end_fork_in_child,
)
