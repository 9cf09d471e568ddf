"""Rays and hits are NumPy arrays that the library reads and writes in place.

RAY, HIT, HIT_PART, FULL_HIT and START are the layouts of crt_ray, crt_hit, crt_hit_part,
crt_full_hit and crt_start. LOCATION is what Prepared.locate() returns. Arrays of them may be of any
shape, and have gaps: a field of an array of larger records will do. What would need a copy is
refused.

crt.rays() makes rays that reach from 0 to infinity. Beware of np.zeros(n, crt.RAY): there t_max is
0, and a ray without a t between t_min and t_max meets nothing.
"""

import math
from typing import Any, SupportsFloat, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments
from ._arguments import Point
from ._handles import Reference
from ._library import create, library
from ._structs import reference
from .errors import named
from .values import Camera, Projection, Settings

Ray = np.void | np.ndarray[tuple[()], np.dtype[np.void]]
"""is the type of one ray: a record of an array, or what crt.ray() makes"""
Rays = np.ndarray[tuple[int, ...], np.dtype[np.void]]
"""is the type of what crt.rays() makes"""

RAY = np.dtype([("origin", "f8", 3), ("direction", "f8", 3), ("t_min", "f8"), ("t_max", "f8")])
HIT = np.dtype(
    [
        ("t", "f8"),
        ("normal", "f8", 3),
        ("u", "f8"),
        ("v", "f8"),
        ("entity_id", "u4"),
        ("flags", "u4"),
    ]
)
HIT_PART = np.dtype(
    [
        ("entity_id", "u4"),
        ("part_id", "u4"),
        ("face", "u4"),
        ("reserved", "u4"),
        ("u", "f8"),
        ("v", "f8"),
    ]
)
START = np.dtype([("bits", "u8", 2)])
FULL_HIT = np.dtype(
    [
        ("t", "f8"),
        ("position", "f8", 3),
        ("normal", "f8", 3),
        ("u", "f8"),
        ("v", "f8"),
        ("entity_id", "u4"),
        ("part_id", "u4"),
        ("face", "u4"),
        ("flags", "u4"),
        ("user", "u8"),
        ("start", START),
    ]
)
LOCATION = np.dtype([("entity_id", "u4"), ("part_id", "u4"), ("user", "u8")])
LAYOUTS = {"RAY": RAY, "HIT": HIT, "HIT_PART": HIT_PART, "START": START, "FULL_HIT": FULL_HIT}

ENTERING = 1
"""is a flag of hits: the ray goes into the solid, or through a surface against its normal"""
BACKFACE = 2
"""is a flag of hits: the ray comes from the side that the normal points away from"""


NO_ENTITY = 0xFFFFFFFF
"""is the entity_id of a miss, as in the channel "id" of pictures, and its part_id and face"""


@overload
def rays(shape: int | tuple[int, ...]) -> Rays: ...
@overload
def rays(
    origin: ArrayLike, /, direction: ArrayLike, t_min: ArrayLike = 0, t_max: ArrayLike = math.inf
) -> Rays: ...
@overload
def rays(
    *, origin: ArrayLike, direction: ArrayLike, t_min: ArrayLike = 0, t_max: ArrayLike = math.inf
) -> Rays: ...
def rays(
    shape: Any = None,
    direction: Any = None,
    t_min: Any = 0,
    t_max: Any = math.inf,
    *,
    origin: Any = None,
) -> Any:
    """Makes an array of rays: crt.rays(origin, direction) of numbers that broadcast together, such
    as one origin and n x 3 directions. crt.rays(shape) leaves origins and directions for you to
    fill in.

    A ray is the points origin + t * direction with t_min < t < t_max, by default 0 and infinity.
    """
    if direction is None:
        if origin is not None or shape is None:
            raise TypeError("rays: there must be a shape, or an origin and a direction")
        array = np.zeros(shape, RAY)
        array["t_min"], array["t_max"] = t_min, t_max
        return array
    start = _vectors(shape if origin is None else origin, "rays: origin")
    along = _vectors(direction, "rays: direction")
    first, last = _numbers(t_min, "rays: t_min"), _numbers(t_max, "rays: t_max")
    common = np.broadcast_shapes(start.shape[:-1], along.shape[:-1], first.shape, last.shape)
    array = np.empty(common, RAY)
    array["origin"], array["direction"], array["t_min"], array["t_max"] = start, along, first, last
    return array


def _vectors(value: Any, name: str) -> NDArray[np.float64]:
    vectors = _numbers(value, name)
    if vectors.shape[-1:] != (3,):
        raise ValueError(f"{name} must have 3 numbers in its last dimension, not {vectors.shape}")
    return vectors


def _numbers(value: Any, name: str) -> NDArray[np.float64]:
    try:
        return np.asarray(value, np.float64)
    except (TypeError, ValueError):
        raise _arguments.refusal(name, "numbers", value) from None


def ray(
    origin: Point, direction: Point, t_min: SupportsFloat = 0, t_max: SupportsFloat = math.inf
) -> np.ndarray[tuple[()], np.dtype[np.void]]:
    """Makes one ray: the points origin + t * direction with t_min < t < t_max."""
    start = tuple(_arguments.vector(origin, "ray: origin"))
    along = tuple(_arguments.vector(direction, "ray: direction"))
    first = _arguments.number(t_min, "ray: t_min")
    return np.array((start, along, first, _arguments.number(t_max, "ray: t_max")), RAY)


def camera_rays(camera: Camera, width: int, height: int) -> Rays:
    """Makes the rays through the middles of a picture's pixels and of the camera's lens, height x
    width. Those of pinhole cameras have a length of 1 along the view, and all others one of 1. So a
    hit's t is the depth of the point, or the distance for cameras that look around."""
    _arguments.instance(camera, Camera, "camera_rays: camera")
    width = _arguments.whole(width, "camera_rays: width")
    height = _arguments.whole(height, "camera_rays: height")
    scene = Reference(create("crt_scene_create"), library.crt_scene_release)
    with named("camera_rays: camera"):
        library.crt_scene_set_camera(scene, reference(camera, "crt_camera"))
    with named("camera_rays"):
        settings = Settings(width=width, height=height)
        library.crt_scene_set_settings(scene, reference(settings, "crt_settings"))
    prepared = Reference(create("crt_scene_prepare", scene), library.crt_prepared_release)
    places = np.empty((height, width, 2))
    places[..., 0] = np.arange(width) + 0.5
    places[..., 1] = (np.arange(height) + 0.5)[:, None]
    result = rays((height, width))
    library.crt_camera_rays(prepared, places.ctypes.data, width * height, result.ctypes.data, 0)
    if camera.projection == Projection.PINHOLE:
        forward = np.subtract(camera.pointing, camera.position)
        forward /= np.linalg.norm(forward)
        result["direction"] /= (result["direction"] @ forward)[..., None]
    return result


def points_of(value: ArrayLike, name: str) -> NDArray[np.float64]:
    """Returns points one after the other in memory, each of 3 numbers."""
    return np.ascontiguousarray(_vectors(value, name))


class Batch:
    """A Batch says where the library finds the items of an array: where, how many, how many bytes
    apart. It keeps the array."""

    def __init__(self, array: Ray | NDArray[Any], dtype: np.dtype[Any], name: str) -> None:
        kind = next(kind for kind, layout in LAYOUTS.items() if layout is dtype)
        if isinstance(array, np.void):
            array = np.asarray(array)  # one record
        if not isinstance(array, np.ndarray):
            raise _arguments.refusal(name, f"a NumPy array of crt.{kind}", array)
        items = array.shape
        steps = array.strides
        if dtype is RAY and array.dtype == np.float64 and items[-1:] == (8,):
            if steps[-1] != 8:
                raise TypeError(
                    f"{name} are float64 whose 8 numbers of a ray do not follow one another"
                    f" (they are {steps[-1]} bytes apart): np.ascontiguousarray() makes a copy"
                    " that can be asked"
                )
            items, steps = items[:-1], steps[:-1]
        elif array.dtype != dtype:
            also = " or float64 with 8 numbers in the last dimension" if dtype is RAY else ""
            raise TypeError(
                f"{name} have the dtype {array.dtype} and the shape {items}, not crt.{kind}{also}"
            )
        self.array = array
        self.shape = items
        self.count = math.prod(items)
        self.address = array.ctypes.data
        self.stride = _common_stride(items, steps, dtype.itemsize, name)

    def packed(self) -> "Batch":
        """Returns a copy whose items follow one another."""
        array = np.ascontiguousarray(self.array)
        kind = next(layout for layout in LAYOUTS.values() if layout == array.dtype)
        return Batch(array, kind, "")

    def as_records(self) -> NDArray[np.void]:
        """Returns the rays as an array of crt.RAY, which may be a copy."""
        if self.array.dtype == RAY:
            return self.array
        return np.ascontiguousarray(self.array).view(RAY)[..., 0]


def _common_stride(shape: tuple[int, ...], strides: tuple[int, ...], size: int, name: str) -> int:
    """Returns the one distance from each item to the next, of an array of any number of
    dimensions."""
    steps = [(length, step) for length, step in zip(shape, strides) if length != 1]
    if math.prod(shape) == 0 or not steps:
        return size
    stride = steps[-1][1]
    if stride < size:
        raise ValueError(f"{name} overlap or run backwards: np.ascontiguousarray() makes a copy")
    expected = stride
    for length, step in reversed(steps):
        if step != expected:
            raise ValueError(
                f"{name} are not evenly spaced: ask row by row, or a copy by"
                " np.ascontiguousarray()"
            )
        expected *= length
    return stride
