"""This module asks for every crossing of rays, which come in arrays that grow."""

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._handles import Reference
from ._library import library
from .errors import Error
from .rays import HIT, Batch


class Crossings(NamedTuple):
    """Crossings are those of many rays. Those of ray i, in the order of the array, are
    hits[offsets[i]:offsets[i + 1]]."""

    hits: NDArray[Any]
    """has the dtype crt.HIT"""
    offsets: NDArray[Any]
    """has one more number than there are rays, and begins with 0"""

    def of(self, index: int) -> NDArray[Any]:
        """Returns the hits of one ray."""
        count = len(self.offsets) - 1
        if not -count <= index < count:
            raise IndexError(f"there is no ray {index} among {count}")
        place = index % count
        return self.hits[self.offsets[place] : self.offsets[place + 1]]

    @property
    def counts(self) -> NDArray[Any]:
        """Returns how many crossings each ray has."""
        return np.diff(self.offsets)


def crossings_of_one(prepared: Reference, ray: Batch) -> NDArray[Any]:
    """Returns the crossings of one ray."""
    return crossings_of_many(prepared, ray).hits


def crossings_of_many(prepared: Reference, rays: Batch) -> Crossings:
    """Returns the crossings of many rays."""
    hits = np.empty(max(16, 4 * rays.count), HIT)
    offsets = np.zeros(rays.count + 1, np.int64)
    found = ctypes.c_size_t()
    ask, count = library.crt_crossings, ctypes.byref(found)
    size, address, used = HIT.itemsize, hits.ctypes.data, 0
    for index in range(rays.count):
        ray = rays.address + index * rays.stride
        room = len(hits) - used
        try:
            ask(prepared, ray, address + used * size, room, count)
            if found.value > room:
                hits = _grown(hits[:used], 2 * len(hits) + found.value)
                address = hits.ctypes.data
                ask(prepared, ray, address + used * size, len(hits) - used, count)
        except Error as error:
            if rays.shape == ():
                raise
            raise Error(error.status, f"rays[{index}]: {error}") from None
        used += found.value
        offsets[index + 1] = used
    return Crossings(hits[:used], offsets)


def _grown(hits: NDArray[Any], room: int) -> NDArray[Any]:
    larger = np.empty(room, HIT)
    larger[: len(hits)] = hits
    return larger
