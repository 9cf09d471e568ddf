"""Lists parts of the scenes for each class of pixels, and runs the program that compares claims
with the truth there."""

import json
import pathlib
import subprocess
from dataclasses import dataclass

from povray import crt_writer, trade_scenes

from . import errors

SEEDS, QUICK_SEEDS = 100, 5
QUICK_SIDE = 6
NO_ENTITIES = (1, 0)


@dataclass(frozen=True)
class Part:
    scene: str
    left: int
    top: int
    entities: tuple[int, int] = NO_ENTITIES  # ids of what the class is about


@dataclass(frozen=True)
class Class:
    kind: str  # as bench_honesty calls it
    samples: int  # of each half of the truth
    parts: tuple[Part, ...]
    side: int = 16  # of a part, in pixels


def glass(left: int, top: int) -> Part:
    return Part("glass", left, top, (0, 11))


def mirrors(left: int, top: int) -> Part:
    return Part("mirrors", left, top, (2, 17))


# None of these scenes is among those that the rules of refinement were adjusted by.
CLASSES = {
    "flat": Class(
        "flat", 4096, (Part("cad", 100, 60), Part("scale", 100, 60), Part("flat", 30, 30))
    ),
    "edge": Class("edge", 16384, (
        Part("cad", 40, 62), Part("cad", 120, 40), Part("cad", 160, 100), Part(
            "silhouettes", 60, 40
        ),
        Part("silhouettes", 130, 80), Part("scale", 110, 70), Part("scale", 60, 90))),
    "sub-pixel": Class(
        "sub-pixel", 16384, tuple(Part("wires", x, y) for x, y in ((60, 50), (110, 100), (160, 60)))
    ),
    "defocused": Class(
        "defocused", 32768,
        tuple(Part("defocus", x, y) for x, y in ((60, 50), (120, 80), (160, 110))),
    ),
    "refractive": Class("special", 8192, (glass(40, 50), glass(80, 55), glass(110, 50)), side=10),
    "mirrored": Class(
        "special", 16384, (mirrors(40, 60), mirrors(80, 40), mirrors(110, 80)), side=12
    ),
}
QUICK = ("flat", "edge", "sub-pixel")


def measure(name: str, program: pathlib.Path, folder: pathlib.Path, quick: bool) -> dict:
    chosen = CLASSES[name]
    side = QUICK_SIDE if quick else chosen.side
    folder.mkdir(parents=True, exist_ok=True)
    arguments = [chosen.kind, QUICK_SEEDS if quick else SEEDS, 256 if quick else chosen.samples]
    for part in chosen.parts[:1 if quick else None]:
        script = folder / f"{part.scene}.crt"
        with open(script, "w") as out:
            crt_writer.Writer(trade_scenes.SCENES[part.scene](), script).write(out)
        height = trade_scenes.height_of(part.scene)
        arguments += [
            script, height * 4 // 3, height, errors.GAMMA, *part.entities, part.left, part.top,
            side, side,
        ]
    done = subprocess.run(
        [program, *map(str, arguments)], stdout=subprocess.PIPE, check=True, text=True
    )
    return json.loads(done.stdout)
