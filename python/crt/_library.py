"""This module loads libcrt, and tells ctypes what the functions of crt.h take and return.

The environment variable CRT_LIBRARY may name the file. Otherwise it is the one that was installed
with this package, or the system's loader is asked for libcrt.so.1. A function that returns a status
raises crt.Error instead. Calls give up Python's lock, so other threads go on.
"""

import ctypes
import ctypes.util
import os
import pathlib
from typing import Any

from . import _arguments
from ._callbacks import failures
from ._functions import FUNCTIONS
from .errors import Error, Status

ABI = 1

NATIVE = pathlib.Path(__file__).parent / "_native"  # a wheel has its libraries here


class _Text:
    """A _Text is an argument that is a str or a path, and arrives as UTF-8 ended by 0."""

    @classmethod
    def from_param(cls, text: str | bytes | os.PathLike[str] | None) -> ctypes.c_char_p:
        return ctypes.c_char_p(None if text is None else _arguments.text(text, "a text"))


KINDS = {
    "double": ctypes.c_double,
    "size_t": ctypes.c_size_t,
    "int32_t": ctypes.c_int32,
    "uint32_t": ctypes.c_uint32,
    "uint64_t": ctypes.c_uint64,
    "crt_status": ctypes.c_int,
    "void": None,
}


def kind_of(declaration: str, is_result: bool = False) -> Any:
    """Returns what stands for a type of C, such as that of "const double center[3]"."""
    if declaration.startswith("const char*") and declaration.count("*") == 1:
        is_counted = declaration == "const char* text"  # that has its length beside it
        if not is_counted:
            return ctypes.c_char_p if is_result else _Text
    if "*" in declaration or declaration.endswith("]"):
        return ctypes.c_void_p
    return KINDS[declaration.split()[0]]


def _find() -> str:
    if named := os.environ.get("CRT_LIBRARY"):
        return named
    ours = NATIVE / f"libcrt.so.{ABI}"
    if ours.exists():
        return str(ours)
    return ctypes.util.find_library("crt") or f"libcrt.so.{ABI}"


def _load() -> ctypes.CDLL:
    try:
        loaded = ctypes.CDLL(_find())
    except OSError as error:
        raise ImportError(
            f"CRT's library cannot be loaded ({error}); CRT_LIBRARY may name its file"
        ) from error
    for name, (result, *parameters) in FUNCTIONS.items():
        if not hasattr(loaded, name):
            continue  # the library is older than this package
        function = getattr(loaded, name)
        function.restype = kind_of(result, is_result=True)
        function.argtypes = [kind_of(parameter) for parameter in parameters]
        if result == "crt_status":
            function.errcheck = _raise_error
    return loaded


def _raise_error(status: int, _function: Any, _arguments: Any) -> None:
    if status == Status.CANCELLED:
        exception = failures.taken(library.crt_cancel_value())
        if exception is not None:
            raise exception from None
    if status != Status.OK:
        raise Error(Status(status), library.crt_error_message().decode(errors="replace"))


library = _load()


def create(name: str, *arguments: Any) -> int:
    """Calls a function whose last parameter gets a handle, which is returned."""
    handle = ctypes.c_void_p()
    getattr(library, name)(*arguments, ctypes.byref(handle))
    assert handle.value is not None
    return handle.value


def version() -> tuple[int, int, int]:
    """Returns the version of the library: major, minor, patch."""
    number = library.crt_version()
    return number >> 16, number >> 8 & 0xFF, number & 0xFF
