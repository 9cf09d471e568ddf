"""Calls raise crt.Error, or crt.ScriptError with the places in the script."""

import contextlib
import enum
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any


class Status(enum.IntEnum):
    """A Status says how a call ended; see crt_status in crt.h."""

    OK = 0
    INVALID_ARGUMENT = 1
    SCRIPT = 2
    IO = 3
    UNSUPPORTED = 4
    LIMIT = 5
    CANCELLED = 6
    OUT_OF_MEMORY = 7
    INTERNAL = 8
    UNKNOWN = -1

    @classmethod
    def _missing_(cls, value: object) -> "Status":
        return cls.UNKNOWN  # of a later version of the library


class Error(Exception):
    """An Error is a call that failed. `status` is the kind, and the text says what was wrong."""

    def __init__(self, status: Status, message: str) -> None:
        super().__init__(message)
        self.status = status

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.status, str(self))  # as a process pool sends it


@contextlib.contextmanager
def named(what: str) -> Iterator[None]:
    """Says in errors of the library what they are about."""
    try:
        yield
    except Error as error:
        raise Error(error.status, f"{what}: {error}") from None


@dataclass(frozen=True)
class Call:
    """A Call is a macro call that led to an error."""

    name: str
    file: str
    line: int
    column: int


@dataclass(frozen=True)
class Diagnostic:
    """A Diagnostic is one message about a script. Lines and columns count from 1; 0 means that it
    has no place."""

    is_error: bool  # or a warning
    status: Status
    message: str
    file: str
    line: int
    column: int
    length: int  # of the marked piece
    source_line: str
    calls: tuple[Call, ...]  # that led there, the innermost first


class ScriptError(Error):
    """A ScriptError is a script that failed. `diagnostics` has all messages, and the text is as
    compilers print them."""

    def __init__(self, status: Status, message: str, diagnostics: list[Diagnostic]) -> None:
        super().__init__(status, message)
        self.diagnostics = diagnostics

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.status, str(self), self.diagnostics)
