"""These tests check pictures, callbacks, jobs and images."""

import gc
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import weakref

import numpy as np
from support import small_scene

import crt


class Interrupt(Exception):
    pass


class Rendering(unittest.TestCase):
    def test_a_picture_has_the_size_and_content_of_the_scene(self):
        image = small_scene(48).render()
        self.assertEqual((image.width, image.height, image.pixels.shape), (48, 48, (48, 48, 4)))
        self.assertEqual(tuple(image.pixels[0, 0]), (1, 1, 1, 1))
        self.assertLess(image.pixels[24, 24, 0], 1)
        self.assertEqual(image.stats.camera_rays, 48 * 48)
        self.assertEqual(image.settings.width, 48)

    def test_the_number_of_threads_changes_nothing(self):
        prepared = small_scene(64, 2).prepare()
        np.testing.assert_array_equal(
            prepared.render(threads=1).pixels, prepared.render(threads=3).pixels
        )

    def test_a_picture_goes_on_from_its_checkpoint(self):
        prepared = small_scene(48).prepare()
        expected = prepared.render(passes=72).pixels
        with tempfile.TemporaryDirectory() as folder:
            checkpoint = pathlib.Path(folder) / "state"
            prepared.render(passes=20, checkpoint=checkpoint)
            resumed = prepared.render(passes=72, checkpoint=checkpoint).pixels
            with self.assertRaisesRegex(crt.Error, "72 passes"):
                prepared.render(passes=20, checkpoint=checkpoint)
        np.testing.assert_array_equal(resumed, expected)

    def test_a_region_has_the_pixels_of_the_whole(self):
        prepared = small_scene(48).prepare()
        part = prepared.render(region=(10, 20, 30, 8))
        self.assertEqual((part.width, part.height), (30, 8))
        np.testing.assert_array_equal(part.pixels, prepared.render().pixels[20:28, 10:40])

    def test_wrong_options_are_errors(self):
        with self.assertRaises(crt.Error):
            small_scene().prepare().render(threads=-1)
        with self.assertRaises(crt.Error):
            small_scene().prepare().render(region=(40, 0, 20, 10))

    def test_channels_beside_the_colours_are_told_if_asked_for(self):
        prepared = small_scene(48).prepare()
        image = prepared.render(aovs=["depth", "id", "normal"])
        self.assertEqual(set(image.channels), {"Z", "id", "N.X", "N.Y", "N.Z"})
        depth, numbers = image.channels["Z"], image.channels["id"]
        self.assertEqual((depth.shape, depth.dtype), ((48, 48), np.float32))
        self.assertEqual((numbers.shape, numbers.dtype), ((48, 48), np.uint32))
        self.assertFalse(depth.flags.writeable)
        self.assertTrue(np.isinf(depth[0, 0]))
        self.assertEqual(numbers[0, 0], 0xFFFFFFFF)
        self.assertTrue(np.isfinite(depth[24, 24]))
        del image
        gc.collect()
        self.assertTrue(np.isfinite(depth[24, 24]))  # the array keeps the image
        np.testing.assert_array_equal(prepared.start(aovs=("depth",)).wait().channels["Z"], depth)
        self.assertEqual(prepared.render().channels, {})
        with self.assertRaisesRegex(ValueError, "depht"):
            prepared.render(aovs=["depht"])

    def test_channels_go_into_exr_files_alone(self):
        image = small_scene(16).render(aovs=["albedo"])
        self.assertGreater(len(image.encode("exr")), len(image.encode("exr", colors_only=True)))
        with self.assertRaises(crt.Error) as caught:
            image.encode("png")
        self.assertEqual(caught.exception.status, crt.Status.UNSUPPORTED)
        self.assertEqual(image.encode("png", colors_only=True)[1:4], b"PNG")
        self.assertEqual(image._repr_png_()[1:4], b"PNG")

    def test_values_of_a_file_that_are_not_finite_are_told(self):
        values = np.array([1, 1, 1, 0, np.nan, np.inf], dtype="<f4")
        image = crt.Image.decode(b"PF\n2 1\n-1.0\n" + values.tobytes(), "a.pfm")
        self.assertEqual(image.not_finite, (1, 1, 0))
        self.assertEqual(image.pixels[0, 1].tolist(), [0, 0, 0, 1])
        self.assertEqual(small_scene(8).render().not_finite, (0, 0, 0))


class Callbacks(unittest.TestCase):
    def test_progress_goes_from_0_to_1(self):
        shares = []
        small_scene(100).render(progress=shares.append)
        self.assertEqual((shares[0], shares[-1]), (0, 1))
        self.assertEqual(shares, sorted(shares))

    def test_what_progress_raises_cancels_and_comes_out(self):
        calls = []

        def fail(fraction):
            calls.append(fraction)
            raise Interrupt("enough")

        with self.assertRaisesRegex(Interrupt, "enough"):
            small_scene(200).render(progress=fail)
        self.assertEqual(calls, [0])

    def test_progress_that_returns_false_cancels(self):
        calls = []

        def stop(fraction):
            calls.append(fraction)
            return False

        for answer in (stop, lambda fraction: np.False_):
            with self.assertRaises(crt.Error) as caught:
                small_scene(200).render(progress=answer)
            self.assertEqual(caught.exception.status, crt.Status.CANCELLED)
        self.assertEqual(calls, [0])
        job = small_scene(200).prepare().start(progress=stop)
        with self.assertRaises(crt.Error) as caught:
            job.wait()
        self.assertEqual(caught.exception.status, crt.Status.CANCELLED)

    def test_progress_may_return_anything_else(self):
        for answer in (None, True, 0, 1, "", []):
            self.assertEqual(small_scene(20).render(progress=lambda _: answer).width, 20)

    def test_the_log_gets_lines(self):
        lines = []
        small_scene(48).render(log=lines.append)
        self.assertIn("rendered 2304 pixels", lines[0])

    def test_what_the_log_raises_comes_out(self):
        def fail(line):
            raise Interrupt(line)

        with self.assertRaisesRegex(Interrupt, "rendered"):
            small_scene(48).render(log=fail)

    def test_control_c_cancels(self):
        def press(fraction):
            if fraction > 0.2:
                os.kill(os.getpid(), signal.SIGINT)

        before = signal.getsignal(signal.SIGINT)
        with self.assertRaises(KeyboardInterrupt):
            small_scene(300).render(threads=1, progress=press)
        self.assertIs(signal.getsignal(signal.SIGINT), before)

    def test_what_a_callback_refers_to_is_let_go(self):
        class Watcher:
            def tell(self, fraction):
                pass

        watcher = Watcher()
        reference = weakref.ref(watcher)
        small_scene().render(progress=watcher.tell)
        del watcher
        gc.collect()
        self.assertIsNone(reference())

    def test_what_callbacks_raise_keeps_nothing_that_the_caller_has(self):
        def fail(*_):
            raise Interrupt

        def press(*_):
            os.kill(os.getpid(), signal.SIGINT)

        prepared = small_scene().prepare()
        gc.disable()
        self.addCleanup(gc.enable)
        for callbacks in ({"progress": fail}, {"log": fail}, {"progress": press}):
            reference = held_by_caller(lambda: prepared.render(**callbacks))
            self.assertIsNone(reference(), callbacks)
        reference = held_by_caller(lambda: prepared.start(progress=fail).wait())
        gc.collect()  # a job keeps what was raised for who waits again
        self.assertIsNone(reference())

    def test_the_end_of_an_iterator_comes_out_as_such(self):
        with self.assertRaises(StopIteration):
            small_scene().render(progress=lambda _, none=iter(()): next(none))


def held_by_caller(call):
    """Has a caller with something large among its locals catch what a call raises."""

    class Large:
        pass

    large = Large()
    try:
        call()
    except (Interrupt, KeyboardInterrupt):
        return weakref.ref(large)
    raise AssertionError("nothing was raised")


class Jobs(unittest.TestCase):
    def test_a_job_gives_the_picture_that_a_render_gives(self):
        prepared = small_scene(100).prepare()
        with prepared.start() as job:
            image = job.wait()
            self.assertTrue(job.is_finished)
            self.assertEqual(job.progress, 1)
        np.testing.assert_array_equal(image.pixels, prepared.render().pixels)

    def test_a_snapshot_of_a_job_that_was_cancelled_at_its_start_is_not_the_whole(self):
        def cancel(fraction):
            raise Interrupt

        job = small_scene(200).prepare().start(progress=cancel)
        with self.assertRaises(Interrupt):
            job.wait()
        with self.assertRaises(Interrupt):
            job.wait()
        self.assertTrue(job.is_finished)
        self.assertEqual(job.snapshot().pixels[..., 3].min(), 0)

    def test_cancelling_is_an_error_of_waiting(self):
        job = small_scene(2000, 8).prepare().start(threads=1)
        job.cancel()
        with self.assertRaises(crt.Error) as caught:
            job.wait()
        self.assertEqual(caught.exception.status, crt.Status.CANCELLED)

    def test_control_c_cancels_what_is_waited_for(self):
        def press(fraction):
            if fraction > 0.05:
                os.kill(os.getpid(), signal.SIGINT)

        job = small_scene(2000, 8).prepare().start(progress=press)
        with self.assertRaises(KeyboardInterrupt):
            job.wait()
        self.assertTrue(job.is_finished)

    def test_a_job_that_is_dropped_ends(self):
        class Watcher:
            def tell(self, fraction):
                assert fraction < 1

        watcher = Watcher()
        reference = weakref.ref(watcher)
        job = small_scene(2000, 8).prepare().start(progress=watcher.tell)
        del watcher
        self.assertIsNotNone(reference())
        del job
        gc.collect()
        self.assertIsNone(reference())

    def test_a_job_may_be_closed_by_its_own_callback(self):
        jobs = []
        closed = threading.Event()

        def close(fraction):
            if jobs:
                jobs.pop().close()
                closed.set()

        jobs.append(small_scene(2000, 8).prepare().start(progress=close))
        self.assertTrue(closed.wait(60))

    def test_a_callback_that_refers_to_its_job_does_not_keep_it(self):
        class Window:
            def __init__(self):
                self.job = small_scene(2000, 8).prepare().start(progress=self.tell)

            def tell(self, fraction):
                pass

        reference = weakref.ref(Window())
        gc.collect()
        self.assertIsNone(reference())

    def test_python_may_end_while_a_job_runs(self):
        program = (
            "from support import small_scene\n"
            "job = small_scene(2000, 8).prepare().start(progress=lambda fraction: None)\n"
            "image = job.snapshot()\n"
        )
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Images(unittest.TestCase):
    def test_pixels_are_the_librarys_memory_and_outlive_the_image(self):
        image = crt.Image.from_pixels(np.arange(24, dtype=np.float32).reshape(2, 3, 4))
        pixels = image.pixels
        self.assertEqual(
            pixels.__array_interface__["data"][0], image.pixels.__array_interface__["data"][0]
        )
        self.assertFalse(pixels.flags.owndata)
        with self.assertRaises(ValueError):
            pixels[0, 0, 0] = 1
        row = pixels[1]
        image.close()
        del image, pixels
        gc.collect()
        np.testing.assert_array_equal(row, np.arange(12, 24).reshape(3, 4))

    def test_rows_that_lie_apart_are_taken_as_they_are(self):
        whole = np.random.default_rng(2).random((8, 8, 4), np.float32)
        np.testing.assert_array_equal(crt.Image.from_pixels(whole[::2, :5]).pixels, whole[::2, :5])
        np.testing.assert_array_equal(
            crt.Image.from_pixels(whole[3:4, 2:5]).pixels, whole[3:4, 2:5]
        )

    def test_what_is_no_picture_is_refused(self):
        whole = np.zeros((4, 4, 4), np.float32)
        for wrong in (
            whole.astype(np.float64),
            whole[..., :3],
            whole[0],
            whole[::-1],
            whole[:, ::2],
            whole.transpose(1, 0, 2),
        ):
            with self.assertRaises(TypeError):
                crt.Image.from_pixels(wrong)
        with self.assertRaises(TypeError):
            crt.Image.from_rgba8(whole)

    def test_eight_bits_there_and_back(self):
        pixels = np.random.default_rng(3).integers(0, 256, (5, 7, 4), np.uint8)
        pixels[..., 3] = 255
        np.testing.assert_array_equal(crt.Image.from_rgba8(pixels).to_rgba8(), pixels)

    def test_a_file_has_the_picture_in_it(self):
        image = small_scene().render()
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "Bild mit Größe.png"
            image.save(path, reproducible=True)
            self.assertEqual(path.read_bytes(), image.encode("png", reproducible=True))
            np.testing.assert_array_equal(crt.Image.read(path).to_rgba8(), image.to_rgba8())
            with self.assertRaisesRegex(crt.Error, "xyz"):
                image.save(path.with_suffix(".xyz"))

    def test_a_notebook_gets_a_png(self):
        image = small_scene().render()
        content = image._repr_png_()
        self.assertEqual(content[:8], b"\x89PNG\r\n\x1a\n")
        np.testing.assert_array_equal(crt.Image.decode(content).to_rgba8(), image.to_rgba8())

    def test_other_settings_change_how_it_is_written(self):
        image = small_scene().render()
        brighter = image.with_settings(crt.Settings(gamma=3))
        np.testing.assert_array_equal(brighter.pixels, image.pixels)
        self.assertGreater(brighter.to_rgba8().mean(), image.to_rgba8().mean())

    def test_exposure_and_tone_map_change_what_is_shown_and_no_light(self):
        pixels = np.zeros((1, 256, 4), np.float32)
        pixels[..., :3] = np.linspace(0, 12, 256, dtype=np.float32)[None, :, None]
        pixels[..., 3] = 1
        image = crt.Image.from_pixels(pixels)
        shown = image.with_settings(crt.Settings(exposure=-2, tone_map="filmic"))
        np.testing.assert_array_equal(shown.pixels, image.pixels)
        x = 0.7231708051011695 * pixels[0, :, 0].astype(np.float64) / 4
        curve = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)
        expected = np.floor(255 * np.clip(curve, 0, 1) ** (1 / 2.2) + 0.5)
        np.testing.assert_array_equal(shown.to_rgba8()[0, :, 1], expected)
        self.assertEqual(crt.Settings().tone_map, crt.ToneMap.NONE)
        with self.assertRaisesRegex(crt.Error, "exposure"):
            image.with_settings(crt.Settings(exposure=101))
