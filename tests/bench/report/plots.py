"""Draws plots as SVG."""

import math
import statistics
from html import escape

from . import tables

COLORS = ("#1f5fa8", "#c0392b", "#2e8b57", "#8e44ad", "#d68910")
FAINT, FRAME = "#ddd", "#888"


class Drawing:
    def __init__(self, width: float, height: float) -> None:
        self.parts = [f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {width:g} {height:g}'"
                      " font-family='sans-serif' font-size='11'>", "<rect width='100%'"
                                                                   " height='100%' fill='white'/>"]

    def text(
        self, x: float, y: float, text: str, anchor: str = "start", weight: str = "normal"
    ) -> None:
        self.parts.append(
            f"<text x='{x:.1f}' y='{y:.1f}' text-anchor='{anchor}'"
            f" font-weight='{weight}'>{escape(text)}</text>")

    def line(
        self, x1: float, y1: float, x2: float, y2: float, color: str, width: float = 1
    ) -> None:
        self.parts.append(f"<line x1='{x1:.1f}' y1='{y1:.1f}' x2='{x2:.1f}' y2='{y2:.1f}'"
                          f" stroke='{color}'"
                          f" stroke-width='{width:g}'/>")

    def rectangle(self, x: float, y: float, width: float, height: float, color: str) -> None:
        self.parts.append(
            f"<rect x='{x:.1f}' y='{y:.1f}' width='{width:.1f}' height='{height:.1f}'"
            f" fill='{color}'/>"
        )

    def curve(self, points: list[tuple[float, float]], color: str) -> None:
        places = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(
            f"<polyline points='{places}' fill='none' stroke='{color}' stroke-width='2'/>"
        )
        self.parts += [
            f"<circle cx='{x:.1f}' cy='{y:.1f}' r='3' fill='{color}'/>" for x, y in points
        ]

    def svg(self) -> str:
        return "\n".join(self.parts) + "\n</svg>\n"


def power(exponent: int) -> str:
    return f"{10.0**exponent:g}" if -2 <= exponent <= 3 else f"10^{exponent}"


def ratio_bars(results: dict) -> str:
    """Draws how many times as long POV-Ray takes, a bar for each number of threads."""
    scenes = tables.povray_results(results)
    threads = list(next(iter(scenes.values()))["threads"])
    bar, gap, left, top, wide = 12, 8, 120, 44, 560
    row = bar * len(threads) + gap
    ratios = [times["ratio"] for scene in scenes.values() for times in scene["threads"].values()]
    low = min(0, math.floor(math.log10(min(ratios))))
    high = math.ceil(math.log10(max(ratios)))

    def place(ratio: float) -> float:
        return left + wide * (math.log10(ratio) - low) / (high - low)

    bottom = top + row * len(scenes)
    drawing = Drawing(left + wide + 60, bottom + 30)
    drawing.text(left, 16, "POV-Ray's time of tracing / CRT's", weight="bold")
    for index, count in enumerate(threads):
        drawing.rectangle(left + 130 * index, 24, 10, 10, COLORS[index])
        drawing.text(left + 130 * index + 15, 33, tables.plural(count))
    for exponent in range(low, high + 1):
        x = place(10.0**exponent)
        drawing.line(x, top, x, bottom, FRAME if exponent == 0 else FAINT)
        drawing.text(x, bottom + 14, power(exponent), "middle")
    for index, (name, scene) in enumerate(scenes.items()):
        y = top + row * index + gap / 2
        drawing.text(left - 6, y + row / 2, name, "end")
        for nth, count in enumerate(threads):
            x = place(scene["threads"][count]["ratio"])
            drawing.rectangle(
                min(x, place(1)), y + bar * nth, abs(x - place(1)), bar - 1, COLORS[nth]
            )
            drawing.text(
                max(x, place(1)) + 4, y + bar * nth + 9,
                tables.rounded(scene["threads"][count]["ratio"]),
            )
    return drawing.svg()


def cost_curves(results: dict) -> str:
    """Draws nanoseconds a ray against N, both logarithmic."""
    curves = tables.curves_by_name(results)
    points = {name: [(n, statistics.median(point["nanoseconds"]))
                     for n, point in sorted(rows.items())]
              for name, rows in curves.items()}
    every = [point for line in points.values() for point in line]
    most_n = round(math.log10(max(n for n, _ in every)))
    low = math.floor(math.log10(min(time for _, time in every)))
    high = math.ceil(math.log10(max(time for _, time in every)))
    left, top, wide, tall = 60, 30, 520, 320

    def place(n: float, time: float) -> tuple[float, float]:
        return (
            left + wide * math.log10(n) / most_n,
            top + tall * (high - math.log10(time)) / (high - low),
        )

    drawing = Drawing(left + wide + 150, top + tall + 40)
    drawing.text(left, 18, "nanoseconds a ray against N, one thread", weight="bold")
    for exponent in range(low, high + 1):
        y = place(1, 10.0**exponent)[1]
        drawing.line(left, y, left + wide, y, FAINT)
        drawing.text(left - 6, y + 4, power(exponent), "end")
    for exponent in range(most_n + 1):
        x = place(10.0**exponent, 10.0**low)[0]
        drawing.line(x, top, x, top + tall, FAINT)
        drawing.text(x, top + tall + 16, power(exponent), "middle")
    for index, (name, line) in enumerate(points.items()):
        drawing.curve([place(*point) for point in line], COLORS[index])
        drawing.rectangle(left + wide + 16, top + 20 * index, 10, 10, COLORS[index])
        drawing.text(left + wide + 31, top + 20 * index + 9, name)
    return drawing.svg()
