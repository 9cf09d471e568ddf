"""The second program of the tutorial for Python: it asks rays how thick a part is."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

import crt
from tutorial_scene import bracket

part = crt.Scene([bracket()]).prepare()


def walls(origin: tuple[float, float, float], direction: tuple[float, float, float]) -> list[float]:
    """Returns how long the pieces of a ray are that lie inside of the part. The ray must begin and
    end outside of it."""
    t = part.crossings(crt.ray(origin, direction))["t"]
    return [round(float(end - begin), 6) for begin, end in zip(t[::2], t[1::2])]


def heights(count: int) -> NDArray[Any]:
    """Looks down on the part from a height of 5, count x count times, and returns how high it is
    there."""
    x, z = np.meshgrid(np.linspace(-2, 2, count), np.linspace(1.5, -1.5, count))
    rays = crt.rays(np.stack((x, np.full_like(x, 5), z), axis=-1), (0, -1, 0))
    return np.maximum(5 - part.intersect(rays)["t"], 0)


if __name__ == "__main__":
    print("plate:", walls((1.9, 5, -1), (0, -1, 0)))
    print("eye:", walls((-5, 1.8, 1.35), (1, 0, 0)))
    print("hole:", walls((0.5, 5, -0.6), (0, -1, 0)))
    print("highest:", round(float(heights(201).max()), 6))
