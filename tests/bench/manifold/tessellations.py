"""Has Manifold check meshes of random solids: tessellations.py FOLDER [--count N] [--seed N]

FOLDER is where npm has installed manifold-3d. CRT_LIBRARY names the libcrt.so. The solids are
trees of primitives, half of them on a grid where faces coincide. It says of how many meshes
Manifold says that they are solids, how far their volumes are from CRT's, and how long they took.
It fails if one is no solid, or if its volume cannot be that of a mesh that is near enough.
"""

import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import time

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "python"))
import crt  # noqa: E402

SHARE = 0.01  # of a solid's size: the deviation that is asked for
SECONDS = 20


class Maker:
    """A Maker makes random solids."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng(seed)

    def place(self, on_grid: bool) -> np.ndarray:
        place = self.random.uniform(-2, 2, 3)
        return np.round(2 * place) / 2 if on_grid else place

    def primitive(self, on_grid: bool) -> crt.Entity:
        a = self.place(on_grid)
        size = self.random.uniform(0.5, 1.5)
        if on_grid:
            size = np.ceil(2 * size) / 2
        axis = np.eye(3)[self.random.integers(3)] if on_grid else self.random.normal(size=3)
        axis /= np.linalg.norm(axis)
        kind = self.random.integers(5)
        if kind == 0:
            return crt.Box(corner_a=a, corner_b=a + size)
        if kind == 1:
            return crt.Sphere(center=a, radius=size)
        if kind == 2:
            return crt.Cylinder(a, a + 2 * size * axis, radius=0.5 * size)
        if kind == 3:
            return crt.Cone(a, a + size * axis, radius=size, radius2=0.25 * size)
        return crt.Torus(center=a, axis=axis, radius=size, thickness=0.25 * size)

    def tree(self, depth: int, on_grid: bool) -> crt.Entity:
        if depth == 0:
            return self.primitive(on_grid)
        a = self.tree(depth - 1, on_grid)
        b = self.tree(self.random.integers(depth), on_grid)
        operation = self.random.integers(3)
        return a + b if operation == 0 else a - b if operation == 1 else a ^ b


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    lines, truths, deviations, seconds, open_ones = [], [], [], [], 0
    for number in range(options.count):
        maker = Maker(options.seed * 1_000_003 + number)
        solid = maker.tree(int(maker.random.integers(4)), on_grid=number % 2 == 0)
        low, high = solid.bounds
        size = float(np.max(np.asarray(high) - np.asarray(low)))
        if not size > 0:
            continue
        start = time.perf_counter()
        mesh = solid.tessellate(SHARE * size)
        seconds.append(time.perf_counter() - start)
        if len(mesh.triangles) == 0:
            continue
        open_ones += not np.isfinite(mesh.deviation)
        deviations.append(mesh.deviation)
        truths.append(solid.volume(relative_width=1e-4, seconds=SECONDS))
        lines.append(
            json.dumps(
                {
                    "positions": np.asarray(mesh.positions).ravel().tolist(),
                    "indices": np.asarray(mesh.triangles).ravel().tolist(),
                }
            )
        )
    command = ["node", str(HERE / "check_meshes.mjs"), str(options.folder)]
    done = subprocess.run(
        command, input="\n".join(lines) + "\n", stdout=subprocess.PIPE, check=True, text=True
    )
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    failed = 0
    used = []
    for number, (answer, truth, deviation) in enumerate(zip(answers, truths, deviations)):
        if answer["status"] != "NoError":
            failed += 1
            print(f"mesh {number}: Manifold says {answer['status']}")
            continue
        beyond = max(truth.lower - answer["volume"], answer["volume"] - truth.upper, 0)
        if not np.isfinite(deviation):
            continue
        # A layer of this thickness, with what is added at edges and corners.
        layer = 1.5 * deviation * answer["area"] + 1e-6 * abs(answer["volume"])
        used.append(beyond / layer)
        if beyond > layer:
            failed += 1
            print(f"mesh {number}: the volume is {answer['volume']}, not {truth}")
    print(
        f"{len(answers)} meshes, of which {open_ones} are not proved; {failed} failed. Seconds: "
        f"median {statistics.median(seconds):.3f}, longest {max(seconds):.1f}. Volumes are off by "
        f"{statistics.median(used):.3f} of the layer (median), {max(used):.3f} (most)."
    )
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
