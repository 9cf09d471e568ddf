"""This package is CRT for Python: solids, scenes, pictures and ray queries by libcrt and NumPy.

    import crt

    ball = crt.Sphere((0, 1, 0), 1, material=crt.Material(color=(0.6, 0.02, 0.01)))
    corner = crt.Box((0, 1, 0), (2, 3, -2))
    scene = crt.Scene([ball - corner], [crt.Light.point(origin=(3, 5, -4))])
    scene.camera = crt.Camera(position=(2, 2, -5), pointing=(0, 1, 0))
    scene.render().save("ball.png")

Space is left-handed: x to the right, y up, z into the picture. Everything is released by itself;
`with` and `close()` do so earlier. Prepared scenes, images and entities may be shared between
threads, and threads run at once while the library works. What fails raises crt.Error. An argument
of a wrong type is a TypeError that names it. help(crt.Material) and the like list the fields of
values.
"""

from . import farm
from ._crossings import Crossings
from ._library import version
from ._version import __version__
from .custom import Custom
from .entities import Entity, difference, interference, intersection, union
from .errors import Call, Diagnostic, Error, MissingFileError, ScriptError, Status
from .expressions import Expression
from .images import Image
from .jobs import Job
from .measures import Clearance, Interval, Mass, Nearest, Overlap, Thickness
from .meshes import Mesh, MeshReport, load_mesh, mesh_report
from .notebooks import Live
from .primitives import (
    Blob,
    Box,
    Capsule,
    Cone,
    Cylinder,
    Disc,
    Ellipsoid,
    Empty,
    Extrusion,
    HalfPlane,
    HeightField,
    Helix,
    Hull,
    Implicit,
    Plane,
    Polyhedron,
    Quadric,
    Revolution,
    RoundedBox,
    ShapedExtrusion,
    Sphere,
    Superellipsoid,
    Sweep,
    Thread,
    Torus,
    Triangle,
    Tube,
)
from .profiles import offset_contours, svg_path, text_contours
from .rays import (
    BACKFACE,
    ENTERING,
    FULL_HIT,
    HIT,
    HIT_PART,
    LOCATION,
    NO_ENTITY,
    RAY,
    START,
    camera_rays,
    ray,
    rays,
)
from .rendering import Prepared
from .scenes import Scene
from .sections import Section
from .surface_meshes import SurfaceMesh, write_surface_meshes
from .values import (
    AmbientModel,
    ApertureShape,
    Background,
    BackgroundType,
    Camera,
    FalloffModel,
    ImageMapping,
    Light,
    LightType,
    Material,
    Pattern,
    PatternType,
    PixelFilter,
    Precision,
    PrincipledMaterial,
    Projection,
    RenderStats,
    Settings,
    ToneMap,
    Unit,
)

live = Live

__all__ = [
    "AmbientModel",
    "ApertureShape",
    "BACKFACE",
    "Background",
    "BackgroundType",
    "Blob",
    "Box",
    "Call",
    "Camera",
    "Capsule",
    "Clearance",
    "Cone",
    "Crossings",
    "Custom",
    "Cylinder",
    "Diagnostic",
    "Disc",
    "Ellipsoid",
    "ENTERING",
    "Empty",
    "Entity",
    "Error",
    "Expression",
    "Extrusion",
    "FULL_HIT",
    "FalloffModel",
    "HIT",
    "HIT_PART",
    "HalfPlane",
    "HeightField",
    "Helix",
    "Hull",
    "Image",
    "ImageMapping",
    "Implicit",
    "Interval",
    "Job",
    "Light",
    "LightType",
    "LOCATION",
    "Live",
    "Mass",
    "Material",
    "Mesh",
    "MeshReport",
    "MissingFileError",
    "NO_ENTITY",
    "Nearest",
    "Overlap",
    "Pattern",
    "PatternType",
    "PixelFilter",
    "Plane",
    "Polyhedron",
    "Precision",
    "PrincipledMaterial",
    "Prepared",
    "Projection",
    "RAY",
    "RenderStats",
    "Quadric",
    "Revolution",
    "RoundedBox",
    "START",
    "Scene",
    "Section",
    "ScriptError",
    "Settings",
    "ShapedExtrusion",
    "Sphere",
    "Status",
    "Superellipsoid",
    "SurfaceMesh",
    "Sweep",
    "Thickness",
    "Thread",
    "ToneMap",
    "Torus",
    "Triangle",
    "Tube",
    "Unit",
    "__version__",
    "camera_rays",
    "difference",
    "farm",
    "interference",
    "intersection",
    "live",
    "load_mesh",
    "mesh_report",
    "offset_contours",
    "ray",
    "rays",
    "svg_path",
    "text_contours",
    "union",
    "version",
    "write_surface_meshes",
]
