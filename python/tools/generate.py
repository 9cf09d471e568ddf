#!/usr/bin/env python3
"""This program writes what the package has of crt.h, and the types of its values.

    python/tools/generate.py

makes three files in python/crt: _functions.py and _fields.py, which are the functions and the
structs of crt.h as tables, and values.pyi, which tells type checkers and editors the fields of
materials, lights, cameras and so on. A test checks that all three are up to date.
"""

import inspect
import os
import pathlib
import re
import sys
import textwrap
from collections.abc import Iterator
from typing import Any

PYTHON = pathlib.Path(__file__).resolve().parents[1]
HEADER = PYTHON.parent / "include/crt/crt.h"
COLUMNS = 100

NOTICE = "# python/tools/generate.py has written this file from crt.h.\n"
FUNCTIONS_DOC = '"""This table has the functions of crt.h: results, and parameters."""\n'
FIELDS_DOC = '"""This table has the structs of crt.h that may grow: fields and comments."""\n'
STUB_DOC = '"""These are the types of what values.py has."""\n'


def functions(header: str) -> str:
    """Returns the content of _functions.py."""
    plain = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
    lines = []
    for result, name, given in re.findall(r"CRT_API (\w[\w ]*?\*?) ?(crt_\w+)\(([^)]*)\);", plain):
        parameters = [] if given == "void" else [" ".join(p.split()) for p in given.split(",")]
        lines += _entry(name, [result, *parameters])
    return f"{NOTICE}{FUNCTIONS_DOC}\nFUNCTIONS = {{\n" + "\n".join(lines) + "\n}\n"


def fields(header: str) -> str:
    """Returns the content of _fields.py."""
    names = _python_names(header)
    lines = []
    for name, body in re.findall(r"typedef struct (crt_\w+) \{(.*?)\} \1;", header, re.DOTALL):
        given = list(_fields_of(body))
        if given[0][0] != "uint32_t struct_size":
            continue
        lines.append(f'    "{name}": (')
        for declaration, text in given[1:]:
            lines += _field(declaration, _renamed(text, names))
        lines.append("    ),")
    return f"{NOTICE}{FIELDS_DOC}\nFIELDS = {{\n" + "\n".join(lines) + "\n}\n"


def _python_names(header: str) -> dict[str, str]:
    """Returns what Python calls the enumerations of crt.h and their values."""
    names = {}
    for enumeration, body in re.findall(r"typedef enum (crt_\w+) \{(.*?)\} \1;", header, re.DOTALL):
        words = enumeration.split("_")[1:]
        names[enumeration] = "".join(map(str.capitalize, words))
        values = re.findall(r"^\s*CRT_(\w+)", body, re.MULTILINE)
        prefix = "ERROR_" if enumeration == "crt_status" else os.path.commonprefix(values)
        prefix = prefix[: prefix.rfind("_") + 1]
        for value in values:
            names[f"CRT_{value}"] = f"{names[enumeration]}.{value.removeprefix(prefix)}"
    return names


def _renamed(text: str, names: dict[str, str]) -> str:
    return re.sub(r"\b(crt|CRT)_\w+", lambda found: names.get(found[0], found[0]), text)


def _entry(name: str, parts: list[str]) -> list[str]:
    line = f'    "{name}": ({", ".join(map(_quoted, parts))}{"," if len(parts) == 1 else ""}),'
    if len(line) <= COLUMNS:
        return [line]
    return [f'    "{name}": (', *(f"        {_quoted(part)}," for part in parts), "    ),"]


def _field(declaration: str, text: str) -> list[str]:
    line = f"        ({_quoted(declaration)}, {_quoted(text)}),"
    if len(line) <= COLUMNS:
        return [line]
    pieces = textwrap.wrap(text, COLUMNS - 18, drop_whitespace=False)
    return [
        "        (",
        f"            {_quoted(declaration)},",
        *(f"            {_quoted(piece)}" for piece in pieces[:-1]),
        f"            {_quoted(pieces[-1])},",
        "        ),",
    ]


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _fields_of(body: str) -> Iterator[tuple[str, str]]:
    """Gives each field's declaration, and the comment before or behind it."""
    rest, before = body.strip(), ""
    while rest:
        if comment := re.match(r"/\*(.*?)\*/\s*", rest, re.DOTALL):
            before = _text(comment[1]) if comment[1].startswith("*") else ""
            rest = rest[comment.end() :]
            continue
        field = re.match(r"([^;]+);\s*(/\*\*<(.*?)\*/)?\s*", rest, re.DOTALL)
        assert field is not None, rest
        names = " ".join(field[1].split())
        yield names, before or _text(field[3] or "")
        before = ""
        rest = rest[field.end() :]


def _text(comment: str) -> str:
    words = re.sub(r"^\s*\*+", " ", comment, flags=re.MULTILINE).split()
    return " ".join(words).replace("NULL", "None")


# ---- types ------------------------------------------------------------------------------------


def stub() -> str:
    """Returns the content of values.pyi."""
    sys.path.insert(0, str(PYTHON))
    from crt import values
    from crt._structs import Struct

    lines = [
        "import enum",
        "from collections.abc import Sequence",
        "from typing import Any, Literal, SupportsFloat, SupportsIndex, TypeVar",
        "",
        "from numpy.typing import NDArray",
        "",
        "from .images import Image",
        "",
        'Self = TypeVar("Self")',
        "# What is given may be less than what is read back.",
        "GivenVector = Sequence[SupportsFloat] | NDArray[Any]",
        "Vector = Sequence[float] | NDArray[Any]",
        "ColorStops = Sequence[tuple[float, Vector] | tuple[float, Vector, float]]",
        "",
        "# Each is a ctypes.Structure, of which a checker believes that it has any attribute.",
        "class _Struct:",
        "    @classmethod",
        "    def of_type(cls: type[Self], kind: int, /, **fields: Any) -> Self: ...",
        "    @classmethod",
        "    def _filled_by(cls: type[Self], function: str, *arguments: Any) -> Self: ...",
        "    def _freeze(self: Self, why: str) -> Self: ...",
        "    def _snapshot(self: Self, why: str) -> Self: ...",
    ]
    thing: Any
    for name, thing in vars(values).items():
        if not isinstance(thing, type) or thing.__module__ != values.__name__:
            continue
        if name.startswith("_"):
            continue
        if issubclass(thing, Struct):
            lines += ["", *_struct(name, thing)]
        else:
            members: Any = thing
            lines += ["", *_names(name, [member.name.lower() for member in members])]
            lines += ["", f"class {name}(enum.IntEnum):", *_doc(thing.__doc__)]
            lines += [f"    {member.name} = {member.value}" for member in members]
    return f"{NOTICE}{STUB_DOC}\n" + "\n".join(lines) + "\n"


def _struct(name: str, struct: Any) -> Iterator[str]:
    types = struct._types()
    yield f"class {name}(_Struct):"
    yield from _doc(struct.__doc__)
    for field, type_name in types.items():
        yield f"    {field}: {type_name}"
    given = {"float": "SupportsFloat", "int": "SupportsIndex", "Vector": "GivenVector"}
    keywords = [f"{field}: {given.get(kind, kind)} = ..." for field, kind in types.items()]
    if struct._has_init:
        yield from _function("__init__", ["self", "*", *keywords], "None")
        yield from _function("set", ["self", "*", *keywords], "None")
    for method_name, method in vars(struct).items():
        if not isinstance(method, classmethod) or method_name.startswith("_"):
            continue
        parameters = list(inspect.signature(method.__func__).parameters.values())[1:]
        explicit, names = [], set()
        for parameter in parameters:
            if parameter.kind is parameter.KEYWORD_ONLY:
                names.add(parameter.name)
                continue
            default = "" if parameter.default is parameter.empty else " = ..."
            explicit.append(f"{parameter.name}: {_annotation(parameter.annotation)}{default}")
        rest = [keyword for keyword in keywords if keyword.split(":")[0] in names]
        yield "    @classmethod"
        yield from _function(method_name, ["cls", *explicit, "*", *rest], name, method.__doc__)


def _names(name: str, members: list[str]) -> list[str]:
    """Returns the type of what members may be called."""
    lines = textwrap.wrap(", ".join(f'"{member}"' for member in members), COLUMNS - 4)
    if len(lines) == 1 and len(lines[0]) + len(name) + 17 <= COLUMNS:
        return [f"{name}Name = Literal[{lines[0]}]"]
    return [f"{name}Name = Literal[", *(f"    {line}" for line in lines), "]"]


def _annotation(annotation: Any) -> str:
    return annotation if isinstance(annotation, str) else str(annotation.__name__)


def _function(name: str, parts: list[str], result: str, doc: str | None = None) -> Iterator[str]:
    line = f"    def {name}({', '.join(parts)}) -> {result}:"
    if len(line) + 4 <= COLUMNS:
        yield line + ("" if doc else " ...")
    else:
        yield f"    def {name}("
        yield from (f"        {part}," for part in parts)
        yield f"    ) -> {result}:" + ("" if doc else " ...")
    if doc:
        yield from ("    " + line for line in _doc(doc))


def _doc(doc: str | None) -> Iterator[str]:
    lines = inspect.cleandoc(doc or "").splitlines()
    if len(lines) == 1:
        yield f'    """{lines[0]}"""'
        return
    yield f'    """{lines[0]}'
    yield from (f"    {line}" if line else "" for line in lines[1:])
    yield '    """'


def main() -> None:
    header = HEADER.read_text()
    (PYTHON / "crt/_functions.py").write_text(functions(header))
    (PYTHON / "crt/_fields.py").write_text(fields(header))
    (PYTHON / "crt/values.pyi").write_text(stub())


if __name__ == "__main__":
    main()
