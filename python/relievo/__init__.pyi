"""The types of the package. Made by python/write_stub.py."""

import os
from collections.abc import Callable
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

__version__: str
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

class Cloud:
    points: NDArray[Any]
    normals: Optional[NDArray[Any]]
    colours: Optional[NDArray[Any]]
    def __init__(self, points: Any, normals: Any = ..., colours: Any = ...) -> None: ...
    def save(self, path: Union[str, os.PathLike[str]]) -> None: ...
    def __len__(self) -> int: ...

class Error(Exception):
    kind: str
    input: str
    place: str
    expected: str
    def __init__(self, kind: str, input: str, place: str, expected: str) -> None: ...

class OutOfMemory(Exception):
    kind: str
    input: str
    place: str
    expected: str

class Frame:
    def __init__(self, native: Any) -> None: ...
    @property
    def heights(self) -> NDArray[np.float32]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def height_mm(self) -> float: ...
    @property
    def is_height_met(self) -> bool: ...
    @property
    def u(self) -> float: ...
    @property
    def mm_per_unit(self) -> float: ...

class HeightSystem:
    def __init__(self, points: Any, *, rho: Optional[float] = ..., weights: Any = ...) -> None: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...
    @property
    def is_boundary(self) -> NDArray[np.bool_]: ...
    def solve(self, slopes: Any) -> NDArray[np.float64]: ...

class Relief:
    def __init__(self, native: Any) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def faces(self) -> NDArray[np.uint32]: ...
    @property
    def colours(self) -> Optional[NDArray[np.uint8]]: ...
    @property
    def heights(self) -> NDArray[np.float32]: ...
    @property
    def report(self) -> dict[str, Any]: ...
    @property
    def remarks(self) -> list[str]: ...
    def height_map(self, size: int = ...) -> NDArray[np.float32]: ...
    def preview(self, size: int = ..., material: str = ...) -> NDArray[np.uint8]: ...
    def save(
        self,
        solid: Optional[Union[str, os.PathLike[str]]] = ...,
        *,
        preview: Optional[Union[str, os.PathLike[str]]] = ...,
        heightmap: Optional[Union[str, os.PathLike[str]]] = ...,
        tool_picture: Optional[Union[str, os.PathLike[str]]] = ...,
        report: Optional[Union[str, os.PathLike[str]]] = ...,
        units: str = ...,
        heightmap_size: int = ...,
        preview_size: int = ...,
    ) -> None: ...
    def to_bytes(self, format: str, *, heightmap_size: int = ...) -> bytes: ...
    def _repr_png_(self) -> bytes: ...
    def __repr__(self) -> str: ...

class Session:
    def __init__(
        self,
        source: Any,
        *,
        normals: Any = ...,
        colours: Any = ...,
        faces: Any = ...,
        progress: Optional[Callable[[str, float], object]] = ...,
        width_mm: Union[float, str, None] = ...,
        height_mm: Union[float, str, None] = ...,
        alpha: Optional[float] = ...,
        saturation: Optional[float] = ...,
        detail: Optional[float] = ...,
        method: Optional[str] = ...,
        steepest_deg: Optional[float] = ...,
        draft_deg: Optional[float] = ...,
        boundary: Optional[float] = ...,
        steps: Optional[float] = ...,
        tone: Any = ...,
        mode: Optional[str] = ...,
        view: Any = ...,
        up: Any = ...,
        crop: Any = ...,
        crumbs: Optional[str] = ...,
        plane: Optional[str] = ...,
        denoise: Any = ...,
        outline: Optional[str] = ...,
        corner_mm: Union[float, str, None] = ...,
        diameter_mm: Union[float, str, None] = ...,
        plate: Optional[str] = ...,
        shift: Optional[str] = ...,
        margin_mm: Union[float, str, None] = ...,
        thickness_mm: Union[float, str, None] = ...,
        rim_mm: Union[float, str, None] = ...,
        rim_height_mm: Union[float, str, None] = ...,
        rim_bevel_mm: Union[float, str, None] = ...,
        base: Optional[str] = ...,
        wrap: Optional[str] = ...,
        points: Optional[float] = ...,
        form: Optional[str] = ...,
        tool: Optional[str] = ...,
        finish: Optional[str] = ...,
        resolution_mm: Union[float, str, None] = ...,
        tolerance_mm: Union[float, str, None] = ...,
        triangles: Optional[float] = ...,
        depth_values: Optional[str] = ...,
        channel: Optional[float] = ...,
        depth_range: Optional[float] = ...,
        background: Optional[str] = ...,
        camera: Any = ...,
        base_image: Any = ...,
        scan: Any = ...,
        stream_above_mb: Optional[float] = ...,
    ) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]: ...
    @property
    def triangles(self) -> NDArray[np.uint32]: ...
    @property
    def is_inside(self) -> NDArray[np.bool_]: ...
    def frame(
        self,
        *,
        width_mm: Union[float, str, None] = ...,
        height_mm: Union[float, str, None] = ...,
        alpha: Optional[float] = ...,
        saturation: Optional[float] = ...,
        detail: Optional[float] = ...,
        method: Optional[str] = ...,
        steepest_deg: Optional[float] = ...,
        boundary: Optional[float] = ...,
        steps: Optional[float] = ...,
        tone: Any = ...,
    ) -> Frame: ...
    def make(
        self,
        *,
        progress: Optional[Callable[[str, float], object]] = ...,
        width_mm: Union[float, str, None] = ...,
        height_mm: Union[float, str, None] = ...,
        alpha: Optional[float] = ...,
        saturation: Optional[float] = ...,
        detail: Optional[float] = ...,
        method: Optional[str] = ...,
        steepest_deg: Optional[float] = ...,
        draft_deg: Optional[float] = ...,
        boundary: Optional[float] = ...,
        steps: Optional[float] = ...,
        tone: Any = ...,
        outline: Optional[str] = ...,
        corner_mm: Union[float, str, None] = ...,
        diameter_mm: Union[float, str, None] = ...,
        plate: Optional[str] = ...,
        shift: Optional[str] = ...,
        margin_mm: Union[float, str, None] = ...,
        thickness_mm: Union[float, str, None] = ...,
        rim_mm: Union[float, str, None] = ...,
        rim_height_mm: Union[float, str, None] = ...,
        rim_bevel_mm: Union[float, str, None] = ...,
        base: Optional[str] = ...,
        wrap: Optional[str] = ...,
        form: Optional[str] = ...,
        tool: Optional[str] = ...,
        finish: Optional[str] = ...,
        resolution_mm: Union[float, str, None] = ...,
        tolerance_mm: Union[float, str, None] = ...,
        triangles: Optional[float] = ...,
        base_image: Any = ...,
    ) -> Relief: ...
    def picture(
        self,
        frame: Frame,
        *,
        width: int = ...,
        height: int = ...,
        yaw_deg: float = ...,
        pitch_deg: float = ...,
        zoom: float = ...,
        material: str = ...,
        is_fine: bool = ...,
    ) -> NDArray[np.uint8]: ...

def estimate_normals(points: Any, neighbours: int = ...) -> NDArray[np.float32]: ...

def make(
    source: Any,
    *,
    normals: Any = ...,
    colours: Any = ...,
    faces: Any = ...,
    progress: Optional[Callable[[str, float], object]] = ...,
    width_mm: Union[float, str, None] = ...,
    height_mm: Union[float, str, None] = ...,
    alpha: Optional[float] = ...,
    saturation: Optional[float] = ...,
    detail: Optional[float] = ...,
    method: Optional[str] = ...,
    steepest_deg: Optional[float] = ...,
    draft_deg: Optional[float] = ...,
    boundary: Optional[float] = ...,
    steps: Optional[float] = ...,
    tone: Any = ...,
    mode: Optional[str] = ...,
    view: Any = ...,
    up: Any = ...,
    crop: Any = ...,
    crumbs: Optional[str] = ...,
    plane: Optional[str] = ...,
    denoise: Any = ...,
    outline: Optional[str] = ...,
    corner_mm: Union[float, str, None] = ...,
    diameter_mm: Union[float, str, None] = ...,
    plate: Optional[str] = ...,
    shift: Optional[str] = ...,
    margin_mm: Union[float, str, None] = ...,
    thickness_mm: Union[float, str, None] = ...,
    rim_mm: Union[float, str, None] = ...,
    rim_height_mm: Union[float, str, None] = ...,
    rim_bevel_mm: Union[float, str, None] = ...,
    base: Optional[str] = ...,
    wrap: Optional[str] = ...,
    points: Optional[float] = ...,
    form: Optional[str] = ...,
    tool: Optional[str] = ...,
    finish: Optional[str] = ...,
    resolution_mm: Union[float, str, None] = ...,
    tolerance_mm: Union[float, str, None] = ...,
    triangles: Optional[float] = ...,
    depth_values: Optional[str] = ...,
    channel: Optional[float] = ...,
    depth_range: Optional[float] = ...,
    background: Optional[str] = ...,
    camera: Any = ...,
    base_image: Any = ...,
    scan: Any = ...,
    stream_above_mb: Optional[float] = ...,
) -> Relief: ...

def mean_curvature(points: Any, normals: Any, queries: Any = ..., *, scale: float = ...) -> NDArray[np.float64]: ...

def png(picture: Any) -> bytes: ...

def sample(name: str, *, points: int = ..., noise: float = ...) -> Cloud: ...

def set_threads(number: int) -> None: ...

def solve_heights(
    points: Any,
    slopes: Any,
    *,
    rho: Optional[float] = ...,
    weights: Any = ...,
) -> NDArray[np.float64]: ...

def threads() -> int: ...

def triangulate(points: Any) -> NDArray[np.uint32]: ...

def visible_points(points: Any, normals: Any = ..., *, view: Any = ..., up: Any = ...) -> NDArray[np.uint32]: ...
