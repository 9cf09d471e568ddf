"""Rays and hits are NumPy arrays that the library reads and writes in place.

RAY and HIT are the layouts of crt_ray and crt_hit. Arrays of them may be of any shape, and have
gaps: a field of an array of larger records will do. What would need a copy is refused.
"""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arguments
from .values import Camera, Projection

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

ENTERING = 1
"""is a flag of hits: the ray goes into the solid, or through a surface against its normal"""
BACKFACE = 2
"""is a flag of hits: the ray comes from the side that the normal points away from"""


def rays(shape: int | tuple[int, ...]) -> NDArray[Any]:
    """Makes an array of rays from 0 to infinity, for you to fill in `origin` and `direction`."""
    array = np.zeros(shape, RAY)
    array["t_max"] = math.inf
    return array


def ray(
    origin: Sequence[float], direction: Sequence[float], t_min: float = 0, t_max: float = math.inf
) -> NDArray[Any]:
    """Makes one ray: the points origin + t * direction with t_min < t < t_max."""
    start = tuple(_arguments.vector(origin, "ray: origin"))
    along = tuple(_arguments.vector(direction, "ray: direction"))
    first = _arguments.number(t_min, "ray: t_min")
    return np.array((start, along, first, _arguments.number(t_max, "ray: t_max")), RAY)


def camera_rays(camera: Camera, width: int, height: int) -> NDArray[Any]:
    """Makes the rays through the middles of a pinhole camera's pixels, height x width. Their
    directions have a length of 1 along the view, so that a hit's t is the depth of the point."""
    _arguments.instance(camera, Camera, "camera_rays: camera")
    width = _arguments.whole(width, "camera_rays: width")
    height = _arguments.whole(height, "camera_rays: height")
    if camera.projection != Projection.PINHOLE:
        raise ValueError("only a pinhole camera's rays are known here")
    forward = np.subtract(camera.pointing, camera.position)
    forward /= np.linalg.norm(forward)
    is_vertical = math.hypot(forward[0], forward[2]) < 1e-9
    level_right = np.cross((0, 0, 1) if is_vertical else (0, 1, 0), forward)
    level_right /= np.linalg.norm(level_right)
    level_up = np.cross(forward, level_right)
    cosine, sine = math.cos(camera.roll), math.sin(camera.roll)
    right = cosine * level_right - sine * level_up
    up = cosine * level_up + sine * level_right

    half_height = math.tan(camera.fov / 2)
    half_width = half_height * width / height
    x = (2 * (np.arange(width) + 0.5) / width - 1) * half_width
    y = (1 - 2 * (np.arange(height) + 0.5) / height) * half_height
    result = rays((height, width))
    result["origin"] = camera.position
    result["direction"] = forward + x[None, :, None] * right + y[:, None, None] * up
    return result


class Batch:
    """A Batch says where the library finds the items of an array: where, how many, how many bytes
    apart."""

    def __init__(self, array: NDArray[Any], dtype: np.dtype[Any], name: str) -> None:
        if not isinstance(array, np.ndarray):
            kind = "RAY" if dtype is RAY else "HIT"
            raise _arguments.refusal(name, f"a NumPy array of crt.{kind}", array)
        items = array.shape
        steps = array.strides
        if dtype is RAY and array.dtype == np.float64 and items[-1:] == (8,) and steps[-1] == 8:
            items, steps = items[:-1], steps[:-1]
        elif array.dtype != dtype:
            raise TypeError(
                f"{name} have the dtype {array.dtype}, not crt.{'RAY' if dtype is RAY else 'HIT'}"
            )
        self.shape = items
        self.count = math.prod(items)
        self.address = array.ctypes.data
        self.stride = _common_stride(items, steps, dtype.itemsize, name)


def _common_stride(shape: tuple[int, ...], strides: tuple[int, ...], size: int, name: str) -> int:
    """Returns the one distance from each item to the next, of an array of any number of
    dimensions."""
    steps = [(length, step) for length, step in zip(shape, strides) if length != 1]
    if math.prod(shape) == 0 or not steps:
        return size
    stride = steps[-1][1]
    if stride < size:
        raise ValueError(f"{name} overlap or run backwards")
    expected = stride
    for length, step in reversed(steps):
        if step != expected:
            raise ValueError(f"{name} are not evenly spaced: ask row by row")
        expected *= length
    return stride
