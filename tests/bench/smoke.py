"""Checks that CRT still takes the scenes that are measured.

    smoke.py CRT LIBRARY FOLDER [BENCH_HONESTY]

Checks the script of each (but the large ones), and renders one of each kind, tiny. Measures error
against time, tiny, where there is POV-Ray, and honesty, if its program is given.
"""

import dataclasses
import json
import os
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from povray import catalogue, measure, threads, trade_scenes  # noqa: E402
from povray.programs import Size, run  # noqa: E402
from report import tables, trade_plots, trade_tables  # noqa: E402
from trade import honesty, ladders  # noqa: E402
from trade import measure as trade_measure  # noqa: E402

LARGE = ("-1e3", "-1e4", "-1e5", "-1e6", "-500", "-4096")
RENDERED = ("tunnel-1e1", "lens-union-1e2", "mirror-room", "glass", "nested-50", "mesh-1e4",
            "height-field-512", "lens-scene", "mirror-cabinet")


MEASURED = ("wires", "defocus", "flat")


def check_catalogue(crt: pathlib.Path, folder: pathlib.Path) -> None:
    plan = measure.Plan(crt=crt, folder=folder, size=Size(12, 9), rounds=1, threads=(1,), longest=1,
                        patience=1,
                        say=print)
    for name, make in catalogue.SCENES.items():
        if name.endswith(LARGE) and name not in RENDERED:
            continue
        program, _ = measure.write_scripts(make(), name, plan)
        run([crt, "check", program.script], None, folder)
        if name not in RENDERED:
            continue
        picture = folder / f"{name}.png"
        program.trace(plan.size, 1, picture)
        if json.loads(picture.with_suffix(".json").read_text())["rays"]["shadow"] == 0:
            raise SystemExit(f"{name}: no surface is lit")
    plan = dataclasses.replace(plan, size=Size(64, 48), threads=(1, 2))
    print(
        tables.threads_table(
            {"threads/glass": threads.measure("glass", catalogue.SCENES["glass"](), plan)}
        )
    )


def check_trade(library: pathlib.Path, folder: pathlib.Path) -> dict:
    """Measures what is measured, in pictures of a few pixels."""
    plan = trade_measure.Plan(
        library=library, folder=folder, rounds=1, patience=1, quick=True, say=print, divisor=15
    )
    for name in trade_scenes.SCENES:
        trade_measure.contest(name, plan).crt.render(
            {"targeterror": 8 * ladders.STEP, "maxsamples": 16}
        )
    if shutil.which("povray") is None:
        return {}
    return {f"trade/{name}": trade_measure.measure(name, plan) for name in MEASURED}


def main() -> int:
    # sanitizers, for this process and its libcrt; POV-Ray does not run with them
    os.environ.pop("LD_PRELOAD", None)
    crt, library, folder, *rest = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    check_catalogue(crt, folder)
    results = check_trade(library, folder)
    for program in rest:
        results["honesty/edge"] = honesty.measure("edge", program, folder, quick=True)
    if results:
        print(trade_tables.all_tables(results))
        trade_plots.error_against_time(results, "rmse")
        trade_plots.achieved_against_claimed(results)
    return 0


if __name__ == "__main__":
    sys.exit(main())
