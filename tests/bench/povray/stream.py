"""Makes the random numbers of all scenes: POV-Ray's own `rand`."""

import numpy as np

MULTIPLIER, INCREMENT, MODULUS = 1812433253, 12345, 2**32


class Stream:
    """A Stream gives numbers in [0, 1], as POV-Ray's rand(seed(n)) does."""

    def __init__(self, seed: int) -> None:
        self.state = seed

    def number(self) -> float:
        self.state = (self.state * MULTIPLIER + INCREMENT) % MODULUS
        return self.state / (MODULUS - 1)

    def between(self, low: float, high: float) -> float:
        return low + (high - low) * self.number()

    def points(self, count: int, low: tuple, high: tuple) -> np.ndarray:
        """Returns points in a box, one in a row, each from three numbers of the stream."""
        numbers = np.fromiter((self.number() for _ in range(3 * count)), float, 3 * count)
        return np.asarray(low) + (np.asarray(high) - np.asarray(low)) * numbers.reshape(count, 3)
