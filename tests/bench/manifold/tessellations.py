"""Has Manifold check meshes of random solids: tessellations.py FOLDER [OPTION...]

FOLDER is where npm has installed manifold-3d. CRT_LIBRARY names the libcrt.so. The solids are
those of trees.py. It says of how many meshes Manifold says that they are solids, how far their
volumes are from CRT's, how far points of both surfaces are from each other, and how long they took.
Solids that take longer than --seconds are counted. Of the first solids, --openscad says how many,
OpenSCAD makes meshes, too, and their triangles are compared. It tells how far it is on standard
error. Ctrl-C ends it with a sum of what was done.
It fails if a mesh is no solid, if its volume cannot be that of a mesh that is near enough, or if a
point is farther off than was proved.
"""

import argparse
import json
import pathlib
import signal
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from typing import Any

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[2] / "python")]
import openscad  # noqa: E402
from trees import Tree, entity, random_tree  # noqa: E402

import crt  # noqa: E402

SHARE = 0.01  # of a solid's size: the deviation that is asked for
POINTS = 64  # of each surface, whose distance from the other is asked for
ROUNDING = 1e-9  # of a solid's size: how well these distances are known


class Manifold:
    """A Manifold is asked about one mesh after the other."""

    def __init__(self, folder: pathlib.Path) -> None:
        command = ["node", str(HERE / "check_meshes.mjs"), str(folder)]
        self.process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def check(self, positions: np.ndarray, triangles: np.ndarray) -> dict[str, Any]:
        """Returns what it says of a mesh: its status, volume, area and genus."""
        assert self.process.stdin and self.process.stdout
        mesh = {"positions": positions.ravel().tolist(), "indices": triangles.ravel().tolist()}
        self.process.stdin.write(json.dumps(mesh) + "\n")
        self.process.stdin.flush()
        return dict(json.loads(self.process.stdout.readline()))

    def close(self) -> None:
        self.process.communicate()


@dataclass
class Account:
    """An Account has what was found so far."""

    asked: int = 0
    empty: int = 0
    slow: int = 0  # of these no mesh is known to be near enough
    unproved: int = 0
    meshes: int = 0
    closed: int = 0
    manifold: int = 0
    sampled: int = 0  # points
    unsampled: int = 0  # surfaces whose points took too long
    failures: list[str] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)
    layers: list[float] = field(default_factory=list)  # how far volumes are off, in layers
    reached: list[float] = field(default_factory=list)  # the farthest points, in deviations
    rivals: list[tuple[int, int]] = field(default_factory=list)  # triangles, and OpenSCAD's
    slow_rivals: int = 0

    def report(self) -> str:
        lines = [
            f"{self.asked} solids, of which {self.empty} are empty and {self.slow} took too long.",
            f"Of {self.meshes} meshes {self.closed} are closed, {self.manifold} are solids to"
            f" Manifold, {self.unproved} are not proved to be near enough;"
            f" {len(self.failures)} failed.",
        ]
        if self.seconds:
            typical, longest = statistics.median(self.seconds), max(self.seconds)
            lines.append(f"Seconds: median {typical:.3f}, longest {longest:.1f}.")
        if self.layers:
            typical, most = statistics.median(self.layers), max(self.layers)
            lines.append(f"Volumes are off by {typical:.3f} of the layer (median), {most:.3f}.")
        if self.reached:
            typical, most = statistics.median(self.reached), max(self.reached)
            lines.append(
                f"Of {self.sampled} points the farthest of a mesh are off by {typical:.3f} of the"
                f" deviation that is proved (median), {most:.3f} at most. Those of"
                f" {self.unsampled} surfaces took too long."
            )
        if self.rivals:
            shares = [own / other for own, other in self.rivals]
            own, other = (sum(count) for count in zip(*self.rivals))
            lines.append(
                f"Of {len(shares)} meshes beside OpenSCAD's ({self.slow_rivals} more took that too"
                f" long) the triangles are {statistics.median(shares):.2f} times as many (median),"
                f" {max(shares):.2f} at most, {own / other:.2f} all together."
            )
        return "\n".join(lines)


def is_closed(triangles: np.ndarray) -> bool:
    """Says whether each edge is one of two triangles, once in each direction."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    ways = edges[:, 0].astype(np.int64) * (edges.max() + 1) + edges[:, 1]
    back = edges[:, 1].astype(np.int64) * (edges.max() + 1) + edges[:, 0]
    return len(np.unique(ways)) == len(ways) and np.array_equal(np.sort(ways), np.sort(back))


def points_of_mesh(mesh: crt.SurfaceMesh, random: np.random.Generator) -> np.ndarray:
    corners = np.asarray(mesh.positions)[np.asarray(mesh.triangles)]
    areas = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    chosen = corners[random.choice(len(corners), POINTS, p=areas / areas.sum())]
    return np.einsum("ij,ijk->ik", random.dirichlet((1, 1, 1), POINTS), chosen)


def points_of_solid(
    solid: crt.Entity, low: np.ndarray, high: np.ndarray, random: np.random.Generator
) -> np.ndarray:
    """Returns where rays from around a solid hit it."""
    ways = random.normal(size=(2 * POINTS, 3))
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    origins = random.uniform(low, high, ways.shape) - 2 * np.linalg.norm(high - low) * ways
    reach, _ = crt.Scene([solid]).prepare().distances(crt.rays(origins, ways))
    hit = np.isfinite(reach)
    return (origins[hit] + reach[hit, None] * ways[hit])[:POINTS]


def farthest(
    solid: crt.Entity, points: np.ndarray, seconds: float
) -> tuple[float, float] | None:
    """Returns how far the farthest point is from a surface. It is at most the first number, and
    the second one is how far that may be too much. It is None if that took too long."""
    if not len(points):
        return 0.0, 0.0
    start = time.perf_counter()
    found = np.abs(solid.distance(points, relative_width=1e-3, seconds=seconds).distance)
    if time.perf_counter() - start >= seconds:
        return None
    return float(found.max()), 1e-3 * float(found.max())


def look_at(
    tree: Tree, number: int, options: argparse.Namespace, manifold: Manifold, account: Account
) -> None:
    """Makes the mesh of a solid, and takes it into the account."""
    solid = entity(tree)
    account.asked += 1
    low, high = solid.bounds
    size = float(np.max(high - low))
    if not size > 0:
        account.empty += 1
        return
    start = time.perf_counter()
    mesh = solid.tessellate(SHARE * size, seconds=options.seconds)
    taken = time.perf_counter() - start
    account.seconds.append(taken)
    is_proved = bool(np.isfinite(mesh.deviation))
    if not is_proved and taken >= options.seconds:
        account.slow += 1
    elif not is_proved:
        account.unproved += 1
    triangles = np.asarray(mesh.triangles)
    if len(triangles) == 0:
        account.empty += 1
        return
    account.meshes += 1
    fail = lambda text: account.failures.append(f"solid {number}: {text}")  # noqa: E731
    if is_closed(triangles):
        account.closed += 1
    else:
        fail("its mesh is not closed")
    answer = manifold.check(np.asarray(mesh.positions), triangles)
    if answer["status"] != "NoError":
        fail(f"Manifold says {answer['status']}")
        return
    account.manifold += 1
    if not is_proved:
        return
    check_volume(solid, mesh, answer, options.seconds, account, fail)
    check_deviation(solid, mesh, number, options.seconds, account, fail)


def check_volume(
    solid: crt.Entity, mesh: Any, answer: Any, seconds: float, account: Account, fail: Any
) -> None:
    truth = solid.volume(relative_width=1e-4, seconds=seconds)
    beyond = max(truth.lower - answer["volume"], answer["volume"] - truth.upper, 0)
    # A layer of this thickness, with what is added at edges and corners.
    layer = 1.5 * mesh.deviation * answer["area"] + 1e-6 * abs(answer["volume"])
    account.layers.append(beyond / layer)
    if beyond > layer:
        fail(f"the volume is {answer['volume']}, not {truth}")


def check_deviation(
    solid: crt.Entity, mesh: Any, number: int, seconds: float, account: Account, fail: Any
) -> None:
    random = np.random.default_rng([number, 1])
    low, high = solid.bounds
    of_solid = points_of_solid(solid, low, high, random)
    pairs = [
        ("of the mesh", solid, points_of_mesh(mesh, random)),
        ("of the solid", crt.Mesh(mesh.positions, mesh.triangles), of_solid),
    ]
    for name, other, points in pairs:
        far = farthest(other, points, seconds)
        if far is None:
            account.unsampled += 1
            continue
        reach, unsure = far
        account.sampled += len(points)
        account.reached.append((reach - unsure) / mesh.deviation if mesh.deviation > 0 else 0)
        if reach - unsure > mesh.deviation + ROUNDING * float(np.max(high - low)):
            fail(f"a point {name} is {reach} away, not {mesh.deviation}")


def compare_with_openscad(
    tree: Tree, options: argparse.Namespace, manifold: Manifold, account: Account
) -> None:
    solid = entity(tree)
    low, high = solid.bounds
    size = float(np.max(high - low))
    if not size > 0:
        return
    own = len(solid.tessellate(SHARE * size, seconds=options.seconds).triangles)
    other = openscad.triangles(tree, SHARE * size, options.openscad_seconds)
    if other is None:
        account.slow_rivals += 1
    elif own > 0 and other > 0:
        account.rivals.append((own, other))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="where manifold-3d is installed")
    parser.add_argument("--count", type=int, default=200, help="how many solids")
    parser.add_argument("--first", type=int, default=0, help="the number of the first one")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=20, help="for each answer")
    parser.add_argument("--openscad", type=int, default=0, help="of how many it makes meshes")
    parser.add_argument("--openscad-seconds", type=float, default=60)
    options = parser.parse_args()
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    account, manifold, shown = Account(), Manifold(options.folder), 0
    reported = time.monotonic()
    try:
        for number in range(options.first, options.first + options.count):
            tree = random_tree(options.seed, number)
            look_at(tree, number, options, manifold, account)
            if number < options.first + options.openscad:
                compare_with_openscad(tree, options, manifold, account)
            for failure in account.failures[shown:]:
                print(failure, flush=True)
            shown = len(account.failures)
            if time.monotonic() - reported > 10:
                reported = time.monotonic()
                print(f"[{account.asked} of {options.count}]", account.report(), file=sys.stderr)
    except KeyboardInterrupt:
        print("It was interrupted.")
    print(account.report())
    return 1 if account.failures else 0


if __name__ == "__main__":
    sys.exit(main())
