#pragma once

#include <cstdint>
#include <string>

namespace crt {

/// Bytes of memory that a prepared scene keeps, by what they are for. What it shares with the scene
/// that it was made from (the entities themselves, pictures in linear light) is not counted.
struct MemoryUse {
  std::uint64_t primitives = 0;  ///< each in its place, and which of their faces coincide
  std::uint64_t csg = 0;         ///< how they are combined, and a tree of boxes for each CSG object
  std::uint64_t tree = 0;        ///< the tree of boxes over all objects
  std::uint64_t materials = 0;   ///< and pictures that had to be taken to linear light

  /// All of them together.
  std::uint64_t total() const { return primitives + csg + tree + materials; }
};

/// What a render did. Counts are exact and do not depend on the number of threads.
struct RenderStats {
  // Rays by kind.
  std::uint64_t camera_rays = 0;
  std::uint64_t shadow_rays = 0;
  std::uint64_t reflection_rays = 0;
  std::uint64_t refraction_rays = 0;
  /// Rays not traced because their weight was below Settings::min_weight.
  std::uint64_t rays_below_min_weight = 0;
  /// Rays not traced because the recursion depth was reached.
  std::uint64_t rays_beyond_depth = 0;
  /// Camera samples that reached the fixed bound on rays a sample (65536) and dropped the rest.
  std::uint64_t samples_over_ray_bound = 0;

  // Work. These may vary with the way the acceleration structure was built.
  std::uint64_t intersection_tests = 0;  ///< rays against primitives or CSG objects
  std::uint64_t interval_events = 0;     ///< crossings sorted and flipped inside CSG objects

  /// How often Precision::exact had to go on from bounded rounding to exact arithmetic; 0 in the
  /// standard one.
  std::uint64_t escalations = 0;

  /// How often the solids around a point were looked up, and media entered or left.
  std::uint64_t media_lookups = 0;
  std::uint64_t media_changes = 0;
  std::uint64_t pattern_lookups = 0;
  std::uint64_t lens_samples = 0;

  // Accuracy. Errors are in what a display shows, from 0 to 1; 1/255 is a step of 8 bits.
  /// Samples of a pixel.
  std::uint64_t samples_min = 0;
  double samples_mean = 0;
  std::uint64_t samples_max = 0;
  /// Passes that were rendered; 0 for the plain grid (no target error, no time budget).
  /// RenderOptions::passes gives the same picture.
  int passes = 0;
  /// Half of the width of the interval around a pixel that holds its true value in 95 of 100 cases:
  /// over all pixels the root of the mean of its square, what 95 of 100 pixels are within, and the
  /// greatest. 0 for the plain grid, which does not know.
  double half_width_rms = 0;
  double half_width_95 = 0;
  double half_width_max = 0;
  /// Pixels that have a greater half-width than the target error.
  std::uint64_t pixels_unresolved = 0;
  /// What covers more than this share of a pixel has been seen there in 95 of 100 cases: 3 /
  /// samples_min.
  double unseen_share = 0;
  /// What cutting off paths (recursion depth, weight, number of rays) may have taken from a pixel:
  /// the weight of the rays that were not traced, as if each had brought as much light as white or,
  /// if that is brighter, as the brightest background; the mean of all pixels and the greatest.
  double cutoff_mean = 0;
  double cutoff_max = 0;

  std::uint64_t pixels = 0;
  int threads = 0;  ///< that were allowed to work on it

  // Wall-clock seconds by stage; 0 for a stage that the library did not do.
  double parse_seconds = 0;
  double prepare_seconds = 0;
  double trace_seconds = 0;
  double write_seconds = 0;

  MemoryUse memory;  ///< of the prepared scene
};

}  // namespace crt
