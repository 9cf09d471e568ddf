# python/tools/generate.py has written this file from crt.h.
"""This table has the structs of crt.h that may grow: fields and comments."""

FIELDS = {
    "crt_pattern": (
        ("int32_t type", "a PatternType"),
        ("double color_a[3]", "linear RGB, each in [0, 1e30]"),
        ("double alpha_a", "in [0, 1]; what is missing to 1 adds to the material's transparency"),
        ("double color_b[3]", ""),
        ("double alpha_b", ""),
        ("double direction[3]", "any length but 0"),
        ("double offset[3]", "moves the pattern; scene units"),
        ("double scale", "of one period, in scene units; > 0"),
        ("double turbulence", ">= 0"),
        ("int32_t octaves", "in [1, 16]"),
        ("int32_t reserved", "0"),
        ("const crt_image* image", "of PatternType.IMAGE alone"),
        ("double repeat_u", "how often the image repeats across the surface; > 0"),
        ("double repeat_v", ""),
        ("const struct crt_pattern* pattern_a", "takes the place of color_a; default None"),
        (
            "const struct crt_pattern* pattern_b",
            "Takes the place of color_b; default None. At most 5 patterns lie within one "
            "another.",
        ),
        (
            "const crt_color_stop* colors",
            "Takes the place of both colours of gradient, noise, marble and wood: 2 to 64 stops"
            " at ascending positions. Two at one position make an edge.",
        ),
        ("uint64_t color_count", "of `colors`; default 0"),
        (
            "int32_t mapping",
            "Says how the image is laid over the surface (ImageMapping). All but "
            "ImageMapping.UV take `direction`, `offset` and `scale`, the width and height of "
            "the picture.",
        ),
        ("int32_t reserved_2", "must be 0"),
    ),
    "crt_material": (
        ("int32_t reserved", "0"),
        ("double color[3]", "linear RGB, each in [0, 1e30]; above 1 it brightens; default 0.5"),
        ("double alpha", "in [0, 1]; what is missing to 1 adds to the transparency; default 1"),
        ("const crt_pattern* pattern", "takes the place of the colour; default None"),
        ("double reflectivity", "share of light mirrored, in [0, 1]; default 0"),
        (
            "double transparency",
            "share of light let through, times the colour at each surface, in [0, 1]; default 0",
        ),
        ("double refractive_index", "of the inside, in [0.01, 100]; default 1"),
        ("double diffuse", ">= 0, or -1 (default) for max(0, 1 - reflectivity - transparency)"),
        ("double specular", "strength of the highlight, >= 0; default 0"),
        ("double shininess", "exponent of the highlight's cosine, >= 0; default 3"),
        (
            "double absorption[3]",
            "inside, per scene unit and channel (Beer-Lambert), >= 0; default 0",
        ),
        ("const crt_pattern* bump", "its luminance raises the surface; default None"),
        ("double bump_height", "scene units; default 0.1"),
        (
            "double emission[3]",
            "Is the radiance that the surface gives off, linear RGB, each in [0, 1e30]; default"
            " 0. Since 1.1.",
        ),
        (
            "double density",
            "kg per cubic metre, for masses (crt_entity_density()), >= 0; default 0, which says"
            " nothing of it. Since 1.1.",
        ),
    ),
    "crt_principled": (
        ("int32_t reserved", "0"),
        (
            "double color[3]",
            "what is scattered, mirrored by metal or let through: linear RGB, each in [0, "
            "1e30]; default 0.8",
        ),
        ("const crt_pattern* pattern", "takes the place of the colour; default None"),
        ("double metallic", "share that is a metal, in [0, 1]; default 0"),
        ("double roughness", "0 for a mirror or clear glass, to 1; default 0.5"),
        ("double refractive_index", "of the inside, in [0.01, 100]; default 1.5"),
        (
            "double transmission",
            "share of what is no metal that lets light through, in [0, 1]; default 0",
        ),
        (
            "double absorption[3]",
            "inside, per scene unit and channel (Beer-Lambert), >= 0; default 0",
        ),
        ("double coat", "strength of a clear varnish on top, in [0, 1]; default 0"),
        ("double coat_roughness", "in [0, 1]; default 0"),
        ("double sheen", "strength of the sheen of cloth, in [0, 1]; default 0"),
        ("double emission[3]", "radiance given off, linear RGB, each in [0, 1e30]; default 0"),
        (
            "const crt_pattern* metallic_map",
            "its luminance takes the place of metallic; default None",
        ),
        ("const crt_pattern* roughness_map", "and that of roughness"),
        ("const crt_pattern* emission_map", "takes the place of emission; default None"),
        ("const crt_pattern* bump", "its luminance raises the surface; default None"),
        (
            "const crt_pattern* normal_map",
            "Tilts the normal by its colours, from -1 at 0 to 1 at 1: red along u, green along "
            "v, blue out of the surface. Pictures count as they are, without the gamma of "
            "displays. Default None.",
        ),
        ("double bump_height", "scene units; default 0.1"),
        (
            "double density",
            "kg per cubic metre, for masses, >= 0; default 0: nothing is said of it",
        ),
    ),
    "crt_light": (
        ("int32_t type", "a LightType; default LightType.POINT"),
        ("double origin[3]", "default 0"),
        (
            "double pointing[3]",
            "default 0; a point light ignores it, others need a point other than `origin`",
        ),
        (
            "double color[3]",
            "linear RGB, >= 0, may pass 1; default 1. Of what has a surface it is the radiance",
        ),
        (
            "double angle",
            "spot: full angle of the cone, in (0, 2 pi]; 0 (default) is pi / 3. Parallel: how "
            "wide it is seen, in [0, pi], which softens shadows; default 0",
        ),
        (
            "double penumbra",
            "spot: width of its soft edge inwards, radians of the half angle; default pi / 36",
        ),
        (
            "double radius",
            "cylinder, sphere, disc: > 0, and 0 (default) is 1. Point: at 0 a point, above it a"
            " ball that softens shadows and is not seen",
        ),
        (
            "double falloff",
            "0 (default) or less: distance does not matter; else the light fades as falloff / "
            "D^2",
        ),
        ("double ambient", "share of the colour that every point gets, >= 0; default 0"),
        ("double edge_a[3]", "rectangle: not 0; default (1, 0, 0). Since 1.1, as what follows."),
        ("double edge_b[3]", "rectangle: not parallel to `edge_a`; default (0, 0, 1)"),
        ("int32_t visible", "sphere, disc, rectangle: whether it is seen itself; default 1"),
        ("int32_t two_sided", "disc, rectangle: whether it shines to both sides; default 0"),
        ("double scale", "environment: factor of the background's light; default 1"),
    ),
    "crt_camera": (
        ("int32_t projection", "a Projection; default Projection.PINHOLE"),
        ("double position[3]", "default (0, 0, -1)"),
        ("double pointing[3]", "the point looked at; default 0"),
        ("double fov", "vertical field of view, radians, in (0, pi); default pi / 3"),
        ("double roll", "radians; positive tips the picture's top to the right; default 0"),
        (
            "double aperture",
            "radius of the lens in thousandths of a scene unit; 0 (default): all is sharp",
        ),
        ("double focal_distance", "along the view direction to what is in focus, > 0; default 1"),
        ("int32_t aperture_shape", "a ApertureShape; default ApertureShape.CIRCLE"),
        ("int32_t reserved", "0"),
        (
            "double lens_radius",
            "Is the radius of the lens in scene units, instead of `aperture`: one of the two "
            "must be 0. Default 0. Since 1.1.",
        ),
        (
            "double section_normal[3]",
            "Cuts solids open if it is not 0: only what is against this normal of the plane {p "
            ": normal . p = offset |normal|} is there, and cuts are hatched. Default 0. Since "
            "1.1, as what follows.",
        ),
        ("double section_offset", "of the plane, in scene units; default 0"),
        (
            "double section_hatch",
            "distance of hatching lines, >= 0; default 0: by the size of the cut",
        ),
    ),
    "crt_background": (
        ("int32_t type", "a BackgroundType; default BackgroundType.SOLID"),
        ("double color[3]", "linear RGB, >= 0; default 1"),
        ("double alpha", "of the pixels where nothing is hit, in [0, 1]; default 1"),
        ("double horizon[3]", ""),
        ("double horizon_alpha", ""),
        ("double sky[3]", ""),
        ("double sky_alpha", ""),
        ("const crt_image* image", "its middle column is straight ahead (+z) at angle 0"),
        ("double angle", "turns the image about y, radians"),
        (
            "double sun[3]",
            "sky: the direction to the sun, not 0; default (-1, 1, -1). Since 1.1, as what "
            "follows.",
        ),
        ("double turbidity", "sky: how hazy the air is, in [2, 10]; default 3"),
        ("double scale", "sky: factor of all of its light; default 1"),
        ("double ground[3]", "sky: colour of what is seen below the horizon; default 0.3"),
        ("int32_t shines", "sky: whether it lights the scene, or is merely seen; default 1"),
        ("int32_t reserved", "must be 0"),
    ),
    "crt_settings": (
        ("int32_t width", "pixels, in [1, 65536]; default 640; width * height is at most 2^27"),
        ("int32_t height", "default 480"),
        ("int32_t supersampling", "n x n rays a pixel, in [1, 64]; default 1"),
        (
            "int32_t dof_samples",
            "points of the lens for each of them, in [1, 65536]; default 1: no lens",
        ),
        ("int32_t recursion_depth", "bounces after the camera's ray, in [0, 256]; default 3"),
        ("double gamma", "8-bit files hold clamp(c)^(1/gamma); in [0.1, 10]; default 2.2"),
        (
            "double min_weight",
            "rays with a smaller share of the pixel in every channel are dropped; default "
            "1/1024",
        ),
        ("int32_t falloff_model", "a FalloffModel; default FalloffModel.LIGHT"),
        (
            "int32_t show_clip",
            "not 0: pixels are red in 8-bit files that cannot say how bright a channel is; "
            "default 0",
        ),
        ("uint64_t seed", "of the random numbers; default 0"),
        ("const char* title", "this and the next go into the files; None (default) for none"),
        ("const char* author", ""),
        ("const char* date", ""),
        ("const char* notes", ""),
        ("int32_t precision", "a Precision; default Precision.STANDARD"),
        ("int32_t reserved", "must be 0"),
        (
            "double target_error",
            "Above 0, a pixel gets samples until it is this near the truth in 95 of 100 cases. "
            "1/255 is a step of 8 bits. In [0, 1]; default 0.",
        ),
        (
            "double time_budget",
            "Above 0, these are the seconds that tracing may take. It stops at the end of a "
            "pass. The first pass is always completed, so that there is a picture. In [0, 1e6];"
            " default 0.",
        ),
        (
            "double filter_width",
            "pixels across, of filters other than the box; in [1, 16]; default 3",
        ),
        (
            "int32_t min_samples",
            "of a pixel, with a target error or a time budget: a power of 2 in [4, 65536]; "
            "default 16",
        ),
        ("int32_t max_samples", "of a pixel, also a power of 2 in [4, 65536]; default 1024"),
        ("int32_t filter", "a PixelFilter; default PixelFilter.BOX"),
        ("int32_t reserved_2", "must be 0"),
        (
            "int32_t compat",
            "0 is the default. With 2015 the picture is formed as the program of that year "
            "formed it: lens, panoramas, places of the grid's samples, levels of 8-bit files. "
            "The other settings are left: those of a script of 2015 are gamma 1, "
            "FalloffModel.PATH and AmbientModel.LIGHT. See docs/compat.md.",
        ),
        ("int32_t reserved_3", "must be 0"),
        ("int32_t ambient_model", "a AmbientModel; default AmbientModel.SURFACE"),
        (
            "int32_t no_head_light",
            "A scene without lights is lit from the camera, unless this is not 0. Default 0.",
        ),
        (
            "int32_t indirect",
            "Light is followed over so many diffuse bounces, in [0, 64]. Above 0 there is no "
            "ambient light. Default 0. Since 1.1.",
        ),
        (
            "int32_t light_samples",
            "Each ray takes so many samples of what lights a point and has a size, in [1, "
            "1024]. Default 1. Since 1.1.",
        ),
        ("int32_t tone_map", "a ToneMap; default ToneMap.NONE. Since 1.1."),
        (
            "int32_t cutoff",
            "This is a Cutoff: what is seen along rays that recursion_depth ends; default "
            "Cutoff.BACKGROUND. Since 1.1.",
        ),
        (
            "double exposure",
            "8-bit files are brighter by so many stops: light counts 2^exposure times, before "
            "the tone map and gamma. Float files hold light as it is. In [-100, 100]; default "
            "0. Since 1.1.",
        ),
        (
            "double clamp",
            "Above 0, light that comes by bounces counts as this bright at most, and nothing is"
            " claimed of the picture's accuracy. Default 0. Since 1.1.",
        ),
        (
            "int32_t denoise",
            "Not 0: the finished picture is freed of noise, and nothing is claimed of its "
            "accuracy. Default 0. Since 1.1.",
        ),
        (
            "int32_t unit",
            "a Unit: what a scene unit is, which neither the geometry nor the picture knows; "
            "default Unit.M. Since 1.1.",
        ),
        (
            "int32_t frames",
            "of an animation, t = 0 to frames - 1, in [0, 1000000]; default 0: not said. Since "
            "1.1.",
        ),
        ("int32_t reserved_4", "must be 0"),
    ),
    "crt_mesh": (
        ("int32_t reserved", "must be 0"),
        ("const double* positions", "3 * vertex_count numbers, as for crt_mesh_create()"),
        ("uint64_t vertex_count", ""),
        ("const uint32_t* indices", "3 * triangle_count numbers, each below vertex_count"),
        ("uint64_t triangle_count", ""),
        (
            "const double* normals",
            "Has 3 * normal_count numbers: normals of any length. One that is 0 stands for that"
            " of the triangle. They are turned to the side of the triangle's own normal. "
            "Default None.",
        ),
        ("uint64_t normal_count", "default 0"),
        (
            "const uint32_t* normal_indices",
            "Has 3 * triangle_count numbers that name the normals of the triangles' corners. "
            "Default None: those of `indices`, and normal_count is vertex_count.",
        ),
        ("const double* uv", "2 * uv_count numbers, up to 1e30 in magnitude; default None"),
        ("uint64_t uv_count", "default 0"),
        (
            "const uint32_t* uv_indices",
            "name the (u, v) of the corners as normal_indices do normals",
        ),
        (
            "const crt_material* const* materials",
            "Has material_count materials, or None for those that `principled` has. They stand "
            "in the place of the default one: a material that the whole entity gets is put in "
            "their place. Default None.",
        ),
        ("uint64_t material_count", "default 0"),
        (
            "const uint32_t* material_of_triangle",
            "Has triangle_count numbers that name the triangles' materials. Default None: all "
            "have the first.",
        ),
        (
            "double smooth",
            "Is the largest angle in radians, up to pi, between triangles that are shaded as "
            "one round surface across their edge. Their normals are then computed, and those "
            "above left alone. 0 leaves all flat. Default -1: the normals above, if there are "
            "any.",
        ),
        (
            "const crt_principled* const* principled",
            "Has material_count principled materials, or None for those that `materials` has. "
            "It is an error if both have one of the same number, or neither. `materials` may be"
            " None if all are here. Default None: all are in `materials`. Since 1.1.",
        ),
    ),
    "crt_mesh_options": (
        (
            "int32_t fill",
            "Is a FillRule, or -1, the default: FillRule.EVEN_ODD for the triangles of a "
            "program, and for those of a file FillRule.NONZERO if all shells are turned "
            "outwards, but for cavities.",
        ),
        (
            "double weld",
            "Vertices up to this far from an earlier one become that one. It is from 0, the "
            "default, to 1e100.",
        ),
        (
            "double stitch",
            "Where a vertex of an open edge lies on another open edge, up to this distance, "
            "that edge is divided there, so that T-junctions are closed. It is from 0 (never), "
            "the default, to 1e100.",
        ),
    ),
    "crt_mesh_report": (
        ("int32_t fill", "the FillRule that holds"),
        ("uint64_t welded_vertices", "so many became others by `weld`"),
        ("uint64_t welded_triangles", "so many went, as two of their corners became one"),
        ("uint64_t stitched_vertices", "so many times an edge was divided by `stitch`"),
        ("uint64_t repeated_triangles", "so many have the corners of an earlier one"),
        ("double first_repeated[3]", "the middle of one of these"),
        ("uint64_t shells", "so many parts are not connected by edges"),
        (
            "uint64_t overlapping_shells",
            "So many shells lie in others, overlap them or pass through themselves, turned one "
            "way.",
        ),
        ("double first_overlap[3]", "a point near the first of these places"),
    ),
    "crt_measure_options": (
        ("int32_t threads", "as in crt_render_options; 0 means all"),
        ("double relative_width", "above 0 and at most 1; 0 means what each function says"),
        ("double seconds", "ends the search with what is known then; 0 or INFINITY: no such end"),
        (
            "crt_poll_fn poll",
            "None, or a callback that may cancel: the call then ends with Status.CANCELLED. Any"
            " of the threads that work may call it, one at a time.",
        ),
        ("void* poll_user", ""),
    ),
    "crt_mass": (
        ("uint32_t reserved", "0"),
        ("crt_interval volume", "parts that overlap count once"),
        (
            "crt_interval area",
            "of the surface, without what is within the solid; INFINITY above while a place of "
            "it is so narrow that nothing bounds it",
        ),
        (
            "crt_interval centroid[3]",
            "its width is relative to half of the longest side of the box",
        ),
        (
            "crt_interval inertia[6]",
            "About the centroid: xx, yy, zz, xy, yz and zx. The last three are the integrals of"
            " -x y, -y z and -z x. Widths are relative to the volume times the square of half "
            "of the longest side of the box around the solid.",
        ),
    ),
    "crt_prepare_options": (
        ("uint32_t reserved", "0"),
        (
            "crt_poll_fn poll",
            "None, or a callback that may cancel. Preparing then ends with Status.CANCELLED, "
            "within 0.1 s in scenes of up to a million primitives. Any of the threads that work"
            " may call it.",
        ),
        ("void* poll_user", ""),
        (
            "uint64_t max_primitives",
            "This is the most primitives that the scene may have. With more, preparing ends "
            "with Status.LIMIT before it takes any memory. 0 means as many as the memory of the"
            " machine (or container) may be enough for. It counts 1350 bytes for each, or 2700 "
            "in the exact tier, as the largest primitives take; lone spheres take 600. There "
            "can never be more than 33554432. A solid of several primitives, or a mesh, counts "
            "once if one entity is placed 16 times or more, and each of its uses as one "
            "primitive of 512 bytes.",
        ),
        (
            "crt_prepared* previous",
            "None, or the scene that parts are taken from, as crt_scene_prepare_from() does. "
            "Since 1.1.",
        ),
    ),
    "crt_script_options": (
        (
            "int32_t allow_outside_files",
            "not 0: files outside its directory and the resource directories too",
        ),
        (
            "const char* const* resource_directories",
            "where files are looked for after the script's directory",
        ),
        ("uint64_t resource_directory_count", ""),
        ("double t", "the frame of an animation: the script's constant `t`"),
        ("const char* const* variable_names", "top-level variables set from outside ..."),
        (
            "const char* const* variable_values",
            "... to these expressions of the language, such as \"18\"",
        ),
        ("uint64_t variable_count", ""),
        (
            "const char* const* setting_names",
            "attributes of Settings that win over the script's ...",
        ),
        ("const char* const* setting_values", "... with these expressions"),
        ("uint64_t setting_count", ""),
        ("uint64_t max_steps", "expressions evaluated; 0: 20 million"),
        ("uint64_t max_entities", "0: 10 million"),
        ("uint64_t max_call_depth", "macros within macros, at most 1000; 0: 256"),
        ("uint64_t max_list_length", "0: 10 million"),
        ("uint64_t max_string_bytes", "0: 16 MiB"),
        ("uint64_t max_memory_bytes", "of all lists and strings together, about; 0: 2 GiB"),
        ("uint64_t max_source_bytes", "of the script and its imports; 0: 64 MiB"),
        ("uint64_t max_errors", "reported before giving up; 0: 20"),
        ("crt_open_file_fn open_file", "None: files come from the file system"),
        ("void* open_file_user", ""),
        ("crt_print_fn print", "None: what is printed goes nowhere"),
        ("void* print_user", ""),
        ("crt_poll_fn poll", "None: only the limits end a script"),
        ("void* poll_user", ""),
        (
            "int32_t compat",
            "0: as the script's Settings say; 2015: it is a script of that year "
            "(docs/compat.md)",
        ),
        ("int32_t reserved", "0"),
        (
            "uint64_t max_image_pixels",
            "Pixels that all pictures have together that the script or its meshes name, and "
            "heights of height fields. Headers of files say it before anything is decoded. 0: "
            "what a quarter of the process's memory is enough for at 16 bytes each, and at most"
            " 2^27. Since 1.1.",
        ),
    ),
    "crt_diagnostic": (
        ("int32_t severity", "a Severity"),
        ("int32_t status", "a Status: what kind of error"),
        ("int32_t line", ""),
        ("int32_t column", ""),
        ("int32_t length", "of the marked piece, in code points"),
        ("const char* message", ""),
        ("const char* file", ""),
        ("const char* source_line", "the text of that line, without its end"),
        ("uint64_t call_count", "macro calls that led there"),
    ),
    "crt_diagnostic_call": (
        ("int32_t line", "where the macro was called"),
        ("int32_t column", ""),
        ("int32_t reserved", ""),
        ("const char* name", "of the macro"),
        ("const char* file", ""),
    ),
    "crt_render_options": (
        ("int32_t threads", "at most; 0: what the calling TBB arena has; 1: none is started"),
        (
            "int32_t region_x",
            "renders a part of the picture only, from the top left; the image has its size",
        ),
        ("int32_t region_y", ""),
        ("int32_t region_width", "region_width and region_height 0: all of it"),
        ("int32_t region_height", ""),
        ("uint64_t seed", "takes the place of the settings' seed; 0: the settings'"),
        ("crt_progress_fn progress", ""),
        ("void* progress_user", ""),
        ("crt_log_fn log", ""),
        ("void* log_user", ""),
        (
            "int32_t passes",
            "above 0: renders so many (crt_render_stats.passes), whatever the time budget",
        ),
        (
            "uint32_t aovs",
            "bits CRT_AOV_*: what the image gets beside its colours, which stay the same",
        ),
        (
            "const char* checkpoint",
            "None, or the path of the file that keeps an unfinished picture which is rendered "
            "by passes (target error, time budget, number of passes). The next render with the "
            "same checkpoint continues from it, be it in another process, to the same picture "
            "as without the break. The file is written within the first ten seconds, then every"
            " few seconds, and at the end, also when the render is cancelled or fails. It is "
            "written whole or not at all, and never removed. If writing fails, `log` gets a "
            "message and the render continues. A time budget counts from the break on. A "
            "checkpoint of another picture is Status.INVALID_ARGUMENT. The settings and the "
            "light of up to 1024 samples show which picture it is of. The call reads this text "
            "before it returns.",
        ),
        (
            "uint64_t max_ray_steps",
            "This is the most things that a single ray may be tested against: objects, and "
            "primitives of CSG objects, whose boxes it passes. It is checked after every 1024 "
            "of them. A ray that takes more ends the render with Status.LIMIT. 0 means 4194304,"
            " about a second's work; a ray through an ordinary scene takes some hundred.",
        ),
    ),
    "crt_render_stats": (
        ("int32_t threads", "that were allowed to work on it"),
        ("uint64_t pixels", ""),
        ("uint64_t camera_rays", ""),
        ("uint64_t shadow_rays", ""),
        ("uint64_t reflection_rays", ""),
        ("uint64_t refraction_rays", ""),
        ("uint64_t rays_below_min_weight", "not traced: below the settings' min_weight"),
        ("uint64_t rays_beyond_depth", "not traced: the recursion depth was reached"),
        (
            "uint64_t samples_over_ray_bound",
            "camera samples that reached 65536 rays and dropped the rest",
        ),
        ("uint64_t intersection_tests", "rays against primitives or CSG objects"),
        ("uint64_t interval_events", "crossings sorted and flipped inside CSG objects"),
        ("uint64_t media_lookups", ""),
        ("uint64_t media_changes", ""),
        ("uint64_t pattern_lookups", ""),
        ("uint64_t lens_samples", ""),
        ("double prepare_seconds", "wall-clock time, as is the next"),
        ("double trace_seconds", ""),
        ("uint64_t escalations", "decisions of Precision.EXACT that took exact arithmetic"),
        (
            "uint64_t primitive_bytes",
            "primitives in their places, and which of their faces coincide",
        ),
        (
            "uint64_t csg_bytes",
            "how they are combined, and a bounding volume hierarchy for each CSG object",
        ),
        ("uint64_t tree_bytes", "the bounding volume hierarchy over all objects"),
        ("uint64_t material_bytes", "materials, and pictures that were converted to linear light"),
        ("uint64_t samples_min", "of a pixel"),
        ("double samples_mean", ""),
        ("uint64_t samples_max", ""),
        ("int32_t passes", "that were rendered; 0 without target error and time budget"),
        ("int32_t reserved", "0"),
        ("double half_width_rms", "the root of the mean square"),
        ("double half_width_95", "what 95 of 100 pixels are within"),
        ("double half_width_max", ""),
        ("uint64_t pixels_unresolved", "their half-width is above the target error"),
        (
            "double unseen_share",
            "share of a pixel: what covers more has been seen in 95 of 100 cases",
        ),
        (
            "double cutoff_mean",
            "light that a pixel may have lost by cutting off paths, if all light were white",
        ),
        ("double cutoff_max", ""),
        (
            "uint64_t undecided",
            "how often interval arithmetic left open what a ray crosses of an implicit solid, "
            "so that the signs on both sides decided it",
        ),
    ),
    "crt_write_options": (
        (
            "int32_t reproducible",
            "not 0: leaves out what changes from run to run (the render time)",
        ),
        (
            "int32_t colors_only",
            "not 0: leaves out all channels beside the colours, which only exr holds",
        ),
    ),
    "crt_custom": (
        (
            "uint32_t face_count",
            "how many faces there are, from 1 to 65536; crt_hit_parts() says which was hit",
        ),
        (
            "double lower[3]",
            "what the solid lies within; rays that miss this box are not asked about",
        ),
        ("double upper[3]", "above `lower` by at least 1e-100"),
        ("crt_custom_crossings_fn crossings", ""),
        ("crt_custom_point_fn point", ""),
        ("crt_release_fn release", "None, or called when nothing uses the solid any more"),
        ("void* user", "is handed to the functions"),
        ("const char* name", "what messages call the solid; None: \"a custom shape\""),
    ),
    "crt_farm_options": (
        (
            "int32_t has_frames",
            "not 0: renders the whole t from first_frame to last_frame; 0: one picture, at the "
            "script options' t",
        ),
        ("int32_t first_frame", "of an animation"),
        ("int32_t last_frame", "is rendered, too"),
        ("int32_t tasks", "in [1, 1000000]; 0: as many as last `least_seconds` each"),
        (
            "int32_t tile_width",
            "pixels across of the tiles that pictures are cut into; 0: they are cut where that "
            "makes the tasks' costs equal",
        ),
        ("int32_t tile_height", "pixels down; 0 if tile_width is"),
        ("int32_t reserved", "0"),
        ("double least_seconds", "that a task may take on one core; 0: 60"),
        (
            "const crt_script_options* script",
            "None, or what the script gets. Of the limits max_steps and max_image_pixels count."
            " `print` and `poll` are not called. allow_outside_files and open_file are "
            "Status.INVALID_ARGUMENT, as the job has all files of the script.",
        ),
        (
            "const crt_render_options* render",
            "None, or what the tasks get: `seed`, `passes`, `max_ray_steps` and `aovs`. "
            "Planning uses `threads` and `progress`, which is first 0 and never 1. A region and"
            " a checkpoint are Status.INVALID_ARGUMENT.",
        ),
        ("uint64_t max_primitives", "see crt_prepare_options"),
    ),
    "crt_farm_job": (
        ("int32_t tasks", "their numbers go from 0 to tasks - 1"),
        ("int32_t has_frames", "1: it is an animation; 0: one picture"),
        ("int32_t first_frame", "0 if it is one picture"),
        ("int32_t last_frame", ""),
        ("int32_t width", "of the pictures"),
        ("int32_t height", ""),
        ("int32_t passes", "see crt_render_options; a time budget becomes such a number"),
        (
            "int32_t has_channels",
            "1: there are channels beside the colours, so that pictures are EXR",
        ),
        ("int32_t reserved", "0"),
        ("double seconds", "estimated, of one core, for all tasks"),
        ("double longest_seconds", "estimated, for the task that takes longest"),
    ),
    "crt_farm_work_options": (
        ("int32_t threads", "at most; 0: what the calling TBB arena has"),
        ("crt_progress_fn progress", "gets the share of the task that is done"),
        ("void* progress_user", ""),
    ),
    "crt_farm_merge_options": (
        ("int32_t reserved", "0"),
        (
            "const char* output",
            "None: the pictures go into the job's folder. Else it is the path of the picture. "
            "For frames a run of # or a %04d in its name becomes the number, which else goes "
            "before the ending.",
        ),
        ("const int32_t* skip", "frames to leave out, such as those that were merged before"),
        ("uint64_t skip_count", ""),
        ("crt_farm_report_fn report", "is called at the end, for all that was found"),
        ("void* report_user", ""),
        ("crt_poll_fn poll", "is asked between parts"),
        ("void* poll_user", ""),
    ),
    "crt_farm_progress": (
        ("int32_t waiting", "how many tasks nobody works on"),
        ("int32_t running", "how many somebody works on, or did within the last minute"),
        ("int32_t lost", "whose workers have not been heard of for over a minute"),
        ("int32_t done", "whose parts are there"),
        ("int32_t reserved", "0"),
        ("double share", "of the work that is done, estimated, in [0, 1]"),
        ("double seconds_spent", "that all tasks done have taken together"),
        ("double seconds_left", "estimated, for one worker"),
    ),
}
