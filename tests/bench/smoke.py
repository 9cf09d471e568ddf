"""Whether CRT still takes the scenes that are measured:  smoke.py CRT FOLDER

Checks the script of each (but the large ones), and renders one of each kind, tiny.
"""

import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from povray import catalogue, measure  # noqa: E402
from povray.programs import Size, run  # noqa: E402

LARGE = ("-1e3", "-1e4", "-1e5", "-1e6", "-500")
RENDERED = ("tunnel-1e1", "lens-union-1e2", "mirror-room", "glass", "nested-50")


def main() -> int:
    crt, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    plan = measure.Plan(crt=crt, folder=folder, size=Size(12, 9), rounds=1, threads=(1,), longest=1, patience=1,
                        say=print)
    for name, make in catalogue.SCENES.items():
        if name.endswith(LARGE):
            continue
        program, _ = measure.write_scripts(make(), name, plan)
        run([crt, "check", program.script], None, folder)
        if name not in RENDERED:
            continue
        picture = folder / f"{name}.png"
        program.trace(plan.size, 1, picture)
        if json.loads(picture.with_suffix(".json").read_text())["rays"]["shadow"] == 0:
            print(f"{name}: no surface is lit")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
