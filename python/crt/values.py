"""This module has materials, lights, cameras, backgrounds and settings.

The fields, their units, ranges and defaults are those of the structs of the same name in crt.h, and
stand in the documentation of each class: help(crt.Material). Vectors are three numbers, colours
linear RGB, angles radians. Each class takes fields as keyword arguments, and they may be changed
later. An entity copies its material. A scene keeps the very objects that it is given, so that what
changes in them changes the scene.
"""

import ctypes
import enum
from typing import TYPE_CHECKING, Any

from . import _arguments
from ._structs import Struct, growable

if TYPE_CHECKING:
    from .images import Image


class PatternType(enum.IntEnum):
    """Lists the kinds of patterns."""

    CHECKER = 0
    STRIPES = 1
    GRADIENT = 2
    NOISE = 3
    MARBLE = 4
    WOOD = 5
    IMAGE = 6


class ImageMapping(enum.IntEnum):
    """Says how an image is laid over a surface."""

    UV = 0
    PLANAR = 1
    CYLINDRICAL = 2
    CUBIC = 3


class _ColorStop(ctypes.Structure):
    _fields_ = [
        ("position", ctypes.c_double),
        ("color", ctypes.c_double * 3),
        ("alpha", ctypes.c_double),
    ]

    @classmethod
    def of(cls, given: Any, name: str) -> "_ColorStop":
        if not isinstance(given, (tuple, list)) or not 2 <= len(given) <= 3:
            raise _arguments.refusal(name, "(position, color) or (position, color, alpha)", given)
        position = _arguments.number(given[0], f"{name}[0]")
        color = _arguments.vector(given[1], f"{name}[1]")
        alpha = _arguments.number(given[2], f"{name}[2]") if len(given) == 3 else 1
        return cls(position, color, alpha)


@growable("crt_pattern", type=PatternType, mapping=ImageMapping)
class Pattern(Struct):
    """A Pattern is colours that vary over a surface or through space: Pattern.wood(scale=0.1).
    Each of its `colors` is (position, color) or (position, color, alpha)."""

    def __setattr__(self, name: str, value: Any) -> None:
        if name == "colors":
            self._set_colors(value)
        elif name == "color_count":
            if value != len(self.colors or ()):
                raise AttributeError("Pattern: color_count is that of colors, and follows them")
        else:
            super().__setattr__(name, value)

    def _set_colors(self, value: Any) -> None:
        self._require_free("colors")
        stops = []
        for i, given in enumerate(() if value is None else value):
            stops.append(_ColorStop.of(given, f"Pattern: colors[{i}]"))
        array = (_ColorStop * len(stops))(*stops)
        address = ctypes.addressof(array) if stops else None
        ctypes.Structure.__setattr__(self, "colors", address)
        ctypes.Structure.__setattr__(self, "color_count", len(stops))
        shown = tuple((stop.position, tuple(stop.color), stop.alpha) for stop in stops)
        self._kept.update({"colors": shown or None, "_stops": array})

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
    def of_image(cls, image: "Image", **fields: Any) -> "Pattern":
        """Lays a crt.Image over the surface."""
        return cls.of_type(PatternType.IMAGE, image=image, **fields)


@growable("crt_material")
class Material(Struct):
    """A Material says what a surface is made of. A `pattern` replaces the colour."""


@growable("crt_principled")
class PrincipledMaterial(Struct):
    """A PrincipledMaterial says what a surface is made of, in the words of glTF, OpenPBR and
    Blender. Each `..._map` and `pattern` is a Pattern that replaces what it is called after."""


class LightType(enum.IntEnum):
    """Lists the kinds of lights. All cast shadows."""

    POINT = 0
    PARALLEL = 1
    SPOT = 2
    CYLINDER = 3
    SPHERE = 4
    DISC = 5
    RECTANGLE = 6
    ENVIRONMENT = 7


@growable("crt_light", type=LightType)
class Light(Struct):
    """A Light is made by Light.point(origin=...), Light.parallel(origin=..., pointing=...),
    Light.spot(), Light.cylinder(), Light.sphere(), Light.disc(), Light.rectangle() or
    Light.environment()."""

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

    @classmethod
    def sphere(cls, **fields: Any) -> "Light":
        """Shines outwards from a sphere about `origin`. `color` is its radiance, as of the next
        two."""
        return cls.of_type(LightType.SPHERE, **fields)

    @classmethod
    def disc(cls, **fields: Any) -> "Light":
        """Shines from a disc about `origin` towards `pointing`."""
        return cls.of_type(LightType.DISC, **fields)

    @classmethod
    def rectangle(cls, **fields: Any) -> "Light":
        """Shines from the parallelogram from `origin` along `edge_a` and `edge_b`, to the side of
        their cross product."""
        return cls.of_type(LightType.RECTANGLE, **fields)

    @classmethod
    def environment(cls, **fields: Any) -> "Light":
        """Makes the background a light, times `scale`."""
        return cls.of_type(LightType.ENVIRONMENT, **fields)


class Projection(enum.IntEnum):
    """Says how a camera maps directions to the picture."""

    PINHOLE = 0
    SPHERICAL = 1
    CYLINDRICAL = 2
    ORTHOGRAPHIC = 3


class ApertureShape(enum.IntEnum):
    """Lists the shapes of the lens opening."""

    CIRCLE = 0
    UNIFORM = 1
    GAUSSIAN = 2
    TRIANGLE = 3
    SQUARE = 4
    PENTAGON = 5
    HEXAGON = 6
    OCTAGON = 7
    LINE = 8


@growable("crt_camera", projection=Projection, aperture_shape=ApertureShape)
class Camera(Struct):
    """A Camera says where the picture is seen from."""


class BackgroundType(enum.IntEnum):
    """Lists the kinds of backgrounds."""

    SOLID = 0
    GRADIENT = 1
    SPHERICAL = 2
    CYLINDRICAL = 3
    EQUAL_AREA = 4
    SKY = 5


@growable("crt_background", type=BackgroundType)
class Background(Struct):
    """A Background is what a ray that hits nothing sees: a colour, Background.gradient(),
    Background.panorama(image), or Background.daylight(), which is a light, too."""

    @classmethod
    def gradient(cls, **fields: Any) -> "Background":
        """Changes from `horizon` to `sky`."""
        return cls(type=BackgroundType.GRADIENT, **fields)

    @classmethod
    def panorama(
        cls, image: "Image", cylindrical: bool = False, equal_area: bool = False, **fields: Any
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

    @classmethod
    def daylight(cls, **fields: Any) -> "Background":
        """Is a clear sky whose sun is in the direction `sun`. Both light the scene."""
        return cls(type=BackgroundType.SKY, **fields)


class PixelFilter(enum.IntEnum):
    """Says what a pixel is the mean of."""

    BOX = 0
    BLACKMAN_HARRIS = 1


class FalloffModel(enum.IntEnum):
    """Says what the distance D in a light's falloff / D^2 is."""

    PATH = 0
    LIGHT = 1


class AmbientModel(enum.IntEnum):
    """Says how much of a light's ambient share a surface sends back."""

    LIGHT = 0
    SURFACE = 1


class ToneMap(enum.IntEnum):
    """Says how light that is too bright for a display is brought into its range."""

    NONE = 0
    FILMIC = 1


class Unit(enum.IntEnum):
    """Says what a scene unit is."""

    M = 0
    CM = 1
    MM = 2
    IN = 3


class Precision(enum.IntEnum):
    """Says how close calls of the geometry are decided."""

    STANDARD = 0
    EXACT = 1


@growable(
    "crt_settings",
    falloff_model=FalloffModel,
    ambient_model=AmbientModel,
    precision=Precision,
    filter=PixelFilter,
    tone_map=ToneMap,
    unit=Unit,
)
class Settings(Struct):
    """Settings say how a scene is rendered."""


@growable("crt_render_stats", has_init=False)
class RenderStats(Struct):
    """RenderStats say what rendering a picture took."""

