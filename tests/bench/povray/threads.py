"""Measures what further threads gain, beside what the machine could give: as many processes at
once."""

import concurrent.futures
import dataclasses
import time

from .measure import Plan, fitting_divisor, write_scripts
from .model import Scene


@dataclasses.dataclass(frozen=True)
class Round:
    """A Round holds seconds of tracing."""

    alone: float
    at_once: float  # of the processes the slowest
    together: float


def measure(name: str, scene: Scene, plan: Plan) -> dict:
    """Runs one thread alone, one in each of several processes at once, and all threads in one
    process, by turns. What two processes lose to one another (memory, caches) two threads cannot
    gain. The fastest of each counts: it does the same each time, and only the rest of the host
    makes it longer."""
    crt, _ = write_scripts(scene, name, plan)
    threads = max(plan.threads)
    pictures = [plan.folder / f"{name}-threads-{i}.ppm" for i in range(threads)]
    divisor = fitting_divisor(crt, pictures[0], plan)
    size = plan.size.divided(divisor)
    rounds: list[Round] = []
    begin = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(threads) as pool:
        while len(rounds) < plan.rounds and (
            not rounds or time.monotonic() - begin < plan.patience
        ):
            alone = crt.trace(size, 1, pictures[0])
            at_once = max(pool.map(lambda picture: crt.trace(size, 1, picture), pictures))
            rounds.append(Round(alone, at_once, together=crt.trace(size, threads, pictures[0])))
            plan.say(f"{name}, round {len(rounds)} of {plan.rounds}: alone {alone:.3f} s,"
                     f" {threads} at once"
                     f" {at_once:.3f} s, {threads} threads {rounds[-1].together:.3f} s")
    fastest = {
        field.name: min(getattr(turn, field.name) for turn in rounds)
        for field in dataclasses.fields(Round)
    }
    return {"threads": threads, "rounds": len(rounds), **fastest}
