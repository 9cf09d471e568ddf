"""Surfaces of solids become triangles, and files for slicers and other programs.

    surface = part.tessellate(0.01)
    surface.write("part.3mf", unit="mm")
"""

import ctypes
import os
from collections.abc import Iterable, Sequence
from typing import Any, SupportsFloat

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, measures
from ._handles import Handle, Reference
from ._library import create, library
from ._structs import _member
from .values import Unit


class _LentNumbers:
    """NumPy makes an array of a _LentNumbers. The array keeps it, and it keeps the mesh."""

    def __init__(self, reference: Reference, function: str, kind: type) -> None:
        count = ctypes.c_size_t()
        address = getattr(library, function)(reference, ctypes.byref(count))
        self._reference = reference
        self._is_empty = count.value == 0
        self.__array_interface__: dict[str, Any] = {
            "version": 3,
            "typestr": np.dtype(kind).str,
            "shape": (count.value, 3),
            "data": (address, True),  # read-only
        }

    @classmethod
    def array(cls, reference: Reference, function: str, kind: type) -> NDArray[Any]:
        lent = cls(reference, function, kind)
        return np.empty((0, 3), kind) if lent._is_empty else np.asarray(lent)


class SurfaceMesh(Handle):
    """A SurfaceMesh is the surface of a solid as triangles: see Entity.tessellate()."""

    _name = "crt_surface_mesh"
    _instead_of_pickle = "pickle its positions and triangles"

    @property
    def positions(self) -> NDArray[np.float64]:
        """Returns the corners, n x 3 and read-only: the library's own memory, which the array
        keeps."""
        return _LentNumbers.array(self._handle, "crt_surface_mesh_positions", np.float64)

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Returns the places of each triangle's corners a, b and c, n x 3 and read-only. The cross
        product of b - a and c - a points out of the solid."""
        return _LentNumbers.array(self._handle, "crt_surface_mesh_indices", np.uint32)

    @property
    def deviation(self) -> float:
        """Returns how far triangles and surface are apart at most. That is proved; it is infinite
        where it could not be."""
        return float(library.crt_surface_mesh_deviation(self._handle))

    def write(
        self,
        path: str | os.PathLike[str],
        unit: Unit | str = Unit.M,
        color: ArrayLike | None = None,
        name: str | None = None,
    ) -> None:
        """Writes a file, all of it or none, in the format that its ending says: .stl (binary),
        .obj, .ply (binary), .3mf or .glb. `unit` is what a scene unit is. 3MF and glTF have it, the
        name and the colour, which is linear red, green, blue and perhaps coverage."""
        colors = None if color is None else [color]
        write_surface_meshes(path, [self], unit, colors, None if name is None else [name])

    def _summary(self) -> str:
        return f"{len(self.triangles)} triangles, within {self.deviation:g}"


def write_surface_meshes(
    path: str | os.PathLike[str],
    meshes: Iterable[SurfaceMesh],
    unit: Unit | str = Unit.M,
    colors: Sequence[ArrayLike] | None = None,
    names: Sequence[str] | None = None,
) -> None:
    """Writes a file of several parts, as SurfaceMesh.write() does. 3MF and glTF have the names and
    colours of the parts, OBJ their names, and PLY their colours."""
    where = _arguments.text(path, "write_surface_meshes: path")
    given = _arguments.instances(meshes, SurfaceMesh, "write_surface_meshes: meshes")
    references = [mesh._handle for mesh in given]
    handles = (ctypes.c_void_p * len(given))(
        *(reference._as_parameter_ for reference in references)
    )
    texts = None
    if names is not None:
        _check_length("names", len(names), len(given))
        encoded = [_arguments.text(name, "write_surface_meshes: names") for name in names]
        texts = (ctypes.c_char_p * len(given))(*encoded)
    numbers = None
    if colors is not None:
        _check_length("colors", len(colors), len(given))
        numbers = np.array([_rgba(color) for color in colors], np.float64)
    library.crt_surface_meshes_write(
        handles,
        len(given),
        texts,
        None if numbers is None else numbers.ctypes.data,
        int(_member(Unit, unit, "unit") if isinstance(unit, str) else Unit(unit)),
        where,
    )


def tessellated(
    entity: Reference, deviation: SupportsFloat, seconds: SupportsFloat | None
) -> SurfaceMesh:
    """Makes a mesh of a solid's surface."""
    distance = _arguments.number(deviation, "tessellate: deviation")
    with measures.searching("tessellate", 1, seconds) as options:
        return SurfaceMesh._adopt(create("crt_entity_tessellate_with", entity, distance, options))


def _rgba(color: ArrayLike) -> NDArray[np.float64]:
    channels = np.asarray(color, np.float64).ravel()
    if channels.size not in (3, 4):
        raise TypeError(f"a colour has 3 or 4 numbers, not {channels.size}")
    return np.append(channels, np.ones(4 - channels.size))


def _check_length(what: str, length: int, wanted: int) -> None:
    if length != wanted:
        raise ValueError(f"write_surface_meshes: {what} are {length}, of {wanted} meshes")
