#!/usr/bin/env python3
"""Measures how equal the tasks of jobs are, for docs/farm.md.

usage: balance.py CRT FOLDER TASKS SCENE... [-- OPTION...]

Plans a job of each scene in FOLDER, works on all of its tasks on one thread, one after the other,
and prints the longest task by the mean. What a process takes is the seconds that it computes, not
those of the clock, and the least of three runs, so that other work on the machine matters little.
Options go to `crt farm plan`.
For 1000 workers it then repeats the measured tasks of each scene until a job has 10 core-hours in
about a minute's tasks, and prints how well the workers are used when each takes the next task.
"""

import heapq
import json
import os
import shutil
import sys


def seconds_of(words):
    """Runs a program, and returns the seconds that it computed."""
    process = os.posix_spawnp(words[0], words, os.environ)
    _, status, usage = os.wait4(process, 0)
    if status != 0:
        raise RuntimeError(" ".join(words))
    return usage.ru_utime + usage.ru_stime


def efficiency(tasks, workers):
    """Returns the share of the workers' time that is work, if each takes the next task."""
    free = [0.0] * workers
    for task in tasks:
        heapq.heappush(free, heapq.heappop(free) + task)
    return sum(tasks) / (workers * max(free))


def work(crt, job, task):
    part = os.path.join(job, "parts", f"{task:06}.part")
    if os.path.exists(part):
        os.remove(part)
    return seconds_of([crt, "farm", "work", job, "--task", str(task), "--threads", "1", "-q"])


def measure(crt, folder, tasks, scene, options):
    name = os.path.splitext(os.path.basename(scene))[0]
    job = os.path.join(folder, name)
    shutil.rmtree(job, ignore_errors=True)
    plan = seconds_of(
        [crt, "farm", "plan", scene, "-o", job, "--tasks", str(tasks), "-q", *options])
    times = [min(work(crt, job, i) for _ in range(3)) for i in range(tasks)]
    merge = seconds_of([crt, "farm", "merge", job, "-q"])
    with open(os.path.join(job, "manifest.json"), encoding="utf-8") as file:
        estimated = sum(task["seconds"] for task in json.load(file)["tasks"])
    shutil.rmtree(job)
    total = sum(times)
    print(f"{name}: {total:.2f} s, longest by mean {max(times) * tasks / total:.3f}, "
          f"estimated {estimated:.2f} s, plan {100 * plan / total:.2f} %, "
          f"merge {100 * merge / total:.2f} %", flush=True)
    return times


def main():
    words = sys.argv[1:]
    options = words[words.index("--") + 1:] if "--" in words else []
    if "--" in words:
        words = words[:words.index("--")]
    crt, folder, tasks, *scenes = words
    for scene in scenes:
        times = measure(crt, folder, int(tasks), scene, options)
        # Ten core-hours as tasks whose spread is the measured one.
        ten_hours = 36000.0
        for count in (1000, 2000, 4000, 8000):
            scale = ten_hours / count * len(times) / sum(times)
            drawn = [scale * times[i * 37 % len(times)] for i in range(count)]
            print(f"  1000 workers, {count} tasks: {100 * efficiency(drawn, 1000):.1f} %")


if __name__ == "__main__":
    main()
