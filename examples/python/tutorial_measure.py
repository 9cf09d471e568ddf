"""The fifth program of the tutorial for Python: how much a part is, where it is, what is in it."""

import numpy as np

import crt
from tutorial_scene import bracket

DENSITY = 7.85  # of steel, in tonnes per cubic metre, where a scene unit is a metre


def report(part: crt.Entity) -> list[str]:
    """Returns what there is to say of a part, with the digits that are sure."""
    low, high = part.bounds
    mass = part.mass(relative_width=1e-4)
    center = ", ".join(f"{number.middle:.2f}" for number in mass.centroid)
    return [
        f"size: {' x '.join(f'{side:.2f}' for side in high - low)} m",
        f"mass: {DENSITY * mass.volume.middle:.2f} t, to {DENSITY * mass.volume.width:.4f}",
        f"centroid: {center}",
    ]


def share_inside(part: crt.Entity, count: int) -> float:
    """Returns the share of random points of the part's box that are in the part."""
    points = np.random.default_rng(1).uniform(*part.bounds, (count, 3))
    return float((part.contains(points) >= 0).mean())


def draw_section(part: crt.Entity, file: str) -> crt.Section:
    """Writes what a plane half-way up cuts out of a part, hatched, as SVG or DXF."""
    low, high = part.bounds
    section = part.section((0, 1, 0), offset=(low[1] + high[1]) / 2, deviation=1e-4)
    section.write(file, unit="m", hatch=0.1)
    return section


def deepest(part: crt.Entity, count: int) -> float:
    """Returns how far the deepest of some random points is below the part's surface."""
    points = np.random.default_rng(2).uniform(*part.bounds, (count, 3))
    depths = -part.distance(points).distance
    return float(depths.max())


if __name__ == "__main__":
    print("\n".join(report(bracket())))
    print("of its box it fills", round(share_inside(bracket(), 100_000), 2))
    print("it holds a ball of radius", round(deepest(bracket(), 200), 2))
