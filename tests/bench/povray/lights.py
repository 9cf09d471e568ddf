"""Compares soft and bounced light: how long each program takes to the same error.

    lights.py --library build/release/lib/libcrt.so [--rounds 3] [--width 160] [area studio room]

Each program is compared with a reference of its own, in linear light, as both have their own idea
of what is right. Of CRT's settings the fastest counts that is as near to its reference as POV-Ray
is to POV-Ray's. Seconds are those of the processor, for tracing alone, so that a machine with
other work to do changes little."""

import argparse
import pathlib
import re
import statistics
import sys
import time
from dataclasses import dataclass

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from povray import pictures  # noqa: E402
from povray.light_scenes import SCENES, LightScene  # noqa: E402
from povray.programs import run  # noqa: E402
from trade.programs import binding  # noqa: E402

# The radiosity's time is that of its pretrace.
CPU_SECONDS = re.compile(r"using \d+ thread\(s\) with ([\d.]+) CPU-seconds")
POV_SETTINGS = (("-A",), ("+AM2", "+A0.1", "+R3"))
# The grids of each family, by samples of each light for each ray, and the finest last.
CRT_FAMILIES = (
    *([{"supersampling": n, "lightsamples": m} for n in (1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 16, 20)]
      for m in (1, 2, 4)),
    [{"targeterror": n / 255, "minsamples": 4} for n in (24, 16, 12, 8, 6, 4, 3, 2)],
)


@dataclass(frozen=True)
class Picture:
    pixels: np.ndarray  # linear light, 0 to 1
    seconds: float


@dataclass(frozen=True)
class Contest:
    scene: LightScene
    crt: object  # the Python package
    folder: pathlib.Path
    width: int
    threads: int

    @property
    def height(self) -> int:
        return self.width * 3 // 4

    def by_crt(self, settings: dict, seed: int = 1) -> Picture:
        prepared = self.crt.Scene.from_script(
            self.scene.crt, settings={"width": self.width, "height": self.height, **settings}
        ).prepare()
        begin = time.process_time()
        image = prepared.render(threads=self.threads, seed=seed)
        seconds = time.process_time() - begin
        return Picture(np.clip(image.pixels[..., :3].astype(float), 0, 1), seconds)

    def by_pov(self, options: tuple[str, ...], fine: bool = False) -> Picture:
        script = self.folder / f"{self.scene.name}.pov"
        script.write_text(self.scene.pov)
        picture = self.folder / f"{self.scene.name}.ppm"
        output = run(["povray", f"+I{script.name}", f"+O{picture.name}", "+FP16", "File_Gamma=1",
                      f"+W{self.width}", f"+H{self.height}", f"+WT{self.threads}", "-D", "-V",
                      f"Declare=Fine={int(fine)}", *options], None, self.folder)
        seconds = sum(float(found) for found in CPU_SECONDS.findall(output))
        return Picture(pictures.read_ppm(picture).astype(float) / 65535, seconds)


def rmse(a: Picture, b: Picture) -> float:
    return float(np.sqrt(((a.pixels - b.pixels) ** 2).mean()))


def say(text: str) -> None:
    print(text, flush=True)


def named(settings: dict) -> str:
    if "supersampling" in settings:
        return (f"{settings['supersampling']} x {settings['supersampling']},"
                f" lightsamples {settings['lightsamples']}")
    return f"target error {settings['targeterror'] * 255:.0f}/255"


def as_good(contest: Contest, reference: Picture, error: float) -> dict:
    """Returns the fastest settings whose error is at most this."""
    found = []
    for family in CRT_FAMILIES:
        for settings in family:
            picture = contest.by_crt(settings)
            if rmse(picture, reference) <= error:
                found.append((picture.seconds, settings))
                break
    if not found:
        raise SystemExit(f"no setting of CRT has an error of {error:.5f}")
    return min(found, key=lambda pair: pair[0])[1]


def measure(contest: Contest, rounds: int) -> None:
    scene = contest.scene
    crt_reference = contest.by_crt(scene.crt_reference, seed=2)
    pov_reference = contest.by_pov(scene.pov_reference, fine=True)
    apart = rmse(crt_reference, pov_reference)
    means = [float(picture.pixels.mean()) for picture in (crt_reference, pov_reference)]
    say(f"\n{scene.name}: {scene.about}, {contest.width} x {contest.height} pixels,"
        f" {contest.threads} threads")
    say(f"references: CRT {crt_reference.seconds:.0f} s, POV-Ray {pov_reference.seconds:.0f} s,"
        f" means {means[0]:.4f} and {means[1]:.4f}, RMSE of one to the other {apart:.4f}\n")
    say("| POV-Ray | s | RMSE | to CRT's | CRT | s | RMSE | times as fast |")
    say("|---|--:|--:|--:|---|--:|--:|--:|")
    for options in POV_SETTINGS:
        pov = [contest.by_pov(options)]
        error = rmse(pov[0], pov_reference)
        settings = as_good(contest, crt_reference, error)
        crt = []
        for _ in range(rounds):
            crt.append(contest.by_crt(settings))
            pov.append(contest.by_pov(options))
        ratio = statistics.median(p.seconds / c.seconds for p, c in zip(pov[1:], crt))
        pov_seconds = statistics.median(p.seconds for p in pov[1:])
        crt_seconds = statistics.median(c.seconds for c in crt)
        other = f"{rmse(pov[0], crt_reference):.4f}" if scene.alike else ""
        say(f"| {' '.join(options)} | {pov_seconds:.2f} | {error:.4f} | {other} | {named(settings)}"
            f" | {crt_seconds:.3f} | {rmse(crt[0], crt_reference):.4f} | **{ratio:.1f}** |")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--library", type=pathlib.Path, required=True)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/bench/lights"))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--width", type=int, default=160)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("scenes", nargs="*")
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    crt = binding(options.library.resolve())
    for scene in SCENES:
        if not options.scenes or scene.name in options.scenes:
            contest = Contest(scene, crt, options.folder.resolve(), options.width, options.threads)
            measure(contest, options.rounds)


if __name__ == "__main__":
    main()
