"""Whether CRT still takes the scenes that are measured:  smoke.py CRT FOLDER

Renders each of them tiny (but the large ones, which only take longer), and looks whether any surface is lit.
"""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from povray import catalogue, measure  # noqa: E402
from povray.programs import Size  # noqa: E402

LARGE = ("-1e3", "-1e4", "-1e5", "-1e6", "-500")


def main() -> int:
    crt, folder = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    plan = measure.Plan(crt=crt, folder=folder, size=Size(12, 9), rounds=1, threads=(1,), longest=1, patience=1,
                        say=print)
    for name, make in catalogue.SCENES.items():
        if name.endswith(LARGE):
            continue
        program, _ = measure.write_scripts(make(), name, plan)
        picture = folder / f"{name}.png"
        program.trace(plan.size, 1, picture)
        if json.loads(picture.with_suffix(".json").read_text())["rays"]["shadow"] == 0:
            print(f"{name}: no surface is lit")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
