"""These are references to what the library owns. Python drops them when it needs them no more."""

import types
from typing import Any, ClassVar, NoReturn, TypeVar

from ._library import library

Self = TypeVar("Self", bound="Handle")


class Reference:
    """A Reference is one reference. It stands for its handle in calls, which it outlives as their
    argument."""

    __slots__ = ("_as_parameter_", "_release")

    def __init__(self, handle: int, release: Any) -> None:
        self._as_parameter_ = handle
        self._release = release

    def __del__(self) -> None:
        self._release(self._as_parameter_)


class Handle:
    """A Handle is something of the library. It lives as long as it is used; `close()`, or `with`,
    ends its use earlier.

    Closing drops this object's reference. A call of another thread that is under way, and arrays
    that were lent, have references of their own, so closing never pulls anything from under them.
    Copies share what is behind the handle where that never changes.
    """

    _name: ClassVar[str]  # of the type in crt.h
    _instead_of_pickle: ClassVar[str]  # what to do, as the end of a sentence
    _reference: Reference | None = None

    @classmethod
    def _adopt(cls: type[Self], handle: int) -> Self:
        """Makes an object for a reference that is ours to release."""
        self = cls.__new__(cls)
        self._take(handle)
        return self

    def _take(self, handle: int) -> None:
        self._reference = Reference(handle, getattr(library, f"{self._name}_release"))

    @property
    def _handle(self) -> Reference:
        reference = self._reference
        if reference is None:
            raise ValueError(f"this {type(self).__name__} is closed")
        return reference

    def __setattr__(self, name: str, value: Any) -> None:
        if name[0] != "_":
            _require_assignable(type(self), name)
        super().__setattr__(name, value)

    def close(self) -> None:
        """Ends the use of this object. Closing again does no harm."""
        self._reference = None

    def __enter__(self: Self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: types.TracebackType | None,
    ) -> None:
        self.close()

    def __copy__(self: Self) -> Self:
        """Returns another object for the same thing, which is closed by itself."""
        reference = self._handle
        twin = self.__class__.__new__(self.__class__)
        twin.__dict__.update(self.__dict__)
        twin._reference = reference
        return twin

    def __deepcopy__(self: Self, _memo: dict[int, Any]) -> Self:
        return self.__copy__()

    def __reduce_ex__(self, _protocol: Any) -> NoReturn:
        name = type(self).__name__
        article = "an" if name[0] in "AEIO" else "a"
        raise TypeError(
            f"{article} {name} lives in the library's memory and cannot be pickled:"
            f" {self._instead_of_pickle}"
        )

    def __repr__(self) -> str:
        content = "closed" if self._reference is None else self._summary()
        return f"<crt.{type(self).__name__}: {content}>"

    def _summary(self) -> str:
        """Returns what __repr__ says of it."""
        return "open"


def _require_assignable(kind: type, name: str) -> None:
    """Refuses a name that a class of this package does not have, as the value would be lost."""
    is_ours = kind.__module__.partition(".")[0] == __name__.partition(".")[0]
    if not is_ours or hasattr(kind, name):
        return
    properties = [known for known in dir(kind) if isinstance(getattr(kind, known), property)]
    known = [one for one in properties if getattr(kind, one).fset is not None]
    there_is = f"; {', '.join(known)} can be assigned" if known else " that can be assigned"
    raise AttributeError(f"a crt.{kind.__name__} has no {name!r}{there_is}")
