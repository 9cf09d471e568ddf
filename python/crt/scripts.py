"""This module runs scripts in the CRT language."""

import ctypes
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from . import _arguments
from ._callbacks import OPEN_FILE, POLL, PRINT, Guard
from ._library import create, library
from ._structs import Struct, growable, texts
from .diagnostics import diagnostics_of
from .errors import Diagnostic, Error, ScriptError, Status, of_reading
from .expressions import to_expressions

Path = str | os.PathLike[str]
Print = Callable[[str], Any]
OpenFile = Callable[[str], bytes | None]


@growable("crt_script_options", shown="a script")
class ScriptOptions(Struct):
    """ScriptOptions say what a script may see and use."""


LIMITS = [name for name in ScriptOptions._kinds if name.startswith("max_")]


def make_options(
    *,
    variables: Mapping[str, Any],
    settings: Mapping[str, Any],
    t: float,
    compat: int,
    resource_directories: Iterable[Path],
    limits: Mapping[str, int],
) -> ScriptOptions:
    """Returns the struct, without callbacks."""
    for limit in limits:
        if limit not in LIMITS:
            raise TypeError(f"a script has no argument {limit!r}; limits are {', '.join(LIMITS)}")
    options = ScriptOptions(t=t, compat=compat, **limits)
    options.set(**_pairs("variable", variables), **_pairs("setting", settings))
    if isinstance(resource_directories, (str, os.PathLike)):
        resource_directories = (resource_directories,)
    directories = [_arguments.text(one, "resource_directories") for one in resource_directories]
    options.resource_directories = texts(directories)
    options.resource_directory_count = len(directories)
    return options


def run(
    script: str | None,
    name: Path,
    *,
    variables: Mapping[str, Any],
    settings: Mapping[str, Any],
    t: float,
    compat: int,
    resource_directories: Iterable[Path],
    allow_outside_files: bool,
    print: Print | None,
    open_file: OpenFile | None,
    limits: Mapping[str, int],
) -> tuple[int, list[Diagnostic]]:
    """Runs a text, or the file that is named if there is none. Returns the handle of the scene, and
    the warnings."""
    guard = Guard()
    options = make_options(
        variables=variables,
        settings=settings,
        t=t,
        compat=compat,
        resource_directories=resource_directories,
        limits=limits,
    )
    options.allow_outside_files = allow_outside_files
    options.poll = POLL(lambda _user: guard.call(_nothing))
    if print is not None:
        options.print = _print_callback(guard, print)
    if open_file is not None:
        options.open_file = _open_file_callback(guard, open_file)
    with guard.raising():
        return _call(script, name, options)


def _call(script: str | None, name: Path, options: ScriptOptions) -> tuple[int, list[Diagnostic]]:
    said = ctypes.c_void_p()
    rest = ctypes.byref(options), ctypes.byref(said)
    try:
        if script is None:
            scene = create("crt_scene_from_script_file", name, *rest)
        else:
            code = script.encode()
            scene = create("crt_scene_from_script", code, len(code), name, *rest)
    except Error as error:
        if said.value is None:
            raise
        text, diagnostics = diagnostics_of(said.value)
        first = diagnostics[0]
        if script is None and error.status == Status.IO and first.line == 0:
            # The script itself could not be read.
            raise of_reading(f"{first.file}: {first.message}", os.fspath(name)) from None
        raise ScriptError(error.status, text, diagnostics) from None
    return scene, [] if said.value is None else diagnostics_of(said.value)[1]


def refuse_path(script: str) -> None:
    """Refuses a text that can only be meant as the path of a script."""
    if "\n" in script or "{" in script or '"' in script:
        return
    if script.strip().lower().endswith(".crt") or (script and os.path.isfile(script)):
        raise ValueError(
            f"{_arguments.shown(script)} is a path, not the text of a script:"
            f" use crt.Scene.from_file({script!r})"
        )


def refuse_text(path: Path) -> None:
    """Refuses a path that can only be meant as the text of a script."""
    if isinstance(path, str) and ("\n" in path or "{" in path) and not os.path.exists(path):
        raise ValueError(
            f"{_arguments.shown(path)} is the text of a script, not a path: use"
            " crt.Scene.from_script()"
        )


def _pairs(kind: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the three fields of the options that have names, values and their count."""
    if not isinstance(values, Mapping):
        raise _arguments.refusal(f"{kind}s", "a dict of names and values", values)
    names, expressions = to_expressions(values)
    return {
        f"{kind}_names": texts(_arguments.text(name, f"the name of a {kind}") for name in names),
        f"{kind}_values": texts(_arguments.text(one, f"a {kind}") for one in expressions),
        f"{kind}_count": len(names),
    }


def _nothing() -> None:
    """Does nothing, as a callback that only checks whether another one has raised something."""


def _print_callback(guard: Guard, print: Print) -> Any:
    def call(line: bytes) -> None:
        print(line.decode(errors="replace"))

    return PRINT(lambda line, length, _user: guard.call(call, ctypes.string_at(line, length)))


def _open_file_callback(guard: Guard, open_file: OpenFile) -> Any:
    given, not_given = 0, 1

    def call(path: bytes, content: int) -> int:
        found = open_file(os.fsdecode(path))
        if found is None:
            return not_given
        library.crt_file_content_append(content, bytes(found), len(found))
        return given

    return OPEN_FILE(lambda path, content, _user: guard.call(call, path, content))
