"""Profiles are made of contours. These functions make contours of drawings, as lists of corners
(x, y, bulge), for crt.Extrusion and for what else takes a profile."""

import ctypes
import os
import warnings
from collections.abc import Sequence
from typing import Any, SupportsFloat

import numpy as np

from . import _arguments
from ._handles import Reference
from ._library import create, library
from .errors import named

__all__ = ["offset_contours", "svg_path", "text_contours"]

Contour = list[tuple[float, float, float]]


def svg_path(path: str, *, even_odd: bool = False, deviation: SupportsFloat = 0) -> list[Contour]:
    """Returns the contours of an SVG path, which is the attribute d of a path element. As SVG has y
    downward, (x, y) of the path becomes (x, -y). What is inside says SVG's nonzero rule, or the
    even-odd rule. Curves become arcs within `deviation`, or by default within a 10000th of the size
    of each curve."""
    text = _arguments.text(path, "svg_path: path")
    within = _arguments.number(deviation, "svg_path: deviation")
    handle = _new_profile()
    with named("svg_path"):
        library.crt_profile_svg_path(handle, text, len(text), int(bool(even_odd)), within)
    return contours_of(handle)


_ALIGNMENTS = ("left", "center", "right")  # as crt_text_alignment has them


def text_contours(
    text: str,
    size: SupportsFloat = 1,
    *,
    font: str | os.PathLike[str] | None = None,
    alignment: str = "left",
    line_spacing: SupportsFloat = 1,
    deviation: SupportsFloat = 0,
) -> list[Contour]:
    """Returns the contours of text. Its first line stands on y = 0, and x = 0 is where lines begin,
    have their middle or end. `size` is that of the em; capital letters are about 0.7 of it high.
    `font` is a font file, or by default Liberation Sans, which comes with the library. Letters that
    the font lacks give a warning, and are the box that it has for that."""
    if alignment not in _ALIGNMENTS:
        names = ", ".join(map(repr, _ALIGNMENTS))
        raise ValueError(f"text_contours: alignment must be one of {names}, not {alignment!r}")
    if not isinstance(text, str):
        raise _arguments.refusal("text_contours: text", "a text", text)
    content = text.encode(errors="surrogatepass")
    file = None if font is None else _arguments.text(font, "text_contours: font")
    given = {"size": size, "line_spacing": line_spacing, "deviation": deviation}
    numbers = [_arguments.number(given[name], f"text_contours: {name}") for name in given]
    handle = _new_profile()
    missing = ctypes.c_size_t()
    with named("text_contours"):
        library.crt_profile_text(
            handle, content, len(content), file, numbers[0], _ALIGNMENTS.index(alignment),
            *numbers[1:], ctypes.byref(missing)
        )
    if missing.value:
        warnings.warn(f"text_contours: the font lacks {missing.value} of the letters", stacklevel=2)
    return contours_of(handle)


def offset_contours(profile: Sequence[Any], distance: SupportsFloat) -> list[Contour]:
    """Returns the contours of a region that is larger all around by a distance, or smaller by one
    below 0, of which nothing may be left. `profile` is as crt.Extrusion takes it. Straight pieces
    move, arcs get another radius, and outer corners become arcs about them (inner ones, below
    0)."""
    handle = profile_of(read_contours("offset_contours", profile))
    with named("offset_contours"):
        library.crt_profile_offset(
            handle, _arguments.number(distance, "offset_contours: distance")
        )
    return contours_of(handle)


def _new_profile() -> Reference:
    return Reference(create("crt_profile_create"), library.crt_profile_release)


def contours_of(handle: Reference) -> list[Contour]:
    """Returns the contours that a profile of C has."""
    contours = []
    count = ctypes.c_size_t()
    library.crt_profile_contour_count(handle, ctypes.byref(count))
    for index in range(count.value):
        size = ctypes.c_size_t()
        library.crt_profile_contour(handle, index, None, 0, ctypes.byref(size))
        numbers = (ctypes.c_double * (3 * size.value))()
        library.crt_profile_contour(handle, index, numbers, size.value, ctypes.byref(size))
        corners = iter(numbers)
        contours.append(list(zip(corners, corners, corners)))
    return contours


def end_of(corner: tuple[float, ...]) -> tuple[float, ...]:
    """Returns where a corner is, which control points may come before."""
    return corner[:2] if len(corner) == 3 else corner[-2:]


def add_piece(handle: Any, corner: tuple[float, ...]) -> None:
    """Adds the piece that leads to a corner."""
    if len(corner) < 4:
        library.crt_profile_arc_to(handle, *corner, *(0.0,) * (3 - len(corner)))
        return
    with named("profile"):
        if len(corner) == 6:
            library.crt_profile_cubic_to(handle, *corner, 0.0)
        else:
            library.crt_profile_quadratic_to(handle, *corner, 0.0)


def read_contours(name: str, profile: Sequence[Any]) -> list[list[tuple[float, ...]]]:
    """Returns the contours of a profile, which may be one or a sequence of several."""
    wanted = (
        "corners (x, y), (x, y, bulge), (x1, y1, x, y) or (x1, y1, x2, y2, x, y),"
        " or a sequence of contours of such corners"
    )
    try:
        is_one = len(profile) == 0 or np.ndim(profile[0][0]) == 0
        contours = [profile] if is_one else profile
        made = [[tuple(map(float, corner)) for corner in contour] for contour in contours]
    except (TypeError, ValueError, IndexError, KeyError):
        raise _arguments.refusal(f"{name}: profile", wanted, profile) from None
    if not all(len(corner) in (2, 3, 4, 6) for contour in made for corner in contour):
        raise ValueError(f"{name}: profile must be {wanted}")
    return made


def profile_of(contours: list[list[tuple[float, ...]]]) -> Reference:
    """Makes a profile of the contours."""
    handle = _new_profile()
    for contour in contours:
        for i, corner in enumerate(contour):
            if i == 0:
                library.crt_profile_move_to(handle, *end_of(corner))
            else:
                add_piece(handle, corner)
        if contour and len(contour[0]) > 2:
            add_piece(handle, contour[0])
    return handle
