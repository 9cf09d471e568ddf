"""Puts tables into the pages of docs/, each between its own markers. The rest of a page is written
by hand."""

import pathlib
import re
import textwrap

from . import plots, tables, trade_plots, trade_tables


def wrapped(text: str) -> str:
    """Breaks lines of prose that are longer than a page of docs/ has them. Rows of tables and
    headings stay whole."""
    def lines_of(line: str) -> str:
        if len(line) <= 100 or line.startswith(("|", "#", "![")):
            return line
        return textwrap.fill(line, 99, subsequent_indent="  " if line.startswith("- ") else "",
                             break_long_words=False, break_on_hyphens=False)

    return "\n".join(lines_of(line) for line in text.split("\n"))


def filled(page: str, name: str, text: str) -> str:
    begin, end = f"<!-- measured: {name} -->", f"<!-- end: {name} -->"
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
    if not pattern.search(page):
        raise ValueError(f"the page has no place for {name}: no {begin} ... {end}")
    return pattern.sub(lambda _: f"{begin}\n{wrapped(text)}\n{end}", page)


def with_plot(caption: str, file: str, table: str) -> str:
    return f"![{caption}]({file})\n\n{table}" if table else ""


def fill(path: pathlib.Path, texts: dict[str, str]) -> None:
    """Puts in the texts that are not empty."""
    page = path.read_text()
    for name, text in texts.items():
        if text:
            page = filled(page, name, text)
    path.write_text(page)


def write(folder: pathlib.Path, results: dict, machine: str) -> None:
    write_speed(folder, results, machine)
    write_trade(folder, results, machine)


def write_speed(folder: pathlib.Path, results: dict, machine: str) -> None:
    texts = {"povray": with_plot("How many times as long POV-Ray traces, for each scene",
                                 "speed.svg",
                                 tables.povray_table(results)),
             "povray, scenes": tables.scene_list(results),
             "povray, BSP tree": tables.bsp_table(results),
             "threads": tables.threads_table(results),
             "embree": tables.embree_table(results),
             "meshes": tables.meshes_table(results),
             "curves": with_plot("Nanoseconds a ray against the number of solids",
                                 "speed_curves.svg",
                                 tables.curves_table(results))}
    if not any(texts.values()):
        return
    fill(folder / "speed.md", {"machine": machine, **texts})
    if texts["povray"]:
        (folder / "speed.svg").write_text(plots.ratio_bars(results))
    if texts["curves"]:
        (folder / "speed_curves.svg").write_text(plots.cost_curves(results))


def write_trade(folder: pathlib.Path, results: dict, machine: str) -> None:
    texts = {"samples": trade_tables.saving_table(results),
             "overhead": trade_tables.overhead_table(results),
             "povray": with_plot("Error against time, for each scene", "trade_rmse.svg",
                                 trade_tables.named_table(results)),
             "povray, finest": trade_tables.finest_table(results),
             "vanished": trade_tables.vanished_text(results),
             "honesty": with_plot("Achieved against claimed errors, by class of pixels",
                                  "trade_honesty.svg",
                                  trade_tables.honesty_table(results))}
    if not any(texts.values()):
        return
    fill(folder / "trade_measured.md", {"machine": machine, **texts})
    fill(folder / "trade_scenes.md", {
        "machine": machine,
        "scenes": with_plot("What 99.9 % of the pixels stay below, against time", "trade_p999.svg",
                                                trade_tables.scene_tables(results))})
    if texts["povray"]:
        (folder / "trade_rmse.svg").write_text(trade_plots.error_against_time(results, "rmse"))
        (folder / "trade_p999.svg").write_text(trade_plots.error_against_time(results, "p999"))
    if texts["honesty"]:
        (folder / "trade_honesty.svg").write_text(trade_plots.achieved_against_claimed(results))
