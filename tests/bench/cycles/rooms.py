"""Describes the rooms once, as plain data that Blender's process can read as JSON, and writes them
as scripts of CRT. Coordinates are CRT's: left-handed, y up, z into the picture."""

import random
from typing import Any

import numpy as np

Room = dict[str, Any]
Vector = tuple[float, float, float]

WHITE, RED, GREEN = (0.75, 0.75, 0.75), (0.6, 0.08, 0.06), (0.12, 0.45, 0.12)
BOUNCES = 4  # diffuse ones, and as many of mirrors and rough metal
METAL_ROUGHNESS = 0.3


def box(
    low: Vector, high: Vector, color: Vector, turned: float = 0, at: Vector = (0, 0, 0)
) -> dict:
    """Returns a box that is turned about y, in degrees, and then moved."""
    return {"low": low, "high": high, "color": color, "turned": turned, "at": at}


def cased_light(corner: Vector, x: float, z: float, radiance: Vector) -> tuple[dict, dict]:
    """Returns a light that shines down, and its black casing. Behind a light CRT's rays end, and
    those of Cycles go on: with the casing there is nothing to be seen there."""
    low = tuple(np.add(corner, (0, 0.001, 0)).tolist())
    high = tuple(np.add(corner, (x, 0.005, z)).tolist())
    return {"corner": corner, "x": x, "z": z, "radiance": radiance}, box(low, high, (0, 0, 0))


def sphere(center: Vector, radius: float, color: Vector, is_metal: bool = False) -> dict:
    return {"center": center, "radius": radius, "color": color, "is_metal": is_metal}


def closed() -> Room:
    """Returns a room without a window: two boxes, a matt ball and one of rough metal."""
    light, casing = cased_light((-0.5, 2.49, -0.6), 1.0, 0.8, (12, 11, 9))
    walls = [
        box((-1.6, -0.1, -3.1), (1.6, 0, 1.6), WHITE),
        box((-1.6, 2.5, -3.1), (1.6, 2.6, 1.6), WHITE),
        box((-1.6, 0, 1.5), (1.6, 2.5, 1.6), WHITE), box((-1.6, 0, -3.1), (1.6, 2.5, -3), WHITE),
        box((-1.6, 0, -3), (-1.5, 2.5, 1.5), RED), box((1.5, 0, -3), (1.6, 2.5, 1.5), GREEN),
    ]
    return {
        "about": "a closed room: 2 boxes, a matt sphere and one of rough metal",
        "camera": {"position": (0, 1.35, -2.9), "pointing": (0, 1.1, 0), "fov": 50},
        "light": light,
        "environment": (0, 0, 0),
        "boxes": [
            *walls, casing,
            box((-0.35, 0, -0.35), (0.35, 1.3, 0.35), WHITE, 20, (-0.6, 0, 0.6)),
            box((-0.35, 0, -0.35), (0.35, 0.6, 0.35), WHITE, -18, (0.6, 0, -0.1)),
        ],
        "spheres": [
            sphere((-0.4, 0.25, -0.7), 0.25, (0.3, 0.4, 0.7)),
            sphere((0.6, 0.9, -0.1), 0.3, (0.91, 0.78, 0.42), is_metal=True),
        ],
    }


def spheres() -> Room:
    """Returns a floor and a wall under a grey sky, with 100 spheres and 6 boxes upon it."""
    chance = random.Random(48)
    placed: list[dict] = []
    while len(placed) < 100:
        radius = chance.choice((0.1, 0.15, 0.2, 0.3, 0.45))
        center = (chance.uniform(-3, 3), radius + chance.choice((0, 0, 0.4, 1)),
                  chance.uniform(-2, 3))
        apart = all(np.linalg.norm(np.subtract(center, other["center"])) > radius + other["radius"]
                    for other in placed)
        if apart:
            color = tuple(round(chance.uniform(0.1, 0.9), 3) for _ in range(3))
            placed.append(sphere(center, radius, color, is_metal=len(placed) % 4 == 0))
    light, casing = cased_light((-3, 4.5, -3), 1.5, 1.5, (20, 18, 15))
    boxes = [box((-6, -0.1, -6), (6, 0, 4), WHITE), box((-6, 0, 4), (6, 4, 4.1), WHITE), casing]
    for index in range(6):
        side = 0.3 + 0.05 * index
        boxes.append(box((-side / 2, 0, -side / 2), (side / 2, 3 * side, side / 2),
                         RED if index % 2 else GREEN, 15 * index, (index - 2.5, 0, 3.4)))
    return {
        "about": "100 spheres, a fourth of rough metal, and 8 boxes under a grey sky",
        "camera": {"position": (0, 2.2, -5.5), "pointing": (0, 0.6, 0), "fov": 42},
        "light": light,
        "environment": (0.4, 0.4, 0.4),
        "boxes": boxes,
        "spheres": placed,
    }


ROOMS = {"closed": closed, "spheres": spheres}


def vector(numbers: Vector) -> str:
    return f"vec3({', '.join(map(repr, numbers))})"


def rgb(numbers: Vector) -> str:
    return f"rgb({', '.join(map(repr, numbers))})"


def material(thing: dict) -> str:
    color = f"color -> {rgb(thing['color'])}"
    if thing.get("is_metal"):
        return f"PrincipledMaterial {{ {color} metallic -> 1 roughness -> {METAL_ROUGHNESS} }}"
    return f"Material {{ {color} }}"


def script(room: Room) -> str:
    """Returns the room in CRT's language."""
    camera, light = room["camera"], room["light"]
    lights = [
        f"RectangleLight {{ corner -> {vector(light['corner'])} color -> {rgb(light['radiance'])}"
        f" edgeA -> {vector((light['x'], 0, 0))} edgeB -> {vector((0, 0, light['z']))} }}"
    ]
    if any(room["environment"]):
        lights.append("EnvironmentLight { }")
    lines = [
        "Settings {",
        f"camera -> Camera {{ position -> {vector(camera['position'])}"
        f" pointing -> {vector(camera['pointing'])} fov -> {camera['fov']} }}",
        f"lights -> [{', '.join(lights)}]",
        f"background -> Background {{ color -> {rgb(room['environment'])} }}",
        f"indirect -> {BOUNCES} recursiondepth -> {BOUNCES}", "}", "Scene {",
    ]
    for each in room["boxes"]:
        lines.append(f"Box {{ cornerA -> {vector(each['low'])} cornerB -> {vector(each['high'])}"
                     f" material -> {material(each)} }}"
                     f" <rotate {vector((0, each['turned'], 0))}, translate {vector(each['at'])}>")
    for each in room["spheres"]:
        lines.append(f"Sphere {{ center -> {vector(each['center'])} radius -> {each['radius']!r}"
                     f" material -> {material(each)} }}")
    return "\n".join([*lines, "}", ""])
