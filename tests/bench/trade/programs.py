"""Renders with CRT's library in this process, and with povray. Returns pictures and the processor's
time."""

import os
import pathlib
import re
import sys
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from povray import pictures
from povray.programs import Failed, Size, run

from . import errors

SOURCE = pathlib.Path(__file__).resolve().parents[3]
TRACE_CPU = re.compile(
    r"Trace Time:.*?\n\s*using \d+ thread\(s\) with ([\d.]+) CPU-seconds", re.DOTALL
)
SHOT = re.compile(r"Pixels:\s*(\d+)\s+Samples:\s*(\d+)")


@dataclass(frozen=True)
class Rendered:
    picture: np.ndarray  # in 8-bit steps
    seconds: float  # of the processor, for tracing
    samples: float  # a pixel


def binding(library: pathlib.Path) -> Any:
    """Returns CRT's Python package on top of this library."""
    os.environ["CRT_LIBRARY"] = str(library)
    package = str(SOURCE / "python")
    if package not in sys.path:
        sys.path.insert(0, package)
    import crt

    return crt


@dataclass(frozen=True)
class Crt:
    crt: Any
    script: pathlib.Path
    size: Size

    def prepared(self, settings: dict, size: Size | None = None) -> Any:
        size = size or self.size
        all_settings = {
            "width": size.width, "height": size.height, "gamma": errors.GAMMA, **settings
        }
        return self.crt.Scene.from_script(
            self.script, settings=all_settings, max_steps=10**9
        ).prepare()

    def image(
        self, settings: dict, seed: int = 1, threads: int = 0, size: Size | None = None
    ) -> tuple[Any, float]:
        """Returns a picture and the seconds it took."""
        prepared = self.prepared(settings, size)
        begin = time.process_time()
        image = prepared.render(threads=threads, seed=seed)
        return image, time.process_time() - begin

    def render(self, settings: dict, seed: int = 1, threads: int = 1) -> Rendered:
        image, seconds = self.image(settings, seed, threads)
        samples = image.stats.camera_rays / self.size.pixels
        return Rendered(errors.shown(image.pixels), seconds, samples)


@dataclass(frozen=True)
class PovRay:
    script: pathlib.Path
    size: Size

    def render(self, options: tuple[str, ...], threads: int = 1, enlarged: int = 1) -> Rendered:
        """Renders. `enlarged` says how many times as wide and high the picture is."""
        picture = self.script.with_suffix(".ppm")
        output = run(["povray", f"+I{self.script.name}", f"+O{picture.name}", "+FP16",
                      f"File_Gamma={errors.GAMMA}",
                      f"+W{enlarged * self.size.width}", f"+H{enlarged * self.size.height}",
                      f"+WT{threads}", *options,
                      "-D", "-V"], None, picture.parent)
        seconds, shot = TRACE_CPU.search(output), SHOT.search(output)
        if seconds is None or shot is None:
            raise Failed(f"povray printed no times: {output[-2000:]}")
        steps = pictures.read_ppm(picture).astype(float) * (errors.FULL / 65535)
        samples = (int(shot[1]) + int(shot[2])) / self.size.pixels
        return Rendered(steps, float(seconds[1]), samples)
