"""A job renders in the background."""

import atexit
import ctypes
import threading
import time
import weakref

from ._callbacks import Guard
from ._handles import Handle, Reference
from ._library import create, library
from .images import Image
from .options import RenderOptions


class Job(Handle):
    """A Job is a render that runs on threads of its own. Closing it, or dropping it, cancels it and
    waits for its threads."""

    _name = "crt_job"
    _instead_of_pickle = "wait for its image"

    def __init__(self, handle: int, guard: Guard, options: RenderOptions) -> None:
        self._guard = guard
        self._raised: BaseException | None = None  # by a callback, out of wait()
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

    def _summary(self) -> str:
        return f"{self.progress:.0%} done" + (", finished" if self.is_finished else "")

    def __copy__(self) -> "Job":
        raise TypeError("a Job cannot be copied: it is one render, with one end")

    def wait(self) -> Image:
        """Returns the image, once it is there, or raises what went wrong, such as what the progress
        callback raised. Ctrl-C in here cancels the job."""
        reference = self._handle
        if self._raised is not None:
            raise self._raised
        try:
            with self._guard.raising():
                if threading.current_thread() is threading.main_thread():
                    while not library.crt_job_is_finished(reference):
                        time.sleep(0.01)  # in which Python sees signals
                return Image._adopt(create("crt_job_wait", reference))
        except BaseException as exception:
            if self._guard.has_raised:
                self._raised = exception
            raise


class _JobReference(Reference):
    """Keeps the callbacks until the job's threads have ended."""

    __slots__ = ("_guard", "_options")

    def __init__(self, handle: int, guard: Guard, options: RenderOptions) -> None:
        super().__init__(handle, library.crt_job_release)
        self._guard = guard
        self._options = options

    def __del__(self) -> None:
        # a callback drops its own job, whose thread then ends by itself, later
        if self._guard.is_inside():
            _still_needed.append(self._options)
        super().__del__()


_still_needed: list[RenderOptions] = []
_jobs: weakref.WeakSet[Job] = weakref.WeakSet()


@atexit.register
def _end_jobs() -> None:
    """Ends all jobs, as no callback may come while Python shuts down."""
    for job in list(_jobs):
        if job._reference is not None:
            job.cancel()
            job.close()
