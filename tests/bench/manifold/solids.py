"""This module makes closed meshes. Their coordinates fit floats, as Manifold reads floats: so both
programs compute with the same solids."""

from dataclasses import dataclass

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

# The corners of a cell's six sides, seen from outside against the clock, by which ends of the
# cell's edges along x, y and z they are. Two are for each axis, the lower side first.
SIDES = np.array(
    [
        [[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]],
        [[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]],
        [[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]],
        [[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]],
        [[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]],
        [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]],
    ]
)
HALVES = [[0, 1, 2], [0, 2, 3]]  # the triangles of a side


@dataclass(frozen=True)
class Mesh:
    """A Mesh is closed, and its triangles run against the clock, seen from outside."""

    positions: NDArray[np.float64]
    indices: NDArray[np.int64]

    def placed(self, transform: NDArray[np.float64], shift: NDArray[np.float64]) -> "Mesh":
        """Returns the mesh moved, and rounded to floats."""
        return Mesh(as_floats(self.positions @ transform.T + shift), self.indices)

    @property
    def volume(self) -> float:
        """Returns the volume by the divergence theorem."""
        a, b, c = (self.positions[self.indices[:, i]] for i in range(3))
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def as_floats(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Returns the nearest numbers that floats can be."""
    return positions.astype(np.float32).astype(np.float64)


def turn(random: Generator) -> NDArray[np.float64]:
    """Returns a random rotation."""
    matrix, upper = np.linalg.qr(random.normal(size=(3, 3)))
    matrix = matrix * np.sign(np.diag(upper))
    return matrix * np.sign(np.linalg.det(matrix))


def ball(level: int) -> Mesh:
    """Returns an icosahedron of radius 1 whose triangles were cut in four several times."""
    golden = (1 + np.sqrt(5)) / 2
    flat = [(s, t * golden) for s in (-1, 1) for t in (-1, 1)]
    points = np.array(
        [(0, a, b) for a, b in flat] + [(a, b, 0) for a, b in flat] + [(b, 0, a) for a, b in flat]
    )
    points = points / np.linalg.norm(points, axis=1, keepdims=True)
    near = points @ points.T > 0.4  # neighbours; 0.447 is the cosine between them
    triangles = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if near[i, j] and near[j, k] and near[i, k]:
                    outwards = np.linalg.det(points[[i, j, k]]) > 0
                    triangles.append((i, j, k) if outwards else (i, k, j))
    indices = np.array(triangles)
    for _ in range(level):
        points, indices = _cut_in_four(points, indices)
    return Mesh(points, indices)


def _cut_in_four(
    points: NDArray[np.float64], indices: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    edges = np.sort(indices[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
    unique, places = np.unique(edges.reshape(-1, 2), axis=0, return_inverse=True)
    middles = points[unique].sum(axis=1)
    middles /= np.linalg.norm(middles, axis=1, keepdims=True)
    a, b, c = indices.T
    ab, bc, ca = places.reshape(-1, 3).T + len(points)
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    cut = np.concatenate([np.stack(part, axis=1) for part in parts])
    return np.concatenate([points, middles]), cut


def torus(thickness: float, around: int, across: int) -> Mesh:
    """Returns a torus of quads that are cut in two. Its ring has radius 1."""
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    phi, theta = 2 * np.pi * u / around, 2 * np.pi * v / across
    ring = 1 + thickness * np.cos(theta)
    points = np.stack([ring * np.cos(phi), ring * np.sin(phi), thickness * np.sin(theta)], axis=2)

    def corner(i: int, j: int) -> NDArray[np.int64]:
        return (u + i) % around * across + (v + j) % across

    quads = np.stack([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)], axis=2)
    return Mesh(points.reshape(-1, 3), quads.reshape(-1, 4)[:, HALVES].reshape(-1, 3))


def needle(sides: int) -> Mesh:
    """Returns two pyramids of height 1 back to back, along z. Their base has radius 1."""
    angles = 2 * np.pi * np.arange(sides) / sides
    base = np.stack([np.cos(angles), np.sin(angles), np.zeros(sides)], axis=1)
    here = np.arange(sides)
    after = (here + 1) % sides
    top = np.stack([here, after, np.full(sides, sides)], axis=1)
    bottom = np.stack([after, here, np.full(sides, sides + 1)], axis=1)
    points = np.concatenate([base, [[0, 0, 1], [0, 0, -1]]])
    return Mesh(points, np.concatenate([top, bottom]))


def voxel_body(cells: NDArray[np.bool_], lines: list[NDArray[np.float64]]) -> Mesh:
    """Returns the boundary of the cells that are full: two triangles for each side between a full
    cell and an empty one. `lines` are where the grid's planes cross the three axes."""
    padded = np.pad(cells, 1)
    corners = []
    for side, ends in enumerate(SIDES):
        neighbour = np.roll(padded, -1 if side % 2 else 1, side // 2)[1:-1, 1:-1, 1:-1]
        corners.append(np.argwhere(cells & ~neighbour)[:, None, :] + ends)
    quads = np.concatenate(corners)
    places, indices = np.unique(quads.reshape(-1, 3), axis=0, return_inverse=True)
    points = np.stack([lines[axis][places[:, axis]] for axis in range(3)], axis=1)
    return Mesh(points, indices.reshape(-1, 4)[:, HALVES].reshape(-1, 3))


def without_edge_contacts(cells: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Returns the cells and as many more as it takes that no two touch along an edge alone. So no
    edge of their boundary has four triangles."""
    filled = cells.copy()
    while True:
        before = int(filled.sum())
        for axis in range(3):
            layers = np.moveaxis(filled, axis, 2)  # a view
            a, b = layers[:-1, :-1], layers[1:, :-1]
            c, d = layers[:-1, 1:], layers[1:, 1:]
            b |= a & d & ~b & ~c
            a |= b & c & ~a & ~d
        if int(filled.sum()) == before:
            return filled


def box(ends: list[tuple[float, float]]) -> Mesh:
    """Returns a box of twelve triangles between two ends along each axis."""
    return voxel_body(np.ones((1, 1, 1), np.bool_), [np.array(pair) for pair in ends])
