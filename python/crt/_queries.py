"""This module asks the library about many rays, piece by piece: between the pieces Python sees
signals, such as Ctrl-C. The answers do not depend on that."""

import re
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._handles import Reference
from ._library import library
from .errors import Error
from .rays import FULL_HIT, HIT_PART, LOCATION, NO_ENTITY, Batch

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


def trace(prepared: Reference, rays: Batch, starts: Batch | None, hits: Batch) -> None:
    """Finds the nearest hit of each ray, which may begin on the surface of another hit."""

    def ask(ray: int, first: int, count: int) -> None:
        place = hits.address + first * hits.stride
        start = _starts_from(starts, first)
        library.crt_trace(prepared, ray, rays.stride, *start, count, place, hits.stride)

    _in_pieces(rays, ask)


def are_blocked(
    prepared: Reference, rays: Batch, starts: Batch | None, ends: Batch | None
) -> NDArray[np.bool_]:
    """Asks whether anything lies between the starts and the ends of rays. What both begin or end
    on must have one stride."""
    out = np.empty(rays.shape, np.bool_)

    def ask(ray: int, first: int, count: int) -> None:
        start, stride = _starts_from(starts, first)
        end, stride_of_ends = _starts_from(ends, first)
        stride = stride or stride_of_ends
        place = out.ctypes.data + first
        library.crt_blocked(prepared, ray, rays.stride, start, end, stride, count, place)

    _in_pieces(rays, ask)
    return out


def all_crossings(
    prepared: Reference, rays: Batch, starts: Batch | None
) -> tuple[NDArray[np.void], NDArray[np.int64]]:
    """Finds every crossing of rays, and where those of each ray begin."""
    pieces: list[NDArray[np.void]] = []
    offsets = np.zeros(rays.count + 1, np.int64)

    def ask(ray: int, first: int, count: int) -> None:
        bounds = np.zeros(count + 1, np.uintp)
        given = prepared, ray, rays.stride, *_starts_from(starts, first), count
        hits = np.empty(4 * count, FULL_HIT)
        try:
            library.crt_trace_all(*given, hits.ctypes.data, len(hits), bounds.ctypes.data)
        except Error as error:
            if bounds[count] <= len(hits):
                raise error
            hits = np.empty(bounds[count], FULL_HIT)
            library.crt_trace_all(*given, hits.ctypes.data, len(hits), bounds.ctypes.data)
        pieces.append(hits[: bounds[count]])
        offsets[first + 1 : first + count + 1] = offsets[first] + bounds[1:].astype(np.int64)

    _in_pieces(rays, ask)
    return np.concatenate(pieces) if pieces else np.empty(0, FULL_HIT), offsets


def locate(prepared: Reference, points: NDArray[np.float64]) -> NDArray[np.void]:
    """Finds in what points are."""
    shape = points.shape[:-1]
    out = np.empty(shape, LOCATION)
    count = out.size
    ids, parts = np.empty(count, np.uint32), np.empty(count, np.uint32)
    users = np.empty(count, np.uint64)
    answers = ids.ctypes.data, parts.ctypes.data, users.ctypes.data
    library.crt_locate(prepared, points.ctypes.data, 0, count, *answers)
    out["entity_id"], out["part_id"] = ids.reshape(shape), parts.reshape(shape)
    out["user"] = users.reshape(shape)
    return out


def _starts_from(starts: Batch | None, first: int) -> tuple[int | None, int]:
    """Returns the address of the starts from one on, and their stride."""
    if starts is None:
        return None, 0
    return starts.address + first * starts.stride, starts.stride


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
                r"^(rays|starts|ends)\[(\d+)\]",
                lambda place: f"{place[1]}[{first + int(place[2])}]",
                str(error),
            )
            raise Error(error.status, message) from None
