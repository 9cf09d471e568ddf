"""A scene is put together in Python, or made by a script."""

import ctypes
import os
import threading
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from . import _arguments, scripts
from ._callbacks import POLL, Guard
from ._handles import Handle, Reference
from ._library import create, library
from ._structs import Struct, growable, reference
from .entities import Entity
from .errors import Diagnostic, named
from .images import Image
from .options import Log, Path, Progress, Region
from .rendering import Prepared
from .values import Background, Camera, Light, Settings

Value = TypeVar("Value", Background, Camera, Settings)
T = TypeVar("T")

if TYPE_CHECKING:

    class _ListProperty(Generic[T]):
        """A _ListProperty is a property that is a list, and takes the content of anything. Not
        every type checker knows that of a property."""

        def __init__(
            self, get: Callable[[Any], list[T]], set: Callable[[Any, Iterable[T]], None]
        ) -> None: ...
        def __get__(self, thing: object, kind: type) -> list[T]: ...
        def __set__(self, thing: object, content: Iterable[T]) -> None: ...

else:
    _ListProperty = property


class Scene(Handle):
    """A Scene is the description of a picture: entities, lights, a camera, a background and
    settings. All of them are plain objects and lists, which you may change at any time:

        scene.settings.width = 800
        scene.camera.fov = 0.5
        scene.entities.append(crt.Sphere((0, 0, 0), 1))

    What `prepare()` makes of the scene, ready for rays, does not change with it.
    """

    _name = "crt_scene"
    _instead_of_pickle = "pickle the text of its script, or what its parts are made from"

    def __init__(
        self,
        entities: Iterable[Entity] = (),
        lights: Iterable[Light] = (),
        camera: Camera | None = None,
        background: Background | None = None,
        settings: Settings | None = None,
    ) -> None:
        self._take(create("crt_scene_create"))
        self.add(*_arguments.instances(entities, Entity, "Scene: entities"))
        self.add(*_arguments.instances(lights, Light, "Scene: lights"))
        if camera is not None:
            self.camera = camera
        if background is not None:
            self.background = background
        if settings is not None:
            self.settings = settings

    def _take(self, handle: int) -> None:
        super()._take(handle)
        self._lock = threading.RLock()  # the library takes one thread at a time
        # What Python has not asked for is in the library alone. The rest goes there before use.
        self._entities: list[Entity] | None = None
        self._lights: list[Light] | None = None
        self._values: dict[str, Any] = {}
        self._known: list[Reference] | None = []  # the entities in the library, if they are known
        self._kept: dict[int, tuple[Entity, Reference]] = {}  # those that may have been closed
        self._diagnostics: list[Diagnostic] = []

    @classmethod
    def from_script(
        cls,
        script: Path,
        *,
        name: str = "script",
        variables: Mapping[str, Any] = {},
        settings: Mapping[str, Any] = {},
        t: float = 0,
        compat: int = 0,
        resource_directories: Iterable[Path] = (),
        allow_outside_files: bool = False,
        print: scripts.Print | None = None,
        open_file: scripts.OpenFile | None = None,
        **limits: int,
    ) -> "Scene":
        """Makes the scene of a script, given as text. (A pathlib.Path is read as a file, as by
        from_file().)

        `name` stands for the text in messages. `variables` of the top level and attributes of
        Settings get these values in place of the script's (see crt.Expression). `t` is the frame of
        an animation. `compat` may be 2015, for a script of that year (docs/compat.md). `print` gets
        each line that the script prints. `open_file` is asked for the content of each file that the
        script names; None leaves it to the file system. `limits` are max_steps and the like, see
        crt_script_options. What a callback raises comes out of here. So does Ctrl-C. A script that
        is wrong raises crt.ScriptError.
        """
        text: str | None = None
        where: Path = name
        if isinstance(script, str):
            scripts.refuse_path(script)
            text = script
        elif isinstance(script, os.PathLike):
            where = script
        else:
            raise _arguments.refusal("Scene.from_script: script", "a text", script)
        handle, diagnostics = scripts.run(
            text,
            where,
            variables=variables,
            settings=settings,
            t=t,
            compat=compat,
            resource_directories=resource_directories,
            allow_outside_files=allow_outside_files,
            print=print,
            open_file=open_file,
            limits=limits,
        )
        return cls._made_by(handle, diagnostics)

    @classmethod
    def from_file(
        cls,
        path: Path,
        *,
        variables: Mapping[str, Any] = {},
        settings: Mapping[str, Any] = {},
        t: float = 0,
        compat: int = 0,
        resource_directories: Iterable[Path] = (),
        allow_outside_files: bool = False,
        print: scripts.Print | None = None,
        open_file: scripts.OpenFile | None = None,
        **limits: int,
    ) -> "Scene":
        """Makes the scene of a script in a file. The options are those of from_script(). Files that
        the script names are looked for beside it."""
        scripts.refuse_text(path)
        handle, diagnostics = scripts.run(
            None,
            os.fsdecode(_arguments.text(path, "Scene.from_file: path")),
            variables=variables,
            settings=settings,
            t=t,
            compat=compat,
            resource_directories=resource_directories,
            allow_outside_files=allow_outside_files,
            print=print,
            open_file=open_file,
            limits=limits,
        )
        return cls._made_by(handle, diagnostics)

    @classmethod
    def _made_by(cls, handle: int, diagnostics: list[Diagnostic]) -> "Scene":
        scene = cls._adopt(handle)
        scene._known = None
        scene._diagnostics = diagnostics
        return scene

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """Returns the warnings of the script that the scene is from."""
        return self._diagnostics

    def add(self, *things: Entity | Light) -> None:
        """Adds entities and lights."""
        with self._lock:
            for thing in things:
                if isinstance(thing, Entity):
                    self._kept[id(thing)] = thing, thing._handle
                    self.entities.append(thing)
                elif isinstance(thing, Light):
                    lights = self.lights
                    # This is for its check alone, as the library gets all lights again.
                    _add_light(self._handle, len(lights), thing)
                    lights.append(thing)
                else:
                    raise _arguments.refusal("add: a thing", "an Entity or a Light", thing)

    def _get_entities(self) -> list[Entity]:
        """Is the list of entities. A change of it changes the scene."""
        with self._lock:
            scene = self._handle
            if self._entities is None:
                count = library.crt_scene_entity_count(scene)
                places = range(count)
                handles = [create("crt_scene_get_entity", scene, place) for place in places]
                self._entities = [Entity._adopt(handle) for handle in handles]
                self._known = [entity._handle for entity in self._entities]
            return self._entities

    def _set_entities(self, entities: Iterable[Entity]) -> None:
        given = _arguments.instances(entities, Entity, "Scene: entities")
        with self._lock:
            self.entities[:] = given

    entities = _ListProperty(_get_entities, _set_entities)

    def _get_lights(self) -> list[Light]:
        """Is the list of lights. A change of it, or of a light in it, changes the scene."""
        with self._lock:
            scene = self._handle
            if self._lights is None:
                places = range(library.crt_scene_light_count(scene))
                self._lights = [
                    Light._filled_by("crt_scene_get_light", scene, place) for place in places
                ]
            return self._lights

    def _set_lights(self, lights: Iterable[Light]) -> None:
        given = _arguments.instances(lights, Light, "Scene: lights")
        with self._lock:
            self.lights[:] = given

    lights = _ListProperty(_get_lights, _set_lights)

    @property
    def camera(self) -> Camera:
        """Is the camera. A change of it changes the scene, as of the next two."""
        return self._value("camera", Camera)

    @camera.setter
    def camera(self, camera: Camera) -> None:
        self._set("camera", camera)

    @property
    def background(self) -> Background:
        """Is what a ray that hits nothing sees."""
        return self._value("background", Background)

    @background.setter
    def background(self, background: Background) -> None:
        self._set("background", background)

    @property
    def settings(self) -> Settings:
        """Says how the scene is rendered."""
        return self._value("settings", Settings)

    @settings.setter
    def settings(self, settings: Settings) -> None:
        self._set("settings", settings)

    def _value(self, name: str, kind: type[Value]) -> Value:
        with self._lock:
            scene = self._handle
            if name not in self._values:
                value: Any = kind._filled_by(f"crt_scene_get_{name}", scene)
                if isinstance(value, Background) and value.image is not None:
                    value.image = Image._adopt(library.crt_image_retain(value.image))
                self._values[name] = value
            return self._values[name]  # type: ignore[no-any-return]

    def _set(self, name: str, value: Any) -> None:
        with self._lock:
            given = reference(value, f"crt_{name}", f"Scene: {name}")
            with named(f"Scene: {name}"):
                getattr(library, f"crt_scene_set_{name}")(self._handle, given)
            self._values[name] = value

    def _update(self) -> Reference:
        """Gives the library what Python has, and returns its scene."""
        scene = self._handle
        for name, value in self._values.items():
            self._set(name, value)
        if self._lights is not None:
            lights = _arguments.instances(self._lights, Light, "Scene: lights")
            library.crt_scene_clear_lights(scene)
            for place, light in enumerate(lights):
                _add_light(scene, place, light)
        if self._entities is not None:
            self._update_entities(scene, self._entities)
        return scene

    def _update_entities(self, scene: Reference, entities: list[Entity]) -> None:
        given = _arguments.instances(entities, Entity, "Scene: entities")
        wanted = [
            self._kept[id(entity)][1] if id(entity) in self._kept else entity._handle
            for entity in given
        ]
        known, self._known = self._known, None
        if known is None:
            library.crt_scene_clear_entities(scene)
            known = []
        for place in range(len(known) - 1, len(wanted) - 1, -1):
            library.crt_scene_remove_entity(scene, place)
        for place, (old, new) in enumerate(zip(known, wanted)):
            if old is not new:
                library.crt_scene_replace_entity(scene, place, new)
        for entity in wanted[len(known) :]:
            library.crt_scene_add_entity(scene, entity)
        self._known = wanted
        self._kept = {id(entity): (entity, kept) for entity, kept in zip(given, wanted)}

    def copy(self) -> "Scene":
        """Returns another scene with the same content, which goes its own way."""
        with self._lock:
            copy = Scene._adopt(create("crt_scene_copy", self._update()))
            copy._known = None
            if self._entities is not None and self._known is not None:
                copy._entities, copy._known = list(self._entities), list(self._known)
                copy._kept = dict(self._kept)
            copy._diagnostics = list(self._diagnostics)
            return copy

    def __copy__(self) -> "Scene":
        return self.copy()

    def save_script(self, path: Path) -> None:
        """Writes the scene as a script, which from_file() reads. Meshes, images and large height
        fields go into files beside it, whose names begin with its own."""
        name = os.fsencode(_arguments.text(path, "Scene.save_script: path"))
        with self._lock:
            library.crt_scene_save_script(self._update(), name)

    def prepare(self, max_primitives: int = 0, previous: Prepared | None = None) -> Prepared:
        """Checks the scene and builds what rays need. Ctrl-C ends it, and comes out of here. A
        scene of more than max_primitives is an error; 0 is as many as memory is enough for.

        What was prepared last of this scene, or `previous`, is taken over as far as it is made of
        the same entities. So a scene of thousands of parts of which some move is prepared in a few
        milliseconds. Rays and pictures find the same, to the bit.
        """
        guard = Guard()
        options = _PrepareOptions(max_primitives=max_primitives, previous=previous)
        options.poll = POLL(lambda _user: guard.call(_nothing))
        with self._lock, guard.raising():
            return Prepared._adopt(
                create("crt_scene_prepare_with", self._update(), ctypes.byref(options))
            )

    def render(
        self,
        *,
        threads: int = 0,
        region: Region | None = None,
        seed: int = 0,
        passes: int = 0,
        aovs: Iterable[str] = (),
        checkpoint: Path | None = None,
        max_ray_steps: int = 0,
        progress: Progress | None = None,
        log: Log | None = None,
    ) -> Image:
        """Prepares and renders. The options are those of Prepared.render()."""
        return self.prepare().render(
            threads=threads,
            region=region,
            seed=seed,
            passes=passes,
            aovs=aovs,
            checkpoint=checkpoint,
            max_ray_steps=max_ray_steps,
            progress=progress,
            log=log,
        )

    def _summary(self) -> str:
        settings = self.settings
        entities, lights = len(self.entities), len(self.lights)
        return (
            f"{entities} {'entity' if entities == 1 else 'entities'},"
            f" {lights} light{'' if lights == 1 else 's'},"
            f" {settings.width} x {settings.height} pixels"
        )

    def _repr_png_(self) -> bytes:
        """Shows the scene in notebooks: small, and with few samples a pixel."""
        from .preview import picture_of_scene

        return picture_of_scene(self)._repr_png_()


def _add_light(scene: Reference, place: int, light: Light) -> None:
    with named(f"Scene: lights[{place}]"):
        library.crt_scene_add_light(scene, reference(light, "crt_light"))


@growable("crt_prepare_options", shown="prepare")
class _PrepareOptions(Struct):
    """_PrepareOptions say what preparing may be asked beyond the scene."""


def _nothing() -> None:
    """Does nothing, as a callback that only checks whether Ctrl-C was pressed."""
