"""Holds a scene before it is written in either language. Both worlds are left-handed with y up."""

from dataclasses import dataclass

import numpy as np

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Checker:
    """A Checker is cubes of two colours. The offset keeps the borders off the surfaces."""

    color_a: Vector
    color_b: Vector
    scale: float
    offset: Vector = (0, 0, 0)


@dataclass(frozen=True)
class Material:
    """A highlight is the same in both programs on grey only: CRT tints it by the colour, POV-Ray
    does not."""

    color: Vector | Checker = (0.5, 0.5, 0.5)
    diffuse: float = 1
    specular: float = 0
    shininess: float = 20
    reflectivity: float = 0
    transparency: float = 0
    refractive_index: float = 1


GREY = Material()


@dataclass(frozen=True)
class Sphere:
    center: Vector
    radius: float
    material: Material = GREY


@dataclass(frozen=True)
class Box:
    low: Vector
    high: Vector
    material: Material = GREY


@dataclass(frozen=True)
class Cylinder:
    """A Cylinder is solid, between the middles of its two caps."""

    start: Vector
    end: Vector
    radius: float
    material: Material = GREY


@dataclass(frozen=True)
class Cone:
    """A Cone is solid, with a radius at either end."""

    start: Vector
    end: Vector
    start_radius: float
    end_radius: float
    material: Material = GREY


@dataclass(frozen=True)
class Plane:
    """A Plane is all that lies below a height."""

    height: float
    material: Material = GREY


@dataclass(frozen=True)
class Torus:
    """A Torus is about y, before it is turned (degrees about x, then y, then z) and moved."""

    center: Vector
    radius: float
    thickness: float
    turn: Vector = (0, 0, 0)
    material: Material = GREY


@dataclass(frozen=True)
class Spheres:
    """Spheres are many of one kind, a centre in a row, so that a million take little memory."""

    centers: np.ndarray
    radius: float
    material: Material = GREY


@dataclass(frozen=True)
class Lenses:
    """Each lens is what two spheres share, whose centres are `half_gap` along z from the lens's
    own."""

    centers: np.ndarray
    radius: float
    half_gap: float
    material: Material = GREY


@dataclass(frozen=True, eq=False)
class Mesh:
    """A Mesh is closed, with corners in single precision and triangles of their numbers."""

    positions: np.ndarray
    triangles: np.ndarray
    inside: Vector  # a direction that no facet is parallel to, for POV-Ray
    material: Material = GREY


@dataclass(frozen=True, eq=False)
class HeightField:
    """A HeightField has 16-bit heights, in rows along x from the lower z on."""

    heights: np.ndarray
    low: Vector
    high: Vector
    material: Material = GREY


@dataclass(frozen=True)
class Union:
    parts: tuple


@dataclass(frozen=True)
class Difference:
    base: object
    cutters: tuple


@dataclass(frozen=True)
class Alternating:
    """Alternating is (((base + first) - second) + third) - ..., with a level of nesting for each
    part."""

    base: object
    parts: tuple


@dataclass(frozen=True)
class Camera:
    position: Vector
    pointing: Vector
    fov: float = 45  # degrees, vertical
    orthographic_height: float | None = None  # of what the picture shows, instead of fov
    aperture: float = 0  # radius of the lens, scene units
    focal_distance: float = 1
    # in CRT alone: POV-Ray 3.7 has round lenses, and gets one of the same area
    aperture_shape: str = "circle"


@dataclass(frozen=True)
class PointLight:
    origin: Vector
    color: Vector = (1, 1, 1)


@dataclass(frozen=True, eq=False)
class Panorama:
    """A Panorama is a picture all around, in 8 bits of linear light: rows of pixels of three
    channels, from straight up to straight down. The middle column is towards z, and its right half
    towards x."""

    pixels: np.ndarray


@dataclass(frozen=True)
class Scene:
    about: str
    things: tuple
    camera: Camera
    lights: tuple = (PointLight((8, 12, -10)),)
    background: Vector | Panorama = (0.1, 0.15, 0.3)
    ambient: float = 0.1  # of the first light
    depth: int = 3  # bounces
    grid: int = 1  # rays a pixel: grid * grid
    lens_samples: int = 1
    noisy: bool = False  # pictures agree but for noise
