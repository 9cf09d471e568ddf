"""This module has OpenSCAD make meshes of the solids that trees.py describes."""

import math
import pathlib
import subprocess
import tempfile
from collections.abc import Sequence

import numpy as np
from trees import Part, Tree

OPERATIONS = {"+": "union", "-": "difference", "^": "intersection"}


def segments(radius: float, deviation: float) -> int:
    """Returns how many sides a polygon takes whose corners are on a circle."""
    if deviation >= radius:
        return 3
    return max(3, math.ceil(math.pi / math.acos(1 - deviation / radius)))


def _numbers(values: Sequence[float]) -> str:
    return "[" + ", ".join(f"{value:.17g}" for value in values) + "]"


def _placed(origin: np.ndarray, axis: np.ndarray) -> str:
    """Returns what moves a solid about z from the origin along an axis."""
    z = axis / np.linalg.norm(axis)
    x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x /= np.linalg.norm(x)
    rows = np.column_stack([x, np.cross(z, x), z, origin])
    return "multmatrix([" + ", ".join(_numbers(row) for row in rows) + ", [0, 0, 0, 1]]) "


def _part(part: Part, deviation: float) -> str:
    radius = part.size
    if part.kind == "box":
        return f"translate({_numbers(part.at)}) cube({radius:.17g});"
    if part.kind == "sphere":
        sides = segments(radius, deviation)
        return f"translate({_numbers(part.at)}) sphere(r={radius:.17g}, $fn={sides});"
    place = _placed(part.at, part.axis)
    if part.kind == "cylinder":
        sides = segments(0.5 * radius, deviation)
        return place + f"cylinder(h={2 * radius:.17g}, r={0.5 * radius:.17g}, $fn={sides});"
    if part.kind == "cone":
        radii = f"r1={radius:.17g}, r2={0.25 * radius:.17g}"
        return place + f"cylinder(h={radius:.17g}, {radii}, $fn={segments(radius, deviation)});"
    around, across = segments(1.25 * radius, deviation), segments(0.25 * radius, deviation)
    ring = f"translate([{radius:.17g}, 0]) circle(r={0.25 * radius:.17g}, $fn={across});"
    return place + f"rotate_extrude($fn={around}) {ring}"


def script(tree: Tree, deviation: float) -> str:
    """Returns a solid in OpenSCAD's language, each of whose parts is as near as the deviation."""
    if isinstance(tree, Part):
        return _part(tree, deviation)
    operation, a, b = tree
    return f"{OPERATIONS[operation]}() {{ {script(a, deviation)} {script(b, deviation)} }}"


def triangles(tree: Tree, deviation: float, seconds: float) -> int | None:
    """Returns of how many triangles OpenSCAD's mesh is, or None if that took too long."""
    with tempfile.TemporaryDirectory() as folder:
        source, made = pathlib.Path(folder, "solid.scad"), pathlib.Path(folder, "solid.stl")
        source.write_text(script(tree, deviation) + "\n")
        command = ["openscad", "--quiet", "-o", str(made), str(source)]
        try:
            subprocess.run(command, timeout=seconds, capture_output=True, check=False)
        except subprocess.TimeoutExpired:
            return None
        return made.read_text().count("endfacet") if made.exists() else 0
