"""The third program of the tutorial for Python: it renders in the background with a line of
progress, and writes the picture with channels beside its colours. Ctrl-C stops it."""

import sys
import time

import numpy as np

import crt
from tutorial_scene import bracket_scene


def render(scene: crt.Scene, stop_at: float = 2) -> crt.Image:
    """Renders in the background. Stops when so much is done, and then raises crt.Error."""
    job = scene.prepare().start(aovs=["depth", "normal"])
    while not job.is_finished:
        print(f"\rrendering: {job.progress:4.0%}", end="", file=sys.stderr)
        if job.progress >= stop_at:
            job.cancel()
        time.sleep(0.05)
    return job.wait()


def normal_picture(image: crt.Image) -> crt.Image:
    """Makes a picture of where surfaces face: x as red, y as green, towards the viewer as blue."""
    pixels = np.ones((image.height, image.width, 4), np.float32)
    for color, (axis, sign) in enumerate((("N.X", 1), ("N.Y", 1), ("N.Z", -1))):
        pixels[:, :, color] = 0.5 + 0.5 * sign * image.channels[axis]
    return crt.Image.from_pixels(pixels).with_settings(crt.Settings(gamma=1))


if __name__ == "__main__":
    image = render(bracket_scene())
    image.save("bracket.exr")
    normal_picture(image).save("normals.png")
