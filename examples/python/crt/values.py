"""This module has materials, lights, cameras, backgrounds and settings.

The fields, their units, ranges and defaults are those of the structs of the same name in crt.h:
vectors are three numbers, colours linear RGB, angles radians. Each class takes fields as keyword
arguments, and they may be changed later; whoever takes a value copies it.
"""

import enum
from typing import Any

from ._structs import (
    Double,
    ImagePointer,
    Int,
    Long,
    PatternPointer,
    Pointer,
    Struct,
    Text,
    Vector,
    growable,
)


class PatternType(enum.IntEnum):
    CHECKER = 0
    STRIPES = 1
    GRADIENT = 2
    NOISE = 3
    MARBLE = 4
    WOOD = 5
    IMAGE = 6


@growable("crt_pattern")
class Pattern(Struct):
    """A Pattern is colours that vary over a surface or through space: Pattern.wood(scale=0.1)."""

    type: Int
    color_a: Vector
    alpha_a: Double
    color_b: Vector
    alpha_b: Double
    direction: Vector
    offset: Vector
    scale: Double
    turbulence: Double
    octaves: Int
    reserved: Int
    image: ImagePointer
    repeat_u: Double
    repeat_v: Double
    pattern_a: PatternPointer
    pattern_b: PatternPointer
    colors: Pointer
    color_count: Long
    mapping: Int
    reserved_2: Int

    @classmethod
    def checker(cls, **fields: Any) -> "Pattern":
        """Makes cubes whose edges are `scale` long."""
        return cls.of_type(PatternType.CHECKER, **fields)

    @classmethod
    def stripes(cls, **fields: Any) -> "Pattern":
        """Makes bands across `direction`, one of each colour in `scale`."""
        return cls.of_type(PatternType.STRIPES, **fields)

    @classmethod
    def gradient(cls, **fields: Any) -> "Pattern":
        """Changes from `color_a` to `color_b` and back along `direction` within `scale`."""
        return cls.of_type(PatternType.GRADIENT, **fields)

    @classmethod
    def noise(cls, **fields: Any) -> "Pattern":
        """Makes clouds."""
        return cls.of_type(PatternType.NOISE, **fields)

    @classmethod
    def marble(cls, **fields: Any) -> "Pattern":
        """Makes veins across `direction`."""
        return cls.of_type(PatternType.MARBLE, **fields)

    @classmethod
    def wood(cls, **fields: Any) -> "Pattern":
        """Makes rings about the line through `offset` along `direction`."""
        return cls.of_type(PatternType.WOOD, **fields)

    @classmethod
    def of_image(cls, image: Any, **fields: Any) -> "Pattern":
        """Lays a crt.Image over the surface."""
        return cls.of_type(PatternType.IMAGE, image=image, **fields)


@growable("crt_material")
class Material(Struct):
    """A Material says what a surface is made of. A `pattern` replaces the colour."""

    reserved: Int
    color: Vector
    alpha: Double
    pattern: PatternPointer
    reflectivity: Double
    transparency: Double
    refractive_index: Double
    diffuse: Double
    specular: Double
    shininess: Double
    absorption: Vector
    bump: PatternPointer
    bump_height: Double


class LightType(enum.IntEnum):
    POINT = 0
    PARALLEL = 1
    SPOT = 2
    CYLINDER = 3


@growable("crt_light")
class Light(Struct):
    """A Light is made by Light.point(origin=...), Light.parallel(origin=..., pointing=...),
    Light.spot() or Light.cylinder()."""

    type: Int
    origin: Vector
    pointing: Vector
    color: Vector
    angle: Double
    penumbra: Double
    radius: Double
    falloff: Double
    ambient: Double

    @classmethod
    def point(cls, **fields: Any) -> "Light":
        """Shines from `origin` in all directions."""
        return cls.of_type(LightType.POINT, **fields)

    @classmethod
    def parallel(cls, **fields: Any) -> "Light":
        """Shines along `origin` to `pointing` everywhere, like a sun."""
        return cls.of_type(LightType.PARALLEL, **fields)

    @classmethod
    def spot(cls, **fields: Any) -> "Light":
        """Shines from `origin` into a cone about the direction to `pointing`."""
        return cls.of_type(LightType.SPOT, **fields)

    @classmethod
    def cylinder(cls, **fields: Any) -> "Light":
        """Sends parallel rays that fill a cylinder from `origin` towards `pointing`."""
        return cls.of_type(LightType.CYLINDER, **fields)


class Projection(enum.IntEnum):
    PINHOLE = 0
    SPHERICAL = 1
    CYLINDRICAL = 2
    ORTHOGRAPHIC = 3


class ApertureShape(enum.IntEnum):
    CIRCLE = 0
    UNIFORM = 1
    GAUSSIAN = 2
    TRIANGLE = 3
    SQUARE = 4
    PENTAGON = 5
    HEXAGON = 6
    OCTAGON = 7
    LINE = 8


@growable("crt_camera")
class Camera(Struct):
    """A Camera says where the picture is seen from."""

    projection: Int
    position: Vector
    pointing: Vector
    fov: Double
    roll: Double
    aperture: Double
    focal_distance: Double
    aperture_shape: Int
    reserved: Int


class BackgroundType(enum.IntEnum):
    SOLID = 0
    GRADIENT = 1
    SPHERICAL = 2
    CYLINDRICAL = 3
    EQUAL_AREA = 4


@growable("crt_background")
class Background(Struct):
    """A Background is what a ray that hits nothing sees: a colour, Background.gradient(), or
    Background.panorama(image)."""

    type: Int
    color: Vector
    alpha: Double
    horizon: Vector
    horizon_alpha: Double
    sky: Vector
    sky_alpha: Double
    image: ImagePointer
    angle: Double

    @classmethod
    def gradient(cls, **fields: Any) -> "Background":
        """Changes from `horizon` to `sky`."""
        return cls(type=BackgroundType.GRADIENT, **fields)

    @classmethod
    def panorama(
        cls, image: Any, cylindrical: bool = False, equal_area: bool = False, **fields: Any
    ) -> "Background":
        """Shows a crt.Image all around: spherical (equirectangular), unless it is one of the
        others."""
        if cylindrical and equal_area:
            raise ValueError("a panorama is cylindrical or of equal area, not both")
        type = BackgroundType.SPHERICAL
        if cylindrical:
            type = BackgroundType.CYLINDRICAL
        if equal_area:
            type = BackgroundType.EQUAL_AREA
        return cls(type=type, image=image, **fields)


class PixelFilter(enum.IntEnum):
    BOX = 0
    BLACKMAN_HARRIS = 1


@growable("crt_settings")
class Settings(Struct):
    """Settings say how a scene is rendered."""

    width: Int
    height: Int
    supersampling: Int
    dof_samples: Int
    recursion_depth: Int
    gamma: Double
    min_weight: Double
    falloff_model: Int
    show_clip: Int
    seed: Long
    title: Text
    author: Text
    date: Text
    notes: Text
    precision: Int
    reserved: Int
    target_error: Double
    time_budget: Double
    filter_width: Double
    min_samples: Int
    max_samples: Int
    filter: Int
    reserved_2: Int
    compat: Int
    reserved_3: Int


@growable("crt_render_stats", has_init=False)
class RenderStats(Struct):
    """RenderStats say what rendering a picture took."""

    threads: Int
    pixels: Long
    camera_rays: Long
    shadow_rays: Long
    reflection_rays: Long
    refraction_rays: Long
    rays_below_min_weight: Long
    rays_beyond_depth: Long
    samples_over_ray_bound: Long
    intersection_tests: Long
    interval_events: Long
    media_lookups: Long
    media_changes: Long
    pattern_lookups: Long
    lens_samples: Long
    prepare_seconds: Double
    trace_seconds: Double
    escalations: Long
    primitive_bytes: Long
    csg_bytes: Long
    tree_bytes: Long
    material_bytes: Long
    samples_min: Long
    samples_mean: Double
    samples_max: Long
    passes: Int
    reserved: Int
    half_width_rms: Double
    half_width_95: Double
    half_width_max: Double
    pixels_unresolved: Long
    unseen_share: Double
    cutoff_mean: Double
    cutoff_max: Double
