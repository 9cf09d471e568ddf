// A part is the file that a task leaves: the pixels of its pieces in linear light, and what is to
// be known of them.
#pragma once

#include <array>

#include "farm/manifest.hpp"

namespace crt::farm {

/// A RenderedPiece is a piece of a frame's picture.
struct RenderedPiece {
  Piece piece;
  /// The image has the settings and those of the statistics that all machines agree on.
  Image image;
  std::uint64_t cutoff_units = 0;  ///< see core::CutoffSum
  double brightest = 1;            ///< see core::brightest_of
};

/// These counts of a picture are the sums of those of its pieces. All machines agree on them.
inline constexpr std::array summed_counts = {&RenderStats::camera_rays,
                                             &RenderStats::shadow_rays,
                                             &RenderStats::reflection_rays,
                                             &RenderStats::refraction_rays,
                                             &RenderStats::rays_beyond_depth,
                                             &RenderStats::rays_below_min_weight,
                                             &RenderStats::samples_over_ray_bound,
                                             &RenderStats::pixels,
                                             &RenderStats::pixels_unresolved};

/// Writes the part of a task, whole or not at all. Throws Error (io).
void write_part(const Job& job, int task, const std::vector<RenderedPiece>& pieces);

/// Reads the part of a task. Throws Error (io) where it is damaged, or is of another plan or task.
std::vector<RenderedPiece> read_part(const Job& job, int task);

/// Says whether the part's beginning is that of this plan and task. The rest is not read.
bool has_part(const Job& job, int task);

/// Throws Error (io) where a file of a job is to be written and there is something else than a
/// regular file: a pipe would make the worker wait, and a link lead it out of the job.
void check_replaceable(const std::filesystem::path& file);

}  // namespace crt::farm
