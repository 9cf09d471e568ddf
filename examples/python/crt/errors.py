"""What can go wrong: crt.Error, and crt.ScriptError with the places in the script."""

import enum
from dataclasses import dataclass


class Status(enum.IntEnum):
    """What became of a call; see crt_status in crt.h."""

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
    """A call that failed. `status` is the kind, the text says what was wrong."""

    def __init__(self, status: Status, message: str) -> None:
        super().__init__(message)
        self.status = status


@dataclass(frozen=True)
class Call:
    """A macro call that led to an error."""

    name: str
    file: str
    line: int
    column: int


@dataclass(frozen=True)
class Diagnostic:
    """One thing to say about a script. Lines and columns count from 1; 0: it has no place."""

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
    """A script that failed. `diagnostics` has all there is to say, the text is as compilers print
    it."""

    def __init__(self, status: Status, message: str, diagnostics: list[Diagnostic]) -> None:
        super().__init__(status, message)
        self.diagnostics = diagnostics
