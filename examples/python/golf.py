"""Renders a golf ball on its tee: many things placed by a formula. Writes golf.png, or the file
that is named."""

import math
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import crt


def fibonacci_sphere(count: int) -> NDArray[Any]:
    """Spreads points evenly over the unit sphere: each a golden angle further round, a step further
    down."""
    index = np.arange(count)
    height = 1 - (2 * index + 1) / count
    angle = index * math.pi * (3 - math.sqrt(5))
    radius = np.sqrt(1 - height**2)
    return np.column_stack((radius * np.cos(angle), height, radius * np.sin(angle)))


white = crt.Material(color=(0.8, 0.8, 0.78), specular=0.35, shininess=60, reflectivity=0.03)
red = crt.Material(color=(0.75, 0.05, 0.03), specular=0.4, shininess=30)
grass = crt.Material(
    pattern=crt.Pattern.noise(
        color_a=(0.1, 0.32, 0.03), color_b=(0.03, 0.16, 0.01), scale=0.5, octaves=6
    )
)

dimples = [crt.Sphere(1.15 * point, 0.18) for point in fibonacci_sphere(336)]
ball = crt.difference(crt.Sphere((0, 0, 0), 1), dimples).with_material(white)
tee = (
    crt.Cone((0, -2.2, 0), (0, -0.7, 0), 0.08, 0.45) - crt.Sphere((0, 0, 0), 1.001)
).with_material(red)

scene = crt.Scene(
    entities=[ball.rotated((20, 30, 0)), tee, crt.Plane((0, 1, 0), (0, -1.9, 0), material=grass)],
    lights=[
        crt.Light.parallel(origin=(-3, 4, -2.5), color=(0.95, 0.9, 0.82), ambient=0.04),
        crt.Light.point(origin=(3, 1, -6), color=(0.2, 0.22, 0.26)),
    ],
    camera=crt.Camera(position=(0, 0.5, -7), pointing=(0, -0.35, 0), fov=math.radians(30)),
    background=crt.Background.gradient(horizon=(0.7, 0.8, 0.95), sky=(0.05, 0.2, 0.6)),
    settings=crt.Settings(
        width=400,
        height=400,
        supersampling=2,
        title="Tee",
    ),
)


if __name__ == "__main__":
    image = scene.render(progress=True)
    image.save(sys.argv[1] if len(sys.argv) > 1 else "golf.png")
