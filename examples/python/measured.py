"""Measures a part: a script becomes numbers, pictures, a drawing, and files for a slicer.

    measured.py [FOLDER]

It prints what it finds of examples/measure/housing.crt and writes into the folder:
housing.png, housing_wall.png (cut open, with arrows at the thinnest wall), housing.svg,
housing.stl and housing.3mf. docs/measured.md shows all of them.
"""

import math
import sys
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

import crt

SCRIPT = Path(__file__).parent.parent / "measure/housing.crt"
DENSITY = 7.85e-3  # of steel, in grams per cubic millimetre: the script's unit is mm

# What turns the screw: it needs room above the foot, beside the hub.
DRIVER = crt.Cylinder((42.2, 18, 14), (42.2, 120, 14), 9.5)

RED = crt.PrincipledMaterial(color=(0.75, 0.07, 0.03), roughness=0.5)
YELLOW = crt.PrincipledMaterial(color=(0.95, 0.7, 0.05), roughness=0.4)


class Measured(NamedTuple):
    """A Measured is what there is to say of a part and of what has to fit beside it."""

    box: tuple[NDArray[np.float64], NDArray[np.float64]]
    volume: crt.Interval
    area: crt.Interval
    wall: crt.Thickness
    screw: crt.Clearance
    driver: crt.Clearance


def load(**variables: float) -> crt.Scene:
    """Runs the script, with other values of some of its variables."""
    return crt.Scene.from_file(SCRIPT, variables=variables)


def measure(part: crt.Entity, screw: crt.Entity) -> Measured:
    return Measured(
        box=part.bounds,
        volume=part.volume(relative_width=1e-6),
        area=part.area(relative_width=1e-4),
        wall=part.least_wall(relative_width=1e-3),
        screw=part.clearance(screw),
        driver=part.clearance(DRIVER, relative_width=1e-4),
    )


def arrow(tip: NDArray[np.float64], direction: NDArray[np.float64]) -> crt.Entity:
    """Makes an arrow of 15 mm whose tip is at a point."""
    neck, tail = tip - 5 * direction, tip - 15 * direction
    return (crt.Cone(neck, tip, 1.6, 0) + crt.Capsule(neck, tail, 0.6)).with_material(YELLOW)


def cut_open(scene: crt.Scene, wall: crt.Thickness) -> crt.Scene:
    """Makes the scene of the part without its right half, with arrows at the thinnest wall."""
    part, _, _, bench = scene.entities
    half = crt.Box((wall.start[0], -1, -1), (60, 90, 40), material=RED)
    across = (wall.end - wall.start) / np.linalg.norm(wall.end - wall.start)
    arrows = [arrow(wall.start, across), arrow(wall.end, -across)]
    cut = scene.copy()
    cut.entities = [part - half, *arrows, bench]
    cut.camera.set(position=(130, 108, -92), pointing=(0, 40, 14), fov=0.5)
    return cut


def draw(part: crt.Entity, file: Path) -> crt.Section:
    """Draws what the plane x = 0 cuts out of the part, hatched, at a scale of 1:1."""
    section = part.section((1, 0, 0), offset=0, deviation=1e-3)
    section.write(file, unit="mm", hatch=2)
    return section


def export(part: crt.Entity, files: Iterable[Path], deviation: float = 0.05) -> crt.SurfaceMesh:
    """Writes the part's surface as triangles, for slicers."""
    surface = part.tessellate(deviation)
    for file in files:
        surface.write(file, unit="mm", color=(0.05, 0.17, 0.2), name="housing")
    return surface


def between(number: crt.Interval, decimals: int, factor: float = 1) -> str:
    """Says what holds a number, rounded away from it, so that it still does."""
    shift = 10**decimals
    lower = math.floor(factor * number.lower * shift) / shift
    upper = math.ceil(factor * number.upper * shift) / shift
    return f"between {lower:.{decimals}f} and {upper:.{decimals}f}"


def report(found: Measured, section: crt.Section, surface: crt.SurfaceMesh) -> list[str]:
    """Returns what is known of a part, each number with the interval that holds it."""
    width, height, depth = found.box[1] - found.box[0]
    return [
        f"size       {width:.2f} x {height:.2f} x {depth:.2f} mm",
        f"volume     {between(found.volume, 2)} mm3",
        f"area       {between(found.area, 1)} mm2",
        f"mass       {between(found.volume, 3, DENSITY)} g",
        f"wall       {between(found.wall.least, 4)} mm",
        f"screw      {between(found.screw.distance, 4)} mm away",
        f"driver     {between(found.driver.distance, 4)} mm away",
        f"section    {between(section.area, 4)} mm2",
        f"triangles  {len(surface.triangles)}, within {surface.deviation:.4f} mm of the surface",
    ]


def main(folder: Path) -> None:
    scene = load()
    part, screw = scene.entities[:2]
    found = measure(part, screw)
    section = draw(part, folder / "housing.svg")
    surface = export(part, [folder / "housing.stl", folder / "housing.3mf"])
    print("\n".join(report(found, section, surface)))
    scene.render().save(folder / "housing.png")
    cut_open(scene, found.wall).render().save(folder / "housing_wall.png")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
