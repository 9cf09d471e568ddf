"""A scene is put together in Python, or made by a script."""

import ctypes
import os
import threading
from collections.abc import Callable, Iterable, Mapping
from typing import Annotated, Any

from ._callbacks import OPEN_FILE, POLL, PRINT, Guard
from ._handles import Handle
from ._library import create, library, to_utf8
from ._structs import Double, Int, Long, Pointer, Struct, Unsigned, growable, reference
from .diagnostics import diagnostics_of
from .entities import Entity
from .errors import Diagnostic, Error, ScriptError
from .expressions import to_expressions
from .images import Image
from .rendering import Prepared
from .values import Background, Camera, Light, Settings


class Scene(Handle):
    """A Scene is the description of a picture. What `prepare()` makes of it, ready for rays, does
    not change with it."""

    _name = "crt_scene"

    def __init__(
        self,
        entities: Iterable[Entity] = (),
        lights: Iterable[Light] = (),
        camera: Camera | None = None,
        background: Background | None = None,
        settings: Settings | None = None,
    ) -> None:
        self._take(create("crt_scene_create"))
        self.add(*entities, *lights)
        if camera is not None:
            self.camera = camera
        if background is not None:
            self.background = background
        if settings is not None:
            self.settings = settings

    def _take(self, handle: int) -> None:
        super()._take(handle)
        self._lock = threading.Lock()  # the library takes one thread at a time
        self.diagnostics: list[Diagnostic] = []  # the warnings of the script that it is from

    @classmethod
    def from_script(
        cls,
        script: str | os.PathLike[str],
        *,
        name: str = "script",
        variables: Mapping[str, Any] = {},
        settings: Mapping[str, Any] = {},
        t: float = 0,
        compat: int = 0,
        resource_directories: Iterable[str | os.PathLike[str]] = (),
        allow_outside_files: bool = False,
        print: Callable[[str], Any] | None = None,
        open_file: Callable[[str], bytes | None] | None = None,
        **limits: int,
    ) -> "Scene":
        """Makes the scene of a script: a str is its text, a path (pathlib.Path) its file.

        `name` stands for a text in messages. `variables` of the top level and attributes of
        Settings get these values in place of the script's (see crt.Expression). `t` is the frame of
        an animation. `compat` may be 2015, for a script of that year (docs/compat.md). `print` gets
        each line that the script prints. `open_file` is asked for the content of each file that the
        script names; None leaves it to the file system. `limits` are max_steps and the like, see
        crt_script_options. What a callback raises comes out of here. So does Ctrl-C. A script that
        is wrong raises crt.ScriptError.
        """
        guard = Guard()
        options = _ScriptOptions(
            t=t, compat=compat, allow_outside_files=allow_outside_files, **limits
        )
        options.set(**_pairs("variable", variables), **_pairs("setting", settings))
        directories = [to_utf8(directory) for directory in resource_directories]
        options.resource_directories = _texts(directories)
        options.resource_directory_count = len(directories)
        options.poll = POLL(lambda _user: guard.call(_nothing))
        if print is not None:
            options.print = _print_callback(guard, print)
        if open_file is not None:
            options.open_file = _open_file_callback(guard, open_file)
        with guard.raising():
            return cls._run(script, name, options)

    @classmethod
    def _run(cls, script: str | os.PathLike[str], name: str, options: "_ScriptOptions") -> "Scene":
        said = ctypes.c_void_p()
        rest = ctypes.byref(options), ctypes.byref(said)
        try:
            if isinstance(script, str):
                code = script.encode()
                scene = cls._adopt(create("crt_scene_from_script", code, len(code), name, *rest))
            else:
                scene = cls._adopt(create("crt_scene_from_script_file", script, *rest))
        except Error as error:
            if said.value is None:
                raise
            text, diagnostics = diagnostics_of(said.value)
            raise ScriptError(error.status, text, diagnostics) from None
        if said.value is not None:
            _, scene.diagnostics = diagnostics_of(said.value)
        return scene

    def add(self, *things: Entity | Light) -> None:
        """Adds entities and lights."""
        with self._lock:
            for thing in things:
                if isinstance(thing, Entity):
                    library.crt_scene_add_entity(self._handle, thing._handle)
                else:
                    library.crt_scene_add_light(self._handle, reference(thing, "crt_light"))

    @property
    def entities(self) -> list[Entity]:
        with self._lock:
            scene = self._handle
            count = library.crt_scene_entity_count(scene)
            return [
                Entity._adopt(create("crt_scene_get_entity", scene, index))
                for index in range(count)
            ]

    @property
    def lights(self) -> list[Light]:
        with self._lock:
            scene = self._handle
            count = library.crt_scene_light_count(scene)
            return [Light._filled_by("crt_scene_get_light", scene, index) for index in range(count)]

    @property
    def camera(self) -> Camera:
        """Returns a copy, as do the next two: assign what you have changed."""
        with self._lock:
            return Camera._filled_by("crt_scene_get_camera", self._handle)

    @camera.setter
    def camera(self, camera: Camera) -> None:
        with self._lock:
            library.crt_scene_set_camera(self._handle, reference(camera, "crt_camera"))

    @property
    def background(self) -> Background:
        with self._lock:
            background = Background._filled_by("crt_scene_get_background", self._handle)
            if background.image is not None:
                background.image = Image._adopt(library.crt_image_retain(background.image))
            return background

    @background.setter
    def background(self, background: Background) -> None:
        with self._lock:
            library.crt_scene_set_background(self._handle, reference(background, "crt_background"))

    @property
    def settings(self) -> Settings:
        with self._lock:
            return Settings._filled_by("crt_scene_get_settings", self._handle)

    @settings.setter
    def settings(self, settings: Settings) -> None:
        with self._lock:
            library.crt_scene_set_settings(self._handle, reference(settings, "crt_settings"))

    def copy(self) -> "Scene":
        """Returns another scene with the same content."""
        with self._lock:
            return Scene._adopt(create("crt_scene_copy", self._handle))

    def prepare(self, max_primitives: int = 0) -> Prepared:
        """Checks the scene and builds what rays need. Ctrl-C ends it, and comes out of here. A
        scene of more than max_primitives is an error; 0 is as many as memory is enough for.

        A scene of more than max_primitives is an error; 0 is as many as memory is enough for.
        """
        guard = Guard()
        options = _PrepareOptions()
        options.max_primitives = max_primitives
        options.poll = POLL(lambda _user: guard.call(_nothing))
        with self._lock, guard.raising():
            return Prepared._adopt(
                create("crt_scene_prepare_with", self._handle, ctypes.byref(options))
            )

    def render(self, **options: Any) -> Image:
        """Prepares and renders. The options are those of Prepared.render()."""
        return self.prepare().render(**options)


@growable("crt_prepare_options")
class _PrepareOptions(Struct):
    reserved: Unsigned
    poll: Annotated[Any, POLL]
    poll_user: Pointer
    max_primitives: Long


@growable("crt_script_options")
class _ScriptOptions(Struct):
    allow_outside_files: Int
    resource_directories: Pointer
    resource_directory_count: Long
    t: Double
    variable_names: Pointer
    variable_values: Pointer
    variable_count: Long
    setting_names: Pointer
    setting_values: Pointer
    setting_count: Long
    max_steps: Long
    max_entities: Long
    max_call_depth: Long
    max_list_length: Long
    max_string_bytes: Long
    max_memory_bytes: Long
    max_source_bytes: Long
    max_errors: Long
    open_file: Annotated[Any, OPEN_FILE]
    open_file_user: Pointer
    print: Annotated[Any, PRINT]
    print_user: Pointer
    poll: Annotated[Any, POLL]
    poll_user: Pointer
    compat: Int
    reserved: Int


def _texts(texts: list[bytes]) -> Any:
    return (ctypes.c_char_p * len(texts))(*texts)


def _pairs(kind: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Returns the three fields of the options that have names, values and their count."""
    names, expressions = to_expressions(values)
    return {
        f"{kind}_names": _texts([to_utf8(name) for name in names]),
        f"{kind}_values": _texts([to_utf8(text) for text in expressions]),
        f"{kind}_count": len(names),
    }


def _nothing() -> None:
    """Does nothing, as a callback that only checks whether another one has raised something."""


def _print_callback(guard: Guard, print: Callable[[str], Any]) -> Any:
    def call(line: bytes) -> None:
        print(line.decode(errors="replace"))

    return PRINT(lambda line, length, _user: guard.call(call, ctypes.string_at(line, length)))


def _open_file_callback(guard: Guard, open_file: Callable[[str], bytes | None]) -> Any:
    given, not_given = 0, 1

    def call(path: bytes, content: int) -> int:
        found = open_file(os.fsdecode(path))
        if found is None:
            return not_given
        library.crt_file_content_append(content, bytes(found), len(found))
        return given

    return OPEN_FILE(lambda path, content, _user: guard.call(call, path, content))
