"""Writes scenes in POV-Ray's language, such that its formulas give what CRT's do."""

import math
import pathlib
from typing import TextIO

from . import data_files
from .model import (
    Alternating, Box, Checker, Cone, Cylinder, Difference, HeightField, Lenses, Material, Mesh,
    Panorama, Plane, Scene, Sphere, Spheres, Torus, Union,
)

# The ratio of POV-Ray's `aperture` to the radius of its lens was found by the size of a spot out of
# focus.
APERTURE_FOR_RADIUS = 4.0
# The areas of shapes that POV-Ray lacks are relative to that of a circle around them.
AREAS = {"circle": 1, "hexagon": 3 * math.sqrt(3) / (2 * math.pi)}


def number(value: float) -> str:
    return f"{value:.10g}"


def vector(values) -> str:
    return f"<{', '.join(map(number, values))}>"


def rows(centers, before: str, after: str) -> str:
    return "\n".join(f"{before}<{x:.5f}, {y:.5f}, {z:.5f}>{after}" for x, y, z in centers.tolist())


class Writer:
    def __init__(self, scene: Scene, aspect: float, script: pathlib.Path) -> None:
        self.scene = scene
        self.aspect = aspect
        self.script = script
        self.fields = 0
        self.declarations: list[str] = []
        self.materials: dict[Material, str] = {}

    def write(self, out: TextIO) -> None:
        things = [self.text(thing) for thing in self.scene.things]
        out.write(f"// {self.scene.about}\n#version 3.7;\n")
        out.write(self.settings())
        for declaration in self.declarations:
            out.write(declaration + "\n")
        for thing in things:
            out.write(thing + "\n")

    def settings(self) -> str:
        scene = self.scene
        lights = "".join(
            f"light_source {{ {vector(light.origin)}, rgb {vector(light.color)} }}\n"
            for light in scene.lights)
        lens = ""
        if scene.camera.aperture > 0:  # both may be set on the command line
            lens = (f"#ifndef (BlurSamples) #declare BlurSamples = {scene.lens_samples}; #end\n"
                    "#ifndef (Variance) #declare Variance = 0; #end\n")
        return f"""{lens}global_settings {{
  assumed_gamma 1
  ambient_light 1
  max_trace_level {scene.depth + 1}  // counts the camera's ray
  adc_bailout 1 / 1024
}}
{self.camera()}
{self.background()}
{lights}"""

    def background(self) -> str:
        """Says what there is behind all things. POV-Ray's panoramas begin at x and go on to z,
        so their middle column is at -x and what is right of it towards -z."""
        background = self.scene.background
        if not isinstance(background, Panorama):
            return f"background {{ rgb {vector(background)} }}"
        path = self.script.with_name(f"{self.script.stem}-around.ppm")
        data_files.write_ppm(path, background)
        return (f'sky_sphere {{ pigment {{ image_map {{ ppm "{path.name}" gamma 1 map_type 1'
                " interpolate 2 } scale <1, 1, -1> rotate y * 90 } }")

    def camera(self) -> str:
        scene, camera = self.scene, self.scene.camera
        if camera.orthographic_height is not None:
            height = camera.orthographic_height
            return (f"camera {{ orthographic location {vector(camera.position)}"
                    f" right x * {number(self.aspect * height)} up y * {number(height)} direction z"
                    f" look_at {vector(camera.pointing)} }}")
        length = 0.5 / math.tan(math.radians(camera.fov) / 2)
        lens = ""
        if camera.aperture > 0:
            view = [b - a for a, b in zip(camera.position, camera.pointing)]
            reach = camera.focal_distance / math.hypot(*view)
            focus = [a + reach * v for a, v in zip(camera.position, view)]
            radius = camera.aperture * math.sqrt(AREAS[camera.aperture_shape])
            lens = (f" aperture {number(APERTURE_FOR_RADIUS * radius)} focal_point {vector(focus)}"
                    " blur_samples BlurSamples variance Variance")
        return (f"camera {{ perspective location {vector(camera.position)}"
                f" right x * {number(self.aspect)} up y"
                f" direction z * {number(length)} look_at {vector(camera.pointing)}{lens} }}")

    def material(self, material: Material) -> str:
        """Writes a material. CRT's ambient light is not tinted by the surface with the model that
        crt_writer.py asks for, so it is divided by the colour here."""
        if material in self.materials:
            return self.materials[material]
        ambient = [0, 0, 0]
        if self.scene.lights:
            ambient = [
                self.scene.ambient * (1 - material.reflectivity) * c
                for c in self.scene.lights[0].color
            ]
        name = f"T{len(self.materials) + 1}"
        self.declarations.append(f"#declare {name} = texture {{ {self.paint(material, ambient)} }}")
        self.materials[material] = name
        return name

    def paint(self, material: Material, ambient: list[float]) -> str:
        paint = material.color
        if isinstance(paint, Checker):
            return self.checker(material, paint, ambient)
        kept = f"rgbf <{', '.join(map(number, (*paint, material.transparency)))}>"
        return f"pigment {{ {kept} }} {self.finish(material, paint, ambient)}"

    def checker(self, material: Material, paint: Checker, ambient: list[float]) -> str:
        tiles = (f"texture {{ pigment {{ rgb {vector(shade)} }}"
                 f" {self.finish(material, shade, ambient)} }}"
                 for shade in (paint.color_a, paint.color_b))
        return (f"checker {', '.join(tiles)} scale {number(paint.scale)}"
                f" translate {vector(paint.offset)}")

    def finish(self, material: Material, shade, ambient: list[float]) -> str:
        tinted = [a / max(c, 1e-9) for a, c in zip(ambient, shade)]
        text = f"finish {{ ambient rgb {vector(tinted)} diffuse {number(material.diffuse)}"
        if material.specular:
            text += (f" phong {number(material.specular * shade[0])}"
                     f" phong_size {number(material.shininess)}")
        if material.transparency:
            text += " reflection { 0, 1 fresnel on } conserve_energy"
        elif material.reflectivity:
            text += f" reflection {number(material.reflectivity)}"
        return text + " }"

    def look(self, material: Material) -> str:
        text = f" texture {{ {self.material(material)} }}"
        if material.transparency:
            text += f" interior {{ ior {number(material.refractive_index)} }}"
        return text

    def text(self, thing) -> str:
        if isinstance(thing, Spheres):
            return rows(
                thing.centers, "sphere {", f", {number(thing.radius)}{self.look(thing.material)}}}"
            )
        if isinstance(thing, Lenses):
            half = (
                f"sphere {{ {sign}z * {number(thing.half_gap)}, {number(thing.radius)} }}"
                for sign in "-+"
            )
            self.declarations.append(
                f"#declare Lens = intersection {{ {' '.join(half)}{self.look(thing.material)} }}"
            )
            return rows(thing.centers, "object { Lens translate ", " }")
        if isinstance(thing, Sphere):
            return (f"sphere {{ {vector(thing.center)}, {number(thing.radius)}"
                    f"{self.look(thing.material)} }}")
        if isinstance(thing, Box):
            return f"box {{ {vector(thing.low)}, {vector(thing.high)}{self.look(thing.material)} }}"
        if isinstance(thing, Cylinder):
            return (f"cylinder {{ {vector(thing.start)}, {vector(thing.end)},"
                    f" {number(thing.radius)}"
                    f"{self.look(thing.material)} }}")
        if isinstance(thing, Cone):
            return (f"cone {{ {vector(thing.start)}, {number(thing.start_radius)},"
                    f" {vector(thing.end)},"
                    f" {number(thing.end_radius)}{self.look(thing.material)} }}")
        if isinstance(thing, Plane):
            return f"plane {{ y, {number(thing.height)}{self.look(thing.material)} }}"
        if isinstance(thing, Torus):
            return (f"torus {{ {number(thing.radius)}, {number(thing.thickness)}"
                    f" rotate {vector(thing.turn)}"
                    f" translate {vector(thing.center)}{self.look(thing.material)} }}")
        if isinstance(thing, Mesh):
            return self.mesh(thing)
        if isinstance(thing, HeightField):
            self.fields += 1
            path = self.script.with_name(f"{self.script.stem}-heights{self.fields}.pgm")
            data_files.write_pgm(path, thing)
            size = [high - low for low, high in zip(thing.low, thing.high)]
            return (f'height_field {{ pgm "{path.name}" scale {vector(size)}'
                    f" translate {vector(thing.low)}{self.look(thing.material)} }}")
        if isinstance(thing, Union):
            return self.csg("union", thing.parts)
        if isinstance(thing, Difference):
            return self.csg("difference", (thing.base, *thing.cutters))
        if isinstance(thing, Alternating):
            text = self.text(thing.base)
            for level, part in enumerate(thing.parts):
                text = f"{('union', 'difference')[level % 2]} {{ {text}\n{self.text(part)} }}"
            return text
        raise TypeError(f"no {type(thing).__name__} in POV-Ray's language")

    def mesh(self, mesh: Mesh) -> str:
        corners = ",\n".join(vector(place) for place in mesh.positions.tolist())
        faces = ",\n".join(f"<{a}, {b}, {c}>" for a, b, c in mesh.triangles.tolist())
        return (f"mesh2 {{ vertex_vectors {{ {len(mesh.positions)},\n{corners} }}\n"
                f"face_indices {{ {len(mesh.triangles)},\n{faces} }}\n"
                f"inside_vector {vector(mesh.inside)}{self.look(mesh.material)} }}")

    def csg(self, operation: str, parts) -> str:
        return f"{operation} {{\n" + "\n".join(map(self.text, parts)) + "\n}"
