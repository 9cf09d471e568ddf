"""The fourth program of the tutorial for Python: it runs a script several times with other values
for its variables. `tutorial_script.py SCRIPT.crt NAME=VALUE...` writes script.png."""

import pathlib
import sys
from collections.abc import Mapping
from typing import Any

import crt


def run(script: pathlib.Path, variables: Mapping[str, Any]) -> crt.Scene:
    scene = crt.Scene.from_script(
        script, variables=variables, settings={"width": 240, "height": 160}, print=print
    )
    for warning in scene.diagnostics:
        print(warning.message, file=sys.stderr)
    return scene


if __name__ == "__main__":
    given = [argument.split("=", 1) for argument in sys.argv[2:]]
    variables = {name: crt.Expression(value) for name, value in given}
    try:
        run(pathlib.Path(sys.argv[1]), variables).render().save("script.png")
    except crt.ScriptError as error:
        sys.exit(str(error))
