"""This program renders the frames of a script on a Dask cluster, and shows them on a contact sheet.

    python farm_dask.py scene.crt --frames 1 24 --output film_##.png
    python farm_dask.py scene.crt --frames 1 24 --scheduler tcp://head:8786

Without a scheduler it starts a cluster on this machine. All workers must see the job's folder. A
task whose worker ends early goes to another one.
"""

import argparse
import pathlib

from dask.distributed import Client, LocalCluster, as_completed

import crt

RETRIES = 2


def render(client: Client, given: argparse.Namespace, job: str) -> None:
    """Renders frames on the workers of a cluster."""
    first, last = given.frames
    plan = crt.farm.plan(given.script, job, frames=(first, last), tasks=given.tasks)
    print(f"{plan.tasks} tasks of about {plan.seconds / plan.tasks:.3g} s")
    # Whether a task is done is seen by its part, so a result that Dask keeps must not count.
    futures = client.map(
        crt.farm.work,
        [job] * plan.tasks,
        range(plan.tasks),
        threads=1,
        pure=False,
        retries=RETRIES,
    )
    for done, future in enumerate(as_completed(futures), 1):
        future.result()  # raises what the task has raised
        print(f"\r{done} of {plan.tasks} tasks", end="", flush=True)
    merged = crt.farm.merge(job, output=given.output)
    print(f"\n{len(merged.frames)} frames")


def main() -> None:
    parser = argparse.ArgumentParser(description="Renders frames on a Dask cluster.")
    parser.add_argument("script")
    parser.add_argument("--frames", type=int, nargs=2, default=(1, 12), metavar=("FIRST", "LAST"))
    parser.add_argument("--tasks", type=int, default=16, help="several for each worker are good")
    parser.add_argument("--job", default="job", help="a new folder")
    parser.add_argument("--output", default="film_###.png")
    parser.add_argument("--sheet", default="sheet.png")
    parser.add_argument("--scheduler", help="the address of a cluster")
    given = parser.parse_args()
    # One thread a worker: CRT renders without Python's lock, but a task is the work of one core.
    cluster = given.scheduler or LocalCluster(threads_per_worker=1, dashboard_address=None)
    job = str(pathlib.Path(given.job).resolve())
    with Client(cluster) as client:
        render(client, given, job)
    if not given.scheduler:
        cluster.close()
    crt.farm.sheet(job).save(given.sheet)
    print(f"{given.sheet} shows them")


if __name__ == "__main__":
    main()
