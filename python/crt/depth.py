"""This program makes depth maps by ray queries: python -m crt.depth SCENE.crt -o depth.png

Each pixel of a script's picture gets how far along the view the nearest surface is. An .exr or .hdr
file holds the depth itself, in scene units; others a grey, from white for the nearest to dark for
the farthest. Where nothing is, the picture is transparent.
"""

import argparse
import pathlib
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

import crt


def depth_map(scene: crt.Scene) -> NDArray[Any]:
    """Returns height x width depths of the scene as its camera sees it, infinite where nothing
    is."""
    settings = scene.settings
    rays = crt.camera_rays(scene.camera, settings.width, settings.height)
    return scene.prepare().intersect(rays)["t"]


def to_grey(depths: NDArray[Any], nearest: float, farthest: float) -> NDArray[Any]:
    """Returns 8-bit RGBA: 1 / depth between those of the nearest and the farthest."""
    darkest = 0.08
    span = 1 / nearest - 1 / farthest
    closeness = (
        (1 / np.maximum(depths, nearest) - 1 / farthest) / span
        if span > 0
        else np.ones_like(depths)
    )
    pixels = np.empty((*depths.shape, 4), np.uint8)
    greys = np.round(255 * (darkest + (1 - darkest) * np.clip(closeness, 0, 1)))
    pixels[..., :3] = greys[..., None]
    pixels[..., 3] = np.where(np.isfinite(depths), 255, 0)
    return pixels


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="crt.depth", description="Renders how far away things are."
    )
    parser.add_argument("scene", type=pathlib.Path, help="a script")
    parser.add_argument(
        "-o", "--output", default="depth.png", help="the picture (default: depth.png)"
    )
    parser.add_argument("--width", type=int, help="pixels, in place of the script's")
    parser.add_argument("--height", type=int)
    parser.add_argument("--near", type=float, help="what is white (default: the nearest point)")
    parser.add_argument("--far", type=float, help="what is dark (default: the farthest point)")
    arguments = parser.parse_args()

    settings = {
        name: value
        for name in ("width", "height")
        if (value := getattr(arguments, name)) is not None
    }
    try:
        depths = depth_map(crt.Scene.from_file(arguments.scene, settings=settings, print=print))
        if arguments.output.lower().endswith((".exr", ".hdr")):
            image = crt.Image.from_pixels(_floats(depths))
        else:
            seen = depths[np.isfinite(depths)]
            nearest = arguments.near or (seen.min() if seen.size else 1)
            farthest = arguments.far or (seen.max() if seen.size else 1)
            image = crt.Image.from_rgba8(to_grey(depths, nearest, farthest))
        image.save(arguments.output)
    except (crt.Error, ValueError) as error:
        print(error, file=sys.stderr)
        return 1
    return 0


def _floats(depths: NDArray[Any]) -> NDArray[Any]:
    is_seen = np.isfinite(depths)
    pixels = np.zeros((*depths.shape, 4), np.float32)
    pixels[is_seen, :3] = depths[is_seen][:, None]
    pixels[is_seen, 3] = 1
    return pixels


if __name__ == "__main__":
    sys.exit(main())
