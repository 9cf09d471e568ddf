// A Workspace is what one thread works with: memory that it reuses from ray to ray, and its counts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/math/packed_direction.hpp"
#include "core/prepare/prepared_data.hpp"
#include "core/render/first_hit.hpp"
#include "core/render/media_along_ray.hpp"
#include "core/sampling/pixel_samples.hpp"
#include "core/sampling/sample_numbers.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

enum class RayKind : std::uint8_t { camera, reflection, refraction, diffuse };

/// A PathState is what a ray has behind it.
struct PathState {
  RayKind kind = RayKind::camera;
  bool is_scattered = false;  ///< whether the direction of it, or of a ray before it, was drawn
  int bounces = 0;            ///< in mirrors and glass, before this ray
  int diffuse_bounces = 0;
  PackedDirection normal;  ///< of the surface, where there are ChosenLights
  double path_length = 0;  ///< from the camera to the ray's origin
  /// This is the density by solid angle with which its direction was drawn. It is 0 for rays whose
  /// surfaces have taken no samples of lights instead.
  double density = 0;
  MediaLists::List media = MediaLists::empty;
  /// This is the MediaLists::mark() when the ray was put aside. It needs no lists made later.
  std::uint32_t media_mark = 0;
};

struct PathRay {
  Vec3 origin;
  Vec3 direction;  ///< unit length
  StartPoint start;
  Rgb weight;  ///< share of the pixel's light that comes along it
  PathState path;
};

/// A PathStack is a stack of rays that wait.
class PathStack {
 public:
  bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  /// Returns a place on top, where there may have been another ray.
  PathRay& push() {
    if (count_ == places_.size()) places_.emplace_back();
    return places_[count_++];
  }
  const PathRay& top() const { return places_[count_ - 1]; }
  void pop() { --count_; }
  std::span<const PathRay> all() const { return std::span(places_).first(count_); }

 private:
  std::vector<PathRay> places_;  ///< made once
  std::size_t count_ = 0;
};

/// A SampleWork is one of the samples that are traced side by side.
struct SampleWork {
  MediaLists media;
  PathStack pending;  ///< what follows when that is done
  int rays = 0;       ///< the number of rays followed
  SampleId id;        ///< for the numbers that it draws
};

/// A CutoffSum is the weight of rays that were not followed, of some pixels.
struct CutoffSum {
  static constexpr double unit = 0x1p-24;
  static constexpr double max_of_pixel = 256;

  /// The sum is in whole units, so that the order does not matter.
  std::uint64_t units = 0;
  double most = 0;

  void add(double pixel) {
    const double weight = std::min(pixel, max_of_pixel);
    units += static_cast<std::uint64_t>(std::ceil(weight / unit));
    most = std::max(most, weight);
  }
  void add(const CutoffSum& other) {
    units += other.units;
    most = std::max(most, other.most);
  }
  double total() const { return unit * static_cast<double>(units); }
};

/// All threads of a render count these, each for itself.
inline constexpr std::array summed_counts = {&RenderStats::camera_rays,
                                             &RenderStats::shadow_rays,
                                             &RenderStats::reflection_rays,
                                             &RenderStats::refraction_rays,
                                             &RenderStats::rays_below_min_weight,
                                             &RenderStats::rays_beyond_depth,
                                             &RenderStats::samples_over_ray_bound,
                                             &RenderStats::intersection_tests,
                                             &RenderStats::interval_events,
                                             &RenderStats::escalations,
                                             &RenderStats::undecided,
                                             &RenderStats::media_lookups,
                                             &RenderStats::media_changes,
                                             &RenderStats::pattern_lookups,
                                             &RenderStats::lens_samples,
                                             &RenderStats::pixels,
                                             &RenderStats::pixels_unresolved};

struct Workspace {
  RayWorkspace rays;
  RenderStats stats;
  CutoffSum cutoff;
  std::array<SampleWork, packet_size> samples;
  std::vector<RayHit> crossings;
  std::vector<RayHit> entered;
  std::vector<Medium> surrounding;
  MediaAlongRay media_along_ray;
  CrossingList scratch;
  SurfacePointLanes points;  ///< that are being looked up
  // These are of a tile's pixels, while they need not be kept, or are not whole.
  std::vector<PixelSamples> pixel_samples;
  std::vector<FirstHit> first_hits;
};

/// A WorkspacePool has the workspaces of a render: as many as there ever are tasks running at once.
class WorkspacePool {
 public:
  /// A Loan is a workspace for as long as it lives.
  class Loan {
   public:
    explicit Loan(WorkspacePool& pool) : pool_(pool), workspace_(pool.take()) {}
    ~Loan() { pool_.give_back(workspace_); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    Workspace& operator*() { return *workspace_; }

   private:
    WorkspacePool& pool_;
    Workspace* workspace_;
  };

  /// `rules` are for the rays of all of them. They must outlive the pool.
  explicit WorkspacePool(const StepRules& rules) : rules_(rules) {}

  /// Counts are sums of counts.
  struct Counts {
    RenderStats stats;
    CutoffSum cutoff;
  };

  /// Returns all counts together. Nothing may be on loan.
  Counts total() const;
  /// Replaces all that has been counted. Nothing may be on loan.
  void set_total(const Counts& counts);

  /// Adds what a workspace has counted since the last time to the settled sum, for work that is
  /// done for good. It is called from the thread that has the workspace.
  void settle(Workspace& workspace);
  /// Settles all workspaces. Nothing may be on loan.
  void settle_all();
  /// Returns what has been settled. It may be called from any thread.
  Counts settled() const;

 private:
  Workspace* take();
  void give_back(Workspace* workspace);

  const StepRules& rules_;
  mutable std::mutex mutex_;
  std::vector<std::unique_ptr<Workspace>> all_;
  std::vector<Workspace*> idle_;
  Counts settled_;
};

}  // namespace crt::core
