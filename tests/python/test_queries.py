"""These tests ask ray queries on arrays in place."""

import math
import os
import signal
import unittest
from unittest import mock

import numpy as np
from support import INFINITY, parallel_rays, prepared_shell, shell, small_scene

import crt
from crt import _queries

prepared = prepared_shell()


def expected_t(rays: np.ndarray) -> np.ndarray:
    """Returns where a ray along z from z = -5 meets the unit ball."""
    rest = 1 - rays["origin"][..., 0] ** 2
    return np.where(rest > 0, 5 - np.sqrt(np.maximum(rest, 0)), INFINITY)


class Answers(unittest.TestCase):
    def test_the_nearest_hit(self):
        rays = parallel_rays(301)
        hits = prepared.intersect(rays)
        np.testing.assert_allclose(hits["t"], expected_t(rays), rtol=1e-14)
        middle = hits[150]
        np.testing.assert_allclose(middle["normal"], (0, 0, -1), atol=1e-15)
        self.assertEqual(middle["flags"], crt.ENTERING)

    def test_how_far_it_is(self):
        rays = parallel_rays(301)
        hits = prepared.intersect(rays)
        distances, ids = prepared.distances(rays)
        self.assertEqual((distances.dtype, ids.dtype), (np.float64, np.uint32))
        np.testing.assert_array_equal(distances, hits["t"])
        np.testing.assert_array_equal(ids, hits["entity_id"])

    def test_what_is_hit_at_all(self):
        rays = parallel_rays(301)
        occluded = prepared.occluded(rays)
        self.assertEqual(occluded.dtype, np.bool_)
        np.testing.assert_array_equal(occluded, np.isfinite(expected_t(rays)))

    def test_a_miss_is_of_no_entity(self):
        rays = parallel_rays(31)
        is_miss = ~prepared.occluded(rays)
        self.assertEqual(crt.NO_ENTITY, 0xFFFFFFFF)
        hits = np.zeros(62, crt.HIT)[::2].reshape(31, 1)
        prepared.intersect(rays.reshape(31, 1), out=hits)
        for ids in (hits["entity_id"][:, 0], prepared.distances(rays)[1]):
            np.testing.assert_array_equal(ids, np.where(is_miss, crt.NO_ENTITY, 0))
        one = prepared.intersect(crt.ray((9, 0, 0), (1, 0, 0)))
        self.assertEqual(one["entity_id"], crt.NO_ENTITY)

    def test_every_crossing(self):
        hits = prepared.crossings(crt.ray((0, 0, -5), (0, 0, 2)))
        np.testing.assert_allclose(hits["t"], (2, 2.25, 2.75, 3), rtol=1e-15)
        self.assertEqual(
            [bool(flags & crt.ENTERING) for flags in hits["flags"]], [True, False, True, False]
        )

    def test_more_crossings_than_there_was_room_for(self):
        row = crt.union(crt.Sphere((0, 0, 3 * i), 1) for i in range(100))
        hits = crt.Scene([row]).prepare().crossings(crt.ray((0, 0, -5), (0, 0, 1)))
        np.testing.assert_allclose(
            hits["t"], np.ravel([(3 * i + 4, 3 * i + 6) for i in range(100)])
        )

    def test_a_range_of_t(self):
        ray = crt.ray((0, 0, -5), (0, 0, 1), t_min=4.2, t_max=5.7)
        self.assertEqual(list(prepared.crossings(ray)["t"]), [4.5, 5.5])


class Memory(unittest.TestCase):
    RECORD = np.dtype(
        [("name", "S3"), ("ray", crt.RAY), ("count", "i4"), ("hit", crt.HIT), ("end", "u1")]
    )

    def records(self, count: int) -> np.ndarray:
        records = np.zeros(count, self.RECORD)
        records["ray"] = parallel_rays(count)
        records["name"], records["count"], records["end"] = b"abc", -1, 0xEE
        return records

    def test_fields_of_larger_records_are_used_where_they_are(self):
        records = self.records(101)
        result = prepared.intersect(records["ray"], out=records["hit"])
        self.assertTrue(np.shares_memory(result, records))
        np.testing.assert_allclose(records["hit"]["t"], expected_t(records["ray"]), rtol=1e-14)
        np.testing.assert_array_equal(records["ray"], parallel_rays(101))
        self.assertTrue(
            (
                (records["name"] == b"abc") & (records["count"] == -1) & (records["end"] == 0xEE)
            ).all()
        )

    def test_every_third_ray(self):
        rays = parallel_rays(301)
        hits = np.zeros(202, crt.HIT)
        prepared.intersect(rays[::3], out=hits[::2])
        np.testing.assert_allclose(hits[::2]["t"], expected_t(rays[::3]), rtol=1e-14)
        self.assertTrue((hits[1::2]["t"] == 0).all())

    def test_rays_as_eight_columns_of_numbers(self):
        rays = parallel_rays(301)
        table = np.zeros((301, 11))
        table[:, 2:10] = rays.view(np.float64).reshape(301, 8)
        np.testing.assert_array_equal(prepared.intersect(table[:, 2:10]), prepared.intersect(rays))
        np.testing.assert_array_equal(prepared.occluded(table[:, 2:10]), prepared.occluded(rays))

    def test_hits_have_the_shape_of_the_rays(self):
        rays = parallel_rays(300).reshape(3, 10, 10)
        hits = prepared.intersect(rays)
        self.assertEqual(hits.shape, (3, 10, 10))
        np.testing.assert_array_equal(hits.ravel(), prepared.intersect(rays.ravel()))
        np.testing.assert_array_equal(prepared.intersect(rays[:, :, 4]), hits[:, :, 4])
        self.assertEqual(prepared.intersect(rays[1, 2, 3:4]).shape, (1,))

    def test_no_rays(self):
        self.assertEqual(prepared.intersect(crt.rays(0)).shape, (0,))
        self.assertEqual(prepared.occluded(crt.rays((4, 0))).shape, (4, 0))
        self.assertEqual([a.shape for a in prepared.distances(crt.rays((4, 0)))], [(4, 0), (4, 0)])

    def test_another_dtype_is_refused_rather_than_copied(self):
        for wrong in (
            np.zeros((5, 8), np.float32),
            np.zeros((5, 8), ">f8"),
            np.zeros((5, 7)),
            np.zeros(5, crt.HIT),
        ):
            with self.assertRaises(TypeError):
                prepared.intersect(wrong)
        with self.assertRaises(TypeError):
            prepared.intersect(parallel_rays(5), out=np.zeros((5, 7)))

    def test_a_wrong_layout_is_named(self):
        table = np.zeros((5, 16))
        for wrong in (np.zeros((8, 5)).T, table[:, ::2], table[:, 7::-1]):
            with self.assertRaisesRegex(TypeError, "do not follow one another.*ascontiguousarray"):
                prepared.intersect(wrong)
        with self.assertRaisesRegex(TypeError, r"shape \(5, 7\), not crt.RAY or float64 with 8"):
            prepared.intersect(table[:, :7])

    def test_one_record_is_one_ray(self):
        rays = parallel_rays(5)
        for ask in (prepared.intersect, prepared.occluded):
            self.assertEqual(ask(rays[2]).shape, ())
            self.assertEqual(ask(rays[2]), ask(rays)[2])
        self.assertEqual(prepared.distances(rays[2])[0], prepared.distances(rays)[0][2])

    def test_what_no_stride_describes_is_refused(self):
        rays = parallel_rays(20)
        for wrong in (
            rays[::-1],
            np.broadcast_to(rays[:1], 20),
            rays.reshape(4, 5)[:, :3],
            rays.reshape(4, 5).T,
        ):
            with self.assertRaises(ValueError):
                prepared.intersect(wrong)

    def test_hits_that_do_not_fit_are_refused(self):
        rays = parallel_rays(5)
        read_only = np.zeros(5, crt.HIT)
        read_only.flags.writeable = False
        for wrong in (np.zeros(4, crt.HIT), np.zeros((5, 1), crt.HIT), read_only):
            with self.assertRaises(ValueError):
                prepared.intersect(rays, out=wrong)

    def test_a_wrong_ray_is_named(self):
        rays = parallel_rays(20)
        rays["direction"][13] = 0
        with self.assertRaisesRegex(crt.Error, r"rays\[13\]") as caught:
            prepared.intersect(rays)
        self.assertEqual(caught.exception.status, crt.Status.INVALID_ARGUMENT)


class Pieces(unittest.TestCase):
    """Many rays are asked piece by piece."""

    def setUp(self):
        piece = _queries.PIECE
        self.addCleanup(setattr, _queries, "PIECE", piece)
        _queries.PIECE = 7

    def test_answers_are_those_of_all_at_once(self):
        rays = parallel_rays(60)
        one_by_one = [prepared.intersect(ray) for ray in rays]
        hits = np.zeros((60, 2), crt.HIT)
        prepared.intersect(rays.reshape(6, 10), out=hits[:, 0].reshape(6, 10))
        np.testing.assert_array_equal(hits[:, 0], one_by_one)
        distances, ids = prepared.distances(rays)
        np.testing.assert_array_equal(distances, hits[:, 0]["t"])
        np.testing.assert_array_equal(ids, hits[:, 0]["entity_id"])
        np.testing.assert_array_equal(prepared.occluded(rays), np.isfinite(distances))

    def test_a_wrong_ray_is_named_by_its_place_among_all(self):
        rays = parallel_rays(20)
        rays["direction"][13] = 0
        for ask in (prepared.intersect, prepared.distances, prepared.occluded, prepared.crossings):
            with self.assertRaisesRegex(crt.Error, r"^rays\[13\]: "):
                ask(rays)

    def test_control_c_ends_them(self):
        asked = []

        def press(*arguments):
            asked.append(arguments)
            os.kill(os.getpid(), signal.SIGINT)

        library = mock.Mock(crt_intersect=press, crt_distances=press, crt_occluded=press)
        with mock.patch.object(_queries, "library", library):
            for ask in (prepared.intersect, prepared.distances, prepared.occluded):
                with self.assertRaises(KeyboardInterrupt):
                    ask(parallel_rays(60))
        self.assertEqual(len(asked), 3)


class Making(unittest.TestCase):
    def test_origins_and_directions_broadcast(self):
        rays = crt.rays((1, 2, 3), np.eye(3))
        self.assertEqual((rays.dtype, rays.shape), (crt.RAY, (3,)))
        np.testing.assert_array_equal(rays["origin"], [(1, 2, 3)] * 3)
        np.testing.assert_array_equal(rays["direction"], np.eye(3))
        self.assertEqual((rays["t_min"].max(), rays["t_max"].min()), (0, INFINITY))
        grid = crt.rays(origin=np.zeros((4, 1, 3)), direction=np.ones((5, 3)), t_max=np.arange(5))
        self.assertEqual(grid.shape, (4, 5))
        np.testing.assert_array_equal(grid["t_max"][2], np.arange(5))
        self.assertEqual(crt.rays((0, 0, 0), (0, 0, 1)).shape, ())
        self.assertEqual(crt.rays(shape=(2, 3)).shape, (2, 3))
        for wrong in (
            lambda: crt.rays((0, 0), (0, 0, 1)),
            lambda: crt.rays(np.zeros((4, 3)), np.zeros((5, 3))),
            lambda: crt.rays((0, 0, 0), "up"),
            lambda: crt.rays(origin=(0, 0, 0)),
            lambda: crt.rays(),
        ):
            with self.assertRaises((TypeError, ValueError)):
                wrong()


class Crossings(unittest.TestCase):
    def test_those_of_one_record_are_an_array(self):
        self.assertEqual(len(prepared.crossings(parallel_rays(3)[1])), 4)
        self.assertEqual(len(prepared.crossings(np.array([0.0, 0, -5, 0, 0, 1, 0, 9]))), 4)

    def test_those_of_many_rays_are_flat_with_offsets(self):
        rays = parallel_rays(61)
        crossings = prepared.crossings(rays)
        self.assertIsInstance(crossings, crt.Crossings)
        self.assertEqual((crossings.hits.dtype, crossings.offsets.dtype), (crt.HIT, np.int64))
        self.assertEqual((len(crossings.offsets), crossings.offsets[0]), (62, 0))
        self.assertEqual(crossings.offsets[-1], len(crossings.hits))
        self.assertEqual(set(crossings.counts), {0, 2, 4})
        for index, ray in enumerate(rays):
            alone = prepared.crossings(ray)
            np.testing.assert_array_equal(crossings.of(index), alone)
            first, end = crossings.offsets[index : index + 2]
            np.testing.assert_array_equal(crossings.hits[first:end], alone)
        np.testing.assert_array_equal(crossings.of(-31), crossings.of(30))
        for wrong in (61, -62):
            with self.assertRaises(IndexError):
                crossings.of(wrong)

    def test_there_may_be_many_of_a_ray(self):
        row = crt.union(crt.Sphere((0, 0, 3 * i), 1) for i in range(100))
        rays = parallel_rays(5)
        crossings = crt.Scene([row]).prepare().crossings(rays)
        self.assertEqual(list(crossings.counts), [0, 200, 200, 200, 0])
        np.testing.assert_allclose(
            crossings.of(2)["t"], np.ravel([(3 * i + 4, 3 * i + 6) for i in range(100)])
        )

    def test_rays_may_lie_apart_in_any_shape(self):
        rays = parallel_rays(60)
        expected = prepared.crossings(rays[::2])
        found = prepared.crossings(rays.reshape(6, 10)[:, ::2])
        np.testing.assert_array_equal(found.hits, expected.hits)
        np.testing.assert_array_equal(found.offsets, expected.offsets)

    def test_no_rays_have_none(self):
        hits, offsets = prepared.crossings(crt.rays(0))
        self.assertEqual((len(hits), list(offsets)), (0, [0]))

    def test_a_wrong_ray_is_named(self):
        rays = parallel_rays(20)
        rays["direction"][13] = 0
        with self.assertRaisesRegex(crt.Error, r"rays\[13\]") as caught:
            prepared.crossings(rays)
        self.assertEqual(caught.exception.status, crt.Status.INVALID_ARGUMENT)


class CameraRays(unittest.TestCase):
    def test_they_are_those_of_a_picture(self):
        size = 64
        cameras = [
            crt.Camera(position=(2, 1, -4), pointing=(0.2, 0.1, 0), roll=0.7, fov=0.8),
            crt.Camera(position=(0, 5, 0), pointing=(0, 0, 0), fov=0.5),
        ]
        part = shell() - crt.Box((0, 0.1, 0), (2, 2, -2)) - crt.Box((-2, -0.3, 0.2), (2, 0.4, 2))
        for camera in cameras:
            scene = crt.Scene([part], camera=camera, background=crt.Background(alpha=0))
            scene.settings = crt.Settings(width=size, height=size * 3 // 4)
            prepared = scene.prepare()
            seen = prepared.render().pixels[..., 3] > 0
            hit = prepared.occluded(crt.camera_rays(camera, size, size * 3 // 4))
            self.assertGreater(hit.sum(), 300)
            self.assertEqual((seen != hit).sum(), 0)

    def test_t_is_the_depth_along_the_view(self):
        camera = crt.Camera(position=(1, 2, 3), pointing=(1, 2, 9))
        wall = crt.Scene([crt.Plane((0, 0, -1), (0, 0, 8))]).prepare()
        np.testing.assert_allclose(
            wall.intersect(crt.camera_rays(camera, 7, 5))["t"], 5, rtol=1e-14
        )

    def test_other_projections_have_directions_of_unit_length(self):
        for projection in set(crt.Projection) - {crt.Projection.PINHOLE}:
            camera = crt.Camera(projection=projection, fov=1)
            rays = crt.camera_rays(camera, 5, 5)
            lengths = np.linalg.norm(rays["direction"], axis=-1)
            np.testing.assert_allclose(lengths, 1, rtol=1e-14)
            np.testing.assert_allclose(rays["direction"][2, 2], (0, 0, 1), atol=1e-14)

    def test_what_a_scene_refuses_is_refused_in_the_same_words(self):
        for fields in (
            {"fov": 4},
            {"fov": 0},
            {"roll": INFINITY},
            {"position": (1, 2, 3), "pointing": (1, 2, 3)},
            {"position": (math.nan, 0, 0)},
        ):
            camera = crt.Camera(**fields)
            with self.assertRaises(crt.Error) as of_scene:
                crt.Scene(camera=camera)
            with self.assertRaises(crt.Error) as caught:
                crt.camera_rays(camera, 4, 4)
            message = str(of_scene.exception).removeprefix("Scene: ")
            self.assertEqual(str(caught.exception), f"camera_rays: {message}")
        for width, height in ((0, 4), (4, -1)):
            with self.assertRaisesRegex(crt.Error, "camera_rays: (width|height) must be between"):
                crt.camera_rays(crt.Camera(), width, height)

    def test_the_middle_ray_looks_straight_ahead(self):
        scene = small_scene()
        rays = crt.camera_rays(scene.camera, 5, 5)
        np.testing.assert_allclose(rays[2, 2]["direction"], (0, 0, 1), atol=1e-15)
        self.assertTrue(math.isinf(rays[0, 0]["t_max"]))


class Parts(unittest.TestCase):
    def test_a_cut_has_the_id_of_what_cut_it(self):
        whole = crt.Box((-1, -1, -1), (1, 1, 1), id=5) - crt.Sphere((0, 0, -1), 0.5, id=6)
        starts = [[(0, 0, -9), (0.9, 0, -9)], [(0, 9, 0), (9, 9, 9)]]
        rays = crt.rays(starts, [[(0, 0, 1)], [(0, -1, 0)]])
        parts = crt.Scene([whole.with_id(7)]).prepare().hit_parts(rays)
        self.assertEqual(parts.shape, (2, 2))
        none = crt.NO_ENTITY
        np.testing.assert_array_equal(parts["entity_id"], [[7, 7], [7, none]])
        np.testing.assert_array_equal(parts["part_id"], [[6, 5], [5, none]])
        np.testing.assert_array_equal(parts["face"], [[0, 4], [3, none]])

    def test_more_rays_than_a_piece_agree_with_intersect(self):
        rays = parallel_rays(_queries.PIECE + 99)
        parts, hits = prepared.hit_parts(rays), prepared.intersect(rays)
        for field in ("entity_id", "u", "v"):
            np.testing.assert_array_equal(parts[field], hits[field])


class Bounds(unittest.TestCase):
    def test_they_hold_the_entity(self):
        low, high = (crt.Sphere((1, 2, 3), 2) + crt.Box((0, 0, 0), (9, 1, 1))).bounds
        np.testing.assert_allclose(low, (-1, 0, 0), atol=1e-13)
        np.testing.assert_allclose(high, (9, 4, 5), rtol=1e-13)

    def test_they_are_infinite_or_inverted_where_the_entity_is(self):
        low, high = crt.Plane((0, 1, 0)).bounds
        self.assertTrue(np.isinf(low).all())
        self.assertTrue(math.isinf(high[0]))
        low, high = crt.Empty().bounds
        self.assertTrue((low > high).all())
