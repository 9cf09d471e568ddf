"""Compares CRT with Cycles: the processor's time that each needs to the same error.

    compare.py --crt build/release/bin/crt [OPTION...]

Needs the programs crt and blender (Debian: apt install --no-install-recommends blender) and NumPy.
Both render the same rooms with the same number of threads, by turns. Each is compared with a
reference of its own, in linear light. It fails if the means of both references are more than a
hundredth apart. Times are seconds of the processor in user mode, without what a program does
however few samples it takes. A room takes some six minutes of the processor. The table on standard
output is for docs/speed.md, and what it is made of goes into build/bench/cycles.
"""

import argparse
import dataclasses
import json
import math
import pathlib
import resource
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from cycles import exr, rooms  # noqa: E402
from povray.programs import Failed, Size, run  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[3]
SAMPLES = (16, 64, 256)
ALIKE = 0.01  # what the means of the references may differ by
LEAST = 4  # samples of the rendering that is taken off
HALVES = (1001, 1002)  # seeds of the two halves of a reference


@dataclass(frozen=True)
class Rendered:
    picture: np.ndarray
    seconds: float  # of the processor, with all that is done before


@dataclass(frozen=True)
class Bench:
    crt: pathlib.Path
    folder: pathlib.Path
    size: Size
    threads: int
    begin: float

    def say(self, text: str) -> None:
        print(f"[{time.monotonic() - self.begin:7.1f} s] {text}", file=sys.stderr, flush=True)


def crt_settings(is_grid: bool, samples: int) -> list:
    if is_grid:
        return ["--supersampling", math.isqrt(samples)]
    return ["--targeterror", 1e-9, "--minsamples", samples, "--maxsamples", samples]


def by_crt(
    bench: Bench, name: str, seed: int, samples: tuple[int, ...], is_grid: bool = False
) -> list[Rendered]:
    script, picture = bench.folder / f"{name}.crt", bench.folder / f"{name}-crt.exr"
    script.write_text(rooms.script(rooms.ROOMS[name]()))
    results = []
    for count in samples:
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        run([bench.crt, "render", script, "-o", picture, "--quiet", "--width", bench.size.width,
             "--height", bench.size.height, "--threads", bench.threads, "--seed", seed,
             *crt_settings(is_grid, count)], None, bench.folder)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        results.append(Rendered(exr.read(picture), seconds))
    return results


def by_cycles(bench: Bench, name: str, seed: int, samples: tuple[int, ...]) -> list[Rendered]:
    """Renders in one process, as Blender itself takes a second of the processor to begin."""
    pictures = [bench.folder / f"{name}-cycles-{count}.exr" for count in samples]
    times, job = bench.folder / f"{name}-times.json", bench.folder / f"{name}-job.json"
    job.write_text(json.dumps({
        "room": rooms.ROOMS[name](), "width": bench.size.width, "height": bench.size.height,
        "threads": bench.threads, "bounces": rooms.BOUNCES,
        "metal_roughness": rooms.METAL_ROUGHNESS, "times": str(times), "renderings": [
            {"samples": count, "seed": seed, "picture": str(picture)}
            for count, picture in zip(samples, pictures, strict=True)
        ]}))
    run(["blender", "-b", "-noaudio", "--python-exit-code", 1, "-P",
         pathlib.Path(__file__).with_name("in_blender.py"), "--", job], None, bench.folder)
    seconds = json.loads(times.read_text())
    return [Rendered(exr.read(picture), each)
            for picture, each in zip(pictures, seconds, strict=True)]


Renderer = Callable[[Bench, str, int, tuple[int, ...]], list[Rendered]]
FAMILIES: dict[str, Renderer] = {
    "Cycles": by_cycles,
    "CRT": by_crt,
    "CRT, grid": lambda *arguments: by_crt(*arguments, is_grid=True),
}


def counted(room: rooms.Room, size: Size) -> np.ndarray:
    """Returns which pixels count: not those about the light, which Cycles hides from the camera."""
    camera, light = room["camera"], room["light"]
    forward = np.subtract(camera["pointing"], camera["position"])
    forward = forward / np.linalg.norm(forward)
    right = np.cross((0, 1, 0), forward)
    right /= np.linalg.norm(right)
    axes = np.array([right, -np.cross(forward, right), forward])
    corners = np.array([np.add(light["corner"], (x * light["x"], 0, z * light["z"]))
                        for x in (0, 1) for z in (0, 1)]) - camera["position"]
    across, down, along = axes @ corners.T
    if along.min() <= 0:
        raise ValueError("the light reaches behind the camera")
    scale = size.height / 2 / math.tan(math.radians(camera["fov"]) / 2)
    x = size.width / 2 + scale * across / along
    y = size.height / 2 + scale * down / along
    count = np.ones((size.height, size.width), bool)
    count[max(math.floor(y.min()) - 1, 0):max(math.ceil(y.max()) + 1, 0),
          max(math.floor(x.min()) - 1, 0):max(math.ceil(x.max()) + 1, 0)] = False
    return count


def mean_square(a: np.ndarray, b: np.ndarray) -> float:
    return float(((a - b) ** 2).mean())


@dataclass(frozen=True)
class Yardstick:
    """A Yardstick compares with a reference, within the light's radiance, where pixels count."""

    counts: np.ndarray
    brightest: float
    reference: np.ndarray
    uncertainty: float  # of the reference: the mean of the squares

    def rmse(self, picture: np.ndarray) -> float:
        square = mean_square(clipped(picture, self.counts, self.brightest), self.reference)
        return math.sqrt(max(square - self.uncertainty, 0))


def clipped(picture: np.ndarray, counts: np.ndarray, brightest: float) -> np.ndarray:
    return np.minimum(picture[counts], brightest)


def yardstick(bench: Bench, name: str, family: str, samples: int) -> Yardstick:
    """Renders a reference: the mean of two halves with different random numbers."""
    room = rooms.ROOMS[name]()
    counts, brightest = counted(room, bench.size), max(room["light"]["radiance"])
    halves = []
    for seed in HALVES:
        kept = bench.folder / f"{name}-{family}-{samples}-{bench.size.width}-{seed}.npy"
        if not kept.exists():
            np.save(kept, FAMILIES[family](bench, name, seed, (samples,))[0].picture)
            bench.say(f"{name}: half of the reference of {family}")
        halves.append(clipped(np.load(kept), counts, brightest))
    return Yardstick(counts, brightest, (halves[0] + halves[1]) / 2, mean_square(*halves) / 4)


@dataclass
class Point:
    """A Point is a number of samples, and what each round found."""

    seconds: list[float] = dataclasses.field(default_factory=list)
    rmse: list[float] = dataclasses.field(default_factory=list)

    def median(self) -> tuple[float, float]:
        return statistics.median(self.seconds), statistics.median(self.rmse)


def time_to(error: float, points: list[tuple[float, float]]) -> float:
    """Returns the seconds to this error, on the lines between the points in logarithms. Beyond the
    points the first or the last line goes on."""
    logs = [(math.log(seconds), math.log(rmse)) for seconds, rmse in points]
    for (t0, e0), (t1, e1) in zip(logs, logs[1:]):
        if math.log(error) >= e1 or (t1, e1) == logs[-1]:
            return math.exp(t0 + (math.log(error) - e0) * (t1 - t0) / (e1 - e0))
    raise ValueError("one point makes no line")


def measure(bench: Bench, name: str, rounds: int, reference_samples: int) -> dict:
    """Measures a room, and writes what is known of it after each round."""
    own = {
        family: yardstick(bench, name, family, reference_samples) for family in ("CRT", "Cycles")
    }
    means = {family: float(each.reference.mean()) for family, each in own.items()}
    if abs(means["CRT"] / means["Cycles"] - 1) > ALIKE:
        raise Failed(f"the references of {name} differ: {means}")
    result = {
        "about": rooms.ROOMS[name]()["about"], "means": means,
        "apart": math.sqrt(mean_square(own["CRT"].reference, own["Cycles"].reference)),
        "uncertainty": {family: math.sqrt(each.uncertainty) for family, each in own.items()},
    }
    yardsticks = {**own, "CRT, grid": own["CRT"]}
    found = {family: {count: Point() for count in SAMPLES} for family in FAMILIES}
    for turn in range(rounds):
        for family, renderer in FAMILIES.items():
            least, *rest = renderer(bench, name, turn + 1, (LEAST, *SAMPLES))
            for count, rendered in zip(SAMPLES, rest, strict=True):
                seconds = (rendered.seconds - least.seconds) * count / (count - LEAST)
                found[family][count].seconds.append(seconds)
                found[family][count].rmse.append(yardsticks[family].rmse(rendered.picture))
                bench.say(f"{name}: {family}, {count} samples: {seconds:.2f} s,"
                          f" RMSE {found[family][count].rmse[-1]:.5f}")
        result["points"] = {
            family: {str(count): dataclasses.asdict(point) for count, point in each.items()}
            for family, each in found.items()
        }
        result["medians"] = {
            family: {str(count): point.median() for count, point in each.items()}
            for family, each in found.items()
        }
        (bench.folder / f"{name}-results.json").write_text(json.dumps(result, indent=1))
    return result


def table(results: dict[str, dict]) -> str:
    lines = [
        "| room | samples | Cycles, s | RMSE | CRT, s | RMSE | to that RMSE, s | ratio |"
        " by grid, s | ratio |",
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|",
    ]
    for name, result in results.items():
        medians = result["medians"]
        for count, (seconds, rmse) in medians["Cycles"].items():
            own_seconds, own_rmse = medians["CRT"][count]
            needed, by_grid = (time_to(rmse, list(medians[family].values()))
                               for family in ("CRT", "CRT, grid"))
            lines.append(
                f"| `{name}` | {count} | {seconds:.3g} | {rmse:.4f} | {own_seconds:.3g} |"
                f" {own_rmse:.4f} | {needed:.3g} | **{seconds / needed:.2f}** | {by_grid:.3g} |"
                f" **{seconds / by_grid:.2f}** |"
            )
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--crt", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--room", choices=rooms.ROOMS, action="append", help="only this room")
    parser.add_argument("--width", type=int, default=160)
    parser.add_argument("--height", type=int, default=120)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--reference", type=int, default=1024, help="samples of each of two halves")
    parser.add_argument("--folder", type=pathlib.Path, default=SOURCE / "build/bench/cycles")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    bench = Bench(options.crt.resolve(), options.folder.resolve(),
                  Size(options.width, options.height), options.threads, time.monotonic())
    names = options.room or rooms.ROOMS
    print(table({name: measure(bench, name, options.rounds, options.reference) for name in names}))


if __name__ == "__main__":
    main()
