"""Measures a scene with both programs, by turns, and makes sure that they drew the same."""

import pathlib
import statistics
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass

from . import crt_writer, pictures, pov_writer
from .model import Scene
from .programs import Crt, PovRay, Size

STEPS = 6  # 8-bit steps that a pixel may differ by
MOST_DIFFERENT = 0.01  # of the pixels: rims, where the programs' roundings decide
NOISE_BLOCK, NOISE_STEPS = 16, 3  # of noisy pictures blocks of pixels are compared
FIRST_DIVISOR = 32  # of the sides of the first picture that a program's speed is guessed from
TELLING = 0.5  # seconds from which on a guess is good
LONGEST_PROBE = 120.0  # seconds


@dataclass(frozen=True)
class Plan:
    """A Plan says how to measure."""

    crt: pathlib.Path
    folder: pathlib.Path
    size: Size
    rounds: int
    threads: tuple[int, ...]
    # seconds; what would take longer is measured on a smaller picture, in a quarter of that
    longest: float
    patience: float  # seconds: no further round begins after that
    say: Callable[[str], None]
    tree: int = 1  # POV-Ray's bounding method


class DifferentPictures(Exception):
    pass


def write_scripts(scene: Scene, name: str, plan: Plan) -> tuple[Crt, PovRay]:
    plan.folder.mkdir(parents=True, exist_ok=True)
    crt_script, pov_script = (plan.folder / f"{name}.{ending}" for ending in ("crt", "pov"))
    with open(crt_script, "w") as out:
        crt_writer.Writer(scene, crt_script).write(out)
    with open(pov_script, "w") as out:
        pov_writer.Writer(scene, plan.size.width / plan.size.height, pov_script).write(out)
    return Crt(plan.crt, crt_script), PovRay(pov_script, scene.grid, plan.tree)


def fitting_divisor(program: Crt | PovRay, picture: pathlib.Path, plan: Plan) -> int:
    """Returns by what the picture's sides must be divided so that one thread does not take too
    long. It is 1 if the picture can be whole."""
    divisor = FIRST_DIVISOR
    while True:
        try:
            seconds = program.trace(plan.size.divided(divisor), 1, picture, LONGEST_PROBE)
        except subprocess.TimeoutExpired:
            if divisor > FIRST_DIVISOR:
                raise
            divisor *= 4
            continue
        if divisor == 1 or seconds > TELLING:
            break
        divisor = max(1, divisor // (4 if 16 * seconds < TELLING else 2))
    if seconds * divisor**2 <= plan.longest:
        return 1
    while divisor > 1 and 4 * seconds <= plan.longest / 4:
        divisor //= 2
        seconds *= 4
    return divisor


def compare(scene: Scene, crt: pathlib.Path, pov: pathlib.Path) -> pictures.Difference:
    a, b = pictures.read_ppm(crt), pictures.read_ppm(pov)
    if scene.noisy:
        return pictures.difference(a, b, NOISE_STEPS, NOISE_BLOCK)
    return pictures.difference(a, b, STEPS)


def measure(name: str, scene: Scene, plan: Plan) -> dict:
    crt, pov = write_scripts(scene, name, plan)
    crt_picture, pov_picture = (plan.folder / f"{name}-{program}.ppm" for program in ("crt", "pov"))
    crt_divisor = fitting_divisor(crt, crt_picture, plan)
    pov_divisor = fitting_divisor(pov, pov_picture, plan)

    # They are compared at the smaller of both sizes.
    common = plan.size.divided(max(crt_divisor, pov_divisor))
    crt.trace(common, max(plan.threads), crt_picture)
    pov.trace(common, max(plan.threads), pov_picture)
    difference = compare(scene, crt_picture, pov_picture)
    plan.say(
        f"{name}: {difference.share:.3%} of the pixels differ, {difference.mean:.3f} steps on"
        f" average"
    )
    if difference.share > MOST_DIFFERENT:
        raise DifferentPictures(
            f"{name}: {difference.share:.2%} of the pixels differ by more than {STEPS} steps"
            f" (allowed: {MOST_DIFFERENT:.0%}); see {crt_picture} and {pov_picture}")

    result = {"about": scene.about, "width": plan.size.width, "height": plan.size.height,
              "different_pixels": difference.share, "mean_steps": difference.mean, "threads": {}}
    seconds: dict[int, list[tuple[float, float]]] = {threads: [] for threads in plan.threads}
    begin = time.monotonic()
    for turn in range(plan.rounds):
        if turn > 0 and time.monotonic() - begin > plan.patience:
            break
        for threads in plan.threads:
            pair = tuple(
                program.trace(plan.size.divided(divisor), threads, picture)
                * plan.size.pixels / plan.size.divided(divisor).pixels
                for program, divisor, picture in (
                    (crt, crt_divisor, crt_picture), (pov, pov_divisor, pov_picture)
                ))
            seconds[threads].append(pair)
            plan.say(f"{name}, round {turn + 1} of {plan.rounds}, {threads} thread(s):"
                     f" crt {pair[0]:.3f} s, povray {pair[1]:.3f} s")
    for threads, pairs in seconds.items():
        result["threads"][str(threads)] = {
            "crt": statistics.median(pair[0] for pair in pairs),
            "povray": statistics.median(pair[1] for pair in pairs),
            "ratio": statistics.median(pair[1] / pair[0] for pair in pairs),
        }
    result["crt_divisor"], result["pov_divisor"] = crt_divisor, pov_divisor
    result["rounds"] = len(pairs)
    return result
