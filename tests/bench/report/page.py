"""Puts tables into docs/speed.md, each between its own markers; the rest of the page is written by hand."""

import pathlib
import re

from . import plots, tables


def filled(page: str, name: str, text: str) -> str:
    begin, end = f"<!-- measured: {name} -->", f"<!-- end: {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise ValueError(f"the page has no place for {name}: no {begin} ... {end}")
    return pattern.sub(lambda _: f"{begin}\n{text}\n{end}", page)


def with_plot(caption: str, file: str, table: str) -> str:
    return f"![{caption}]({file})\n\n{table}" if table else ""


def write(folder: pathlib.Path, results: dict, machine: str) -> None:
    texts = {"machine": machine,
             "povray": with_plot("How many times as long POV-Ray traces, for each scene", "speed.svg",
                                 tables.povray_table(results)),
             "povray, BSP tree": tables.bsp_table(results), "embree": tables.embree_table(results),
             "curves": with_plot("Nanoseconds a ray against the number of solids", "speed_curves.svg",
                                 tables.curves_table(results))}
    path = folder / "speed.md"
    page = path.read_text()
    for name, text in texts.items():
        if text:
            page = filled(page, name, text)
    path.write_text(page)
    if texts["povray"]:
        (folder / "speed.svg").write_text(plots.ratio_bars(results))
    if texts["curves"]:
        (folder / "speed_curves.svg").write_text(plots.cost_curves(results))
