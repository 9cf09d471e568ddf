"""This module checks arguments. An error names the argument, what it must be, and what was given.

What a number may be is the library's to say. Here it is only made sure that it is one.
"""

import ctypes
import enum
import operator
import os
from collections.abc import Iterable, Sequence
from typing import Any, SupportsFloat, TypeVar

import numpy as np
from numpy.typing import NDArray

T = TypeVar("T")
Point = Sequence[SupportsFloat] | NDArray[Any]
"""is the type of three numbers that are given"""


def shown(value: Any) -> str:
    """Returns how a value is written, cut short."""
    longest = 60
    text = repr(value)
    return text if len(text) <= longest else f"{text[:longest]}..."


def written(value: Any) -> str:
    """Returns how a value is written in the representation of what has it."""
    if isinstance(value, tuple):
        return f"({', '.join(map(written, value))})"
    if isinstance(value, float):
        return f"{value:g}"
    if isinstance(value, enum.Enum):
        return repr(value.name.lower())
    if isinstance(value, str):
        return value
    brief = getattr(value, "_brief", None)
    return repr(value) if brief is None else str(brief())


def refusal(name: str, expected: str, value: Any) -> TypeError:
    """Returns the error that an argument of a wrong type is."""
    return TypeError(f"{name} must be {expected}, not {shown(value)}")


def number(value: Any, name: str, expected: str = "a number") -> float:
    if isinstance(value, (str, bytes)):
        raise refusal(name, expected, value)
    try:
        return float(value)
    except (TypeError, ValueError):
        raise refusal(name, expected, value) from None


def positive(value: Any, name: str) -> float:
    """Returns a number that the library wants to be positive, which it checks itself."""
    return number(value, name, "a positive number")


def whole(value: Any, name: str, kind: Any = ctypes.c_int32) -> int:
    """Returns a whole number that a type of C can hold."""
    try:
        given = operator.index(value)
    except TypeError:
        raise refusal(name, "a whole number", value) from None
    if kind(given).value != given:  # ctypes would cut it off
        raise OverflowError(f"{name} must be a whole number of {_range(kind)}, not {given}")
    return given


def boolean(value: Any, name: str) -> bool:
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise refusal(name, "True or False", value)


def _range(kind: Any) -> str:
    bits = 8 * ctypes.sizeof(kind)
    is_signed = kind(-1).value < 0
    return f"-2^{bits - 1} to 2^{bits - 1} - 1" if is_signed else f"0 to 2^{bits} - 1"


def numbers(value: Any, count: int, name: str, expected: str) -> list[float]:
    """Returns so many numbers."""
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable):
        raise refusal(name, expected, value)
    given = list(value)
    if len(given) != count:
        raise ValueError(f"{name} must be {expected}, not {shown(value)}")
    try:
        return [number(one, name) for one in given]
    except TypeError:
        raise refusal(name, expected, value) from None


def vector(value: Any, name: str) -> Any:
    """Returns three numbers as C has them."""
    return (ctypes.c_double * 3)(*numbers(value, 3, name, "three numbers"))


def text(value: Any, name: str) -> bytes:
    """Returns a text or a path in UTF-8."""
    try:
        given = os.fspath(value)
    except TypeError:
        raise refusal(name, "a text", value) from None
    if isinstance(given, bytes):
        given = os.fsdecode(given)
    if "\0" in given:
        raise ValueError(f"{name} must not contain the character 0")
    return os.fsencode(given)


def instance(value: Any, kind: type[T], name: str) -> T:
    """Returns what is of this class of the package."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIO" else "a"
        raise refusal(name, f"{article} {kind.__name__}", value)
    return value


def instances(values: Any, kind: type[T], name: str) -> list[T]:
    """Returns a list of them."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        plural = {"Entity": "entities"}.get(kind.__name__, f"{kind.__name__.lower()}s")
        raise refusal(name, f"a list of {plural}", values)
    return [instance(value, kind, f"{name}[{index}]") for index, value in enumerate(values)]
