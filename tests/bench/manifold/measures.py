"""Measures solids by CRT, Manifold and OpenSCAD: measures.py FOLDER [OPTION...]

FOLDER is where npm has installed manifold-3d. CRT_LIBRARY names the libcrt.so. OpenSCAD is asked if
it is installed. The questions are the volumes of many primitives and of a flange, and how near two
parts are. CRT is asked to relative widths, and the others for facets within a deviation, as a share
of the solid's size. Each row is an answer: how wide CRT's proved interval is, or how far the others
are off the middle of the narrowest one, both relative to it. Seconds are those of all processors
together, so that other programs that run meanwhile count little.
"""

import argparse
import json
import math
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path[:0] = [str(HERE), str(ROOT / "python")]
from openscad import segments  # noqa: E402
from trees import Part  # noqa: E402

import crt  # noqa: E402

ROUNDS = 3  # of which the fastest counts; fewer if they take long
MOST_SECONDS = 10
KINDS = ("box", "sphere", "cylinder", "cone", "torus")


@dataclass
class Solid:
    """A Solid is made of parts that are joined, without those that are cut off."""

    joined: list[Any]
    cut: list[Any] = field(default_factory=list)


@dataclass
class Turned:
    """A Turned is a profile about z, of corners [x, z] or [x, z, bulge], as CRT has them."""

    profile: list[list[float]]


@dataclass
class Rod:
    """A Rod is a cylinder along z."""

    at: tuple[float, float]
    low: float
    high: float
    radius: float


@dataclass
class Block:
    low: tuple[float, float, float]
    high: tuple[float, float, float]


@dataclass
class Question:
    name: str
    solids: list[Solid]
    own: Callable[[float], crt.Interval]  # asks CRT, to a relative width
    widths: tuple[float, ...]  # that are asked for
    deviations: tuple[float, ...]  # of the facets of others, in sizes of the solid
    size: float


# ---- facets ----


def turn_to(axis: np.ndarray) -> np.ndarray:
    """Returns a matrix that turns z to an axis."""
    z = axis / np.linalg.norm(axis)
    x = np.cross(np.eye(3)[np.argmin(np.abs(z))], z)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(z, x), z])


def matrix(linear: np.ndarray, at: Any) -> np.ndarray:
    whole = np.eye(4)
    whole[:3, :3] = linear
    whole[:3, 3] = at
    return whole


def flat_profile(profile: list[list[float]], deviation: float) -> list[list[float]]:
    """Returns a profile whose arcs are as many lines as it takes."""
    corners: list[list[float]] = []
    for before, (x, z, *bulge) in zip([profile[-1], *profile], profile):
        if bulge and bulge[0] != 0:
            start, end = np.array(before[:2]), np.array([x, z])
            middle, way = (start + end) / 2, end - start
            # To the left of the chord, for a bulge above 0.
            rise = (1 - bulge[0] ** 2) / (4 * bulge[0])
            center = middle + rise * np.array([-way[1], way[0]])
            radius = float(np.linalg.norm(start - center))
            angle = 4 * math.atan(bulge[0])
            count = max(1, math.ceil(segments(radius, deviation) * abs(angle) / (2 * math.pi)))
            for i in range(1, count):
                c, s = math.cos(angle * i / count), math.sin(angle * i / count)
                corners.append(list(center + np.array([[c, -s], [s, c]]) @ (start - center)))
        corners.append([x, z])
    return corners


def shape(part: Any, deviation: float) -> dict[str, Any]:
    """Returns a part with facets whose corners are on its surface."""

    def turned(profile: list[list[float]], place: np.ndarray) -> dict[str, Any]:
        sides = segments(max(x for x, _ in profile), deviation)
        return {"kind": "turned", "profile": profile, "sides": sides, "matrix": place}

    if isinstance(part, Turned):
        return turned(flat_profile(part.profile, deviation), np.eye(4))
    if isinstance(part, Rod):
        ends = [[0, part.low], [part.radius, part.low], [part.radius, part.high], [0, part.high]]
        return turned(ends, matrix(np.eye(3), (*part.at, 0)))
    if isinstance(part, Block):
        size = np.array(part.high) - np.array(part.low)
        return {"kind": "cube", "matrix": matrix(np.diag(size), part.low)}
    r = part.size
    if part.kind == "box":
        return {"kind": "cube", "matrix": matrix(r * np.eye(3), part.at)}
    if part.kind == "sphere":
        sides = segments(r, deviation)
        return {"kind": "sphere", "sides": sides, "matrix": matrix(r * np.eye(3), part.at)}
    if part.kind == "torus":
        angles = 2 * math.pi * np.arange(count := segments(0.25 * r, deviation)) / count
        ring = np.column_stack([r + 0.25 * r * np.cos(angles), 0.25 * r * np.sin(angles)])
        return turned(ring.tolist(), matrix(turn_to(part.axis), part.at))
    bottom, top, height = (0.5 * r, 0.5 * r, 2 * r) if part.kind == "cylinder" else (r, 0.25 * r, r)
    ends = [[0, 0], [bottom, 0], [top, height], [0, height]]
    return turned(ends, matrix(turn_to(part.axis), part.at))


# ---- the programs ----


class Manifold:
    def __init__(self, folder: pathlib.Path) -> None:
        command = ["node", "--max-old-space-size=8000", str(HERE / "measures.mjs"), str(folder)]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def ask(self, solids: list[Solid], deviation: float, search: float) -> dict[str, float]:
        def shapes(parts: list[Any]) -> list[dict[str, Any]]:
            made = [shape(part, deviation) for part in parts]
            return [one | {"matrix": one["matrix"].T.ravel().tolist()} for one in made]

        question = {
            "solids": [{"joined": shapes(s.joined), "cut": shapes(s.cut)} for s in solids],
            "search": search,
        }
        assert self.process.stdin and self.process.stdout
        self.process.stdin.write(json.dumps(question) + "\n")
        self.process.stdin.flush()
        return dict(json.loads(self.process.stdout.readline()))


def scad(solid: Solid, deviation: float) -> str:
    def text(part: Any) -> str:
        made = shape(part, deviation)
        place = f"multmatrix({json.dumps(made['matrix'].tolist())}) "
        if made["kind"] == "cube":
            return place + "cube(1);"
        if made["kind"] == "sphere":
            return place + f"sphere(r=1, $fn={made['sides']});"
        profile = json.dumps(made["profile"])
        return place + f"rotate_extrude($fn={made['sides']}) polygon({profile});"

    joined, cut = (" ".join(map(text, parts)) for parts in (solid.joined, solid.cut))
    return f"difference() {{ union() {{ {joined} }} {cut} }}\n"


def by_openscad(solid: Solid, deviation: float, seconds: float) -> dict[str, float] | None:
    """Returns the volume of its mesh, or None if that took too long."""
    with tempfile.TemporaryDirectory() as folder:
        source, made = pathlib.Path(folder, "solid.scad"), pathlib.Path(folder, "solid.stl")
        source.write_text(scad(solid, deviation))
        command = ["openscad", "--quiet", "-o", str(made), str(source)]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        try:
            subprocess.run(command, timeout=seconds, capture_output=True, check=True)
        except subprocess.TimeoutExpired:
            return None
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        taken = after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime
        corners = [
            line.split()[1:] for line in made.read_text().splitlines() if "vertex" in line
        ]
        a, b, c = np.array(corners, float).reshape(-1, 3, 3).transpose(1, 0, 2)
        volume = float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)
        return {"value": volume, "triangles": len(a), "seconds": taken}


# ---- the questions ----


def cloud(seed: int, count: int, away: float = 0) -> list[Part]:
    """Returns primitives of which some overlap, as dense for any count, and moved along x."""
    random = np.random.default_rng(seed)
    half = 1.5 * count ** (1 / 3)
    made = []
    for number in range(count):
        at = random.uniform(-half, half, 3) + (away, 0, 0)
        axis = random.normal(size=3)
        size = float(random.uniform(0.5, 1.5))
        made.append(Part(KINDS[number % len(KINDS)], at, size, axis / np.linalg.norm(axis)))
    return made


def entity(solid: Solid) -> crt.Entity:
    whole = crt.union([part.entity() for part in solid.joined])
    return crt.difference(whole, [part.entity() for part in solid.cut]) if solid.cut else whole


def many(
    seed: int, count: int, widths: tuple[float, ...], deviations: tuple[float, ...]
) -> Question:
    parts = cloud(seed, count)
    fifth = count // 5
    solid = Solid(parts[fifth:], parts[:fifth])
    own = entity(solid)
    low, high = own.bounds
    return Question(
        f"volume of {count} primitives",
        [solid],
        lambda width: own.volume(relative_width=width, seconds=300),
        widths,
        deviations,
        float(np.max(high - low)),
    )


def flange() -> Question:
    """Returns the flange of examples/scenes/flange.crt, and the same for the others."""
    bulge = 1 - math.sqrt(2)
    profile = [[1.2, 0], [4.85, 0], [5, 0.15], [5, 0.85], [4.85, 1], [2.5, 1], [2, 1.5, bulge]]
    profile += [[2, 2.85], [1.85, 3], [1.2, 3]]
    angles = [2 * math.pi * i / 6 for i in range(6)]
    places = [(3.7 * math.cos(angle), 3.7 * math.sin(angle)) for angle in angles]
    holes: list[Any] = [Rod(at, -1, 2, 0.42) for at in places]
    counterbores: list[Any] = [Rod(at, 0.6, 2, 0.75) for at in places]
    keyway: list[Any] = [Block((-0.3, 0, -1), (0.3, 1.55, 4))]
    own = crt.Scene.from_file(str(ROOT / "examples/scenes/flange.crt")).entities[0]
    return Question(
        "volume of a flange",
        [Solid([Turned(profile)], holes + counterbores + keyway)],
        lambda width: own.volume(relative_width=width, seconds=300),
        (1e-4, 1e-6),
        (1e-3, 1e-4, 1e-5),
        10,
    )


def gap(seed: int) -> Question:
    solids = [Solid(cloud(seed + 1, 20)), Solid(cloud(seed + 2, 20, away=13))]
    a, b = map(entity, solids)
    return Question(
        "clearance of 20 and 20 primitives",
        solids,
        lambda width: a.clearance(b, relative_width=width, seconds=300).distance,
        (1e-4, 1e-6),
        (1e-3, 1e-4),
        10,
    )


def fastest(ask: Callable[[], crt.Interval]) -> tuple[float, crt.Interval]:
    taken: list[float] = []
    while len(taken) < ROUNDS and sum(taken) < MOST_SECONDS:
        start = time.process_time()
        answer = ask()
        taken.append(time.process_time() - start)
    return min(taken), answer


def rows(
    question: Question, manifold: Manifold, options: argparse.Namespace
) -> list[tuple[str, str, float, float, str]]:
    made: list[tuple[str, str, float, float, str]] = []
    middle = 1.0
    for width in question.widths:
        taken, answer = fastest(lambda: question.own(width))
        middle = (answer.lower + answer.upper) / 2
        made.append(("CRT", "", answer.width / middle, taken, ""))
    for share in question.deviations:
        deviation = share * question.size
        one = manifold.ask(question.solids, deviation, 1.1 * middle)
        off = one["value"] / middle - 1
        made.append(("Manifold", f"{share:g}", off, one["seconds"], f"{one['triangles']}"))
    if not shutil.which("openscad") or len(question.solids) > 1:
        return made
    for share in question.deviations:
        other = by_openscad(question.solids[0], share * question.size, options.openscad_seconds)
        if other is None:
            made.append(("OpenSCAD", f"{share:g}", math.nan, options.openscad_seconds, "too slow"))
            break
        off = other["value"] / middle - 1
        made.append(("OpenSCAD", f"{share:g}", off, other["seconds"], f"{other['triangles']}"))
    return made


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="where manifold-3d is installed")
    parser.add_argument("--seed", type=int, default=1, help="what the primitives are made from")
    parser.add_argument("--openscad-seconds", type=float, default=60)
    options = parser.parse_args()
    manifold = Manifold(options.folder)
    print("| | facets off by | triangles | error, or width | seconds |")
    print("|---|--:|--:|--:|--:|")
    questions = [
        many(options.seed, 100, (1e-4, 1e-6), (1e-3, 1e-4, 1e-5)),
        many(options.seed, 1000, (1e-3, 1e-4), (1e-3, 1e-4)),
        flange(),
        gap(options.seed),
    ]
    for question in questions:
        print(f"| **{question.name}** | | | | |")
        for name, share, off, taken, triangles in rows(question, manifold, options):
            error = "" if math.isnan(off) else f"{off:.1e}"
            seconds = f"over {taken:.0f}" if math.isnan(off) else f"{taken:.3g}"
            print(f"| {name} | {share} | {triangles} | {error} | {seconds} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
