"""A program may compute a solid by itself."""

import ctypes
import itertools
from collections.abc import Callable, Iterable, Iterator
from typing import Any, ClassVar, SupportsIndex

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arguments
from ._arguments import Point
from ._callbacks import CUSTOM_CROSSINGS, CUSTOM_POINT, RELEASE, failures
from ._materials import AnyMaterial
from ._structs import Struct, growable
from .primitives import Vector, _Given, _Primitive

__all__ = ["Custom"]

Array = NDArray[np.float64]
Crossings = Callable[[Array, Array, float, float], Iterable[Any]]

_MOST_CROSSINGS = 65536
_CROSSING = np.dtype(
    [("t", np.float64), ("error", np.float64), ("face", np.uint32), ("reserved", np.uint32)]
)


@growable("crt_custom")
class _CustomStruct(Struct):
    """A _CustomStruct is how the library gets a solid."""


class Custom(_Primitive):
    """A Custom is a solid of which the program computes what rays cross.

    `crossings(origin, direction, t_min, t_max)` returns what a ray crosses between t_min and t_max,
    which is where it is within `lower` and `upper`. It is a list of t in ascending order: where the
    ray enters, leaves, and so on. Instead of t there may be (t, face) or (t, face, error). Origin
    and direction are arrays; the direction has unit length. |t - true t| is at most the error,
    which is `error` if none is given.

    `normal(position, face)` returns the normal out of the solid, of any length but 0, or a tuple of
    it and (u, v). `faces` is how many faces there are, and messages call the solid by its `name`.

    Both functions are called from any thread, and must always give the same answer to the same
    question. What they raise comes out of the call that asked."""

    lower = _Given[Vector]()
    upper = _Given[Vector]()
    name = _Given[str | None]()

    def __init__(
        self,
        lower: Point,
        upper: Point,
        crossings: Crossings,
        normal: Callable[[Array, int], Any],
        *,
        faces: SupportsIndex = 1,
        error: float = 1e-14,
        name: str | None = None,
        material: AnyMaterial | None = None,
        id: SupportsIndex | None = None,
    ) -> None:
        for function, what in ((crossings, "crossings"), (normal, "normal")):
            if not callable(function):
                raise _arguments.refusal(f"Custom: {what}", "a function", function)
        a, b = self._vectors(lower=lower, upper=upper)
        functions = _Functions(crossings, normal, _arguments.number(error, "Custom: error"))
        struct = _CustomStruct(
            face_count=_arguments.whole(faces, "Custom: faces", ctypes.c_uint32),
            lower=tuple(a),
            upper=tuple(b),
            name=name,
        )
        for field, value in functions.fields().items():
            ctypes.Structure.__setattr__(struct, field, value)
        shown = {"lower": tuple(a), "upper": tuple(b), "name": name}
        try:
            self._create("crt_custom_create", None, None, shown, ctypes.byref(struct))
        except BaseException:
            functions.forget()
            raise
        self._dress(material, id, shown)


class _Functions:
    """Some _Functions are Python's. The library has their number until it releases them."""

    _alive: ClassVar[dict[int, "_Functions"]] = {}
    _numbers: ClassVar[Iterator[int]] = itertools.count(1)

    def __init__(
        self, crossings: Crossings, normal: Callable[[Array, int], Any], error: float
    ) -> None:
        self._crossings = crossings
        self._normal = normal
        self._error = error
        self._number = next(self._numbers)

    def fields(self) -> dict[str, Any]:
        """Returns what the library gets."""
        self._alive[self._number] = self
        return {**_CALLBACKS, "user": self._number}

    def forget(self) -> None:
        self._alive.pop(self._number, None)

    @classmethod
    def of(cls, number: int) -> "_Functions":
        return cls._alive[number]

    def find(self, ray: Array) -> NDArray[Any]:
        given = self._crossings(ray[:3], ray[3:6], float(ray[6]), float(ray[7]))
        rows = [self._crossing(one) for one in itertools.islice(given, _MOST_CROSSINGS + 1)]
        return np.array(rows, _CROSSING)

    def _crossing(self, given: Any) -> tuple[float, float, int, int]:
        if not isinstance(given, tuple):
            return float(given), self._error, 0, 0
        t, face, error = (*given, self._error)[:3]
        return float(t), float(error), int(face), 0

    def describe(self, position: Array, face: int) -> Array:
        given = self._normal(position, face)
        has_uv = isinstance(given, tuple) and len(given) == 2
        normal, uv = given if has_uv else (given, (0, 0))
        return np.concatenate([_numbers(normal, 3), _numbers(uv, 2)])


def _find(ray: int, out: int, capacity: int, count: Any, user: int) -> int:
    with failures.kept() as failure:
        found = _Functions.of(user).find(_read(ray, 8))
        fitting = found[:capacity].tobytes()
        ctypes.memmove(out, fitting, len(fitting))
        count[0] = len(found)
    return failure.number


def _describe(position: int, face: int, out: int, user: int) -> int:
    with failures.kept() as failure:
        numbers = _Functions.of(user).describe(_read(position, 3), face)
        ctypes.memmove(out, numbers.tobytes(), numbers.nbytes)
    return failure.number


def _release(user: int) -> None:
    _Functions.of(user).forget()


_CALLBACKS = {
    "crossings": CUSTOM_CROSSINGS(_find),
    "point": CUSTOM_POINT(_describe),
    "release": RELEASE(_release),
}


def _read(address: int, count: int) -> Array:
    return np.array((ctypes.c_double * count).from_address(address))


def _numbers(given: ArrayLike, count: int) -> Array:
    return np.asarray(given, np.float64).reshape(count)
