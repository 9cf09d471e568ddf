"""This module makes random booleans of meshes, the same ones for the same seed."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from solids import (
    Mesh,
    as_floats,
    ball,
    box,
    needle,
    torus,
    turn,
    voxel_body,
    without_edge_contacts,
)

OPERATIONS = ("union", "difference", "intersection")
LONGEST_CHAIN = 8


@dataclass(frozen=True)
class Grid:
    """A Grid has the answer for solids made of its cells."""

    lines: list[NDArray[np.float64]]
    cells: NDArray[np.bool_]  # which of them are in the result

    @property
    def volume(self) -> float:
        """Returns the volume of the result, by counting."""
        x, y, z = (np.diff(line) for line in self.lines)
        return float(np.einsum("ijk,i,j,k->", self.cells, x, y, z))


@dataclass(frozen=True)
class Boolean:
    """A Boolean joins meshes from left to right. `frame` has three axes to look along."""

    family: str
    meshes: list[Mesh]
    operations: list[str]
    frame: NDArray[np.float64]
    grid: Grid | None = None  # for voxel bodies along the axes


def placed_ball(random: Generator) -> Mesh:
    """Returns a ball, or what is made of it by other sizes along the axes."""
    sizes = np.diag(random.uniform(0.5, 1.2, 3))
    return ball(int(random.integers(2, 5))).placed(turn(random) @ sizes, random.normal(0, 0.4, 3))


def placed_torus(random: Generator) -> Mesh:
    around, across = random.integers(16, 65), random.integers(8, 33)
    ring = torus(random.uniform(0.1, 0.5), int(around), int(across))
    return ring.placed(turn(random) * random.uniform(0.6, 1.2), random.normal(0, 0.4, 3))


def placed_needle(random: Generator) -> Mesh:
    return _needle(random, _needle_sizes(random), turn(random))


def _needle_sizes(random: Generator) -> NDArray[np.float64]:
    """Returns half of a needle's sizes. It is 50 to 5000 times as long as wide."""
    return np.array([1, 1, 10 ** random.uniform(1.7, 3.7)]) * 10 ** random.uniform(-3, -2)


def _needle(random: Generator, sizes: NDArray[np.float64], rotation: NDArray[np.float64]) -> Mesh:
    """Returns a needle that passes near the origin."""
    shift = random.normal(0, 0.5 * sizes[0], 3)
    return needle(int(random.integers(3, 13))).placed(rotation * sizes, shift)


def placed_voxel_body(random: Generator) -> Mesh:
    body = voxel_body(random_cells(random, (4, 4, 4)), [np.linspace(-0.8, 0.8, 5)] * 3)
    return body.placed(turn(random), random.normal(0, 0.3, 3))


def random_cells(
    random: Generator, shape: tuple[int, ...], with_contacts: bool = False
) -> NDArray[np.bool_]:
    """Returns some of a grid's cells: a heap of boxes with holes, or each by chance. They touch
    along edges alone only if `with_contacts` says so, and at corners anyway."""
    if random.random() < 0.3:
        cells = random.random(shape) < random.uniform(0.2, 0.8)
    else:
        cells = np.zeros(shape, np.bool_)
        for _ in range(random.integers(2, 8)):
            cells[_random_range(random, shape)] = random.random() < 0.75
    if not cells.any():
        cells.flat[random.integers(cells.size)] = True
    return cells if with_contacts else without_edge_contacts(cells)


def _random_range(random: Generator, shape: tuple[int, ...]) -> tuple[slice, ...]:
    ends = [np.sort(random.choice(count + 1, 2, replace=False)) for count in shape]
    return tuple(slice(int(low), int(high)) for low, high in ends)


def chain(random: Generator, longest: int) -> list[str]:
    count = int(random.integers(2, longest)) if longest > 2 else 1
    return [str(name) for name in random.choice(OPERATIONS, count, p=[0.4, 0.4, 0.2])]


def balls(random: Generator) -> Boolean:
    meshes = [placed_ball(random) for _ in range(2)]
    return Boolean("balls", meshes, [str(random.choice(OPERATIONS))], turn(random))


def tori(random: Generator) -> Boolean:
    meshes = [placed_torus(random) for _ in range(2)]
    return Boolean("tori", meshes, [str(random.choice(OPERATIONS))], turn(random))


def copies(random: Generator) -> Boolean:
    """Returns a boolean of a solid and its copy, 10^-6.5 to 10^-2 away, that nearly coincide."""
    solid = (placed_ball, placed_torus, placed_voxel_body)[random.integers(3)](random)
    aside = random.normal(size=3)
    aside *= 10 ** random.uniform(-6.5, -2) / np.linalg.norm(aside)
    meshes = [solid, solid.placed(np.eye(3), aside)]
    return Boolean("near copies", meshes, [str(random.choice(OPERATIONS))], turn(random))


def needles(random: Generator) -> Boolean:
    """Returns a boolean of a needle and a ball, or of a bundle of needles, which cross one another
    at small angles. One axis of the frame is along the first needle."""
    sizes, rotation = _needle_sizes(random), turn(random)
    first = _needle(random, sizes, rotation)
    if random.random() < 0.5:
        others = [placed_ball(random)]
        operations = [str(random.choice(OPERATIONS[1:]))]  # what is left is all of the needle
    else:
        others = []
        for _ in range(random.integers(1, 4)):
            tilted = rotation.copy()
            tilted[:, 2] += rotation[:, :2] @ random.normal(0, 2 * sizes[0] / sizes[2], 2)
            others.append(_needle(random, sizes * [1, 1, random.uniform(0.5, 2)], tilted))
        operations = [str(name) for name in random.choice(OPERATIONS, len(others))]
    return Boolean("needles", [first, *others], operations, np.roll(rotation.T, 1, axis=0))


def voxels(random: Generator, with_contacts: bool = False) -> Boolean:
    """Returns a boolean of solids made of the cells of one grid, so that their facets coincide.
    Half of them are chains."""
    shape = _random_shape(random)
    if random.random() < 0.5:
        lines = [np.arange(count + 1.0) for count in shape]
    else:
        lines = [np.sort(as_floats(random.uniform(0, 8, count + 1))) for count in shape]
    operations = chain(random, LONGEST_CHAIN if random.random() < 0.5 else 2)
    result, meshes = np.zeros(shape, np.bool_), []
    for name in ["union", *operations]:
        if random.random() < 0.3:  # facets coincide, but not their triangles
            place = _random_range(random, shape)
            cells = np.zeros(shape, np.bool_)
            cells[place] = True
            ends = [(line[s.start], line[s.stop]) for line, s in zip(lines, place)]
            meshes.append(box(ends))
        else:
            cells = random_cells(random, shape, with_contacts)
            meshes.append(voxel_body(cells, lines))
        result = {"union": result | cells, "difference": result & ~cells}.get(name, result & cells)
    family = "voxels, touching" if with_contacts else "voxels"
    return Boolean(family, meshes, operations, turn(random), Grid(lines, result))


def voxels_touching(random: Generator) -> Boolean:
    return voxels(random, with_contacts=True)


def voxels_turned(random: Generator) -> Boolean:
    """Returns a boolean of two solids made of cells, turned. Where facets of both coincide, so do
    the corners of their triangles, bit for bit. Other triangles of a side are not quite flat."""
    shape, rotation, shift = _random_shape(random), turn(random), random.normal(size=3)
    lines = [np.arange(count + 1.0) for count in shape]
    meshes = [
        voxel_body(random_cells(random, shape), lines).placed(rotation, shift) for _ in range(2)
    ]
    return Boolean("voxels, turned", meshes, [str(random.choice(OPERATIONS))], turn(random))


def _random_shape(random: Generator) -> tuple[int, ...]:
    return tuple(int(count) for count in random.integers(3, 9, 3))


def chains(random: Generator) -> Boolean:
    """Returns a chain of solids of all kinds."""
    makers = (placed_ball, placed_torus, placed_needle, placed_voxel_body)
    operations = chain(random, LONGEST_CHAIN)
    kinds = random.choice(len(makers), len(operations) + 1, p=[0.35, 0.25, 0.1, 0.3])
    return Boolean("chains", [makers[kind](random) for kind in kinds], operations, turn(random))


FAMILIES: dict[Callable[[Generator], Boolean], int] = {
    balls: 40,
    tori: 20,
    needles: 20,
    copies: 20,
    voxels: 40,
    voxels_touching: 20,
    voxels_turned: 20,
    chains: 20,
}


def random_booleans(seed: int) -> list[Boolean]:
    """Returns as many booleans of each family as FAMILIES says."""
    made = []
    for place, (maker, count) in enumerate(FAMILIES.items()):
        random = np.random.default_rng([seed, place])
        made += [maker(random) for _ in range(count)]
    return made
