"""Prints digests of pictures and of queries' answers:  record.py CRT QUERY_DIGESTS FOLDER

They are of every example and every scene that the benchmarks render, in both tiers, and of a
million random queries. A change that only moves code leaves all of them as they are: record
before, record after, and compare the two texts. They hold for one machine and its libraries (the C
library's elementary functions are among them).
"""

import hashlib
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "bench"))

from povray import catalogue, crt_writer  # noqa: E402

TIERS = ("standard", "exact")
SIZE = ("--width", "160", "--height", "120")
RAYS = 1_000_000
LARGEST = 20_000  # primitives' worth of script: larger scenes of the catalogue take minutes to read


def written_scenes(folder: pathlib.Path) -> list[pathlib.Path]:
    """Returns the benchmarks' scenes as scripts, but for the huge ones."""
    scripts = []
    for name, make in catalogue.SCENES.items():
        count = name.rpartition("-")[2]
        if count.startswith("1e") and float(count) > LARGEST:
            continue
        script = folder / f"{name.replace('/', '-')}.crt"
        with open(script, "w") as out:
            crt_writer.Writer(make(), script).write(out)
        scripts.append(script)
    return scripts


def picture_digest(crt: pathlib.Path, script: pathlib.Path, tier: str, folder: pathlib.Path) -> str:
    picture = folder / "picture.exr"
    command = [
        crt, "render", script, *SIZE, "--precision", tier, "--reproducible", "--quiet", "-o",
        picture,
    ]
    subprocess.run(command, check=True, stdin=subprocess.DEVNULL, cwd=script.parent)
    return hashlib.sha256(picture.read_bytes()).hexdigest()


def main() -> int:
    crt, queries, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    folder.mkdir(parents=True, exist_ok=True)
    for script in sorted((ROOT / "examples" / "scenes").glob("*.crt")) + written_scenes(folder):
        for tier in TIERS:
            print(f"{picture_digest(crt, script, tier, folder)}  {script.stem} {tier}", flush=True)
    subprocess.run([queries, str(RAYS)], check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
