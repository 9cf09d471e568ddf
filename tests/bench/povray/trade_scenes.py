"""Makes scenes for accuracy against time, by name. Each is hard for samplers for a reason of its
own, or not hard at all."""

from .catalogue import CRYSTAL, FLOOR, HOLE, SHINY, STUDIO, TILES, WOOD, mirror_room, spheres
from .model import (
    Box, Camera, Checker, Cone, Cylinder, Difference, Material, Plane, PointLight, Scene, Sphere,
    Torus,
)
from .stream import Stream

# of the full pictures, in pixels; 180 for the others
HEIGHTS = {"glass": 120, "hard": 120, "mirrors": 120}


def height_of(name: str) -> int:
    return HEIGHTS.get(name, 180)


def camera_of_pixels(name: str) -> Camera:
    """Returns a camera for which a pixel of the full picture is a unit."""
    return Camera(
        position=(0, 0, -500), pointing=(0, 0, 0), orthographic_height=height_of(name),
        focal_distance=1,
    )


FAR_LIGHT = (PointLight((400, 700, -900)),)


def cad() -> Scene:
    """Looks along z, so that all straight edges are parallel to the pixels' sides."""
    drills = tuple(
        Cylinder((-2.71 + 1.093 * i, 1.207 - 1.211 * j, -1),
                 (-2.71 + 1.093 * i, 1.207 - 1.211 * j, 2),
                 0.11 + 0.05 * i, HOLE)
        for i in range(6) for j in range(2))
    slots = tuple(
        Box((-2.903 + 1.313 * i, -2.107, -1), (-2.207 + 1.313 * i, -1.411 + 0.0531 * i, 2), HOLE)
        for i in range(5))
    plate = Difference(Box((-3.617, -2.503, 0), (3.607, 2.011, 0.3), WOOD), drills + slots)
    ribs = tuple(
        Box((-3.41 + 0.857 * i, 2.203, -0.4), (-3.297 + 0.857 * i, 2.851, 0.6), SHINY)
        for i in range(9))
    back = Box((-5, -4, 1.2), (5, 4, 1.5), FLOOR)
    camera = Camera(position=(0.113, 0.071, -8), pointing=(0.113, 0.071, 0))
    return Scene(
        "plates with drilled holes, slots and ribs, edges along the pixels", (back, plate) + ribs,
        camera,
    )


def wires() -> Scene:
    """Makes cylinders 0.1 to 0.8 pixels wide, needles that end in less, and balls that cover 3 to
    60 % of a pixel."""
    stream = Stream(17)

    def ends() -> tuple:
        return ((stream.between(-115, 0), stream.between(-85, 85), stream.between(-20, 20)),
                (stream.between(0, 115), stream.between(-85, 85), stream.between(-20, 20)))

    bright = Material(color=(0.65, 0.65, 0.6))  # such that nothing is brighter than white
    cylinders = tuple(Cylinder(*ends(), 0.05 * 1.174**i, bright) for i in range(14))
    needles = tuple(Cone(*ends(), 0.5, 0.02, bright) for _ in range(6))
    balls = tuple(
        Sphere((stream.between(-115, 115), stream.between(-85, 85), -25), 0.1 + 0.0056 * i, bright)
        for i in range(60))
    return Scene("wires, needles and spheres thinner than a pixel", cylinders + needles + balls,
                 camera_of_pixels("wires"), FAR_LIGHT, ambient=0.4)


def silhouettes() -> Scene:
    stream = Stream(19)

    def place() -> tuple:
        return (stream.between(-4.5, 4.5), stream.between(-3.3, 3.3), stream.between(-3, 3))

    balls = tuple(Sphere(place(), stream.between(0.15, 0.6), SHINY) for _ in range(40))
    rings = tuple(
        Torus(place(), stream.between(0.3, 0.6), stream.between(0.06, 0.16),
              (stream.between(0, 180), stream.between(0, 180), 0), WOOD)
        for _ in range(16))
    return Scene("40 spheres and 16 tori before the background", balls + rings, STUDIO)


def glass_rows() -> Scene:
    """Has no ambient light: in POV-Ray glass has no share of it, in CRT it has."""
    stream = Stream(23)
    balls = tuple(
        Sphere((1.9 * column - 2.85, 0.1, 2.1 * row - 3), stream.between(0.75, 0.95), CRYSTAL)
        for row in range(3) for column in range(4))
    camera = Camera(position=(0.4, 1.1, -11), pointing=(0, 0, 0), fov=35)
    return Scene("three rows of glass spheres over tiles, 10 bounces", balls + (Plane(-1, TILES),),
                 camera, ambient=0, depth=10)


def defocus() -> Scene:
    camera = Camera(position=STUDIO.position, pointing=STUDIO.pointing, aperture=0.3,
                    focal_distance=11, aperture_shape="hexagon")
    return Scene(
        "100 spheres behind a six-sided lens", spheres(100).things, camera, lens_samples=37,
        noisy=True,
    )


def flat() -> Scene:
    return Scene("a plane under a light and nothing else", (Plane(-1, FLOOR),),
                 Camera(position=(0, 4, -5), pointing=(0, -1, 0)))


def hard() -> Scene:
    tiles = Material(color=Checker((0.9, 0.85, 0.8), (0.1, 0.15, 0.2), 0.731, (0.013, 0.017, 0.3)))
    wall = Box((-400, -300, 0), (400, 300, 1), tiles)
    return Scene("a wall of tiles that are smaller than a pixel", (wall,), camera_of_pixels("hard"),
                 FAR_LIGHT)


def scale() -> Scene:
    """Puts some balls of radius 1000, 100, 10 and 1 on a ball of radius 1e6."""
    stream = Stream(29)
    things = [Sphere((0, -1e6, 0), 1e6, FLOOR)]
    for size, far in ((1000, 6000), (100, 900), (10, 120), (1, 22)):
        for i in range(6):
            x = far * (0.17 * i - 0.45 + stream.between(-0.06, 0.06))
            z = far * stream.between(0.8, 1.2)
            things.append(Sphere((x, size * stream.between(0.9, 1), z), size, SHINY))
    camera = Camera(position=(0, 6, -12), pointing=(0, 4.5, 10))
    return Scene(
        "spheres of radius 1 to 1e6", tuple(things), camera, (PointLight((8e6, 12e6, -1e7)),)
    )


SCENES = {
    "cad": cad,
    "wires": wires,
    "silhouettes": silhouettes,
    "glass": glass_rows,
    "defocus": defocus,
    "mirrors": mirror_room,
    "scale": scale,
    "flat": flat,
    "hard": hard,
}
QUICK = ("cad", "wires", "defocus", "flat")
