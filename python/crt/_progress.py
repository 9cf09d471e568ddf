"""This module shows how far a render is, on a line of standard error."""

import importlib
import sys
import time
from collections.abc import Callable
from typing import Any


class Line:
    """A Line is what progress=True shows: tqdm's if that is installed, or a plain one.

    It is called with the share that is done, from 0 to 1, and closed at the end, whatever that is.
    """

    def __init__(self) -> None:
        self._line = _tqdm() or _Plain()

    def __call__(self, fraction: float) -> None:
        self._line.show(fraction)
        if fraction >= 1:
            self.close()

    def close(self) -> None:
        """Ends the line. Closing again does no harm."""
        self._line.close()


class _Plain:
    """A _Plain line has a bar, and the seconds that have passed and are left."""

    WIDTH = 30
    SECONDS = 0.1  # from one state to the next

    def __init__(self) -> None:
        self._start = time.monotonic()
        self._shown = ""
        self._next = 0.0

    def show(self, fraction: float) -> None:
        passed = time.monotonic() - self._start
        if passed < self._next and fraction < 1:
            return
        self._next = passed + self.SECONDS
        bar = ("#" * round(self.WIDTH * fraction)).ljust(self.WIDTH)
        left = f", {passed / fraction - passed:.0f} s left" if 0 < fraction < 1 else ""
        text = f"rendering: {fraction:4.0%} [{bar}] {passed:.0f} s{left}"
        if text != self._shown:
            sys.stderr.write("\r" + text.ljust(len(self._shown)))
            sys.stderr.flush()
            self._shown = text

    def close(self) -> None:
        if self._shown:
            sys.stderr.write("\n")
            self._shown = ""


class _Tqdm:
    """A _Tqdm counts per cents with a bar of tqdm."""

    def __init__(self, tqdm: Callable[..., Any]) -> None:
        shape = "{l_bar}{bar}| {elapsed}<{remaining}"
        self._bar = tqdm(total=100, desc="rendering", bar_format=shape)

    def show(self, fraction: float) -> None:
        self._bar.update(100 * fraction - self._bar.n)

    def close(self) -> None:
        self._bar.close()


def _tqdm() -> _Tqdm | None:
    try:
        return _Tqdm(importlib.import_module("tqdm.auto").tqdm)
    except ImportError:
        return None
