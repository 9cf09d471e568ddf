"""Draws plots of accuracy as SVG: small panels side by side, both axes logarithmic."""

import math
from dataclasses import dataclass

from trade import ladders

from . import trade_tables
from .plots import FAINT, FRAME, Drawing, power

WIDE, TALL, GAP_X, GAP_Y, LEFT, TOP = 220, 170, 56, 58, 50, 52
COLUMNS = 3
HEADS = {"rmse": "RMSE", "p999": "99.9 % error"}
FAMILY_COLORS = {
    ladders.GRID: "#1f5fa8", ladders.ADAPTIVE: "#c0392b", ladders.LOW_START: "#e59866",
    ladders.ONE_RAY: "#888888",
    ladders.PLAIN: "#2e8b57", ladders.RECURSIVE: "#8e44ad", ladders.LENS: "#2e8b57",
    ladders.LENS_BY_VARIANCE: "#d68910",
}


@dataclass(frozen=True)
class Line:
    name: str
    color: str
    points: list[tuple[float, float]]


@dataclass(frozen=True)
class Panel:
    title: str
    lines: list[Line]
    with_diagonal: bool = False


def decades(values: list[float]) -> tuple[int, int]:
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def draw_panel(drawing: Drawing, panel: Panel, left: float, top: float) -> None:
    points = [point for line in panel.lines for point in line.points]
    low_x, high_x = decades([x for x, _ in points])
    low_y, high_y = decades([y for _, y in points])
    if panel.with_diagonal:
        low_x = low_y = min(low_x, low_y)
        high_x = high_y = max(high_x, high_y)

    def place(x: float, y: float) -> tuple[float, float]:
        return (left + WIDE * (math.log10(x) - low_x) / (high_x - low_x),
                top + TALL * (high_y - math.log10(y)) / (high_y - low_y))

    drawing.text(left, top - 6, panel.title, weight="bold")
    for exponent in range(low_x, high_x + 1):
        x = place(10.0**exponent, 10.0**low_y)[0]
        drawing.line(x, top, x, top + TALL, FAINT)
        drawing.text(x, top + TALL + 14, power(exponent), "middle")
    for exponent in range(low_y, high_y + 1):
        y = place(10.0**low_x, 10.0**exponent)[1]
        drawing.line(left, y, left + WIDE, y, FAINT)
        drawing.text(left - 5, y + 4, power(exponent), "end")
    if panel.with_diagonal:
        drawing.line(*place(10.0**low_x, 10.0**low_y), *place(10.0**high_x, 10.0**high_y), FRAME)
    for line in panel.lines:
        drawing.curve([place(*point) for point in line.points], line.color)


def drawn(title: str, axes: str, panels: list[Panel]) -> str:
    rows = math.ceil(len(panels) / COLUMNS)
    legend = {line.name: line.color for panel in panels for line in panel.lines}
    width = LEFT + COLUMNS * (WIDE + GAP_X)
    height = TOP + rows * (TALL + GAP_Y) + 20 * math.ceil(len(legend) / COLUMNS) + 10
    drawing = Drawing(width, height)
    drawing.text(LEFT, 16, title, weight="bold")
    drawing.text(LEFT, 31, axes)
    for index, panel in enumerate(panels):
        row, column = divmod(index, COLUMNS)
        draw_panel(drawing, panel, LEFT + column * (WIDE + GAP_X), TOP + 8 + row * (TALL + GAP_Y))
    below = TOP + rows * (TALL + GAP_Y)
    for index, (name, color) in enumerate(legend.items()):
        x, y = LEFT + (index % COLUMNS) * (WIDE + GAP_X), below + 20 * (index // COLUMNS)
        drawing.rectangle(x, y, 10, 10, color)
        drawing.text(x + 15, y + 9, name)
    return drawing.svg()


def error_against_time(results: dict, error: str) -> str:
    """Draws each scene with pixels that are not flat."""
    panels = []
    for name, result in trade_tables.scenes_of(results).items():
        if name == "flat":
            continue
        lines = []
        for family, color in FAMILY_COLORS.items():
            rows = sorted(
                (row for row in result["rows"] if row["family"] == family),
                key=lambda row: row["seconds"],
            )
            points = [(max(row["seconds"], 1e-3), row[error]) for row in rows if row[error] > 0]
            if points:
                lines.append(Line(family, color, points))
        panels.append(Panel(f"{name} ({result['hard']:.0%} hard)", lines))
    return drawn(f"{HEADS[error]} against seconds",
                 "across: seconds of tracing, one thread; up: 8-bit steps of what a display shows",
                 panels)


def achieved_against_claimed(results: dict) -> str:
    panels = []
    for name, result in trade_tables.classes_of(results).items():
        bins = [one for one in result["bins"] if one["count"] >= result["seeds"] and one["rms"] > 0]
        if not bins:
            continue
        lines = [
            Line("95 of 100 errors are below", "#c0392b",
                 [(one["claimed"], one["within_95"]) for one in bins
                                                           if one["within_95"] > 0]),
            Line(
                "root of the mean square", "#1f5fa8", [(one["claimed"], one["rms"]) for one in bins]
            ),
        ]
        panels.append(Panel(name, lines, with_diagonal=True))
    return drawn("Achieved against claimed errors, where the renderer stopped",
                 "across: the half-width that is claimed; up: errors; 8-bit steps of what a"
                 " display shows", panels)
