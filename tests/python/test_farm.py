"""Jobs are planned, worked on and merged from Python."""

import pathlib
import pickle
import tempfile
import threading
import unittest

import crt

SCRIPT = """size = 1
Settings { width -> 31 height -> 23
           lights -> [PointLight { origin -> vec3(3, 5, -9) color -> rgb(1, 1, 1) }] }
Scene { Sphere { center -> vec3(t / 4, 0, 2) radius -> size } }
"""


class Farm(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.script = self.folder / "scene.crt"
        self.script.write_text(SCRIPT)
        self.job = self.folder / "job"

    def plan(self, **options):
        return crt.farm.plan(self.script, self.job, variables={"size": 0.7}, **options)

    def test_a_merged_film_has_the_bytes_of_its_frames(self):
        plan = self.plan(frames=(-1, 2), tasks=5, tile=(9, 11), settings={"supersampling": 2})
        self.assertEqual((plan.tasks, plan.frames, plan.width, plan.height), (5, (-1, 2), 31, 23))
        self.assertEqual(plan, crt.farm.read_plan(self.job))
        self.assertEqual(plan, pickle.loads(pickle.dumps(plan)))
        self.assertGreater(plan.seconds, plan.longest_seconds)
        threads = [
            threading.Thread(target=crt.farm.work, args=(self.job, task)) for task in range(5)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        merged = crt.farm.merge(self.job, output=self.folder / "film_##.png", skip=[0, 1])
        self.assertTrue(merged.is_complete)
        self.assertEqual(sorted(merged.frames), [-1, 2])
        for frame, name in ((-1, "film_-1.png"), (2, "film_02.png")):
            scene = crt.Scene.from_file(
                self.script, t=frame, variables={"size": 0.7}, settings={"supersampling": 2}
            )
            expected = scene.render().encode("png", reproducible=True)
            self.assertEqual((self.folder / name).read_bytes(), expected)
        self.assertFalse((self.folder / "film_00.png").exists())

    def test_channels_and_seeds_go_into_the_tasks(self):
        plan = self.plan(tasks=2, aovs=["depth"], seed=5, passes=3)
        self.assertEqual((plan.frames, plan.has_channels, plan.passes), (None, True, 3))
        for task in range(2):
            self.assertTrue(crt.farm.work(self.job, task, threads=1))
        self.assertEqual(crt.farm.merge(self.job).frames, [0])
        scene = crt.Scene.from_file(self.script, variables={"size": 0.7})
        image = scene.render(seed=5, passes=3, aovs=["depth"])
        expected = image.encode("exr", reproducible=True)
        self.assertEqual((self.job / "scene.exr").read_bytes(), expected)

    def test_what_is_missing_or_damaged_is_reported(self):
        self.plan(tasks=3, settings={"supersampling": 8})
        self.assertTrue(crt.farm.work(self.job, 0))
        self.assertFalse(crt.farm.work(self.job, 0))
        self.assertTrue(crt.farm.work(self.job, 1))
        status = crt.farm.status(self.job)
        states = [task.state for task in status.tasks]
        done, waiting = crt.farm.TaskState.DONE, crt.farm.TaskState.WAITING
        self.assertEqual(states, [done, done, waiting])
        self.assertTrue(0 < status.share < 1)
        self.assertGreater(status.seconds_spent, 0)
        self.assertGreater(status.seconds_left, 0)
        self.assertRegex(status.tasks[0].worker, r".+:\d+$")
        part = self.job / "parts/000001.part"
        part.write_bytes(part.read_bytes()[:9])
        merged = crt.farm.merge(self.job)
        self.assertFalse(merged.is_complete)
        self.assertEqual((merged.frames, merged.missing), ([], [2]))
        self.assertEqual([refused.task for refused in merged.refused], [1])
        self.assertIn("000001.part", merged.refused[0].why)
        sheet = crt.farm.sheet(self.job, cell=20)
        self.assertEqual(sheet.width, 20)
        self.assertGreater(sheet.pixels[:, :, 3].max(), 0)

    def test_progress_cancels_and_what_it_raises_comes_out(self):
        with self.assertRaises(crt.Error) as caught:
            self.plan(progress=lambda share: False)
        self.assertEqual(caught.exception.status, crt.Status.CANCELLED)
        self.job = self.folder / "another"
        self.plan(tasks=1)
        shares = []
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            crt.farm.work(self.job, 0, progress=lambda share: 1 / 0)
        self.assertTrue(crt.farm.work(self.job, 0, progress=shares.append))
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1)

    def test_wrong_arguments_are_refused_by_name(self):
        for options, text in (
            ({"frames": 3}, "plan: frames"),
            ({"tile": (3,)}, "plan: tile"),
            ({"tasks": "many"}, "plan: tasks"),
            ({"progress": 3}, "progress"),
            ({"max_stops": 3}, "max_stops"),
        ):
            with self.assertRaisesRegex(TypeError, text):
                self.plan(**options)
        with self.assertRaisesRegex(TypeError, "work: task"):
            crt.farm.work(self.job, 0.5)
        with self.assertRaisesRegex(TypeError, "merge: skip"):
            crt.farm.merge(self.job, skip=["one"])
        with self.assertRaisesRegex(TypeError, "status: job"):
            crt.farm.status(3)
        with self.assertRaises(crt.Error) as caught:
            crt.farm.status(self.folder)
        self.assertEqual(caught.exception.status, crt.Status.IO)
        self.script.write_text("Scene { Spere { } }")
        with self.assertRaisesRegex(crt.Error, "1:9") as caught:
            crt.farm.plan(self.script, self.job)
        self.assertEqual(caught.exception.status, crt.Status.SCRIPT)
