"""Runs crt and povray and reports how long each of them traced."""

import json
import pathlib
import re
import subprocess
from dataclasses import dataclass

TRACE_TIME = re.compile(r"Trace Time:.*?\(([\d.]+) seconds\)")


class Failed(Exception):
    """Is raised where a program ended with an error."""


@dataclass(frozen=True)
class Size:
    width: int
    height: int

    @property
    def pixels(self) -> int:
        return self.width * self.height

    def divided(self, by: int) -> "Size":
        return Size(self.width // by, self.height // by)

    def __str__(self) -> str:
        return f"{self.width} x {self.height}"


def run(command: list, timeout: float | None, folder: pathlib.Path) -> str:
    """Returns what it prints. TimeoutExpired passes."""
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, timeout=timeout,
                          cwd=folder, errors="replace")
    if done.returncode != 0:
        raise Failed(
            f"{command[0]} ended with {done.returncode}: {(done.stdout + done.stderr)[-2000:]}"
        )
    return done.stdout + done.stderr


@dataclass(frozen=True)
class Crt:
    program: pathlib.Path
    script: pathlib.Path

    def trace(
        self, size: Size, threads: int, picture: pathlib.Path, timeout: float | None = None
    ) -> float:
        stats = picture.with_suffix(".json")
        run([self.program, "render", self.script, "-o", picture, "--width", size.width, "--height",
             size.height, "--threads", threads, "--stats", stats, "--max-steps", 10**9, "--quiet"],
            timeout, picture.parent)
        return float(json.loads(stats.read_text())["seconds"]["trace"])


@dataclass(frozen=True)
class PovRay:
    script: pathlib.Path
    grid: int
    tree: int  # its bounding method: 1 is a hierarchy of boxes, the default; 2 a BSP tree

    def trace(
        self, size: Size, threads: int, picture: pathlib.Path, timeout: float | None = None
    ) -> float:
        samples = ["-A"] if self.grid == 1 else ["+AM1", "+A0.0", "-J", f"+R{self.grid}"]
        output = run(["povray", f"+I{self.script.name}", f"+O{picture.name}", "+FP8",
                      "File_Gamma=1", f"+W{size.width}", f"+H{size.height}", f"+WT{threads}",
                      *samples, f"+BM{self.tree}", "-D", "-V"],
                     timeout, picture.parent)
        found = TRACE_TIME.search(output)
        if found is None:
            raise Failed(f"povray printed no trace time: {output[-2000:]}")
        return float(found.group(1))
