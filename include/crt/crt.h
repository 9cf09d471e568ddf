/**
 * @file
 * This header is the C interface of CRT: solids, scenes, pictures and ray queries for programs in
 * any language.
 *
 * These rules hold for every function:
 *
 * - **Status.** A function that can fail returns a crt_status. It writes its result through its
 *   last parameter, which it leaves untouched on failure. crt_error_message() then says to the
 *   calling thread what was wrong. Nothing throws, ends the process or prints.
 *   CRT_ERROR_INVALID_ARGUMENT is returned for NULL where something is required, for an unknown
 *   value of an enumeration and for a number that is not finite. Any function may return
 *   CRT_ERROR_OUT_OF_MEMORY and CRT_ERROR_INTERNAL (a fault of CRT).
 * - **Handles** (crt_entity, crt_scene, ...) are counted. A function that hands out a handle gives
 *   one reference, which the caller must release. `*_retain` adds a reference and returns its
 *   argument. `*_release` drops one, from any thread. Both take NULL. A container holds what goes
 *   into it, so the order of releasing does not matter.
 * - **Structs** that may grow begin with `struct_size`. Call their `crt_*_init(&s, sizeof s)` to
 *   fill in the defaults, then change what you like. Fields beyond the size that you pass have
 *   their defaults.
 * - **Threads.** Each group of functions says who may call it. "Any thread" has no restriction.
 *   "One at a time" is for a scene that is being put together: only one thread may use it at any
 *   moment. "Shared" is for what is immutable: any number of threads may use it at once. A thread
 *   that calls needs a stack of 256 kB. On less than 1.2 MB, macros and expressions of scripts nest
 *   less deeply before they are CRT_ERROR_LIMIT.
 * - **Conventions.** Space is left-handed: x to the right, y up, z into the screen. Vectors are
 *   double[3]. Colours are double[3], linear RGB. Transforms are double[12], the three rows of a
 *   3x4 affine matrix (linear part, then translation). Angles are radians. Texts are UTF-8 and end
 *   with a 0 byte unless a length is passed. Coordinates and sizes lie between 1e-100 and 1e100 in
 *   magnitude. crt_empty_create() makes what has no size.
 *
 * This program renders a sphere in 20 lines:
 * @code{.c}
 * #include <crt/crt.h>
 * #include <stdio.h>
 *
 * int main(void) {
 *   const double center[3] = {0, 0, 2};
 *   crt_entity *sphere = NULL;
 *   crt_scene *scene = NULL;
 *   crt_light light;
 *   crt_prepared *prepared = NULL;
 *   crt_image *image = NULL;
 *   crt_light_init(&light, sizeof light);
 *   light.origin[1] = 3;
 *   const int failed = crt_sphere_create(center, 1, &sphere) || crt_scene_create(&scene) ||
 *                      crt_scene_add_entity(scene, sphere) || crt_scene_add_light(scene, &light) ||
 *                      crt_scene_prepare(scene, &prepared) || crt_render(prepared, NULL, &image) ||
 *                      crt_image_write(image, "sphere.png");
 *   if (failed) fprintf(stderr, "%s\n", crt_error_message());
 *   crt_image_release(image);
 *   crt_prepared_release(prepared);
 *   crt_scene_release(scene);
 *   crt_entity_release(sphere);
 *   return failed;
 * }
 * @endcode
 */
#ifndef CRT_CRT_H
#define CRT_CRT_H

#include <stddef.h>
#include <stdint.h>

/** Marks a symbol that the library exports. */
#if defined(__GNUC__)
#define CRT_API __attribute__((visibility("default")))
#else
#define CRT_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- versions and errors -------------------------------------------------------------------- */

/** @defgroup errors Versions and errors
 * Threads: Any thread.
 * @{ */

/**
 * This is the version of this header. A program runs with the library of this or any later minor
 * version.
 */
#define CRT_VERSION_MAJOR 1
/** This number grows with every release that adds something. */
#define CRT_VERSION_MINOR 1
/** This number grows with every other release. */
#define CRT_VERSION_PATCH 0

/** Says how a call ended. Later versions may add values. */
typedef enum crt_status {
  CRT_OK = 0,
  CRT_ERROR_INVALID_ARGUMENT, /**< a value that is NULL, not finite, out of its range or unknown */
  CRT_ERROR_SCRIPT,           /**< a script is wrong; the diagnostics say where */
  CRT_ERROR_IO,               /**< a file could not be found, read, understood or written */
  CRT_ERROR_UNSUPPORTED,      /**< this library or machine cannot do it */
  CRT_ERROR_LIMIT,            /**< a limit was passed, of the options or of the library */
  CRT_ERROR_CANCELLED,        /**< a callback or crt_job_cancel() stopped it */
  CRT_ERROR_OUT_OF_MEMORY,
  CRT_ERROR_INTERNAL /**< a fault of CRT: please report it */
} crt_status;

/** Returns the version of the library: major << 16 | minor << 8 | patch. */
CRT_API uint32_t crt_version(void);

/**
 * Returns what went wrong in the calling thread's last call that failed, or "" if none has failed.
 * The text is valid until that thread's next failing call. Long messages are cut at about 2000
 * bytes.
 */
CRT_API const char* crt_error_message(void);

/**
 * Returns a name for a status, such as "ok" or "invalid argument". It is "unknown" for a number
 * that is no status.
 */
CRT_API const char* crt_status_string(crt_status status);

/**
 * Returns the number with which a callback stopped the last call of this thread that returned
 * CRT_ERROR_CANCELLED. It is 0 if crt_job_cancel() stopped it or if there was no such call. For a
 * job, ask after crt_job_wait().
 */
CRT_API int32_t crt_cancel_value(void);

/**
 * Is called now and then while something takes long (for a script every few thousand steps). A
 * return value other than 0 cancels it.
 */
typedef int (*crt_poll_fn)(void* user);

/** @} */

/* ---- handles -------------------------------------------------------------------------------- */

/** @defgroup handles Handles
 * Threads: Any thread may retain and release.
 * @{ */

/** A crt_entity is something in a scene: a primitive, or several combined. It is immutable. */
typedef struct crt_entity crt_entity;
/** A crt_scene is the description of a picture, which you put together. */
typedef struct crt_scene crt_scene;
/** A crt_prepared is a scene made ready for rays. It is immutable. */
typedef struct crt_prepared crt_prepared;
/** A crt_job is a render that runs on threads of its own. */
typedef struct crt_job crt_job;
/** A crt_image is a picture. It is immutable. */
typedef struct crt_image crt_image;
/** A crt_buffer holds bytes that the library made. It is immutable. */
typedef struct crt_buffer crt_buffer;
/** A crt_diagnostics is a list of messages about a script. It is immutable. */
typedef struct crt_diagnostics crt_diagnostics;
/** A crt_profile is a region of a plane, which you put together of contours. */
typedef struct crt_profile crt_profile;
/** A crt_section is what a plane cuts out of a solid. It is immutable. Since 1.1. */
typedef struct crt_section crt_section;
/** A crt_surface_mesh is the surface of a solid as triangles. It is immutable. Since 1.1. */
typedef struct crt_surface_mesh crt_surface_mesh;

/** Adds a reference to an entity and returns it. */
CRT_API crt_entity* crt_entity_retain(crt_entity* entity);
/** Drops a reference to an entity. */
CRT_API void crt_entity_release(crt_entity* entity);
/** Adds a reference to a scene and returns it. It is the same scene, not a copy. */
CRT_API crt_scene* crt_scene_retain(crt_scene* scene);
/** Drops a reference to a scene. */
CRT_API void crt_scene_release(crt_scene* scene);
/** Adds a reference to a prepared scene and returns it. */
CRT_API crt_prepared* crt_prepared_retain(crt_prepared* prepared);
/** Drops a reference to a prepared scene. Jobs that render it hold their own. */
CRT_API void crt_prepared_release(crt_prepared* prepared);
/** Adds a reference to a job and returns it. */
CRT_API crt_job* crt_job_retain(crt_job* job);
/**
 * Drops a reference to a job. Dropping the last reference to a job that still runs cancels it and
 * waits for its threads.
 */
CRT_API void crt_job_release(crt_job* job);
/** Adds a reference to an image and returns it. */
CRT_API crt_image* crt_image_retain(crt_image* image);
/** Drops a reference to an image, and with the last one its pixels. */
CRT_API void crt_image_release(crt_image* image);
/** Adds a reference to a buffer and returns it. */
CRT_API crt_buffer* crt_buffer_retain(crt_buffer* buffer);
/** Drops a reference to a buffer, and with the last one its bytes. */
CRT_API void crt_buffer_release(crt_buffer* buffer);
/** Adds a reference to diagnostics and returns it. */
CRT_API crt_diagnostics* crt_diagnostics_retain(crt_diagnostics* diagnostics);
/** Drops a reference to diagnostics, and with the last one all their texts. */
CRT_API void crt_diagnostics_release(crt_diagnostics* diagnostics);

/** Adds a reference to a section and returns it. Since 1.1. */
CRT_API crt_section* crt_section_retain(crt_section* section);
/** Drops a reference to a section, and with the last one its contours. Since 1.1. */
CRT_API void crt_section_release(crt_section* section);
/** Adds a reference to a profile and returns it. Since 1.1. */
CRT_API crt_profile* crt_profile_retain(crt_profile* profile);
/** Removes a reference. Since 1.1. */
CRT_API void crt_profile_release(crt_profile* profile);

/** Adds a reference to a surface mesh and returns it. Since 1.1. */
CRT_API crt_surface_mesh* crt_surface_mesh_retain(crt_surface_mesh* mesh);
/** Removes a reference. The last one ends what the mesh has lent. Since 1.1. */
CRT_API void crt_surface_mesh_release(crt_surface_mesh* mesh);

/** @} */

/* ---- plain values --------------------------------------------------------------------------- */

/** @defgroup values Materials, lights, cameras, backgrounds, settings
 * These are plain structs in your memory. A function copies what it takes of them, and retains
 * images. `crt_*_init` fill in the defaults, never beyond `struct_size` bytes. A size that does not
 * hold `struct_size` itself is an error. Threads: Any thread.
 *
 * @code{.c}
 * crt_material glass;
 * crt_material_init(&glass, sizeof glass);
 * glass.color[0] = glass.color[1] = glass.color[2] = 1;
 * glass.transparency = 0.95;
 * glass.refractive_index = 1.5;
 * crt_entity_with_material(sphere, &glass, &glass_sphere);
 * @endcode
 * @{ */

/** Lists the kinds of patterns. */
typedef enum crt_pattern_type {
  CRT_PATTERN_CHECKER = 0, /**< cubes whose edges are `scale` long */
  CRT_PATTERN_STRIPES,  /**< bands of equal width across `direction`, one of each colour in `scale`
                         */
  CRT_PATTERN_GRADIENT, /**< from color_a to color_b and back along `direction` within `scale` */
  CRT_PATTERN_NOISE,    /**< clouds: gradient noise of `octaves` octaves */
  CRT_PATTERN_MARBLE,   /**< veins: a wave along `direction`, shifted by noise times `turbulence` */
  CRT_PATTERN_WOOD,     /**< rings about the line through `offset` along `direction` */
  CRT_PATTERN_IMAGE     /**< `image` laid over the surface by its (u, v) */
} crt_pattern_type;

/** Lists how a picture is laid over a surface. All but the first work in space. */
typedef enum crt_image_mapping {
  CRT_MAPPING_UV = 0,      /**< by the surface's own (u, v) */
  CRT_MAPPING_PLANAR,      /**< along `direction`, as seen from where that comes from */
  CRT_MAPPING_CYLINDRICAL, /**< once around the axis `direction`, and up along it */
  CRT_MAPPING_CUBIC        /**< planar, along the axis that is nearest to the normal */
} crt_image_mapping;

/** Is the colour at a place of a smooth pattern. The layout is fixed for ever: 40 bytes. */
typedef struct crt_color_stop {
  double position; /**< in [0, 1]: 0 is where color_a would be, and 1 where color_b would be */
  double color[3]; /**< linear RGB, each in [0, 1e30] */
  double alpha;    /**< in [0, 1] */
} crt_color_stop;

/**
 * Describes colours that vary over a surface or through space. A pattern lives in the space of the
 * entity that wears it.
 */
typedef struct crt_pattern {
  uint32_t struct_size;
  int32_t type;      /**< a crt_pattern_type */
  double color_a[3]; /**< linear RGB, each in [0, 1e30] */
  double alpha_a;    /**< in [0, 1]; what is missing to 1 adds to the material's transparency */
  double color_b[3];
  double alpha_b;
  double direction[3];    /**< any length but 0 */
  double offset[3];       /**< moves the pattern; scene units */
  double scale;           /**< of one period, in scene units; > 0 */
  double turbulence;      /**< >= 0 */
  int32_t octaves;        /**< in [1, 16] */
  int32_t reserved;       /**< 0 */
  const crt_image* image; /**< of CRT_PATTERN_IMAGE alone */
  double repeat_u;        /**< how often the image repeats across the surface; > 0 */
  double repeat_v;
  const struct crt_pattern* pattern_a; /**< takes the place of color_a; default NULL */
  /** Takes the place of color_b; default NULL. At most 5 patterns lie within one another. */
  const struct crt_pattern* pattern_b;
  /** Takes the place of both colours of gradient, noise, marble and wood: 2 to 64 stops at
   * ascending positions. Two at one position make an edge. */
  const crt_color_stop* colors;
  uint64_t color_count; /**< of `colors`; default 0 */
  /** Says how the image is laid over the surface (crt_image_mapping). All but CRT_MAPPING_UV take
   * `direction`, `offset` and `scale`, the width and height of the picture. */
  int32_t mapping;
  int32_t reserved_2; /**< must be 0 */
} crt_pattern;

/** Describes what a surface is made of. */
typedef struct crt_material {
  uint32_t struct_size;
  int32_t reserved; /**< 0 */
  double color[3];  /**< linear RGB, each in [0, 1e30]; above 1 it brightens; default 0.5 */
  double alpha;     /**< in [0, 1]; what is missing to 1 adds to the transparency; default 1 */
  const crt_pattern* pattern; /**< takes the place of the colour; default NULL */
  double reflectivity;        /**< share of light mirrored, in [0, 1]; default 0 */
  double transparency;        /**< share of light let through, times the colour at each surface, in
                                 [0, 1]; default 0 */
  double refractive_index;    /**< of the inside, in [0.01, 100]; default 1 */
  double diffuse;       /**< >= 0, or -1 (default) for max(0, 1 - reflectivity - transparency) */
  double specular;      /**< strength of the highlight, >= 0; default 0 */
  double shininess;     /**< exponent of the highlight's cosine, >= 0; default 3 */
  double absorption[3]; /**< inside, per scene unit and channel (Beer-Lambert), >= 0; default 0 */
  const crt_pattern* bump; /**< its luminance raises the surface; default NULL */
  double bump_height;      /**< scene units; default 0.1 */
  /** Is the radiance that the surface gives off, linear RGB, each in [0, 1e30]; default 0. Since
   * 1.1. */
  double emission[3];
  double density; /**< kg per cubic metre, for masses (crt_entity_density()), >= 0; default 0, which
                     says nothing of it. Since 1.1. */
} crt_material;

/** Describes what a surface is made of, in the words of glTF, OpenPBR and Blender: a mixture of a
 * metal and a dielectric. A white one sends back all light. Since 1.1. */
typedef struct crt_principled {
  uint32_t struct_size;
  int32_t reserved;           /**< 0 */
  double color[3];            /**< what is scattered, mirrored by metal or let through: linear RGB,
                                 each in [0, 1e30]; default 0.8 */
  const crt_pattern* pattern; /**< takes the place of the colour; default NULL */
  double metallic;            /**< share that is a metal, in [0, 1]; default 0 */
  double roughness;           /**< 0 for a mirror or clear glass, to 1; default 0.5 */
  double refractive_index;    /**< of the inside, in [0.01, 100]; default 1.5 */
  double transmission;        /**< share of what is no metal that lets light through, in [0, 1];
                                 default 0 */
  double absorption[3];  /**< inside, per scene unit and channel (Beer-Lambert), >= 0; default 0 */
  double coat;           /**< strength of a clear varnish on top, in [0, 1]; default 0 */
  double coat_roughness; /**< in [0, 1]; default 0 */
  double sheen;          /**< strength of the sheen of cloth, in [0, 1]; default 0 */
  double emission[3];    /**< radiance given off, linear RGB, each in [0, 1e30]; default 0 */
  const crt_pattern* metallic_map;  /**< its luminance takes the place of metallic; default NULL */
  const crt_pattern* roughness_map; /**< and that of roughness */
  const crt_pattern* emission_map;  /**< takes the place of emission; default NULL */
  const crt_pattern* bump;          /**< its luminance raises the surface; default NULL */
  /** Tilts the normal by its colours, from -1 at 0 to 1 at 1: red along u, green along v, blue out
   * of the surface. Pictures count as they are, without the gamma of displays. Default NULL. */
  const crt_pattern* normal_map;
  double bump_height; /**< scene units; default 0.1 */
  double density;     /**< kg per cubic metre, for masses, >= 0; default 0: nothing is said of it */
} crt_principled;

/** Lists the kinds of lights. All cast shadows. */
typedef enum crt_light_type {
  CRT_LIGHT_POINT = 0, /**< shines from `origin` in all directions */
  CRT_LIGHT_PARALLEL,  /**< shines along `origin` to `pointing` everywhere, like a sun */
  CRT_LIGHT_SPOT,      /**< shines from `origin` into a cone about the direction to `pointing` */
  CRT_LIGHT_CYLINDER,  /**< parallel rays that fill a cylinder from `origin` towards `pointing` */
  CRT_LIGHT_SPHERE, /**< a sphere about `origin` that shines outwards. Since 1.1, as what follows */
  CRT_LIGHT_DISC,   /**< a disc about `origin` that shines towards `pointing` */
  CRT_LIGHT_RECTANGLE,  /**< a parallelogram from `origin` along `edge_a` and `edge_b`; it shines
                          along the cross product of these */
  CRT_LIGHT_ENVIRONMENT /**< the background, from all directions */
} crt_light_type;

/** Describes a light. */
typedef struct crt_light {
  uint32_t struct_size;
  int32_t type;       /**< a crt_light_type; default CRT_LIGHT_POINT */
  double origin[3];   /**< default 0 */
  double pointing[3]; /**< default 0; a point light ignores it, others need a point other than
                         `origin` */
  double color[3];    /**< linear RGB, >= 0, may pass 1; default 1. Of what has a surface it is the
                         radiance */
  double angle;    /**< spot: full angle of the cone, in (0, 2 pi]; 0 (default) is pi / 3. Parallel:
                      how wide it is seen, in [0, pi], which softens shadows; default 0 */
  double penumbra; /**< spot: width of its soft edge inwards, radians of the half angle; default pi
                      / 36 */
  double radius;  /**< cylinder, sphere, disc: > 0, and 0 (default) is 1. Point: at 0 a point, above
                     it a ball that softens shadows and is not seen */
  double falloff; /**< 0 (default) or less: distance does not matter; else the light fades as
                     falloff / D^2 */
  double ambient; /**< share of the colour that every point gets, >= 0; default 0 */
  double edge_a[3];  /**< rectangle: not 0; default (1, 0, 0). Since 1.1, as what follows. */
  double edge_b[3];  /**< rectangle: not parallel to `edge_a`; default (0, 0, 1) */
  int32_t visible;   /**< sphere, disc, rectangle: whether it is seen itself; default 1 */
  int32_t two_sided; /**< disc, rectangle: whether it shines to both sides; default 0 */
  double scale;      /**< environment: factor of the background's light; default 1 */
} crt_light;

/** Says how a camera maps directions to the picture. */
typedef enum crt_projection {
  CRT_PROJECTION_PINHOLE = 0,
  CRT_PROJECTION_SPHERICAL,
  CRT_PROJECTION_CYLINDRICAL,
  CRT_PROJECTION_ORTHOGRAPHIC
} crt_projection;

/** Lists the shapes of the lens opening. */
typedef enum crt_aperture_shape {
  CRT_APERTURE_CIRCLE = 0,
  CRT_APERTURE_UNIFORM, /**< the whole square around the circle */
  CRT_APERTURE_GAUSSIAN,
  CRT_APERTURE_TRIANGLE,
  CRT_APERTURE_SQUARE,
  CRT_APERTURE_PENTAGON,
  CRT_APERTURE_HEXAGON,
  CRT_APERTURE_OCTAGON,
  CRT_APERTURE_LINE
} crt_aperture_shape;

/** Describes where the picture is seen from. */
typedef struct crt_camera {
  uint32_t struct_size;
  int32_t projection; /**< a crt_projection; default CRT_PROJECTION_PINHOLE */
  double position[3]; /**< default (0, 0, -1) */
  double pointing[3]; /**< the point looked at; default 0 */
  double fov;         /**< vertical field of view, radians, in (0, pi); default pi / 3 */
  double roll;        /**< radians; positive tips the picture's top to the right; default 0 */
  double
      aperture; /**< radius of the lens in thousandths of a scene unit; 0 (default): all is sharp */
  double focal_distance;  /**< along the view direction to what is in focus, > 0; default 1 */
  int32_t aperture_shape; /**< a crt_aperture_shape; default CRT_APERTURE_CIRCLE */
  int32_t reserved;       /**< 0 */
  /** Is the radius of the lens in scene units, instead of `aperture`: one of the two must be 0.
   * Default 0. Since 1.1. */
  double lens_radius;
  /** Cuts solids open if it is not 0: only what is against this normal of the plane {p : normal . p
   * = offset |normal|} is there, and cuts are hatched. Default 0. Since 1.1, as what follows. */
  double section_normal[3];
  double section_offset; /**< of the plane, in scene units; default 0 */
  double section_hatch;  /**< distance of hatching lines, >= 0; default 0: by the size of the cut */
} crt_camera;

/** Lists the kinds of backgrounds. */
typedef enum crt_background_type {
  CRT_BACKGROUND_SOLID = 0,   /**< `color` in every direction */
  CRT_BACKGROUND_GRADIENT,    /**< from `horizon` (level) to `sky` (straight up and down) */
  CRT_BACKGROUND_SPHERICAL,   /**< `image` all around, equirectangular */
  CRT_BACKGROUND_CYLINDRICAL, /**< `image` all around on a cylinder */
  CRT_BACKGROUND_EQUAL_AREA,  /**< `image` all around; the height from the top is (1 - y) / 2 of the
                                 unit direction */
  CRT_BACKGROUND_SKY          /**< a clear sky with its sun, which are lights, too. Since 1.1. */
} crt_background_type;

/** Describes what a ray that hits nothing sees. */
typedef struct crt_background {
  uint32_t struct_size;
  int32_t type;    /**< a crt_background_type; default CRT_BACKGROUND_SOLID */
  double color[3]; /**< linear RGB, >= 0; default 1 */
  double alpha;    /**< of the pixels where nothing is hit, in [0, 1]; default 1 */
  double horizon[3];
  double horizon_alpha;
  double sky[3];
  double sky_alpha;
  const crt_image* image; /**< its middle column is straight ahead (+z) at angle 0 */
  double angle;           /**< turns the image about y, radians */
  double sun[3];    /**< sky: the direction to the sun, not 0; default (-1, 1, -1). Since 1.1, as
                       what follows. */
  double turbidity; /**< sky: how hazy the air is, in [2, 10]; default 3 */
  double scale;     /**< sky: factor of all of its light; default 1 */
  double ground[3]; /**< sky: colour of what is seen below the horizon; default 0.3 */
  int32_t shines;   /**< sky: whether it lights the scene, or is merely seen; default 1 */
  int32_t reserved; /**< must be 0 */
} crt_background;

/** Says what a pixel is the mean of. */
typedef enum crt_pixel_filter {
  CRT_FILTER_BOX = 0,        /**< its square, with equal weights */
  CRT_FILTER_BLACKMAN_HARRIS /**< a bell around its middle */
} crt_pixel_filter;

/** Says what the distance D in a light's falloff / D^2 is. */
typedef enum crt_falloff_model {
  CRT_FALLOFF_PATH =
      0, /**< D is the length of the path from the camera over all bounces to the light */
  CRT_FALLOFF_LIGHT /**< D is the distance from the lit point to the light */
} crt_falloff_model;

/** Says how much of a light's ambient share a surface sends back. */
typedef enum crt_ambient_model {
  CRT_AMBIENT_LIGHT = 0, /**< all that it does not mirror, whatever its colour */
  CRT_AMBIENT_SURFACE    /**< that times its colour and its opacity: what is black stays black */
} crt_ambient_model;

/** Lists what is seen along rays that recursion_depth ends. Since 1.1. */
typedef enum crt_cutoff {
  CRT_CUTOFF_BLACK = 0,
  CRT_CUTOFF_BACKGROUND /**< the background in their direction */
} crt_cutoff;

/** Says how light that is too bright for a display is brought into its range. Since 1.1. */
typedef enum crt_tone_map {
  CRT_TONE_MAP_NONE = 0, /**< it is clipped */
  CRT_TONE_MAP_FILMIC    /**< by a curve as that of film: highlights fade out; see docs/image.md */
} crt_tone_map;

/** Says how close calls of the geometry are decided. Both values answer the same question. */
typedef enum crt_precision {
  CRT_PRECISION_STANDARD = 0, /**< right at a silhouette, rounding decides the last bit */
  CRT_PRECISION_EXACT /**< hits and their order are right, t within 0.51 ulp (tori: 1); nested
                         transforms are multiplied without rounding, in up to 1024 bits */
} crt_precision;

/** Says what a scene unit is. Since 1.1. */
typedef enum crt_unit {
  CRT_UNIT_M = 0, /**< a metre */
  CRT_UNIT_CM,    /**< a centimetre */
  CRT_UNIT_MM,    /**< a millimetre */
  CRT_UNIT_IN     /**< an inch */
} crt_unit;

/** Says how a scene is rendered. */
typedef struct crt_settings {
  uint32_t struct_size;
  int32_t width;         /**< pixels, in [1, 65536]; default 640; width * height is at most 2^27 */
  int32_t height;        /**< default 480 */
  int32_t supersampling; /**< n x n rays a pixel, in [1, 64]; default 1 */
  int32_t
      dof_samples; /**< points of the lens for each of them, in [1, 65536]; default 1: no lens */
  int32_t recursion_depth; /**< bounces after the camera's ray, in [0, 256]; default 3 */
  double gamma;            /**< 8-bit files hold clamp(c)^(1/gamma); in [0.1, 10]; default 2.2 */
  double min_weight;       /**< rays with a smaller share of the pixel in every channel are dropped;
                              default 1/1024 */
  int32_t falloff_model;   /**< a crt_falloff_model; default CRT_FALLOFF_LIGHT */
  int32_t show_clip; /**< not 0: pixels are red in 8-bit files that cannot say how bright a channel
                        is; default 0 */
  uint64_t seed;     /**< of the random numbers; default 0 */
  const char* title; /**< this and the next go into the files; NULL (default) for none */
  const char* author;
  const char* date;
  const char* notes;
  int32_t precision; /**< a crt_precision; default CRT_PRECISION_STANDARD */
  int32_t reserved;  /**< must be 0 */
  /** Above 0, a pixel gets samples until it is this near the truth in 95 of 100 cases. 1/255 is a
   * step of 8 bits. In [0, 1]; default 0. */
  double target_error;
  /** Above 0, these are the seconds that tracing may take. It stops at the end of a pass. The first
   * pass is always completed, so that there is a picture. In [0, 1e6]; default 0. */
  double time_budget;
  double filter_width; /**< pixels across, of filters other than the box; in [1, 16]; default 3 */
  int32_t min_samples; /**< of a pixel, with a target error or a time budget: a power of 2 in [4,
                          65536]; default 16 */
  int32_t max_samples; /**< of a pixel, also a power of 2 in [4, 65536]; default 1024 */
  int32_t filter;      /**< a crt_pixel_filter; default CRT_FILTER_BOX */
  int32_t reserved_2;  /**< must be 0 */
  /** 0 is the default. With 2015 the picture is formed as the program of that year formed it: lens,
   * panoramas, places of the grid's samples, levels of 8-bit files. The other settings are left:
   * those of a script of 2015 are gamma 1, CRT_FALLOFF_PATH and CRT_AMBIENT_LIGHT. See
   * docs/compat.md. */
  int32_t compat;
  int32_t reserved_3;    /**< must be 0 */
  int32_t ambient_model; /**< a crt_ambient_model; default CRT_AMBIENT_SURFACE */
  /** A scene without lights is lit from the camera, unless this is not 0. Default 0. */
  int32_t no_head_light;
  /** Light is followed over so many diffuse bounces, in [0, 64]. Above 0 there is no ambient light.
   * Default 0. Since 1.1. */
  int32_t indirect;
  /** Each ray takes so many samples of what lights a point and has a size, in [1, 1024]. Default 1.
   * Since 1.1. */
  int32_t light_samples;
  int32_t tone_map; /**< a crt_tone_map; default CRT_TONE_MAP_NONE. Since 1.1. */
  /** This is a crt_cutoff: what is seen along rays that recursion_depth ends; default
   * CRT_CUTOFF_BACKGROUND. Since 1.1. */
  int32_t cutoff;
  /** 8-bit files are brighter by so many stops: light counts 2^exposure times, before the tone map
   * and gamma. Float files hold light as it is. In [-100, 100]; default 0. Since 1.1. */
  double exposure;
  /** Above 0, light that comes by bounces counts as this bright at most, and nothing is claimed of
   * the picture's accuracy. Default 0. Since 1.1. */
  double clamp;
  /** Not 0: the finished picture is freed of noise, and nothing is claimed of its accuracy. Default
   * 0. Since 1.1. */
  int32_t denoise;
  int32_t unit;   /**< a crt_unit: what a scene unit is, which neither the geometry nor the picture
                     knows; default CRT_UNIT_M. Since 1.1. */
  int32_t frames; /**< of an animation, t = 0 to frames - 1, in [0, 1000000]; default 0: not said.
                     Since 1.1. */
  int32_t reserved_4; /**< must be 0 */
} crt_settings;

/** Fills in a checker. The values that other types need get sensible defaults too. */
CRT_API crt_status crt_pattern_init(crt_pattern* pattern, size_t struct_size);
/** Fills in the defaults of a crt_pattern_type. Those of wood are brown. */
CRT_API crt_status crt_pattern_init_type(crt_pattern* pattern, size_t struct_size, int32_t type);
/** Fills in a matt grey. */
CRT_API crt_status crt_material_init(crt_material* material, size_t struct_size);
/** Since 1.1. */
CRT_API crt_status crt_principled_init(crt_principled* material, size_t struct_size);
/** Fills in a white point light at the origin. */
CRT_API crt_status crt_light_init(crt_light* light, size_t struct_size);
/**
 * Fills in the defaults of a crt_light_type. All but the point light shine from (0, 1, 0) down to
 * the origin.
 */
CRT_API crt_status crt_light_init_type(crt_light* light, size_t struct_size, int32_t type);
/**
 * Fills in a camera at (0, 0, -1) that looks at the origin, with a field of view 60 degrees high.
 */
CRT_API crt_status crt_camera_init(crt_camera* camera, size_t struct_size);
/** Fills in a white background. */
CRT_API crt_status crt_background_init(crt_background* background, size_t struct_size);
/**
 * Fills in the default settings: 640 x 480 pixels, one ray a pixel, gamma 2.2. A program that was
 * compiled with the crt.h of 1.0, whose struct is shorter, gets what it was compiled with: gamma 1,
 * CRT_FALLOFF_PATH and CRT_AMBIENT_LIGHT.
 */
CRT_API crt_status crt_settings_init(crt_settings* settings, size_t struct_size);

/** @} */

/* ---- entities ------------------------------------------------------------------------------- */

/** @defgroup entities Entities
 * Entities are made, combined and placed. Each function makes a new entity, which never changes.
 * Combining and placing are cheap and share their parts. Threads: Shared.
 *
 * @code{.c}
 * crt_entity *cutters[] = {hole_a, hole_b};
 * crt_difference_create(plate, cutters, 2, &part);  // the holes' walls have the cutters' materials
 * @endcode
 * @{ */

/** Makes a solid sphere of `radius` > 0. */
CRT_API crt_status crt_sphere_create(const double center[3], double radius, crt_entity** out);
/**
 * Makes an axis-parallel box between any two opposite corners, which must differ by at least 1e-100
 * in every coordinate.
 */
CRT_API crt_status crt_box_create(const double corner_a[3], const double corner_b[3],
                                  crt_entity** out);
/** Makes the half-space behind a plane. `normal` (any length but 0) points out of the solid. */
CRT_API crt_status crt_plane_create(const double normal[3], const double position[3],
                                    crt_entity** out);
/**
 * Makes a surface: the half of a plane on the `direction` side of the line through `position`
 * across it.
 */
CRT_API crt_status crt_half_plane_create(const double normal[3], const double position[3],
                                         const double direction[3], crt_entity** out);
/**
 * Makes a solid cylinder of `radius` > 0 between the centres of its two caps, at least 1e-100
 * apart.
 */
CRT_API crt_status crt_cylinder_create(const double from[3], const double to[3], double radius,
                                       crt_entity** out);
/**
 * Makes a cone or frustum with `radius` at `from` and `radius2` (0 or more) at `to`. The two points
 * are at least 1e-100 apart.
 */
CRT_API crt_status crt_cone_create(const double from[3], const double to[3], double radius,
                                   double radius2, crt_entity** out);
/**
 * Makes a capsule: all points within `radius` > 0 of the straight line between two points, which
 * are at least 1e-100 apart.
 */
CRT_API crt_status crt_capsule_create(const double from[3], const double to[3], double radius,
                                      crt_entity** out);
/**
 * Makes an ellipsoid with its axes along x, y and z: a sphere that is scaled to three radii, each
 * > 0. Since 1.1.
 */
CRT_API crt_status crt_ellipsoid_create(const double center[3], const double radii[3],
                                        crt_entity** out);
/**
 * Makes the solid of a screw thread from one point to another, with the profile of ISO 68-1: M8 has
 * a diameter of 8 and a pitch of 1.25. Its ends are flat. It is an implicit solid. Since 1.1.
 * @param diameter  of the crests, from 1e-100 to 1e100
 * @param pitch     how far a turn leads, from a 10000th of the length to 0.9 diameters
 * @param left      1 turns the other way; 0 does not
 */
CRT_API crt_status crt_thread_create(const double from[3], const double to[3], double diameter,
                                     double pitch, int32_t left, crt_entity** out);
/**
 * Makes a round wire that winds about a line from one point to another, where its ends are cut
 * flat. It is an implicit solid. Since 1.1.
 * @param radius     from the line to the middle of the wire, from 1e-100 to 1e100
 * @param thickness  the wire's radius, at most 0.9 of `radius`
 * @param pitch      how far a turn leads: from a 10000th of the length on, with a tenth of it
 *                   between the turns
 * @param left       1 winds the other way than a common screw; 0 does not
 */
CRT_API crt_status crt_helix_create(const double from[3], const double to[3], double radius,
                                    double thickness, double pitch, int32_t left, crt_entity** out);
/**
 * Makes a profile that is drawn out along z, from 0 to a height, and shaped on its way. It is an
 * implicit solid with the distance from the profile as its field. Contours must not cross or touch
 * one another. Since 1.1.
 * @param twist     by how much the upper end is turned, in radians from x towards y; at most 1000
 *                  turns
 * @param taper     how many times as large as the lower end the upper one is, 0.001 to 1000
 * @param bevel     how far edges at both ends are cut off at 45 degrees, up to half of the height
 * @param rounding  the radius of edges that are rounded instead; 0 if there is a bevel
 */
CRT_API crt_status crt_shaped_extrusion_create(const crt_profile* profile, double height,
                                               double twist, double taper, double bevel,
                                               double rounding, crt_entity** out);
/**
 * Makes a box between two corners whose edges and corners are rounded with `radius`, which is from
 * 0 to half of the shortest side. Since 1.1.
 */
CRT_API crt_status crt_rounded_box_create(const double corner_a[3], const double corner_b[3],
                                          double radius, crt_entity** out);
/**
 * Makes a torus: all points within `thickness` of the circle of `radius` about `center` across
 * `axis`.
 */
CRT_API crt_status crt_torus_create(const double center[3], const double axis[3], double radius,
                                    double thickness, crt_entity** out);
/** Makes a surface: a flat disc. */
CRT_API crt_status crt_disc_create(const double center[3], const double normal[3], double radius,
                                   crt_entity** out);
/** Makes a surface: a triangle, which must have an area. Its normal is along (b - a) x (c - a). */
CRT_API crt_status crt_triangle_create(const double a[3], const double b[3], const double c[3],
                                       crt_entity** out);
/**
 * Makes a mesh. It is a solid if each edge belongs to an even number of triangles, and else a
 * surface. Corners with equal coordinates are one. Inside is every point from which a line to
 * infinity crosses an odd number of triangles. It is an error if no triangle has an area.
 * @param positions       3 * vertex_count numbers
 * @param indices         3 * triangle_count numbers, each below vertex_count
 */
CRT_API crt_status crt_mesh_create(const double* positions, size_t vertex_count,
                                   const uint32_t* indices, size_t triangle_count,
                                   crt_entity** out);

/**
 * Describes a mesh with more than triangles: normals for shading, (u, v) and materials. What rays
 * meet and where the inside is, the triangles alone say. In the lists of indices UINT32_MAX says
 * that there is none.
 */
typedef struct crt_mesh {
  uint32_t struct_size;
  int32_t reserved;        /**< must be 0 */
  const double* positions; /**< 3 * vertex_count numbers, as for crt_mesh_create() */
  uint64_t vertex_count;
  const uint32_t* indices; /**< 3 * triangle_count numbers, each below vertex_count */
  uint64_t triangle_count;
  /** Has 3 * normal_count numbers: normals of any length. One that is 0 stands for that of the
   * triangle. They are turned to the side of the triangle's own normal. Default NULL. */
  const double* normals;
  uint64_t normal_count; /**< default 0 */
  /** Has 3 * triangle_count numbers that name the normals of the triangles' corners. Default NULL:
   * those of `indices`, and normal_count is vertex_count. */
  const uint32_t* normal_indices;
  const double* uv;           /**< 2 * uv_count numbers, up to 1e30 in magnitude; default NULL */
  uint64_t uv_count;          /**< default 0 */
  const uint32_t* uv_indices; /**< name the (u, v) of the corners as normal_indices do normals */
  /** Has material_count materials, or NULL for those that `principled` has. They stand in the place
   * of the default one: a material that the whole entity gets is put in their place. Default
   * NULL. */
  const crt_material* const* materials;
  uint64_t material_count; /**< default 0 */
  /** Has triangle_count numbers that name the triangles' materials. Default NULL: all have the
   * first. */
  const uint32_t* material_of_triangle;
  /** Is the largest angle in radians, up to pi, between triangles that are shaded as one round
   * surface across their edge. Their normals are then computed, and those above left alone. 0
   * leaves all flat. Default -1: the normals above, if there are any. */
  double smooth;
  /** Has material_count principled materials, or NULL for those that `materials` has. It is an
   * error if both have one of the same number, or neither. `materials` may be NULL if all are
   * here. Default NULL: all are in `materials`. Since 1.1. */
  const crt_principled* const* principled;
} crt_mesh;

/**
 * Makes a mesh by a rule that says what is inside, otherwise as crt_mesh_create() does. By
 * CRT_FILL_NONZERO it is every point that the triangles go about more often in one direction than
 * in the other, so that parts which overlap are one solid. The mesh is a solid then if each edge
 * runs as often in one direction as in the other. Since 1.1.
 * @param rule  CRT_FILL_EVEN_ODD, as crt_mesh_create() has it, or CRT_FILL_NONZERO
 */
CRT_API crt_status crt_mesh_from_triangles_rule(const double* positions, size_t vertex_count,
                                                const uint32_t* indices, size_t triangle_count,
                                                int32_t rule, crt_entity** out);

/** Fills in a mesh of nothing. Since 1.1. */
CRT_API crt_status crt_mesh_init(crt_mesh* mesh, size_t struct_size);
/**
 * Makes a mesh with normals, (u, v) or materials, otherwise as crt_mesh_create() does. Since 1.1.
 */
CRT_API crt_status crt_mesh_create_with(const crt_mesh* mesh, crt_entity** out);

/** Says what is inside of a mesh, and how its triangles are put right before. Since 1.1. */
typedef struct crt_mesh_options {
  uint32_t struct_size;
  /** Is a crt_fill_rule, or -1, the default: CRT_FILL_EVEN_ODD for the triangles of a program, and
   * for those of a file CRT_FILL_NONZERO if all shells are turned outwards, but for cavities. */
  int32_t fill;
  /** Vertices up to this far from an earlier one become that one. It is from 0, the default, to
   * 1e100. */
  double weld;
  /** Where a vertex of an open edge lies on another open edge, up to this distance, that edge is
   * divided there, so that T-junctions are closed. It is from 0 (never), the default, to 1e100. */
  double stitch;
} crt_mesh_options;

/** Fills in the defaults. Since 1.1. */
CRT_API crt_status crt_mesh_options_init(crt_mesh_options* options, size_t struct_size);
/** Makes a mesh by options, otherwise as crt_mesh_create_with() does. Since 1.1. */
CRT_API crt_status crt_mesh_create_with_options(const crt_mesh* mesh,
                                                const crt_mesh_options* options, crt_entity** out);

/** Says what was found out about the triangles of a mesh, and what was changed. Since 1.1. */
typedef struct crt_mesh_report {
  uint32_t struct_size;
  int32_t fill;                /**< the crt_fill_rule that holds */
  uint64_t welded_vertices;    /**< so many became others by `weld` */
  uint64_t welded_triangles;   /**< so many went, as two of their corners became one */
  uint64_t stitched_vertices;  /**< so many times an edge was divided by `stitch` */
  uint64_t repeated_triangles; /**< so many have the corners of an earlier one */
  double first_repeated[3];    /**< the middle of one of these */
  uint64_t shells;             /**< so many parts are not connected by edges */
  /** So many shells lie in others, overlap them or pass through themselves, turned one way. */
  uint64_t overlapping_shells;
  double first_overlap[3]; /**< a point near the first of these places */
} crt_mesh_report;

/** Fills in the report of nothing. Since 1.1. */
CRT_API crt_status crt_mesh_report_init(crt_mesh_report* report, size_t struct_size);
/**
 * Gives the report of an entity that is one mesh, wherever it is placed. It is an error for others.
 * Since 1.1.
 * @param report  is filled in as far as its struct_size goes
 */
CRT_API crt_status crt_entity_mesh_report(crt_entity* entity, crt_mesh_report* report);
/**
 * Gives the warnings of an entity that is one mesh, a line each: what most likely was not meant,
 * what of a file was left out, and what was changed. It is an error for others. Since 1.1.
 * @param text      an array of `capacity` bytes, which gets as much of the text as fits, and a 0
 *                  after it; NULL if that is 0
 * @param length    gets the length of the whole text without the 0
 */
CRT_API crt_status crt_entity_mesh_warnings(crt_entity* entity, char* text, size_t capacity,
                                            size_t* length);

/**
 * Makes a profile without a contour. Add contours, each by crt_profile_move_to() and then by
 * pieces, before you make entities of it: these keep what it is at the time. A contour is closed by
 * a straight piece, unless its last corner repeats the first. The even-odd rule says what is
 * inside: all points from which a line to infinity crosses an odd number of pieces. So a contour
 * within another is a hole, whichever way round either goes. Since 1.1.
 */
CRT_API crt_status crt_profile_create(crt_profile** out);
/** Begins a contour at a corner. Since 1.1. */
CRT_API crt_status crt_profile_move_to(crt_profile* profile, double x, double y);
/**
 * Adds a straight piece from the last corner to another. It fails before a contour begins.
 * Since 1.1.
 */
CRT_API crt_status crt_profile_line_to(crt_profile* profile, double x, double y);
/**
 * Adds an arc of a circle from the last corner to another. It is an error before a contour begins.
 * Since 1.1.
 * @param bulge  the tangent of a quarter of the arc's angle: above 0 for an arc that turns from x
 *               to y, and below 0 for one that turns from y to x. It is 1 for half a circle, and
 *               sqrt(2) - 1 for a quarter. 0 makes a straight piece.
 */
CRT_API crt_status crt_profile_arc_to(crt_profile* profile, double x, double y, double bulge);
/**
 * Adds a cubic Bezier curve from the last corner to (x, y), with the control points (x1, y1) and
 * (x2, y2). It becomes arcs of circles that continue one another's directions. Since 1.1.
 * @param deviation  how far the arcs and the curve may be away from each other; 0 for a 10000th of
 *                   the larger side of the box around the four points, or 2^-44 of their largest
 *                   coordinate if that is more. It is an error if it is below 2^-32 of that side,
 *                   or below 2^-44 of that coordinate.
 */
CRT_API crt_status crt_profile_cubic_to(crt_profile* profile, double x1, double y1, double x2,
                                        double y2, double x, double y, double deviation);
/**
 * Adds a quadratic Bezier curve with the control point (x1, y1), as crt_profile_cubic_to().
 * Since 1.1.
 */
CRT_API crt_status crt_profile_quadratic_to(crt_profile* profile, double x1, double y1, double x,
                                            double y, double deviation);

/** Lists what is inside of contours that cross each other, or that lie within each other. */
typedef enum crt_fill_rule {
  CRT_FILL_NONZERO = 0, /**< where they go about a point more often in one direction than in the
                             other; SVG has it unless the drawing says something else */
  CRT_FILL_EVEN_ODD     /**< where a line to infinity crosses an odd number of pieces */
} crt_fill_rule;
/**
 * Adds the contours of an SVG path, which is the attribute d of a path element. (x, y) of the path
 * becomes (x, -y), as SVG has y downward. Subpaths are closed. Arcs of circles stay what they are,
 * and other curves become such arcs. By the nonzero rule, contours are cut where they cross, so
 * that by the even-odd rule they enclose what they should. The message of an error names the
 * character of the path. Begin a contour by crt_profile_move_to() before you add further pieces.
 * Since 1.1.
 * @param path       `length` bytes
 * @param fill       a crt_fill_rule
 * @param deviation  as for crt_profile_cubic_to(); with 0 each curve has the default for its size
 */
CRT_API crt_status crt_profile_svg_path(crt_profile* profile, const char* path, size_t length,
                                        int32_t fill, double deviation);
/**
 * Replaces the contours of a profile by those of a region that is larger all around by a distance,
 * or smaller by one below 0, of which nothing may be left. Straight pieces move, arcs get another
 * radius, and outer corners become arcs about them (inner ones, below 0). Begin a contour by
 * crt_profile_move_to() before you add further pieces. Since 1.1.
 * @param distance  in scene units
 */
CRT_API crt_status crt_profile_offset(crt_profile* profile, double distance);

/** Lists where lines of text are, from x = 0 on. */
typedef enum crt_text_alignment {
  CRT_TEXT_LEFT = 0, /**< lines begin there */
  CRT_TEXT_CENTER,   /**< lines have their middle there */
  CRT_TEXT_RIGHT     /**< lines end there */
} crt_text_alignment;
/**
 * Adds the contours of text. The first line stands on y = 0, and others are below it. Pairs of
 * letters come closer where the font has a kern table. There are no ligatures, and letters follow
 * one another from left to right. A letter that the font lacks is the box that it has for that.
 * The library of FreeType is loaded when this is first called: without it, this is
 * CRT_ERROR_UNSUPPORTED. Begin a contour by crt_profile_move_to() before you add further pieces.
 * Since 1.1.
 * @param text          `length` bytes of UTF-8, with lines ended by "\n"
 * @param font          the path of a font file; NULL for the library's own, Liberation Sans
 * @param size          the size of the em, above 0; capital letters are about 0.7 of it high
 * @param alignment     a crt_text_alignment
 * @param line_spacing  the distance of lines as a multiple of what the font says; usually 1
 * @param deviation     as for crt_profile_cubic_to(); with 0 each curve has the default for its
 *                      size
 * @param missing       gets how many different letters the font lacks; may be NULL
 */
CRT_API crt_status crt_profile_text(crt_profile* profile, const char* text, size_t length,
                                    const char* font, double size, int32_t alignment,
                                    double line_spacing, double deviation, size_t* missing);

/** Tells how many contours a profile has. Since 1.1. */
CRT_API crt_status crt_profile_contour_count(const crt_profile* profile, size_t* count);
/**
 * Tells the corners of a contour, three numbers each: x, y, and the bulge of the piece that leads
 * to it from the corner before. Since 1.1.
 * @param index     below the number of contours
 * @param corners   an array of 3 * `capacity` numbers; NULL if that is 0
 * @param count     gets how many corners there are, which may be more than `capacity`; only so many
 *                  are written
 */
CRT_API crt_status crt_profile_contour(const crt_profile* profile, size_t index, double* corners,
                                       size_t capacity, size_t* count);
/**
 * Makes an extrusion: a profile that is drawn out from its own plane, which goes through `from`, to
 * `to`. The profile's origin is at `from`. Its x axis is where angles about the axis begin: along z
 * as far as that is across the axis, or along x if the axis is mostly along z. Its y axis is a
 * quarter of a turn from there about the axis. So from (0, 0, a) to (0, 0, b), with a < b, x and y
 * are those of the scene, and nothing is rounded. Straight pieces make flat faces, and arcs make
 * parts of cylinders. Errors of the profile are reported here, with the numbers of the contour and
 * the corner. Since 1.1.
 */
CRT_API crt_status crt_extrusion_create(const crt_profile* profile, const double from[3],
                                        const double to[3], crt_entity** out);
/**
 * Makes a revolution: a profile that is turned about the axis from `from` towards `to`. x of the
 * profile is the distance from the axis, which no corner and no arc may have below 0. y is the
 * height along the axis from `from` on, in scene units. The turn starts where angles about the axis
 * begin, as for crt_extrusion_create(). Straight pieces make flat faces and parts of cylinders and
 * cones, and arcs make parts of spheres and tori. Errors of the profile are reported here, with the
 * numbers of the contour and the corner. Since 1.1.
 * @param angle  in radians, above 0 and at most a whole turn, which is 2 pi
 */
CRT_API crt_status crt_revolution_create(const crt_profile* profile, const double from[3],
                                         const double to[3], double angle, crt_entity** out);

/**
 * Makes a sweep: all points that a profile passes as it follows a path of straight lines, across
 * which it stays. It turns with the path as little as can be. With a bend above 0 the path has an
 * arc of that radius at each point in between, and with 0 the pieces are mitred. Ends are flat.
 * Since 1.1.
 * @param path    count points of three coordinates each; those that follow one another are at least
 *                1e-100 apart, and the path nowhere turns straight back (to 0.1 degrees)
 * @param count   at least 2, or 3 if the path is closed, and at most 4096
 * @param bend    from 1e-100 to 1e100, or 0
 * @param up      where y of the profile points at the first line, as far as that is across; z takes
 *                its place if it is along the line, or x if it is along that, too
 * @param closed  1 leads back from the last point to the first, in a plane; 0 does not
 */
CRT_API crt_status crt_sweep_create(const crt_profile* profile, const double* path, size_t count,
                                    double bend, const double up[3], int32_t closed,
                                    crt_entity** out);
/**
 * Makes a tube: all points within a radius of a path. The radius changes along it, and the ends are
 * round. Since 1.1.
 * @param path       as for crt_sweep_create(); it may turn back
 * @param radii      the radius at each of the count points, from 1e-100 to 1e100, or 0 for a tip
 * @param smooth     1 lets the path be a curve through the points, and the radii change as
 *                   smoothly; with 0 both are straight in between
 * @param closed     1 leads back from the last point to the first; 0 does not
 * @param deviation  how far the pieces of a curve may be off; 0 is a 1000th of the largest radius
 */
CRT_API crt_status crt_tube_create(const double* path, const double* radii, size_t count,
                                   int32_t smooth, int32_t closed, double deviation,
                                   crt_entity** out);

/**
 * Makes a polyhedron: the solid that flat faces enclose. A face need not be convex. It becomes
 * triangles between its corners, which are flat if these are in one plane. It is a mesh. Since 1.1.
 * @param points   point_count points of three coordinates each
 * @param corners  places in `points`, from 0: the corners of the first face in order around it,
 *                 either way, then those of the second, and so on
 * @param sizes    how many corners each face has, from 3 to 1024
 */
CRT_API crt_status crt_polyhedron_create(const double* points, size_t point_count,
                                         const uint32_t* corners, const uint32_t* sizes,
                                         size_t face_count, crt_entity** out);
/**
 * Makes a hull: the smallest convex solid that holds points. Its corners are some of these. It is a
 * mesh. Since 1.1.
 * @param points  count points of three coordinates each, which are not all in one plane
 * @param count   at least 4, and at most 1024
 */
CRT_API crt_status crt_hull_create(const double* points, size_t count, crt_entity** out);

/**
 * Makes a height field: a solid in the box between two opposite corners, which differ by at least
 * 1e-100 in every coordinate. It is below a surface over a grid of heights, of `columns` along x
 * and `rows` along z. The first column and row lie at the box's lower x and z, the last ones at the
 * upper. A height is from 0, at the box's lower y, to 1, at its upper. They must not all be 0.
 * Between four heights there are two triangles, which meet in the line from lower x and z to upper
 * x and z. Since 1.1.
 * @param heights  columns * rows numbers, row by row
 * @param columns  at least 2
 * @param rows     at least 2; columns * rows must be at most 2^27
 */
CRT_API crt_status crt_height_field_create(const double* heights, uint32_t columns, uint32_t rows,
                                           const double corner_a[3], const double corner_b[3],
                                           crt_entity** out);

/**
 * Makes a quadric: all points (x, y, z) for which the sum of the ten terms is not above 0. It must
 * be below 0 at some points and above 0 at others. So an ellipsoid, a paraboloid, a hyperboloid, a
 * cone or a cylinder is a quadric. All but ellipsoids are infinite. Coefficients may be any finite
 * numbers, if the quadric has a size from 1e-100 to 1e100, and no coefficient but 0 is below 1e-200
 * of the largest, with that size as the unit of length. The size is the larger of sqrt(|constant| /
 * a) and l / a. Here l is the largest magnitude in `linear`, and a that in `squares` and
 * `products`. If a is 0 it is |constant| / l, and if all that is 0 it is 1. Since 1.1.
 * @param squares   of x^2, y^2 and z^2
 * @param products  of x y, x z and y z
 * @param linear    of x, y and z
 */
CRT_API crt_status crt_quadric_create(const double squares[3], const double products[3],
                                      const double linear[3], double constant, crt_entity** out);

/**
 * Makes an implicit solid: all points from `lower` to `upper` at which a field f(x, y, z) is at
 * most 0. The text is an expression of the CRT language, in which x, y and z are the coordinates,
 * such as "x ** 2 + y ** 2 + z ** 2 - 1". `upper` is above `lower` by at least 1e-100 in every
 * coordinate. What is wrong with the text is CRT_ERROR_SCRIPT, and the message says where.
 * Since 1.1.
 * @param length  in bytes
 */
CRT_API crt_status crt_implicit_create(const char* field, size_t length, const double lower[3],
                                       const double upper[3], crt_entity** out);

/**
 * A part of a blob is a ball about `from`, or what is around the line from there to another point.
 * With the share s of the radius that a point is away from it, it adds strength (1 - s^2)^2 where
 * s < 1. A negative strength takes away. The struct is fixed for ever: 64 bytes.
 */
typedef struct crt_blob_part {
  double from[3];
  double to[3]; /**< equal to `from` for a ball, else at least 1e-100 from it */
  double radius;
  double strength; /**< not 0 */
} crt_blob_part;

/**
 * Makes a blob: all points at which parts add up to a threshold or more, which is above 0. There
 * may be some 300 balls or 150 lines. It is an implicit solid. Since 1.1.
 */
CRT_API crt_status crt_blob_create(const crt_blob_part* parts, size_t count, double threshold,
                                   crt_entity** out);

/**
 * Makes a superellipsoid: all points at which (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1. It is
 * an implicit solid, which reaches from -1 to 1 along all axes. Since 1.1.
 * @param east_west    e, the shape across z, from 0.01 to 10
 * @param north_south  n, the shape along z, from 0.01 to 10
 */
CRT_API crt_status crt_superellipsoid_create(double east_west, double north_south,
                                             crt_entity** out);

/**
 * Makes the solid without a point, such as what is left of a sphere whose radius shrinks to 0. No
 * ray meets it. In combinations it behaves as the empty set. No transform, material or id changes
 * it.
 */
CRT_API crt_status crt_empty_create(crt_entity** out);

/** Makes the union: what is in any of the parts (at least one), which may be surfaces too. */
CRT_API crt_status crt_union_create(crt_entity* const* parts, size_t count, crt_entity** out);
/**
 * Makes the intersection: what is in all of the parts. There is at least one, and all are solids.
 */
CRT_API crt_status crt_intersection_create(crt_entity* const* parts, size_t count,
                                           crt_entity** out);
/**
 * Makes the difference: what is in `from` and in none of the cutters. All are solids, and there may
 * be no cutters. A cut has its cutter's material.
 */
CRT_API crt_status crt_difference_create(crt_entity* from, crt_entity* const* cutters, size_t count,
                                         crt_entity** out);

/**
 * Writes the map that moves nothing. As with all crt_affine_* functions, the map is the three rows
 * of a 3x4 matrix for crt_entity_with_transform(), which checks it. A function that returns nothing
 * does nothing if a pointer is NULL. Since 1.1.
 *
 * @code{.c}
 * double turn[12], lift[12], both[12];
 * const double axis[3] = {0, 1, 0}, up[3] = {0, 2, 0};
 * crt_affine_rotation(axis, 0.5, turn);
 * crt_affine_translation(up, lift);
 * crt_affine_product(turn, lift, both);
 * crt_entity_with_transform(sphere, both, &part);
 * @endcode
 */
CRT_API void crt_affine_identity(double out[12]);
/** Writes the map that moves by an offset. Since 1.1. */
CRT_API void crt_affine_translation(const double by[3], double out[12]);
/** Writes the map that scales about the origin, by a factor for each axis. Since 1.1. */
CRT_API void crt_affine_scaling(const double by[3], double out[12]);
/**
 * Writes the rotation about an axis through the origin, of any length but 0, by an angle in
 * radians. It is left-handed, as crt::rotate_degrees in C++ and `rotate` in scripts: a positive
 * angle turns x to y about z, y to z about x, and z to x about y, which is counter-clockwise for
 * one who looks along the axis. Quarter turns are exact where the axis is x, y or z. Since 1.1.
 */
CRT_API crt_status crt_affine_rotation(const double axis[3], double angle, double out[12]);
/**
 * Writes the map that does what `first` does, and `then` the other. `out` may be one of them.
 * Since 1.1.
 */
CRT_API void crt_affine_product(const double first[12], const double then[12], double out[12]);

/** Makes the entity moved by an affine map with an inverse, after whatever moved it before. */
CRT_API crt_status crt_entity_with_transform(crt_entity* entity, const double affine[12],
                                             crt_entity** out);
/**
 * Makes the entity with a material on every part that has none of its own. A part that has one,
 * from its maker or from an earlier call, keeps it.
 */
CRT_API crt_status crt_entity_with_material(crt_entity* entity, const crt_material* material,
                                            crt_entity** out);
/** Does so with a principled material. Threads: any thread. Since 1.1. */
CRT_API crt_status crt_entity_with_principled(crt_entity* entity, const crt_principled* material,
                                              crt_entity** out);
/**
 * Makes the entity under a number that hits report. An entity without one reports its place in the
 * scene. The outermost number holds.
 */
CRT_API crt_status crt_entity_with_id(crt_entity* entity, uint32_t id, crt_entity** out);

/**
 * Makes the entity with a number of yours for all its parts that have none, such as a pointer or a
 * key. crt_full_hit and crt_locate() report it. The innermost one holds. Since 1.1.
 */
CRT_API crt_status crt_entity_with_user(crt_entity* entity, uint64_t user, crt_entity** out);
/**
 * Makes the entity as one that casts a shadow, or with 0 one that light passes on its way to what
 * it lights. Mirrors, glass and the camera still show it. The last call holds. It is of whole
 * entities of a scene: one that casts no shadow cannot be combined with others
 * (CRT_ERROR_INVALID_ARGUMENT). Since 1.1.
 */
CRT_API crt_status crt_entity_with_shadow(crt_entity* entity, int32_t casts, crt_entity** out);
/**
 * Makes the entity as one that the camera sees, or with 0 one that its rays pass as if it were not
 * there. Mirrors, glass and shadows still show it, and ray queries meet it. Otherwise as
 * crt_entity_with_shadow(). Since 1.1.
 */
CRT_API crt_status crt_entity_with_visible(crt_entity* entity, int32_t visible, crt_entity** out);

/** Returns 1 if the entity has an inside, and 0 if a part of it is a mere surface or it is NULL. */
CRT_API int32_t crt_entity_is_solid(const crt_entity* entity);
/**
 * Says why an entity has no inside: of a mesh which edge is open, and how many are. Since 1.1.
 * @param text      an array of `capacity` bytes, which gets as much of the text as fits, and a 0
 *                  after it; NULL if that is 0
 * @param length    gets the length of the whole text without the 0; it is 0 for a solid
 */
CRT_API crt_status crt_entity_solid_fault(crt_entity* entity, char* text, size_t capacity,
                                          size_t* length);
/**
 * Returns the number of primitives the entity is made of. A part that occurs twice is counted
 * twice. It is 0 for NULL and for the empty entity.
 */
CRT_API uint64_t crt_entity_primitive_count(const crt_entity* entity);

/**
 * Describes an entity and what it is made of, as JSON: a list of objects, each before its parts. A
 * `kind` is the type of a primitive ("Sphere"), "Union", "Intersection", "Difference", "Placed" or
 * "Empty". `parent` is the place in the list of what it is a part of, and null for the entity
 * itself. `values` has the numbers and vectors of its fields, by name, and what its material is
 * like. After 10000 parts the rest is left out. Since 1.1.
 * @param json      an array of `capacity` bytes, which gets as much of the text as fits, and a 0
 *                  after it; NULL if that is 0
 * @param length    gets the length of the whole text without the 0
 */
CRT_API crt_status crt_entity_describe(crt_entity* entity, char* json, size_t capacity,
                                       size_t* length);

/** @} */

/* ---- measures ------------------------------------------------------------------------------- */

/** @defgroup measures Measures of solids
 * These functions say how much a solid is, where it is and what is in it. The solid is that which
 * the numbers of the entity describe, by their equations; no triangles and no samples are taken.
 * Answers are intervals that surely hold the truth. They are the same for any number of threads,
 * unless time ends them. docs/measure.md is a guide. Threads: Shared.
 *
 * What has no inside is refused (crt_entity_solid_fault() says why), and so is a volume, an area or
 * a mass without a box around it.
 *
 * - `relative_width` is the width that is asked for, relative to the size of the answer: above 0
 * and at most 1. Rounding keeps answers from being narrower than about 1e-12.
 * - `seconds` ends the work with what is known then, which may be a wider interval. It is 0 or
 *   INFINITY for no such end.
 *
 * @code{.c}
 * crt_mass mass;
 * crt_mass_init(&mass, sizeof mass);
 * if (crt_entity_mass(entity, 1e-6, 0, &mass) == CRT_OK)
 *   printf("between %.9g and %.9g\n", mass.volume.lower, mass.volume.upper);
 * @endcode
 * @{ */

/**
 * An interval holds a number: lower <= it <= upper. The layout is fixed for ever: 16 bytes. Since
 * 1.1.
 */
typedef struct crt_interval {
  double lower;
  double upper;
} crt_interval;

/**
 * Says how well something is to be known, and what may end the search for it. All 0 is the default.
 * Since 1.1.
 */
typedef struct crt_measure_options {
  uint32_t struct_size;
  int32_t threads;       /**< as in crt_render_options; 0 means all */
  double relative_width; /**< above 0 and at most 1; 0 means what each function says */
  double seconds;        /**< ends the search with what is known then; 0 or INFINITY: no such end */
  /** NULL, or a callback that may cancel: the call then ends with CRT_ERROR_CANCELLED. Any of the
   * threads that work may call it, one at a time. */
  crt_poll_fn poll;
  void* poll_user;
} crt_measure_options;

/** Fills in the defaults, which are all 0. Since 1.1. */
CRT_API crt_status crt_measure_options_init(crt_measure_options* options, size_t struct_size);

/** Has the mass properties of a solid of density 1, in scene units. Since 1.1. */
typedef struct crt_mass {
  uint32_t struct_size;
  uint32_t reserved;        /**< 0 */
  crt_interval volume;      /**< parts that overlap count once */
  crt_interval area;        /**< of the surface, without what is within the solid; INFINITY above
                               while a place of it is so narrow that nothing bounds it */
  crt_interval centroid[3]; /**< its width is relative to half of the longest side of the box */
  /** About the centroid: xx, yy, zz, xy, yz and zx. The last three are the integrals of -x y, -y z
   * and -z x. Widths are relative to the volume times the square of half of the longest side of the
   * box around the solid. */
  crt_interval inertia[6];
} crt_mass;

/** Fills in zeros. Since 1.1. */
CRT_API crt_status crt_mass_init(crt_mass* mass, size_t struct_size);
/**
 * Finds all mass properties of a solid. It takes some times as long as the volume alone. Since 1.1.
 * @param out  is filled in as far as its struct_size goes
 */
CRT_API crt_status crt_entity_mass(crt_entity* entity, double relative_width, double seconds,
                                   crt_mass* out);
/**
 * Gives the density of a solid that its materials say, in kg per cubic metre: 0 if they say none.
 * Of a difference and of an intersection the first part counts alone. Fails with
 * CRT_ERROR_INVALID_ARGUMENT if parts of it have different densities. Since 1.1.
 */
CRT_API crt_status crt_entity_density(crt_entity* entity, double* out);
/** Finds the volume of a solid, in cubed scene units. Since 1.1. */
CRT_API crt_status crt_entity_volume(crt_entity* entity, double relative_width, double seconds,
                                     crt_interval* out);
/** Finds the area of the surface of a solid, in squared scene units. Since 1.1. */
CRT_API crt_status crt_entity_area(crt_entity* entity, double relative_width, double seconds,
                                   crt_interval* out);
/**
 * Finds the centroid of a solid, which takes less long than all mass properties. Its widths are
 * relative to half of the longest side of the box around the solid. Since 1.1.
 */
CRT_API crt_status crt_entity_centroid(crt_entity* entity, double relative_width, double seconds,
                                       crt_interval out[3]);
/**
 * Gives a box that holds the entity. Each side of it is within 1e-6 times half of the longest side
 * of the box around its parts of where the smallest box has it. What no equations bound, such as
 * crt_custom_create(), or what is thinner than rounding may have a larger one. Of surfaces, and of
 * what is infinite along any axis, it is the box around the parts, rounded outwards: that of a
 * difference holds what is cut from. Sides of what has no end are infinite, and what has no points
 * has lower > upper. Since 1.1.
 */
CRT_API crt_status crt_entity_bounds(crt_entity* entity, double lower[3], double upper[3]);
/**
 * Finds whether points are in a solid: 1 for inside, 0 for on the surface, as far as rounding of
 * its equations lets one know, and -1 for outside. Where parts of a union touch is inside. What
 * crt_custom_create() made has no 0. If a point is not finite, nothing is written, and the message
 * names its index. Since 1.1.
 * @param points  each 3 numbers
 * @param stride  bytes from one point to the next; 0 means one after the other
 * @param side    gets `count` numbers
 */
CRT_API crt_status crt_entity_contains(crt_entity* entity, const double* points, size_t stride,
                                       size_t count, int8_t* side);
/**
 * Finds the nearest points of a solid's surface, and how far away they are: below 0 for points in
 * the solid. No distance is less than the true one. It is at most 1e-6 of itself more, unless
 * surfaces are equally near over a wide range, as between a shaft and its bore, or merely touch:
 * there the search ends after many thousand boxes. If a point is not finite, nothing is written,
 * and the message names its index. A solid without points, or without an end, is refused. Since
 * 1.1.
 * @param points           each 3 numbers
 * @param stride           bytes from one point to the next; 0 means one after the other
 * @param signed_distance  gets `count` numbers
 * @param nearest          gets `count` points of 3 numbers; NULL if they are not wanted
 * @param nearest_stride   bytes from one of these to the next; 0 means one after the other
 */
CRT_API crt_status crt_entity_distance(crt_entity* entity, const double* points, size_t stride,
                                       size_t count, double* signed_distance, double* nearest,
                                       size_t nearest_stride);
/**
 * Finds nearest points as crt_entity_distance() does, by options: NULL, or a relative width of 0,
 * stands for those of that function. Where time ends the search, distances are those of the nearest
 * points until then. Since 1.1.
 */
CRT_API crt_status crt_entity_distance_with(crt_entity* entity, const crt_measure_options* options,
                                            const double* points, size_t stride, size_t count,
                                            double* signed_distance, double* nearest,
                                            size_t nearest_stride);
/**
 * Finds how near two solids are, and a pair of points so far apart. For solids that overlap, which
 * have inner points in common, both ends of the distance are 0, and both points are such a point.
 * For those that touch, the lower end alone is 0. Between surfaces that are equally near over a
 * wide range, the lower end may be poor, as the search ends after many thousand boxes. A solid
 * without points, or without an end, is refused. Since 1.1.
 * @param on_a  gets the point of `a`
 * @param on_b  gets the point of `b`
 */
CRT_API crt_status crt_entity_clearance(crt_entity* a, crt_entity* b, double relative_width,
                                        crt_interval* distance, double on_a[3], double on_b[3]);
/**
 * Finds how near two solids are as crt_entity_clearance() does, by options. The usual relative
 * width is 1e-6. Since 1.1.
 */
CRT_API crt_status crt_entity_clearance_with(crt_entity* a, crt_entity* b,
                                             const crt_measure_options* options,
                                             crt_interval* distance, double on_a[3],
                                             double on_b[3]);
/**
 * Finds how thin the thinnest wall of a solid is: the shortest chord in it that is normal to the
 * surface at one end and within 5 degrees of a normal at the other. So the edge of a box is no
 * wall. The chord is as long as the upper end says. Both ends are INFINITY, and both points 0, if
 * there is no wall. The lower end may be poor where curved walls of one thickness are large, and is
 * 0 where a surface has a point without a normal, such as the apex of a cone: the search ends after
 * many thousand pairs of boxes, which is some seconds. Since 1.1.
 * @param relative_width  such as 0.01
 * @param from            gets one end of the chord
 * @param to              gets the other end
 */
CRT_API crt_status crt_entity_thickness(crt_entity* entity, double relative_width,
                                        crt_interval* least, double from[3], double to[3]);
/**
 * Finds the thinnest wall as crt_entity_thickness() does, by options. The usual relative width is
 * 0.01. Since 1.1.
 */
CRT_API crt_status crt_entity_thickness_with(crt_entity* entity, const crt_measure_options* options,
                                             crt_interval* least, double from[3], double to[3]);

/** Says how much two entities have in common. The layout is fixed for ever: 32 bytes. Since 1.1. */
typedef struct crt_overlap {
  uint64_t first; /**< places in what was given, first < second */
  uint64_t second;
  crt_interval volume; /**< above 0 at its upper end */
} crt_overlap;

/**
 * Finds which solids overlap, with how much each pair has in common. Surfaces without an inside are
 * passed over, and so is what only touches. Since 1.1.
 * @param seconds   is for each pair
 * @param overlaps  gets the first `capacity` pairs, in order; may be NULL if that is 0
 * @param count     gets how many there are
 */
CRT_API crt_status crt_interference(crt_entity* const* entities, size_t entity_count,
                                    double relative_width, double seconds, crt_overlap* overlaps,
                                    size_t capacity, size_t* count);

/** @} */

/* ---- sections ------------------------------------------------------------------------------- */

/** @defgroup sections Sections of solids
 * A section is what a plane cuts out of a solid: contours of lines and arcs that are within a
 * deviation of the true boundary, which is proved from the solid's equations. docs/measure.md is a
 * guide. Threads: Shared.
 *
 * A section's drawing is as somebody sees it who looks against the normal, with x to the right and
 * y up. y is as near to y of the world as can be; for a plane across that it is z for a normal
 * upwards, and -z for one downwards.
 *
 * @code{.c}
 * static const double up[3] = {0, 1, 0};
 * crt_section* section;
 * if (crt_section_create(entity, up, 6, 0.01, &section) == CRT_OK) {
 *   crt_section_write(section, "plate.svg");
 *   crt_section_release(section);
 * }
 * @endcode
 * @{ */

/**
 * Cuts a solid by the plane {p : normal . p / |normal| = offset}. A plane in a face of the solid
 * cuts what is against the normal, as near to the plane as can be. There, and where an edge lies in
 * it, it is moved by 2^-32 of half of the longest side of the box around the solid
 * (crt_section_frame() tells). Since 1.1.
 * @param normal     of any length but 0
 * @param offset     in scene units
 * @param deviation  that is asked for, in scene units: above 0
 */
CRT_API crt_status crt_section_create(crt_entity* entity, const double normal[3], double offset,
                                      double deviation, crt_section** out);
/**
 * Cuts a solid as crt_section_create() does, by options. Where time ends the search, the deviation
 * says how well the contours are known. Since 1.1.
 * @param options  NULL, or how; the relative width is that of the area, 1e-6 if it is 0
 */
CRT_API crt_status crt_section_create_with(crt_entity* entity, const double normal[3],
                                           double offset, double deviation,
                                           const crt_measure_options* options, crt_section** out);
/** Gives the area of a section, to 1e-6 of itself where that can be known. Since 1.1. */
CRT_API crt_status crt_section_area(const crt_section* section, crt_interval* out);
/**
 * Gives the deviation that is proved: each point of the true boundary is within it of the contours,
 * and each point of these within it of the boundary. It is INFINITY if there may be a part of which
 * no contour is known, as where a plane merely touches a cylinder. Since 1.1.
 */
CRT_API crt_status crt_section_deviation(const crt_section* section, double* out);
/**
 * Tells where the drawing is in the world: a point (x, y) of it is origin + x x_axis + y y_axis.
 * Since 1.1.
 * @param offset  gets that of the plane, which may be next to the one that was asked for
 */
CRT_API crt_status crt_section_frame(const crt_section* section, double origin[3], double x_axis[3],
                                     double y_axis[3], double* offset);
/**
 * Lends the contours as points in the world, whose chords are within the deviation that was asked
 * for of the lines and arcs. Each is closed, without its first point again at the end. Seen against
 * the normal, outer ones go counterclockwise, and holes clockwise. Since 1.1.
 * @param contour_count  gets how many contours there are
 * @param first          gets an array of contour_count + 1 numbers: contour i has the points from
 *                       first[i] up to before first[i + 1]
 * @param points         gets the points, three numbers each. Both arrays are the section's: they
 *                       live as long as it does
 */
CRT_API crt_status crt_section_contours(const crt_section* section, size_t* contour_count,
                                        const size_t** first, const double** points);
/**
 * Gives the contours as they are, lines and arcs in the coordinates of the drawing, as a new
 * profile. crt_profile_contour() tells their corners, and crt_extrusion_create() takes it. Since
 * 1.1.
 */
CRT_API crt_status crt_section_profile(const crt_section* section, crt_profile** out);
/**
 * Writes a section as a drawing: SVG or DXF, by the ending .svg or .dxf of the name. A scene unit
 * is a metre, so it prints at a scale of 1:1. Since 1.1.
 */
CRT_API crt_status crt_section_write(const crt_section* section, const char* path);
/**
 * Writes a section in another unit, and hatched. Since 1.1.
 * @param unit   a crt_unit: what a scene unit is
 * @param hatch  is the distance of hatching lines, which run at 45 degrees, in scene units; 0 draws
 *               none
 */
CRT_API crt_status crt_section_write_with(const crt_section* section, const char* path,
                                          int32_t unit, double hatch);

/** @} */

/* ---- surfaces as triangles ------------------------------------------------------------------ */

/** @defgroup surface_meshes Surfaces as triangles
 * These functions make triangles of a solid's surface, and files of them for slicers and other
 * programs. Those have a right-handed space: they show left and right exchanged, as CRT does with
 * their files. Threads: Shared.
 *
 * @code{.c}
 * crt_surface_mesh* surface = NULL;
 * if (crt_entity_tessellate(entity, 0.01, &surface) == CRT_OK)
 *   crt_surface_mesh_write(surface, "part.stl");
 * crt_surface_mesh_release(surface);
 * @endcode
 * @{ */

/**
 * Makes a closed mesh of a solid's surface. Corners lie on the surface, and sharp edges of the
 * solid are edges of triangles, but for rounding. What has no inside or no end is refused. Since
 * 1.1.
 * @param deviation  how far the triangles may be from the surface, and it from them, in scene
 * units; above 0
 */
CRT_API crt_status crt_entity_tessellate(crt_entity* entity, double deviation,
                                         crt_surface_mesh** out);
/**
 * Makes a mesh as crt_entity_tessellate() does, by options. Where time ends the search, the mesh is
 * as good as it is then, and its deviation INFINITY. Since 1.1.
 * @param options  NULL, or how; the relative width is not used
 */
CRT_API crt_status crt_entity_tessellate_with(crt_entity* entity, double deviation,
                                              const crt_measure_options* options,
                                              crt_surface_mesh** out);
/**
 * Returns the corners, 3 numbers each, which the mesh lends; NULL for NULL. Since 1.1.
 * @param vertex_count  gets how many there are; may be NULL
 */
CRT_API const double* crt_surface_mesh_positions(const crt_surface_mesh* mesh,
                                                 size_t* vertex_count);
/**
 * Returns the triangles, each the places of 3 corners a, b and c, which the mesh lends; NULL for
 * NULL. The cross product of b - a and c - a points out of the solid. Since 1.1.
 * @param triangle_count  gets how many there are; may be NULL
 */
CRT_API const uint32_t* crt_surface_mesh_indices(const crt_surface_mesh* mesh,
                                                 size_t* triangle_count);
/**
 * Returns how far triangles and surface are apart at most. That is proved. It is INFINITY where it
 * could not be, as where surfaces merely touch, or after very many cells; and for NULL. Since 1.1.
 */
CRT_API double crt_surface_mesh_deviation(const crt_surface_mesh* mesh);
/**
 * Writes a file, all of it or none, in the format that its ending says: .stl (binary), .obj, .ply
 * (binary), .3mf or .glb (glTF). Numbers are as they are, and a scene unit is a metre. It fails
 * with CRT_ERROR_UNSUPPORTED for another ending, with CRT_ERROR_LIMIT for more than the format has
 * room for, and with CRT_ERROR_IO where the file cannot be written. Since 1.1.
 */
CRT_API crt_status crt_surface_mesh_write(const crt_surface_mesh* mesh, const char* path);
/**
 * Writes a file of several parts, as crt_surface_mesh_write() does. 3MF and glTF have their names,
 * colours and unit, OBJ their names, and PLY their colours; STL has all triangles. Since 1.1.
 * @param meshes  the parts, at least one of which has triangles
 * @param names   NULL, or a name for each, any of which may be NULL
 * @param colors  NULL, or linear red, green, blue and coverage of each, in [0, 1]
 * @param unit    a crt_unit: what a scene unit is. Numbers in 3MF are in it, and those of glTF in
 * metres
 */
CRT_API crt_status crt_surface_meshes_write(const crt_surface_mesh* const* meshes, size_t count,
                                            const char* const* names, const double* colors,
                                            int32_t unit, const char* path);

/** @} */

/* ---- scenes --------------------------------------------------------------------------------- */

/** @defgroup scenes Scenes
 * A scene needs nothing to be prepared: without a camera it has the default one. Threads: One at a
 * time for each scene. What was prepared does not change with the scene.
 * @{ */

/** Makes an empty scene with the default camera, background and settings. */
CRT_API crt_status crt_scene_create(crt_scene** out);
/** Makes another scene with the same content. */
CRT_API crt_status crt_scene_copy(const crt_scene* scene, crt_scene** out);

/** Adds an entity after those in the scene. Its place, from 0, is the id that its hits report. */
CRT_API crt_status crt_scene_add_entity(crt_scene* scene, crt_entity* entity);
/** Adds a light. Errors name the field that is out of range. */
CRT_API crt_status crt_scene_add_light(crt_scene* scene, const crt_light* light);
/** Replaces the camera. Errors name the field that is out of range. */
CRT_API crt_status crt_scene_set_camera(crt_scene* scene, const crt_camera* camera);
/** Replaces the background, and retains its image. */
CRT_API crt_status crt_scene_set_background(crt_scene* scene, const crt_background* background);
/** Replaces all settings, and copies the texts. */
CRT_API crt_status crt_scene_set_settings(crt_scene* scene, const crt_settings* settings);
/** Puts an entity in the place of another one. Since 1.1. */
CRT_API crt_status crt_scene_replace_entity(crt_scene* scene, size_t index, crt_entity* entity);
/** Takes out an entity. Those after it move up, and so do the ids that they report. Since 1.1. */
CRT_API crt_status crt_scene_remove_entity(crt_scene* scene, size_t index);
/** Takes out all entities. */
CRT_API crt_status crt_scene_clear_entities(crt_scene* scene);
/** Takes out all lights. */
CRT_API crt_status crt_scene_clear_lights(crt_scene* scene);

/** Returns the number of entities; 0 for NULL. */
CRT_API size_t crt_scene_entity_count(const crt_scene* scene);
/** Returns the number of lights; 0 for NULL. */
CRT_API size_t crt_scene_light_count(const crt_scene* scene);
/** Gives the entity at a place from 0, as a reference that you must release. */
CRT_API crt_status crt_scene_get_entity(const crt_scene* scene, size_t index, crt_entity** out);
/**
 * Gives the light at a place from 0. This and the next three functions fill in as much of the
 * struct as its `struct_size` (which must be set) holds.
 */
CRT_API crt_status crt_scene_get_light(const crt_scene* scene, size_t index, crt_light* light);
/** Gives the camera; see crt_scene_get_light(). */
CRT_API crt_status crt_scene_get_camera(const crt_scene* scene, crt_camera* camera);
/** Gives the background. Its image belongs to the scene: retain it to keep it. */
CRT_API crt_status crt_scene_get_background(const crt_scene* scene, crt_background* background);
/** Gives the settings. Their texts are valid until the scene changes. */
CRT_API crt_status crt_scene_get_settings(const crt_scene* scene, crt_settings* settings);

/**
 * Writes the scene as a script in the CRT language, which renders the same picture. Meshes, images
 * and large height fields go into files beside it, whose names begin with its own and have a hash
 * of what they are. They are written first, so that the file of the script has the new text or
 * still the old one. Files of older texts stay. Numbers that the language cannot have are rounded:
 * see "Programs from scripts" in docs/command.md. It fails with CRT_ERROR_UNSUPPORTED for what it
 * has no form of at all, such as custom shapes. Since 1.1.
 */
CRT_API crt_status crt_scene_save_script(crt_scene* scene, const char* path);

/**
 * Checks the scene, which stays as it is, and builds what rays need. While an earlier prepared form
 * of the same scene still exists, it takes over what it can from the last one, as
 * crt_scene_prepare_from() does. Then a new camera, light, background or setting (other than the
 * precision) costs next to nothing, and a few other entities little.
 */
CRT_API crt_status crt_scene_prepare(crt_scene* scene, crt_prepared** out);

/** Says what preparing may be asked beyond the scene. All 0 is the default. */
typedef struct crt_prepare_options {
  uint32_t struct_size;
  uint32_t reserved; /**< 0 */
  /** NULL, or a callback that may cancel. Preparing then ends with CRT_ERROR_CANCELLED, within 0.1
   * s in scenes of up to a million primitives. Any of the threads that work may call it. */
  crt_poll_fn poll;
  void* poll_user;
  /** This is the most primitives that the scene may have. With more, preparing ends with
   * CRT_ERROR_LIMIT before it takes any memory. 0 means as many as the memory of the machine (or
   * container) may be enough for. It counts 1350 bytes for each, or 2700 in the exact tier, as the
   * largest primitives take; lone spheres take 600. There can never be more than 33554432. A
   * solid of several primitives, or a mesh, counts once if one entity is placed 16 times or more,
   * and each of its uses as one primitive of 512 bytes. */
  uint64_t max_primitives;
  /** NULL, or the scene that parts are taken from, as crt_scene_prepare_from() does. Since 1.1. */
  crt_prepared* previous;
} crt_prepare_options;

/** Fills in the defaults, which are all 0. */
CRT_API crt_status crt_prepare_options_init(crt_prepare_options* options, size_t struct_size);

/** Prepares as crt_scene_prepare() does, with options. NULL stands for the defaults. */
CRT_API crt_status crt_scene_prepare_with(crt_scene* scene, const crt_prepare_options* options,
                                          crt_prepared** out);

/**
 * Prepares a scene, and takes over from what was prepared earlier, of this scene or of any other,
 * what is made of the same entities. These are entities that were added to both, in the same order.
 * What was moved (crt_entity_with_transform()), given another material, replaced, added or removed
 * is prepared for itself. All answers and pictures are those of a scene that is prepared anew, to
 * the bit, and so are the starts of hits. With NULL it is crt_scene_prepare(). Since 1.1.
 */
CRT_API crt_status crt_scene_prepare_from(crt_scene* scene, crt_prepared* previous,
                                          crt_prepared** out);

/** @} */

/* ---- scripts -------------------------------------------------------------------------------- */

/** @defgroup scripts Scripts
 * These functions make scenes from scripts in the CRT language. Threads: Any thread.
 *
 * @code{.c}
 * crt_diagnostics *diagnostics = NULL;
 * if (crt_scene_from_script_file("part.crt", NULL, &diagnostics, &scene) != CRT_OK)
 *   fputs(crt_diagnostics_text(diagnostics), stderr);
 * crt_diagnostics_release(diagnostics);
 * @endcode
 * @{ */

/** A crt_file_content takes what a file holds; see crt_open_file_fn. */
typedef struct crt_file_content crt_file_content;

/** These are the values that a crt_open_file_fn returns. Any other number cancels the script. */
enum {
  CRT_FILE_GIVEN = 0,    /**< the content was appended (an empty file: nothing) */
  CRT_FILE_NOT_GIVEN = 1 /**< the file system is to be asked */
};

/**
 * Is called for each file that a script names, before the file system is asked. The
 * thread that runs the script calls it.
 * @param path  where the file would be: the script's directory or a resource directory, and its
 *   name
 */
typedef int (*crt_open_file_fn)(const char* path, crt_file_content* content, void* user);
/** Appends to the content of a file. It may be called inside a crt_open_file_fn only. */
CRT_API crt_status crt_file_content_append(crt_file_content* content, const void* bytes,
                                           size_t count);

/**
 * Gets a line that the script prints, without its end. A return value other than 0 cancels the
 * script.
 */
typedef int (*crt_print_fn)(const char* line, size_t length, void* user);

/**
 * Says what a script may see and use. All 0 is the default: files of its own directory, and the
 * limits below.
 */
typedef struct crt_script_options {
  uint32_t struct_size;
  int32_t allow_outside_files; /**< not 0: files outside its directory and the resource directories
                                  too */
  const char* const*
      resource_directories; /**< where files are looked for after the script's directory */
  uint64_t resource_directory_count;
  double t;                           /**< the frame of an animation: the script's constant `t` */
  const char* const* variable_names;  /**< top-level variables set from outside ... */
  const char* const* variable_values; /**< ... to these expressions of the language, such as "18" */
  uint64_t variable_count;
  const char* const* setting_names;  /**< attributes of Settings that win over the script's ... */
  const char* const* setting_values; /**< ... with these expressions */
  uint64_t setting_count;
  uint64_t max_steps;         /**< expressions evaluated; 0: 20 million */
  uint64_t max_entities;      /**< 0: 10 million */
  uint64_t max_call_depth;    /**< macros within macros, at most 1000; 0: 256 */
  uint64_t max_list_length;   /**< 0: 10 million */
  uint64_t max_string_bytes;  /**< 0: 16 MiB */
  uint64_t max_memory_bytes;  /**< of all lists and strings together, about; 0: 2 GiB */
  uint64_t max_source_bytes;  /**< of the script and its imports; 0: 64 MiB */
  uint64_t max_errors;        /**< reported before giving up; 0: 20 */
  crt_open_file_fn open_file; /**< NULL: files come from the file system */
  void* open_file_user;
  crt_print_fn print; /**< NULL: what is printed goes nowhere */
  void* print_user;
  crt_poll_fn poll; /**< NULL: only the limits end a script */
  void* poll_user;
  int32_t compat;   /**< 0: as the script's Settings say; 2015: it is a script of that year
                       (docs/compat.md) */
  int32_t reserved; /**< 0 */
  /** Pixels that all pictures have together that the script or its meshes name, and heights of
   * height fields. Headers of files say it before anything is decoded. 0: what a quarter of the
   * process's memory is enough for at 16 bytes each, and at most 2^27. Since 1.1. */
  uint64_t max_image_pixels;
} crt_script_options;

/** Fills in the defaults, which are all 0. */
CRT_API crt_status crt_script_options_init(crt_script_options* options, size_t struct_size);

/**
 * Runs a script.
 * @param text         UTF-8, `length` bytes; NULL if length is 0
 * @param name         stands for the script in messages; its directory is where its files are
 * looked for
 * @param options      NULL for the defaults
 * @param diagnostics  NULL, or gets all messages, warnings too, whether the script failed or not
 * (it is left untouched only if the arguments are wrong or memory ran out)
 * @return CRT_ERROR_SCRIPT, or the status of the first error: CRT_ERROR_IO, CRT_ERROR_LIMIT,
 *         CRT_ERROR_CANCELLED, ...
 */
CRT_API crt_status crt_scene_from_script(const char* text, size_t length, const char* name,
                                         const crt_script_options* options,
                                         crt_diagnostics** diagnostics, crt_scene** out);
/** Runs a script from a file, otherwise as crt_scene_from_script() does. */
CRT_API crt_status crt_scene_from_script_file(const char* path, const crt_script_options* options,
                                              crt_diagnostics** diagnostics, crt_scene** out);

/**
 * Makes an entity of a mesh file: OBJ, PLY, STL, 3MF or OFF. The content shows which it is, or else
 * the name. Positions and faces are read in the file's own numbers, of OBJ and PLY also normals and
 * (u, v), of OBJ materials. Vertices with equal coordinates become one, and triangles with two
 * equal corners are left out. What is inside says CRT_FILL_NONZERO if all shells are turned
 * outwards, but for cavities, and else CRT_FILL_EVEN_ODD; crt_entity_mesh_report() has which.
 * Material libraries and pictures that cannot be read are left out, too. Without options they are
 * looked for in the directory of the file and those below. Since 1.1.
 * @param path     where the file is
 * @param options  NULL opens the file of that path. With options, the file is looked for like those
 *                 of a script in the current directory: resource_directories, allow_outside_files,
 *                 open_file and max_image_pixels count, the others do not.
 * @return CRT_ERROR_IO if there is no such file or it is broken; the message has the line or byte
 */
CRT_API crt_status crt_mesh_load(const char* path, const crt_script_options* options,
                                 crt_entity** out);
/**
 * Makes an entity of a mesh file whose normals are computed, otherwise as crt_mesh_load() does.
 * Since 1.1.
 * @param smooth  as in crt_mesh
 */
CRT_API crt_status crt_mesh_load_smooth(const char* path, const crt_script_options* options,
                                        double smooth, crt_entity** out);
/**
 * Makes an entity of a mesh file by options, otherwise as crt_mesh_load_smooth() does. Since 1.1.
 * @param mesh  NULL for the defaults
 */
CRT_API crt_status crt_mesh_load_with(const char* path, const crt_script_options* options,
                                      double smooth, const crt_mesh_options* mesh,
                                      crt_entity** out);

/** Says how bad a diagnostic is. */
typedef enum crt_severity { CRT_SEVERITY_WARNING = 0, CRT_SEVERITY_ERROR } crt_severity;

/**
 * Holds one message about a script. Lines and columns count from 1, columns in code points. 0 means
 * that the message has no place.
 */
typedef struct crt_diagnostic {
  uint32_t struct_size;
  int32_t severity; /**< a crt_severity */
  int32_t status;   /**< a crt_status: what kind of error */
  int32_t line;
  int32_t column;
  int32_t length; /**< of the marked piece, in code points */
  const char* message;
  const char* file;
  const char* source_line; /**< the text of that line, without its end */
  uint64_t call_count;     /**< macro calls that led there */
} crt_diagnostic;

/** Names a macro call that led to an error. */
typedef struct crt_diagnostic_call {
  uint32_t struct_size;
  int32_t line; /**< where the macro was called */
  int32_t column;
  int32_t reserved;
  const char* name; /**< of the macro */
  const char* file;
} crt_diagnostic_call;

/* The texts of diagnostics belong to the handle. Threads: Shared. */

/** Returns the number of diagnostics; 0 for NULL. */
CRT_API size_t crt_diagnostics_count(const crt_diagnostics* diagnostics);
/**
 * Gives a diagnostic. It fills in as much as `diagnostic->struct_size` (which must be set) holds.
 */
CRT_API crt_status crt_diagnostics_get(const crt_diagnostics* diagnostics, size_t index,
                                       crt_diagnostic* diagnostic);
/** Gives a call that led to a diagnostic, innermost first. `call->struct_size` must be set. */
CRT_API crt_status crt_diagnostics_get_call(const crt_diagnostics* diagnostics, size_t index,
                                            size_t call_index, crt_diagnostic_call* call);
/**
 * Returns all of them as a compiler would print them, with source lines and carets; "" for NULL.
 */
CRT_API const char* crt_diagnostics_text(const crt_diagnostics* diagnostics);
/** Returns all of them as a JSON array of objects; "[]" for NULL. */
CRT_API const char* crt_diagnostics_json(const crt_diagnostics* diagnostics);

/** @} */

/* ---- rendering ------------------------------------------------------------------------------ */

/** @defgroup rendering Rendering
 * The pixels depend on the scene and the seed alone, not on threads or regions. Threads: Shared.
 *
 * @code{.c}
 * static int show(double fraction, void *user) { printf("%3.0f %%\n", 100 * fraction); return 0; }
 *
 * crt_render_options options;
 * crt_render_options_init(&options, sizeof options);
 * options.progress = show;
 * crt_render(prepared, &options, &image);
 * @endcode
 * @{ */

/**
 * Gets the share of a render that is done, now and then: first 0, never less than before, last 1.
 * One thread at a time calls it, which may be one of the render's own. A return value other than 0
 * cancels.
 */
typedef int (*crt_progress_fn)(double fraction, void* user);

/** Says how much a line of the log matters. */
typedef enum crt_log_level { CRT_LOG_INFO = 0, CRT_LOG_WARNING } crt_log_level;

/**
 * Gets the messages of a render. The thread that called crt_render() calls it, or the job's own.
 */
typedef void (*crt_log_fn)(int32_t level, const char* message, void* user);

/**
 * These are the bits of crt_render_options.aovs. They say what a render reports of each pixel
 * beside its colour, as channels of the image (see crt_image_channel()). Distance, entity and part
 * are those of one ray, through the middles of the pixel and of the lens. Normal and albedo are
 * means over the pixel's samples. All describe what camera rays meet first, be it glass or a
 * mirror.
 */
enum {
  CRT_AOV_DEPTH =
      1, /**< "Z": the distance along the ray from the camera; INFINITY where nothing is */
  CRT_AOV_NORMAL =
      2, /**< "N.X", "N.Y", "N.Z": in the world, turned to the viewer; 0 where nothing is */
  CRT_AOV_ID =
      4, /**< "id": crt_hit.entity_id, a channel of whole numbers; UINT32_MAX where nothing is */
  CRT_AOV_ALBEDO =
      8, /**< "albedo.R", "albedo.G", "albedo.B": the material's colour; 0 where nothing is */
  CRT_AOV_SAMPLES = 16, /**< "samples": how many the pixel has, a channel of whole numbers */
  CRT_AOV_ERROR = 32,   /**< "error": the half-width of the pixel's interval, see half_width_rms in
                             crt_render_stats; 1 for the plain grid */
  CRT_AOV_PART = 64 /**< "part": crt_hit_part.part_id, a channel of whole numbers; UINT32_MAX where
                       nothing is */
};

/**
 * Says what a render may be asked beyond the scene. All 0 is the default: the whole picture on all
 * cores.
 */
typedef struct crt_render_options {
  uint32_t struct_size;
  int32_t threads;  /**< at most; 0: what the calling TBB arena has; 1: none is started */
  int32_t region_x; /**< renders a part of the picture only, from the top left; the image has its
                       size */
  int32_t region_y;
  int32_t region_width; /**< region_width and region_height 0: all of it */
  int32_t region_height;
  uint64_t seed; /**< takes the place of the settings' seed; 0: the settings' */
  crt_progress_fn progress;
  void* progress_user;
  crt_log_fn log;
  void* log_user;
  int32_t
      passes; /**< above 0: renders so many (crt_render_stats.passes), whatever the time budget */
  uint32_t aovs; /**< bits CRT_AOV_*: what the image gets beside its colours, which stay the same */
  /** NULL, or the path of the file that keeps an unfinished picture which is rendered by passes
   * (target error, time budget, number of passes). The next render with the same checkpoint
   * continues from it, be it in another process, to the same picture as without the break. The file
   * is written within the first ten seconds, then every few seconds, and at the end, also when the
   * render is cancelled or fails. It is written whole or not at all, and never removed. If writing
   * fails, `log` gets a message and the render continues. A time budget counts from the break on. A
   * checkpoint of another picture is CRT_ERROR_INVALID_ARGUMENT. The settings and the light of up
   * to 1024 samples show which picture it is of. The call reads this text before it returns. */
  const char* checkpoint;
  /** This is the most things that a single ray may be tested against: objects, and primitives of
   * CSG objects, whose boxes it passes. It is checked after every 1024 of them. A ray that takes
   * more ends the render with CRT_ERROR_LIMIT. 0 means 4194304, about a second's work; a ray
   * through an ordinary scene takes some hundred.
   */
  uint64_t max_ray_steps;
} crt_render_options;

/** Fills in the defaults, which are all 0. */
CRT_API crt_status crt_render_options_init(crt_render_options* options, size_t struct_size);

/** Renders, and returns when done. `options` NULL stands for the defaults. */
CRT_API crt_status crt_render(crt_prepared* prepared, const crt_render_options* options,
                              crt_image** out);

/**
 * Starts to render on a thread of the job's own, which counts as one of `threads`. 0 threads means
 * as many as the TBB arena of the calling thread has. The callbacks must be good to call until the
 * job has ended.
 */
CRT_API crt_status crt_render_start(crt_prepared* prepared, const crt_render_options* options,
                                    crt_job** out);
/** Gives the share that is done, from 0 to 1. */
CRT_API crt_status crt_job_progress(crt_job* job, double* fraction);
/**
 * Returns 1 if the job has ended: it is done, was cancelled or failed. Else it returns 0, also for
 * NULL.
 */
CRT_API int32_t crt_job_is_finished(const crt_job* job);
/**
 * Gives the image so far, in which pixels that are not yet rendered are transparent black. It may
 * be called after the end too, even if the job was cancelled or failed.
 */
CRT_API crt_status crt_job_snapshot(crt_job* job, crt_image** out);
/**
 * Asks the job to stop, which it does within a few tiles, and returns at once. After the job's end
 * it has no effect.
 */
CRT_API crt_status crt_job_cancel(crt_job* job);
/**
 * Waits for the end and gives the image, at each call, or returns what went wrong. With `out` NULL
 * it only waits. The job's own callbacks must not call it: they get CRT_ERROR_INVALID_ARGUMENT.
 */
CRT_API crt_status crt_job_wait(crt_job* job, crt_image** out);

/** Says what a render did. Counts do not depend on the number of threads. */
typedef struct crt_render_stats {
  uint32_t struct_size;
  int32_t threads; /**< that were allowed to work on it */
  uint64_t pixels;
  uint64_t camera_rays;
  uint64_t shadow_rays;
  uint64_t reflection_rays;
  uint64_t refraction_rays;
  uint64_t rays_below_min_weight; /**< not traced: below the settings' min_weight */
  uint64_t rays_beyond_depth;     /**< not traced: the recursion depth was reached */
  uint64_t
      samples_over_ray_bound;  /**< camera samples that reached 65536 rays and dropped the rest */
  uint64_t intersection_tests; /**< rays against primitives or CSG objects */
  uint64_t interval_events;    /**< crossings sorted and flipped inside CSG objects */
  uint64_t media_lookups;
  uint64_t media_changes;
  uint64_t pattern_lookups;
  uint64_t lens_samples;
  double prepare_seconds; /**< wall-clock time, as is the next */
  double trace_seconds;
  uint64_t escalations; /**< decisions of CRT_PRECISION_EXACT that took exact arithmetic */
  /* These are the bytes that the prepared scene keeps. What it shares with its entities and images
   * is not counted. */
  uint64_t primitive_bytes; /**< primitives in their places, and which of their faces coincide */
  uint64_t
      csg_bytes; /**< how they are combined, and a bounding volume hierarchy for each CSG object */
  uint64_t tree_bytes;     /**< the bounding volume hierarchy over all objects */
  uint64_t material_bytes; /**< materials, and pictures that were converted to linear light */
  uint64_t samples_min;    /**< of a pixel */
  double samples_mean;
  uint64_t samples_max;
  int32_t passes;   /**< that were rendered; 0 without target error and time budget */
  int32_t reserved; /**< 0 */
  /* These say how far pixels are from the truth in 95 of 100 cases, on a display, where 1/255 is a
   * step of 8 bits. They are 0 where that is not known, without passes. */
  double half_width_rms; /**< the root of the mean square */
  double half_width_95;  /**< what 95 of 100 pixels are within */
  double half_width_max;
  uint64_t pixels_unresolved; /**< their half-width is above the target error */
  double unseen_share; /**< share of a pixel: what covers more has been seen in 95 of 100 cases */
  double cutoff_mean;  /**< light that a pixel may have lost by cutting off paths, if all light were
                          white */
  double cutoff_max;
  /* From here on since 1.1. */
  uint64_t undecided; /**< how often interval arithmetic left open what a ray crosses of an implicit
                           solid, so that the signs on both sides decided it */
} crt_render_stats;

/** @} */

/* ---- images --------------------------------------------------------------------------------- */

/** @defgroup images Images
 * Images have rows from the top, of linear RGBA floats with premultiplied alpha. Threads: Shared.
 *
 * @code{.c}
 * size_t stride = 0;
 * const float *rows = crt_image_pixels(image, &stride);
 * const float *pixel = (const float *)((const char *)rows + y * stride) + 4 * x;  // r, g, b, a
 * @endcode
 * @{ */

/**
 * Makes an image from your pixels: 4 floats each, rows `row_stride` bytes apart (0: without gaps).
 * All must be finite.
 */
CRT_API crt_status crt_image_create(uint32_t width, uint32_t height, const float* pixels,
                                    size_t row_stride, crt_image** out);
/**
 * Makes an image from 8-bit RGBA with straight alpha, as displays want it. Where the image serves
 * in a scene, its gamma undoes the scene's.
 */
CRT_API crt_status crt_image_from_rgba8(uint32_t width, uint32_t height, const uint8_t* pixels,
                                        size_t row_stride, crt_image** out);
/**
 * Reads a PNG, JPEG, EXR, HDR, TIFF, BMP, PNM, PFM or WebP file. Its content decides which it is.
 * @return CRT_ERROR_LIMIT, before anything is decoded, if its header says that its pixels, at 16
 *         bytes each, take more than a quarter of the process's memory
 */
CRT_API crt_status crt_image_read(const char* path, crt_image** out);
/**
 * Reads an image from a file's bytes, otherwise as crt_image_read() does. `name` (or NULL) is for
 * messages.
 */
CRT_API crt_status crt_image_decode(const void* bytes, size_t count, const char* name,
                                    crt_image** out);
/**
 * Returns how many pixels of the file that an image was read from had values which are no finite
 * numbers (NaN, infinities). Such values count as 0. The place of the first, row by row from the
 * top left, goes to *x and *y if there is one (either may be NULL). A render of a scene with such
 * an image warns through its log, too. The result is 0 for all other images.
 */
CRT_API uint64_t crt_image_not_finite(const crt_image* image, uint32_t* x, uint32_t* y);

/** Returns the number of pixels across; 0 for NULL. */
CRT_API uint32_t crt_image_width(const crt_image* image);
/** Returns the number of pixels down; 0 for NULL. */
CRT_API uint32_t crt_image_height(const crt_image* image);
/**
 * Returns the pixels, which belong to the image; NULL for NULL.
 * @param row_stride  gets the bytes from row to row; may be NULL
 */
CRT_API const float* crt_image_pixels(const crt_image* image, size_t* row_stride);
/**
 * Returns how many channels there are beside the colours (see crt_render_options.aovs); 0 for NULL.
 */
CRT_API size_t crt_image_channel_count(const crt_image* image);
/** Returns the name of a channel, which belongs to the image; NULL beyond the last one. */
CRT_API const char* crt_image_channel_name(const crt_image* image, size_t index);
/**
 * Returns the numbers of the channel of this name: width * height, without gaps, which belong to
 * the image. It is NULL if there is no such channel of floats.
 */
CRT_API const float* crt_image_channel(const crt_image* image, const char* name);
/**
 * Returns the numbers of a channel of whole numbers, such as "id", otherwise as crt_image_channel()
 * does.
 */
CRT_API const uint32_t* crt_image_channel_uint(const crt_image* image, const char* name);
/**
 * Writes the 8-bit RGBA that a file gets, with exposure, tone map and gamma applied and straight
 * alpha, into `pixels`.
 * @param row_stride  bytes from row to row of yours; 0: without gaps
 */
CRT_API crt_status crt_image_to_rgba8(const crt_image* image, uint8_t* pixels, size_t row_stride);

/** Says how to write a file. */
typedef struct crt_write_options {
  uint32_t struct_size;
  int32_t reproducible; /**< not 0: leaves out what changes from run to run (the render time) */
  int32_t
      colors_only; /**< not 0: leaves out all channels beside the colours, which only exr holds */
} crt_write_options;

/** Fills in the defaults, which are all 0. */
CRT_API crt_status crt_write_options_init(crt_write_options* options, size_t struct_size);

/**
 * Writes a file whose ending decides the format: png, tif, jpg, bmp and ppm get 8-bit integers, exr
 * and hdr linear floats. An image with channels beside the colours goes into exr only (else
 * CRT_ERROR_UNSUPPORTED). The file appears whole or not at all. It is written under another name in
 * the same folder. Then it takes the place, the permissions and where possible the owner of a
 * regular file that is there (other hard links of which stay as they were). Symbolic links are
 * followed. What is no regular file (a device, a named pipe, /dev/fd/N) is written to as it is. So
 * is a regular file that may be written in a folder that takes no other. A pipe whose reader has
 * gone is CRT_ERROR_IO, without a signal.
 */
CRT_API crt_status crt_image_write(const crt_image* image, const char* path);
/** Writes a file as crt_image_write() does, with options; NULL stands for the defaults. */
CRT_API crt_status crt_image_write_with(const crt_image* image, const char* path,
                                        const crt_write_options* options);
/**
 * Gives the bytes of such a file. `format` is its ending ("png", "exr", ...). `options` may be
 * NULL.
 */
CRT_API crt_status crt_image_encode(const crt_image* image, const char* format,
                                    const crt_write_options* options, crt_buffer** out);
/** Returns the bytes, which belong to the buffer; NULL for NULL. */
CRT_API const void* crt_buffer_data(const crt_buffer* buffer);
/** Returns the number of bytes; 0 for NULL. */
CRT_API size_t crt_buffer_size(const crt_buffer* buffer);

/**
 * Gives what rendering the image took. `stats->struct_size` must be set. All is 0 for an image that
 * was not rendered.
 */
CRT_API crt_status crt_image_stats(const crt_image* image, crt_render_stats* stats);
/**
 * Gives the settings that the image was rendered with. `settings->struct_size` must be set. The
 * texts belong to the image.
 */
CRT_API crt_status crt_image_settings(const crt_image* image, crt_settings* settings);
/**
 * Makes an image of the same pixels with other settings. Gamma and show_clip act when it is
 * written, and the texts go into files.
 */
CRT_API crt_status crt_image_with_settings(const crt_image* image, const crt_settings* settings,
                                           crt_image** out);

/** @} */

/* ---- ray queries ---------------------------------------------------------------------------- */

/** @defgroup queries Ray queries
 * Ray queries ask about the geometry without making a picture, and report the same crossings that
 * pictures see. Many rays at once are split among the threads of the calling TBB arena. Threads:
 * Shared.
 *
 * All queries treat a surface at the start of a ray alike. With CRT_PRECISION_STANDARD it counts as
 * behind the ray if it is within 32 u times the sum of the start's largest coordinate and the
 * object's size, measured across the surface (u = 2^-53; the size is half of the longest side of
 * the box around it), or within twice the error bound of its t if that is more. That is at most 64
 * u times the sum for lone primitives but implicit and custom ones. At the end, t_max, the same
 * holds of what is before it. So a ray from a point that was computed as origin + t * direction of
 * a hit does not meet that surface there again, nor does one to such a point. What is nearer than
 * that is not seen. What is behind the start is never reported as ahead of it. The point must not
 * come from much farther away than the size and the coordinates are, as then it is off by more, and
 * the ray must be at an angle of more than 2^-24 with the surface. A ray with a crt_start knows
 * where it begins and needs none of this.
 *
 * With CRT_PRECISION_EXACT the origin is taken for the point that its doubles say. A surface is met
 * exactly if t_min < t holds for the exact t, rounded to a double. So a ray from a point which
 * rounding has put just below a surface meets it at once, unless it has a crt_start.
 *
 * Strides are in bytes, so that rays and hits may lie inside larger structs of yours. 0 means one
 * after the other. Any alignment will do, and hits may take the place of their own rays.
 *
 * @code{.c}
 * const crt_ray ray = {{0, 0, -5}, {0, 0, 1}, 0, INFINITY};
 * crt_hit hit;
 * if (crt_intersect(prepared, &ray, 0, 1, &hit, 0) == CRT_OK && hit.t < INFINITY)
 *   printf("hit %u at t = %g\n", hit.entity_id, hit.t);
 * @endcode
 * @{ */

/**
 * A ray is the points origin + t * direction with t_min < t < t_max. The direction may have any
 * length but 0. If its components are more than 2^1022 apart, the smaller ones keep only the digits
 * that doubles have at 2^-1022 of the largest. A hit whose place is beyond the largest double does
 * not count. t_min may be -INFINITY, t_max INFINITY. The layout is fixed for ever: 64 bytes.
 */
typedef struct crt_ray {
  double origin[3];
  double direction[3];
  double t_min;
  double t_max;
} crt_ray;

/** These are the bits of crt_hit.flags. */
enum {
  CRT_HIT_ENTERING = 1, /**< the ray goes into the solid, or through a surface against its normal */
  CRT_HIT_BACKFACE = 2  /**< the ray comes from the side that the normal points away from */
};

/**
 * A hit is where a ray meets a surface. A miss has t = INFINITY and 0 elsewhere. The layout is
 * fixed for ever: 56 bytes.
 */
typedef struct crt_hit {
  double t;           /**< in units of |direction| */
  double normal[3];   /**< unit length, out of the solid; for a surface the side its maker chose */
  double u, v;        /**< as each primitive defines them */
  uint32_t entity_id; /**< of crt_entity_with_id(), or the entity's place in the scene */
  uint32_t flags;     /**< CRT_HIT_* */
} crt_hit;

/**
 * Finds the nearest hit of each ray. A surface at its start counts as is said above. In this and
 * the other queries a ray that would be tested against more than 4194304 things (see
 * crt_render_options.max_ray_steps) is CRT_ERROR_LIMIT. If any ray is invalid, no ray is traced,
 * and the message names its index.
 */
CRT_API crt_status crt_intersect(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                                 size_t count, crt_hit* hits, size_t hit_stride);
/**
 * Finds how far the nearest hit of each ray is, and of which entity. Both are as crt_intersect()
 * reports them, also for a surface at the start. It takes less time, as normals, u and v are not
 * computed. If any ray is invalid, nothing is written, and the message names its index.
 * @param distances   gets `count` numbers, in units of |direction|; INFINITY for a miss
 * @param entity_ids  gets as many, 0 for a miss; may be NULL
 */
CRT_API crt_status crt_distances(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                                 size_t count, double* distances, uint32_t* entity_ids);
/**
 * Writes for each ray 1 if it hits anything at all (transparent or not), else 0, into `count`
 * bytes. A surface at its start counts as for crt_intersect(). If any ray is invalid, nothing is
 * written, and the message names its index.
 */
CRT_API crt_status crt_occluded(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                                size_t count, uint8_t* occluded);
/**
 * Finds every crossing along a ray in order: of each entity, the solid intervals that CSG leaves. A
 * surface at its start counts as for crt_intersect().
 * @param hits      an array of `capacity` hits; NULL if that is 0
 * @param count     gets how many there are, which may be more than `capacity`; only so many are
 *   written
 */
CRT_API crt_status crt_crossings(crt_prepared* prepared, const crt_ray* ray, crt_hit* hits,
                                 size_t capacity, size_t* count);

/**
 * Says on which part of an entity a hit is. A miss has UINT32_MAX for the three ids, and 0 else.
 * Where surfaces of several parts coincide, it is the part that was combined first. The layout is
 * fixed for ever: 32 bytes.
 */
typedef struct crt_hit_part {
  uint32_t entity_id; /**< as in crt_hit */
  uint32_t part_id; /**< the innermost crt_entity_with_id() around the primitive that was hit, such
                         as a cutter; without any the entity's place in the scene */
  /**
   * Numbers the faces of the primitive. A box has 0 and 1 across x at its lower and upper end, 2
   * and 3 across y, 4 and 5 across z. Cylinders, cones and capsules have 0 for the side, 1 at
   * `from`, 2 at `to`. Rounded boxes have 0 to 5 as a box has, 6 to 17 for the edges, four each
   * along x, y and z, and 18 to 25 for the corners. Extrusions have 0 and 1 for the lower and the
   * upper end, and revolutions for where the turn begins and ends. Both have further numbers for
   * their sides. Height fields have 0 and 1 across x at the lower and the upper end, 2 and 3 across
   * z, 4 for the bottom, and further numbers for the triangles of their cells. Implicit solids have
   * 0 for where the field is 0, and the faces of their box from 1 on. Meshes have the place of the
   * triangle among those with an area. All others have 0.
   */
  uint32_t face;
  uint32_t reserved; /**< 0 */
  double u, v;       /**< as in crt_hit */
} crt_hit_part;

/**
 * Finds on which parts of entities the nearest hits are that crt_intersect() finds. If any ray is
 * invalid, nothing is written, and the message names its index. Since 1.1.
 */
CRT_API crt_status crt_hit_parts(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                                 size_t count, crt_hit_part* parts, size_t part_stride);

/**
 * Says on which surface a ray begins or ends. Every crt_full_hit has one. It is good for queries of
 * the crt_prepared that the hit is from, and nobody else knows what is in it. All 0 is nowhere. The
 * layout is fixed for ever: 16 bytes. Since 1.1.
 */
typedef struct crt_start {
  uint64_t bits[2];
} crt_start;

/**
 * A full hit is all that is known of where a ray meets a surface. A miss has t = INFINITY,
 * UINT32_MAX for the three ids, and 0 elsewhere. The layout is fixed for ever: 112 bytes.
 * Since 1.1.
 */
typedef struct crt_full_hit {
  double t;           /**< in units of |direction| */
  double position[3]; /**< on the surface, with less error than origin + t * direction */
  double normal[3];   /**< as in crt_hit */
  double u, v;        /**< as in crt_hit */
  uint32_t entity_id; /**< as in crt_hit_part, like the next two */
  uint32_t part_id;
  uint32_t face;
  uint32_t flags;  /**< CRT_HIT_* */
  uint64_t user;   /**< of the innermost crt_entity_with_user() around what was hit, or 0 */
  crt_start start; /**< for rays that go on from here */
} crt_full_hit;

/**
 * Finds the nearest hit of each ray, with all that is known of it. A ray with a start begins on the
 * surface of that hit, whatever its coordinates say. It never meets that surface there again, nor
 * others that coincide with it there, and it goes to the side that its direction says. So a walk
 * ends, in both tiers, and meets each place that crt_crossings() lists. With t_min = 0 the surface
 * is at the ray's origin: give the position of the hit. A ray that goes on along its own line may
 * also keep its origin and begin at t_min = t of the hit. If any ray is invalid, or a start is not
 * of this scene as far as one can see, no ray is traced, and the message names its index.
 * Since 1.1.
 * @param starts        as many as rays, or NULL; they may lie in `hits`, each in its own ray's hit
 * @param start_stride  bytes from one to the next; 0 means one after the other
 */
CRT_API crt_status crt_trace(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                             const crt_start* starts, size_t start_stride, size_t count,
                             crt_full_hit* hits, size_t hit_stride);
/**
 * Writes for each ray 1 if anything lies between its start and its end, else 0, into `count` bytes.
 * A ray that has an end ends at t_max on the surface of that hit, which does not block it there.
 * Errors are as for crt_trace(). Since 1.1.
 * @param starts        as many as rays, or NULL
 * @param ends          as many as rays, or NULL
 * @param start_stride  bytes from one start to the next, and from one end to the next
 */
CRT_API crt_status crt_blocked(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                               const crt_start* starts, const crt_start* ends, size_t start_stride,
                               size_t count, uint8_t* blocked);
/**
 * Finds every crossing of each ray in order, as crt_crossings() does, with all that is known of it.
 * Those of ray i are hits[first[i]] ... hits[first[i + 1] - 1]. Errors are as for crt_trace(). If
 * `capacity` is too small, it returns CRT_ERROR_LIMIT and writes no hits, but first[count] is how
 * many there are. Since 1.1.
 * @param starts  as many as rays, or NULL
 * @param hits    an array of `capacity` hits; NULL if that is 0
 * @param first   gets `count` + 1 numbers
 */
CRT_API crt_status crt_trace_all(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                                 const crt_start* starts, size_t start_stride, size_t count,
                                 crt_full_hit* hits, size_t capacity, size_t* first);
/**
 * Finds in what each of several points is: in the innermost solid around it, as pictures order
 * media. Of solids that overlap without one being in the other that is the one which a ray along
 * (0.739, 0.567, 0.363) leaves first. What is exactly on a surface is on the side to which that
 * points. If a point is not finite, nothing is written, and the message names its index. Since 1.1.
 * @param points      each 3 numbers
 * @param stride      bytes from one point to the next; 0 means one after the other
 * @param entity_ids  gets `count` numbers; UINT32_MAX for a point in no solid
 * @param part_ids    gets as many, of the first part as written that holds the point; may be NULL
 * @param users       gets as many, of crt_entity_with_user(), or 0; may be NULL
 */
CRT_API crt_status crt_locate(crt_prepared* prepared, const double* points, size_t stride,
                              size_t count, uint32_t* entity_ids, uint32_t* part_ids,
                              uint64_t* users);

/**
 * Computes the rays through places of the picture and the middle of the camera's lens, for programs
 * that trace them by themselves. The picture has the size of the scene's settings. A place is x, y
 * in pixels from the left and from the top: (0.5, 0.5) is the middle of the first pixel. Places
 * beside the picture are legal. Directions have unit length, t_min is 0 and t_max INFINITY. If a
 * place is not finite or too far outside, nothing is written, and the message names its index.
 * Since 1.1.
 * @param xy  2 * `count` numbers
 */
CRT_API crt_status crt_camera_rays(crt_prepared* prepared, const double* xy, size_t count,
                                   crt_ray* rays, size_t ray_stride);

/** @} */

/* ---- solids of your own --------------------------------------------------------------------- */

/** @defgroup custom Solids of your own
 * A program adds a finite solid of its own by two functions: one says what a ray crosses, and the
 * other has the normal of a point. Entities of it may be placed, combined and given materials as
 * all others.
 *
 * Both are called from any thread, from many at once, and the same question must always have the
 * same answer. If one returns another number than 0, the call that asked ends with
 * CRT_ERROR_CANCELLED, and crt_cancel_value() is that number. An answer that cannot be ends it with
 * CRT_ERROR_INVALID_ARGUMENT, and the message says what was wrong and along which ray.
 * @{ */

/** A crossing is where a ray crosses the surface of the solid. Fixed for ever: 24 bytes. */
typedef struct crt_custom_crossing {
  double t;          /**< along the ray that was given */
  double error;      /**< |t - true t| is at most this, for that ray */
  uint32_t face;     /**< the face that is crossed, below crt_custom.face_count */
  uint32_t reserved; /**< not read */
} crt_custom_crossing;

/** A point is what is known of a place on the surface. Fixed for ever: 40 bytes. */
typedef struct crt_custom_point {
  double normal[3]; /**< out of the solid, of any length but 0 */
  double u, v;
} crt_custom_point;

/**
 * Says what the ray crosses from t_min to t_max, which is where it is within the bounds: in
 * ascending t, first where it enters the solid, then where it leaves it, and so on. So there is an
 * even number of crossings. The direction has unit length, t may be negative, and the origin is
 * near the bounds. A ray that only touches the solid may have no crossings or two.
 *
 * The errors must be true, also where the ray grazes. What is within them of a surface that a ray
 * starts on is taken for that surface. The library adds what its own rounding of the ray does:
 * about 1e-15 of the largest coordinate, divided by the cosine of the ray to the normal.
 * @param crossings  has place for `capacity` crossings
 * @param count      gets how many there are. If that is more than `capacity`, the function is
 *                   called again with place for as many. More than 65536 are an error.
 */
typedef int (*crt_custom_crossings_fn)(const crt_ray* ray, crt_custom_crossing* crossings,
                                       size_t capacity, size_t* count, void* user);
/**
 * Says what is known of a place where a ray crosses a face. It is on the surface to the error of
 * the crossing.
 * @param point  all 0 before the call
 */
typedef int (*crt_custom_point_fn)(const double position[3], uint32_t face, crt_custom_point* point,
                                   void* user);
/** Is called once, from any thread, when the library will not use `user` again. */
typedef void (*crt_release_fn)(void* user);

/** Describes a solid of your own. */
typedef struct crt_custom {
  uint32_t struct_size;
  uint32_t face_count; /**< how many faces there are, from 1 to 65536; crt_hit_parts() says which
                            was hit */
  double lower[3]; /**< what the solid lies within; rays that miss this box are not asked about */
  double upper[3]; /**< above `lower` by at least 1e-100 */
  crt_custom_crossings_fn crossings;
  crt_custom_point_fn point;
  crt_release_fn release; /**< NULL, or called when nothing uses the solid any more */
  void* user;             /**< is handed to the functions */
  const char* name;       /**< what messages call the solid; NULL: "a custom shape" */
} crt_custom;

/** Fills in the defaults: 1 face, and 0 elsewhere. Since 1.1. */
CRT_API crt_status crt_custom_init(crt_custom* custom, size_t struct_size);
/**
 * Makes an entity of a solid of your own. The struct and the name are copied. If this fails,
 * `release` is not called. Since 1.1.
 */
CRT_API crt_status crt_custom_create(const crt_custom* custom, crt_entity** out);

/** @} */

/* ---- rendering on many machines ------------------------------------------------------------- */

/** @defgroup farm Rendering on many machines
 * A render of a script is planned as tasks, which any machines work on, and merged. The job is a
 * folder that all of them see, or that is copied to and fro. Nothing here starts a process or talks
 * to a network: that is for what calls it (docs/farm.md). The merged pictures are to the byte those
 * of one machine, whatever the tasks are and however often each of them ran. Threads: Any thread.
 *
 * @code{.c}
 * crt_farm_options options;
 * crt_farm_job job;
 * crt_farm_options_init(&options, sizeof options);
 * options.tasks = 64;
 * job.struct_size = sizeof job;
 * if (crt_farm_plan("scene.crt", "job", &options, &job)) return;
 * for (int32_t task = 0; task < job.tasks; ++task) crt_farm_work("job", task, NULL, NULL);
 * crt_farm_merge("job", NULL, NULL);
 * @endcode
 * @{ */

/** Says what is to be rendered on many machines, and how it is split. */
typedef struct crt_farm_options {
  uint32_t struct_size;
  int32_t has_frames;   /**< not 0: renders the whole t from first_frame to last_frame; 0: one
                             picture, at the script options' t */
  int32_t first_frame;  /**< of an animation */
  int32_t last_frame;   /**< is rendered, too */
  int32_t tasks;        /**< in [1, 1000000]; 0: as many as last `least_seconds` each */
  int32_t tile_width;   /**< pixels across of the tiles that pictures are cut into; 0: they are cut
                             where that makes the tasks' costs equal */
  int32_t tile_height;  /**< pixels down; 0 if tile_width is */
  int32_t reserved;     /**< 0 */
  double least_seconds; /**< that a task may take on one core; 0: 60 */
  /** NULL, or what the script gets. Of the limits max_steps and max_image_pixels count. `print` and
   * `poll` are not called. allow_outside_files and open_file are CRT_ERROR_INVALID_ARGUMENT, as the
   * job has all files of the script. */
  const crt_script_options* script;
  /** NULL, or what the tasks get: `seed`, `passes`, `max_ray_steps` and `aovs`. Planning uses
   * `threads` and `progress`, which is first 0 and never 1. A region and a checkpoint are
   * CRT_ERROR_INVALID_ARGUMENT. */
  const crt_render_options* render;
  uint64_t max_primitives; /**< see crt_prepare_options */
} crt_farm_options;

/** Fills in the defaults, which are all 0. Since 1.1. */
CRT_API crt_status crt_farm_options_init(crt_farm_options* options, size_t struct_size);

/** Says what a job consists of. */
typedef struct crt_farm_job {
  uint32_t struct_size;
  int32_t tasks;       /**< their numbers go from 0 to tasks - 1 */
  int32_t has_frames;  /**< 1: it is an animation; 0: one picture */
  int32_t first_frame; /**< 0 if it is one picture */
  int32_t last_frame;
  int32_t width; /**< of the pictures */
  int32_t height;
  int32_t passes;         /**< see crt_render_options; a time budget becomes such a number */
  int32_t has_channels;   /**< 1: there are channels beside the colours, so that pictures are EXR */
  int32_t reserved;       /**< 0 */
  double seconds;         /**< estimated, of one core, for all tasks */
  double longest_seconds; /**< estimated, for the task that takes longest */
} crt_farm_job;

/**
 * Makes a job of a script, in a folder that must not exist or be empty. It renders a small picture
 * of some frames to see where time goes. A time budget is taken for what this machine does in that
 * time with the render options' threads. Since 1.1.
 * @param options  NULL for the defaults
 * @param plan     gets what the job consists of; its struct_size must be set
 * @return CRT_ERROR_SCRIPT if the script is wrong; the message has the diagnostics
 */
CRT_API crt_status crt_farm_plan(const char* script, const char* job,
                                 const crt_farm_options* options, crt_farm_job* plan);
/** Reads what a job consists of. `plan->struct_size` must be set. Since 1.1. */
CRT_API crt_status crt_farm_read_plan(const char* job, crt_farm_job* plan);

/** Says how a task is worked on. */
typedef struct crt_farm_work_options {
  uint32_t struct_size;
  int32_t threads;          /**< at most; 0: what the calling TBB arena has */
  crt_progress_fn progress; /**< gets the share of the task that is done */
  void* progress_user;
} crt_farm_work_options;

/** Fills in the defaults, which are all 0. Since 1.1. */
CRT_API crt_status crt_farm_work_options_init(crt_farm_work_options* options, size_t struct_size);

/**
 * Renders a task of a job, and leaves its part. A task whose part is there and whole is not
 * rendered again. A part is written whole or not at all, and has the same bytes whoever makes it.
 * So any number of processes and threads may work on one task. Since 1.1.
 * @param task      from 0 on
 * @param options   NULL for the defaults
 * @param rendered  NULL, or gets 1, or 0 if the part was there
 */
CRT_API crt_status crt_farm_work(const char* job, int32_t task,
                                 const crt_farm_work_options* options, int32_t* rendered);

/** Lists what merging reports. */
typedef enum crt_farm_report {
  CRT_FARM_REPORT_WRITTEN = 0, /**< the picture of a frame was written */
  CRT_FARM_REPORT_MISSING,     /**< a task has no part */
  CRT_FARM_REPORT_REFUSED      /**< the part of a task is damaged, or of another plan */
} crt_farm_report;

/**
 * Gets what merging has found, from the thread that merges.
 * @param report  a crt_farm_report
 * @param number  of the frame or task; the frame of a single picture is 0
 * @param why     says why a part is refused and names its file; else ""
 */
typedef void (*crt_farm_report_fn)(int32_t report, int32_t number, const char* why, void* user);

/** Says where merged pictures go. */
typedef struct crt_farm_merge_options {
  uint32_t struct_size;
  int32_t reserved; /**< 0 */
  /** NULL: the pictures go into the job's folder. Else it is the path of the picture. For frames a
   * run of # or a %04d in its name becomes the number, which else goes before the ending. */
  const char* output;
  const int32_t* skip; /**< frames to leave out, such as those that were merged before */
  uint64_t skip_count;
  crt_farm_report_fn report; /**< is called at the end, for all that was found */
  void* report_user;
  crt_poll_fn poll; /**< is asked between parts */
  void* poll_user;
} crt_farm_merge_options;

/** Fills in the defaults, which are all 0. Since 1.1. */
CRT_API crt_status crt_farm_merge_options_init(crt_farm_merge_options* options, size_t struct_size);

/**
 * Writes the pictures all of whose parts are there, and reports what is missing. It may be called
 * again at any time. Working on refused tasks again replaces their parts. Since 1.1.
 * @param options   NULL for the defaults
 * @param complete  NULL, or gets 1 if no part was missing or refused, else 0
 */
CRT_API crt_status crt_farm_merge(const char* job, const crt_farm_merge_options* options,
                                  int32_t* complete);

/** Says how far a job is. Times are in seconds. */
typedef struct crt_farm_progress {
  uint32_t struct_size;
  int32_t waiting;      /**< how many tasks nobody works on */
  int32_t running;      /**< how many somebody works on, or did within the last minute */
  int32_t lost;         /**< whose workers have not been heard of for over a minute */
  int32_t done;         /**< whose parts are there */
  int32_t reserved;     /**< 0 */
  double share;         /**< of the work that is done, estimated, in [0, 1] */
  double seconds_spent; /**< that all tasks done have taken together */
  double seconds_left;  /**< estimated, for one worker */
} crt_farm_progress;

/** Reads how far a job is. `progress->struct_size` must be set. Since 1.1. */
CRT_API crt_status crt_farm_status(const char* job, crt_farm_progress* progress);

/** Says how far a task is. */
typedef enum crt_farm_task_state {
  CRT_FARM_TASK_WAITING = 0, /**< nobody works on it */
  CRT_FARM_TASK_RUNNING,     /**< somebody does, or did within the last minute */
  CRT_FARM_TASK_LOST,        /**< who began has not been heard of for over a minute */
  CRT_FARM_TASK_DONE         /**< its part is there */
} crt_farm_task_state;

/** Is one task of a job. The layout is fixed for ever: 160 bytes. */
typedef struct crt_farm_task {
  int32_t state;    /**< a crt_farm_task_state */
  int32_t reserved; /**< 0 */
  double seconds;   /**< that rendering it took; 0 if it is not known */
  double estimated; /**< the seconds that were planned for it, on one core */
  double share;     /**< that is done, in [0, 1] */
  char worker[128]; /**< the machine and process, cut at 127 bytes; "" if there is none */
} crt_farm_task;

/**
 * Reads how far each task of a job is. Since 1.1.
 * @param tasks  an array of `capacity` tasks; NULL if that is 0
 * @param count  gets how many there are, which may be more than `capacity`; only so many are
 *   written
 */
CRT_API crt_status crt_farm_tasks(const char* job, crt_farm_task* tasks, size_t capacity,
                                  size_t* count);
/**
 * Makes a contact sheet of all that is there: the frames side by side, each at most `cell` pixels
 * across, with transparent black where parts are missing. Since 1.1.
 */
CRT_API crt_status crt_farm_sheet(const char* job, int32_t cell, crt_image** out);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
