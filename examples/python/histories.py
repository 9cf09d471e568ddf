"""Follows neutral particles through nested cells in a room whose walls reflect, and counts how much
of their way is in each. In such a room that share is the share of the volume. No particle is lost:
each ray begins on the surface where the one before has ended, by the start of its hit.

    histories.py [HOW_MANY [SEED]]
"""

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import crt

NAMES = ["air", "tank", "water", "fuel"]
"""are the cells, from the outermost to the innermost: a point is in the innermost one around it"""
AIR = 0
MEAN_FREE_PATH = 0.4
COLLISIONS = 10
TOGETHER = 100_000


def cells() -> crt.Scene:
    """Makes the room, and a tank with water and fuel in it."""
    return crt.Scene(
        [
            crt.Box((-1, -1, -1), (1, 1, 1)),
            crt.Cylinder((0, -0.8, 0), (0, 0.8, 0), 0.7),
            crt.Cylinder((0, -0.7, 0), (0, 0.7, 0), 0.6),
            crt.Sphere((0.1, 0, 0), 0.4),
        ]
    )


def true_shares() -> NDArray[np.float64]:
    """Returns the share of the volume that each cell has."""
    within = np.array([8, np.pi * 0.49 * 1.6, np.pi * 0.36 * 1.4, np.pi * 4 / 3 * 0.064, 0])
    return -np.diff(within) / 8


def follow(prepared: crt.Prepared, count: int, random: Any) -> tuple[NDArray[np.float64], int, int]:
    """Follows so many particles until all have ended. Returns how far they flew in each cell, how
    many were lost, and how many steps they made."""
    paths, lost, steps = np.zeros(len(NAMES)), 0, 0
    rays = crt.rays(random.uniform(-1, 1, (count, 3)), _directions(count, random))
    rays["t_max"] = random.exponential(MEAN_FREE_PATH, count)
    cell = prepared.locate(rays["origin"])["entity_id"]
    starts = np.zeros(count, crt.START)
    collisions = np.zeros(count, np.int64)
    while len(rays) > 0:
        hits = prepared.trace(rays, starts)
        way = np.minimum(hits["t"], rays["t_max"])
        paths += np.bincount(cell, way, len(NAMES))
        steps += len(rays)
        rays["t_max"] -= way
        starts = hits["start"].copy()  # zeros where nothing was hit

        met = hits["t"] < np.inf
        rays["origin"][met] = hits["position"][met]
        wall = met & (hits["entity_id"] == AIR)
        normal = hits["normal"][wall]
        along = np.sum(rays["direction"][wall] * normal, axis=1, keepdims=True)
        rays["direction"][wall] -= 2 * along * normal
        through = met & ~wall
        entity, is_entering = hits["entity_id"][through], hits["flags"][through] & crt.ENTERING
        cell[through] = np.where(is_entering, entity, entity - 1)

        scattered = ~met
        number = int(scattered.sum())
        rays["origin"][scattered] += way[scattered, None] * rays["direction"][scattered]
        rays["direction"][scattered] = _directions(number, random)
        rays["t_max"][scattered] = random.exponential(MEAN_FREE_PATH, number)
        collisions[scattered] += 1
        astray = np.zeros(len(rays), np.bool_)
        found = prepared.locate(rays["origin"][scattered])["entity_id"]
        astray[scattered] = found != cell[scattered]
        lost += int(astray.sum())
        kept = (collisions < COLLISIONS) & ~astray
        rays, cell, starts, collisions = rays[kept], cell[kept], starts[kept], collisions[kept]
    return paths, lost, steps


def _directions(count: int, random: Any) -> NDArray[np.float64]:
    """Returns directions that are spread evenly over the sphere."""
    vectors: NDArray[np.float64] = random.normal(size=(count, 3))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


def main(count: int = 1_000_000, seed: int = 1) -> int:
    """Prints the shares. Returns how many particles were lost."""
    random = np.random.default_rng(seed)
    prepared = cells().prepare()
    paths, lost, steps = np.zeros(len(NAMES)), 0, 0
    for done in range(0, count, TOGETHER):
        of_some = follow(prepared, min(TOGETHER, count - done), random)
        paths, lost, steps = paths + of_some[0], lost + of_some[1], steps + of_some[2]
    for name, path, share in zip(NAMES, paths / paths.sum(), true_shares()):
        print(f"{name}: {path:.4f} of all paths, {share:.4f} of the volume")
    print(f"{count} histories, {steps} steps, {lost} lost")
    return lost


if __name__ == "__main__":
    sys.exit(1 if main(*map(int, sys.argv[1:])) else 0)
