"""This module measures the volumes of CRT's booleans by rays."""

from dataclasses import dataclass

import numpy as np
from booleans import Boolean, Grid
from numpy.random import Generator
from numpy.typing import NDArray
from solids import Mesh

import crt

JOIN = {
    "union": lambda a, b: crt.union((a, b)),
    "difference": lambda a, b: crt.difference(a, (b,)),
    "intersection": lambda a, b: crt.intersection((a, b)),
}
SIDES = (32, 64, 128, 256)  # rays along a side of a grid, as many as the error asks for
SHIFTS = 4  # random places of the grid, for each of three axes
GOAL = 1e-4  # the standard error, of the volume


@dataclass(frozen=True)
class Estimate:
    """An Estimate is the mean of several that are independent."""

    mean: float
    error: float  # the standard error of the mean

    @staticmethod
    def of(values: list[float]) -> "Estimate":
        spread = float(np.std(values, ddof=1))
        return Estimate(float(np.mean(values)), spread / len(values) ** 0.5)


@dataclass(frozen=True)
class Volumes:
    """Volumes are measured by the same rays, that of a boolean and how much more it is than that
    of a mesh."""

    whole: Estimate
    excess: Estimate
    rays: int


def solids(meshes: list[Mesh]) -> list[crt.Entity]:
    return [crt.Mesh(mesh.positions, mesh.indices) for mesh in meshes]


def prepared(parts: list[crt.Entity], operations: list[str]) -> crt.Prepared:
    """Returns a scene of what is left of the solids."""
    whole = parts[0]
    for name, part in zip(operations, parts[1:]):
        whole = JOIN[name](whole, part)
    return crt.Scene([whole]).prepare()


def by_cells(scene: crt.Prepared, grid: Grid) -> list[float]:
    """Returns the volume as measured along each axis, by one ray through the middle of each row of
    cells. It is exact but for rounding."""
    middles = [(line[1:] + line[:-1]) / 2 for line in grid.lines]
    widths = [np.diff(line) for line in grid.lines]
    volumes = []
    for axis in range(3):
        i, j = (other for other in range(3) if other != axis)
        rays = crt.rays((len(middles[i]), len(middles[j])))
        rays["origin"][..., i] = middles[i][:, None]
        rays["origin"][..., j] = middles[j][None, :]
        rays["origin"][..., axis] = grid.lines[axis][0] - 1
        rays["direction"][..., axis] = 1
        lengths = scene.inside_lengths(rays)
        volumes.append(float(np.einsum("ij,i,j->", lengths, widths[i], widths[j])))
    return volumes


def by_rays(scene: crt.Prepared, boolean: Boolean, other: Mesh, random: Generator) -> Volumes:
    """Returns the volume of a boolean, and how much more it is than that of the other mesh.

    Rays run along each axis of the frame, on grids at random places. So each grid's sum is right in
    the mean, and their spread shows the error."""
    low, high = _bounds(boolean, other)
    rival = prepared(solids([other]), []) if len(other.indices) else None
    rays_asked = 0
    for side in SIDES:
        wholes, excesses = [], []
        for axis in np.repeat(range(3), SHIFTS):
            rays, area = _grid(boolean.frame, low, high, axis, side, random)
            lengths = scene.inside_lengths(rays)
            others = rival.inside_lengths(rays) if rival else np.zeros(len(rays))
            wholes.append(area * float(lengths.mean()))
            excesses.append(area * float((lengths - others).mean()))
            rays_asked += len(rays)
        whole = Estimate.of(wholes)
        if whole.error <= GOAL * whole.mean:
            break
    return Volumes(whole, Estimate.of(excesses), rays_asked)


def _bounds(boolean: Boolean, other: Mesh) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Returns the low and the high corner of a box, in the frame, around the boolean and the other
    mesh."""
    ends = [_ends(mesh, boolean.frame) for mesh in boolean.meshes]
    low, high = ends[0]
    for name, (begin, end) in zip(boolean.operations, ends[1:]):
        if name == "union":
            low, high = np.minimum(low, begin), np.maximum(high, end)
        elif name == "intersection" and (np.maximum(low, begin) < np.minimum(high, end)).all():
            low, high = np.maximum(low, begin), np.minimum(high, end)
    if len(other.indices):
        begin, end = _ends(other, boolean.frame)
        low, high = np.minimum(low, begin), np.maximum(high, end)
    return low, high


def _ends(
    mesh: Mesh, frame: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    places = mesh.positions @ frame.T
    return places.min(axis=0), places.max(axis=0)


def _grid(
    frame: NDArray[np.float64],
    low: NDArray[np.float64],
    high: NDArray[np.float64],
    axis: int,
    side: int,
    random: Generator,
) -> tuple[NDArray[np.void], float]:
    """Returns the rays of a grid along an axis of the frame, and the area that they stand for."""
    places = np.empty((side, side, 3))
    i, j = (other for other in range(3) if other != axis)
    steps = (np.arange(side) + random.random((2, 1))) / side
    places[..., i] = low[i] + (high[i] - low[i]) * steps[0][:, None]
    places[..., j] = low[j] + (high[j] - low[j]) * steps[1][None, :]
    places[..., axis] = low[axis] - 0.1 * (high[axis] - low[axis])
    rays = crt.rays(places.reshape(-1, 3) @ frame, frame[axis])
    return rays, float((high[i] - low[i]) * (high[j] - low[j]))
