"""The view shows a picture without its noise, marks it so, and leaves files as the script says."""

import os
import struct
import subprocess
import unittest

from client import ALL, ViewedFolder

COMMAND = os.environ["CRT_COMMAND"]
WIDTH, HEIGHT = 96, 64
SCENE = """Settings {
    width -> 96 height -> 64 targeterror -> 0.03 maxsamples -> 32
    lights -> [PointLight { origin -> vec3(2, 3, -2) color -> rgb(1, 1, 1) radius -> 1 }]
    camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
}
Scene {
    Sphere { center -> vec3(-1, 0, 0) radius -> 0.7 }
    Box { cornerA -> vec3(0.5, -0.5, -0.5) cornerB -> vec3(1.5, 0.5, 0.5) }
    Plane { normal -> vec3(0, 1, 0) position -> vec3(0, -0.7, 0) }
}
"""


class Denoise(ViewedFolder):
    SCENE, WIDTH, HEIGHT = SCENE, WIDTH, HEIGHT

    def test_noise_is_smoothed_away_in_the_view_alone_which_marks_it(self):
        self.assertEqual(self.marks, {0})
        script = self.folder / "noisy.crt"
        script.write_text(SCENE)
        before = self.client.picture("exr")
        smooth = self.show(denoise=True)
        self.assertEqual(self.marks, {0x200})
        self.client.wait("state", lambda state: state["phase"] == "done")
        for pixels, options in ((self.picture, []), (smooth, ["--denoise"])):
            file = self.folder / "noisy.ppm"
            command = [COMMAND, "render", "--quiet", script, "-o", file, *options]
            subprocess.run(command, check=True)
            shown = bytes(byte for i, byte in enumerate(pixels) if i % 4 < 3)
            self.assertEqual(shown, file.read_bytes()[-3 * WIDTH * HEIGHT :])
        self.assertNotEqual(self.picture, smooth)
        self.assertEqual(self.client.picture("exr"), before)
        # Both are known now, so that nothing is rendered for either.
        for is_smooth in (False, True):
            self.client.send(type="view", view={**ALL, "denoise": is_smooth})
            message = self.client.receive()
            numbers = struct.unpack("<10I", message[:40])
            self.assertEqual(numbers[1], 0x102 + 0x200 * is_smooth)
            begin = 4 * WIDTH * numbers[8]
            wanted = smooth if is_smooth else self.picture
            self.assertEqual(message[40:], wanted[begin : begin + len(message) - 40])
        # What is measured of a picture is not smoothed.
        self.show(denoise=True, channel="error")
        self.assertEqual(self.marks, {0})

    def test_a_smoothed_region_is_marked_and_other_changes_begin_with_a_marked_draft(self):
        region = {"x": 20, "y": 10, "width": 40, "height": 30}
        self.show(denoise=True, region=region)
        self.assertEqual(self.marks, {0x200})
        self.client.send(type="render", action="restart")
        _, kinds = self.whole()
        self.assertIn(0, kinds)
        self.assertEqual(self.marks, {0x200})

    def test_no_error_is_claimed_of_a_script_that_has_noise_smoothed_away(self):
        for text, is_smooth in (
            (SCENE, False),
            (SCENE.replace("Settings {", "Settings { denoise -> true"), True),
        ):
            self.client.set_text(text)
            self.whole()
            self.assertEqual(self.marks, {0x200 * is_smooth})
            self.assertEqual("error of 95 of 100 pixels" in self.stats, not is_smooth)
            self.assertEqual("error of pixels (root mean square)" in self.stats, not is_smooth)
            self.assertGreater(self.stats["passes"], 0)


if __name__ == "__main__":
    unittest.main()
