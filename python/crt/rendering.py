"""This module renders pictures of prepared scenes and asks ray queries."""

import atexit
import ctypes
import os
import threading
import time
import weakref
from collections.abc import Callable, Iterable
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from ._callbacks import LOG, PROGRESS, Guard
from ._handles import Handle, Reference
from ._library import create, library
from ._structs import Int, Long, Pointer, Struct, Text, Unsigned, growable
from .images import Image
from .rays import HIT, RAY, Batch

Progress = Callable[[float], Any]
Log = Callable[[str], Any]
Region = tuple[int, int, int, int]
Path = str | os.PathLike[str]

_AOV_BITS = {"depth": 1, "normal": 2, "id": 4, "albedo": 8, "samples": 16, "error": 32}


class Prepared(Handle):
    """A Prepared is a scene ready for rays. It is immutable: any number of threads may use it at
    once."""

    _name = "crt_prepared"

    def render(
        self,
        *,
        threads: int = 0,
        region: Region | None = None,
        seed: int = 0,
        passes: int = 0,
        aovs: Iterable[str] = (),
        checkpoint: Path | None = None,
        max_ray_steps: int = 0,
        progress: Progress | None = None,
        log: Log | None = None,
    ) -> Image:
        """Renders a picture.

        `threads` is the most threads, 0 for all cores. `region` is x, y, width, height of a part,
        from the top left. `seed` replaces the settings', unless it is 0. `passes` is the number of
        passes to render (stats.passes), unless it is 0, whatever the settings' time budget. `aovs`,
        some of "depth", "normal", "id", "albedo", "samples" and "error", become Image.channels.
        `checkpoint` is a file that keeps a picture which is rendered by passes, and from which the
        next render continues. `max_ray_steps` limits the things that one ray may be tested against,
        see crt_render_options. `progress` gets the share that is done, and `log` the messages. Both
        may be called from other threads, one at a time. What progress raises cancels the render and
        comes out of here. So does Ctrl-C.
        """
        guard = Guard()
        options = _options(
            guard, threads, region, seed, passes, aovs, checkpoint, max_ray_steps, progress, log
        )
        with guard.raising():
            return Image._adopt(create("crt_render", self._handle, ctypes.byref(options)))

    def start(
        self,
        *,
        threads: int = 0,
        region: Region | None = None,
        seed: int = 0,
        passes: int = 0,
        aovs: Iterable[str] = (),
        checkpoint: Path | None = None,
        max_ray_steps: int = 0,
        progress: Progress | None = None,
        log: Log | None = None,
    ) -> "Job":
        """Starts to render in the background, otherwise as render()."""
        guard = Guard()
        options = _options(
            guard, threads, region, seed, passes, aovs, checkpoint, max_ray_steps, progress, log
        )
        return Job(create("crt_render_start", self._handle, ctypes.byref(options)), guard, options)

    def intersect(self, rays: NDArray[Any], out: NDArray[Any] | None = None) -> NDArray[Any]:
        """Finds the nearest hit of each ray. A miss has an infinite t.

        `rays` has the dtype crt.RAY, or is float64 with 8 numbers in its last dimension; `out`, if
        given, has crt.HIT and as many items. Both are used in place.
        """
        questions = Batch(rays, RAY, "rays")
        if out is None:
            out = np.empty(questions.shape, HIT)
        answers = Batch(out, HIT, "hits")
        if answers.shape != questions.shape or not out.flags.writeable:
            raise ValueError(
                f"hits of shape {answers.shape} cannot be written for rays of {questions.shape}"
            )
        library.crt_intersect(
            self._handle,
            questions.address,
            questions.stride,
            questions.count,
            answers.address,
            answers.stride,
        )
        return out

    def distances(self, rays: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """Finds how far each ray's nearest hit is (infinity for a miss), and of which entity,
        faster than intersect()."""
        questions = Batch(rays, RAY, "rays")
        out = np.empty(questions.shape, np.float64)
        ids = np.empty(questions.shape, np.uint32)
        library.crt_distances(
            self._handle,
            questions.address,
            questions.stride,
            questions.count,
            out.ctypes.data,
            ids.ctypes.data,
        )
        return out, ids

    def occluded(self, rays: NDArray[Any]) -> NDArray[Any]:
        """Asks whether any surface blocks each ray."""
        questions = Batch(rays, RAY, "rays")
        out = np.empty(questions.shape, np.bool_)
        library.crt_occluded(
            self._handle, questions.address, questions.stride, questions.count, out.ctypes.data
        )
        return out

    def crossings(self, ray: NDArray[Any]) -> NDArray[Any]:
        """Finds every crossing along one ray, in order: the solid intervals that CSG leaves."""
        record = np.asarray(ray)
        question = Batch(record, RAY, "rays")
        if question.count != 1:
            raise ValueError("crossings are those of one ray")
        count = ctypes.c_size_t(16)
        while True:
            hits = np.empty(count.value, HIT)
            library.crt_crossings(
                self._handle, question.address, hits.ctypes.data, len(hits), ctypes.byref(count)
            )
            if count.value <= len(hits):
                return hits[: count.value]


class Job(Handle):
    """A Job is a render that runs on threads of its own. Closing it, or dropping it, cancels it and
    waits for its threads."""

    _name = "crt_job"

    def __init__(self, handle: int, guard: Guard, options: "_RenderOptions") -> None:
        self._guard = guard
        self._reference = _JobReference(handle, guard, options)
        _jobs.add(self)

    @property
    def progress(self) -> float:
        """Returns the share done, from 0 to 1."""
        fraction = ctypes.c_double()
        library.crt_job_progress(self._handle, ctypes.byref(fraction))
        return fraction.value

    @property
    def is_finished(self) -> bool:
        """Says whether it has ended: it is done, was cancelled or failed."""
        return bool(library.crt_job_is_finished(self._handle))

    def snapshot(self) -> Image:
        """Returns the image so far, in which pixels that are not yet rendered are transparent
        black."""
        return Image._adopt(create("crt_job_snapshot", self._handle))

    def cancel(self) -> None:
        """Asks the job to stop, and returns at once."""
        library.crt_job_cancel(self._handle)

    def wait(self) -> Image:
        """Returns the image, once it is there, or raises what went wrong, such as what the progress
        callback raised. Ctrl-C in here cancels the job.

        Ctrl-C in here cancels the job.
        """
        reference = self._handle
        with self._guard.raising():
            if threading.current_thread() is threading.main_thread():
                while not library.crt_job_is_finished(reference):
                    time.sleep(0.01)  # in which Python sees signals
            return Image._adopt(create("crt_job_wait", reference))


class _JobReference(Reference):
    """Keeps the callbacks until the job's threads have ended."""

    __slots__ = ("_guard", "_options")

    def __init__(self, handle: int, guard: Guard, options: "_RenderOptions") -> None:
        super().__init__(handle, library.crt_job_release)
        self._guard = guard
        self._options = options

    def __del__(self) -> None:
        # a callback drops its own job, whose thread then ends by itself, later
        if self._guard.is_inside():
            _still_needed.append(self._options)
        super().__del__()


_still_needed: list["_RenderOptions"] = []
_jobs: weakref.WeakSet[Job] = weakref.WeakSet()


@atexit.register
def _end_jobs() -> None:
    """Ends all jobs, as no callback may come while Python shuts down."""
    for job in list(_jobs):
        if job._reference is not None:
            job.cancel()
            job.close()


@growable("crt_render_options")
class _RenderOptions(Struct):
    threads: Int
    region_x: Int
    region_y: Int
    region_width: Int
    region_height: Int
    seed: Long
    progress: Annotated[Any, PROGRESS]
    progress_user: Pointer
    log: Annotated[Any, LOG]
    log_user: Pointer
    passes: Int
    aovs: Unsigned
    checkpoint: Text
    max_ray_steps: Long


def _aov_bits(names: Iterable[str]) -> int:
    bits = 0
    for name in names:
        if name not in _AOV_BITS:
            raise ValueError(f"there is no AOV {name!r}; there are {', '.join(_AOV_BITS)}")
        bits |= _AOV_BITS[name]
    return bits


def _options(
    guard: Guard,
    threads: int,
    region: Region | None,
    seed: int,
    passes: int,
    aovs: Iterable[str],
    checkpoint: Path | None,
    max_ray_steps: int,
    progress: Progress | None,
    log: Log | None,
) -> _RenderOptions:
    def tell_progress(fraction: float) -> None:
        if progress is not None:
            progress(fraction)

    def tell(line: bytes) -> None:
        if log is not None:
            log(line.decode())

    options = _RenderOptions(
        threads=threads,
        seed=seed,
        passes=passes,
        aovs=_aov_bits(aovs),
        checkpoint=checkpoint,
        max_ray_steps=max_ray_steps,
    )
    if region is not None:
        x, y, width, height = region
        options.set(region_x=x, region_y=y, region_width=width, region_height=height)
    # There is always one, which sees Ctrl-C and what the other has raised.
    options.progress = PROGRESS(lambda fraction, _user: guard.call(tell_progress, fraction))
    options.log = LOG(lambda _level, line, _user: guard.call(tell, line))
    return options
