"""This module asks for every crossing of rays, which come in arrays that grow."""

import ctypes
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._handles import Reference
from ._library import library
from ._queries import are_occluded
from .errors import Error
from .rays import ENTERING, HIT, RAY, Batch


class Crossings(NamedTuple):
    """Crossings are those of many rays. Those of ray i, in the order of the array, are
    hits[offsets[i]:offsets[i + 1]]."""

    hits: NDArray[np.void]
    """has the dtype crt.HIT"""
    offsets: NDArray[np.int64]
    """has one more number than there are rays, and begins with 0"""

    def of(self, index: int) -> NDArray[np.void]:
        """Returns the hits of one ray."""
        count = len(self.offsets) - 1
        if not -count <= index < count:
            raise IndexError(f"there is no ray {index} among {count}")
        place = index % count
        return self.hits[self.offsets[place] : self.offsets[place + 1]]

    @property
    def counts(self) -> NDArray[np.int64]:
        """Returns how many crossings each ray has."""
        return np.diff(self.offsets)


def crossings_of_one(prepared: Reference, ray: Batch) -> NDArray[np.void]:
    """Returns the crossings of one ray."""
    return _crossings_of(prepared, ray, np.zeros(1, np.int64)).hits


def crossings_of_many(prepared: Reference, rays: Batch) -> Crossings:
    """Returns the crossings of many rays. Most rays that have none are found together first, which
    takes much less time."""
    return _crossings_of(prepared, rays, np.flatnonzero(are_occluded(prepared, rays)))


def _crossings_of(prepared: Reference, rays: Batch, asked: NDArray[np.int64]) -> Crossings:
    """Returns the crossings of the rays that are asked for, by their index. The others have
    none."""
    hits = np.empty(max(16, 4 * len(asked)), HIT)
    counts = np.zeros(rays.count, np.int64)
    found = ctypes.c_size_t()
    ask, count = library.crt_crossings, ctypes.byref(found)
    size, address, used, room = HIT.itemsize, hits.ctypes.data, 0, len(hits)
    first, stride = rays.address, rays.stride
    for index in asked.tolist():
        ray = first + index * stride
        try:
            ask(prepared, ray, address + used * size, room - used, count)
            number = found.value
            if number > room - used:
                hits = _grown(hits[:used], 2 * room + number)
                address, room = hits.ctypes.data, len(hits)
                ask(prepared, ray, address + used * size, room - used, count)
        except Error as error:
            if rays.shape == ():
                raise
            raise Error(error.status, f"rays[{index}]: {error}") from None
        used += number
        counts[index] = number
    offsets = np.zeros(rays.count + 1, np.int64)
    np.cumsum(counts, out=offsets[1:])
    return Crossings(hits[:used], offsets)


def _grown(hits: NDArray[np.void], room: int) -> NDArray[np.void]:
    larger = np.empty(room, HIT)
    larger[: len(hits)] = hits
    return larger


def inside_lengths(prepared: Reference, rays: Batch) -> NDArray[np.float64]:
    """Returns how much of each ray, in units of its direction's length, is inside of solids.

    The crossings of the whole line decide it, so that a ray may begin and end anywhere.
    """
    given = rays.as_records().ravel()
    lines = given.copy()
    lines["t_min"], lines["t_max"] = -np.inf, np.inf
    hits, offsets = crossings_of_many(prepared, Batch(lines, RAY, "rays"))
    of_hit = np.repeat(np.arange(rays.count), np.diff(offsets))
    steps = np.where(hits["flags"] & ENTERING, 1, -1)
    before = _sums_before(steps, offsets[:-1])  # in how many solids: first from the line's begin
    before += _first_depths(hits["entity_id"], of_hit, steps, rays.count)[of_hit]

    is_last = np.ones(len(hits), np.bool_)
    is_last[:-1] = of_hit[1:] != of_hit[:-1]
    ends = np.full(len(hits), np.inf)
    ends[~is_last] = hits["t"][1:][~is_last[:-1]]
    lengths = np.where(before + steps > 0, _clipped(hits["t"], ends, given[of_hit]), 0)
    # What is before the first crossing may be inside, too.
    is_first = np.roll(is_last, 1) & (before > 0)
    lengths[is_first] += _clipped(-np.inf, hits["t"][is_first], given[of_hit[is_first]])
    sums: NDArray[np.float64] = np.bincount(of_hit, lengths, rays.count).astype(np.float64)
    return sums.reshape(rays.shape)


def _sums_before(steps: NDArray[np.int64], starts: NDArray[np.int64]) -> NDArray[np.int64]:
    """Returns the sum of what is before each number in its run. The runs begin at `starts`, and
    one that is empty begins where the next one does."""
    sums = np.cumsum(steps) - steps
    ends = np.append(starts[1:], len(steps))
    has_any = ends > starts
    runs: NDArray[np.int64] = np.repeat(sums[starts[has_any]], (ends - starts)[has_any])
    return sums - runs


def _clipped(begins: Any, ends: Any, rays: NDArray[np.void]) -> Any:
    """Returns how much of parts of lines belongs to the rays on them."""
    return np.maximum(np.minimum(ends, rays["t_max"]) - np.maximum(begins, rays["t_min"]), 0)


def _first_depths(
    entities: NDArray[np.uint32], of_hit: NDArray[np.int64], steps: NDArray[np.int64], count: int
) -> NDArray[np.int64]:
    """Returns in how many solids each line begins: of each entity in as many as it takes for the
    line not to leave more than it has entered."""
    depths = np.zeros(count, np.int64)
    if len(steps) == 0:
        return depths
    order = np.argsort((of_hit << 32) | entities, kind="stable")
    entities, of_hit, steps = entities[order], of_hit[order], steps[order]
    is_new = np.ones(len(steps), np.bool_)
    is_new[1:] = (entities[1:] != entities[:-1]) | (of_hit[1:] != of_hit[:-1])
    starts = np.flatnonzero(is_new)
    lowest = np.minimum.reduceat(_sums_before(steps, starts) + steps, starts)
    np.add.at(depths, of_hit[starts], np.maximum(-lowest, 0))
    return depths
