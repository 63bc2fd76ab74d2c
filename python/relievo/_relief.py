"""Makes reliefs, as the command `relievo make` does."""

from __future__ import annotations

import inspect
import os
import warnings
from collections.abc import Callable
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _inputs, _native, _options

Path = Union[str, "os.PathLike[str]"]
Progress = Optional[Callable[[str, float], object]]


class Relief:
    """A finished relief: a closed solid in millimetres."""

    def __init__(self, native: Any) -> None:
        self._native = native
        self._heights: Optional[NDArray[np.float32]] = None

    @property
    def vertices(self) -> NDArray[np.float64]:
        """The points of the solid in millimetres, (N, 3). Not a copy; cannot be written to."""
        return self._native.vertices()

    @property
    def faces(self) -> NDArray[np.uint32]:
        """The triangles of the solid, (M, 3) indices of vertices, counter-clockwise from outside. Not a copy."""
        return self._native.faces()

    @property
    def colours(self) -> Optional[NDArray[np.uint8]]:
        """Red, green and blue of each vertex, (N, 3), or None if the scan has none. Not a copy."""
        return self._native.colours()

    @property
    def heights(self) -> NDArray[np.float32]:
        """The heights of the front above its lowest point in mm, as a picture of 1024 pixels on the longer side."""
        if self._heights is None:
            self._heights = self.height_map()
            self._heights.setflags(write=False)
        return self._heights

    @property
    def report(self) -> dict[str, Any]:
        """The report on the relief: the content of the file that `relievo make --report` writes, as a dict."""
        return self._native.report()

    @property
    def remarks(self) -> list[str]:
        """Remarks for the user on the scan and the relief, one line each."""
        return self._native.remarks()

    def height_map(self, size: int = 1024) -> NDArray[np.float32]:
        """Returns the heights of the front as a picture with `size` pixels on its longer side; 0 beside the plate."""
        return self._native.heights(size)

    def preview(self, size: int = 1200, material: str = "plaster") -> NDArray[np.uint8]:
        """Returns a picture, (rows, columns, 3): a front and an oblique view, each `size` pixels on its longer side.

        The materials are plaster, silver, bronze, walnut and porcelain, which is lit from behind.
        """
        return self._native.preview(size, material)

    def save(
        self,
        solid: Optional[Path] = None,
        *,
        preview: Optional[Path] = None,
        heightmap: Optional[Path] = None,
        tool_picture: Optional[Path] = None,
        report: Optional[Path] = None,
        units: str = "mm",
        heightmap_size: int = 1024,
        pixel_mm: Optional[float] = None,
        dpi: Optional[float] = None,
        heightmap_bits: Optional[int] = None,
        heightmap_area: Optional[str] = None,
        heightmap_zero: Optional[str] = None,
        heightmap_high: Optional[str] = None,
        preview_size: int = 1200,
    ) -> None:
        """Writes the files that `relievo make` writes, with the same bytes: all of them or, on any error, none.

        The path of the solid ends in .stl, .3mf, .ply or .obj; its units are "mm" or "in". The path of the preview ends
        in .png, that of the height map in .png (16 bits) or .tif (millimetres). Sizes are longer sides in pixels.
        pixel_mm or dpi give the exact size of a pixel of the height map; its other keywords have the meaning of the
        flags of `relievo make`. The tool's picture needs the option tool. The report is JSON.
        """
        paths = {
            "solid": solid,
            "preview": preview,
            "heightmap": heightmap,
            "tool_picture": tool_picture,
            "report": report,
        }
        wanted = {name: os.fsdecode(path) for name, path in paths.items() if path is not None}
        if not wanted:
            raise TypeError("save() expected the path of at least one file")
        map_flags = {
            "pixel": None if pixel_mm is None else f"{pixel_mm!r}mm",
            "dpi": dpi,
            "heightmap-bits": heightmap_bits,
            "heightmap-area": heightmap_area,
            "heightmap-zero": heightmap_zero,
            "heightmap-high": heightmap_high,
        }
        wanted.update({flag: str(value) for flag, value in map_flags.items() if value is not None})
        self._native.save(wanted, units, heightmap_size, preview_size)

    def to_bytes(self, format: str, *, heightmap_size: int = 1024) -> bytes:
        """Returns a file's bytes: of format stl, 3mf, ply, obj, heightmap (PNG), tiff or preview (PNG)."""
        return self._native.to_bytes(format, heightmap_size)

    def _repr_png_(self) -> bytes:
        """Shows the relief in a notebook."""
        return png(self.preview(480))

    def __repr__(self) -> str:
        size = " x ".join(f"{mm:.4g}" for mm in self.report["size_mm"])
        return f"<relievo.Relief {size} mm, {len(self.faces)} triangles>"

    def __reduce__(self) -> tuple[type[Relief], tuple[Any]]:
        """Pickles the relief with its report, so that other processes may save it."""
        return Relief, (self._native,)


_options.ELSEWHERE.update(
    {name: f"save() takes {name}" for name in inspect.signature(Relief.save).parameters if name not in ("self", "solid")}
)


@_options.with_keywords(_options.OF_MAKE)
def make(
    source: Any,
    *,
    normals: Any = None,
    colours: Any = None,
    faces: Any = None,
    progress: Progress = None,
    **options: Any,
) -> Relief:
    """Returns the relief of a scan.

    source is the path of any file that `relievo make` reads, the bytes of such a file, an (N, 3) array of points, a 2-D
    depth image, or an object with points, or with vertices and faces, like those of Open3D and trimesh. A list of
    sources makes one relief of several models, side by side. Points may have normals and colours, (N, 3). With faces,
    (M, 3), they are a mesh.

    progress is called with the name of each stage and the fraction done, at last with "done" and 1. Ctrl-C, or an
    exception that progress raises, ends the work and is passed on. Several threads may call this function at the same
    time. A warning names the parts of a file that the relief does not use, such as points that the file marks as noise.
    """
    _options.check("make", options, _options.OF_MAKE)
    _options.check_progress(progress)
    sources = _inputs.sources_of(source, normals, colours, faces)
    native = _native.make(sources, _options.texts(options), progress)
    for line in native.left_out():
        warnings.warn(line, stacklevel=2)
    return Relief(native)


def png(picture: Any) -> bytes:
    """Returns a picture, rows and columns of uint8 with 1, 3 or 4 channels, as the bytes of a PNG file."""
    return _native.png(_inputs.numbers("picture", picture))
