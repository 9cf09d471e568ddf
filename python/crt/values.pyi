# python/tools/generate.py has written this file from crt.h.
"""These are the types of what values.py has."""

import enum
from collections.abc import Sequence
from typing import Any, Literal, SupportsFloat, SupportsIndex, TypeVar

from numpy.typing import NDArray

from .images import Image

Self = TypeVar("Self")
# What is given may be less than what is read back.
GivenVector = Sequence[SupportsFloat] | NDArray[Any]
Vector = Sequence[float] | NDArray[Any]
ColorStops = Sequence[tuple[float, Vector] | tuple[float, Vector, float]]

# Each is a ctypes.Structure, of which a checker believes that it has any attribute.
class _Struct:
    @classmethod
    def of_type(cls: type[Self], kind: int, /, **fields: Any) -> Self: ...
    @classmethod
    def _filled_by(cls: type[Self], function: str, *arguments: Any) -> Self: ...
    def _freeze(self: Self, why: str) -> Self: ...
    def _snapshot(self: Self, why: str) -> Self: ...

PatternTypeName = Literal["checker", "stripes", "gradient", "noise", "marble", "wood", "image"]

class PatternType(enum.IntEnum):
    """Lists the kinds of patterns."""
    CHECKER = 0
    STRIPES = 1
    GRADIENT = 2
    NOISE = 3
    MARBLE = 4
    WOOD = 5
    IMAGE = 6

ImageMappingName = Literal["uv", "planar", "cylindrical", "cubic"]

class ImageMapping(enum.IntEnum):
    """Says how an image is laid over a surface."""
    UV = 0
    PLANAR = 1
    CYLINDRICAL = 2
    CUBIC = 3

class Pattern(_Struct):
    """A Pattern is colours that vary over a surface or through space: Pattern.wood(scale=0.1).
    Each of its `colors` is (position, color) or (position, color, alpha).

    Its fields are:
    - type (PatternType, or its name): a PatternType
    - color_a (Vector): linear RGB, each in [0, 1e30]
    - alpha_a (float): in [0, 1]; what is missing to 1 adds to the material's transparency
    - color_b (Vector)
    - alpha_b (float)
    - direction (Vector): any length but 0
    - offset (Vector): moves the pattern; scene units
    - scale (float): of one period, in scene units; > 0
    - turbulence (float): >= 0
    - octaves (int): in [1, 16]
    - image (Image | None): of PatternType.IMAGE alone
    - repeat_u (float): how often the image repeats across the surface; > 0
    - repeat_v (float)
    - pattern_a (Pattern | None): takes the place of color_a; default None
    - pattern_b (Pattern | None): Takes the place of color_b; default None. At most 5 patterns lie
      within one another.
    - colors (ColorStops | None): Takes the place of both colours of gradient, noise, marble and
      wood: 2 to 64 stops at ascending positions. Two at one position make an edge.
    - color_count (int): of `colors`; default 0
    - mapping (ImageMapping, or its name): Says how the image is laid over the surface
      (ImageMapping). All but ImageMapping.UV take `direction`, `offset` and `scale`, the width and
      height of the picture.
    """
    type: PatternType | int | PatternTypeName
    color_a: Vector
    alpha_a: float
    color_b: Vector
    alpha_b: float
    direction: Vector
    offset: Vector
    scale: float
    turbulence: float
    octaves: int
    image: Image | None
    repeat_u: float
    repeat_v: float
    pattern_a: Pattern | None
    pattern_b: Pattern | None
    colors: ColorStops | None
    color_count: int
    mapping: ImageMapping | int | ImageMappingName
    def __init__(
        self,
        *,
        type: PatternType | int | PatternTypeName = ...,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> None: ...
    def set(
        self,
        *,
        type: PatternType | int | PatternTypeName = ...,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> None: ...
    @classmethod
    def checker(
        cls,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Makes cubes whose edges are `scale` long."""
    @classmethod
    def stripes(
        cls,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Makes bands across `direction`, one of each colour in `scale`."""
    @classmethod
    def gradient(
        cls,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Changes from `color_a` to `color_b` and back along `direction` within `scale`."""
    @classmethod
    def noise(
        cls,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Makes clouds."""
    @classmethod
    def marble(
        cls,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Makes veins across `direction`."""
    @classmethod
    def wood(
        cls,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        image: Image | None = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Makes rings about the line through `offset` along `direction`."""
    @classmethod
    def of_image(
        cls,
        image: Image,
        *,
        color_a: GivenVector = ...,
        alpha_a: SupportsFloat = ...,
        color_b: GivenVector = ...,
        alpha_b: SupportsFloat = ...,
        direction: GivenVector = ...,
        offset: GivenVector = ...,
        scale: SupportsFloat = ...,
        turbulence: SupportsFloat = ...,
        octaves: SupportsIndex = ...,
        repeat_u: SupportsFloat = ...,
        repeat_v: SupportsFloat = ...,
        pattern_a: Pattern | None = ...,
        pattern_b: Pattern | None = ...,
        colors: ColorStops | None = ...,
        color_count: SupportsIndex = ...,
        mapping: ImageMapping | int | ImageMappingName = ...,
    ) -> Pattern:
        """Lays a crt.Image over the surface."""

class Material(_Struct):
    """A Material says what a surface is made of. A `pattern` replaces the colour.

    Its fields are:
    - color (Vector): linear RGB, each in [0, 1e30]; above 1 it brightens; default 0.5
    - alpha (float): in [0, 1]; what is missing to 1 adds to the transparency; default 1
    - pattern (Pattern | None): takes the place of the colour; default None
    - reflectivity (float): share of light mirrored, in [0, 1]; default 0
    - transparency (float): share of light let through, times the colour at each surface, in [0, 1];
      default 0
    - refractive_index (float): of the inside, in [0.01, 100]; default 1
    - diffuse (float): >= 0, or -1 (default) for max(0, 1 - reflectivity - transparency)
    - specular (float): strength of the highlight, >= 0; default 0
    - shininess (float): exponent of the highlight's cosine, >= 0; default 3
    - absorption (Vector): inside, per scene unit and channel (Beer-Lambert), >= 0; default 0
    - bump (Pattern | None): its luminance raises the surface; default None
    - bump_height (float): scene units; default 0.1
    - emission (Vector): Is the radiance that the surface gives off, linear RGB, each in [0, 1e30];
      default 0. Since 1.1.
    - density (float): kg per cubic metre, for masses (crt_entity_density()), >= 0; default 0, which
      says nothing of it. Since 1.1.
    """
    color: Vector
    alpha: float
    pattern: Pattern | None
    reflectivity: float
    transparency: float
    refractive_index: float
    diffuse: float
    specular: float
    shininess: float
    absorption: Vector
    bump: Pattern | None
    bump_height: float
    emission: Vector
    density: float
    def __init__(
        self,
        *,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        pattern: Pattern | None = ...,
        reflectivity: SupportsFloat = ...,
        transparency: SupportsFloat = ...,
        refractive_index: SupportsFloat = ...,
        diffuse: SupportsFloat = ...,
        specular: SupportsFloat = ...,
        shininess: SupportsFloat = ...,
        absorption: GivenVector = ...,
        bump: Pattern | None = ...,
        bump_height: SupportsFloat = ...,
        emission: GivenVector = ...,
        density: SupportsFloat = ...,
    ) -> None: ...
    def set(
        self,
        *,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        pattern: Pattern | None = ...,
        reflectivity: SupportsFloat = ...,
        transparency: SupportsFloat = ...,
        refractive_index: SupportsFloat = ...,
        diffuse: SupportsFloat = ...,
        specular: SupportsFloat = ...,
        shininess: SupportsFloat = ...,
        absorption: GivenVector = ...,
        bump: Pattern | None = ...,
        bump_height: SupportsFloat = ...,
        emission: GivenVector = ...,
        density: SupportsFloat = ...,
    ) -> None: ...

class PrincipledMaterial(_Struct):
    """A PrincipledMaterial says what a surface is made of, in the words of glTF, OpenPBR and
    Blender. Each `..._map` and `pattern` is a Pattern that replaces what it is called after.

    Its fields are:
    - color (Vector): what is scattered, mirrored by metal or let through: linear RGB, each in [0,
      1e30]; default 0.8
    - pattern (Pattern | None): takes the place of the colour; default None
    - metallic (float): share that is a metal, in [0, 1]; default 0
    - roughness (float): 0 for a mirror or clear glass, to 1; default 0.5
    - refractive_index (float): of the inside, in [0.01, 100]; default 1.5
    - transmission (float): share of what is no metal that lets light through, in [0, 1]; default 0
    - absorption (Vector): inside, per scene unit and channel (Beer-Lambert), >= 0; default 0
    - coat (float): strength of a clear varnish on top, in [0, 1]; default 0
    - coat_roughness (float): in [0, 1]; default 0
    - sheen (float): strength of the sheen of cloth, in [0, 1]; default 0
    - emission (Vector): radiance given off, linear RGB, each in [0, 1e30]; default 0
    - metallic_map (Pattern | None): its luminance takes the place of metallic; default None
    - roughness_map (Pattern | None): and that of roughness
    - emission_map (Pattern | None): takes the place of emission; default None
    - bump (Pattern | None): its luminance raises the surface; default None
    - normal_map (Pattern | None): Tilts the normal by its colours, from -1 at 0 to 1 at 1: red
      along u, green along v, blue out of the surface. Pictures count as they are, without the gamma
      of displays. Default None.
    - bump_height (float): scene units; default 0.1
    - density (float): kg per cubic metre, for masses, >= 0; default 0: nothing is said of it
    """
    color: Vector
    pattern: Pattern | None
    metallic: float
    roughness: float
    refractive_index: float
    transmission: float
    absorption: Vector
    coat: float
    coat_roughness: float
    sheen: float
    emission: Vector
    metallic_map: Pattern | None
    roughness_map: Pattern | None
    emission_map: Pattern | None
    bump: Pattern | None
    normal_map: Pattern | None
    bump_height: float
    density: float
    def __init__(
        self,
        *,
        color: GivenVector = ...,
        pattern: Pattern | None = ...,
        metallic: SupportsFloat = ...,
        roughness: SupportsFloat = ...,
        refractive_index: SupportsFloat = ...,
        transmission: SupportsFloat = ...,
        absorption: GivenVector = ...,
        coat: SupportsFloat = ...,
        coat_roughness: SupportsFloat = ...,
        sheen: SupportsFloat = ...,
        emission: GivenVector = ...,
        metallic_map: Pattern | None = ...,
        roughness_map: Pattern | None = ...,
        emission_map: Pattern | None = ...,
        bump: Pattern | None = ...,
        normal_map: Pattern | None = ...,
        bump_height: SupportsFloat = ...,
        density: SupportsFloat = ...,
    ) -> None: ...
    def set(
        self,
        *,
        color: GivenVector = ...,
        pattern: Pattern | None = ...,
        metallic: SupportsFloat = ...,
        roughness: SupportsFloat = ...,
        refractive_index: SupportsFloat = ...,
        transmission: SupportsFloat = ...,
        absorption: GivenVector = ...,
        coat: SupportsFloat = ...,
        coat_roughness: SupportsFloat = ...,
        sheen: SupportsFloat = ...,
        emission: GivenVector = ...,
        metallic_map: Pattern | None = ...,
        roughness_map: Pattern | None = ...,
        emission_map: Pattern | None = ...,
        bump: Pattern | None = ...,
        normal_map: Pattern | None = ...,
        bump_height: SupportsFloat = ...,
        density: SupportsFloat = ...,
    ) -> None: ...

LightTypeName = Literal[
    "point", "parallel", "spot", "cylinder", "sphere", "disc", "rectangle", "environment"
]

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

class Light(_Struct):
    """A Light is made by Light.point(origin=...), Light.parallel(origin=..., pointing=...),
    Light.spot(), Light.cylinder(), Light.sphere(), Light.disc(), Light.rectangle() or
    Light.environment().

    Its fields are:
    - type (LightType, or its name): a LightType; default LightType.POINT
    - origin (Vector): default 0
    - pointing (Vector): default 0; a point light ignores it, others need a point other than
      `origin`
    - color (Vector): linear RGB, >= 0, may pass 1; default 1. Of what has a surface it is the
      radiance
    - angle (float): spot: full angle of the cone, in (0, 2 pi]; 0 (default) is pi / 3. Parallel:
      how wide it is seen, in [0, pi], which softens shadows; default 0
    - penumbra (float): spot: width of its soft edge inwards, radians of the half angle; default pi
      / 36
    - radius (float): cylinder, sphere, disc: > 0, and 0 (default) is 1. Point: at 0 a point, above
      it a ball that softens shadows and is not seen
    - falloff (float): 0 (default) or less: distance does not matter; else the light fades as
      falloff / D^2
    - ambient (float): share of the colour that every point gets, >= 0; default 0
    - edge_a (Vector): rectangle: not 0; default (1, 0, 0). Since 1.1, as what follows.
    - edge_b (Vector): rectangle: not parallel to `edge_a`; default (0, 0, 1)
    - visible (int): sphere, disc, rectangle: whether it is seen itself; default 1
    - two_sided (int): disc, rectangle: whether it shines to both sides; default 0
    - scale (float): environment: factor of the background's light; default 1
    """
    type: LightType | int | LightTypeName
    origin: Vector
    pointing: Vector
    color: Vector
    angle: float
    penumbra: float
    radius: float
    falloff: float
    ambient: float
    edge_a: Vector
    edge_b: Vector
    visible: int
    two_sided: int
    scale: float
    def __init__(
        self,
        *,
        type: LightType | int | LightTypeName = ...,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> None: ...
    def set(
        self,
        *,
        type: LightType | int | LightTypeName = ...,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> None: ...
    @classmethod
    def point(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Shines from `origin` in all directions."""
    @classmethod
    def parallel(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Shines along `origin` to `pointing` everywhere, like a sun."""
    @classmethod
    def spot(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Shines from `origin` into a cone about the direction to `pointing`."""
    @classmethod
    def cylinder(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Sends parallel rays that fill a cylinder from `origin` towards `pointing`."""
    @classmethod
    def sphere(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Shines outwards from a sphere about `origin`. `color` is its radiance, as of the next
        two.
        """
    @classmethod
    def disc(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Shines from a disc about `origin` towards `pointing`."""
    @classmethod
    def rectangle(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Shines from the parallelogram from `origin` along `edge_a` and `edge_b`, to the side of
        their cross product.
        """
    @classmethod
    def environment(
        cls,
        *,
        origin: GivenVector = ...,
        pointing: GivenVector = ...,
        color: GivenVector = ...,
        angle: SupportsFloat = ...,
        penumbra: SupportsFloat = ...,
        radius: SupportsFloat = ...,
        falloff: SupportsFloat = ...,
        ambient: SupportsFloat = ...,
        edge_a: GivenVector = ...,
        edge_b: GivenVector = ...,
        visible: SupportsIndex = ...,
        two_sided: SupportsIndex = ...,
        scale: SupportsFloat = ...,
    ) -> Light:
        """Makes the background a light, times `scale`."""

ProjectionName = Literal["pinhole", "spherical", "cylindrical", "orthographic"]

class Projection(enum.IntEnum):
    """Says how a camera maps directions to the picture."""
    PINHOLE = 0
    SPHERICAL = 1
    CYLINDRICAL = 2
    ORTHOGRAPHIC = 3

ApertureShapeName = Literal[
    "circle", "uniform", "gaussian", "triangle", "square", "pentagon", "hexagon", "octagon", "line"
]

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

class Camera(_Struct):
    """A Camera says where the picture is seen from.

    Its fields are:
    - projection (Projection, or its name): a Projection; default Projection.PINHOLE
    - position (Vector): default (0, 0, -1)
    - pointing (Vector): the point looked at; default 0
    - fov (float): vertical field of view, radians, in (0, pi); default pi / 3
    - roll (float): radians; positive tips the picture's top to the right; default 0
    - aperture (float): radius of the lens in thousandths of a scene unit; 0 (default): all is sharp
    - focal_distance (float): along the view direction to what is in focus, > 0; default 1
    - aperture_shape (ApertureShape, or its name): a ApertureShape; default ApertureShape.CIRCLE
    - lens_radius (float): Is the radius of the lens in scene units, instead of `aperture`: one of
      the two must be 0. Default 0. Since 1.1.
    - section_normal (Vector): Cuts solids open if it is not 0: only what is against this normal of
      the plane {p : normal . p = offset |normal|} is there, and cuts are hatched. Default 0. Since
      1.1, as what follows.
    - section_offset (float): of the plane, in scene units; default 0
    - section_hatch (float): distance of hatching lines, >= 0; default 0: by the size of the cut
    """
    projection: Projection | int | ProjectionName
    position: Vector
    pointing: Vector
    fov: float
    roll: float
    aperture: float
    focal_distance: float
    aperture_shape: ApertureShape | int | ApertureShapeName
    lens_radius: float
    section_normal: Vector
    section_offset: float
    section_hatch: float
    def __init__(
        self,
        *,
        projection: Projection | int | ProjectionName = ...,
        position: GivenVector = ...,
        pointing: GivenVector = ...,
        fov: SupportsFloat = ...,
        roll: SupportsFloat = ...,
        aperture: SupportsFloat = ...,
        focal_distance: SupportsFloat = ...,
        aperture_shape: ApertureShape | int | ApertureShapeName = ...,
        lens_radius: SupportsFloat = ...,
        section_normal: GivenVector = ...,
        section_offset: SupportsFloat = ...,
        section_hatch: SupportsFloat = ...,
    ) -> None: ...
    def set(
        self,
        *,
        projection: Projection | int | ProjectionName = ...,
        position: GivenVector = ...,
        pointing: GivenVector = ...,
        fov: SupportsFloat = ...,
        roll: SupportsFloat = ...,
        aperture: SupportsFloat = ...,
        focal_distance: SupportsFloat = ...,
        aperture_shape: ApertureShape | int | ApertureShapeName = ...,
        lens_radius: SupportsFloat = ...,
        section_normal: GivenVector = ...,
        section_offset: SupportsFloat = ...,
        section_hatch: SupportsFloat = ...,
    ) -> None: ...

BackgroundTypeName = Literal["solid", "gradient", "spherical", "cylindrical", "equal_area", "sky"]

class BackgroundType(enum.IntEnum):
    """Lists the kinds of backgrounds."""
    SOLID = 0
    GRADIENT = 1
    SPHERICAL = 2
    CYLINDRICAL = 3
    EQUAL_AREA = 4
    SKY = 5

class Background(_Struct):
    """A Background is what a ray that hits nothing sees: a colour, Background.gradient(),
    Background.panorama(image), or Background.daylight(), which is a light, too.

    Its fields are:
    - type (BackgroundType, or its name): a BackgroundType; default BackgroundType.SOLID
    - color (Vector): linear RGB, >= 0; default 1
    - alpha (float): of the pixels where nothing is hit, in [0, 1]; default 1
    - horizon (Vector)
    - horizon_alpha (float)
    - sky (Vector)
    - sky_alpha (float)
    - image (Image | None): its middle column is straight ahead (+z) at angle 0
    - angle (float): turns the image about y, radians
    - sun (Vector): sky: the direction to the sun, not 0; default (-1, 1, -1). Since 1.1, as what
      follows.
    - turbidity (float): sky: how hazy the air is, in [2, 10]; default 3
    - scale (float): sky: factor of all of its light; default 1
    - ground (Vector): sky: colour of what is seen below the horizon; default 0.3
    - shines (int): sky: whether it lights the scene, or is merely seen; default 1
    """
    type: BackgroundType | int | BackgroundTypeName
    color: Vector
    alpha: float
    horizon: Vector
    horizon_alpha: float
    sky: Vector
    sky_alpha: float
    image: Image | None
    angle: float
    sun: Vector
    turbidity: float
    scale: float
    ground: Vector
    shines: int
    def __init__(
        self,
        *,
        type: BackgroundType | int | BackgroundTypeName = ...,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        horizon: GivenVector = ...,
        horizon_alpha: SupportsFloat = ...,
        sky: GivenVector = ...,
        sky_alpha: SupportsFloat = ...,
        image: Image | None = ...,
        angle: SupportsFloat = ...,
        sun: GivenVector = ...,
        turbidity: SupportsFloat = ...,
        scale: SupportsFloat = ...,
        ground: GivenVector = ...,
        shines: SupportsIndex = ...,
    ) -> None: ...
    def set(
        self,
        *,
        type: BackgroundType | int | BackgroundTypeName = ...,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        horizon: GivenVector = ...,
        horizon_alpha: SupportsFloat = ...,
        sky: GivenVector = ...,
        sky_alpha: SupportsFloat = ...,
        image: Image | None = ...,
        angle: SupportsFloat = ...,
        sun: GivenVector = ...,
        turbidity: SupportsFloat = ...,
        scale: SupportsFloat = ...,
        ground: GivenVector = ...,
        shines: SupportsIndex = ...,
    ) -> None: ...
    @classmethod
    def gradient(
        cls,
        *,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        horizon: GivenVector = ...,
        horizon_alpha: SupportsFloat = ...,
        sky: GivenVector = ...,
        sky_alpha: SupportsFloat = ...,
        image: Image | None = ...,
        angle: SupportsFloat = ...,
        sun: GivenVector = ...,
        turbidity: SupportsFloat = ...,
        scale: SupportsFloat = ...,
        ground: GivenVector = ...,
        shines: SupportsIndex = ...,
    ) -> Background:
        """Changes from `horizon` to `sky`."""
    @classmethod
    def panorama(
        cls,
        image: Image,
        cylindrical: bool = ...,
        equal_area: bool = ...,
        *,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        horizon: GivenVector = ...,
        horizon_alpha: SupportsFloat = ...,
        sky: GivenVector = ...,
        sky_alpha: SupportsFloat = ...,
        angle: SupportsFloat = ...,
        sun: GivenVector = ...,
        turbidity: SupportsFloat = ...,
        scale: SupportsFloat = ...,
        ground: GivenVector = ...,
        shines: SupportsIndex = ...,
    ) -> Background:
        """Shows a crt.Image all around: spherical (equirectangular), unless it is one of the
        others.
        """
    @classmethod
    def daylight(
        cls,
        *,
        color: GivenVector = ...,
        alpha: SupportsFloat = ...,
        horizon: GivenVector = ...,
        horizon_alpha: SupportsFloat = ...,
        sky: GivenVector = ...,
        sky_alpha: SupportsFloat = ...,
        image: Image | None = ...,
        angle: SupportsFloat = ...,
        sun: GivenVector = ...,
        turbidity: SupportsFloat = ...,
        scale: SupportsFloat = ...,
        ground: GivenVector = ...,
        shines: SupportsIndex = ...,
    ) -> Background:
        """Is a clear sky whose sun is in the direction `sun`. Both light the scene."""

PixelFilterName = Literal["box", "blackman_harris"]

class PixelFilter(enum.IntEnum):
    """Says what a pixel is the mean of."""
    BOX = 0
    BLACKMAN_HARRIS = 1

FalloffModelName = Literal["path", "light"]

class FalloffModel(enum.IntEnum):
    """Says what the distance D in a light's falloff / D^2 is."""
    PATH = 0
    LIGHT = 1

AmbientModelName = Literal["light", "surface"]

class AmbientModel(enum.IntEnum):
    """Says how much of a light's ambient share a surface sends back."""
    LIGHT = 0
    SURFACE = 1

ToneMapName = Literal["none", "filmic"]

class ToneMap(enum.IntEnum):
    """Says how light that is too bright for a display is brought into its range."""
    NONE = 0
    FILMIC = 1

UnitName = Literal["m", "cm", "mm", "in"]

class Unit(enum.IntEnum):
    """Says what a scene unit is."""
    M = 0
    CM = 1
    MM = 2
    IN = 3

PrecisionName = Literal["standard", "exact"]

class Precision(enum.IntEnum):
    """Says how close calls of the geometry are decided."""
    STANDARD = 0
    EXACT = 1

class Settings(_Struct):
    """Settings say how a scene is rendered.

    Its fields are:
    - width (int): pixels, in [1, 65536]; default 640; width * height is at most 2^27
    - height (int): default 480
    - supersampling (int): n x n rays a pixel, in [1, 64]; default 1
    - dof_samples (int): points of the lens for each of them, in [1, 65536]; default 1: no lens
    - recursion_depth (int): bounces after the camera's ray, in [0, 256]; default 3
    - gamma (float): 8-bit files hold clamp(c)^(1/gamma); in [0.1, 10]; default 2.2
    - min_weight (float): rays with a smaller share of the pixel in every channel are dropped;
      default 1/1024
    - falloff_model (FalloffModel, or its name): a FalloffModel; default FalloffModel.LIGHT
    - show_clip (int): not 0: pixels are red in 8-bit files that cannot say how bright a channel is;
      default 0
    - seed (int): of the random numbers; default 0
    - title (str | None): this and the next go into the files; None (default) for none
    - author (str | None)
    - date (str | None)
    - notes (str | None)
    - precision (Precision, or its name): a Precision; default Precision.STANDARD
    - target_error (float): Above 0, a pixel gets samples until it is this near the truth in 95 of
      100 cases. 1/255 is a step of 8 bits. In [0, 1]; default 0.
    - time_budget (float): Above 0, these are the seconds that tracing may take. It stops at the end
      of a pass. The first pass is always completed, so that there is a picture. In [0, 1e6];
      default 0.
    - filter_width (float): pixels across, of filters other than the box; in [1, 16]; default 3
    - min_samples (int): of a pixel, with a target error or a time budget: a power of 2 in [4,
      65536]; default 16
    - max_samples (int): of a pixel, also a power of 2 in [4, 65536]; default 1024
    - filter (PixelFilter, or its name): a PixelFilter; default PixelFilter.BOX
    - compat (int): 0 is the default. With 2015 the picture is formed as the program of that year
      formed it: lens, panoramas, places of the grid's samples, levels of 8-bit files. The other
      settings are left: those of a script of 2015 are gamma 1, FalloffModel.PATH and
      AmbientModel.LIGHT. See docs/compat.md.
    - ambient_model (AmbientModel, or its name): a AmbientModel; default AmbientModel.SURFACE
    - no_head_light (int): A scene without lights is lit from the camera, unless this is not 0.
      Default 0.
    - indirect (int): Light is followed over so many diffuse bounces, in [0, 64]. Above 0 there is
      no ambient light. Default 0. Since 1.1.
    - light_samples (int): Each ray takes so many samples of what lights a point and has a size, in
      [1, 1024]. Default 1. Since 1.1.
    - tone_map (ToneMap, or its name): a ToneMap; default ToneMap.NONE. Since 1.1.
    - cutoff (int): This is a Cutoff: what is seen along rays that recursion_depth ends; default
      Cutoff.BACKGROUND. Since 1.1.
    - exposure (float): 8-bit files are brighter by so many stops: light counts 2^exposure times,
      before the tone map and gamma. Float files hold light as it is. In [-100, 100]; default 0.
      Since 1.1.
    - clamp (float): Above 0, light that comes by bounces counts as this bright at most, and nothing
      is claimed of the picture's accuracy. Default 0. Since 1.1.
    - denoise (int): Not 0: the finished picture is freed of noise, and nothing is claimed of its
      accuracy. Default 0. Since 1.1.
    - unit (Unit, or its name): a Unit: what a scene unit is, which neither the geometry nor the
      picture knows; default Unit.M. Since 1.1.
    - frames (int): of an animation, t = 0 to frames - 1, in [0, 1000000]; default 0: not said.
      Since 1.1.
    """
    width: int
    height: int
    supersampling: int
    dof_samples: int
    recursion_depth: int
    gamma: float
    min_weight: float
    falloff_model: FalloffModel | int | FalloffModelName
    show_clip: int
    seed: int
    title: str | None
    author: str | None
    date: str | None
    notes: str | None
    precision: Precision | int | PrecisionName
    target_error: float
    time_budget: float
    filter_width: float
    min_samples: int
    max_samples: int
    filter: PixelFilter | int | PixelFilterName
    compat: int
    ambient_model: AmbientModel | int | AmbientModelName
    no_head_light: int
    indirect: int
    light_samples: int
    tone_map: ToneMap | int | ToneMapName
    cutoff: int
    exposure: float
    clamp: float
    denoise: int
    unit: Unit | int | UnitName
    frames: int
    def __init__(
        self,
        *,
        width: SupportsIndex = ...,
        height: SupportsIndex = ...,
        supersampling: SupportsIndex = ...,
        dof_samples: SupportsIndex = ...,
        recursion_depth: SupportsIndex = ...,
        gamma: SupportsFloat = ...,
        min_weight: SupportsFloat = ...,
        falloff_model: FalloffModel | int | FalloffModelName = ...,
        show_clip: SupportsIndex = ...,
        seed: SupportsIndex = ...,
        title: str | None = ...,
        author: str | None = ...,
        date: str | None = ...,
        notes: str | None = ...,
        precision: Precision | int | PrecisionName = ...,
        target_error: SupportsFloat = ...,
        time_budget: SupportsFloat = ...,
        filter_width: SupportsFloat = ...,
        min_samples: SupportsIndex = ...,
        max_samples: SupportsIndex = ...,
        filter: PixelFilter | int | PixelFilterName = ...,
        compat: SupportsIndex = ...,
        ambient_model: AmbientModel | int | AmbientModelName = ...,
        no_head_light: SupportsIndex = ...,
        indirect: SupportsIndex = ...,
        light_samples: SupportsIndex = ...,
        tone_map: ToneMap | int | ToneMapName = ...,
        cutoff: SupportsIndex = ...,
        exposure: SupportsFloat = ...,
        clamp: SupportsFloat = ...,
        denoise: SupportsIndex = ...,
        unit: Unit | int | UnitName = ...,
        frames: SupportsIndex = ...,
    ) -> None: ...
    def set(
        self,
        *,
        width: SupportsIndex = ...,
        height: SupportsIndex = ...,
        supersampling: SupportsIndex = ...,
        dof_samples: SupportsIndex = ...,
        recursion_depth: SupportsIndex = ...,
        gamma: SupportsFloat = ...,
        min_weight: SupportsFloat = ...,
        falloff_model: FalloffModel | int | FalloffModelName = ...,
        show_clip: SupportsIndex = ...,
        seed: SupportsIndex = ...,
        title: str | None = ...,
        author: str | None = ...,
        date: str | None = ...,
        notes: str | None = ...,
        precision: Precision | int | PrecisionName = ...,
        target_error: SupportsFloat = ...,
        time_budget: SupportsFloat = ...,
        filter_width: SupportsFloat = ...,
        min_samples: SupportsIndex = ...,
        max_samples: SupportsIndex = ...,
        filter: PixelFilter | int | PixelFilterName = ...,
        compat: SupportsIndex = ...,
        ambient_model: AmbientModel | int | AmbientModelName = ...,
        no_head_light: SupportsIndex = ...,
        indirect: SupportsIndex = ...,
        light_samples: SupportsIndex = ...,
        tone_map: ToneMap | int | ToneMapName = ...,
        cutoff: SupportsIndex = ...,
        exposure: SupportsFloat = ...,
        clamp: SupportsFloat = ...,
        denoise: SupportsIndex = ...,
        unit: Unit | int | UnitName = ...,
        frames: SupportsIndex = ...,
    ) -> None: ...

class RenderStats(_Struct):
    """RenderStats say what rendering a picture took.

    Its fields are:
    - threads (int): that were allowed to work on it
    - pixels (int)
    - camera_rays (int)
    - shadow_rays (int)
    - reflection_rays (int)
    - refraction_rays (int)
    - rays_below_min_weight (int): not traced: below the settings' min_weight
    - rays_beyond_depth (int): not traced: the recursion depth was reached
    - samples_over_ray_bound (int): camera samples that reached 65536 rays and dropped the rest
    - intersection_tests (int): rays against primitives or CSG objects
    - interval_events (int): crossings sorted and flipped inside CSG objects
    - media_lookups (int)
    - media_changes (int)
    - pattern_lookups (int)
    - lens_samples (int)
    - prepare_seconds (float): wall-clock time, as is the next
    - trace_seconds (float)
    - escalations (int): decisions of Precision.EXACT that took exact arithmetic
    - primitive_bytes (int): primitives in their places, and which of their faces coincide
    - csg_bytes (int): how they are combined, and a bounding volume hierarchy for each CSG object
    - tree_bytes (int): the bounding volume hierarchy over all objects
    - material_bytes (int): materials, and pictures that were converted to linear light
    - samples_min (int): of a pixel
    - samples_mean (float)
    - samples_max (int)
    - passes (int): that were rendered; 0 without target error and time budget
    - half_width_rms (float): the root of the mean square
    - half_width_95 (float): what 95 of 100 pixels are within
    - half_width_max (float)
    - pixels_unresolved (int): their half-width is above the target error
    - unseen_share (float): share of a pixel: what covers more has been seen in 95 of 100 cases
    - cutoff_mean (float): light that a pixel may have lost by cutting off paths, if all light were
      white
    - cutoff_max (float)
    - undecided (int): how often interval arithmetic left open what a ray crosses of an implicit
      solid, so that the signs on both sides decided it
    """
    threads: int
    pixels: int
    camera_rays: int
    shadow_rays: int
    reflection_rays: int
    refraction_rays: int
    rays_below_min_weight: int
    rays_beyond_depth: int
    samples_over_ray_bound: int
    intersection_tests: int
    interval_events: int
    media_lookups: int
    media_changes: int
    pattern_lookups: int
    lens_samples: int
    prepare_seconds: float
    trace_seconds: float
    escalations: int
    primitive_bytes: int
    csg_bytes: int
    tree_bytes: int
    material_bytes: int
    samples_min: int
    samples_mean: float
    samples_max: int
    passes: int
    half_width_rms: float
    half_width_95: float
    half_width_max: float
    pixels_unresolved: int
    unseen_share: float
    cutoff_mean: float
    cutoff_max: float
    undecided: int
