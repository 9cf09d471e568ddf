"""Lists the settings that are tried, from the fastest to the slowest of each family."""

from dataclasses import dataclass

STEP = 1 / 255  # of an 8-bit picture

GRID, ADAPTIVE, LOW_START = "CRT, grid", "CRT, target error", "CRT, target error, minsamples 4"
ONE_RAY, PLAIN, RECURSIVE = "POV-Ray -A", "POV-Ray +AM1", "POV-Ray +AM2"
LENS, LENS_BY_VARIANCE = "POV-Ray, blur_samples", "POV-Ray, variance"
NAMED = "+A0.1 +AM2 +R4"  # the setting that represents others' accuracy

# POV-Ray's lens takes these by default.
DEFAULT_VARIANCE = 1 / 128


@dataclass(frozen=True, eq=False)
class Rung:
    family: str
    name: str
    settings: dict | None = None  # of CRT's script
    options: tuple[str, ...] = ()  # of POV-Ray's command line

    @property
    def is_crt(self) -> bool:
        return self.settings is not None


def crt_grid(with_lens: bool) -> list[Rung]:
    if with_lens:
        sizes = ((1, 4), (1, 16), (2, 16), (2, 64), (4, 64))
        return [
            Rung(GRID, f"{n} x {n} x {m}", {"supersampling": n, "dofsamples": m}) for n, m in sizes
        ]
    return [
        Rung(GRID, f"{n} x {n}", {"supersampling": n}) for n in (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)
    ]


def crt_adaptive(family: str, least_samples: int, steps: tuple[float, ...]) -> list[Rung]:
    return [
        Rung(family, f"{n:g}/255", {"targeterror": n * STEP, "minsamples": least_samples})
        for n in steps
    ]


def antialiasing(family: str, method: int, settings: tuple) -> list[Rung]:
    """Makes rungs of thresholds and depths. Jitter is on, which is the default."""
    rungs = []
    for threshold, depth in settings:
        options = (f"+A{threshold}", f"+AM{method}", f"+R{depth}")
        rungs.append(Rung(family, " ".join(options), options=options))
    return rungs


def lens_options(samples: int, variance: float) -> tuple[str, ...]:
    return (f"Declare=BlurSamples={samples}", f"Declare=Variance={variance:.8f}")


def povray(with_lens: bool) -> list[Rung]:
    if not with_lens:
        return [
            Rung(ONE_RAY, "-A", options=("-A",)),
            *antialiasing(
                PLAIN, 1, ((0.3, 2), (0.3, 3), (0.1, 3), (0.03, 4), (0.01, 4), (0.0, 4), (0.0, 9))
            ),
            *antialiasing(
                RECURSIVE, 2,
                ((0.3, 2), (0.3, 3), (0.1, 3), (0.1, 4), (0.03, 4), (0.01, 4), (0.0, 4)),
            ),
        ]
    fixed = [
        Rung(LENS, f"blur_samples {n}", options=("-A", *lens_options(n, 0)))
        for n in (7, 19, 37, 128, 512)
    ]
    by_variance = [
        Rung(
            LENS_BY_VARIANCE, f"blur_samples {n} variance 1/{steps}",
            options=("-A", *lens_options(n, 1 / steps)),
        )
        for n, steps in ((128, 128), (128, 1000), (512, 10000), (512, 100000))]
    recursive = [
        Rung(RECURSIVE, rung.name, options=(*rung.options, *lens_options(37, DEFAULT_VARIANCE)))
        for rung in antialiasing(RECURSIVE, 2, ((0.3, 3), (0.1, 4), (0.03, 4)))]
    return fixed + by_variance + recursive


def all_rungs(with_lens: bool, quick: bool) -> list[Rung]:
    """Returns CRT's and POV-Ray's by turns."""
    own = [*crt_grid(with_lens), *crt_adaptive(ADAPTIVE, 16, (8, 4, 2, 1, 0.5, 0.25)),
           *crt_adaptive(LOW_START, 4, (64, 32, 16, 8, 4))]
    others = povray(with_lens)
    if quick:
        own = [
            rung for rung in own
            if rung.name in ("1 x 1", "2 x 2", "4 x 4", "1 x 1 x 4", "1 x 1 x 16", "8/255")
        ]
        others = [
            rung for rung in others
            if rung.name in ("-A", "+A0.3 +AM1 +R3", "blur_samples 7", NAMED)
        ]
    rungs = []
    for i in range(max(len(own), len(others))):
        rungs += own[i:i + 1] + others[i:i + 1]
    return rungs
