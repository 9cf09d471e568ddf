"""Boxes around entities, so that a picture of an entity alone can frame it.

The library has no such question. So what is made in Python keeps a box, which holds the entity but
may be larger. It is a low and a high corner, which may be infinite, or None where it is unknown (an
entity of a script). It is computed for every entity, so this is plain Python, which is faster here
than NumPy.
"""

import math
from collections.abc import Iterable, Sequence

Corner = Sequence[float]
Box = tuple[tuple[float, ...], tuple[float, ...]]

EVERYWHERE: Box = (-math.inf,) * 3, (math.inf,) * 3
NOWHERE: Box = (math.inf,) * 3, (-math.inf,) * 3


def around(center: Corner, reach: Corner) -> Box:
    """Returns the box that reaches so far from its centre in each direction."""
    x, y, z = center
    a, b, c = reach
    return (x - a, y - b, z - c), (x + a, y + b, z + c)


def of_ball(center: Corner, radius: float) -> Box:
    """Returns the box around a ball."""
    return around(center, (radius, radius, radius))


def of_points(*points: Corner) -> Box:
    """Returns the box around points."""
    return tuple(map(min, *points)), tuple(map(max, *points))


def of_disc(center: Corner, normal: Corner, radius: float, margin: float = 0) -> Box:
    """Returns the box around a disc across `normal`, and as far beyond."""
    length = math.hypot(*normal)
    if not 0 < length < math.inf:
        return NOWHERE  # the library refuses it
    reach = [radius * math.sqrt(max(0, 1 - (part / length) ** 2)) + margin for part in normal]
    return around(center, reach)


def of_round(start: Corner, end: Corner, radius: float, radius2: float) -> Box:
    """Returns the box around a cylinder or a cone."""
    axis = [b - a for a, b in zip(start, end)]
    first, second = of_disc(start, axis, radius), of_disc(end, axis, radius2)
    return of_points(*first, *second)


def united(boxes: Iterable[Box | None]) -> Box | None:
    """Returns the box around several."""
    low, high = NOWHERE
    for box in boxes:
        if box is None:
            return None
        low, high = tuple(map(min, low, box[0])), tuple(map(max, high, box[1]))
    return low, high


def common(boxes: Iterable[Box | None]) -> Box | None:
    """Returns what several boxes share, of which any may be unknown."""
    known = [box for box in boxes if box is not None]
    if not known:
        return None
    low, high = EVERYWHERE
    for box in known:
        low, high = tuple(map(max, low, box[0])), tuple(map(min, high, box[1]))
    return NOWHERE if any(a > b for a, b in zip(low, high)) else (low, high)


def transformed(box: Box | None, rows: Sequence[Sequence[float]]) -> Box | None:
    """Returns the box around a box that is moved by the rows of a 3 x 4 matrix."""
    if box is None or box == NOWHERE:
        return box
    if not all(map(math.isfinite, (*box[0], *box[1]))):
        return EVERYWHERE
    center = [(a + b) / 2 for a, b in zip(*box)]
    half = [(b - a) / 2 for a, b in zip(*box)]
    moved = [sum(m * c for m, c in zip(row, center)) + row[3] for row in rows]
    reach = [sum(abs(m) * h for m, h in zip(row, half)) for row in rows]
    return around(moved, reach)
