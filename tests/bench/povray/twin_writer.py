"""Writes recorded scenes in POV-Ray's language, as near to the same picture as POV-Ray comes.

POV-Ray has no rough mirrors, no lights that are seen, and no curve of film. So satin metal is a
weaker mirror with a highlight, a light with a size is an area light beside a bright polygon, and
the tone is laid over the linear picture afterwards. docs/speed.md tells more."""

import math
import pathlib

import numpy as np

from . import data_files, model
from .pov_writer import APERTURE_FOR_RADIUS, number, vector
from .recorded import Record, RecordedScene

AREA_LIGHT = "9, 9 adaptive 1 jitter"
RADIOSITY = ("radiosity { pretrace_start 0.08 pretrace_end 0.01 count 200 error_bound 0.3"
             " recursion_limit 4 nearest_count 10 low_error_factor 0.5 brightness 1 }")
ARC_STEP = math.pi / 18  # of an arc that becomes straight pieces
# Where a liquid fills glass, POV-Ray loses one of two surfaces at one place, and where solids
# overlap it absorbs light only up to the next surface. So there is a gap around it.
GAP = [[0.998, 0, 0, 0], [0, 1, 0, 0.001], [0, 0, 0.998, 0]]
GLASS_INDEX = 1.5
GREY = Record("Material", {"color": (0.5, 0.5, 0.5)})


def flattened(contour: list) -> list[tuple[float, float]]:
    """Returns the corners of a contour whose arcs have become straight pieces."""
    points = []
    x0, y0 = contour[-1][:2]
    for corner in contour:
        x1, y1 = corner[:2]
        bulge = corner[2] if len(corner) > 2 else 0
        if bulge:
            angle = 4 * math.atan(bulge)
            steps = max(1, math.ceil(abs(angle) / ARC_STEP))
            # The centre is on the left of the chord for an arc that turns from x to y.
            off = (1 - bulge * bulge) / (4 * bulge)
            cx = (x0 + x1) / 2 - off * (y1 - y0)
            cy = (y0 + y1) / 2 + off * (x1 - x0)
            for i in range(1, steps):
                c, s = math.cos(angle * i / steps), math.sin(angle * i / steps)
                points.append((cx + c * (x0 - cx) - s * (y0 - cy),
                               cy + s * (x0 - cx) + c * (y0 - cy)))
        points.append((x1, y1))
        x0, y0 = x1, y1
    # A prism takes a repeated corner for the end of its contour.
    return [p for i, p in enumerate(points) if math.dist(p, points[i - 1]) > 1e-9]


def matrix(rows) -> str:
    columns = [rows[row][column] for column in range(4) for row in range(3)]
    return f"matrix <{', '.join(map(number, columns))}>"


class TwinWriter:
    def __init__(self, scene: RecordedScene, aspect: float, script: pathlib.Path,
                 radiosity: str | None = None) -> None:
        self.scene = scene
        self.aspect = aspect
        self.script = script
        self.radiosity = radiosity
        if radiosity is None and (scene.settings.indirect or 0) > 0:
            self.radiosity = RADIOSITY
        self.fields = 0
        self.declarations: list[str] = []
        self.textures: dict[int, str] = {}

    def write(self) -> None:
        body = [self.text(thing, GREY) for thing in self.scene.things]
        body += [self.light(light) for light in self.scene.lights]
        depth = self.scene.settings.recursion_depth
        head = f"""#version 3.7;
global_settings {{
  assumed_gamma 1
  max_trace_level {(3 if depth is None else depth) + 4}
  ambient_light rgb {vector(self.ambient())}
  {self.radiosity or ''}
}}
#default {{ finish {{ ambient 1 diffuse 1 }} }}
"""
        self.script.write_text(
            "\n".join([head, self.camera(), self.background(), *self.declarations, *body]) + "\n")

    # -- Light ------------------------------------------------------------------------------------

    def ambient(self) -> tuple:
        """Stands in for an environment light: the mean of the background, nowhere shadowed."""
        sky = self.scene.background
        for light in self.scene.lights:
            if light.kind == "environment" and not self.radiosity:
                scale = 1 if light.scale is None else light.scale
                if sky.color is not None:
                    return tuple(scale * c for c in sky.color)
                return tuple(scale * (a + b) / 2 for a, b in zip(sky.horizon, sky.sky))
        return (0, 0, 0)

    def light(self, light: Record) -> str:
        if light.kind == "environment":
            return ""
        if light.kind == "rectangle":
            a, b = np.array(light.edge_a), np.array(light.edge_b)
            corner = np.array(light.origin)
            area = float(np.linalg.norm(np.cross(a, b)))
            text = self.area_light(corner + (a + b) / 2, a, b, area, light.color, "")
            if light.visible != 0:
                corners = [corner, corner + a, corner + a + b, corner + b, corner]
                text += (f"\npolygon {{ 5, {', '.join(map(vector, corners))} pigment {{ rgb"
                         f" {vector(light.color)} }} finish {{ ambient 0 diffuse 0 emission 1 }}"
                         " no_shadow }")
            return text
        if light.kind == "sphere":
            sides = np.array((2 * light.radius, 0, 0)), np.array((0, 2 * light.radius, 0))
            return self.area_light(np.array(light.origin), *sides, math.pi * light.radius**2,
                                   light.color, " circular orient")
        if light.kind == "parallel":
            target = np.array(light.pointing or (0, 0, 0))
            way = np.array(light.origin) - target
            place = target + 100 * way / np.linalg.norm(way)
            soft = ""
            if light.angle:
                side = 200 * math.tan(light.angle / 2)
                soft = (f" area_light x * {number(side)}, y * {number(side)}, {AREA_LIGHT}"
                        " circular orient")
            return (f"light_source {{ {vector(place)}, rgb {vector(light.color)} parallel point_at"
                    f" {vector(target)}{soft} }}")
        raise TypeError(f"no {light.kind} light in POV-Ray's language")

    def area_light(self, center, a, b, area: float, radiance, kind: str) -> str:
        """A light of radiance L and area A makes a surface far away as bright as L A / (pi d^2).
        POV-Ray's fading, 2 / (1 + (d / fade_distance)^2), is that where d is large."""
        target = np.array(self.scene.camera.pointing)
        near = 0.05 * float(np.linalg.norm(np.asarray(center) - target))
        strength = area / (2 * math.pi * near**2)
        color = [strength * c for c in radiance]
        return (f"light_source {{ {vector(center)}, rgb {vector(color)} area_light {vector(a)},"
                f" {vector(b)}, {AREA_LIGHT}{kind} area_illumination on fade_power 2"
                f" fade_distance {number(near)} }}")

    def background(self) -> str:
        sky = self.scene.background
        if sky.color is not None:
            return f"background {{ rgb {vector(sky.color)} }}"
        if sky.horizon is None:
            return "background { rgb 1 }"
        return ("sky_sphere { pigment { function { abs(y) } color_map {"
                f" [0 rgb {vector(sky.horizon)}] [1 rgb {vector(sky.sky)}] }} }} }}")

    def camera(self) -> str:
        camera = self.scene.camera
        place, target = np.array(camera.position), np.array(camera.pointing)
        view = (target - place) / np.linalg.norm(target - place)
        right = np.cross((0, 1, 0), view)
        right /= np.linalg.norm(right)
        up = np.cross(view, right)
        roll = camera.roll or 0
        right, up = (math.cos(roll) * right - math.sin(roll) * up,
                     math.cos(roll) * up + math.sin(roll) * right)
        long = 0.5 / math.tan(camera.fov / 2)
        lens = ""
        if camera.lens_radius:
            focus = place + camera.focal_distance * view
            lens = (f" aperture {number(APERTURE_FOR_RADIUS * camera.lens_radius)} focal_point"
                    f" {vector(focus)} blur_samples 12 variance 1 / 1024 confidence 0.95")
        return (f"camera {{ location {vector(place)} right {vector(self.aspect * right)}"
                f" up {vector(up)} direction {vector(long * view)}{lens} }}")

    # -- Materials --------------------------------------------------------------------------------

    def look(self, material: Record) -> str:
        if id(material) not in self.textures:
            name = f"Look{len(self.textures) + 1}"
            self.textures[id(material)] = name
            self.declarations.append(f"#declare {name} = material {{ {self.material(material)} }}")
        return f" material {{ {self.textures[id(material)]} }}"

    def material(self, m: Record) -> str:
        rough = 0.5 if m.roughness is None else m.roughness
        normal = self.normal(m)
        if m.kind == "Material":
            return f"texture {{ {self.pigment(m)} finish {{ ambient 1 diffuse 1 }}{normal} }}"
        if m.emission_map is not None or m.emission is not None:
            glow = m.emission_map or m.emission
            bright = self.pattern(glow) if isinstance(glow, Record) else f"rgb {vector(glow)}"
            own = self.pigment(m)
            if m.color == (0, 0, 0):
                return (f"texture {{ pigment {{ {bright} }} finish {{ ambient 0 diffuse 0"
                        " emission 1 } }")
            return (f"texture {{ average texture_map {{ [1 {own} finish {{ ambient 2 diffuse 2"
                    f" specular 0.3 roughness 0.02 }}] [1 pigment {{ {bright} }} finish {{ ambient"
                    " 0 diffuse 0 emission 2 }] } }")
        if m.transmission:
            return self.glass(m)
        if m.metallic:
            mirror = max(0.15, 1 - 1.7 * rough)
            return (f"texture {{ {self.pigment(m)} finish {{ ambient {number(1 - mirror)} diffuse"
                    f" {number(0.7 * (1 - mirror))} metallic specular {number(0.6 * (1 - mirror))}"
                    f" roughness {number(max(0.001, rough**2))} reflection {{ {number(mirror)}"
                    f" metallic }} }}{normal} }}")
        # A varnish mirrors by Fresnel's formula. Without one there is a highlight alone.
        coat = max(m.coat or 0, 1 if rough < 0.2 else 0)
        shine = (m.coat_roughness or 0.001) if m.coat else rough
        fresnel = ""
        if coat:
            fresnel = f" reflection {{ 0, {number(coat)} fresnel on }} conserve_energy"
        return (f"texture {{ {self.pigment(m)} finish {{ ambient 1 diffuse 1 specular"
                f" {number(0.05 + 0.25 * coat)} roughness {number(max(0.001, shine**2))}{fresnel}"
                f" }}{normal} }} interior {{ ior {number(m.refractive_index or 1.5)} }}")

    def glass(self, m: Record) -> str:
        faded = ""
        most = max(m.absorption or (0,))
        if most > 0:
            color = [1 - a / most for a in m.absorption]
            faded = (f" fade_power 1001 fade_distance {number(1 / most)} fade_color rgb"
                     f" {vector(color)}")
        color = m.color or (0.8, 0.8, 0.8)
        return (f"texture {{ pigment {{ rgbf <{', '.join(map(number, color))}, 1> }} finish {{"
                " ambient 0 diffuse 0 specular 0.4 roughness 0.001 reflection { 0, 1 fresnel on }"
                f" conserve_energy }} }} interior {{ ior {number(m.refractive_index or 1.5)}"
                f"{faded} }}")

    def normal(self, m: Record) -> str:
        if m.bump is None or m.bump.kind != "noise":
            return ""
        scale = m.bump.scale or 1
        height = 0.1 if m.bump_height is None else m.bump_height
        return f" normal {{ bumps {number(min(1, 4 * height / scale))} scale {number(scale)} }}"

    def pigment(self, m: Record) -> str:
        if m.pattern is not None:
            return f"pigment {{ {self.pattern(m.pattern)} }}"
        default = (0.5, 0.5, 0.5) if m.kind == "Material" else (0.8, 0.8, 0.8)
        return f"pigment {{ rgb {vector(m.color or default)} }}"

    def pattern(self, p: Record) -> str:
        colors = p.colors or [(0, p.color_a or (1, 1, 1)), (1, p.color_b or (0, 0, 0))]
        entries = " ".join(f"[{number(stop[0])} rgb {vector(stop[1])}]" for stop in colors)
        ramp = f"color_map {{ {entries} }}"
        scale, offset = p.scale or 1, p.offset or (0, 0, 0)
        placed = f" scale {number(scale)} translate {vector(offset)}"
        along = np.array(p.direction or (0, 1, 0), float)
        along /= np.linalg.norm(along)
        if p.kind == "noise":
            return f"bozo {ramp} scale {number(0.6 * scale)} translate {vector(offset)}"
        if p.kind == "gradient":  # there and back within a period
            return (f"gradient {vector(along)} triangle_wave {ramp} scale {number(scale)}"
                    f" translate {vector(offset)}")
        if p.kind == "stripes":
            both = (f"[0 rgb {vector(colors[0][1])}] [0.5 rgb {vector(colors[0][1])}]"
                    f" [0.5 rgb {vector(colors[1][1])}] [1 rgb {vector(colors[1][1])}]")
            return f"gradient {vector(along)} color_map {{ {both} }}{placed}"
        if p.kind == "checker":
            return f"checker rgb {vector(colors[0][1])}, rgb {vector(colors[1][1])}{placed}"
        if p.kind == "marble":
            return (f"marble turbulence {number(0.5 * (p.turbulence or 1))} {ramp}"
                    f" {self.turned((1, 0, 0), along)}{placed}")
        if p.kind == "wood":
            turbulence = 0.1 if p.turbulence is None else p.turbulence
            return (f"wood turbulence {number(0.2 * turbulence)} octaves {p.octaves or 3} {ramp}"
                    f" {self.turned((0, 0, 1), along)}{placed}")
        raise TypeError(f"no {p.kind} in POV-Ray's language")

    @staticmethod
    def turned(axis, along) -> str:
        """Returns a turn that takes one unit vector to another."""
        a, b = np.array(axis, float), np.asarray(along)
        v, c = np.cross(a, b), float(a @ b)
        if c < -0.9999:
            return "scale -1"
        if c > 0.999999:
            return ""
        k = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
        turn = np.eye(3) + k + k @ k / (1 + c)
        return matrix(np.hstack([turn, np.zeros((3, 1))]).tolist())

    # -- Shapes -----------------------------------------------------------------------------------

    def text(self, thing: Record, outer: Record, bare: bool = False) -> str:
        """Writes a thing. A bare one gets no material, as all that it is a part of has one."""
        kind = thing.kind
        if kind == "with_material":
            return self.text(thing.parts[0], thing.material, bare)
        if kind == "with_shadow":
            return f"object {{ {self.text(thing.parts[0], outer, bare)} no_shadow }}"
        if kind == "transformed":
            narrowed = matrix(GAP) + " " if self.is_liquid(thing, outer) else ""
            inner = self.text(thing.parts[0], outer, bare)
            return f"object {{ {inner} {narrowed}{matrix(thing.rows)} }}"
        if thing.parts:
            word = kind
            if kind == "union" and any(self.is_glass(part, outer) for part in thing.parts):
                word = "merge"
            # Glass absorbs light only if the whole solid is said to be of it.
            materials = {id(m): m for m in self.materials(thing, outer)}
            one = next(iter(materials.values()))
            is_whole = len(materials) == 1 and bool(one.transmission) and not bare
            parts = (self.text(part, outer, bare or is_whole) for part in thing.parts)
            look = self.look(one) if is_whole else ""
            return f"{word} {{\n" + "\n".join(parts) + f"\n{look} }}"
        return self.shape(thing, "" if bare else self.look(thing.material or outer))

    def materials(self, thing: Record, outer: Record) -> list[Record]:
        if thing.kind == "with_material":
            outer = thing.material
        if thing.parts:
            return [m for part in thing.parts for m in self.materials(part, outer)]
        return [thing.material or outer]

    def is_liquid(self, thing: Record, outer: Record) -> bool:
        """Says whether it lets light through but for glass, and stands about its own axis."""
        if thing.kind == "with_material":
            outer = thing.material
        if thing.parts:
            return all(self.is_liquid(part, outer) for part in thing.parts)
        material = thing.material or outer
        return bool(material.transmission) and (
            material.refractive_index or GLASS_INDEX) < GLASS_INDEX

    def is_glass(self, thing: Record, outer: Record) -> bool:
        if thing.kind == "with_material":
            outer = thing.material
        if thing.parts:
            return any(self.is_glass(part, outer) for part in thing.parts)
        return bool((thing.material or outer).transmission)

    def shape(self, s: Record, look: str) -> str:
        if s.kind == "Sphere":
            return f"sphere {{ {vector(s.center)}, {number(s.radius)}{look} }}"
        if s.kind == "Box":
            return f"box {{ {vector(s.corner_a)}, {vector(s.corner_b)}{look} }}"
        if s.kind == "Cylinder":
            return (f"cylinder {{ {vector(s.start)}, {vector(s.end)},"
                    f" {number(s.radius)}{look} }}")
        if s.kind == "Cone":
            radii = [s.radius if s.radius is not None else s.start_radius,
                     s.radius2 if s.radius2 is not None else s.end_radius or 0]
            return (f"cone {{ {vector(s.start)}, {number(radii[0])}, {vector(s.end)},"
                    f" {number(radii[1])}{look} }}")
        if s.kind == "Torus":
            turn = self.turned((0, 1, 0), np.array(s.axis, float) / np.linalg.norm(s.axis))
            return (f"torus {{ {number(s.radius)}, {number(s.thickness)} {turn} translate"
                    f" {vector(s.center)}{look} }}")
        if s.kind == "Plane":
            normal = np.array(s.normal, float) / np.linalg.norm(s.normal)
            return f"plane {{ {vector(normal)}, {number(normal @ np.array(s.position))}{look} }}"
        if s.kind == "Disc":
            return f"disc {{ {vector(s.center)}, {vector(s.normal)}, {number(s.radius)}{look} }}"
        if s.kind == "Capsule":
            ends = "".join(f" sphere {{ {vector(end)}, {number(s.radius)} }}"
                           for end in (s.start, s.end))
            return (f"union {{ cylinder {{ {vector(s.start)}, {vector(s.end)},"
                    f" {number(s.radius)} }}{ends}{look} }}")
        if s.kind == "RoundedBox":
            return self.rounded_box(s, look)
        if s.kind == "Extrusion":
            return self.extrusion(s, look)
        if s.kind == "Revolution":
            return self.revolution(s, look)
        if s.kind == "HeightField":
            return self.height_field(s, look)
        raise TypeError(f"no {s.kind} in POV-Ray's language")

    def rounded_box(self, s: Record, look: str) -> str:
        low, high = np.minimum(s.corner_a, s.corner_b), np.maximum(s.corner_a, s.corner_b)
        r = s.radius
        a, b = low + r, high - r
        parts = []
        for axis in range(3):
            grown = np.zeros(3)
            grown[axis] = r
            parts.append(f"box {{ {vector(a - grown)}, {vector(b + grown)} }}")
            others = [i for i in range(3) if i != axis]
            for corner in range(4):
                start = a.copy()
                for bit, i in enumerate(others):
                    start[i] = (a, b)[corner >> bit & 1][i]
                end = start.copy()
                end[axis] = b[axis]
                if b[axis] - a[axis] > 1e-9:
                    parts.append(f"cylinder {{ {vector(start)}, {vector(end)}, {number(r)} }}")
        for corner in range(8):
            center = [(a, b)[corner >> i & 1][i] for i in range(3)]
            parts.append(f"sphere {{ {vector(center)}, {number(r)} }}")
        return f"merge {{ {' '.join(parts)}{look} }}"

    def extrusion(self, s: Record, look: str) -> str:
        contours = [flattened(contour) for contour in s.profile]
        points = [p for contour in contours for p in [*contour, contour[0]]]
        listed = ", ".join(f"<{number(x)}, {number(y)}>" for x, y in points)
        # A prism is along y. This exchanges y and z.
        return (f"prism {{ linear_spline linear_sweep {number(s.start[2])}, {number(s.end[2])},"
                f" {len(points)}, {listed}{look}"
                " matrix <1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0> }")

    def revolution(self, s: Record, look: str) -> str:
        contour = flattened(s.profile[0])
        points = [(max(x, 0), y) for x, y in [*contour, contour[0]]]
        listed = ", ".join(f"<{number(x)}, {number(y)}>" for x, y in points)
        return f"lathe {{ linear_spline {len(points)}, {listed}{look} }}"

    def height_field(self, s: Record, look: str) -> str:
        self.fields += 1
        path = self.script.with_name(f"{self.script.stem}-heights{self.fields}.pgm")
        heights = np.round(65535 * np.array(s.heights)).astype(np.uint16)
        data_files.write_pgm(path, model.HeightField(heights, s.corner_a, s.corner_b))
        size = np.array(s.corner_b) - np.array(s.corner_a)
        return (f'height_field {{ pgm "{path.name}" smooth scale {vector(size)}'
                f" translate {vector(s.corner_a)}{look} }}")
