"""Renders what each program's pictures converge to, each in two independent halves that show how
uncertain it is."""

from dataclasses import dataclass

import numpy as np

from povray import pictures

from . import errors
from .ladders import lens_options
from .programs import Crt, PovRay

FIRST_SEED = 1001  # other random numbers than the ladder's
# POV-Ray's antialiasing has no more than 9 x 9 places in a pixel, always the same ones. So its
# references are pictures of several times the size, with jitter, averaged down: (times, options).
SLOW = ("glass", "mirrors")  # get a fourth of the rays
ENLARGED = ((5, ("+AM1", "+A0.0", "+R4")), (7, ("+AM1", "+A0.0", "+R4")))
ENLARGED_LENS = ((2, ("-A", *lens_options(256, 0))), (3, ("-A", *lens_options(114, 0))))
ENLARGED_SLOW = ((2, ("+AM1", "+A0.0", "+R5")), (3, ("+AM1", "+A0.0", "+R4")))
QUICK_ENLARGED = ((2, ("+AM1", "+A0.0", "+R3")), (3, ("+AM1", "+A0.0", "+R2")))
QUICK_ENLARGED_LENS = ((1, ("-A", *lens_options(64, 0))), (2, ("-A", *lens_options(16, 0))))


@dataclass(frozen=True)
class Reference:
    picture: np.ndarray  # in 8-bit steps
    uncertainty: errors.PictureError


def of_halves(halves: list[np.ndarray]) -> Reference:
    """Returns the mean of two halves, in linear light."""
    mean = errors.shown(sum(halves) / len(halves))
    apart = errors.difference(*(errors.shown(half) for half in halves))
    return Reference(mean, errors.PictureError(apart.rmse / 2, apart.p999 / 2))


def crt_reference(crt: Crt, is_slow: bool, quick: bool) -> Reference:
    settings = {"targeterror": 0.05 / errors.FULL, "minsamples": 64 if quick else 128,
                "maxsamples": 256 if quick else 1024 if is_slow else 4096}
    halves = []
    for seed in (FIRST_SEED, FIRST_SEED + 1):
        image, _ = crt.image(settings, seed)
        halves.append(image.pixels[..., :3].astype(float))
    return of_halves(halves)


def povray_reference(
    pov: PovRay, threads: int, with_lens: bool, is_slow: bool, quick: bool
) -> Reference:
    if quick:
        kinds = QUICK_ENLARGED_LENS if with_lens else QUICK_ENLARGED
    else:
        kinds = ENLARGED_LENS if with_lens else ENLARGED_SLOW if is_slow else ENLARGED
    halves = []
    for times, options in kinds:
        large = pov.render(options, threads, times).picture
        halves.append(pictures.averaged(errors.linear(large), times))
    return of_halves(halves)
