"""The structs of crt.h that may grow are declared by annotations.

    @growable("crt_camera")
    class Camera(Struct):
        position: Vector
        fov: Double

is a ctypes.Structure that begins with struct_size, as all of them do, and goes on with these
fields.
"""

import ctypes
import operator
from collections.abc import Callable, Sequence
from typing import Annotated, Any, ClassVar, TypeVar

from ._handles import Handle
from ._library import library, to_utf8

Double = Annotated[float, ctypes.c_double]
Int = Annotated[int, ctypes.c_int32]
Unsigned = Annotated[int, ctypes.c_uint32]
Long = Annotated[int, ctypes.c_uint64]
Vector = Annotated[Sequence[float], ctypes.c_double * 3]
Text = Annotated[Any, ctypes.c_char_p]  # str or None
Pointer = Annotated[Any, ctypes.c_void_p]
PatternPointer = Annotated[Any, ctypes.c_void_p, "crt_pattern"]  # or None, as the next
ImagePointer = Annotated[Any, ctypes.c_void_p, "crt_image"]

Self = TypeVar("Self", bound="Struct")
Class = TypeVar("Class", bound="type[Struct]")


def vector(numbers: Sequence[float]) -> Any:
    """Returns three numbers as C has them."""
    x, y, z = numbers
    return (ctypes.c_double * 3)(x, y, z)


class Struct(ctypes.Structure):
    """A Struct takes keyword arguments that change fields. The others keep what the library's
    crt_*_init() has put there."""

    _name: ClassVar[str]
    _kinds: ClassVar[dict[str, Any]]
    _pointees: ClassVar[dict[str, str]]  # what pointers must point to, by the name of the field
    _has_init: ClassVar[bool]
    _kept: dict[str, Any]  # and what they do point to

    def __init__(self, **fields: Any) -> None:
        super().__init__()
        super().__setattr__("_kept", {})
        if self._has_init:
            getattr(library, f"{self._name}_init")(ctypes.byref(self), ctypes.sizeof(self))
        else:
            super().__setattr__("struct_size", ctypes.sizeof(self))
        self.set(**fields)

    @classmethod
    def of_type(cls: type[Self], kind: int, /, **fields: Any) -> Self:
        """Makes one of the types that the struct has a list of, with the defaults of that type."""
        self = cls()
        getattr(library, f"{cls._name}_init_type")(ctypes.byref(self), ctypes.sizeof(self), kind)
        self.set(**fields)
        return self

    @classmethod
    def _filled_by(cls: type[Self], function: str, *arguments: Any) -> Self:
        """Returns what a function of the library writes into its last argument, with texts of
        Python's own."""
        self = cls()
        getattr(library, function)(*arguments, ctypes.byref(self))
        for name, kind in cls._kinds.items():
            if kind is ctypes.c_char_p:
                setattr(self, name, getattr(self, name))
        return self

    def set(self, **fields: Any) -> None:
        """Changes several fields."""
        for name, value in fields.items():
            setattr(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        kind = self._kinds.get(name)
        if kind is None:
            raise AttributeError(
                f"{type(self).__name__} has no {name!r}; it has {', '.join(self._kinds)}"
            )
        if kind is ctypes.c_void_p:
            if value is not None and name in self._pointees:
                require_type(value, self._pointees[name], name)
            self._kept[name] = value
        super().__setattr__(name, _to_c(kind, value))

    def __getattribute__(self, name: str) -> Any:
        value = super().__getattribute__(name)
        if name.startswith("_"):
            return value
        kept = self._kept.get(name)
        return _to_python(value) if kept is None else kept

    def __repr__(self) -> str:
        fields = ", ".join(
            f"{name}={getattr(self, name)!r}" for name in self._kinds if name != "reserved"
        )
        return f"{type(self).__name__}({fields})"


def growable(name: str, has_init: bool = True) -> Callable[[Class], Class]:
    """Makes fields of a class's annotations. `name` is the struct's, and `has_init` says that there
    is a crt_*_init()."""

    def finish(cls: Class) -> Class:
        notes = {
            field: annotation.__metadata__ for field, annotation in cls.__annotations__.items()
        }
        kinds = {field: note[0] for field, note in notes.items()}
        cls._name = name
        cls._kinds = kinds
        cls._pointees = {field: note[1] for field, note in notes.items() if len(note) > 1}
        cls._has_init = has_init
        cls._fields_ = [("struct_size", ctypes.c_uint32), *kinds.items()]
        return cls

    return finish


def require_type(value: Any, name: str, argument: str) -> None:
    """Refuses what is not of this type of crt.h, as the library could only take it for one."""
    if getattr(value, "_name", None) != name:
        raise TypeError(
            f"{argument} must be a {name.removeprefix('crt_')}, not a {type(value).__name__}"
        )


def reference(value: Struct, name: str) -> Any:
    """Returns the address of a struct as an argument."""
    require_type(value, name, name.removeprefix("crt_"))
    return ctypes.byref(value)


def _to_c(kind: Any, value: Any) -> Any:
    if kind is ctypes.c_void_p:
        return _address(value)
    if kind is ctypes.c_double:
        return float(value)
    if kind is ctypes.c_char_p:
        return None if value is None else to_utf8(value)
    if kind in (ctypes.c_int32, ctypes.c_uint32, ctypes.c_uint64):
        number = operator.index(value)
        if kind(number).value != number:  # ctypes would cut it off
            raise OverflowError(f"{number} is too large or too small")
        return number
    return vector(value) if issubclass(kind, ctypes.Array) else value


def _address(value: Any) -> int | None:
    """Returns where a Struct, an array of ctypes or what is behind a handle begins."""
    if isinstance(value, Handle):
        return value._handle._as_parameter_
    if isinstance(value, (ctypes.Structure, ctypes.Array)):
        return ctypes.addressof(value)
    if value is None:
        return None
    raise TypeError(f"a {type(value).__name__} cannot be pointed to")


def _to_python(value: Any) -> Any:
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return tuple(value) if isinstance(value, ctypes.Array) else value
