"""The first program of the tutorial for Python: a scene in code, and its picture. Writes
bracket.png, or the file that is named."""

import math
import sys

import crt

steel = crt.Material(color=(0.16, 0.26, 0.36), specular=0.6, shininess=50, reflectivity=0.1)
floor = crt.Material(color=(0.42, 0.38, 0.33))


def bracket(holes: int = 4) -> crt.Entity:
    """Makes an angle of two plates with a rib, an eye, and holes in a row."""
    plates = crt.Box((-2, 0, -1.5), (2, 0.3, 1.5)) + crt.Box((-2, 0, 1.2), (2, 1.8, 1.5))
    eye = crt.Cylinder((0, 1.8, 1.2), (0, 1.8, 1.5), 1.2)
    bore = crt.Cylinder((0, 1.8, 0), (0, 1.8, 3), 0.7)
    rib = crt.Box((-0.15, 0.3, -0.9), (0.15, 1.1, 1.2))
    hollow = crt.Cylinder((-1, 1.9, -0.9), (1, 1.9, -0.9), 1.6)

    drill = crt.Cylinder((0, -1, 0), (0, 1, 0), 0.28)
    places = [((i + 0.5) / holes * 4 - 2, 0, -0.6) for i in range(holes)]
    part = crt.difference(plates + eye + (rib - hollow) - bore, map(drill.moved, places))
    return part.with_material(steel)


def bracket_scene() -> crt.Scene:
    camera = (-4.5, 5, -8)
    return crt.Scene(
        entities=[bracket(), crt.Plane((0, 1, 0), material=floor)],
        lights=[
            crt.Light.parallel(origin=(-5, 6, -3), color=(1.2, 1.1, 0.95)),
            crt.Light.point(origin=camera, color=(0.32, 0.35, 0.42)),
        ],
        camera=crt.Camera(position=camera, pointing=(0, 0.95, 0), fov=math.radians(32)),
        background=crt.Background.gradient(horizon=(0.8, 0.84, 0.88), sky=(0.1, 0.2, 0.4)),
        settings=crt.Settings(width=480, height=360, supersampling=3),
    )


if __name__ == "__main__":
    image = bracket_scene().render()
    image.save(sys.argv[1] if len(sys.argv) > 1 else "bracket.png")
