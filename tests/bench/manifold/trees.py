"""This module makes random trees of primitives, half of them on a grid where faces coincide."""

from dataclasses import dataclass
from typing import Union

import numpy as np

import crt


@dataclass(frozen=True)
class Part:
    """A Part is a primitive: a box, a sphere, a cylinder, a cone or a torus."""

    kind: str
    at: np.ndarray
    size: float
    axis: np.ndarray

    def entity(self) -> crt.Entity:
        at, size, axis = self.at, self.size, self.axis
        if self.kind == "box":
            return crt.Box(corner_a=at, corner_b=at + size)
        if self.kind == "sphere":
            return crt.Sphere(center=at, radius=size)
        if self.kind == "cylinder":
            return crt.Cylinder(at, at + 2 * size * axis, radius=0.5 * size)
        if self.kind == "cone":
            return crt.Cone(at, at + size * axis, radius=size, radius2=0.25 * size)
        return crt.Torus(center=at, axis=axis, radius=size, thickness=0.25 * size)


Tree = Union[Part, tuple[str, "Tree", "Tree"]]  # an operation, and what it joins


def entity(tree: Tree) -> crt.Entity:
    if isinstance(tree, Part):
        return tree.entity()
    operation, a, b = tree[0], entity(tree[1]), entity(tree[2])
    return a + b if operation == "+" else a - b if operation == "-" else a ^ b


class Maker:
    """A Maker makes random trees."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng(seed)

    def place(self, on_grid: bool) -> np.ndarray:
        place = self.random.uniform(-2, 2, 3)
        return np.round(2 * place) / 2 if on_grid else place

    def part(self, on_grid: bool) -> Part:
        at = self.place(on_grid)
        size = self.random.uniform(0.5, 1.5)
        if on_grid:
            size = np.ceil(2 * size) / 2
        axis = np.eye(3)[self.random.integers(3)] if on_grid else self.random.normal(size=3)
        axis /= np.linalg.norm(axis)
        kinds = ("box", "sphere", "cylinder", "cone", "torus")
        return Part(kinds[self.random.integers(5)], at, float(size), axis)

    def tree(self, depth: int, on_grid: bool) -> Tree:
        if depth == 0:
            return self.part(on_grid)
        a = self.tree(depth - 1, on_grid)
        b = self.tree(int(self.random.integers(depth)), on_grid)
        return ("+-^"[self.random.integers(3)], a, b)


def random_tree(seed: int, number: int) -> Tree:
    maker = Maker(seed * 1_000_003 + number)
    return maker.tree(int(maker.random.integers(4)), on_grid=number % 2 == 0)
