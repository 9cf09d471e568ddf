"""Checks that CRT still takes the scenes that are measured.

    smoke.py CRT LIBRARY FOLDER [BENCH_HONESTY]

Checks the script of each (but the large ones), and renders one of each kind, tiny. Renders scenes
of soft and bounced light, and writes the twins of examples. Measures error against time, tiny,
where there is POV-Ray, and honesty, if its program is given.
"""

import dataclasses
import json
import os
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from povray import catalogue, light_scenes, lights, measure, threads  # noqa: E402
from povray import trade_scenes, twins  # noqa: E402
from povray.programs import Size, run  # noqa: E402
from report import tables, trade_plots, trade_tables  # noqa: E402
from trade import honesty, ladders  # noqa: E402
from trade import measure as trade_measure  # noqa: E402
from trade.programs import binding  # noqa: E402

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


TWINS = ("part", "still_life", "room", "product", "mechanism")


def check_lights(crt: pathlib.Path, library: pathlib.Path, folder: pathlib.Path) -> None:
    """Renders the scenes of light by CRT, tiny, and writes the twins of the examples. Where there
    is POV-Ray it has to show an example as bright as CRT does, within a factor of two."""
    for scene in light_scenes.SCENES:
        contest = lights.Contest(scene, binding(library), folder, width=16, threads=1)
        if not 0.02 < contest.by_crt({"supersampling": 4}).pixels.mean() < 0.9:
            raise SystemExit(f"{scene.name}: is too dark or too bright to compare noise in")
    examples = pathlib.Path(__file__).resolve().parents[2] / "examples/scenes"
    for name in TWINS:
        twins.write_twin(crt, examples / f"{name}.crt", (16, 12), folder / f"{name}.pov")
    if shutil.which("povray") is None:
        return
    scene, pov = twins.write_twin(crt, examples / "part.crt", (16, 12), folder / "part.pov")
    pictures = [folder / f"part-{program}.hdr" for program in ("crt", "pov")]
    twins.by_crt(crt, examples / "part.crt", (16, 12), 1, pictures[0], [])
    twins.by_pov(pov, (16, 12), 1, pictures[1], ["-A"])
    means = [twins.shown(twins.read_hdr(picture), scene).mean() for picture in pictures]
    if not 0.5 < means[0] / means[1] < 2:
        raise SystemExit(f"the twins of part.crt have means of {means[0]} and {means[1]}")


def main() -> int:
    # sanitizers, for this process and its libcrt; POV-Ray does not run with them
    os.environ.pop("LD_PRELOAD", None)
    crt, library, folder, *rest = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    check_catalogue(crt, folder)
    check_lights(crt, library, folder)
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
