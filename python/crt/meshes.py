"""Meshes are made of triangles that a program has, or that are in a file."""

import ctypes
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments
from ._library import create
from ._materials import AnyMaterial
from ._structs import Struct, growable, require_type
from .entities import Entity
from .primitives import _Primitive
from .values import Material, PrincipledMaterial

__all__ = ["Mesh", "MeshReport", "load_mesh", "mesh_report"]

_FILLS = ("nonzero", "evenodd")  # as crt_fill_rule counts them


@dataclass(frozen=True)
class MeshReport:
    """A MeshReport says what was found out about the triangles of a mesh, and what was changed."""

    fill: str
    """The rule that says what is inside: "evenodd" or "nonzero"."""
    welded_vertices: int
    """So many vertices became others by `weld`."""
    welded_triangles: int
    """So many triangles went, as two of their corners became one."""
    stitched_vertices: int
    """So many times an edge was divided by `stitch`."""
    repeated_triangles: int
    """So many triangles have the corners of an earlier one."""
    first_repeated: tuple[float, float, float]
    """The middle of one of these."""
    shells: int
    """So many parts are not connected by edges."""
    overlapping_shells: int
    """So many of them lie in others, overlap them or pass through themselves, turned one way."""
    first_overlap: tuple[float, float, float]
    """A point near the first of these places."""
    warnings: list[str]
    """What most likely was not meant, what of a file was left out, and what was changed."""


def mesh_report(entity: Entity) -> MeshReport:
    """Returns the report of an entity that is one mesh, wherever it is placed. Others are a
    crt.Error."""
    report = _ReportStruct._filled_by("crt_entity_mesh_report", entity._handle)
    values: dict[str, Any] = {name: getattr(report, name) for name in _ReportStruct._public()}
    values["fill"] = _FILLS[report.fill]
    for place in ("first_repeated", "first_overlap"):
        values[place] = tuple(values[place])
    return MeshReport(**values, warnings=entity._text("crt_entity_mesh_warnings").splitlines())


def load_mesh(
    path: str | os.PathLike[str],
    *,
    smooth: SupportsFloat | None = None,
    fill: str | None = None,
    weld: SupportsFloat = 0,
    stitch: SupportsFloat = 0,
    material: AnyMaterial | None = None,
    id: int | None = None,
) -> Entity:
    """Returns the entity of a mesh file: OBJ, PLY, STL, 3MF or OFF. The content shows which it is,
    or else the name. `smooth` is that of Mesh, and without it the file's normals count. `fill`,
    `weld` and `stitch` are those of Mesh. Without `fill` it is "nonzero" if all shells are turned
    outwards, but for cavities, and else "evenodd". `material` takes the place of the file's. A
    broken file is a crt.Error with its line or byte."""
    angle = -1 if smooth is None else _angle(smooth, "load_mesh: smooth")
    place = _arguments.text(path, "load_mesh: path")
    options = ctypes.byref(_options(fill, weld, stitch, "load_mesh"))
    entity = Entity._adopt(create("crt_mesh_load_with", place, None, angle, options))
    if material is not None:
        entity = entity.with_material(material)
    return entity if id is None else entity.with_id(id)


@growable("crt_mesh")
class _MeshStruct(Struct):
    """A _MeshStruct has the addresses of arrays, which it keeps."""

    def put(self, field: str, count: str | None, values: Any) -> None:
        """Sets a field to an array, and another one to its length."""
        address = values.ctypes.data if isinstance(values, np.ndarray) else ctypes.addressof(values)
        ctypes.Structure.__setattr__(self, field, address)
        if count is not None:
            ctypes.Structure.__setattr__(self, count, len(values))
        self._kept[f"_{field}"] = values


@growable("crt_mesh_options")
class _OptionsStruct(Struct):
    """An _OptionsStruct says what is inside of a mesh, and how it is put right before."""


@growable("crt_mesh_report")
class _ReportStruct(Struct):
    """A _ReportStruct is what the library fills in of a MeshReport."""


class Mesh(_Primitive):
    """A Mesh is made of triangles: n x 3 positions, and m x 3 indices into them. It is a solid if
    each edge belongs to an even number of triangles, and else a surface.

    `fill` says what is inside. "evenodd" (the default): where a line to infinity crosses an odd
    number of triangles. "nonzero": where they go about a point more often in one direction than in
    the other, so that parts which overlap are one solid. Each edge must run as often in one
    direction as in the other then. `weld` makes vertices up to that far from an earlier one that
    one. `stitch` divides open edges on which vertices of others lie, up to that far away.
    mesh_report() says what both have changed.

    `normals` (k x 3, for shading) and `uv` (k x 2) are one for each position, or are named for the
    corners of each triangle by `normal_indices` and `uv_indices` (m x 3). With `smooth`, an angle
    in radians, normals are computed instead, across edges of triangles that are at most that far
    apart. `material_of_triangle` (m) names one of the `materials` for each triangle, which may be
    of either kind; without it all have the first. `material` takes the place of all of them. Where
    these lists of indices have 0xffffffff there is none."""

    def __init__(
        self,
        positions: ArrayLike,
        indices: ArrayLike,
        *,
        normals: ArrayLike | None = None,
        normal_indices: ArrayLike | None = None,
        uv: ArrayLike | None = None,
        uv_indices: ArrayLike | None = None,
        materials: Sequence[AnyMaterial] = (),
        material_of_triangle: ArrayLike | None = None,
        smooth: SupportsFloat | None = None,
        fill: str | None = None,
        weld: SupportsFloat = 0,
        stitch: SupportsFloat = 0,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        mesh = _MeshStruct()
        points = _numbers(positions, 3, "positions")
        corners = _whole_numbers(indices, 3, "indices")
        if (corners >= len(points)).any():
            raise ValueError(
                "Mesh: indices must be whole numbers below the number of positions,"
                f" which is {len(points)}"
            )
        mesh.put("positions", "vertex_count", points)
        mesh.put("indices", "triangle_count", corners)
        if normals is not None:
            mesh.put("normals", "normal_count", _numbers(normals, 3, "normals"))
        if uv is not None:
            mesh.put("uv", "uv_count", _numbers(uv, 2, "uv"))
        for name, width, given in (
            ("normal_indices", 3, normal_indices),
            ("uv_indices", 3, uv_indices),
            ("material_of_triangle", None, material_of_triangle),
        ):
            if given is not None:
                numbers = _whole_numbers(given, width, name)
                if len(numbers) != len(corners):
                    raise ValueError(f"Mesh: {name} must have {len(corners)} rows, as indices has")
                mesh.put(name, None, numbers)
        _put_materials(mesh, materials)
        if smooth is not None:
            mesh.smooth = _angle(smooth, "Mesh: smooth")
        shown = {"positions": f"<{len(points)} x 3>", "indices": f"<{len(corners)} x 3>"}
        options = _options(fill, weld, stitch, "Mesh")
        self._create(
            "crt_mesh_create_with_options",
            material,
            id,
            shown,
            ctypes.byref(mesh),
            ctypes.byref(options),
        )


def _options(
    fill: str | None, weld: SupportsFloat, stitch: SupportsFloat, name: str
) -> _OptionsStruct:
    options = _OptionsStruct()
    if fill is not None:
        if fill not in _FILLS:
            raise ValueError(f'{name}: fill must be "evenodd" or "nonzero", not {fill!r}')
        options.fill = _FILLS.index(fill)
    for field, given in (("weld", weld), ("stitch", stitch)):
        distance = _arguments.number(given, f"{name}: {field}")
        if not 0 <= distance <= 1e100:
            raise ValueError(f"{name}: {field} must be from 0 to 1e100, not {distance}")
        setattr(options, field, distance)
    return options


def _angle(value: SupportsFloat, name: str) -> float:
    angle = _arguments.number(value, name)
    if not 0 <= angle <= np.pi:
        raise ValueError(f"{name} must be an angle from 0 to pi, not {angle}")
    return angle


def _put_materials(mesh: _MeshStruct, materials: Sequence[AnyMaterial]) -> None:
    given: list[Any] = list(materials)
    if not given:
        return
    for i, material in enumerate(given):
        if not isinstance(material, PrincipledMaterial):
            require_type(material, "crt_material", f"Mesh: materials[{i}]")
    kinds: dict[str, type[Any]] = {"materials": Material, "principled": PrincipledMaterial}
    for field, kind in kinds.items():
        addresses = [ctypes.addressof(m) if isinstance(m, kind) else None for m in given]
        mesh.put(field, "material_count", (ctypes.c_void_p * len(given))(*addresses))
    mesh._kept["_owners"] = given


def _numbers(given: ArrayLike, width: int, name: str) -> NDArray[np.float64]:
    try:
        numbers = np.ascontiguousarray(given, np.float64)
    except (TypeError, ValueError):
        raise _arguments.refusal(f"Mesh: {name}", f"n x {width} numbers", given) from None
    if numbers.ndim != 2 or numbers.shape[1] != width:
        raise ValueError(f"Mesh: {name} must be n x {width} numbers, not {numbers.shape}")
    return numbers


def _whole_numbers(given: ArrayLike, width: int | None, name: str) -> NDArray[np.uint32]:
    """Returns m x width indices, or m of them without a width."""
    numbers = np.asarray(given)
    if numbers.ndim != (1 if width is None else 2) or (width and numbers.shape[1] != width):
        shape = "m" if width is None else f"m x {width}"
        raise ValueError(f"Mesh: {name} must be {shape} whole numbers, not {numbers.shape}")
    if numbers.dtype.kind not in "iu" or (numbers < 0).any() or (numbers > 0xFFFFFFFF).any():
        raise ValueError(f"Mesh: {name} must be whole numbers from 0 to 4294967295")
    return np.ascontiguousarray(numbers, np.uint32)
