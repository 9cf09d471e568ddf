"""Measures what CRT costs its users, and compares it with figures.txt.

    figures.py --build build/release [--record] [NAME...]

A figure is how many instructions a small render, query or measure takes (callgrind counts them), or
what the first build of the command takes: how many headers are parsed, and for how many seconds
compilers run. NAME is a figure or how some begin. --record writes what was measured into the table.

Instructions depend on the compiler, on the versions of libraries and a little on the processor. So
compare with figures of the same machine: record them before a change and measure after it.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BENCH = pathlib.Path(__file__).resolve().parent
SOURCE = BENCH.parents[1]
TABLE = BENCH / "figures.txt"
HEAD = """\
# What CRT costs its users. `./dev figures` compares with this table, and `./dev figures --record`
# writes it: the instructions of small renders, queries and measures, and what the first build
# takes.
"""
TELLING = 0.03  # is the least share of a change that must have a reason
WIDTH, HEIGHT = 40, 30

# These are scenes of catalogue.py and of examples/scenes/, by figure.
RENDERS = {
    "render/lens-and-panorama": "lens-scene",
    "render/drops": "drops-300",
    "render/mirrors": "mirror-cabinet",
    "render/csg": "drilled-plate",
    "render/mesh": "mesh-1e4",
    "render/height-field": "height-field-512",
    "render/glass": "glass",
    "render/implicit": "gyroid.crt",
    "render/text": "lettering.crt",
}
# A figure of queries is what one function takes in ray_queries.c: scene, rays a side, kind.
QUERIES = {
    "query/single": ("crt_intersect", "chess.crt", 100, "single"),
    "query/batch": ("crt_intersect", "chess.crt", 100, "batch"),
    "query/crossings": ("crt_crossings", "chess.crt", 100, "crossings"),
    "prepare/spheres": ("crt_scene_prepare", "spheres-1e4", 1, "batch"),
    "prepare/panorama": ("crt_scene_prepare", "lens-scene", 1, "batch"),
    "script/10000-lines": ("crt_scene_from_script_file", "spheres-1e4", 1, "batch"),
}
# A figure of measures is what one function takes of `crt measure`: its name, the type of its
# options, the scene, and what is asked.
MEASURES = {
    "measure/volume": ("volume", "MeasureOptions", "scenes/flange.crt", "--volume"),
    "measure/area": ("surface_area", "MeasureOptions", "scenes/flange.crt",
                     "--area --relative-width 0.1"),
    "measure/mass": ("mass_properties", "MeasureOptions", "measure/housing.crt",
                     "--mass --relative-width 0.1"),
    "measure/wall": ("least_wall", "WallOptions", "measure/bracket.crt", "--thickness"),
}
BUILD = ("build/headers", "build/seconds")


class Bench:
    def __init__(self, build: pathlib.Path, folder: pathlib.Path) -> None:
        self.build = build.resolve()
        self.folder = folder

    def script(self, scene: str) -> pathlib.Path:
        if scene.endswith(".crt"):
            return SOURCE / "examples/scenes" / scene
        from povray import catalogue, crt_writer  # it needs NumPy
        path = self.folder / f"{scene}.crt"
        if not path.exists():
            with open(path, "w") as out:
                crt_writer.Writer(catalogue.SCENES[scene](), path).write(out)
        return path

    def instructions(self, inside: str, command: list) -> int:
        """Counts in calls of one function, on one thread, as what is beside that depends on the
        machine."""
        profile = self.folder / "callgrind.out"
        done = subprocess.run(
            ["taskset", "-c", "0", "valgrind", "--tool=callgrind", f"--toggle-collect={inside}",
             f"--callgrind-out-file={profile}", *map(str, command)],
            capture_output=True, text=True, cwd=self.folder)
        if done.returncode != 0:
            raise SystemExit(f"{command[0]} failed:\n{done.stderr[-2000:]}")
        return int(re.search(r"^(?:totals|summary): (\d+)", profile.read_text(), re.M).group(1))

    def measured(self, name: str) -> int:
        if name in RENDERS:
            return self.instructions("crt::render(*", [
                self.build / "bin/crt", "render", self.script(RENDERS[name]), "-o", "picture.png",
                "--width", WIDTH, "--height", HEIGHT, "--threads", 1, "--quiet"])
        if name in QUERIES:
            function, scene, side, kind = QUERIES[name]
            program = self.build / "bin/ray_queries"
            return self.instructions(function, [program, self.script(scene), side, 1, kind])
        if name in MEASURES:
            function, taking, scene, arguments = MEASURES[name]
            # A pattern would also name what is inside, where counting would end.
            whole_name = f"crt::{function}(crt::Entity const&, crt::{taking} const&)"
            return self.instructions(whole_name, [
                self.build / "bin/crt", "measure", SOURCE / "examples" / scene, *arguments.split(),
                "--threads", 1, "--quiet"])
        return headers(self.build) if name == "build/headers" else seconds(self.build)


def objects_of_command(build: pathlib.Path) -> set[str]:
    inputs = subprocess.run(["ninja", "-C", build, "-t", "inputs", "crt"], capture_output=True,
                            check=True, text=True)
    return {line for line in inputs.stdout.splitlines() if line.endswith((".o", ".gch"))}


def headers(build: pathlib.Path) -> int:
    """Counts the headers that compilers read, once for each source that includes them."""
    objects = objects_of_command(build)
    deps = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, check=True,
                          text=True)
    found = re.findall(r"^(\S+): #deps (\d+)", deps.stdout, re.M)
    return sum(int(count) - 1 for object_, count in found if object_ in objects)


def seconds(build: pathlib.Path) -> int:
    """Adds up how long each object took when it was built last. With ccache that means nothing."""
    objects = objects_of_command(build)
    last = {}
    for line in (build / ".ninja_log").read_text().splitlines()[1:]:
        start, end, _, output, _ = line.split("\t")
        if output in objects:
            last[output] = int(end) - int(start)
    return round(sum(last.values()) / 1000)


def read_table() -> dict[str, int]:
    if not TABLE.exists():
        return {}
    rows = (line.split() for line in TABLE.read_text().splitlines() if not line.startswith("#"))
    return {name: int(value) for name, value in rows}


def main() -> int:
    names = [*RENDERS, *QUERIES, *MEASURES, *BUILD]
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="where bin/ and lib/ are")
    parser.add_argument("--record", action="store_true", help="write them into the table")
    parser.add_argument("names", nargs="*", metavar="NAME", help="figures, or how some begin")
    options = parser.parse_args()
    chosen = [name for name in names if not options.names
              or any(name.startswith(begin) for begin in options.names)]
    if not chosen:
        parser.error(f"the figures are {', '.join(names)}")
    before = read_table()
    figures = dict(before)
    worse = []
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options.build, pathlib.Path(folder))
        for name in chosen:
            figures[name] = bench.measured(name)
            moved = figures[name] / before[name] - 1 if name in before else 0
            if moved > TELLING:
                worse.append(name)
            print(f"{name:26} {figures[name]:14} {moved:+7.1%}", flush=True)
    if options.record:
        rows = (f"{name:26} {figures[name]:14}\n" for name in names if name in figures)
        TABLE.write_text(HEAD + "".join(rows))
    elif worse:
        print(f"A commit that worsens a figure by {TELLING:.0%} says why: {', '.join(worse)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
