"""Compares booleans of meshes with those of Manifold: compare.py FOLDER [--seed N]

FOLDER is where npm has installed manifold-3d. CRT_LIBRARY names the libcrt.so. What was found goes
to standard output: tables, and the booleans that differ. It fails if CRT may be wrong at one.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from typing import Any

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[2] / "python")]
import volumes  # noqa: E402
from booleans import Boolean, random_booleans  # noqa: E402
from solids import Mesh  # noqa: E402

SEED = 1
ROUNDS = 3  # of which the fastest counts
ERRORS = 5  # what a volume by rays may be off, in standard errors
ROUNDING = 1e-13  # what sums of rounded numbers may be off, of what is summed


@dataclass(frozen=True)
class Comparison:
    """A Comparison has what both programs say of a boolean."""

    family: str
    operations: list[str]
    triangles: int  # of all the solids
    manifold: dict[str, Any]  # what booleans.mjs has written
    measured: volumes.Volumes
    mesh_volume: float  # of the mesh that Manifold has made, by the divergence theorem
    count: float  # the volume by counting cells, if it is of voxel bodies
    by_cells: list[float]  # CRT's volume of these, along each axis
    size: float  # of the volumes that may cancel

    @property
    def tolerance(self) -> float:
        """Returns how much volume is within Manifold's tolerance of its surface."""
        return max(float(self.manifold["tolerance"]), 0) * float(self.manifold["area"])

    @property
    def by_rays(self) -> float:
        """Returns by how many standard errors the volumes differ, beyond the tolerance."""
        return self._errors(self.measured.whole, self.manifold["volume"])

    @property
    def excess(self) -> float:
        """Returns by how much CRT's volume is larger, as the same rays find through the boolean
        and Manifold's mesh."""
        return self.measured.excess.mean + self.mesh_volume - float(self.manifold["volume"])

    @property
    def by_excess(self) -> float:
        expected = self.manifold["volume"] - self.mesh_volume
        return self._errors(self.measured.excess, expected)

    def _errors(self, estimate: volumes.Estimate, expected: float) -> float:
        beyond = abs(estimate.mean - expected) - self.tolerance - ROUNDING * self.size
        if beyond <= 0:
            return 0
        return beyond / estimate.error if estimate.error else math.inf

    @property
    def is_manifold_exact(self) -> bool:
        return self._is_count(self.manifold["volume"])

    @property
    def is_exact(self) -> bool:
        return all(map(self._is_count, self.by_cells))

    def _is_count(self, volume: float) -> bool:
        return abs(volume - self.count) <= ROUNDING * self.size

    @property
    def is_manifold_wrong(self) -> bool:
        """Says whether a count of cells shows that Manifold is wrong, and CRT is right."""
        return bool(self.by_cells) and self.is_exact and not self.is_manifold_exact

    @property
    def agrees(self) -> bool:
        if self.manifold["status"] != "NoError" or self.manifold["broken"]:
            return False
        counted = not self.by_cells or (self.is_exact and self.is_manifold_exact)
        return counted and self.by_rays <= ERRORS and self.by_excess <= ERRORS


def by_manifold(booleans: list[Boolean], folder: pathlib.Path) -> list[dict[str, Any]]:
    lines = [
        json.dumps(
            {
                "meshes": [
                    {
                        "positions": mesh.positions.ravel().tolist(),
                        "indices": mesh.indices.ravel().tolist(),
                    }
                    for mesh in boolean.meshes
                ],
                "operations": boolean.operations,
            }
        )
        for boolean in booleans
    ]
    command = ["node", str(HERE / "booleans.mjs"), str(folder)]
    text = "\n".join(lines) + "\n"
    done = subprocess.run(command, input=text, stdout=subprocess.PIPE, check=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def compared(place: int, boolean: Boolean, manifold: dict[str, Any]) -> Comparison:
    positions = np.array(manifold.pop("positions"), np.float64)
    indices = np.array(manifold.pop("indices"), np.int64).reshape(-1, 3)
    mesh = Mesh(positions.reshape(-1, 3), indices)
    scene = volumes.prepared(volumes.solids(boolean.meshes), boolean.operations)
    return Comparison(
        family=boolean.family,
        operations=boolean.operations,
        triangles=sum(len(part.indices) for part in boolean.meshes),
        manifold=manifold,
        measured=volumes.by_rays(scene, boolean, mesh, np.random.default_rng(place)),
        mesh_volume=mesh.volume,
        count=boolean.grid.volume if boolean.grid else math.nan,
        by_cells=volumes.by_cells(scene, boolean.grid) if boolean.grid else [],
        size=sum(part.volume for part in boolean.meshes),
    )


def milliseconds(work: Callable[[], Any]) -> float:
    """Returns how long the fastest of some rounds takes."""
    taken = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        taken.append(time.perf_counter() - start)
    return 1000 * min(taken)


def times(boolean: Boolean) -> tuple[float, float]:
    """Returns how long CRT takes for the meshes, and to combine and prepare them."""
    parts = volumes.solids(boolean.meshes)
    return (
        milliseconds(lambda: volumes.solids(boolean.meshes)),
        milliseconds(lambda: volumes.prepared(parts, boolean.operations)),
    )


def table(heads: list[str], rows: Iterable[list[str]]) -> str:
    lines = [heads, ["---"] + ["---:"] * (len(heads) - 1), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def families(comparisons: list[Comparison]) -> dict[str, list[int]]:
    """Returns which comparisons are of each family, in order."""
    places: dict[str, list[int]] = {}
    for place, comparison in enumerate(comparisons):
        places.setdefault(comparison.family, []).append(place)
    return places


def agreement(comparisons: list[Comparison]) -> str:
    def row(name: str, places: list[int]) -> list[str]:
        given = [comparisons[place] for place in places]
        wholes = [c.measured.whole for c in given if c.measured.whole.mean > 0]
        relative = [whole.error / whole.mean for whole in wholes]
        layers = [abs(c.excess) / c.tolerance for c in given if c.tolerance > 0]
        return [
            name,
            f"{sum(c.agrees for c in given)} of {len(given)}",
            f"{statistics.median(relative):.1e}, {max(relative):.1e}",
            f"{max(c.by_rays for c in given):.1f}",
            f"{statistics.median(layers):.1e}, {max(layers):.1e}",
        ]

    heads = [
        "solids",
        "agree",
        "error by rays",
        "difference in errors",
        "by the same rays, in tolerances",
    ]
    return table(heads, (row(*item) for item in families(comparisons).items()))


def counted(comparisons: list[Comparison]) -> str:
    def worst(values: Iterable[float]) -> str:
        return f"{max(values):.1e}"

    def row(name: str, places: list[int]) -> list[str]:
        given = [comparisons[place] for place in places]
        return [
            name,
            f"{sum(c.is_exact for c in given)} of {len(given)}",
            worst(abs(v - c.count) for c in given for v in c.by_cells),
            f"{sum(c.is_manifold_exact for c in given)} of {len(given)}",
            worst(abs(c.manifold["volume"] - c.count) for c in given),
        ]

    heads = ["solids", "CRT exact", "largest error", "Manifold exact", "largest error"]
    groups = families(comparisons).items()
    return table(heads, (row(*item) for item in groups if comparisons[item[1][0]].by_cells))


def timed(comparisons: list[Comparison], own: list[tuple[float, float]]) -> str:
    def row(name: str, places: list[int]) -> list[str]:
        values = [
            (
                comparisons[place].triangles,
                comparisons[place].manifold["making"],
                comparisons[place].manifold["combining"],
                *own[place],
            )
            for place in places
        ]
        triangles, *rest = map(statistics.median, zip(*values))
        return [name, f"{triangles:.0f}", *(f"{value:.1f}" for value in rest)]

    heads = [
        "solids",
        "triangles",
        "Manifold: meshes",
        "boolean",
        "CRT: meshes",
        "prepare",
    ]
    return table(heads, (row(*item) for item in families(comparisons).items()))


def main() -> int:
    parser = argparse.ArgumentParser(description="Compares booleans of meshes with Manifold's.")
    parser.add_argument("folder", type=pathlib.Path, help="where manifold-3d is installed")
    parser.add_argument("--seed", type=int, default=SEED, help="what the booleans are made from")
    options = parser.parse_args()

    booleans = random_booleans(options.seed)
    manifold = by_manifold(booleans, options.folder)
    own = [times(boolean) for boolean in booleans]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        comparisons = list(pool.map(compared, range(len(booleans)), booleans, manifold))

    for text in (agreement(comparisons), counted(comparisons), timed(comparisons, own)):
        print(text)
    differing = [(place, c) for place, c in enumerate(comparisons) if not c.agrees]
    for place, c in differing:
        print(
            f"{place} {c.family}, {', '.join(c.operations)}: Manifold {c.manifold['volume']:.12g}"
            f" ({c.manifold['status']}), CRT {c.measured.whole.mean:.12g}"
            f" +- {c.measured.whole.error:.1e}, by the same rays {c.excess:.2e}"
            f" +- {c.measured.excess.error:.1e} more, by count {c.count:.12g}"
        )
    wrong = sum(c.is_manifold_wrong for _, c in differing)
    print(
        f"{len(comparisons) - len(differing)} of {len(comparisons)} agree, by"
        f" {sum(c.measured.rays for c in comparisons)} rays. A count of cells shows that CRT is"
        f" right in {wrong} of the other {len(differing)}."
    )
    return 0 if wrong == len(differing) else 1


if __name__ == "__main__":
    sys.exit(main())
