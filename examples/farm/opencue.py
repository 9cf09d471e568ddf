#!/usr/bin/env python3
"""OpenCue does the tasks of a job in a folder that all machines see, and then merges them:

    crt farm plan scene.crt --frames 1-240 -o /shared/job
    opencue.py /shared/job --show my_show --shot my_shot

This needs OpenCue's PyOutline, and the Python package of CRT. Not tried on an OpenCue.
"""

import argparse
import getpass

import outline
import outline.cuerun
import outline.modules.shell

import crt


def outline_of(given: argparse.Namespace) -> outline.Outline:
    """Makes a layer with a frame for each task, and one that merges when all are done."""
    tasks = crt.farm.read_plan(given.job).tasks
    command = [given.crt, "farm", "work", given.job, "--task", "#IFRAME#"]
    command += ["--threads", str(given.threads), "--quiet"]
    work = outline.modules.shell.Shell(
        "work", command=command, range=f"0-{tasks - 1}", chunk=1, cores=given.threads
    )
    merge = outline.modules.shell.Shell(
        "merge", command=[given.crt, "farm", "merge", given.job], range="0", chunk=1
    )
    merge.depend_all(work)
    job = outline.Outline(given.name, shot=given.shot, show=given.show, user=getpass.getuser())
    job.add_layer(work)
    job.add_layer(merge)
    return job


def main() -> None:
    parser = argparse.ArgumentParser(description="Submits a job of crt farm to OpenCue.")
    parser.add_argument("job", help="the folder that crt farm plan has made")
    parser.add_argument("--name", default="crt")
    parser.add_argument("--show", default="testing")
    parser.add_argument("--shot", default="test")
    parser.add_argument("--threads", type=int, default=1, help="of each task")
    parser.add_argument("--crt", default="/usr/bin/crt", help="the command on the machines")
    outline.cuerun.launch(outline_of(parser.parse_args()), use_pycuerun=False)


if __name__ == "__main__":
    main()
