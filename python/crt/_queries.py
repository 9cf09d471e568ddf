"""This module asks the library about many rays, piece by piece: between the pieces Python sees
signals, such as Ctrl-C. The answers do not depend on that."""

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._handles import Reference
from ._library import library
from .errors import Error
from .rays import HIT_PART, NO_ENTITY, Batch

PIECE = 65536  # rays, which take some hundredths of a second


def intersect(prepared: Reference, rays: Batch, hits: Batch) -> None:
    """Finds the nearest hit of each ray."""

    def ask(ray: int, first: int, count: int) -> None:
        place = hits.address + first * hits.stride
        library.crt_intersect(prepared, ray, rays.stride, count, place, hits.stride)

    _in_pieces(rays, ask)
    mark_misses(hits.array["t"], hits.array["entity_id"])


def hit_parts(prepared: Reference, rays: Batch) -> NDArray[np.void]:
    """Finds on which parts of entities the nearest hits are."""
    out = np.empty(rays.shape, HIT_PART)

    def ask(ray: int, first: int, count: int) -> None:
        place = out.ctypes.data + first * HIT_PART.itemsize
        library.crt_hit_parts(prepared, ray, rays.stride, count, place, 0)

    _in_pieces(rays, ask)
    return out


def distances(prepared: Reference, rays: Batch) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Finds how far the nearest hits are, and of which entities."""
    out, ids = np.empty(rays.shape, np.float64), np.empty(rays.shape, np.uint32)

    def ask(ray: int, first: int, count: int) -> None:
        places = out.ctypes.data + 8 * first, ids.ctypes.data + 4 * first
        library.crt_distances(prepared, ray, rays.stride, count, *places)

    _in_pieces(rays, ask)
    mark_misses(out, ids)
    return out, ids


def are_occluded(prepared: Reference, rays: Batch) -> NDArray[np.bool_]:
    """Asks whether any surface blocks each ray."""
    out = np.empty(rays.shape, np.bool_)

    def ask(ray: int, first: int, count: int) -> None:
        library.crt_occluded(prepared, ray, rays.stride, count, out.ctypes.data + first)

    _in_pieces(rays, ask)
    return out


def mark_misses(t: NDArray[np.float64], ids: NDArray[np.uint32]) -> None:
    """Gives misses an id that no entity has, in place of the library's 0."""
    np.copyto(ids, NO_ENTITY, where=np.isinf(t))


def _in_pieces(rays: Batch, ask: Any) -> None:
    """Calls ask(address of the first ray, its index, count) for all of them."""
    for first in range(0, rays.count, PIECE):
        try:
            ask(rays.address + first * rays.stride, first, min(PIECE, rays.count - first))
        except Error as error:
            message = re.sub(
                r"^rays\[(\d+)\]", lambda index: f"rays[{first + int(index[1])}]", str(error)
            )
            raise Error(error.status, message) from None
