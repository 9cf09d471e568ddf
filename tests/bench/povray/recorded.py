"""Records the scene that a program made by `crt export` builds, instead of rendering it.

Such a program imports `crt`. Here that is a stand-in whose shapes, materials and lights only keep
what they were given."""

import pathlib
import subprocess
import sys
import types
from dataclasses import dataclass, field


@dataclass(eq=False)
class Record:
    """A Record is what a constructor was called with. `kind` is its name."""

    kind: str
    values: dict = field(default_factory=dict)
    parts: tuple = ()

    def __getattr__(self, name: str):
        if name.startswith("__"):
            raise AttributeError(name)
        return self.values.get(name)

    def __add__(self, other: "Record") -> "Record":
        return Record("union", parts=(self, other))

    def __sub__(self, other: "Record") -> "Record":
        return Record("difference", parts=(self, other))

    def __xor__(self, other: "Record") -> "Record":
        return Record("intersection", parts=(self, other))

    def moved(self, by) -> "Record":
        return self.transformed([[1, 0, 0, by[0]], [0, 1, 0, by[1]], [0, 0, 1, by[2]]])

    def scaled(self, by) -> "Record":
        x, y, z = by if isinstance(by, (tuple, list)) else (by, by, by)
        return self.transformed([[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0]])

    def transformed(self, rows) -> "Record":
        return Record("transformed", {"rows": rows}, (self,))

    def with_material(self, material: "Record") -> "Record":
        return Record("with_material", {"material": material}, (self,))

    def with_shadow(self, shadow: bool) -> "Record":
        return Record("with_shadow", {"shadow": shadow}, (self,))


class Maker:
    """A Maker makes records: of its own name when called, and of `kind` by an attribute, as in
    Light.rectangle(...)."""

    def __init__(self, kind: str) -> None:
        self.kind = kind

    def __call__(self, **values) -> Record:
        return Record(self.kind, values)

    def __getattr__(self, name: str):
        if name.isupper():
            return name
        return lambda **values: Record(name, values)


class RecordedScene:
    def __init__(self) -> None:
        self.things: list[Record] = []
        self.lights: list[Record] = []
        self.camera = self.background = self.settings = Record("none")

    def add(self, thing: Record) -> None:
        is_light = thing.kind in ("environment", "rectangle", "parallel", "sphere", "point", "disc")
        (self.lights if is_light else self.things).append(thing)


def stand_in() -> types.ModuleType:
    module = types.ModuleType("crt")
    module.Scene = RecordedScene
    module.union = lambda parts: Record("union", parts=tuple(parts))
    module.__getattr__ = Maker
    return module


def record(crt: pathlib.Path, script: pathlib.Path) -> RecordedScene:
    """Returns the scene of a script."""
    program = subprocess.run([crt, "export", script, "--as", "python", "--quiet"],
                             capture_output=True, text=True, check=True).stdout
    kept = sys.modules.get("crt")
    sys.modules["crt"] = stand_in()
    try:
        names: dict = {"__name__": "recorded"}
        exec(compile(program, str(script), "exec"), names)
        return names["make_scene"]()
    finally:
        del sys.modules["crt"]
        if kept is not None:
            sys.modules["crt"] = kept
