"""The structs of crt.h that may grow become classes with their fields.

    @growable("crt_camera", projection=Projection)
    class Camera(Struct): ...

is a ctypes.Structure that begins with struct_size, as all of them do, and goes on with the fields
that _fields.py has of crt_camera. Of these, `projection` is an enumeration.
"""

import ctypes
import enum
import inspect
import textwrap
from collections.abc import Callable, Iterable
from typing import Any, ClassVar, TypeVar

from . import _arguments
from ._callbacks import CALLBACKS
from ._fields import FIELDS
from ._handles import Handle
from ._library import KINDS, library

Self = TypeVar("Self", bound="Struct")
Class = TypeVar("Class", bound="type[Struct]")

_NO_MEANING = ("reserved", "struct_size")  # the fields that fill gaps, or are the library's


class Struct(ctypes.Structure):
    """A Struct takes keyword arguments that change fields. The others keep what the library's
    crt_*_init() has put there. It can be copied, compared and pickled."""

    _name: ClassVar[str]  # of the struct in crt.h
    _shown: ClassVar[str]  # its name in messages
    _kinds: ClassVar[dict[str, Any]]
    _enums: ClassVar[dict[str, type[enum.IntEnum]]]
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

    @classmethod
    def _public(cls) -> list[str]:
        """Returns the names of the fields that mean something."""
        return [name for name in cls._kinds if not name.startswith(_NO_MEANING)]

    @classmethod
    def _types(cls) -> dict[str, str]:
        """Returns how Python declares the types of these fields."""
        names = {ctypes.c_double: "float", ctypes.c_char_p: "str | None"}
        pointees = {
            "crt_pattern": "Pattern | None",
            "crt_image": "Image | None",
            "crt_color_stop": "ColorStops | None",
        }
        types = {}
        for name in cls._public():
            kind = cls._kinds[name]
            if name in cls._enums:
                enumeration = cls._enums[name].__name__
                types[name] = f"{enumeration} | int | {enumeration}Name"
            elif name in cls._pointees:
                types[name] = pointees[cls._pointees[name]]
            else:
                is_vector = issubclass(kind, ctypes.Array)
                types[name] = "Vector" if is_vector else names.get(kind, "int")
        return types

    def set(self, **fields: Any) -> None:
        """Changes several fields."""
        for name, value in fields.items():
            setattr(self, name, value)

    def _content(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in self._public()}

    def _snapshot(self: Self, why: str) -> Self:
        """Returns a copy that refuses changes."""
        twin = type(self).from_buffer_copy(self)
        kept = {
            name: value._snapshot(why) if isinstance(value, Struct) else value
            for name, value in self._kept.items()
        }
        ctypes.Structure.__setattr__(twin, "_kept", {**kept, "_why_frozen": why})
        return twin

    def _freeze(self: Self, why: str) -> Self:
        """Makes it refuse changes, which would be lost. Copies of it can be changed."""
        self._kept["_why_frozen"] = why
        for value in self._kept.values():
            if isinstance(value, Struct):
                value._freeze(why)
        return self

    def _require_free(self, name: str) -> None:
        why = self._kept.get("_why_frozen")
        if why is not None:
            raise AttributeError(f"{self._shown}: {name} cannot be assigned, as {why}")

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if not name.startswith(_NO_MEANING)]

    def __setattr__(self, name: str, value: Any) -> None:
        self._require_free(name)
        kind = self._kinds.get(name)
        if kind is None:
            known = ", ".join(self._public())
            raise AttributeError(f"{self._shown} has no {name!r}; it has {known}")
        where = f"{self._shown}: {name}"
        if kind is ctypes.c_void_p:
            if value is not None and name in self._pointees:
                require_type(value, self._pointees[name], where)
            self._kept[name] = value
        if isinstance(value, str) and name in self._enums:
            value = _member(self._enums[name], value, where)
        super().__setattr__(name, _to_c(kind, value, where))

    def __getattribute__(self, name: str) -> Any:
        value = super().__getattribute__(name)
        if name.startswith("_"):
            return value
        kept = self._kept.get(name)
        if kept is not None:
            return kept
        kind = self._enums.get(name)
        return _to_python(value) if kind is None else _to_enum(kind, value)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Struct) or type(self) is not type(other):
            return NotImplemented
        return self._content() == other._content()

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self._content())

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={value!r}" for name, value in self._content().items())
        return f"{type(self).__name__}({fields})"


    def _brief(self) -> str:
        """Returns how it is written without the fields that have their defaults."""
        has_types = hasattr(library, f"{self._name}_init_type")
        default = self.of_type(self.type) if has_types else type(self)()
        fields = []
        for name, value in self._content().items():
            if name == "type" and has_types or value != getattr(default, name):
                fields.append(f"{name}={_arguments.written(value)}")
        return f"{type(self).__name__}({', '.join(fields)})"


def _restored(cls: Callable[..., Struct], content: dict[str, Any]) -> Struct:
    return cls(**content)


def growable(
    name: str, has_init: bool = True, shown: str | None = None, **enums: type[enum.IntEnum]
) -> Callable[[Class], Class]:
    """Gives a class the fields of a struct. `name` is the struct's, and `has_init` says that there
    is a crt_*_init(). `shown` is a name for messages. The rest are the fields that have the values
    of an enumeration."""

    def finish(cls: Class) -> Class:
        kinds = {}
        pointees = {}
        texts = {}
        for declaration, text in FIELDS[name]:
            field, kind, pointee = _field(declaration)
            kinds[field] = kind
            texts[field] = text
            if pointee is not None:
                pointees[field] = pointee
        cls._name = name
        cls._shown = shown or cls.__name__
        cls._kinds = kinds
        cls._enums = enums
        cls._pointees = pointees
        cls._has_init = has_init
        cls._fields_ = [("struct_size", ctypes.c_uint32), *kinds.items()]
        if not cls.__name__.startswith("_"):
            _document(cls, texts)
        return cls

    return finish


def _field(declaration: str) -> tuple[str, Any, str | None]:
    """Returns the name of a field, its type of ctypes, and what it must point to."""
    words = declaration.replace("struct ", "").split()
    field = words[-1].removesuffix("[3]")
    if words[0] in CALLBACKS:
        return field, CALLBACKS[words[0]], None
    if "*" in declaration:
        if declaration.startswith("const char* ") and "const*" not in declaration:
            return field, ctypes.c_char_p, None
        pointee = words[1 if words[0] == "const" else 0].removesuffix("*")
        return field, ctypes.c_void_p, pointee if pointee.startswith("crt_") else None
    kind: Any = KINDS[words[0]]
    return field, kind * 3 if declaration.endswith("[3]") else kind, None


def _document(cls: Any, texts: dict[str, str]) -> None:
    """Adds what crt.h says of the fields to the class's documentation, and its signature."""
    lines = [inspect.cleandoc(cls.__doc__), "", "Its fields are:"]
    for field, type_name in cls._types().items():
        if field in cls._enums:
            type_name = f"{cls._enums[field].__name__}, or its name"
        text = f"{field} ({type_name}): {texts[field]}".rstrip(": ")
        lines += textwrap.wrap(text, 96, initial_indent="- ", subsequent_indent="  ")
    cls.__doc__ = "\n".join(lines)
    if cls._has_init:
        cls.__signature__ = inspect.Signature(_keywords(cls, ()))
    for method in vars(cls).values():
        if isinstance(method, classmethod):
            _document_method(cls, method.__func__)


def _document_method(cls: Any, function: Any) -> None:
    """Gives a method that takes any of the fields its signature."""
    given = list(inspect.signature(function).parameters.values())
    if given[-1].kind is inspect.Parameter.VAR_KEYWORD:
        taken = ["type", *(parameter.name for parameter in given)]
        keywords = _keywords(cls, taken)
        function.__signature__ = inspect.Signature(
            [*given[:-1], *keywords], return_annotation=cls.__name__
        )


def _keywords(cls: Any, taken: Iterable[str]) -> list[inspect.Parameter]:
    return [
        inspect.Parameter(field, inspect.Parameter.KEYWORD_ONLY, default=_Default())
        for field in cls._public()
        if field not in taken
    ]


class _Default:
    """A _Default stands for what the library puts into a field."""

    def __repr__(self) -> str:
        return "..."


def require_type(value: Any, name: str, argument: str) -> None:
    """Refuses what is not of this type of crt.h, as the library could only take it for one."""
    if getattr(value, "_name", None) != name:
        words = name.removeprefix("crt_")
        article = "an" if words[0] in "aeio" else "a"
        raise _arguments.refusal(argument, f"{article} {words.capitalize()}", value)


def reference(value: Any, name: str, argument: str | None = None) -> Any:
    """Returns the address of a struct as an argument."""
    require_type(value, name, argument or name.removeprefix("crt_"))
    return ctypes.byref(value)


def texts(given: Iterable[bytes]) -> Any:
    """Returns an array of texts as C has them."""
    content = list(given)
    return (ctypes.c_char_p * len(content))(*content)


def _to_c(kind: Any, value: Any, name: str) -> Any:
    if kind is ctypes.c_void_p:
        return _address(value, name)
    if kind is ctypes.c_double:
        return _arguments.number(value, name)
    if kind is ctypes.c_char_p:
        return None if value is None else _arguments.text(value, name)
    if kind in (ctypes.c_int32, ctypes.c_uint32, ctypes.c_uint64):
        return _arguments.whole(value, name, kind)
    return _arguments.vector(value, name) if issubclass(kind, ctypes.Array) else value


def _address(value: Any, name: str) -> int | None:
    """Returns where a Struct, an array of ctypes or what is behind a handle begins."""
    if isinstance(value, Handle):
        return value._handle._as_parameter_
    if isinstance(value, (ctypes.Structure, ctypes.Array)):
        return ctypes.addressof(value)
    if value is None or isinstance(value, int):
        return value
    raise _arguments.refusal(name, "something of this package", value)


def _to_python(value: Any) -> Any:
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return tuple(value) if isinstance(value, ctypes.Array) else value


def _member(kind: type[enum.IntEnum], name: str, where: str) -> enum.IntEnum:
    """Returns the member of an enumeration that a text names in any case."""
    try:
        return kind[name.upper()]
    except KeyError:
        members = ", ".join(f"{kind.__name__}.{member.name}" for member in kind)
        raise _arguments.refusal(where, f"one of {members}", name) from None


def _to_enum(kind: type[enum.IntEnum], value: int) -> int:
    """Returns the member, or the number if a later version of the library has added it."""
    try:
        return kind(value)
    except ValueError:
        return value
