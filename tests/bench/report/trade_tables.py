"""Writes tables of accuracy against time, and of claimed against achieved errors."""

import statistics

from trade import curves, ladders
from trade.curves import Need

from .tables import povray_results, rounded, table

ERRORS = {"rmse": "RMSE", "p999": "99.9 %"}
CRT_FAMILIES = (ladders.GRID, ladders.ADAPTIVE, ladders.LOW_START)
TOLD = ((ladders.LOW_START, "8/255"), (ladders.ADAPTIVE, "8/255"), (ladders.ADAPTIVE, "2/255"),
        (ladders.ADAPTIVE, "1/255"), (ladders.ADAPTIVE, "0.5/255"))


def scenes_of(results: dict) -> dict[str, dict]:
    return povray_results(results, "trade/")


def classes_of(results: dict) -> dict[str, dict]:
    return povray_results(results, "honesty/")


def text_of(need: Need) -> str:
    return need.bound + rounded(need.value)


def inverse(bound: str) -> str:
    return {"<": ">", ">": "<"}.get(bound, "")


# ---- each scene ---------------------------------------------------------------------------------


def text_of_error(result: dict, row: dict, error: str) -> str:
    return rounded(row[error]) + ("" if curves.is_sensible(result, row, error) else " (?)")


def pair(error: dict) -> str:
    return f"{error['rmse']:.3f} / {error['p999']:.2f}"


def scene_table(name: str, result: dict) -> str:
    uncertain = result["uncertainty"]
    lines = [f"## `{name}`: {result['about']}", "",
             f"{result['width']} x {result['height']} pixels, {result['hard']:.1%} of them hard."
             f" The references are"
             f" uncertain by {pair(uncertain['CRT'])} (CRT) and {pair(uncertain['POV-Ray'])}"
             f" (POV-Ray); they differ by"
             f" {pair(result['apart'])}.", ""]
    rows = [[row["family"], f"`{row['name']}`", rounded(row["seconds"]), rounded(row["samples"]),
             *(text_of_error(result, row, error) for error in ERRORS)]
            for row in sorted(result["rows"], key=lambda row: row["family"])]
    return "\n".join(lines) + "\n" + table(
        ["", "setting", "seconds", "rays a pixel", *ERRORS.values()], rows
    )


def scene_tables(results: dict) -> str:
    return "\n\n".join(scene_table(*item) for item in scenes_of(results).items())


# ---- samples: adaptive against the grid ---------------------------------------------------------


def saved(result: dict, row: dict, error: str) -> Need | None:
    """Returns how many times as many samples the grid needs for the error of an adaptive
    setting."""
    if not curves.is_sensible(result, row, error):
        return None
    grid = curves.need(curves.family(result, ladders.GRID), "samples", error, row[error])
    return Need(grid.value / row["samples"], grid.bound)


def samples_cell(result: dict, row: dict) -> str:
    return rounded(row["samples"])


def saving_cell(result: dict, row: dict) -> str:
    """Returns how many times as many samples it takes for the same RMSE / for the same 99.9 %
    error."""
    both = [saved(result, row, error) for error in ERRORS]
    return " / ".join("?" if one is None else text_of(one) for one in both)


def cells_by_setting(result: dict, cell) -> list[str]:
    found = [
        [row for row in curves.family(result, family) if row["name"] == target]
        for family, target in TOLD
    ]
    return [cell(result, rows[0]) if rows else "" for rows in found]


def saving_table(results: dict) -> str:
    scenes = {name: result for name, result in scenes_of(results).items() if name != "flat"}
    if not scenes:
        return ""
    heads = [
        f"{target} from 4" if family == ladders.LOW_START else target for family, target in TOLD
    ]
    samples = [[f"`{name}`", f"{result['hard']:.0%}", *cells_by_setting(result, samples_cell)]
               for name, result in scenes.items()]
    factors = [
        [f"`{name}`", *cells_by_setting(result, saving_cell)] for name, result in scenes.items()
    ]
    return ("Samples a pixel, by target error (*from 4*: with `minsamples` 4):\n\n"
            + table(["scene", "hard pixels", *heads], samples)
            + "\n\nHow many times as many the grid needs for the same RMSE / the same 99.9 %"
              " error:\n\n"
            + table(["scene", *heads], factors))


# ---- time: CRT against POV-Ray ------------------------------------------------------------------


def crt_need(result: dict, error: str, wanted: float) -> Need:
    families = [curves.family(result, name) for name in CRT_FAMILIES]
    return curves.least([curves.need(rows, "seconds", error, wanted) for rows in families if rows])


def povray_rows(result: dict) -> list[dict]:
    return [row for row in result["rows"] if row["family"].startswith("POV-Ray")]


def finest_of_povray(result: dict) -> dict:
    return min(povray_rows(result), key=lambda row: row["rmse"])


def contest_row(result: dict, row: dict) -> tuple[list[str], list[float]]:
    cells, ratios = [rounded(row["seconds"])], []
    for error in ERRORS:
        need = crt_need(result, error, row[error])
        ratio = row["seconds"] / need.value
        ratios.append(ratio)
        cells += [
            text_of_error(result, row, error), text_of(need),
            f"**{inverse(need.bound)}{rounded(ratio)}**"
        ]
    return cells, ratios


def contest_table(results: dict, choose, heading: str) -> str:
    rows, all_ratios = [], []
    for name, result in scenes_of(results).items():
        if name == "flat":  # both are right with one ray a pixel
            continue
        cells, ratios = contest_row(result, choose(result))
        rows.append([f"`{name}`", *cells])
        all_ratios.append(ratios)
    if not rows:
        return ""
    head = ["scene", "POV-Ray"]
    for error in ERRORS.values():
        head += [f"its {error}", "CRT", "ratio"]
    medians = [rounded(statistics.median(ratios)) for ratios in zip(*all_ratios)]
    return (table(head, rows)
            + f"\n\nTimes are in seconds; POV-Ray's are with {heading}. The median of the ratios"
              f" is {medians[0]} for the RMSE and {medians[1]} for the 99.9 % error.")


def named_table(results: dict) -> str:
    return contest_table(results,
                         lambda result: curves.named(result, ladders.RECURSIVE, ladders.NAMED),
                         f"`{ladders.NAMED}`")


def finest_table(results: dict) -> str:
    return contest_table(results, finest_of_povray, "its finest setting")


def overhead_table(results: dict) -> str:
    rows = [[f"`{name}`", str(at["samples"]), rounded(at["grid"]), rounded(at["passes"]),
             f"**{at['ratio']:.3f}**"]
            for name, result in scenes_of(results).items() for at in result.get("overhead", [])]
    return (
        table(["scene", "samples a pixel", "grid, seconds", "passes, seconds", "ratio"], rows)
        if rows else ""
    )


def vanished_text(results: dict) -> str:
    found = [result["vanished"] for result in scenes_of(results).values() if "vanished" in result]
    if not found:
        return ""
    targets = " and ".join(
        f"{count} at a target error of {steps}/255" for steps, count in found[0]["targets"].items()
    )
    return (f"In `wires` {found[0]['pixels']} pixels are covered by more than 5 %. Of these,"
            f" rendered with `minsamples`"
            f" {found[0]['least_samples']} and each of {found[0]['seeds']} seeds, so many show the"
            f" bare background:"
            f" {targets}.")


# ---- honesty ------------------------------------------------------------------------------------


def honesty_table(results: dict) -> str:
    rows = []
    for name, result in classes_of(results).items():
        targets = result["targets"]
        rows.append([name, str(targets[0]["pixels"]), str(result["seeds"]),
                     rounded(result["uncertainty"]),
                     *(
                         f"{row['within'] / row['trials']:.2%} ({row['low']:.2%})"
                         for row in targets
                     ),
                     f"{min(row['worst_pixel'] for row in targets):.0%}"])
    if not rows:
        return ""
    steps = [f"{row['steps']:g}/255" for row in next(iter(classes_of(results).values()))["targets"]]
    return table(["pixels", "number", "seeds", "truth +-", *steps, "worst pixel"], rows)


def all_tables(results: dict) -> str:
    makers = (
        scene_tables, saving_table, named_table, finest_table, overhead_table, vanished_text,
        honesty_table,
    )
    return "\n\n".join(filter(None, (make(results) for make in makers)))
