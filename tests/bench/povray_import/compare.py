"""Imports scenes of POV-Ray, and compares pictures: compare.py CRT FOLDER INCLUDES [--pictures DIR]

CRT is the command, FOLDER has scenes (the examples of Debian's package povray-examples, unpacked),
and INCLUDES is the folder of colors.inc and the like. It prints how many scenes became scripts, and
what the others have that is not understood. With --pictures the scenes named by --scene are
rendered by `povray` and by CRT into DIR, side by side, and `oiiotool` says how much they differ.
"""

import argparse
import collections
import pathlib
import re
import subprocess
import sys

SECONDS = 60  # that a program may take for a scene
SIZE = (320, 240)


def run(words: list[str], folder: pathlib.Path | None = None) -> subprocess.CompletedProcess[str]:
    try:
        return subprocess.run(
            words,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=SECONDS,
            check=False,
            cwd=folder,
        )
    except subprocess.TimeoutExpired:
        return subprocess.CompletedProcess(words, 1, "", f"error: took over {SECONDS} s")


def imported(arguments: argparse.Namespace, scene: pathlib.Path) -> tuple[bool, str, int]:
    """Imports a scene. Returns whether there is a script, the first error, and the warnings."""
    script = scene.with_suffix(".crt")
    words = [arguments.crt, "import", str(scene), "-o", str(script)]
    result = run([*words, "--include", str(arguments.includes)])
    errors = re.findall(r"error: (.*)", result.stderr)
    return result.returncode == 0, errors[0] if errors else "", result.stderr.count("warning: ")


def kind_of(error: str) -> str:
    """Returns an error without the names that differ from scene to scene."""
    if "no file" in error:
        return "a file is missing"
    if error.endswith("is not defined"):
        return "a name or function is not defined"
    return error


def difference(arguments: argparse.Namespace, scene: pathlib.Path) -> str:
    """Renders a scene with both, and returns the mean error of a channel, 1 for white."""
    width, height = SIZE
    theirs = arguments.pictures / f"{scene.stem}-povray.png"
    ours = arguments.pictures / f"{scene.stem}-crt.png"
    both = arguments.pictures / f"{scene.stem}.png"
    words = ["povray", f"+I{scene.name}", f"+O{theirs}", f"+W{width}", f"+H{height}", "-D", "-GA"]
    run([*words, "+A0.3", f"+L{arguments.includes}"], scene.parent)
    words = [arguments.crt, "render", str(scene.with_suffix(".crt")), "-o", str(ours), "-q"]
    run([*words, "--width", str(width), "--height", str(height)])
    if not theirs.exists() or not ours.exists():
        return "no picture"
    plain = ["--ch", "R,G,B"]
    run(["oiiotool", str(theirs), *plain, str(ours), *plain, "--mosaic", "2x1", "-o", str(both)])
    result = run(["oiiotool", str(theirs), *plain, str(ours), *plain, "--diff"])
    found = re.search(r"Mean error = (\S+)", result.stdout)
    return f"{float(found.group(1)):.3f}" if found else "not compared"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("crt")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("includes", type=pathlib.Path)
    parser.add_argument("--pictures", type=pathlib.Path)
    parser.add_argument("--scene", action="append", default=[], help="a part of a scene's path")
    arguments = parser.parse_args()
    if arguments.pictures:
        arguments.pictures = arguments.pictures.resolve()
        arguments.pictures.mkdir(parents=True, exist_ok=True)
    kinds: collections.Counter[str] = collections.Counter()
    done = warned = 0
    scenes = sorted(arguments.folder.resolve().rglob("*.pov"))
    for scene in scenes:
        is_done, error, warnings = imported(arguments, scene)
        done += is_done
        warned += is_done and warnings > 0
        if not is_done:
            kinds[kind_of(error)] += 1
        is_chosen = any(part in str(scene) for part in arguments.scene)
        if is_done and arguments.pictures and is_chosen:
            print(f"{scene.stem}: mean error {difference(arguments, scene)}", flush=True)
    print(f"\n{done} of {len(scenes)} scenes are scripts, {warned} of them with warnings.\n")
    print("| the first thing that is not understood | scenes |\n| --- | --- |")
    for kind, count in kinds.most_common():
        print(f"| {kind} | {count} |")


if __name__ == "__main__":
    sys.exit(main())
