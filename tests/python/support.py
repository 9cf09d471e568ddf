"""Several tests use this."""

import math
import pathlib

import numpy as np

import crt

SOURCE = pathlib.Path(__file__).resolve().parents[2]
INFINITY = math.inf


def shell() -> crt.Entity:
    """Makes a ball of radius 1 about the origin, hollow from 0.5 inwards."""
    return crt.Sphere((0, 0, 0), 1) - crt.Sphere((0, 0, 0), 0.5)


def prepared_shell() -> crt.Prepared:
    return crt.Scene([shell()]).prepare()


def parallel_rays(count: int) -> np.ndarray:
    """Makes rays along z, from below the shell, side by side from x = -1.5 to 1.5."""
    rays = crt.rays(count)
    rays["origin"][:, 0] = np.linspace(-1.5, 1.5, count)
    rays["origin"][:, 2] = -5
    rays["direction"][:, 2] = 1
    return rays


def small_scene(size: int = 48, supersampling: int = 1) -> crt.Scene:
    scene = crt.Scene([shell()], [crt.Light.point(origin=(-3, 4, -5))])
    scene.camera = crt.Camera(position=(0, 0, -4))
    scene.settings = crt.Settings(width=size, height=size, supersampling=supersampling)
    return scene
