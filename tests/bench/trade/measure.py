"""Measures a scene: errors and times of all settings, and what there is to know of its pixels."""

import dataclasses
import os
import pathlib
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from povray import crt_writer, pov_writer, trade_scenes
from povray.model import Material, Scene
from povray.programs import Size

from . import errors, ladders, references
from .ladders import Rung
from .programs import Crt, PovRay, Rendered, binding

HARD_STEPS = 8  # a pixel is hard if rays through it differ by more than so many steps
RAYS_TO_JUDGE = 8  # in a row and in a column of a pixel
SHORT = 4.0  # seconds: what takes longer is rendered once
LONGEST = 15.0  # seconds: once a family takes longer, its finer settings are left out
OVERHEAD_SAMPLES = (16, 64, 256)  # a pixel, passes against the grid
OVERHEAD_SAMPLES_QUICK = (16,)
OVERHEAD_SCENES = ("flat", "hard")
VANISHING_SHARE = 0.05  # of a pixel
VANISHING_SEEDS = 8


@dataclass(frozen=True)
class Plan:
    library: pathlib.Path
    folder: pathlib.Path
    rounds: int
    patience: float  # seconds: no further round begins after that
    quick: bool
    say: Callable[[str], None]
    divisor: int = 1  # of the picture's sides


@dataclass(frozen=True)
class Contest:
    """A Contest is a scene written for both programs."""

    name: str
    scene: Scene
    crt: Crt
    pov: PovRay
    plan: Plan

    @property
    def with_lens(self) -> bool:
        return self.scene.camera.aperture > 0

    def render(self, rung: Rung) -> Rendered:
        return self.crt.render(rung.settings) if rung.is_crt else self.pov.render(rung.options)


def contest(name: str, plan: Plan) -> Contest:
    scene = trade_scenes.SCENES[name]()
    height = trade_scenes.height_of(name) // plan.divisor
    size = Size(height * 4 // 3, height)
    plan.folder.mkdir(parents=True, exist_ok=True)
    crt_script, pov_script = (plan.folder / f"{name}.{ending}" for ending in ("crt", "pov"))
    with open(crt_script, "w") as out:
        crt_writer.Writer(scene, crt_script).write(out)
    with open(pov_script, "w") as out:
        pov_writer.Writer(scene, size.width / size.height, pov_script).write(out)
    return Contest(
        name, scene, Crt(binding(plan.library), crt_script, size), PovRay(pov_script, size), plan
    )


@dataclass
class Measured:
    """Measured is what a setting takes and gives."""

    seconds: list[float] = dataclasses.field(default_factory=list)
    error: errors.PictureError = errors.PictureError(0, 0)
    samples: float = 0

    def row(self, rung: Rung) -> dict:
        return {"family": rung.family, "name": rung.name, **dataclasses.asdict(self.error),
                "samples": self.samples,
                "seconds": statistics.median(self.seconds), "rounds": len(self.seconds)}


def hard_share(match: Contest) -> float:
    """Returns the share of hard pixels by the rays that go through them: by the truth, not by what
    a renderer estimates."""
    side, size = RAYS_TO_JUDGE, match.crt.size
    rays = Size(side * size.width, side * size.height)
    image, _ = match.crt.image(
        {"supersampling": 1, "dofsamples": 2 if match.with_lens else 1}, size=rays
    )
    each = errors.shown(image.pixels).reshape(size.height, side, size.width, side, 3)
    ranges = (each.max(axis=(1, 3)) - each.min(axis=(1, 3))).max(axis=2)
    return float((ranges > HARD_STEPS).mean())


def measured_rungs(
    match: Contest, own: references.Reference, other: references.Reference
) -> list[dict]:
    plan = match.plan
    rungs = {rung: Measured() for rung in ladders.all_rungs(match.with_lens, plan.quick)}
    too_slow: set[str] = set()
    begin = time.monotonic()
    for turn in range(plan.rounds):
        if turn > 0 and time.monotonic() - begin > plan.patience:
            break
        for rung, measured in rungs.items():
            if rung.family in too_slow or (turn > 0 and measured.seconds[0] > SHORT):
                continue
            rendered = match.render(rung)
            measured.seconds.append(rendered.seconds)
            if turn > 0:
                continue
            measured.error = errors.difference(
                rendered.picture, (own if rung.is_crt else other).picture
            )
            measured.samples = rendered.samples
            if rendered.seconds > LONGEST:
                too_slow.add(rung.family)
            plan.say(f"{match.name}: {rung.family} {rung.name}: {rendered.seconds:.3f} s,"
                     f" {rendered.samples:.2f} samples, RMSE {measured.error.rmse:.3f},"
                     f" 99.9 % {measured.error.p999:.2f}")
    return [measured.row(rung) for rung, measured in rungs.items() if measured.seconds]


def overhead(match: Contest) -> list[dict]:
    return [
        overhead_at(match, count)
        for count in (OVERHEAD_SAMPLES_QUICK if match.plan.quick else OVERHEAD_SAMPLES)
    ]


def overhead_at(match: Contest, count: int) -> dict:
    """Compares passes with as many samples in every pixel as the grid, by turns with it. The
    fastest of each counts: both do the same each time, and only the rest of the machine makes it
    longer."""
    side = round(count**0.5)
    passes = {"targeterror": 1e-6, "minsamples": count, "maxsamples": count}
    seconds: dict[str, list[float]] = {"grid": [], "passes": []}
    for _ in range(1 if match.plan.quick else 9):
        seconds["grid"].append(match.crt.render({"supersampling": side}).seconds)
        seconds["passes"].append(match.crt.render(passes).seconds)
    grid, adaptive = min(seconds["grid"]), min(seconds["passes"])
    return {"samples": count, "grid": grid, "passes": adaptive, "ratio": adaptive / grid}


def vanished(match: Contest) -> dict:
    """Counts what in front of the background is missing from adaptive pictures and covers enough of
    a pixel."""
    glow = Material(color=(1, 1, 1), diffuse=0)
    things = tuple(dataclasses.replace(thing, material=glow) for thing in match.scene.things)
    bare = dataclasses.replace(match.scene, things=things, background=(0, 0, 0), ambient=1)
    script = match.crt.script.with_name(f"{match.name}-coverage.crt")
    with open(script, "w") as out:
        crt_writer.Writer(bare, script).write(out)
    every = {"targeterror": 1.0, "minsamples": 1024, "maxsamples": 1024}
    image, _ = dataclasses.replace(match.crt, script=script).image(every, references.FIRST_SEED)
    cover = image.pixels[..., 0]
    is_there = cover > VANISHING_SHARE
    background = np.asarray(match.scene.background, np.float32)
    result: dict = {
        "pixels": int(is_there.sum()), "seeds": VANISHING_SEEDS, "least_samples": 16, "targets": {}
    }
    for steps in (8, 1):
        missing = 0
        for seed in range(1, 2 if match.plan.quick else VANISHING_SEEDS + 1):
            picture, _ = match.crt.image({"targeterror": steps * ladders.STEP}, seed)
            missing += int((is_there & (picture.pixels[..., :3] == background).all(axis=2)).sum())
        result["targets"][str(steps)] = missing
    return result


def measure(name: str, plan: Plan) -> dict:
    match = contest(name, plan)
    is_slow = name in references.SLOW
    own = references.crt_reference(match.crt, is_slow, plan.quick)
    other = references.povray_reference(
        match.pov, os.cpu_count() or 1, match.with_lens, is_slow, plan.quick
    )
    apart = errors.difference(own.picture, other.picture)
    plan.say(f"{name}: the references differ by {apart.rmse:.3f} (RMSE) and {apart.p999:.2f} (99.9"
             f" %) steps, and are"
             f" uncertain by {own.uncertainty.rmse:.4f} and {other.uncertainty.rmse:.4f}")
    result = {"about": match.scene.about, "width": match.crt.size.width,
              "height": match.crt.size.height,
              "hard": hard_share(match), "apart": dataclasses.asdict(apart),
              "uncertainty": {"CRT": dataclasses.asdict(own.uncertainty),
                              "POV-Ray": dataclasses.asdict(other.uncertainty)},
              "rows": measured_rungs(match, own, other)}
    if name in OVERHEAD_SCENES:
        result["overhead"] = overhead(match)
    if name == "wires":
        result["vanished"] = vanished(match)
    return result
