"""The library calls Python functions through this module."""

import contextlib
import ctypes
import itertools
import signal
import threading
import types
from collections.abc import Callable, Iterator
from typing import Any

PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double, ctypes.c_void_p)
LOG = ctypes.CFUNCTYPE(None, ctypes.c_int32, ctypes.c_char_p, ctypes.c_void_p)
PRINT = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.POINTER(ctypes.c_char), ctypes.c_size_t, ctypes.c_void_p
)
OPEN_FILE = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p)
POLL = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p)
CUSTOM_CROSSINGS = ctypes.CFUNCTYPE(
    ctypes.c_int,
    ctypes.c_void_p,
    ctypes.c_void_p,
    ctypes.c_size_t,
    ctypes.POINTER(ctypes.c_size_t),
    ctypes.c_void_p,
)
CUSTOM_POINT = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.c_void_p, ctypes.c_uint32, ctypes.c_void_p, ctypes.c_void_p
)
RELEASE = ctypes.CFUNCTYPE(None, ctypes.c_void_p)
FARM_REPORT = ctypes.CFUNCTYPE(
    None, ctypes.c_int32, ctypes.c_int32, ctypes.c_char_p, ctypes.c_void_p
)

# What stands for the types of crt.h.
CALLBACKS: dict[str, Any] = {
    "crt_progress_fn": PROGRESS,
    "crt_log_fn": LOG,
    "crt_print_fn": PRINT,
    "crt_open_file_fn": OPEN_FILE,
    "crt_poll_fn": POLL,
    "crt_custom_crossings_fn": CUSTOM_CROSSINGS,
    "crt_custom_point_fn": CUSTOM_POINT,
    "crt_release_fn": RELEASE,
    "crt_farm_report_fn": FARM_REPORT,
}

_DEFAULT_HANDLER = signal.default_int_handler

STOP = -1  # what a callback returns to cancel


class Guard:
    """Keeps what callbacks raise until the library's call has returned."""

    def __init__(self) -> None:
        self.exception: BaseException | None = None
        self.has_raised = False  # what callbacks raised has come out
        self.at_end: Callable[[], None] = _nothing  # of the call
        self._thread_inside: int | None = None

    def call(self, function: Callable[..., int | None], *arguments: Any) -> int:
        """Returns what a callback returns: the function's result, or STOP if it or one before it
        has raised."""
        if self.exception is None and not self.has_raised:
            self._thread_inside = threading.get_ident()
            try:
                return function(*arguments) or 0
            except BaseException as exception:
                self.exception = exception
            finally:
                self._thread_inside = None
        return STOP

    def is_inside(self) -> bool:
        """Says whether this thread is within a call()."""
        return self._thread_inside == threading.get_ident()

    def raising(self) -> "_Raising":
        """Wraps a call of the library. It raises what a callback raised, in place of the error that
        it caused.

        Ctrl-C cancels, if a callback looks here now and then. It is noted by a handler of our own,
        since a KeyboardInterrupt raised on the way into a callback could only be printed by ctypes.
        """
        return _Raising(self)

    def note_interrupt(self, _signal: int, _frame: types.FrameType | None) -> None:
        """Handles Ctrl-C."""
        self.exception = KeyboardInterrupt()


class _Raising:
    """A _Raising is what Guard.raising() returns."""

    def __init__(self, guard: Guard) -> None:
        self._guard = guard
        self._has_handler = False

    def __enter__(self) -> None:
        is_main = threading.current_thread() is threading.main_thread()
        self._has_handler = is_main and signal.getsignal(signal.SIGINT) is _DEFAULT_HANDLER
        if self._has_handler:
            signal.signal(signal.SIGINT, self._guard.note_interrupt)

    def __exit__(
        self,
        _kind: type[BaseException] | None,
        _error: BaseException | None,
        _traceback: types.TracebackType | None,
    ) -> None:
        if self._has_handler:
            signal.signal(signal.SIGINT, _DEFAULT_HANDLER)
        self._guard.at_end()
        # The exception refers to the frames that it went through, and so to all that these have.
        # Neither the guard, which the library's callbacks refer to, nor this frame may keep it:
        # nobody finds a cycle through ctypes.
        exception, self._guard.exception = self._guard.exception, None
        if exception is not None:
            self._guard.has_raised = True
            try:
                raise exception from None
            finally:
                del exception


class Failure:
    """A Failure is what a function of a custom shape returns to the library: 0, or its number."""

    number = 0


class Failures:
    """Keeps what functions of custom shapes raise, until the call that asked has returned the
    number which stands for it."""

    def __init__(self) -> None:
        self._kept: dict[int, BaseException] = {}
        self._numbers = itertools.count(1)

    @contextlib.contextmanager
    def kept(self) -> Iterator[Failure]:
        """Keeps what is raised, and gives the Failure its number."""
        failure = Failure()
        try:
            yield failure
        except BaseException as exception:
            failure.number = next(self._numbers) % 0x40000000 + 0x3FFFFFFF
            self._kept[failure.number] = exception

    def taken(self, number: int) -> BaseException | None:
        """Returns what a number stands for, and forgets what else was raised until now."""
        exception = self._kept.pop(number, None)
        if exception is not None:
            self._kept.clear()
        return exception


failures = Failures()


def _nothing() -> None:
    """Does nothing, at the end of a call that needs nothing."""
