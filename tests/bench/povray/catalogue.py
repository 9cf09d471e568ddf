"""CRT and POV-Ray both render these scenes, by name."""

import math

import numpy as np

from .model import (
    Alternating, Box, Camera, Checker, Cone, Cylinder, Difference, HeightField, Lenses, Material,
    Mesh, Panorama, Plane, PointLight, Scene, Sphere, Spheres, Torus, Union,
)
from .stream import Stream

SHINY = Material(color=(0.6, 0.6, 0.6), diffuse=0.8, specular=0.5, shininess=30)
FLOOR = Material(color=(0.5, 0.6, 0.5))
TILES = Material(color=Checker((0.8, 0.8, 0.7), (0.2, 0.25, 0.3), 1, (0.013, 0.3, 0.017)))
WOOD = Material(color=(0.7, 0.45, 0.25))
HOLE = Material(color=(0.3, 0.5, 0.7))
CRYSTAL = Material(color=(0.95, 0.95, 0.95), diffuse=0, transparency=1, refractive_index=1.5)
STUDIO = Camera(position=(3, 6, -11), pointing=(0, 0, 0))
FRONT = Camera(position=(1, 2, -11), pointing=(0, 0, 0))


def spheres(count: int) -> Scene:
    """Makes so many spheres in the same space, of which their share stays the same."""
    centers = Stream(1).points(count, (-4, -3, -4), (4, 3, 4))
    balls = Spheres(centers, 1.4 / count ** (1 / 3), SHINY)
    return Scene(f"{count} spheres over a plane", (balls, Plane(-4, FLOOR)), STUDIO)


def rows_and_columns(count: int) -> tuple[int, int]:
    columns = math.ceil(math.sqrt(count))
    while count % columns:
        columns += 1
    return columns, count // columns


def cells(count: int, width: float, height: float) -> tuple[np.ndarray, float]:
    """Returns the centres of a grid in the plane z = 0, and the shorter side of a cell."""
    columns, rows = rows_and_columns(count)
    x = width * ((np.arange(columns) + 0.5) / columns - 0.5)
    y = height * ((np.arange(rows) + 0.5) / rows - 0.5)
    centers = np.array([(a, b, 0) for b in y for a in x])
    return centers, min(width / columns, height / rows)


def plate(count: int) -> Scene:
    centers, side = cells(count, 8, 6)
    drilled = Difference(Box((-4, -3, 0), (4, 3, 1), WOOD), (Spheres(centers, 0.4 * side, HOLE),))
    return Scene(f"a box minus {count} spheres side by side", (drilled, Plane(-4, FLOOR)), FRONT)


def tunnel(count: int) -> Scene:
    """Makes a row of holes. Each ray in the middle passes all of them: they overlap, and the narrow
    places are 0.8 of their radius wide."""
    radius, step = 1.2, 0.72 * 2
    centers = np.array([(0, 0, step * i) for i in range(count)])
    block = Box((-2.003, -1.503, 0), (2.003, 1.503, step * (count - 1)), WOOD)
    camera = Camera(
        position=(0, 0, -5), pointing=(0, 0, 0), orthographic_height=3.2, focal_distance=1
    )
    lights = (PointLight((3, 4, -40)),)
    return Scene(f"a box minus {count} spheres in a row along the ray",
                 (Difference(block, (Spheres(centers, radius, HOLE),)),), camera, lights)


def lens_cloud(count: int) -> Lenses:
    size = 2 / count ** (1 / 3)
    return Lenses(Stream(3).points(count, (-4, -3, -4), (4, 3, 4)), size, 0.7 * size, SHINY)


def lens_union(count: int) -> Scene:
    return Scene(
        f"one union of {count} lenses", (Union((lens_cloud(count),)), Plane(-4, FLOOR)), STUDIO
    )


def lens_cut(count: int) -> Scene:
    cloud = Difference(Union((lens_cloud(count),)), (Box((0, -5, -5), (5, 5, 0), HOLE),))
    return Scene(f"a union of {count} lenses minus a box", (cloud, Plane(-4, FLOOR)), STUDIO)


def lenses(count: int) -> Scene:
    return Scene(f"{count} lenses, each by itself", (lens_cloud(count), Plane(-4, FLOOR)), STUDIO)


def mirror_room() -> Scene:
    walls = Material(color=(0.5, 0.5, 0.5), diffuse=0.3, reflectivity=0.7)
    tiles = Material(color=TILES.color, diffuse=0.7, reflectivity=0.3)
    stream = Stream(5)
    balls = tuple(
        Sphere((stream.between(-4, 4), stream.between(-2.2, 1), stream.between(-3, 4)), 0.7,
               Material(
                   color=(0.6, 0.6, 0.6), diffuse=0.6, specular=0.3, shininess=40, reflectivity=0.4
               ))
        for _ in range(12))
    room = (
        Box((-6, -4, -6), (6, -3, 6), tiles), Box((-6, 3, -6), (6, 4, 6), WOOD),
        Box((-6, -3, -6), (-5, 3, 6), walls), Box((5, -3, -6), (6, 3, 6), walls),
        Box((-5, -3, 5), (5, 3, 6), walls), Box((-5, -3, -6), (5, 3, -5), walls),
    )
    camera = Camera(position=(3.9, 1.5, -4.5), pointing=(-1, -1, 1), fov=60)
    lights = (PointLight((-3, 2.5, -3), (0.6, 0.6, 0.6)), PointLight((3, 2.6, 2), (0.4, 0.4, 0.4)))
    return Scene("a room of mirrors, 10 bounces, 2 lights", room + balls, camera, lights, depth=10)


def tori(count: int) -> Scene:
    stream = Stream(7)
    size = 3 / count ** (1 / 3)
    rings = tuple(
        Torus(
            tuple(center), size, 0.3 * size, (stream.between(0, 180), stream.between(0, 180), 0),
            SHINY,
        )
        for center in Stream(11).points(count, (-4, -3, -4), (4, 3, 4)))
    return Scene(f"{count} tori over a plane", rings + (Plane(-4, FLOOR),), STUDIO)


def glass() -> Scene:
    """Has no ambient light: in POV-Ray glass has no share of it, in CRT it has."""
    stream = Stream(13)
    balls = tuple(
        Sphere(
            (2.2 * (i % 4) - 3.3, 0.8 * (i // 4), 2.2 * (i // 4) - 2), stream.between(0.7, 1),
            CRYSTAL,
        )
        for i in range(12))
    return Scene("12 glass spheres over tiles, 10 bounces", balls + (Plane(-1.5, TILES),),
                 Camera(position=(1, 4, -9), pointing=(0, 0, 0)), ambient=0, depth=10)


def depth_of_field() -> Scene:
    scene = spheres(100)
    camera = Camera(
        position=STUDIO.position, pointing=STUDIO.pointing, aperture=0.3, focal_distance=11
    )
    return Scene(
        "100 spheres, a lens, 50 samples a pixel", scene.things, camera, lens_samples=50, noisy=True
    )


def antialiased() -> Scene:
    return Scene("1000 spheres, 3 x 3 rays a pixel", spheres(1000).things, STUDIO, grid=3)


def nested(levels: int) -> Scene:
    """Makes a plate to which balls are added and from which balls are cut, by turns, each level a
    place further."""
    centers, side = cells(levels, 8, 6)
    parts = tuple(
        Sphere(tuple(center), 0.45 * side, SHINY if level % 2 == 0 else HOLE)
        for level, center in enumerate(centers))
    body = Alternating(Box((-4, -3, 0), (4, 3, 1), WOOD), parts)
    return Scene(f"unions and differences nested {levels} deep", (body, Plane(-4, FLOOR)), FRONT)


def tubes(count: int) -> Scene:
    """Makes tubes about one axis, of so many cylinders: each tube has the next ones in its bore.
    The inner ones are longer. Their open ends are seen at a slant."""
    def cylinder(number: int) -> Cylinder:
        is_bore = number % 2 == 1
        end = 4 if is_bore else 2 + number / count
        return Cylinder((0, 0, -end), (0, 0, end), 3 * (1 - number / count),
                        HOLE if is_bore else SHINY)
    parts = tuple(Difference(cylinder(i), (cylinder(i + 1),)) for i in range(0, count, 2))
    return Scene(
        f"one union of tubes in tubes, {count} cylinders", (Union(parts), Plane(-4, FLOOR)), STUDIO
    )


def drilled_plate() -> Scene:
    """Makes a plate with holes, four of them countersunk."""
    places = [(-3 + 2 * i, -2 + 2 * j) for j in range(3) for i in range(4)][:11]
    holes = tuple(
        Cylinder((x, y, -1), (x, y, 2), 0.4 + 0.03 * i, HOLE) for i, (x, y) in enumerate(places))
    sinks = tuple(Cone((x, y, -0.013), (x, y, 0.9), 0.8, 0.2, HOLE) for x, y in places[:4])
    plate = Difference(Box((-4, -3, 0), (4, 3, 1), WOOD), holes + sinks)
    return Scene("a box minus 11 cylinders and 4 cones", (plate, Plane(-4, FLOOR)), FRONT)


def bumpy_ball(count: int) -> Mesh:
    """Makes a ball with bumps of some `count` triangles: rings of them about y."""
    rings = round(math.sqrt(count / 4))
    around = 2 * rings
    polar = np.pi * np.arange(1, rings + 1) / (rings + 1)
    angle = 2 * np.pi * np.arange(around) / around
    level = np.sin(polar)[:, None]
    unit = np.stack([level * np.cos(angle), np.cos(polar)[:, None] + 0 * angle,
                     level * np.sin(angle)], axis=-1).reshape(-1, 3)
    unit = np.concatenate([[[0, 1, 0]], unit, [[0, -1, 0]]])
    x, y, z = unit.T
    bumps = 1 + 0.15 * np.sin(9 * x) * np.sin(8 * y) * np.cos(7 * z)
    ring, place = np.divmod(np.arange((rings - 1) * around), around)
    a, b = 1 + ring * around + place, 1 + ring * around + (place + 1) % around
    first, last = 1 + np.arange(around), 1 + (rings - 1) * around + np.arange(around)
    top = np.stack([0 * first, first, np.roll(first, -1)], axis=-1)
    bottom = np.stack([last, np.full(around, len(unit) - 1), np.roll(last, -1)], axis=-1)
    sides = [np.stack([a, a + around, b + around], axis=-1),
             np.stack([a, b + around, b], axis=-1)]
    return Mesh((3 * bumps[:, None] * unit).astype(np.float32),
                np.concatenate([top, *sides, bottom]), (0.3, 0.9, 0.2), SHINY)


def mesh(count: int) -> Scene:
    return Scene(f"a mesh of {count} triangles", (bumpy_ball(count), Plane(-4, FLOOR)), STUDIO)


def mesh_cut(count: int, holes: int) -> Scene:
    """Makes a mesh from which spheres are cut all over its surface."""
    stream = Stream(17)
    centers = []
    for _ in range(holes):
        y, angle = stream.between(-1, 1), stream.between(0, 2 * math.pi)
        distance = 3 * stream.between(0.8, 1.15)
        level = distance * math.sqrt(1 - y * y)
        centers.append((level * math.cos(angle), distance * y, level * math.sin(angle)))
    cut = Difference(bumpy_ball(count), (Spheres(np.array(centers), 0.13, HOLE),))
    return Scene(f"a mesh of {count} triangles minus {holes} spheres", (cut, Plane(-4, FLOOR)),
                 STUDIO)


def height_field(side: int) -> Scene:
    """Makes mountains of waves of ever shorter lengths, each in another direction. At the sides,
    which POV-Ray leaves open, they end at a height of 0."""
    x, z = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    heights = np.full((side, side), 0.1)
    for octave in range(6):
        angle = 2.4 * octave
        wave = 5 * 2**octave * (x * math.cos(angle) + z * math.sin(angle))
        heights += 0.4 / 2**octave * (0.5 + 0.5 * np.sin(wave + octave))
    heights *= 16 * x * (1 - x) * z * (1 - z)
    field = HeightField(np.round(65535 * np.clip(heights, 0, 1)).astype(np.uint16), (-5, -2, -5),
                        (5, 1.5, 5), SHINY)
    return Scene(f"a height field of {side} x {side}", (field, Plane(-4, FLOOR)), STUDIO)


def sky(rows: int) -> Panorama:
    """Makes a sky that is brighter towards the horizon, with soft clouds, over dark ground."""
    columns = 2 * rows
    height = np.cos(np.pi * (np.arange(rows) + 0.5) / rows)[:, None, None]
    turn = (2 * np.pi * (np.arange(columns) + 0.5) / columns)[None, :, None]
    clouds = 0.5 + 0.25 * (np.sin(3 * turn + 5 * height) + np.sin(7 * turn - 11 * height))
    above = (np.array([0.25, 0.45, 0.85]) + 0.4 * np.exp(-4 * np.abs(height)) +
             0.25 * clouds * np.abs(height))
    below = np.array([0.22, 0.18, 0.12]) + 0.06 * np.sin(9 * turn) * (1 - np.abs(height))
    blend = 1 / (1 + np.exp(-40 * height))
    return Panorama(np.round(255 * np.clip(below + blend * (above - below), 0, 1)))


WATER = Material(color=(0.95, 0.97, 0.99), diffuse=0, transparency=1, refractive_index=1.33)


def lens_scene() -> Scene:
    """Looks through a lens of glass at nine balls, some of them mirrors, out of focus before and
    behind."""
    chrome = Material(color=(0.6, 0.6, 0.6), diffuse=0.2, reflectivity=0.8)
    stream = Stream(19)
    balls = tuple(
        Sphere((2.4 * (i % 3) - 2.4, 2 * (i // 3) - 2, stream.between(0, 6)),
               stream.between(0.6, 0.9), chrome if i % 2 == 0 else SHINY)
        for i in range(9))
    lens = Lenses(np.array([(0.3, 0.2, -5)]), 3, 2.6, CRYSTAL)
    camera = Camera(
        position=(0.4, 0.5, -11), pointing=(0, 0, 0), aperture=0.15, focal_distance=12
    )
    return Scene("9 balls behind a lens under a panorama, depth of field, 50 samples a pixel",
                 (lens, *balls), camera, background=sky(512), ambient=0, depth=6, lens_samples=50,
                 noisy=True)


def drops() -> Scene:
    """Makes drops of water, which are balls that the ground cuts."""
    stream = Stream(23)
    balls = tuple(
        Difference(
            Sphere((stream.between(-6, 6), stream.between(-1.05, -0.95), stream.between(-6, 6)),
                   stream.between(0.12, 0.3), WATER),
            (Box((-9, -3, -9), (9, -1, 9), WATER),))
        for _ in range(300))
    camera = Camera(
        position=(0, 2.5, -9), pointing=(0, -1, -1), aperture=0.08, focal_distance=8.7
    )
    return Scene("300 drops on a plane, depth of field, 2 x 2 rays of 32 samples a pixel",
                 (*balls, Plane(-1.01, TILES)), camera, ambient=0, depth=5, grid=2,
                 lens_samples=32, noisy=True)


def mirror_cabinet() -> Scene:
    """Makes a room of mirrors around a box with round holes and a lens of glass."""
    walls = Material(color=(0.5, 0.5, 0.5), diffuse=0.3, reflectivity=0.7)
    room = (
        Box((-6, -4, -6), (6, -3, 6), Material(color=TILES.color, diffuse=0.9, reflectivity=0.1)),
        Box((-6, 3, -6), (6, 4, 6), FLOOR), Box((-6, -3, -6), (-5, 3, 6), walls),
        Box((5, -3, -6), (6, 3, 6), walls), Box((-5, -3, 5), (5, 3, 6), walls),
        Box((-5, -3, -6), (5, 3, -5), walls),
    )
    cut = Difference(Box((-3.5, -3, 0.5), (-1.1, -0.6, 2.9), WOOD), (
        Sphere((-2.3, -1.8, 0.5), 0.9, HOLE), Sphere((-1.1, -0.6, 2.9), 1.1, HOLE),
        Cylinder((-2.9, -4, 2.3), (-2.9, 0, 2.3), 0.4, HOLE)))
    lens = Lenses(np.array([(1.4, -0.8, 0.5)]), 2, 1.6, CRYSTAL)
    camera = Camera(position=(3.2, 1.3, -4.4), pointing=(-0.6, -1, 1), fov=60)
    lights = (PointLight((-3, 2.5, -3), (0.6, 0.6, 0.6)), PointLight((3, 2.6, 2), (0.4, 0.4, 0.4)))
    return Scene("a room of mirrors with a cut box and a lens, 4 x 4 rays a pixel",
                 (*room, cut, lens), camera, lights, ambient=0, depth=10, grid=4)


def powers(first: int, last: int) -> list[tuple[int, str]]:
    return [(10**k, f"1e{k}") for k in range(first, last + 1)]


# Lists each scene by its name. It is made when asked for, as a million spheres take a while.
SCENES = {
    **{f"spheres-{name}": (lambda n=n: spheres(n)) for n, name in powers(2, 6)},
    **{f"plate-{name}": (lambda n=n: plate(n)) for n, name in powers(1, 4)},
    **{f"tunnel-{name}": (lambda n=n: tunnel(n)) for n, name in powers(1, 3)},
    **{f"lens-union-{name}": (lambda n=n: lens_union(n)) for n, name in powers(2, 4)},
    **{f"lens-cut-{name}": (lambda n=n: lens_cut(n)) for n, name in powers(2, 3)},
    "lenses-1e4": lambda: lenses(10**4),
    "mirror-room": mirror_room,
    "tori-300": lambda: tori(300),
    "glass": glass,
    "depth-of-field": depth_of_field,
    "antialiased": antialiased,
    "lens-scene": lens_scene,
    "drops-300": drops,
    "mirror-cabinet": mirror_cabinet,
    "nested-50": lambda: nested(50),
    "nested-500": lambda: nested(500),
    **{f"tubes-{name}": (lambda n=n: tubes(n)) for n, name in powers(1, 3)},
    "drilled-plate": drilled_plate,
    "mesh-1e4": lambda: mesh(10**4),
    "mesh-1e6": lambda: mesh(10**6),
    "mesh-cut-1e6": lambda: mesh_cut(10**6, 1000),
    "height-field-512": lambda: height_field(512),
    "height-field-4096": lambda: height_field(4096),
}
QUICK = ("spheres-1e2", "spheres-1e4", "plate-1e2", "plate-1e3", "tunnel-1e1", "lenses-1e4",
         "mirror-room", "tori-300", "glass", "depth-of-field", "antialiased", "nested-50",
         "mesh-1e4", "height-field-512")
# POV-Ray renders these with its other tree as well.
BSP = ("spheres-1e4", "spheres-1e6", "lenses-1e4", "plate-1e3")
