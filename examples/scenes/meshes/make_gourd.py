#!/usr/bin/env python3
"""Writes gourd.obj, gourd.mtl and gourd.png beside itself: a ribbed gourd with a stalk. It has
normals and texture coordinates at its vertices, and two materials."""

import math
import pathlib
import struct
import zlib

PLACES = 28  # around the axis
RINGS = 12  # from pole to pole
RIBS = 7
STALK = [(0.13, 0.585), (0.105, 0.75), (0.12, 0.92)]  # radius and height

HERE = pathlib.Path(__file__).parent


def skin(turn: float, way: float) -> list[float]:
    """Returns a point of the skin, `way` of the whole way from the bottom to the top."""
    angle = math.pi * way
    radius = math.sin(angle) * (1 + 0.12 * math.cos(2 * angle))
    radius *= 1 + 0.07 * math.cos(RIBS * turn) * min(1, radius)
    height = -0.78 * math.cos(angle) - 0.22 * max(0.0, -math.cos(angle)) ** 6
    return [radius * math.sin(turn), height, radius * math.cos(turn)]


def stalk(turn: float, radius: float, height: float) -> list[float]:
    radius *= 1 + 0.18 * math.cos(5 * turn)
    return [radius * math.sin(turn), height, radius * math.cos(turn)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(a):
    length = math.hypot(*a)
    return [x / length for x in a]


def normal(turn: float, way: float) -> list[float]:
    step = 1e-4
    around = minus(skin(turn + step, way), skin(turn - step, way))
    upwards = minus(skin(turn, way + step), skin(turn, way - step))
    return unit(cross(upwards, around))


def slope(outer: list[float], inner: list[float], turn: float) -> list[float]:
    """Returns the normal of a cone's side between two points, one above the axis of the other."""
    around = [math.cos(turn), 0, -math.sin(turn)]
    return unit(cross(minus(inner, outer), around))


class Ring:
    """A Ring has the numbers of vertices around the axis, of their places in the picture and of
    their normals. The picture goes around twice."""

    def __init__(self, model, places, normals, height):
        self.places = model.add("v", places)
        self.normals = model.add("vn", normals)
        self.uv = model.add("vt", [[2 * k / PLACES, height] for k in range(PLACES + 1)])

    def corner(self, k: int) -> str:
        one = k % PLACES
        return f"{self.places + one}/{self.uv + k}/{self.normals + one}"


class Model:
    def __init__(self):
        self.lines = {"v": [], "vt": [], "vn": []}
        self.faces = []

    def add(self, kind, rows) -> int:
        first = len(self.lines[kind]) + 1
        for row in rows:
            self.lines[kind].append(" ".join([kind, *(f"{x:.4f}" for x in row)]))
        return first

    def join(self, lower: Ring, upper: Ring):
        for k in range(PLACES):
            corners = lower.corner(k), lower.corner(k + 1), upper.corner(k + 1), upper.corner(k)
            self.faces.append(" ".join(["f", *corners]))

    def close(self, ring: Ring, pole: list[float], side: int):
        """Closes the surface below (-1) or above (1) a ring."""
        place = self.add("v", [pole])
        direction = self.add("vn", [[0, side, 0]])
        for k in range(PLACES):
            pair = [ring.corner(k), ring.corner(k + 1)][::side]
            self.faces.append(f"f {pair[0]} {pair[1]} {place}/{ring.uv + k}/{direction}")


def write_model():
    model = Model()
    turns = [2 * math.pi * k / PLACES for k in range(PLACES)]
    rings = []
    for i in range(1, RINGS + 1):
        way = i / (RINGS + 1)
        places = [skin(turn, way) for turn in turns]
        rings.append(Ring(model, places, [normal(turn, way) for turn in turns], way))
    model.faces.append("usemtl skin")
    model.close(rings[0], skin(0, 0), -1)
    for lower, upper in zip(rings, rings[1:]):
        model.join(lower, upper)
    foot_places = [stalk(turn, *STALK[0]) for turn in turns]
    slopes = [slope(place, foot, turn) for place, foot, turn in zip(places, foot_places, turns)]
    rings[-1].normals = model.add("vn", slopes)
    foot = Ring(model, foot_places, slopes, 1)
    model.join(rings[-1], foot)
    model.faces.append("usemtl stalk")
    outwards = [unit(stalk(turn, 1, 0)) for turn in turns]
    foot.normals = model.add("vn", outwards)
    below = foot
    for radius, height in STALK[1:]:
        above = Ring(model, [stalk(turn, radius, height) for turn in turns], outwards, 1)
        model.join(below, above)
        below = above
    below.normals = model.add("vn", [[0, 1, 0]] * PLACES)
    model.close(below, [0, STALK[-1][1] + 0.01, 0], 1)
    lines = ["# make_gourd.py has written this.", "mtllib gourd.mtl"]
    for kind in model.lines.values():
        lines += kind
    (HERE / "gourd.obj").write_text("\n".join(lines + model.faces) + "\n")
    (HERE / "gourd.mtl").write_text(
        "# make_gourd.py has written this.\n"
        "newmtl skin\nKd 0.9 0.5 0.1\nKs 0.3 0.3 0.3\nNs 40\nmap_Kd gourd.png\n"
        "newmtl stalk\nKd 0.13 0.17 0.05\n"
    )


def write_picture(width: int = 208, height: int = 96):
    """Writes stripes between the ribs, with ragged edges, yellow below and green above."""
    rows = bytearray()
    for y in range(height):
        up = 1 - (y + 0.5) / height
        rows.append(0)
        for x in range(width):
            turn = 2 * math.pi * (x + 0.5) / width
            wave = math.sin(23 * up + 3 * math.sin(turn)) + math.sin(41 * up - 2 * math.cos(turn))
            stripe = math.cos(RIBS / 2 * turn) ** 2 + 0.09 * wave
            green = min(1.0, max(0.0, 6 * (stripe - 0.62))) * min(1.0, max(0.0, 3 * up - 0.7))
            colors = zip((236, 150, 38), (38, 78, 30))
            rows += bytes(round(a + (b - a) * green) for a, b in colors)
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(bytes(rows), 9)), (b"IEND", b"")]
    data = b"\x89PNG\r\n\x1a\n"
    for kind, content in chunks:
        check = struct.pack(">I", zlib.crc32(kind + content))
        data += struct.pack(">I", len(content)) + kind + content + check
    (HERE / "gourd.png").write_bytes(data)


if __name__ == "__main__":
    write_model()
    write_picture()
