"""A section is what a plane cuts out of a solid, as contours of lines and arcs.

    plate = crt.Box((-50, 0, -30), (50, 12, 30)) - crt.Cylinder((0, -1, 0), (0, 13, 0), 4)
    cut = plate.section((0, 1, 0), 6, 0.01)
    print(cut.area)
    cut.write("plate.svg", unit="mm", hatch=2)
"""

import ctypes
import os
from typing import SupportsFloat

import numpy as np
from numpy.typing import NDArray

from . import _arguments, measures
from ._handles import Handle, Reference
from ._library import create, library
from .measures import Interval
from .profiles import Contour, contours_of

_UNITS = ("m", "cm", "mm", "in")  # as crt_unit has them


class Section(Handle):
    """A Section is what a plane cuts out of a solid, from `entity.section()`."""

    _name = "crt_section"
    _instead_of_pickle = "pickle its contours"

    @property
    def contours(self) -> list[NDArray[np.float64]]:
        """Returns the contours as points in the world, an array of n x 3 numbers each. Their chords
        are within the deviation that was asked for of the lines and arcs. Outer ones go
        counterclockwise, as seen against the normal, and holes clockwise."""
        count = ctypes.c_size_t()
        first = ctypes.POINTER(ctypes.c_size_t)()
        points = ctypes.POINTER(ctypes.c_double)()
        arguments = (ctypes.byref(count), ctypes.byref(first), ctypes.byref(points))
        library.crt_section_contours(self._handle, *arguments)
        starts = first[: count.value + 1]
        if not count.value:
            return []
        lent = np.ctypeslib.as_array(points, (starts[-1], 3))
        return [lent[begin:end].copy() for begin, end in zip(starts, starts[1:])]

    @property
    def profile(self) -> list[Contour]:
        """Returns the contours as lines and arcs, in the coordinates of the drawing: lists of
        corners (x, y, bulge), which crt.Extrusion takes. The bulge is that of the piece that leads
        to a corner."""
        profile = Reference(
            create("crt_section_profile", self._handle), library.crt_profile_release
        )
        return contours_of(profile)

    @property
    def area(self) -> Interval:
        """Returns the area of the section, in squared scene units."""
        return measures.section_area(self._handle)

    @property
    def deviation(self) -> float:
        """Returns how far the contours and the true boundary are from each other at most. It is
        infinite if there may be a part of the section of which no contour is known."""
        found = ctypes.c_double()
        library.crt_section_deviation(self._handle, ctypes.byref(found))
        return found.value

    @property
    def frame(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Returns where the drawing is in the world, as (origin, x_axis, y_axis): a point (x, y) of
        it is origin + x * x_axis + y * y_axis."""
        return self._place()[0]

    @property
    def offset(self) -> float:
        """Returns the offset of the plane. It is not quite that which was asked for where the plane
        is moved out of a face of the solid."""
        return self._place()[1]

    def write(
        self, path: str | os.PathLike[str], unit: str = "m", hatch: SupportsFloat = 0
    ) -> None:
        """Writes a drawing, as SVG or DXF by the ending of the name. `unit` says what a scene unit
        is: "m", "cm", "mm" or "in". `hatch` is the distance of hatching lines, in scene units, or 0
        for none."""
        if unit not in _UNITS:
            names = ", ".join(map(repr, _UNITS))
            raise ValueError(f"write: unit must be one of {names}, not {unit!r}")
        file = _arguments.text(path, "write: path")
        distance = _arguments.number(hatch, "write: hatch")
        library.crt_section_write_with(self._handle, file, _UNITS.index(unit), distance)

    def _place(
        self,
    ) -> tuple[tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]], float]:
        origin, x_axis, y_axis = np.empty(3), np.empty(3), np.empty(3)
        offset = ctypes.c_double()
        library.crt_section_frame(
            self._handle, origin.ctypes.data, x_axis.ctypes.data, y_axis.ctypes.data,
            ctypes.byref(offset)
        )
        return (origin, x_axis, y_axis), offset.value

