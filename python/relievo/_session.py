"""Prepares a scan once, for many reliefs of it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _inputs, _native, _options
from ._relief import Progress, Relief


class Frame:
    """One relief of a session: the heights of the session's points, in single precision. It is made in milliseconds."""

    def __init__(self, native: Any) -> None:
        self._native = native

    @property
    def heights(self) -> NDArray[np.float32]:
        """The height of each of the session's points above the ground, in millimetres, (N,). Not a copy."""
        return self._native.heights()

    @property
    def normals(self) -> NDArray[np.float32]:
        """The unit normal of each point of the relief, (N, 3). Not a copy."""
        return self._native.normals()

    @property
    def height_mm(self) -> float:
        """The height from the lowest to the highest point, in millimetres; the ground counts as a point."""
        return self._native.height_mm()

    @property
    def is_height_met(self) -> bool:
        """False if the requested height cannot be reached: the relief then has the largest possible height."""
        return self._native.is_height_met()

    @property
    def u(self) -> float:
        """The compression that was found: 0 makes a relief flat, 1 gives the method's own height, more is higher."""
        return self._native.u()

    @property
    def mm_per_unit(self) -> float:
        """Millimetres per unit of the session's points, at the requested width."""
        return self._native.mm_per_unit()

    def __repr__(self) -> str:
        return f"<relievo.Frame {self.height_mm:.4g} mm, {len(self.heights)} points>"


class Session:
    """A scan with its visible surface prepared, so that a change of the options takes milliseconds.

    Frames show only the relief; make() gives the solid. Several threads may use one session: a frame waits until those
    of other threads are finished.
    """

    @_options.with_keywords(_options.OF_MAKE)
    def __init__(
        self,
        source: Any,
        *,
        normals: Any = None,
        colours: Any = None,
        faces: Any = None,
        progress: Progress = None,
        **options: Any,
    ) -> None:
        """Prepares the scan, which may have any form that relievo.make() accepts. The options that are given here are
        the defaults for frame() and make()."""
        _options.check("Session", options, _options.OF_MAKE)
        _options.check_progress(progress)
        sources = _inputs.sources_of(source, normals, colours, faces)
        self._native = _native.open(sources, _options.texts(options), progress)

    @property
    def points(self) -> NDArray[np.float64]:
        """The points of the surface as the viewer sees it, (N, 3): x to the right, y up, in the scan's units. Not a copy."""
        return self._native.points()

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """The triangles between the points, (M, 3), which cover their convex hull. Not a copy."""
        return self._native.triangles()

    @property
    def is_inside(self) -> NDArray[np.bool_]:
        """For each triangle, whether it belongs to the relief; the others are ground around it or in it. Not a copy."""
        return self._native.is_inside()

    @_options.with_keywords(_options.OF_FRAME)
    def frame(self, **options: Any) -> Frame:
        """Returns the relief for the options, as heights of the session's points.

        The requested height is met to 0.1 %. The method of the session must be layered or paper. Only make() takes the
        options of the draft, the form, the base and the plate.
        """
        _options.check("frame", options, _options.OF_FRAME)
        return Frame(self._native.frame(_options.texts(options)))

    @_options.with_keywords(_options.OF_SESSION)
    def make(self, *, progress: Progress = None, **options: Any) -> Relief:
        """Returns the finished relief, as relievo.make() does, without preparing the scan again."""
        _options.check("make", options, _options.OF_SESSION)
        _options.check_progress(progress)
        return Relief(self._native.make(_options.texts(options), progress))

    def picture(
        self,
        frame: Frame,
        *,
        width: int = 800,
        height: int = 600,
        yaw_deg: float = 0.0,
        pitch_deg: float = 0.0,
        zoom: float = 1.0,
        material: str = "plaster",
        is_fine: bool = False,
    ) -> NDArray[np.uint8]:
        """Returns a shaded picture of a frame on its plate: (height, width, 4), red, green, blue and opacity."""
        if not isinstance(frame, Frame):
            raise TypeError(f"picture() expected a frame, found {type(frame).__name__}")
        return self._native.picture(frame._native, width, height, yaw_deg, pitch_deg, zoom, material, is_fine)

    def __repr__(self) -> str:
        return f"<relievo.Session {len(self.points)} points, {len(self.triangles)} triangles>"
