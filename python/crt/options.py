"""What a render may be asked beyond the scene."""

import os
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from . import _arguments
from ._callbacks import LOG, PROGRESS, STOP, Guard
from ._progress import Line
from ._structs import Struct, growable

Progress = Callable[[float], Any] | bool
Log = Callable[[str], Any]
Region = tuple[int, int, int, int]
Path = str | os.PathLike[str]

AOV_BITS = {
    "depth": 1,
    "normal": 2,
    "id": 4,
    "part": 64,
    "albedo": 8,
    "samples": 16,
    "error": 32,
}


@growable("crt_render_options", shown="render")
class RenderOptions(Struct):
    """RenderOptions are what the keyword arguments of Prepared.render() become."""


def make_options(
    guard: Guard,
    *,
    threads: int,
    region: Region | None,
    seed: int,
    passes: int,
    aovs: Iterable[str],
    checkpoint: Path | None,
    max_ray_steps: int,
    progress: Progress | None,
    log: Log | None,
) -> RenderOptions:
    """Returns the struct, whose callbacks call `progress` and `log` through the guard."""
    options = RenderOptions(
        threads=threads,
        seed=seed,
        passes=passes,
        aovs=_aov_bits(aovs),
        checkpoint=checkpoint,
        max_ray_steps=max_ray_steps,
    )
    if region is not None:
        _set_region(options, region)
    if log is not None and not callable(log):
        raise _arguments.refusal("render: log", "a function", log)
    options.progress = progress_callback(guard, progress, "render: progress")

    def tell(line: bytes) -> None:
        if log is not None:
            log(line.decode(errors="replace"))

    options.log = LOG(lambda _level, line, _user: guard.call(tell, line))
    return options


def progress_callback(guard: Guard, progress: Progress | None, name: str) -> Any:
    """Returns what the library calls. There is always such a callback, which sees Ctrl-C and what
    others have raised."""
    if progress is not None and not isinstance(progress, bool) and not callable(progress):
        raise _arguments.refusal(name, "a function, or True", progress)
    tell = _progress_function(guard, progress)
    return PROGRESS(lambda fraction, _user: guard.call(tell, fraction))


def _progress_function(guard: Guard, progress: Progress | None) -> Callable[[float], int | None]:
    if progress is None or progress is False:
        return lambda _fraction: None
    if progress is True:
        line = Line()
        guard.at_end = line.close
        return line
    call: Callable[[float], Any] = progress

    def tell(fraction: float) -> int | None:
        answer = call(fraction)
        is_no = isinstance(answer, (bool, np.bool_)) and not answer
        return STOP if is_no else None

    return tell


def _set_region(options: RenderOptions, region: Region) -> None:
    try:
        x, y, width, height = region
    except (TypeError, ValueError):
        raise _arguments.refusal("render: region", "x, y, width and height", region) from None
    options.set(region_x=x, region_y=y, region_width=width, region_height=height)


def _aov_bits(names: Iterable[str]) -> int:
    bits = 0
    for name in (names,) if isinstance(names, str) else names:
        if name not in AOV_BITS:
            raise ValueError(f"render: there is no AOV {name!r}; there are {', '.join(AOV_BITS)}")
        bits |= AOV_BITS[name]
    return bits
