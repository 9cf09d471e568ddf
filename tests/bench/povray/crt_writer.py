"""Writes scenes in CRT's language."""

import math
import pathlib
from typing import TextIO

import numpy as np

from . import data_files
from .model import (
    Alternating, Box, Checker, Cone, Cylinder, Difference, HeightField, Lenses, Material, Mesh,
    Panorama, Plane, Scene, Sphere, Spheres, Torus, Union,
)


def number(value: float) -> str:
    return f"{value:.10g}"


def vector(values) -> str:
    return f"vec3({', '.join(map(number, values))})"


def color(values) -> str:
    return f"rgb({', '.join(map(number, values))})"


def rows(centers: np.ndarray, call: str) -> str:
    """Returns a call for each centre, a line each."""
    return "\n".join(f"{call}({x:.5f}, {y:.5f}, {z:.5f})" for x, y, z in centers.tolist())


class Writer:
    """Gives names to materials and to bodies that an expression needs. All go before the Scene.
    Meshes and heights go into files beside the script."""

    def __init__(self, scene: Scene, script: pathlib.Path) -> None:
        self.scene = scene
        self.script = script
        self.definitions: list[str] = []
        self.materials: dict[Material, str] = {}
        self.names = 0

    def write(self, out: TextIO) -> None:
        things = [self.emitted(thing) for thing in self.scene.things]
        out.write(f"-- {self.scene.about}\n")
        out.write(self.settings())
        for definition in self.definitions:
            out.write(definition + "\n")
        out.write("\nScene {\n")
        for thing in things:
            out.write(thing + "\n")
        out.write("}\n")

    def settings(self) -> str:
        scene, camera = self.scene, self.scene.camera
        fov, projection = camera.fov, ""
        if camera.orthographic_height is not None:
            fov = 2 * math.degrees(
                math.atan(camera.orthographic_height / 2 / camera.focal_distance)
            )
            projection = '  projection -> "orthographic"\n'
        lights = ",\n    ".join(
            f"PointLight {{ origin -> {vector(light.origin)} color -> {color(light.color)}"
            f" ambient -> {number(scene.ambient if index == 0 else 0)} }}"
            for index, light in enumerate(scene.lights))
        return f"""Settings {{
  gamma -> 1
  ambientmodel -> "light"
  recursiondepth -> {scene.depth}
  minweight -> 1.0 / 1024
  supersampling -> {scene.grid}
  dofsamples -> {scene.lens_samples}
{projection}  camera -> Camera {{
    position -> {vector(camera.position)} pointing -> {vector(camera.pointing)} fov -> {number(fov)}
    lensradius -> {number(camera.aperture)} focaldistance -> {number(camera.focal_distance)}
    apertureshape -> "{camera.aperture_shape}"
  }}
  background -> {self.background()}
  lights -> [
    {lights}
  ]
}}
"""

    def background(self) -> str:
        """Says what there is behind all things. A panorama's pixels are linear light, as 'gamma'
        says."""
        background = self.scene.background
        if not isinstance(background, Panorama):
            return f"Background {{ color -> {color(background)} }}"
        path = self.script.with_name(f"{self.script.stem}-around.ppm")
        data_files.write_ppm(path, background)
        return f'Background {{ image -> "{path.name}" }}'

    def name(self, stem: str) -> str:
        self.names += 1
        return f"{stem}{self.names}"

    def define(self, stem: str, value: str) -> str:
        name = self.name(stem)
        self.definitions.append(f"{name} = {value}")
        return name

    def material(self, material: Material) -> str:
        if material not in self.materials:
            paint = material.color
            if isinstance(paint, Checker):
                paint = (f"Checker {{ colorA -> {color(paint.color_a)}"
                         f" colorB -> {color(paint.color_b)}"
                         f" scale -> {number(paint.scale)} offset -> {vector(paint.offset)} }}")
            else:
                paint = color(paint)
            self.materials[material] = self.define("material", (
                f"Material {{ color -> {paint} diffuse -> {number(material.diffuse)}"
                f" specular -> {number(material.specular)} shininess ->"
                f" {number(material.shininess)}"
                f" reflectivity -> {number(material.reflectivity)} transparency ->"
                f" {number(material.transparency)}"
                f" refractiveindex -> {number(material.refractive_index)} }}"))
        return self.materials[material]

    def emitted(self, thing) -> str:
        """Returns statements that emit the thing."""
        if isinstance(thing, Spheres):
            ball = self.define("ball", (
                f"Macro (x, y, z)"
                f" {{ Sphere {{ center -> vec3(x, y, z) radius -> {number(thing.radius)}"
                f" material -> {self.material(thing.material)} }} }}"))
            return rows(thing.centers, ball)
        if isinstance(thing, Lenses):
            half = [
                f"Sphere {{ center -> vec3(x, y, z {sign} {number(thing.half_gap)})"
                f" radius -> {number(thing.radius)} material -> {self.material(thing.material)} }}"
                for sign in "-+"]
            return rows(
                thing.centers, self.define("lens", f"Macro (x, y, z) {{ {half[0]} ^ {half[1]} }}")
            )
        return self.value(thing)

    def value(self, thing) -> str:
        """Returns an expression for the thing."""
        if isinstance(thing, (Spheres, Lenses)):
            calls = self.emitted(thing)
            return self.define("group", f"Macro () {{\n{calls}\n}}") + "()"
        if isinstance(thing, Sphere):
            return (f"Sphere {{ center -> {vector(thing.center)} radius -> {number(thing.radius)}"
                    f" material -> {self.material(thing.material)} }}")
        if isinstance(thing, Box):
            return (f"Box {{ cornerA -> {vector(thing.low)} cornerB -> {vector(thing.high)}"
                    f" material -> {self.material(thing.material)} }}")
        if isinstance(thing, Cylinder):
            return (f"Cylinder {{ from -> {vector(thing.start)} to -> {vector(thing.end)}"
                    f" radius -> {number(thing.radius)} material ->"
                    f" {self.material(thing.material)} }}")
        if isinstance(thing, Cone):
            return (f"Cone {{ from -> {vector(thing.start)} to -> {vector(thing.end)}"
                    f" radius -> {number(thing.start_radius)} radius2 -> {number(thing.end_radius)}"
                    f" material -> {self.material(thing.material)} }}")
        if isinstance(thing, Plane):
            return (f"Plane {{ normal -> vec3(0, 1, 0) position -> {vector((0, thing.height, 0))}"
                    f" material -> {self.material(thing.material)} }}")
        if isinstance(thing, Torus):
            return (f"Torus {{ center -> vec3(0, 0, 0) axis -> vec3(0, 1, 0)"
                    f" radius -> {number(thing.radius)}"
                    f" thickness -> {number(thing.thickness)} material ->"
                    f" {self.material(thing.material)} }}"
                    f" <rotate {vector(thing.turn)}, translate {vector(thing.center)}>")
        if isinstance(thing, Mesh):
            path = self.script.with_name(f"{self.script.stem}-{self.name('mesh')}.ply")
            data_files.write_ply(path, thing)
            return f'Mesh {{ file -> "{path.name}" material -> {self.material(thing.material)} }}'
        if isinstance(thing, HeightField):
            path = self.script.with_name(f"{self.script.stem}-{self.name('field')}.pgm")
            data_files.write_pgm(path, thing)
            return (f'HeightField {{ image -> "{path.name}" cornerA -> {vector(thing.low)}'
                    f" cornerB -> {vector(thing.high)} material ->"
                    f" {self.material(thing.material)} }}")
        if isinstance(thing, Union):
            return " + ".join(
                f"({self.value(part)})" if isinstance(part, Difference) else self.value(part)
                for part in thing.parts)
        if isinstance(thing, Difference):
            return " - ".join(map(self.value, (thing.base, *thing.cutters)))
        if isinstance(thing, Alternating):
            body = self.define("body", self.value(thing.base))
            for level, part in enumerate(thing.parts):
                self.definitions.append(f"{body} = {body} {'+-'[level % 2]} {self.value(part)}")
            return body
        raise TypeError(f"no {type(thing).__name__} in CRT's language")
