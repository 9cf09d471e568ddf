#!/usr/bin/env python3
"""Writes knot.off beside itself: a trefoil knot of a six-sided bar, in flat four-sided faces."""

import math
import pathlib

PLACES = 72  # along the knot
SIDES = 6
THICKNESS = 0.34


def curve(turn: float) -> tuple[float, float, float]:
    """Returns the point of the knot's middle line at an angle."""
    ring = 1 + 0.48 * math.cos(3 * turn)
    return ring * math.cos(2 * turn), 0.48 * math.sin(3 * turn), ring * math.sin(2 * turn)


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def corner(place: int, side: int) -> list[float]:
    """Returns a corner of the cross-section at a place. The bar turns as it goes around."""
    turn = 2 * math.pi * place / PLACES
    middle = curve(turn)
    along = unit(minus(curve(turn + 1e-3), curve(turn - 1e-3)))
    center = [math.cos(2 * turn), 0, math.sin(2 * turn)]
    across = unit(cross(along, unit(minus(middle, center))))
    other = cross(across, along)
    angle = 2 * math.pi * side / SIDES + turn
    c, s = THICKNESS * math.cos(angle), THICKNESS * math.sin(angle)
    return [m + c * a + s * o for m, a, o in zip(middle, across, other)]


def text() -> str:
    count = PLACES * SIDES
    lines = ["OFF", "# A trefoil knot, written by make_knot.py", f"{count} {count} {2 * count}"]
    for place in range(PLACES):
        for side in range(SIDES):
            lines.append(" ".join(f"{number:.4f}" for number in corner(place, side)))
    for place in range(PLACES):
        for side in range(SIDES):
            here, there = place * SIDES, (place + 1) % PLACES * SIDES
            after = (side + 1) % SIDES
            lines.append(f"4 {here + side} {there + side} {there + after} {here + after}")
    return "\n".join(lines) + "\n"


pathlib.Path(__file__).with_name("knot.off").write_text(text())
