"""This module splits the rendering of a script into tasks for many machines, and merges the parts.

    plan = crt.farm.plan("scene.crt", "job", frames=(1, 240))
    for task in range(plan.tasks):
        crt.farm.work("job", task)  # on any machine that sees the folder
    crt.farm.merge("job", output="film_###.png")

The job is a folder that all machines see, or that is copied to and fro. Nothing here starts a
process or talks to a network. That is for Dask, Ray, MPI or what you like: all arguments and
results can be pickled. The merged pictures are to the byte those of one machine.
"""

import ctypes
import enum
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _arguments, options, scripts
from ._callbacks import FARM_REPORT, POLL, Guard
from ._library import create, library
from ._structs import Struct, growable
from .images import Image
from .options import Progress

__all__ = ["Merge", "Plan", "RefusedPart", "Status", "Task", "TaskState"]
__all__ += ["merge", "plan", "read_plan", "sheet", "status", "work"]

Path = str | os.PathLike[str]


@growable("crt_farm_options", shown="plan")
class _PlanOptions(Struct):
    """_PlanOptions say how a render is split."""


@growable("crt_farm_job", has_init=False)
class _Job(Struct):
    """A _Job says what a job consists of."""


@growable("crt_farm_work_options", shown="work")
class _WorkOptions(Struct):
    """_WorkOptions say how a task is worked on."""


@growable("crt_farm_merge_options", shown="merge")
class _MergeOptions(Struct):
    """_MergeOptions say where merged pictures go."""


@growable("crt_farm_progress", has_init=False)
class _Progress(Struct):
    """A _Progress says how far a job is."""


_TASK = np.dtype(
    [
        ("state", np.int32),
        ("reserved", np.int32),
        ("seconds", np.float64),
        ("estimated", np.float64),
        ("share", np.float64),
        ("worker", "S128"),
    ]
)


@dataclass(frozen=True)
class Plan:
    """A Plan says what a job consists of."""

    tasks: int
    """is how many tasks there are; their numbers begin with 0"""
    frames: tuple[int, int] | None
    """are the first and the last frame of an animation"""
    width: int
    height: int
    passes: int
    """is the number of passes that a time budget has become, or that was asked for; else 0"""
    has_channels: bool
    """says that there are channels beside the colours, so that pictures are EXR files"""
    seconds: float
    """are estimated, of one core, for all tasks"""
    longest_seconds: float
    """are estimated, for the task that takes longest"""


class TaskState(enum.IntEnum):
    """A TaskState says how far a task is."""

    WAITING = 0
    RUNNING = 1
    LOST = 2
    DONE = 3


@dataclass(frozen=True)
class Task:
    """A Task is one task of a job. Those that run have been heard of within the last minute."""

    state: TaskState
    seconds: float
    """are what rendering it took; 0 if that is not known"""
    estimated: float
    """are the seconds that were planned for it, on one core"""
    share: float
    """is how much of it is done, from 0 to 1"""
    worker: str
    """is the machine and process"""


@dataclass(frozen=True)
class Status:
    """A Status says how far a job is."""

    tasks: list[Task]
    share: float
    """is the estimated share of the work that is done, from 0 to 1"""
    seconds_spent: float
    """are what all tasks done have taken together"""
    seconds_left: float
    """are estimated, for one worker"""


@dataclass(frozen=True)
class RefusedPart:
    """A RefusedPart is damaged, or of another plan. Working on its task again replaces it."""

    task: int
    why: str


@dataclass(frozen=True)
class Merge:
    """A Merge says what merging did."""

    frames: list[int]
    """are the frames whose pictures were written; a single picture is frame 0"""
    missing: list[int]
    """are the tasks without a part"""
    refused: list[RefusedPart]

    @property
    def is_complete(self) -> bool:
        """Says whether all pictures are there."""
        return not self.missing and not self.refused


def plan(
    script: Path,
    job: Path,
    *,
    frames: tuple[int, int] | None = None,
    tasks: int = 0,
    least_seconds: float = 60,
    tile: tuple[int, int] | None = None,
    variables: Mapping[str, Any] = {},
    settings: Mapping[str, Any] = {},
    t: float = 0,
    compat: int = 0,
    resource_directories: Iterable[Path] = (),
    max_steps: int = 0,
    max_image_pixels: int = 0,
    max_primitives: int = 0,
    max_ray_steps: int = 0,
    seed: int = 0,
    passes: int = 0,
    aovs: Iterable[str] = (),
    threads: int = 0,
    progress: Progress | None = None,
) -> Plan:
    """Makes a job of a script, in a folder that must not exist or be empty.

    It renders a small picture of some frames to see where time goes. `frames` are the first and the
    last of an animation, both rendered; without them there is one picture, at `t`. `tasks` is their
    number, and 0 takes as many as last `least_seconds` each on one core. `tile` is the width and
    height of tiles to cut pictures into, which are else cut where that makes tasks equal. A time
    budget is taken for what this machine does in that time with `threads`. The other arguments are
    those of Scene.from_file() and Prepared.render(). The script reads files of its own folder and
    of `resource_directories` alone. One that is wrong raises crt.Error with its diagnostics.
    """
    guard = Guard()
    script_options = scripts.make_options(
        variables=variables,
        settings=settings,
        t=t,
        compat=compat,
        resource_directories=resource_directories,
        limits={"max_steps": max_steps, "max_image_pixels": max_image_pixels},
    )
    render_options = options.make_options(
        guard,
        threads=threads,
        region=None,
        seed=seed,
        passes=passes,
        aovs=aovs,
        checkpoint=None,
        max_ray_steps=max_ray_steps,
        progress=progress,
        log=None,
    )
    given = _PlanOptions(
        tasks=tasks,
        least_seconds=least_seconds,
        max_primitives=max_primitives,
        script=script_options,
        render=render_options,
    )
    if frames is not None:
        first, last = _pair(frames, "plan: frames", "the first and the last frame")
        given.set(has_frames=1, first_frame=first, last_frame=last)
    if tile is not None:
        width, height = _pair(tile, "plan: tile", "a width and a height")
        given.set(tile_width=width, tile_height=height)
    planned = _Job()
    where = _path(script, "plan: script"), _path(job, "plan: job")
    with guard.raising():
        library.crt_farm_plan(*where, ctypes.byref(given), ctypes.byref(planned))
    return _plan_of(planned)


def read_plan(job: Path) -> Plan:
    """Reads what a job consists of."""
    return _plan_of(_Job._filled_by("crt_farm_read_plan", _path(job, "read_plan: job")))


def work(job: Path, task: int, *, threads: int = 0, progress: Progress | None = None) -> bool:
    """Renders a task of a job, and leaves its part.

    A task whose part is there and whole is not rendered again, and then False is returned. Any
    number of processes and threads may work on one task, since a part is written whole or not at
    all, and always has the same bytes. `progress` is that of Prepared.render(), of the task.
    """
    guard = Guard()
    given = _WorkOptions(threads=threads)
    given.progress = options.progress_callback(guard, progress, "work: progress")
    rendered = ctypes.c_int32()
    number = _arguments.whole(task, "work: task")
    with guard.raising():
        library.crt_farm_work(
            _path(job, "work: job"), number, ctypes.byref(given), ctypes.byref(rendered)
        )
    return bool(rendered.value)


def merge(job: Path, *, output: Path | None = None, skip: Iterable[int] = ()) -> Merge:
    """Writes the pictures all of whose parts are there, and says what is missing.

    It may be called again at any time. `output` is the path of the picture. For frames a run of #
    or a %04d in its name becomes the number, which else goes before the ending. Without it pictures
    go into the job's folder. `skip` are frames to leave out, such as those that were merged before.
    """
    guard = Guard()
    left_out = [_arguments.whole(frame, "merge: skip") for frame in skip]
    given = _MergeOptions(output=output, skip_count=len(left_out))
    given.skip = (ctypes.c_int32 * len(left_out))(*left_out)
    merged = Merge([], [], [])

    def note(report: int, number: int, why: bytes) -> None:
        numbers = {0: merged.frames, 1: merged.missing}.get(report)
        if numbers is None:
            merged.refused.append(RefusedPart(number, why.decode(errors="replace")))
        else:
            numbers.append(number)

    given.report = FARM_REPORT(lambda report, number, why, _user: note(report, number, why))
    given.poll = POLL(lambda _user: guard.call(lambda: None))
    with guard.raising():
        library.crt_farm_merge(_path(job, "merge: job"), ctypes.byref(given), None)
    return merged


def status(job: Path) -> Status:
    """Reads how far a job is, and each of its tasks."""
    where = _path(job, "status: job")
    progress = _Progress._filled_by("crt_farm_status", where)
    count = ctypes.c_size_t(read_plan(job).tasks)
    found = np.zeros(count.value, _TASK)
    library.crt_farm_tasks(where, found.ctypes.data, len(found), ctypes.byref(count))
    tasks = [
        Task(TaskState(state), seconds, estimated, share, worker.decode(errors="replace"))
        for state, _, seconds, estimated, share, worker in found.tolist()
    ]
    return Status(tasks, progress.share, progress.seconds_spent, progress.seconds_left)


def sheet(job: Path, cell: int = 160) -> Image:
    """Makes a contact sheet of all that is there: the frames side by side, each at most `cell`
    pixels across, with transparent black where parts are missing."""
    width = _arguments.whole(cell, "sheet: cell")
    return Image._adopt(create("crt_farm_sheet", _path(job, "sheet: job"), width))


def _path(path: Path, name: str) -> bytes:
    return _arguments.text(path, name)


def _pair(given: Any, name: str, expected: str) -> tuple[Any, Any]:
    try:
        first, second = given
    except (TypeError, ValueError):
        raise _arguments.refusal(name, expected, given) from None
    return first, second


def _plan_of(planned: _Job) -> Plan:
    return Plan(
        tasks=planned.tasks,
        frames=(planned.first_frame, planned.last_frame) if planned.has_frames else None,
        width=planned.width,
        height=planned.height,
        passes=planned.passes,
        has_channels=bool(planned.has_channels),
        seconds=planned.seconds,
        longest_seconds=planned.longest_seconds,
    )
