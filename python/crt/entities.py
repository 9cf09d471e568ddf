"""Entities are solids and surfaces, combined and moved. They never change: each operation makes a
new one.

    part = crt.Box((-1, 0, -1), (1, 2, 1)) - crt.Sphere((0, 2, 0), 0.8, material=red)

a + b or a | b is the union, a - b the difference, a ^ b or a & b the intersection.
"""

import ctypes
import json
import math
from collections.abc import Iterable, Sequence
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, measures
from ._arguments import Point
from ._handles import Handle, Reference
from ._library import create, library
from ._materials import AnyMaterial, dressed
from .measures import Clearance, Interval, Mass, Nearest, Overlap, Thickness
from .rays import points_of
from .sections import Section
from .surface_meshes import SurfaceMesh, tessellated

MOST_CALLS = 3  # that a representation shows


class Entity(Handle):
    """An Entity is something in a scene: a primitive (crt.Sphere, crt.Box, ...), or several that
    are combined. Notebooks show a picture of it."""

    _name = "crt_entity"
    _instead_of_pickle = "pickle what it is made from, or the text of a script"
    # For the representation: the primitive that it is made of, if it is one, and the calls that
    # were made since, or the last of them.
    _source: tuple[str, dict[str, Any]] | None = None
    _calls: tuple[tuple[str, Any], ...] = ()

    def with_material(self, material: AnyMaterial) -> "Entity":
        """Returns the entity with a material on every part that has none of its own."""
        handle, kept = dressed(self._handle, material, "with_material: material")
        return Entity._adopt(handle)._made_by(self, "with_material", kept)

    def with_id(self, id: SupportsIndex) -> "Entity":
        """Returns the entity under a number that hits report: the outermost one for the entity, the
        innermost one for its part (see Prepared.hit_parts)."""
        number = _arguments.whole(id, "with_id: id", ctypes.c_uint32)
        entity = Entity._adopt(create("crt_entity_with_id", self._handle, number))
        return entity._made_by(self, "with_id", number)

    def with_user(self, user: SupportsIndex) -> "Entity":
        """Returns the entity with a number of your choice for all its parts that have none, which
        crt.FULL_HIT and crt.LOCATION report. The innermost one holds."""
        number = _arguments.whole(user, "with_user: user", ctypes.c_uint64)
        entity = Entity._adopt(create("crt_entity_with_user", self._handle, number))
        return entity._made_by(self, "with_user", number)

    def with_shadow(self, casts: bool) -> "Entity":
        """Returns the entity as one that casts a shadow or none. The last call holds, and it is of
        whole entities of a scene: one that casts none cannot be combined."""
        yes = _arguments.boolean(casts, "with_shadow: casts")
        entity = Entity._adopt(create("crt_entity_with_shadow", self._handle, yes))
        return entity._made_by(self, "with_shadow", yes)

    def with_visible(self, visible: bool) -> "Entity":
        """Returns the entity as one that the camera sees or not. Mirrors, glass and shadows show it
        all the same, and rays of queries meet it. Otherwise as with_shadow."""
        yes = _arguments.boolean(visible, "with_visible: visible")
        entity = Entity._adopt(create("crt_entity_with_visible", self._handle, yes))
        return entity._made_by(self, "with_visible", yes)

    def transformed(self, matrix: ArrayLike) -> "Entity":
        """Returns the entity moved by an affine map: a 3 x 4 matrix, or a 4 x 4 one whose last row
        is 0, 0, 0, 1."""
        try:
            rows = np.asarray(matrix, np.float64)
        except (TypeError, ValueError):
            raise _arguments.refusal("transformed: matrix", "3 x 4 numbers", matrix) from None
        if rows.shape == (4, 4) and np.array_equal(rows[3], (0, 0, 0, 1)):
            rows = rows[:3]
        if rows.shape != (3, 4):
            raise ValueError(
                "transformed: matrix must be 3 x 4, or 4 x 4 with 0, 0, 0, 1 in its last row"
            )
        return self._mapped(rows)._made_by(self, "transformed", tuple(map(tuple, rows.tolist())))

    def moved(self, offset: Point) -> "Entity":
        """Returns the entity moved by a vector."""
        column = _arguments.vector(offset, "moved: offset")
        moved = self._mapped(np.column_stack((np.eye(3), column)))
        return moved._made_by(self, "moved", tuple(column))

    def scaled(self, factors: SupportsFloat | Point) -> "Entity":
        """Scales by one factor, or one for each axis, about the origin."""
        is_one = isinstance(factors, str) or not isinstance(factors, Sequence)
        given: Any
        if is_one and np.asarray(factors).ndim == 0:
            given = _arguments.number(factors, "scaled: factors", "one number or three")
            scale = np.eye(3) * given
        else:
            given = tuple(_arguments.vector(factors, "scaled: factors"))
            scale = np.diag(given)
        scaled = self._mapped(np.column_stack((scale, np.zeros(3))))
        return scaled._made_by(self, "scaled", given)

    def rotated(self, degrees: Point) -> "Entity":
        """Rotates by degrees about x, then y, then z, as in scripts: 90 about z takes x to y.
        Multiples of 90 are exact."""
        angles = _arguments.vector(degrees, "rotated: degrees")
        about_x, about_y, about_z = (_rotation(axis, angle) for axis, angle in enumerate(angles))
        rotated = self._mapped(np.column_stack((about_z @ about_y @ about_x, np.zeros(3))))
        return rotated._made_by(self, "rotated", tuple(angles))

    def rotated_about(
        self, axis: Point, degrees: SupportsFloat, point: Point = (0, 0, 0)
    ) -> "Entity":
        """Rotates by degrees about a line through a point, in the sense of rotated."""
        name = "rotated_about: "
        along = _direction(axis, name + "axis")
        angle = _arguments.number(degrees, name + "degrees", "a number")
        (cosine, _, _), (sine, _, _), _ = _rotation(2, angle)
        across = np.cross(np.eye(3), along)
        linear = cosine * np.eye(3) + sine * across + (1 - cosine) * np.outer(along, along)
        turned = self._mapped_about(linear, point, name + "point")
        return turned._made_by(self, "rotated_about", tuple(axis), angle, tuple(point))

    def mirrored(self, normal: Point, point: Point = (0, 0, 0)) -> "Entity":
        """Mirrors in the plane through a point that is normal to a vector."""
        along = _direction(normal, "mirrored: normal")
        linear = np.eye(3) - 2 * np.outer(along, along)
        image = self._mapped_about(linear, point, "mirrored: point")
        return image._made_by(self, "mirrored", tuple(normal), tuple(point))

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
    def solid_fault(self) -> str:
        """Says why it has no inside: of a mesh which edge is open. It is empty for a solid."""
        return self._text("crt_entity_solid_fault")

    def describe(self) -> list[dict[str, Any]]:
        """Returns what it is and what it is made of: a list of dictionaries, each before its
        parts. A `kind` is the type of a primitive ("Sphere"), "Union", "Intersection",
        "Difference", "Placed" or "Empty". `parent` is the place in the list of what it is a part
        of, and None for the entity itself. `values` has the numbers and vectors of its fields, and
        what its material is like. After 10000 parts the rest is left out."""
        parts: list[dict[str, Any]] = json.loads(self._text("crt_entity_describe"))
        return parts

    def _text(self, function: str) -> str:
        """Returns what a function of the library writes into an array of bytes."""
        call = getattr(library, function)
        length = ctypes.c_size_t()
        call(self._handle, None, 0, ctypes.byref(length))
        text = ctypes.create_string_buffer(length.value + 1)
        call(self._handle, text, len(text), ctypes.byref(length))
        return text.value.decode()

    @property
    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Returns the low and the high corner of a box that holds it, rounded outwards. Each side
        is within 1e-6 times half of the longest one of where the smallest box has it. That of a
        surface, or of what is infinite along any axis, may be larger. Sides of what has no end are
        infinite, and what has no points has its low corner above the high one."""
        low, high = np.empty(3), np.empty(3)
        library.crt_entity_bounds(self._handle, low.ctypes.data, high.ctypes.data)
        return low, high

    @property
    def density(self) -> float | None:
        """Returns the density that its materials say, in kg per cubic metre, or None if they say
        none. It is an error if parts have different ones. Of a difference and of an intersection
        the first part counts alone."""
        found = ctypes.c_double()
        library.crt_entity_density(self._handle, ctypes.byref(found))
        return found.value or None

    def volume(
        self, relative_width: SupportsFloat = 1e-6, seconds: SupportsFloat | None = None
    ) -> Interval:
        """Returns the volume of the solid, in cubed scene units. It is found to `relative_width`,
        relative to its size, or as far as it is known after so many seconds."""
        return measures.interval("volume", self._handle, relative_width, seconds)

    def area(
        self, relative_width: SupportsFloat = 1e-6, seconds: SupportsFloat | None = None
    ) -> Interval:
        """Returns the area of the solid's surface, in squared scene units. Its upper end is
        infinite while a place of the surface is so narrow that nothing bounds it."""
        return measures.interval("area", self._handle, relative_width, seconds)

    def mass(
        self, relative_width: SupportsFloat = 1e-6, seconds: SupportsFloat | None = None
    ) -> Mass:
        """Returns volume, area, centroid and inertia of the solid, for a density of 1. It takes
        some times as long as the volume alone."""
        return measures.mass(self._handle, relative_width, seconds)

    def centroid(
        self, relative_width: SupportsFloat = 1e-6, seconds: SupportsFloat | None = None
    ) -> tuple[Interval, Interval, Interval]:
        """Returns the centroid of the solid, which takes less long than all of mass(). Widths are
        relative to half of the longest side of the box around it."""
        return measures.centroid(self._handle, relative_width, seconds)

    def section(
        self,
        normal: Point,
        offset: SupportsFloat,
        deviation: SupportsFloat,
        seconds: SupportsFloat | None = None,
    ) -> Section:
        """Returns what the plane of all p with normal . p = offset, for a normal of length 1, cuts
        out of the solid: contours within `deviation` of the true boundary. What is known after so
        many seconds has a larger deviation. Ctrl-C ends the search, and comes out of here."""
        direction = _arguments.vector(normal, "section: normal")
        place = _arguments.number(offset, "section: offset")
        within = _arguments.number(deviation, "section: deviation")
        given = (self._handle, direction, place, within)
        with measures.searching("section", 1e-6, seconds) as options:
            return Section._adopt(create("crt_section_create_with", *given, options))

    def contains(self, points: ArrayLike) -> NDArray[np.int8]:
        """Says of points, in an array of ... x 3 numbers, where they are: 1 inside of the solid, 0
        on its surface, as far as rounding of its equations lets one know, and -1 outside."""
        return measures.sides(self._handle, points_of(points, "contains: points"))

    def distance(
        self,
        points: ArrayLike,
        relative_width: SupportsFloat = 1e-6,
        seconds: SupportsFloat | None = None,
    ) -> Nearest:
        """Returns how far points, in an array of ... x 3 numbers, are from the solid's surface,
        below 0 in it, and its nearest points. No distance is less than the true one. It is at most
        `relative_width` of itself more, unless surfaces are equally near over a wide range, as
        between a shaft and its bore, or merely touch: there the search ends earlier. So it does
        after so many seconds."""
        given = points_of(points, "distance: points")
        return measures.nearest(self._handle, given, relative_width, seconds)

    def clearance(
        self,
        other: "Entity",
        relative_width: SupportsFloat = 1e-6,
        seconds: SupportsFloat | None = None,
    ) -> Clearance:
        """Returns how near this solid and another one are, with a pair of points so far apart, or
        what is known of that after so many seconds."""
        _arguments.instance(other, Entity, "clearance: other")
        return measures.clearance(self._handle, other._handle, relative_width, seconds)

    def least_wall(
        self, relative_width: SupportsFloat = 1e-2, seconds: SupportsFloat | None = None
    ) -> Thickness:
        """Returns how thin the solid's thinnest wall is: the shortest chord in it that is normal to
        the surface at one end and within 5 degrees of a normal at the other. So the edge of a box
        is no wall. The upper end is the length of a chord that is there. The lower end may be poor
        where curved walls of one thickness are large. It is what is known after so many
        seconds."""
        return measures.least_wall(self._handle, relative_width, seconds)

    def tessellate(
        self, deviation: SupportsFloat, seconds: SupportsFloat | None = None
    ) -> SurfaceMesh:
        """Makes a closed mesh of the solid's surface, which is nowhere farther from it than the
        deviation, in scene units. Sharp edges of the solid are edges of triangles. After so many
        seconds the mesh is as good as it is, and its deviation infinite. Ctrl-C ends the search,
        and comes out of here."""
        return tessellated(self._handle, deviation, seconds)

    @property
    def primitive_count(self) -> int:
        """Returns how many primitives it is made of. One that occurs twice counts twice."""
        return int(library.crt_entity_primitive_count(self._handle))

    def _mapped(self, rows: NDArray[np.float64]) -> "Entity":
        numbers = (ctypes.c_double * 12)(*rows.ravel().tolist())
        return Entity._adopt(create("crt_entity_with_transform", self._handle, numbers))

    def _mapped_about(self, linear: NDArray[np.float64], point: Point, name: str) -> "Entity":
        """Applies a linear map as if a point were the origin."""
        center = np.array(_arguments.vector(point, name))[:, None]
        away = self._mapped(np.hstack((np.eye(3), -center)))
        mapped = away._mapped(np.hstack((linear, np.zeros((3, 1)))))
        return mapped._mapped(np.hstack((np.eye(3), center)))

    def _made_by(self, source: "Entity", method: str, *arguments: Any) -> "Entity":
        """Notes for the representation how this entity was made from another one."""
        self._source = source._source
        self._calls = (*source._calls, (method, arguments))[-MOST_CALLS - 1 :]
        return self

    def _expression(self) -> str:
        """Returns the calls that made it, as far as they are known."""
        calls = [
            f".{name}({', '.join(_arguments.written(one) for one in given)})"
            for name, given in self._calls
        ]
        if len(calls) > MOST_CALLS:
            calls[0] = " ... "
        if self._source is None:
            return "".join(calls)
        name, given = self._source
        arguments = ", ".join(f"{key}={_arguments.written(one)}" for key, one in given.items())
        return f"{name}({arguments})" + "".join(calls)

    def _summary(self) -> str:
        count = self.primitive_count
        parts = f"{count} primitive" + ("" if count == 1 else "s")
        made = self._expression()
        return f"{'solid' if self.is_solid else 'surface'} of {parts}" + (made and f", {made}")

    def _repr_png_(self) -> bytes | None:
        """Shows the entity in notebooks: framed by a camera, under a light."""
        from .preview import picture_of_entity

        image = picture_of_entity(self)
        return None if image is None else image._repr_png_()


def union(parts: Iterable[Entity]) -> Entity:
    """Returns what is in any of the parts."""
    given = _arguments.instances(parts, Entity, "union: parts")
    return Entity._adopt(create("crt_union_create", *_handles(given)))


def intersection(parts: Iterable[Entity]) -> Entity:
    """Returns what is in all of the parts."""
    given = _arguments.instances(parts, Entity, "intersection: parts")
    return Entity._adopt(create("crt_intersection_create", *_handles(given)))


def difference(whole: Entity, cutters: Iterable[Entity]) -> Entity:
    """Returns what is in the whole and in none of the cutters. A cut has its cutter's material."""
    _arguments.instance(whole, Entity, "difference: whole")
    given = _arguments.instances(cutters, Entity, "difference: cutters")
    return Entity._adopt(create("crt_difference_create", whole._handle, *_handles(given)))


def interference(
    entities: Iterable[Entity],
    relative_width: SupportsFloat = 1e-6,
    seconds: SupportsFloat | None = None,
) -> list[Overlap]:
    """Returns all pairs of solids that overlap, by their places in `entities`, with the volume that
    they have in common, each after so many seconds. Surfaces are passed over, and so is what only
    touches."""
    given = _arguments.instances(entities, Entity, "interference: entities")
    return measures.overlaps(_handles(given), relative_width, seconds)


def _handles(parts: list[Entity]) -> tuple[Any, int]:
    """Returns the array of pointers that the library needs, and its length."""
    references: list[Reference] = [part._handle for part in parts]
    array: Any = (ctypes.c_void_p * len(references))(
        *(reference._as_parameter_ for reference in references)
    )
    array.references = references  # live as long as the array
    return array, len(references)


def _direction(vector: Point, name: str) -> NDArray[np.float64]:
    """Returns a vector's direction, of length 1."""
    given = np.array(_arguments.vector(vector, name))
    largest = np.abs(given).max()
    if not 0 < largest < math.inf:
        raise ValueError(f"{name} must be finite and not 0")
    return np.asarray(given / largest / np.linalg.norm(given / largest), np.float64)


def _rotation(axis: int, degrees: float) -> NDArray[np.float64]:
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
