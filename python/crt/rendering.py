"""This module renders pictures of prepared scenes and asks ray queries."""

import ctypes
from collections.abc import Iterable
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _queries
from ._callbacks import Guard
from ._crossings import Crossings, crossings_of_many, crossings_of_one, inside_lengths
from ._handles import Handle
from ._library import create
from .images import Image
from .jobs import Job
from .options import Log, Path, Progress, Region, make_options
from .rays import FULL_HIT, HIT, RAY, START, Batch, Ray, Rays, points_of


def _answers(out: NDArray[np.void] | None, layout: np.dtype[Any], rays: Batch) -> Batch:
    """Returns where hits of rays are to be written: in `out`, or in a new array."""
    answers = Batch(np.empty(rays.shape, layout) if out is None else out, layout, "hits")
    if answers.shape != rays.shape or not answers.array.flags.writeable:
        raise ValueError(
            f"hits of shape {answers.shape} cannot be written for rays of {rays.shape}"
        )
    return answers


def _starts(starts: NDArray[np.void] | None, rays: Batch, name: str) -> Batch | None:
    """Returns where the starts of rays are."""
    if starts is None:
        return None
    batch = Batch(starts, START, name)
    if batch.shape != rays.shape:
        raise ValueError(f"{name} of shape {batch.shape} are not those of rays of {rays.shape}")
    return batch


class Prepared(Handle):
    """A Prepared is a scene ready for rays. It is immutable: any number of threads may use it at
    once."""

    _name = "crt_prepared"
    _instead_of_pickle = "prepare it again from what the scene is made from"

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
        """Renders a picture.

        `threads` is the most threads, 0 for all cores. `region` is x, y, width, height of a part,
        from the top left. `seed` replaces the settings', unless it is 0. `passes` is the number of
        passes to render (stats.passes), unless it is 0, whatever the settings' time budget. `aovs`,
        some of "depth", "normal", "id", "part", "albedo", "samples" and "error", become
        Image.channels.
        `checkpoint` is a file that keeps a picture which is rendered by passes, and from which the
        next render continues. `max_ray_steps` limits the things that one ray may be tested against,
        see crt_render_options. `progress` gets the share that is done, and True
        shows it on standard error (by tqdm, if that is installed). `log` gets the messages. Both
        may be called from other threads, one at a time. If progress returns False, the render is
        cancelled, which raises crt.Error. What progress raises cancels the render, too, and comes
        out of here. So does Ctrl-C.
        """
        guard = Guard()
        options = make_options(
            guard,
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
        with guard.raising():
            return Image._adopt(create("crt_render", self._handle, ctypes.byref(options)))

    def start(
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
    ) -> "Job":
        """Starts to render in the background, otherwise as render()."""
        guard = Guard()
        options = make_options(
            guard,
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
        return Job(create("crt_render_start", self._handle, ctypes.byref(options)), guard, options)

    def intersect(
        self, rays: Ray | NDArray[Any], out: NDArray[np.void] | None = None
    ) -> NDArray[np.void]:
        """Finds the nearest hit of each ray. A miss has an infinite t, and crt.NO_ENTITY for an
        entity_id.

        `rays` has the dtype crt.RAY, or is float64 with 8 numbers in its last dimension; `out`, if
        given, has crt.HIT and as many items. Both are used in place. If a ray is wrong, which its
        error says, `out` may have been written in part.
        """
        questions = Batch(rays, RAY, "rays")
        answers = _answers(out, HIT, questions)
        _queries.intersect(self._handle, questions, answers)
        return answers.array

    def hit_parts(self, rays: Ray | NDArray[Any]) -> NDArray[np.void]:
        """Finds on which part of an entity each ray's nearest hit is, as an array of crt.HIT_PART.

        `part_id` is the innermost id around the primitive that was hit, such as that of a cutter:
        see `id=` and Entity.with_id. Without any it is the entity's place in the scene. `face`
        numbers the faces of the primitive. A crt.Box has 0 and 1 across x at its lower and upper
        end, 2 and 3 across y, 4 and 5 across z. Cylinders, cones and capsules have 0 for the side,
        1 at their start and 2 at their end. A crt.RoundedBox has 0 to 5 as a crt.Box has, 6 to 17
        for its edges, four each along x, y and z, and 18 to 25 for its corners. A crt.Extrusion has
        0 at its start and 1 at its end, and a crt.Revolution where its turn begins and ends. Both
        have further numbers for their sides. A crt.HeightField has 0 and 1 across x at its lower
        and upper end, 2 and 3 across z, 4 for its bottom, and further numbers for the triangles of
        its cells. Meshes have the place of the triangle among those with an area. All others have
        0. A miss has crt.NO_ENTITY for all three.
        """
        return _queries.hit_parts(self._handle, Batch(rays, RAY, "rays"))

    def distances(
        self, rays: Ray | NDArray[Any]
    ) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
        """Finds how far each ray's nearest hit is, and of which entity, faster than intersect(). A
        miss is at infinity, and of crt.NO_ENTITY."""
        return _queries.distances(self._handle, Batch(rays, RAY, "rays"))

    def occluded(self, rays: Ray | NDArray[Any]) -> NDArray[np.bool_]:
        """Asks whether any surface blocks each ray."""
        return _queries.are_occluded(self._handle, Batch(rays, RAY, "rays"))

    def trace(
        self,
        rays: Ray | NDArray[Any],
        starts: NDArray[np.void] | None = None,
        out: NDArray[np.void] | None = None,
    ) -> NDArray[np.void]:
        """Finds the nearest hit of each ray with all that is known of it, as an array of
        crt.FULL_HIT. A miss has an infinite t, and crt.NO_ENTITY for entity, part and face.

        `starts` says on what each ray begins: hits["start"] of earlier hits in the same prepared
        scene, or zeros for rays that begin in free space. A ray never meets there again what it
        begins on, whatever its coordinates say, and goes to the side that its direction says. Give
        it the position of the hit as its origin. So a walk ends:

            hits = prepared.trace(rays)
            while (found := hits["t"] < np.inf).any():
                rays, hits = rays[found], hits[found]
                rays["origin"] = hits["position"]
                hits = prepared.trace(rays, hits["start"])

        `rays` and `out` are used in place, as by intersect(). `starts` may lie in `out`.
        """
        questions = Batch(rays, RAY, "rays")
        begins = _starts(starts, questions, "starts")
        answers = _answers(out, FULL_HIT, questions)
        _queries.trace(self._handle, questions, begins, answers)
        return answers.array

    def blocked(
        self,
        rays: Ray | NDArray[Any],
        starts: NDArray[np.void] | None = None,
        ends: NDArray[np.void] | None = None,
    ) -> NDArray[np.bool_]:
        """Asks whether anything lies between the start and the end of each ray. `starts` are as in
        trace(). `ends` are the starts of hits on which rays end, at t_max: what they end on does
        not block them there."""
        questions = Batch(rays, RAY, "rays")
        begins = _starts(starts, questions, "starts")
        finishes = _starts(ends, questions, "ends")
        if begins is not None and finishes is not None and begins.stride != finishes.stride:
            begins, finishes = begins.packed(), finishes.packed()
        return _queries.are_blocked(self._handle, questions, begins, finishes)

    def trace_all(
        self, rays: Ray | NDArray[Any], starts: NDArray[np.void] | None = None
    ) -> Crossings:
        """Finds every crossing along rays, in order, as crt.Crossings of crt.FULL_HIT. `starts` are
        as in trace(). It takes less time than crossings()."""
        questions = Batch(np.asarray(rays), RAY, "rays")
        begins = _starts(starts, questions, "starts")
        return Crossings(*_queries.all_crossings(self._handle, questions, begins))

    def locate(self, points: ArrayLike) -> NDArray[np.void]:
        """Finds in what each point is, as an array of crt.LOCATION: the innermost solid around it,
        by its `entity_id`, `part_id` and `user`. The part is the first as written that holds the
        point. A point in no solid has crt.NO_ENTITY. `points` have 3 numbers in the last
        dimension."""
        return _queries.locate(self._handle, points_of(points, "locate: points"))

    @overload
    def crossings(self, rays: Rays | NDArray[np.float64]) -> Crossings: ...  # type: ignore
    @overload
    def crossings(self, rays: Ray) -> NDArray[np.void]: ...
    def crossings(self, rays: Any) -> Any:
        """Finds every crossing along rays, in order: the solid intervals that CSG leaves.

        For one ray (crt.ray(), or a record of an array) it returns an array of crt.HIT. For an
        array of rays it returns crt.Crossings: `hits` has those of all rays one after the other,
        and those of ray i are hits[offsets[i]:offsets[i + 1]]. Rays that meet something are asked
        one by one, so that a million takes seconds.

        Crossings of several entities may overlap, and the first of a ray that begins inside of a
        solid leaves it. So they need not come in pairs: inside_lengths() minds that.
        """
        questions = Batch(np.asarray(rays), RAY, "rays")
        if questions.shape == ():
            return crossings_of_one(self._handle, questions)
        return crossings_of_many(self._handle, questions)

    def inside_lengths(self, rays: Ray | NDArray[Any]) -> NDArray[np.float64]:
        """Finds how much of each ray is inside of solids, in units of its direction's length: how
        thick they are. It is 0 for a ray that meets nothing.

        Where entities overlap, it counts once. A ray may begin and end inside of solids. Only one
        whose whole line crosses nothing counts as outside, though it may be within a crt.Plane's
        half-space. Surfaces such as a crt.Disc have no inside: the scene must not have any.
        """
        return inside_lengths(self._handle, Batch(rays, RAY, "rays"))
