"""Compares imported parts with OpenSCAD's own meshes: compare.py CRT FOLDER [PART.scad ...]

CRT is the command. Each part is evaluated by `openscad` (which has to be installed) to a tree and
to a mesh, and imported by `crt import` twice: with facets, which must give the same solid, and with
round solids. FOLDER keeps what openscad has made, so that a second run is quick. Without parts it
takes the examples that come with OpenSCAD, which have to be in a folder that may be written to. A
table in Markdown goes to standard output. With --known a line for each part goes to a file: its
name, its volume, and the corners of its box, as openscad has them. tests/import/known.txt is that
of the trees in tests/import/parts.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
from dataclasses import dataclass, field

EXAMPLES = pathlib.Path("/usr/share/openscad/examples")
SECONDS = 300  # that openscad or crt may take for one part
RELATIVE_WIDTH = 1e-5  # of volumes that crt measures


@dataclass
class Solid:
    """A Solid is a volume and the corners of the box around it."""

    volume: float
    lower: list[float]
    upper: list[float]
    width: float = 0.0  # of the interval that surely holds the volume

    def size(self) -> float:
        return max(b - a for a, b in zip(self.lower, self.upper, strict=True))


@dataclass
class Row:
    """A Row is what was found for a part."""

    name: str
    notes: list[str] = field(default_factory=list)
    mesh: Solid | None = None
    faceted: Solid | None = None
    round: Solid | None = None
    lines: int = 0


def run(words: list[str]) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(words, capture_output=True, text=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(words, 1, "", f"took over {SECONDS} s")


def openscad(part: pathlib.Path, output: pathlib.Path) -> bool:
    """Makes a file of a part, unless it is there. Says whether there is one."""
    failed = output.with_suffix(output.suffix + ".failed")
    if not output.exists() and not failed.exists():
        result = run(["openscad", "-o", str(output), str(part)])
        if not output.exists():
            failed.write_text(result.stderr)
    return output.exists()


def solid_of_stl(path: pathlib.Path) -> Solid:
    numbers = re.findall(r"vertex\s+(\S+)\s+(\S+)\s+(\S+)", path.read_text())
    points = [tuple(float(x) for x in vertex) for vertex in numbers]
    # Sums about a corner lose fewer digits than those about an origin that is far away.
    base = points[0]
    volume = 0.0
    for i in range(0, len(points), 3):
        a, b, c = ([p[k] - base[k] for k in range(3)] for p in points[i : i + 3])
        volume += (
            a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
        )
    lower = [min(p[k] for p in points) for k in range(3)]
    upper = [max(p[k] for p in points) for k in range(3)]
    return Solid(volume / 6, lower, upper)


def in_openscad(lower: list[float], upper: list[float]) -> tuple[list[float], list[float]]:
    """Exchanges y and z, which are the other way round in the script."""
    return [lower[0], lower[2], lower[1]], [upper[0], upper[2], upper[1]]


def measured(crt: str, script: pathlib.Path) -> Solid | None:
    """Measures the first entity of a script, which is the part."""
    words = [crt, "measure", str(script), "--volume", "--bounds", "--json", "-q"]
    result = run([*words, "--relative-width", str(RELATIVE_WIDTH), "--seconds", "8"])
    if result.returncode != 0:
        return None
    entity = json.loads(result.stdout)["entities"][0]
    if "volume" not in entity:
        return None
    lower, upper = in_openscad(entity["bounds"]["lower"], entity["bounds"]["upper"])
    low, high = entity["volume"]
    return Solid((low + high) / 2, lower, upper, high - low)


def imported(
    crt: str, part: pathlib.Path, tree: pathlib.Path, row: Row, facets: bool
) -> Solid | None:
    """Imports a part beside its own files, and measures it."""
    local = part.parent / f"{part.stem}.imported.csg"
    script = local.with_suffix(".crt")
    try:
        local.write_bytes(tree.read_bytes())
        words = [crt, "import", str(local), "-o", str(script)]
        result = run(words + (["--facets"] if facets else []))
        if not facets:
            row.notes = sorted(set(re.findall(r"(?:error|warning): (.*)", result.stderr)))
        if result.returncode != 0:
            return None
        row.lines = len(script.read_text().splitlines())
        return measured(crt, script)
    finally:
        local.unlink(missing_ok=True)
        script.unlink(missing_ok=True)


def compare(crt: str, part: pathlib.Path, folder: pathlib.Path) -> Row:
    row = Row(part.stem)
    tree, mesh = folder / f"{part.stem}.csg", folder / f"{part.stem}.stl"
    if part.suffix == ".csg":
        tree = part
    elif not openscad(part, tree):
        row.notes.append("openscad makes no tree of it")
        return row
    if openscad(part, mesh):
        row.mesh = solid_of_stl(mesh)
    row.faceted = imported(crt, part, tree, row, True)
    row.round = imported(crt, part, tree, row, False)
    return row


def difference(solid: Solid | None, mesh: Solid | None) -> str:
    if solid is None:
        return "-"
    if mesh is None:
        return "no mesh"
    share = (solid.volume - mesh.volume) / mesh.volume
    return f"{share:+.1e} ± {solid.width / 2 / mesh.volume:.0e}"


def bounds_difference(solid: Solid | None, mesh: Solid | None) -> str:
    if solid is None or mesh is None:
        return "-"
    pairs = zip(solid.lower + solid.upper, mesh.lower + mesh.upper, strict=True)
    return f"{max(abs(a - b) for a, b in pairs) / mesh.size():.1e}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("crt")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("parts", nargs="*", type=pathlib.Path)
    parser.add_argument("--known", type=pathlib.Path)
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    parts = arguments.parts or sorted(EXAMPLES.glob("*/*.scad"))
    print("| part | lines | volume with facets | bounds | volume of round solids | notes |")
    print("| --- | --- | --- | --- | --- | --- |")
    known = []
    for part in parts:
        row = compare(arguments.crt, part.resolve(), arguments.folder.resolve())
        cells = [
            row.name,
            str(row.lines or "-"),
            difference(row.faceted, row.mesh),
            bounds_difference(row.faceted, row.mesh),
            difference(row.round, row.mesh),
            "; ".join(row.notes),
        ]
        print("| " + " | ".join(cells) + " |", flush=True)
        if row.mesh is not None:
            numbers = [row.mesh.volume, *row.mesh.lower, *row.mesh.upper]
            known.append(" ".join([row.name, *(f"{number:.9g}" for number in numbers)]) + "\n")
    if arguments.known:
        arguments.known.write_text("".join(known))


if __name__ == "__main__":
    sys.exit(main())
