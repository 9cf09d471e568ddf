"""Says what a family of settings takes for an accuracy, between its settings by straight lines in
logarithms."""

import math
from dataclasses import dataclass

SENSIBLE = 2  # times its reference's uncertainty: an error below that says nothing


@dataclass(frozen=True)
class Need:
    value: float
    # "<": it takes at most so much, there is nothing coarser; ">": there is nothing finer
    bound: str = ""


def family(result: dict, name: str) -> list[dict]:
    return [row for row in result["rows"] if row["family"] == name]


def named(result: dict, family_name: str, name: str) -> dict:
    return next(row for row in family(result, family_name) if row["name"] == name)


def is_sensible(result: dict, row: dict, error: str) -> bool:
    program = row["family"].split(",")[0].split()[0]
    return row[error] > SENSIBLE * result["uncertainty"][program][error]


def front(rows: list[dict], cost: str, error: str) -> list[tuple[float, float]]:
    """Returns (cost, error) of those that nothing cheaper beats, the cheapest first."""
    points: list[tuple[float, float]] = []
    for row in sorted(rows, key=lambda row: (row[cost], row[error])):
        if not points or row[error] < points[-1][1]:
            points.append((max(row[cost], 1e-9), max(row[error], 1e-9)))
    return points


def need(rows: list[dict], cost: str, error: str, wanted: float) -> Need:
    points = front(rows, cost, error)
    if wanted >= points[0][1]:
        return Need(points[0][0], "" if wanted == points[0][1] else "<")
    if wanted < points[-1][1]:
        return Need(points[-1][0], ">")
    for (cheap, coarse), (dear, fine) in zip(points, points[1:]):
        if fine <= wanted <= coarse:
            share = (math.log(coarse) - math.log(wanted)) / (math.log(coarse) - math.log(fine))
            return Need(math.exp(math.log(cheap) + share * (math.log(dear) - math.log(cheap))))
    raise AssertionError("errors of a front fall")


def least(needs: list[Need]) -> Need:
    """Returns the need of the family that takes least. What no family reaches is the dearest's."""
    reached = [one for one in needs if one.bound != ">"]
    return (
        min(reached, key=lambda one: one.value) if reached
        else max(needs, key=lambda one: one.value)
    )
