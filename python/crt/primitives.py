"""Primitives are what other entities are made of. Each takes `material=` and `id=` besides, as
Entity.with_material and Entity.with_id do."""

import ctypes
import math
import operator
import re
from collections.abc import Sequence
from typing import Any, ClassVar, Generic, NoReturn, SupportsFloat, SupportsIndex, TypeVar, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments, profiles
from ._arguments import Point
from ._functions import FUNCTIONS
from ._handles import Reference
from ._library import create, library
from ._materials import AnyMaterial, dressed
from .entities import Entity
from .errors import named

__all__ = [
    "Blob",
    "Box",
    "Capsule",
    "Cone",
    "Cylinder",
    "Disc",
    "Ellipsoid",
    "Empty",
    "Extrusion",
    "HalfPlane",
    "HeightField",
    "Helix",
    "Hull",
    "Implicit",
    "Plane",
    "Polyhedron",
    "Quadric",
    "Revolution",
    "RoundedBox",
    "ShapedExtrusion",
    "Sphere",
    "Superellipsoid",
    "Sweep",
    "Thread",
    "Torus",
    "Triangle",
    "Tube",
]


T = TypeVar("T")
Vector = tuple[float, float, float]

# The library's names of arguments, which begin its messages, and Python's.
_NAMES = {
    "to must differ from from": "end must differ from start",
    "from must": "start must",
    "to must": "end must",
}

# What numbers must be that are lengths.
_WANTED = {
    "radius": "a positive number",
    "radius2": "0 or a positive number",
    "thickness": "a positive number",
}


class _Given(Generic[T]):
    """A _Given is an argument that a primitive was made with, to be read back."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name
        self.__doc__ = f"is the argument {name!r} that was given"

    @overload
    def __get__(self, primitive: None, kind: type) -> "_Given[T]": ...
    @overload
    def __get__(self, primitive: "_Primitive", kind: type) -> T: ...
    def __get__(self, primitive: "_Primitive | None", kind: type) -> Any:
        return self if primitive is None else (primitive._source or ("", {}))[1].get(self._name)

    def __set__(self, primitive: "_Primitive", value: NoReturn) -> NoReturn:
        name = type(primitive).__name__
        raise AttributeError(f"a crt.{name} has no {self._name!r} that can be assigned")


class _Primitive(Entity):
    """A _Primitive remembers how it was made, for its representation."""

    _function: ClassVar[str]  # of the library, that makes it
    material = _Given[AnyMaterial | None]()
    id = _Given[int | None]()

    def _create(
        self,
        function: str,
        material: AnyMaterial | None,
        id: SupportsIndex | None,
        given: dict[str, Any],
        *arguments: Any,
    ) -> None:
        with named(type(self).__name__, _NAMES):
            self._take(create(function, *arguments))
        self._dress(material, id, given)

    def _dress(
        self, material: AnyMaterial | None, id: SupportsIndex | None, given: dict[str, Any]
    ) -> None:
        """Gives it what all may have, and remembers that too."""
        name = type(self).__name__
        if material is not None:
            handle, given["material"] = dressed(self._handle, material, f"{name}: material")
            self._take(handle)
        if id is not None:
            number = _arguments.whole(id, f"{name}: id", ctypes.c_uint32)
            self._take(create("crt_entity_with_id", self._handle, number))
            given["id"] = number
        self._source = name, given

    def __init_subclass__(cls) -> None:
        cls._function = "crt" + re.sub("([A-Z])", r"_\1", cls.__name__).lower() + "_create"

    def _make(self, material: AnyMaterial | None, id: SupportsIndex | None, **given: Any) -> None:
        """Makes it of vectors and numbers, which are what its function takes, in that order."""
        name = type(self).__name__
        shown: dict[str, Any] = {}
        arguments: list[Any] = []
        for (key, value), declared in zip(given.items(), FUNCTIONS[self._function][1:]):
            where = f"{name}: {key}"
            if declared.endswith("[3]"):
                arguments.append(_arguments.vector(value, where))
                shown[key] = tuple(arguments[-1])
            else:
                arguments.append(_arguments.number(value, where, _WANTED.get(key, "a number")))
                shown[key] = arguments[-1]
        self._create(self._function, material, id, shown, *arguments)

    def _vectors(self, **points: Point) -> list[Any]:
        """Returns points as C has them."""
        name = type(self).__name__
        return [_arguments.vector(point, f"{name}: {key}") for key, point in points.items()]

    def _positive(self, value: SupportsFloat, name: str) -> float:
        return _arguments.positive(value, f"{type(self).__name__}: {name}")

    def __repr__(self) -> str:
        return super().__repr__() if self._reference is None else self._expression()


class Empty(_Primitive):
    """Empty is the solid without a point. No ray meets it, and in combinations it behaves as the
    empty set."""

    def __init__(
        self, *, material: AnyMaterial | None = None, id: SupportsIndex | None = None
    ) -> None:
        self._create("crt_empty_create", material, id, {})


class Sphere(_Primitive):
    """A Sphere is a ball of `radius` about `center`."""

    center = _Given[Vector]()
    radius = _Given[float]()

    def __init__(
        self,
        center: Point,
        radius: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, center=center, radius=radius)


class Box(_Primitive):
    """A Box is parallel to the axes, between any two opposite corners."""

    corner_a = _Given[Vector]()
    corner_b = _Given[Vector]()

    def __init__(
        self,
        corner_a: Point,
        corner_b: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, corner_a=corner_a, corner_b=corner_b)


class RoundedBox(_Primitive):
    """A RoundedBox is a Box whose edges and corners are rounded. The radius is from 0 to half of
    the shortest side."""

    corner_a = _Given[Vector]()
    corner_b = _Given[Vector]()
    radius = _Given[float]()

    def __init__(
        self,
        corner_a: Point,
        corner_b: Point,
        radius: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, corner_a=corner_a, corner_b=corner_b, radius=radius)


class Plane(_Primitive):
    """A Plane is the half-space behind a plane. The normal points out of it."""

    normal = _Given[Vector]()
    position = _Given[Vector]()

    def __init__(
        self,
        normal: Point,
        position: Point = (0, 0, 0),
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, normal=normal, position=position)


class HalfPlane(_Primitive):
    """A HalfPlane is a surface: the half of a plane on the `direction` side of the line through
    `position` across it."""

    normal = _Given[Vector]()
    position = _Given[Vector]()
    direction = _Given[Vector]()

    def __init__(
        self,
        normal: Point,
        position: Point,
        direction: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, normal=normal, position=position, direction=direction)


class Cylinder(_Primitive):
    """A Cylinder of `radius` reaches from the centre of one cap to that of the other."""

    start = _Given[Vector]()
    end = _Given[Vector]()
    radius = _Given[float]()

    def __init__(
        self,
        start: Point,
        end: Point,
        radius: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, start=start, end=end, radius=radius)


class Cone(_Primitive):
    """A Cone has its apex at the end, or with `radius2` there it is a part of one."""

    start = _Given[Vector]()
    end = _Given[Vector]()
    radius = _Given[float]()
    radius2 = _Given[float]()

    def __init__(
        self,
        start: Point,
        end: Point,
        radius: SupportsFloat,
        radius2: SupportsFloat = 0,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, start=start, end=end, radius=radius, radius2=radius2)


class Capsule(_Primitive):
    """A Capsule is all points within `radius` of the straight line from the start to the end."""

    start = _Given[Vector]()
    end = _Given[Vector]()
    radius = _Given[float]()

    def __init__(
        self,
        start: Point,
        end: Point,
        radius: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, start=start, end=end, radius=radius)


def _points(name: str, path: ArrayLike, argument: str = "path") -> NDArray[np.float64]:
    """Returns points as rows of three numbers."""
    try:
        points = np.ascontiguousarray(path, np.float64)
    except (TypeError, ValueError):
        raise _arguments.refusal(f"{name}: {argument}", "n points", path) from None
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"{name}: {argument} must be n x 3 numbers, not {points.shape}")
    return points


class Extrusion(_Primitive):
    """An Extrusion is a profile that is drawn out from the start to the end. The profile is a
    sequence of corners, (x, y) or (x, y, bulge), or a sequence of such contours. A corner with a
    bulge is joined to the one before it by an arc, of whose angle the bulge is the tangent of a
    quarter. A corner (x1, y1, x2, y2, x, y) is joined by a cubic Bezier curve, whose control points
    come first, and (x1, y1, x, y) by a quadratic one. crt.svg_path gives contours of a drawing.
    What is inside says the even-odd rule. The profile's origin is at the start. Its x is
    along z as far as that is across the axis, or along x if the axis is mostly along z, and its y
    is a quarter of a turn from there about the axis."""

    profile = _Given[Any]()
    start = _Given[Vector]()
    end = _Given[Vector]()

    def __init__(
        self,
        profile: Sequence[Any],
        start: Point,
        end: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        a, b = self._vectors(start=start, end=end)
        contours = profiles.read_contours("Extrusion", profile)
        shown = {"profile": contours, "start": tuple(a), "end": tuple(b)}
        handle = profiles.profile_of(contours)
        self._create("crt_extrusion_create", material, id, shown, handle, a, b)


class Revolution(_Primitive):
    """A Revolution is a profile that is turned about the axis from the start towards the end. The
    profile is as for Extrusion. Its x is the distance from the axis, which is nowhere below 0, and
    its y is the height from the start on. The angle of the turn is in degrees, above 0 and at most
    360. The turn begins along z as far as that is across the axis, or along x if the axis is mostly
    along z."""

    profile = _Given[Any]()
    start = _Given[Vector]()
    end = _Given[Vector]()
    angle = _Given[float]()

    def __init__(
        self,
        profile: Sequence[Any],
        start: Point,
        end: Point,
        angle: SupportsFloat = 360,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        a, b = self._vectors(start=start, end=end)
        contours = profiles.read_contours("Revolution", profile)
        turn = self._positive(angle, "angle")
        shown = {"profile": contours, "start": tuple(a), "end": tuple(b), "angle": turn}
        handle = profiles.profile_of(contours)
        self._create(
            "crt_revolution_create", material, id, shown, handle, a, b, math.radians(turn)
        )


class Sweep(_Primitive):
    """A Sweep is all points that a profile passes as it follows a path of straight lines, across
    which it stays. The profile is as for Extrusion, with its origin on the path. With a `bend` the
    path has an arc of that radius at each point in between, and without the pieces are mitred. y of
    the profile points along `up` at the first line, as far as that is across. A closed path leads
    back from the last point to the first, in a plane."""

    profile = _Given[Any]()
    path = _Given[Any]()
    bend = _Given[float]()
    up = _Given[Vector]()
    closed = _Given[bool]()

    def __init__(
        self,
        profile: Sequence[Any],
        path: ArrayLike,
        bend: SupportsFloat = 0,
        up: Point = (0, 1, 0),
        closed: bool = False,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        contours = profiles.read_contours("Sweep", profile)
        points = _points("Sweep", path)
        radius = _arguments.number(bend, "Sweep: bend")
        (above,) = self._vectors(up=up)
        shown = {
            "profile": contours,
            "path": [tuple(point) for point in points.tolist()],
            "bend": radius,
            "up": tuple(above),
            "closed": bool(closed),
        }
        self._create(
            "crt_sweep_create",
            material,
            id,
            shown,
            profiles.profile_of(contours),
            points.ctypes.data,
            len(points),
            radius,
            above,
            bool(closed),
        )


class Tube(_Primitive):
    """A Tube is all points within a radius of a path. `radii` has a number for each of its points,
    or is one for all, and the ends are round. A `smooth` tube follows a curve through the points,
    whose pieces are off by `deviation` at most. 0 is a 1000th of the largest radius."""

    path = _Given[Any]()
    radii = _Given[Any]()
    smooth = _Given[bool]()
    closed = _Given[bool]()
    deviation = _Given[float]()

    def __init__(
        self,
        path: ArrayLike,
        radii: ArrayLike,
        smooth: bool = False,
        closed: bool = False,
        deviation: SupportsFloat = 0,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        points = _points("Tube", path)
        try:
            given = np.asarray(radii, np.float64)
            every = np.ascontiguousarray(np.broadcast_to(given, len(points)))
        except (TypeError, ValueError):
            raise _arguments.refusal("Tube: radii", "a number, or one a point", radii) from None
        off = _arguments.number(deviation, "Tube: deviation")
        shown = {
            "path": [tuple(point) for point in points.tolist()],
            "radii": every.tolist(),
            "smooth": bool(smooth),
            "closed": bool(closed),
            "deviation": off,
        }
        self._create(
            "crt_tube_create",
            material,
            id,
            shown,
            points.ctypes.data,
            every.ctypes.data,
            len(points),
            bool(smooth),
            bool(closed),
            off,
        )


class HeightField(_Primitive):
    """A HeightField is a solid in the box between two corners, below a surface over a grid of
    heights. `heights` has a row for each z, from lower to upper, of a number for each x. They are
    from 0, at the box's lower y, to 1, at its upper."""

    heights = _Given[Any]()
    corner_a = _Given[Vector]()
    corner_b = _Given[Vector]()

    def __init__(
        self,
        heights: ArrayLike,
        corner_a: Point,
        corner_b: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        try:
            grid = np.ascontiguousarray(heights, np.float64)
        except (TypeError, ValueError):
            raise _arguments.refusal("HeightField: heights", "n x m numbers", heights) from None
        if grid.ndim != 2 or max(grid.shape) >= 2**32:
            raise ValueError(f"HeightField: heights must be n x m numbers, not {grid.shape}")
        a, b = self._vectors(corner_a=corner_a, corner_b=corner_b)
        rows, columns = grid.shape
        shown = {"heights": f"<{rows} x {columns}>", "corner_a": tuple(a), "corner_b": tuple(b)}
        arrays = grid.ctypes.data, columns, rows
        self._create("crt_height_field_create", material, id, shown, *arrays, a, b)


class Quadric(_Primitive):
    """A Quadric is all points for which a sum is at most 0: `squares` times x x, y y and z z,
    `products` times x y, x z and y z, `linear` times x, y and z, and `constant`. All but
    ellipsoids are infinite."""

    squares = _Given[Vector]()
    products = _Given[Vector]()
    linear = _Given[Vector]()
    constant = _Given[float]()

    def __init__(
        self,
        squares: Point,
        products: Point,
        linear: Point,
        constant: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(
            material, id, squares=squares, products=products, linear=linear, constant=constant
        )


class Implicit(_Primitive):
    """An Implicit is all points between the lower and the upper corner of a box at which a field is
    at most 0. The field is an expression of the CRT language, in which x, y and z are the
    coordinates: "x ** 2 + y ** 2 + z ** 2 - 1"."""

    field = _Given[str]()
    lower = _Given[Vector]()
    upper = _Given[Vector]()

    def __init__(
        self,
        field: str,
        lower: Point,
        upper: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        if not isinstance(field, str):
            raise _arguments.refusal("Implicit: field", "a str", field)
        a, b = self._vectors(lower=lower, upper=upper)
        text = field.encode()
        shown = {"field": field, "lower": tuple(a), "upper": tuple(b)}
        self._create("crt_implicit_create", material, id, shown, text, len(text), a, b)


class Blob(_Primitive):
    """A Blob is all points at which parts add up to a threshold or more. A part is (center, radius,
    strength), a ball, or (start, end, radius, strength) along a line. With the share s of the
    radius that a point is away from it, it adds strength (1 - s^2)^2 where s < 1."""

    parts = _Given[Any]()
    threshold = _Given[float]()

    def __init__(
        self,
        parts: Sequence[Any],
        threshold: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        try:
            full = [part if len(part) == 4 else (part[0], *part) for part in parts]
            rows = [[*start, *end, radius, strength] for start, end, radius, strength in full]
            table = np.array(rows, np.float64).reshape(len(rows), 8)
        except (TypeError, ValueError, IndexError):
            raise _arguments.refusal(
                "Blob: parts", "a list of (center, radius, strength)", parts
            ) from None
        level = _arguments.number(threshold, "Blob: threshold")
        shown = {"parts": f"<{len(rows)}>", "threshold": level}
        address = table.ctypes.data
        self._create("crt_blob_create", material, id, shown, address, len(rows), level)


class Superellipsoid(_Primitive):
    """A Superellipsoid is all points at which (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1. e is
    `east_west` and n is `north_south`, both from 0.01 to 10. It reaches from -1 to 1."""

    east_west = _Given[float]()
    north_south = _Given[float]()

    def __init__(
        self,
        east_west: SupportsFloat,
        north_south: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, east_west=east_west, north_south=north_south)


class Torus(_Primitive):
    """A Torus is all points within `thickness` of the circle of `radius` about `center` across
    `axis`."""

    center = _Given[Vector]()
    axis = _Given[Vector]()
    radius = _Given[float]()
    thickness = _Given[float]()

    def __init__(
        self,
        center: Point,
        axis: Point,
        radius: SupportsFloat,
        thickness: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, center=center, axis=axis, radius=radius, thickness=thickness)


class Ellipsoid(_Primitive):
    """An Ellipsoid is a ball about `center` that is scaled to `radii` along x, y and z."""

    center = _Given[Vector]()
    radii = _Given[Vector]()

    def __init__(
        self,
        center: Point,
        radii: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, center=center, radii=radii)


class ShapedExtrusion(_Primitive):
    """A ShapedExtrusion is a profile, as crt.Extrusion has it, that is drawn out along z from 0 to
    the height. Its upper end is turned by `twist` degrees from x towards y, and `taper` times as
    large. Edges at both ends are cut off by `bevel`, or rounded with the radius `rounding`."""

    profile = _Given[Any]()
    height = _Given[float]()
    twist = _Given[float]()
    taper = _Given[float]()
    bevel = _Given[float]()
    rounding = _Given[float]()

    def __init__(
        self,
        profile: Sequence[Any],
        height: SupportsFloat,
        *,
        twist: SupportsFloat = 0,
        taper: SupportsFloat = 1,
        bevel: SupportsFloat = 0,
        rounding: SupportsFloat = 0,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        contours = profiles.read_contours("ShapedExtrusion", profile)
        given = {
            "height": height,
            "twist": twist,
            "taper": taper,
            "bevel": bevel,
            "rounding": rounding,
        }
        numbers = {
            name: _arguments.number(value, f"ShapedExtrusion: {name}")
            for name, value in given.items()
        }
        shown: dict[str, Any] = {"profile": contours, **numbers}
        numbers["twist"] = math.radians(numbers["twist"])
        handle = profiles.profile_of(contours)
        self._create(
            "crt_shaped_extrusion_create", material, id, shown, handle, *numbers.values()
        )


class Thread(_Primitive):
    """A Thread is the solid of a screw thread from the start to the end, with the profile of ISO
    68-1. M8 has a diameter of 8 and a pitch of 1.25. `left` turns the other way."""

    start = _Given[Vector]()
    end = _Given[Vector]()
    diameter = _Given[float]()
    pitch = _Given[float]()
    left = _Given[bool]()

    def __init__(
        self,
        start: Point,
        end: Point,
        diameter: SupportsFloat,
        pitch: SupportsFloat,
        left: bool = False,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        a, b = self._vectors(start=start, end=end)
        across = self._positive(diameter, "diameter")
        turn = self._positive(pitch, "pitch")
        shown = {
            "start": tuple(a),
            "end": tuple(b),
            "diameter": across,
            "pitch": turn,
            "left": bool(left),
        }
        self._create("crt_thread_create", material, id, shown, a, b, across, turn, bool(left))


class Helix(_Primitive):
    """A Helix is a round wire that winds about a line from the start to the end, where it is cut
    flat. `radius` leads from the line to the middle of the wire, and `thickness` is the wire's
    radius. `left` winds the other way than a common screw."""

    start = _Given[Vector]()
    end = _Given[Vector]()
    radius = _Given[float]()
    thickness = _Given[float]()
    pitch = _Given[float]()
    left = _Given[bool]()

    def __init__(
        self,
        start: Point,
        end: Point,
        radius: SupportsFloat,
        thickness: SupportsFloat,
        pitch: SupportsFloat,
        left: bool = False,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        a, b = self._vectors(start=start, end=end)
        given = {"radius": radius, "thickness": thickness, "pitch": pitch}
        numbers = {name: self._positive(value, name) for name, value in given.items()}
        shown: dict[str, Any] = {"start": tuple(a), "end": tuple(b), **numbers}
        shown["left"] = bool(left)
        self._create("crt_helix_create", material, id, shown, a, b, *numbers.values(), bool(left))


class Polyhedron(_Primitive):
    """A Polyhedron is the solid that flat faces enclose. Each is a sequence of corners, which are
    places in `points` from 0, in order around it, either way. It need not be convex."""

    points = _Given[Any]()
    faces = _Given[Any]()

    def __init__(
        self,
        points: ArrayLike,
        faces: Sequence[Sequence[SupportsIndex]],
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        places = _points("Polyhedron", points, "points")
        try:
            given = [[operator.index(corner) for corner in face] for face in faces]
            corners = np.array([corner for face in given for corner in face], np.uint32)
            sizes = np.array([len(face) for face in given], np.uint32)
        except (TypeError, ValueError, OverflowError):
            raise _arguments.refusal(
                "Polyhedron: faces", "sequences of places in points", faces
            ) from None
        shown = {"points": [tuple(point) for point in places.tolist()], "faces": given}
        self._create(
            "crt_polyhedron_create",
            material,
            id,
            shown,
            places.ctypes.data,
            len(places),
            corners.ctypes.data,
            sizes.ctypes.data,
            len(sizes),
        )


class Hull(_Primitive):
    """A Hull is the smallest convex solid that holds points, at least four that are not in one
    plane."""

    points = _Given[Any]()

    def __init__(
        self,
        points: ArrayLike,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        places = _points("Hull", points, "points")
        shown = {"points": [tuple(point) for point in places.tolist()]}
        self._create("crt_hull_create", material, id, shown, places.ctypes.data, len(places))


class Disc(_Primitive):
    """A Disc is a surface: flat and round, across `normal`."""

    center = _Given[Vector]()
    normal = _Given[Vector]()
    radius = _Given[float]()

    def __init__(
        self,
        center: Point,
        normal: Point,
        radius: SupportsFloat,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, center=center, normal=normal, radius=radius)


class Triangle(_Primitive):
    """A Triangle is a surface. Its normal is along (b - a) x (c - a)."""

    a = _Given[Vector]()
    b = _Given[Vector]()
    c = _Given[Vector]()

    def __init__(
        self,
        a: Point,
        b: Point,
        c: Point,
        *,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        self._make(material, id, a=a, b=b, c=c)
