"""Measures how far a picture is from what its settings converge to, in steps of 8 bits of what a
display shows."""

from dataclasses import dataclass

import numpy as np

# of displays: both programs write value^(1/GAMMA), and CRT's target error is about that
GAMMA = 2.2
FULL = 255


@dataclass(frozen=True)
class PictureError:
    rmse: float  # over all pixels and their three colours
    p999: float  # 99.9 % of the pixels have no channel that is farther off


def shown(linear: np.ndarray) -> np.ndarray:
    """Returns a picture in 8-bit steps, not rounded."""
    return FULL * np.clip(linear[..., :3].astype(float), 0, 1) ** (1 / GAMMA)


def linear(steps: np.ndarray) -> np.ndarray:
    return (steps / FULL) ** GAMMA


def difference(a: np.ndarray, b: np.ndarray) -> PictureError:
    """Compares pictures in 8-bit steps."""
    apart = np.abs(a - b)
    worst = np.sort(apart.max(axis=2), axis=None)
    place = max(int(np.ceil(0.999 * worst.size)) - 1, 0)
    return PictureError(float(np.sqrt((apart**2).mean())), float(worst[place]))
