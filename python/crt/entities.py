"""Entities are solids and surfaces, combined and moved. They never change: each operation makes a
new one.

    part = crt.Box((-1, 0, -1), (1, 2, 1)) - crt.Sphere((0, 2, 0), 0.8, material=red)

a + b or a | b is the union, a - b the difference, a ^ b or a & b the intersection.
"""

import ctypes
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._handles import Handle, Reference
from ._library import create, library
from ._structs import reference, require_type, vector
from .values import Material

Point = Sequence[float]


class Entity(Handle):
    """An Entity is something in a scene. All that follow take `material=` and `id=`, as
    with_material and with_id do."""

    _name = "crt_entity"

    def _create(
        self,
        function: str,
        *arguments: Any,
        material: Material | None = None,
        id: int | None = None,
    ) -> None:
        self._take(create(function, *arguments))
        if material is not None:
            self._take(
                create(
                    "crt_entity_with_material", self._handle, reference(material, "crt_material")
                )
            )
        if id is not None:
            self._take(create("crt_entity_with_id", self._handle, id))

    def with_material(self, material: Material) -> "Entity":
        """Returns the entity with a material on every part that has none of its own."""
        return Entity._adopt(
            create("crt_entity_with_material", self._handle, reference(material, "crt_material"))
        )

    def with_id(self, id: int) -> "Entity":
        """Returns the entity under a number that hits report."""
        return Entity._adopt(create("crt_entity_with_id", self._handle, id))

    def transformed(self, matrix: ArrayLike) -> "Entity":
        """Returns the entity moved by an affine map: a 3 x 4 matrix, or a 4 x 4 one whose last row
        is 0, 0, 0, 1."""
        rows = np.asarray(matrix, np.float64)
        if rows.shape == (4, 4) and np.array_equal(rows[3], (0, 0, 0, 1)):
            rows = rows[:3]
        if rows.shape != (3, 4):
            raise ValueError(
                "a transform is a 3 x 4 matrix, or 4 x 4 with 0, 0, 0, 1 in its last row"
            )
        return Entity._adopt(
            create(
                "crt_entity_with_transform",
                self._handle,
                (ctypes.c_double * 12)(*rows.ravel().tolist()),
            )
        )

    def moved(self, offset: Point) -> "Entity":
        return self.transformed(np.column_stack((np.eye(3), vector(offset))))

    def scaled(self, factors: float | Point) -> "Entity":
        """Scales by one factor, or one for each axis, about the origin."""
        return self.transformed(np.column_stack((np.eye(3) * np.asarray(factors), np.zeros(3))))

    def rotated(self, degrees: Point) -> "Entity":
        """Rotates by degrees about x, then y, then z, as in scripts: 90 about z takes x to y.
        Multiples of 90 are exact.

        Multiples of 90 are exact.
        """
        about_x, about_y, about_z = (_rotation(axis, angle) for axis, angle in enumerate(degrees))
        return self.transformed(np.column_stack((about_z @ about_y @ about_x, np.zeros(3))))

    def __add__(self, other: "Entity") -> "Entity":
        return union((self, other)) if isinstance(other, Entity) else NotImplemented

    def __sub__(self, other: "Entity") -> "Entity":
        return difference(self, (other,)) if isinstance(other, Entity) else NotImplemented

    def __xor__(self, other: "Entity") -> "Entity":
        return intersection((self, other)) if isinstance(other, Entity) else NotImplemented

    __or__ = __add__
    __and__ = __xor__

    @property
    def is_solid(self) -> bool:
        """Says whether it has an inside. It has none if a part of it is a mere surface."""
        return bool(library.crt_entity_is_solid(self._handle))

    @property
    def primitive_count(self) -> int:
        return int(library.crt_entity_primitive_count(self._handle))


def union(parts: Iterable[Entity]) -> Entity:
    """Returns what is in any of the parts."""
    return Entity._adopt(create("crt_union_create", *_handles(parts)))


def intersection(parts: Iterable[Entity]) -> Entity:
    """Returns what is in all of the parts."""
    return Entity._adopt(create("crt_intersection_create", *_handles(parts)))


def difference(whole: Entity, cutters: Iterable[Entity]) -> Entity:
    """Returns what is in the whole and in none of the cutters. A cut has its cutter's material."""
    require_type(whole, "crt_entity", "the whole")
    return Entity._adopt(create("crt_difference_create", whole._handle, *_handles(cutters)))


class Empty(Entity):
    """Empty is the solid without a point. No ray meets it, and in combinations it behaves as the
    empty set."""

    def __init__(self, **common: Any) -> None:
        self._create("crt_empty_create", **common)


class Sphere(Entity):
    def __init__(self, center: Point, radius: float, **common: Any) -> None:
        self._create("crt_sphere_create", vector(center), radius, **common)


class Box(Entity):
    """A Box is parallel to the axes, between any two opposite corners."""

    def __init__(self, corner_a: Point, corner_b: Point, **common: Any) -> None:
        self._create("crt_box_create", vector(corner_a), vector(corner_b), **common)


class Plane(Entity):
    """A Plane is the half-space behind a plane. The normal points out of it."""

    def __init__(self, normal: Point, position: Point = (0, 0, 0), **common: Any) -> None:
        self._create("crt_plane_create", vector(normal), vector(position), **common)


class HalfPlane(Entity):
    """A HalfPlane is a surface: the half of a plane on the `direction` side of the line through
    `position` across it."""

    def __init__(self, normal: Point, position: Point, direction: Point, **common: Any) -> None:
        vectors = vector(normal), vector(position), vector(direction)
        self._create("crt_half_plane_create", *vectors, **common)


class Cylinder(Entity):
    def __init__(self, start: Point, end: Point, radius: float, **common: Any) -> None:
        self._create("crt_cylinder_create", vector(start), vector(end), radius, **common)


class Cone(Entity):
    """A Cone has its apex at the end, or with `radius2` there it is a part of one."""

    def __init__(
        self, start: Point, end: Point, radius: float, radius2: float = 0, **common: Any
    ) -> None:
        self._create("crt_cone_create", vector(start), vector(end), radius, radius2, **common)


class Torus(Entity):
    """A Torus is all points within `thickness` of the circle of `radius` about `center` across
    `axis`."""

    def __init__(
        self, center: Point, axis: Point, radius: float, thickness: float, **common: Any
    ) -> None:
        self._create("crt_torus_create", vector(center), vector(axis), radius, thickness, **common)


class Disc(Entity):
    """A Disc is a surface."""

    def __init__(self, center: Point, normal: Point, radius: float, **common: Any) -> None:
        self._create("crt_disc_create", vector(center), vector(normal), radius, **common)


class Triangle(Entity):
    """A Triangle is a surface."""

    def __init__(self, a: Point, b: Point, c: Point, **common: Any) -> None:
        self._create("crt_triangle_create", vector(a), vector(b), vector(c), **common)


class Mesh(Entity):
    """A Mesh is a surface of triangles: n x 3 positions, and m x 3 indices into them."""

    def __init__(self, positions: ArrayLike, indices: ArrayLike, **common: Any) -> None:
        points = np.ascontiguousarray(positions, np.float64)
        corners = np.asarray(indices)
        if points.ndim != 2 or points.shape[1] != 3 or corners.ndim != 2 or corners.shape[1] != 3:
            raise ValueError("a mesh has n x 3 positions and m x 3 indices")
        if corners.dtype.kind not in "iu" or (corners < 0).any() or (corners >= len(points)).any():
            raise ValueError("a mesh's indices are whole numbers below the number of positions")
        corners = np.ascontiguousarray(corners, np.uint32)
        arrays = points.ctypes.data, len(points), corners.ctypes.data, len(corners)
        self._create("crt_mesh_create", *arrays, **common)


def _handles(entities: Iterable[Entity]) -> tuple[Any, int]:
    """Returns the array of pointers that the library needs, and its length."""
    parts = list(entities)
    for part in parts:
        require_type(part, "crt_entity", "a part")
    references: list[Reference] = [part._handle for part in parts]
    array: Any = (ctypes.c_void_p * len(references))(
        *(reference._as_parameter_ for reference in references)
    )
    array.references = references  # live as long as the array
    return array, len(references)


def _rotation(axis: int, degrees: float) -> NDArray[Any]:
    quarters = degrees / 90
    if quarters == round(quarters):
        cosine, sine = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    else:
        cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[first, first] = matrix[second, second] = cosine
    matrix[second, first], matrix[first, second] = sine, -sine
    return matrix
