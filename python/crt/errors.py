"""Calls raise crt.Error, or crt.ScriptError with the places in the script."""

import contextlib
import enum
import errno
import os
from collections.abc import Iterator, Mapping
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


class MissingFileError(Error, FileNotFoundError):
    """A MissingFileError is a file that is not there: an Error whose status is IO, and Python's
    FileNotFoundError, too. `filename` is its path."""

    def __init__(self, message: str, path: str | bytes) -> None:
        super().__init__(Status.IO, message)
        self.errno = errno.ENOENT
        self.strerror = os.strerror(errno.ENOENT)
        self.filename = os.fsdecode(path)

    def __str__(self) -> str:
        return str(self.args[0])

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (str(self), self.filename)


def of_reading(message: str, path: str | bytes) -> Error:
    """Returns the error that a file is which could not be read."""
    try:
        os.stat(path)
    except FileNotFoundError:
        return MissingFileError(message, path)
    except OSError:
        pass
    return Error(Status.IO, message)


@contextlib.contextmanager
def named(what: str, names: Mapping[str, str] = {}) -> Iterator[None]:
    """Says in errors of the library what they are about, and replaces the library's names at their
    begin by those of Python."""
    try:
        yield
    except Error as error:
        text = str(error)
        for theirs, ours in names.items():
            if text.startswith(theirs):
                text = ours + text[len(theirs) :]
                break
        raise Error(error.status, f"{what}: {text}") from None


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
