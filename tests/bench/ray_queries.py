"""Compares ray queries from Python with the same from C: ray_queries.py PROGRAM [SCENE.crt]

PROGRAM is ray_queries.c, built with the libcrt that CRT_LIBRARY names. Both ask a million rays, by
turns, so that what else the machine does falls on both.
"""

import pathlib
import statistics
import subprocess
import sys
import time

import numpy as np

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "python"))
import crt  # noqa: E402

SIDE, ROUNDS, REPETITIONS = 1000, 7, 3


def grid(side: int) -> np.ndarray:
    """Returns the rays of ray_queries.c."""
    place = 8 * (np.arange(side) + 0.5) / side - 4
    rays = crt.rays((side, side))
    rays["origin"][..., 0] = place[None, :]
    rays["origin"][..., 1] = place[:, None]
    rays["origin"][..., 2] = -20
    rays["direction"][..., 2] = 1
    return rays


def in_c(program: str, scene: pathlib.Path) -> float:
    command = [program, scene, str(SIDE), str(REPETITIONS)]
    return min(
        map(
            float,
            subprocess.run(command, capture_output=True, check=True, text=True).stdout.split(),
        )
    )


def in_python(prepared: crt.Prepared, rays: np.ndarray, hits: np.ndarray | None) -> float:
    seconds = []
    for _ in range(REPETITIONS):
        start = time.perf_counter()
        prepared.intersect(rays, out=hits)
        seconds.append(time.perf_counter() - start)
    return min(seconds)


def main() -> None:
    program = sys.argv[1]
    scene = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else SOURCE / "examples/scenes/chess.crt"
    prepared = crt.Scene.from_script(scene).prepare()
    rays = grid(SIDE)
    hits = prepared.intersect(rays)

    rounds = [
        (in_c(program, scene), in_python(prepared, rays, hits), in_python(prepared, rays, None))
        for _ in range(ROUNDS)
    ]
    c, python, allocating = map(statistics.median, zip(*rounds))
    print(
        f"{SIDE * SIDE} rays at {scene.name}, {np.isfinite(hits['t']).mean():.0%} of them hit"
        f" something"
    )
    print(f"C                          {c:.4f} s")
    print(f"Python, hits written again {python:.4f} s  {python / c:.3f} of C")
    print(f"Python, new hits           {allocating:.4f} s  {allocating / c:.3f} of C")


if __name__ == "__main__":
    main()
