#pragma once

#include <cstdint>
#include <string>

namespace crt {

/// MemoryUse counts the bytes of memory that a prepared scene keeps, by what they are for. What it
/// shares with the scene that it was made from (the entities themselves, pictures in linear light)
/// is not counted.
struct MemoryUse {
  std::uint64_t primitives = 0;  ///< each in its place, and which of their faces coincide
  std::uint64_t csg =
      0;  ///< how they are combined, and a bounding volume hierarchy for each CSG object
  std::uint64_t tree = 0;       ///< the bounding volume hierarchy over all objects
  std::uint64_t materials = 0;  ///< and pictures that were converted to linear light

  /// Returns the sum of all of them.
  std::uint64_t total() const { return primitives + csg + tree + materials; }
};

/// RenderStats say what a render did. Counts are exact and do not depend on the number of threads.
struct RenderStats {
  // Rays by kind.
  std::uint64_t camera_rays = 0;
  std::uint64_t shadow_rays = 0;
  std::uint64_t reflection_rays = 0;
  std::uint64_t refraction_rays = 0;
  /// Counts rays that were not traced because their weight was below Settings::min_weight.
  std::uint64_t rays_below_min_weight = 0;
  /// Counts rays that were not traced because the recursion depth was reached.
  std::uint64_t rays_beyond_depth = 0;
  /// Counts camera samples that reached the fixed bound on rays a sample (65536) and dropped the
  /// rest.
  std::uint64_t samples_over_ray_bound = 0;

  // Work. These may vary with how the acceleration structure was built.
  std::uint64_t intersection_tests = 0;  ///< rays against primitives or CSG objects
  std::uint64_t interval_events = 0;     ///< crossings sorted and flipped inside CSG objects

  /// Counts how often Precision::exact had to replace bounded rounding by exact arithmetic. It is 0
  /// with Precision::standard.
  std::uint64_t escalations = 0;

  /// Counts how often something of what a ray crosses of an Implicit could not be decided by
  /// interval arithmetic, within the limit on the work. The signs on both sides decided it then.
  std::uint64_t undecided = 0;

  /// Count how often the solids around a point were looked up, and media entered or left.
  std::uint64_t media_lookups = 0;
  std::uint64_t media_changes = 0;
  std::uint64_t pattern_lookups = 0;
  std::uint64_t lens_samples = 0;

  // Accuracy. Errors are in what a display shows, from 0 to 1; 1/255 is a step of 8 bits.
  /// These are the samples of a pixel.
  std::uint64_t samples_min = 0;
  double samples_mean = 0;
  std::uint64_t samples_max = 0;
  /// This is the number of passes that were rendered. It is 0 for the plain grid (no target error,
  /// no time budget). RenderOptions::passes gives the same picture.
  int passes = 0;
  /// The half-width of a pixel is half of the width of the interval that holds its true value in 95
  /// of 100 cases. Given are, over all pixels, the root of the mean of its square, what 95 of 100
  /// pixels are within, and the greatest. They are 0 for the plain grid, for which nothing is
  /// known.
  double half_width_rms = 0;
  double half_width_95 = 0;
  double half_width_max = 0;
  /// Counts pixels that have a greater half-width than the target error.
  std::uint64_t pixels_unresolved = 0;
  /// What covers more than this share of a pixel has been seen there in 95 of 100 cases. It is 3 /
  /// samples_min.
  double unseen_share = 0;
  /// This is what cutting off paths (recursion depth, weight, number of rays) may have taken from a
  /// pixel. It is the weight of the rays that were not traced, as if each had brought as much light
  /// as white or, if that is brighter, as the brightest background. Given are the mean over all
  /// pixels and the greatest.
  double cutoff_mean = 0;
  double cutoff_max = 0;

  std::uint64_t pixels = 0;
  int threads = 0;  ///< threads that were allowed to work on it

  // Wall-clock seconds by stage; 0 for a stage that the library did not do.
  double parse_seconds = 0;
  double prepare_seconds = 0;
  double trace_seconds = 0;
  double write_seconds = 0;

  MemoryUse memory;  ///< of the prepared scene
};

}  // namespace crt
