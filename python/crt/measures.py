"""Measures of solids are intervals that surely hold the truth: how much a solid is, and where.

    volume = (crt.Box((0, 0, 0), (2, 1, 2)) - crt.Sphere((1, 1, 1), 0.5)).volume()
    print(volume.middle, "within", volume.width)
"""

import contextlib
import ctypes
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, SupportsFloat

import numpy as np
from numpy.typing import NDArray

from . import _arguments
from ._callbacks import POLL, Guard
from ._handles import Reference
from ._library import library
from ._structs import Struct, growable


class Interval(NamedTuple):
    """An Interval holds a number: lower <= it <= upper."""

    lower: float
    upper: float

    @property
    def middle(self) -> float:
        """Returns the number half-way."""
        return 0.5 * self.lower + 0.5 * self.upper

    @property
    def width(self) -> float:
        """Returns how far the ends are apart."""
        return self.upper - self.lower

    def __contains__(self, number: object) -> bool:
        """Says whether a number is in it."""
        return self.lower <= _arguments.number(number, "Interval: number") <= self.upper


@dataclass(frozen=True)
class Mass:
    """Mass has the mass properties of a solid of density 1, in scene units."""

    volume: Interval
    area: Interval  # of the surface
    centroid: tuple[Interval, Interval, Interval]
    # About the centroid: xx, yy, zz, xy, yz, zx. The last three are integrals of -x y, -y z, -z x.
    inertia: tuple[Interval, Interval, Interval, Interval, Interval, Interval]

    @property
    def center(self) -> NDArray[np.float64]:
        """Returns the middles of the centroid."""
        return np.array([number.middle for number in self.centroid])

    @property
    def inertia_tensor(self) -> NDArray[np.float64]:
        """Returns the middles of the inertia as a symmetric 3 x 3 matrix."""
        xx, yy, zz, xy, yz, zx = (number.middle for number in self.inertia)
        return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])


class Nearest(NamedTuple):
    """Nearest has the distances of points from a solid's surface, and its nearest points."""

    distance: NDArray[np.float64]  # below 0 in the solid
    point: NDArray[np.float64]


class Clearance(NamedTuple):
    """A Clearance is how near two solids are, with a pair of points so far apart."""

    distance: Interval  # 0 at its lower end if they touch or overlap
    on_a: NDArray[np.float64]
    on_b: NDArray[np.float64]

    @property
    def overlap(self) -> bool:
        """Says whether they have inner points in common, such as `on_a`."""
        return self.distance.upper == 0


class Thickness(NamedTuple):
    """A Thickness is how thin the thinnest wall of a solid is, with the ends of a chord there."""

    least: Interval  # infinite if there is no wall
    start: NDArray[np.float64]
    end: NDArray[np.float64]


class Overlap(NamedTuple):
    """An Overlap says how much two of several entities have in common."""

    first: int  # places in what was given
    second: int
    volume: Interval


class _Interval(ctypes.Structure):
    _fields_ = [("lower", ctypes.c_double), ("upper", ctypes.c_double)]

    def plain(self) -> Interval:
        return Interval(self.lower, self.upper)


class _Mass(ctypes.Structure):
    """This is crt_mass of crt.h."""

    _fields_ = [
        ("struct_size", ctypes.c_uint32),
        ("reserved", ctypes.c_uint32),
        ("volume", _Interval),
        ("area", _Interval),
        ("centroid", _Interval * 3),
        ("inertia", _Interval * 6),
    ]


class _Overlap(ctypes.Structure):
    """This is crt_overlap of crt.h."""

    _fields_ = [("first", ctypes.c_uint64), ("second", ctypes.c_uint64), ("volume", _Interval)]

    def plain(self) -> Overlap:
        return Overlap(self.first, self.second, self.volume.plain())


def _options(
    name: str, relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> tuple[float, float]:
    width = _arguments.number(relative_width, f"{name}: relative_width")
    if seconds is None:
        return width, math.inf
    return width, _arguments.number(seconds, f"{name}: seconds")


@growable("crt_measure_options", shown="measures")
class _MeasureOptions(Struct):
    """_MeasureOptions say how well something is to be known, and what may end the search."""


@contextlib.contextmanager
def searching(
    name: str, relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> Iterator[Any]:
    """Gives what the functions of C take as options. Ctrl-C ends the search, and comes out of
    here."""
    width, end = _options(name, relative_width, seconds)
    guard = Guard()
    # In C a width of 0 stands for the usual one.
    options = _MeasureOptions(relative_width=width or -1.0, seconds=end)
    options.poll = POLL(lambda _user: guard.call(lambda: None))
    with guard.raising():
        yield ctypes.byref(options)


def interval(
    name: str, entity: Reference, relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> Interval:
    """Returns what crt_entity_volume() or the like gives."""
    found = _Interval()
    call = getattr(library, f"crt_entity_{name}")
    call(entity, *_options(name, relative_width, seconds), ctypes.byref(found))
    return found.plain()


def centroid(
    entity: Reference, relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> tuple[Interval, Interval, Interval]:
    """Returns the centroid of a solid."""
    found = (_Interval * 3)()
    library.crt_entity_centroid(entity, *_options("centroid", relative_width, seconds), found)
    x, y, z = (number.plain() for number in found)
    return x, y, z


def section_area(section: Reference) -> Interval:
    """Returns the area of a section."""
    found = _Interval()
    library.crt_section_area(section, ctypes.byref(found))
    return found.plain()


def mass(entity: Reference, relative_width: SupportsFloat, seconds: SupportsFloat | None) -> Mass:
    """Returns the mass properties of a solid."""
    found = _Mass(struct_size=ctypes.sizeof(_Mass))
    options = _options("mass", relative_width, seconds)
    library.crt_entity_mass(entity, *options, ctypes.byref(found))
    centroid: Any = tuple(number.plain() for number in found.centroid)
    inertia: Any = tuple(number.plain() for number in found.inertia)
    return Mass(found.volume.plain(), found.area.plain(), centroid, inertia)


def sides(entity: Reference, points: NDArray[np.float64]) -> NDArray[np.int8]:
    """Returns where points are: 1 inside, 0 on the surface, -1 outside."""
    out = np.empty(points.shape[:-1], np.int8)
    library.crt_entity_contains(entity, points.ctypes.data, 0, out.size, out.ctypes.data)
    return out


def nearest(
    entity: Reference,
    points: NDArray[np.float64],
    relative_width: SupportsFloat,
    seconds: SupportsFloat | None,
) -> Nearest:
    """Returns how far points are from the surface of a solid, and where that is nearest."""
    distance, point = np.empty(points.shape[:-1]), np.empty(points.shape)
    given = (points.ctypes.data, 0, distance.size)
    with searching("distance", relative_width, seconds) as options:
        library.crt_entity_distance_with(
            entity, options, *given, distance.ctypes.data, point.ctypes.data, 0
        )
    return Nearest(distance, point)


def clearance(
    a: Reference, b: Reference, relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> Clearance:
    """Returns how near two solids are."""
    distance, on_a, on_b = _Interval(), np.empty(3), np.empty(3)
    found = (ctypes.byref(distance), on_a.ctypes.data, on_b.ctypes.data)
    with searching("clearance", relative_width, seconds) as options:
        library.crt_entity_clearance_with(a, b, options, *found)
    return Clearance(distance.plain(), on_a, on_b)


def least_wall(
    entity: Reference, relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> Thickness:
    """Returns how thin a solid's thinnest wall is."""
    least, start, end = _Interval(), np.empty(3), np.empty(3)
    found = (ctypes.byref(least), start.ctypes.data, end.ctypes.data)
    with searching("least_wall", relative_width, seconds) as options:
        library.crt_entity_thickness_with(entity, options, *found)
    return Thickness(least.plain(), start, end)


def overlaps(
    handles: tuple[Any, int], relative_width: SupportsFloat, seconds: SupportsFloat | None
) -> list[Overlap]:
    """Returns which solids overlap, and how much. `handles` are an array and its length."""
    options = _options("interference", relative_width, seconds)
    capacity, count = max(64, 4 * handles[1]), ctypes.c_size_t()
    while True:
        found = (_Overlap * capacity)()
        library.crt_interference(*handles, *options, found, capacity, ctypes.byref(count))
        if count.value <= capacity:
            return [overlap.plain() for overlap in found[: count.value]]
        capacity = count.value
