"""Puts tables into docs/speed.md, each between its own markers; the rest of the page is written by hand."""

import pathlib
import re

from . import tables


def fill(page: str, name: str, text: str) -> str:
    begin, end = f"<!-- measured: {name} -->", f"<!-- end: {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    return pattern.sub(lambda _: f"{begin}\n{text}\n{end}", page)


def write(folder: pathlib.Path, results: dict) -> None:
    path = folder / "speed.md"
    page = path.read_text()
    for name, text in {"povray": tables.povray_table(results)}.items():
        if text:
            page = fill(page, name, text)
    path.write_text(page)
