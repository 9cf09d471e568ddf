#!/usr/bin/env python3
"""The templates in examples/farm tell their schedulers to run what a job needs.

usage: templates_test.py CRT EXAMPLES

None of the schedulers is here. Stand-ins take what the templates give them, and the commands run
one after the other. The merged picture has the bytes of one render.
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

CRT, EXAMPLES = map(pathlib.Path, sys.argv[1:])
TASKS = 3
SCENE = """Settings { width -> 40 height -> 30 }
Scene { Sphere { center -> vec3(0, 0, 2) radius -> 0.7 } }
"""

# What PyOutline has of this, in modules of these names. Launching prints the layers.
OUTLINE = {
    "outline/__init__.py": """
class Outline:
    def __init__(self, name, shot, show, user):
        self.layers = []
    def add_layer(self, layer):
        self.layers.append(layer)
""",
    "outline/cuerun.py": """
import json
def launch(job, use_pycuerun):
    for layer in job.layers:
        needed = [other.name for other in layer.needed]
        print(json.dumps([layer.name, layer.range, layer.command, needed]))
""",
    "outline/modules/__init__.py": "",
    "outline/modules/shell.py": """
class Shell:
    def __init__(self, name, command, range, chunk, cores=1):
        assert chunk == 1 and all(isinstance(word, str) for word in command)
        self.name, self.command, self.range, self.needed = name, command, range, []
    def depend_all(self, layer):
        self.needed.append(layer)
""",
    # The example reads the number of tasks by the Python package.
    "crt.py": f"""
class farm:
    class read_plan:
        tasks = {TASKS}
        def __init__(self, job):
            pass
""",
}

FLAMENCO = """
const author = {
  Task: (name, type) => ({ name, type, commands: [], needed: [],
    addCommand(command) { this.commands.push(command); },
    addDependency(task) { this.needed.push(task.name); } }),
  Command: (name, parameters) => ({ name, parameters }),
};
const [, , file, given] = process.argv;
const text = require("fs").readFileSync(file, "utf8");
const { JOB_TYPE, compileJob } =
  new Function("author", text + "; return { JOB_TYPE, compileJob };")(author);
const settings = JSON.parse(given);
for (const { key, required, default: value } of JOB_TYPE.settings) {
  if (required && !(key in settings)) throw new Error(key + " is required");
  if (!(key in settings)) settings[key] = value;
}
const tasks = [];
compileJob({ settings, addTask: (task) => tasks.push(task) });
console.log(JSON.stringify(tasks));
"""


def htcondor(job: pathlib.Path) -> list[list[str]]:
    """Expands a submit description, and returns the commands that it queues."""
    macros = {"job": str(job), "tasks": str(TASKS), "crt": str(CRT)}

    def expanded(text: str) -> str:
        def value(found: re.Match[str]) -> str:
            name, default = found[1], found[2]
            known = macros.get(name, default)
            assert known is not None, f"{name} has no value"
            return known

        return re.sub(r"\$\((\w+)(?::([^)]*))?\)", value, text)

    entries = {}
    count = 0
    for line in (EXAMPLES / "htcondor.sub").read_text().splitlines():
        if line.startswith("#"):
            continue
        if queue := re.fullmatch(r"queue (.+)", line):
            count = int(expanded(queue[1]))
            continue
        name, value = line.split("=", 1)
        entries[name.strip()] = value.strip()
    commands = []
    for process in range(count):
        macros["Process"] = str(process)
        arguments = entries["arguments"]
        assert arguments[0] == arguments[-1] == '"'
        commands.append([expanded(entries["executable"]), *shlex.split(expanded(arguments[1:-1]))])
        assert pathlib.Path(expanded(entries["output"])).parent.is_dir()
    return [*commands, [str(CRT), "farm", "merge", str(job)]]


def opencue(job: pathlib.Path) -> list[list[str]]:
    """Runs the outline script with a stand-in for PyOutline, and returns its frames' commands."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in OUTLINE.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        done = subprocess.run(
            [sys.executable, "-B", EXAMPLES / "opencue.py", job, "--crt", CRT],
            env={**os.environ, "PYTHONPATH": folder},
            check=True,
            capture_output=True,
            text=True,
        )
    commands = []
    names: list[str] = []
    for name, frames, command, needed in map(json.loads, done.stdout.splitlines()):
        assert needed == names, f"{name} waits for {needed}"
        names.append(name)
        first, _, last = frames.partition("-")
        for frame in range(int(first), int(last or first) + 1):
            commands.append([word.replace("#IFRAME#", str(frame)) for word in command])
    return commands


def flamenco(job: pathlib.Path) -> list[list[str]] | None:
    """Compiles a job by Node, and returns the commands of its tasks."""
    node = shutil.which("node")
    if node is None:
        return None
    settings = json.dumps({"job": str(job), "tasks": TASKS, "crt": str(CRT)})
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder, "compile.js")
        program.write_text(FLAMENCO)
        done = subprocess.run(
            [node, program, EXAMPLES / "flamenco.js", settings],
            check=True,
            capture_output=True,
            text=True,
        )
    tasks = json.loads(done.stdout)
    assert sorted(tasks[-1]["needed"]) == sorted(task["name"] for task in tasks[:-1])
    commands = []
    for task in tasks:
        for command in task["commands"]:
            assert command["name"] == "exec"
            commands.append([command["parameters"]["exe"], *command["parameters"]["args"]])
    return commands


def check(template, folder: pathlib.Path) -> None:
    job = folder / f"job of {template.__name__}"
    run(CRT, "farm", "plan", folder / "scene.crt", "--tasks", TASKS, "-o", job)
    commands = template(job)
    if commands is None:
        print(f"{template.__name__}: not tried, as there is no Node (Debian: nodejs)")
        return
    assert len(commands) == TASKS + 1, commands
    for command in commands:
        run(*command)
    assert (job / "scene.png").read_bytes() == (folder / "whole.png").read_bytes()
    print(f"{template.__name__}: {len(commands)} commands")


def run(*command) -> None:
    subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)


with tempfile.TemporaryDirectory() as name:
    place = pathlib.Path(name)
    (place / "scene.crt").write_text(SCENE)
    run(CRT, "render", place / "scene.crt", "-o", place / "whole.png", "--reproducible", "-q")
    for each in (htcondor, opencue, flamenco):
        check(each, place)
