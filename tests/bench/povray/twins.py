"""Renders scripts with CRT and their twins with POV-Ray, and puts the pictures side by side.

    twins.py --crt build/release/bin/crt [--width 320] examples/scenes/part.crt ...

Both run with the same number of threads, one after the other. Both pictures are of linear light
and get the exposure and the tone map of the script afterwards. NAME.png shows CRT's on the left.
What POV-Ray cannot say is in twin_writer.py."""

import argparse
import pathlib
import re
import struct
import subprocess
import sys
import time
import zlib

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from povray.programs import run  # noqa: E402
from povray.recorded import RecordedScene, record  # noqa: E402
from povray.twin_writer import TwinWriter  # noqa: E402

CPU_SECONDS = re.compile(r"using \d+ thread\(s\) with ([\d.]+) CPU-seconds")


def read_hdr(path: pathlib.Path) -> np.ndarray:
    """Reads a picture of Radiance whose rows are packed by runs: height x width x 3."""
    data = path.read_bytes()
    begin = data.index(b"\n\n") + 2
    end = data.index(b"\n", begin)
    height, width = (int(data[begin:end].split()[i]) for i in (1, 3))
    position = end + 1
    rows = np.zeros((height, 4, width), np.uint8)
    for row in rows:
        if data[position:position + 2] != b"\x02\x02":
            raise ValueError(f"{path} is not packed by runs")
        position += 4
        for channel in row:
            x = 0
            while x < width:
                count = data[position]
                if count > 128:
                    channel[x:x + count - 128] = data[position + 1]
                    x += count - 128
                    position += 2
                else:
                    channel[x:x + count] = np.frombuffer(data, np.uint8, count, position + 1)
                    x += count
                    position += 1 + count
    scale = np.where(rows[:, 3] > 0, np.exp2(rows[:, 3].astype(float) - 136), 0)
    return np.moveaxis(rows[:, :3] * scale[:, None], 1, 2)


def filmic(light: np.ndarray) -> np.ndarray:
    """The curve of docs/image.md."""
    x = 0.72317 * light
    return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)


def shown(light: np.ndarray, scene: RecordedScene) -> np.ndarray:
    exposed = light * 2.0 ** (scene.settings.exposure or 0)
    toned = filmic(exposed) if scene.settings.tone_map == "FILMIC" else exposed
    return np.round(255 * np.clip(toned, 0, 1) ** (1 / 2.2)).astype(np.uint8)


def write_png(path: pathlib.Path, pixels: np.ndarray) -> None:
    height, width, _ = pixels.shape
    rows = np.zeros((height, 1 + 3 * width), np.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)

    def chunk(name: bytes, content: bytes) -> bytes:
        check = zlib.crc32(name + content)
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", check)

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head)
                     + chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def by_crt(crt: pathlib.Path, script: pathlib.Path, size: tuple[int, int], threads: int,
           picture: pathlib.Path, more: list[str]) -> float:
    begin = time.monotonic()
    subprocess.run([crt, "render", script, "-o", picture, "--width", str(size[0]), "--height",
                    str(size[1]), "--threads", str(threads), "--quiet", *more], check=True)
    return time.monotonic() - begin


def by_pov(script: pathlib.Path, size: tuple[int, int], threads: int, picture: pathlib.Path,
           more: list[str]) -> tuple[float, float]:
    """Returns the seconds by the clock and of the processor."""
    begin = time.monotonic()
    output = run(["povray", f"+I{script.name}", f"+O{picture.name}", "+FH", f"+W{size[0]}",
                  f"+H{size[1]}", f"+WT{threads}", "-D", "-V", *more], None, script.parent)
    cpu = sum(float(found) for found in CPU_SECONDS.findall(output))
    return time.monotonic() - begin, cpu


def write_twin(crt: pathlib.Path, script: pathlib.Path, size: tuple[int, int],
               pov: pathlib.Path) -> tuple[RecordedScene, pathlib.Path]:
    scene = record(crt, script)
    TwinWriter(scene, size[0] / size[1], pov).write()
    return scene, pov


def twin(script: pathlib.Path, options: argparse.Namespace) -> None:
    crt = options.crt.resolve()
    scene = record(crt, script)
    width = options.width
    size = (width, round(width * (scene.settings.height or 480) / (scene.settings.width or 640)))
    folder = options.folder.resolve()
    _, pov = write_twin(crt, script, size, folder / f"{script.stem}.pov")
    pictures = [folder / f"{script.stem}-{program}.hdr" for program in ("crt", "pov")]
    crt_seconds = by_crt(crt, script, size, options.threads, pictures[0], options.crt_options)
    pov_seconds, cpu = by_pov(pov, size, options.threads, pictures[1], options.pov_options)
    both = [shown(read_hdr(picture), scene) for picture in pictures]
    gap = np.full((size[1], 4, 3), 255, np.uint8)
    write_png(folder / f"{script.stem}.png", np.hstack([both[0], gap, both[1]]))
    print(f"{script.stem}: CRT {crt_seconds:.1f} s, POV-Ray {pov_seconds:.1f} s"
          f" ({cpu:.1f} of the processor)", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--crt", type=pathlib.Path, required=True)
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("build/bench/twins"))
    parser.add_argument("--width", type=int, default=320)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--crt-options", type=str.split, default=[])
    parser.add_argument("--pov-options", type=str.split, default=["+A0.1", "+AM2", "+R2"])
    parser.add_argument("scripts", nargs="+", type=pathlib.Path)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    for script in options.scripts:
        twin(script.resolve(), options)


if __name__ == "__main__":
    main()
