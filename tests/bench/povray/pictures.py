"""Compares two pictures, to see whether they show the same."""

import pathlib
from dataclasses import dataclass

import numpy as np


def read_ppm(path: pathlib.Path) -> np.ndarray:
    """Reads a binary PPM of 8 or 16 bits: height x width x 3."""
    data = path.read_bytes()
    fields, position = [], 0
    while len(fields) < 4:
        end = position
        while not data[end:end + 1].isspace():
            end += 1
        if data[position:position + 1] == b"#":
            end = data.index(b"\n", position)
        elif end > position:
            fields.append(data[position:end])
        position = end + 1
    if fields[0] != b"P6" or fields[3] not in (b"255", b"65535"):
        raise ValueError(f"{path} is no binary PPM of 8 or 16 bits")
    width, height = int(fields[1]), int(fields[2])
    kind = np.dtype(np.uint8 if fields[3] == b"255" else ">u2")
    return np.frombuffer(data, kind, 3 * width * height, position).reshape(height, width, 3)


@dataclass(frozen=True)
class Difference:
    share: float  # of the pixels that differ by more than `steps`
    mean: float  # over all channels, in 8-bit steps


def averaged(picture: np.ndarray, side: int) -> np.ndarray:
    """Averages blocks of side x side pixels, so that noise goes and what is shown stays."""
    height, width = (length // side * side for length in picture.shape[:2])
    blocks = picture[:height, :width].astype(float)
    return blocks.reshape(height // side, side, width // side, side, 3).mean(axis=(1, 3))


def difference(a: np.ndarray, b: np.ndarray, steps: float, block: int = 1) -> Difference:
    if a.shape != b.shape:
        raise ValueError(f"one picture has {a.shape[:2]} pixels, the other {b.shape[:2]}")
    apart = np.abs(averaged(a, block) - averaged(b, block))
    return Difference(float((apart.max(axis=2) > steps).mean()), float(apart.mean()))
