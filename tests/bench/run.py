"""Runs the benchmarks and writes what they measured into docs/.

    run.py --build build/release [OPTION...]

A part that was measured with the same programs is not measured again, so a run that was interrupted
goes on where it stopped. Quick runs print their tables and leave the documents alone.
"""

import argparse
import fnmatch
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import time
from collections.abc import Callable

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from povray import catalogue, measure, threads, trade_scenes  # noqa: E402
from povray.programs import Failed, Size  # noqa: E402
from report import machine, page, tables, trade_tables  # noqa: E402
from trade import honesty  # noqa: E402
from trade import measure as trade_measure  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]
FULL_SIZE, QUICK_SIZE = Size(1920, 1440), Size(640, 480)
BUSY = 0.5  # load
OWN_PARTS = ("embree", "meshes", "curves")
GOOGLE_PARTS = ("render", "queries")
PROGRAMS = {"python": "ray_queries", **{part: f"bench_{part}" for part in OWN_PARTS + GOOGLE_PARTS}}
HONESTY = "bench_honesty"
QUICK_GOOGLE = ["--benchmark_min_time=0.1", "--benchmark_filter=-plate"]  # the slowest is left out


class Bench:
    def __init__(self, options: argparse.Namespace) -> None:
        self.options = options
        self.bin = options.build.resolve() / "bin"
        self.folder = SOURCE / "build/bench" / ("quick" if options.quick else "full")
        self.begin = time.monotonic()

    def say(self, text: str) -> None:
        print(f"[{time.monotonic() - self.begin:7.1f} s] {text}", flush=True)

    def parts(self) -> dict[str, Callable[[], dict]]:
        scenes = catalogue.QUICK if self.options.quick else catalogue.SCENES
        bsp = () if self.options.quick else catalogue.BSP
        return {
            **{f"povray/{name}": (lambda name=name: self.povray(name)) for name in scenes},
            **{f"povray-bsp/{name}": (lambda name=name: self.povray(name, tree=2)) for name in bsp},
            **{f"threads/{name}": (lambda name=name: self.threads(name)) for name in scenes},
            **{
                f"trade/{name}": (lambda name=name: self.trade(name))
                for name in self.trade_scenes()
            },
            **{
                f"honesty/{name}": (lambda name=name: self.honesty(name))
                for name in self.honesty_classes()
            },
            **{name: (lambda name=name: self.own(name)) for name in OWN_PARTS},
            **{name: (lambda name=name: self.google(name)) for name in GOOGLE_PARTS},
            "python": self.python,
        }

    def plan(self, longest: float, patience: float = 100, tree: int = 1) -> measure.Plan:
        quick = self.options.quick
        return measure.Plan(
            crt=self.bin / "crt", folder=self.folder / "scenes", size=QUICK_SIZE if quick
            else FULL_SIZE,
            rounds=self.options.rounds or (1 if quick else 5), threads=tuple(
                sorted({1, os.cpu_count() or 1})
            ),
            longest=longest, patience=10 if quick else patience, say=self.say, tree=tree)

    def povray(self, name: str, tree: int = 1) -> dict:
        return measure.measure(
            name, catalogue.SCENES[name](), self.plan(4 if self.options.quick else 60, tree=tree)
        )

    def threads(self, name: str) -> dict:
        return threads.measure(
            name, catalogue.SCENES[name](), self.plan(1 if self.options.quick else 3, patience=30)
        )

    def trade_scenes(self) -> tuple[str, ...]:
        return trade_scenes.QUICK if self.options.quick else tuple(trade_scenes.SCENES)

    def trade(self, name: str) -> dict:
        quick = self.options.quick
        plan = trade_measure.Plan(
            library=self.bin.parent / "lib/libcrt.so", folder=self.folder / "scenes/trade",
            rounds=self.options.rounds or (
                1 if quick else 5
            ), patience=10 if quick else 100, quick=quick, say=self.say,
            divisor=4 if quick else 1)
        return trade_measure.measure(name, plan)

    def honesty_classes(self) -> tuple[str, ...]:
        return honesty.QUICK if self.options.quick else tuple(honesty.CLASSES)

    def honesty(self, name: str) -> dict:
        return honesty.measure(
            name, self.bin / HONESTY, self.folder / "scenes/trade", self.options.quick
        )

    def own(self, name: str) -> dict:
        """Runs a program of ours that writes JSON to standard output and its progress to standard
        error."""
        command = [self.bin / PROGRAMS[name], *(["--quick"] if self.options.quick else [])]
        return json.loads(
            subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout
        )

    def google(self, name: str) -> dict:
        results = self.folder / f"{name}-google.json"
        quick = QUICK_GOOGLE if self.options.quick else []
        subprocess.run(
            [self.bin / PROGRAMS[name], *quick, f"--benchmark_out={results}"], check=True
        )
        return json.loads(results.read_text())

    def python(self) -> dict:
        library = self.bin.parent / "lib/libcrt.so"
        done = subprocess.run(
            [sys.executable, SOURCE / "tests/bench/ray_queries.py", self.bin / "ray_queries"],
            stdout=subprocess.PIPE, check=True, text=True, env={
                **os.environ, "CRT_LIBRARY": str(library)
            })
        print(done.stdout, end="")
        return {"text": done.stdout}

    def chosen(self) -> dict[str, Callable[[], dict]]:
        patterns = self.options.only
        return {name: part for name, part in self.parts().items()
                if not patterns or any(
                    name.startswith(p) or fnmatch.fnmatch(name, p) for p in patterns
                )}

    def programs(self, part: str) -> str:
        """Distinguishes one build of what the part measures from another."""
        digest = hashlib.sha256()
        if part.startswith(("povray", "threads/")):
            files = ["bin/crt"]
        elif part.startswith("trade/"):
            files = ["lib/libcrt.so"]
        elif part.startswith("honesty/"):
            files = [f"bin/{HONESTY}"]
        else:
            files = ["lib/libcrt.so", f"bin/{PROGRAMS[part]}"]
        for file in files:
            digest.update((self.bin.parent / file).read_bytes())
        return digest.hexdigest()

    def result_file(self, part: str) -> pathlib.Path:
        return self.folder / "results" / (part.replace("/", "-") + ".json")

    def results(self) -> dict[str, dict]:
        """Returns the results of the programs as they are now."""
        return {part: json.loads(self.result_file(part).read_text())["result"]
                for part in self.parts() if self.is_measured(part)}

    def machine_file(self) -> pathlib.Path:
        return self.folder / "machine.txt"

    def is_measured(self, part: str) -> bool:
        file = self.result_file(part)
        return file.exists() and json.loads(file.read_text())["programs"] == self.programs(part)

    def run(self) -> list[str]:
        """Runs the parts, and returns those that failed."""
        failed = []
        (self.folder / "results").mkdir(parents=True, exist_ok=True)
        chosen = self.chosen()
        if os.getloadavg()[0] > BUSY:
            self.say(
                f"this machine is busy (load {os.getloadavg()[0]:.1f}): the times will be too long"
            )
        self.machine_file().write_text(machine.described(SOURCE))
        for index, (name, part) in enumerate(chosen.items()):
            if self.is_measured(name) and not self.options.again:
                self.say(f"{name} was measured before (--again measures it again)")
                continue
            self.say(f"part {index + 1} of {len(chosen)}: {name}")
            try:
                result = part()
            except (
                Failed, ValueError, measure.DifferentPictures, subprocess.SubprocessError, OSError
            ) as error:
                failed.append(name)
                self.result_file(name).unlink(missing_ok=True)
                self.say(f"FAILED: {name}: {error}")
                continue
            self.result_file(name).write_text(
                json.dumps({"programs": self.programs(name), "result": result}, indent=1)
            )
        return failed


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", type=pathlib.Path, required=True, help="where bin/ and lib/ are")
    parser.add_argument(
        "--quick", action="store_true", help="small pictures, few rounds: some four minutes"
    )
    parser.add_argument(
        "--only", action="append",
        help="parts whose names begin so or match this pattern (repeatable)",
    )
    parser.add_argument(
        "--rounds", type=int, help="how often both programs take turns (5; quick: 1)"
    )
    parser.add_argument(
        "--again", action="store_true", help="also what was measured with these programs before"
    )
    parser.add_argument("--list", action="store_true", help="tells the parts and ends")
    parser.add_argument(
        "--report", action="store_true", help="only writes the tables of what was measured"
    )
    bench = Bench(parser.parse_args())
    if not bench.chosen():
        parser.error(f"no part is called {', '.join(bench.options.only)}; --list tells all")
    if bench.options.list:
        print("\n".join(bench.chosen()))
        return 0
    failed = [] if bench.options.report else bench.run()
    results = bench.results()
    print(
        "\n"
        + "\n\n".join(filter(None, (tables.all_tables(results), trade_tables.all_tables(results))))
    )
    if not bench.options.quick:
        page.write(SOURCE / "docs", results, bench.machine_file().read_text())
        bench.say(
            "wrote docs/speed.md, docs/trade_measured.md, docs/trade_scenes.md and their plots"
        )
    if failed:
        bench.say(f"FAILED: {', '.join(failed)}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
