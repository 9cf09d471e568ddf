"""Small pictures for notebooks, of scenes and of entities alone."""

import math

import numpy as np
from numpy.typing import NDArray

from .entities import Entity
from .images import Image
from .rays import camera_rays
from .rendering import Prepared
from .scenes import Scene
from .values import Background, Camera, Light, Material, Settings

MOST_PIXELS = 400  # of the longer side
MOST_SAMPLES = 4  # of a pixel, through the lens too
VIEW = np.array([0.45, 0.4, -0.8]) / np.linalg.norm([0.45, 0.4, -0.8])  # towards the camera
FOV = math.radians(30)


def picture_of_scene(scene: Scene) -> Image:
    """Renders a scene as it is, but small, and with few samples a pixel."""
    small = scene.copy()
    settings = small.settings
    factor = min(1, MOST_PIXELS / max(settings.width, settings.height))
    settings.set(
        width=max(1, round(settings.width * factor)),
        height=max(1, round(settings.height * factor)),
        supersampling=min(settings.supersampling, 2),
        dof_samples=min(settings.dof_samples, MOST_SAMPLES),
        target_error=0,
        time_budget=0,
    )
    return small.render()


def picture_of_entity(entity: Entity) -> Image | None:
    """Renders an entity in its own colours, or grey. Nothing surrounds it, the camera frames it,
    and a light comes from above the camera. It is None if there is nothing to see."""
    alone = Scene([entity.with_material(Material(color=(0.6, 0.62, 0.65), specular=0.2))])
    prepared = alone.prepare()
    sphere = _sphere_around(*entity.bounds)
    if sphere is None:
        return None
    center, radius = sphere
    position = center + radius / math.sin(FOV / 2) * VIEW
    alone.camera = _closer(prepared, Camera(position=position, pointing=center, fov=FOV))
    sun = center + radius * np.array([-2, 4, -3])
    alone.add(Light.parallel(origin=sun, pointing=center, color=(0.9, 0.9, 0.9), ambient=0.15))
    alone.add(Light.parallel(origin=position, pointing=center, color=(0.3, 0.3, 0.3)))
    alone.background = Background(color=(1, 1, 1), alpha=0)
    alone.settings = Settings(width=320, height=320, supersampling=2)
    return alone.render()


def _closer(prepared: Prepared, camera: Camera) -> Camera:
    """Returns a camera at the same place, whose picture is filled by what the other one sees."""
    side = 128
    sight = camera_rays(camera, side, side)
    rows, columns = np.nonzero(prepared.occluded(sight))
    if not rows.size:
        return camera
    top, bottom, left, right = rows.min(), rows.max(), columns.min(), columns.max()
    corners = sight["direction"][[top, top, bottom, bottom], [left, right, left, right]]
    middle = corners.mean(axis=0)
    half = 1.1 * (max(bottom - top, right - left) + 2) / side * math.tan(FOV / 2)
    fov = min(FOV, 2 * math.atan(half))
    return Camera(position=camera.position, pointing=camera.position + middle, fov=fov)


def _sphere_around(
    low: NDArray[np.float64], high: NDArray[np.float64]
) -> tuple[NDArray[np.float64], float] | None:
    """Returns centre and radius of the ball that a camera has to see, or None for an empty box.
    What has no end is seen about the origin."""
    if (low > high).any():
        return None
    sizes = (high - low)[np.isfinite(low) & np.isfinite(high)]
    largest = float(sizes.max()) if sizes.size else 0.0
    reach = max(largest, 1.0)
    low = np.where(np.isfinite(low), low, np.where(np.isfinite(high), high - reach, -reach / 2))
    high = np.where(np.isfinite(high), high, low + reach)
    radius = float(np.linalg.norm(high - low)) / 2
    return (low + high) / 2, radius or 1.0
