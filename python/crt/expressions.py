"""This module writes Python values in the CRT language, for variables that are set from outside of
a script."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Expression:
    """An Expression is text in the CRT language: crt.Expression("rgb(1, 0.5, 0)")."""

    text: str


def to_expression(value: Any) -> str:
    """Writes Booleans, numbers and strings as they are, a tuple of three as a Vec3, any other
    sequence as a List."""
    if isinstance(value, Expression):
        return value.text
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        if not math.isfinite(value):
            raise ValueError(f"{value} is no number for a script")
        return repr(float(value))
    if isinstance(value, str):
        return _quoted(value)
    if isinstance(value, tuple) and len(value) == 3:
        return f"vec3({', '.join(map(to_expression, value))})"
    if isinstance(value, (tuple, list, np.ndarray)):
        return f"[{', '.join(map(to_expression, value))}]"
    raise TypeError(
        f"a {type(value).__name__} has no counterpart in scripts; crt.Expression takes any text"
    )


def to_expressions(values: Mapping[str, Any]) -> tuple[list[str], list[str]]:
    """Returns the names, and their values as expressions."""
    return list(values), [to_expression(value) for value in values.values()]


def _quoted(text: str) -> str:
    escapes = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t"}
    return '"' + "".join(escapes.get(c, c if c >= " " else f"\\u{ord(c):04x}") for c in text) + '"'
