"""This module gives the diagnostics of a script as Python objects."""

from ._handles import Reference
from ._library import library
from ._structs import Struct, growable
from .errors import Call, Diagnostic, Status


@growable("crt_diagnostic", has_init=False)
class _Diagnostic(Struct):
    """A _Diagnostic is one message, with texts of Python's own."""


@growable("crt_diagnostic_call", has_init=False)
class _DiagnosticCall(Struct):
    """A _DiagnosticCall is a macro call that led to a message."""


def diagnostics_of(handle: int) -> tuple[str, list[Diagnostic]]:
    """Returns the text of all of them, and each, and releases the handle."""
    reference = Reference(handle, library.crt_diagnostics_release)
    count = library.crt_diagnostics_count(reference)
    text = library.crt_diagnostics_text(reference).decode()
    return text, [_diagnostic(reference, index) for index in range(count)]


def _diagnostic(reference: Reference, index: int) -> Diagnostic:
    given = _Diagnostic._filled_by("crt_diagnostics_get", reference, index)
    error = 1
    return Diagnostic(
        is_error=given.severity == error,
        status=Status(given.status),
        message=given.message,
        file=given.file,
        line=given.line,
        column=given.column,
        length=given.length,
        source_line=given.source_line,
        calls=tuple(_call(reference, index, call) for call in range(given.call_count)),
    )


def _call(reference: Reference, index: int, call: int) -> Call:
    given = _DiagnosticCall._filled_by("crt_diagnostics_get_call", reference, index, call)
    return Call(name=given.name, file=given.file, line=given.line, column=given.column)
