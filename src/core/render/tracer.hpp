// The tracer finds what light comes along a camera ray. Source: Whitted, An improved illumination
// model for shaded display, Communications of the ACM 23(6), 1980.
#pragma once

#include <array>
#include <span>

#include "core/render/direct_light.hpp"

namespace crt::core {

/// Traces camera rays on one thread, up to packet_size side by side. Each ray has its weight: its
/// share of the light that the camera ray brings. In every round each sample follows one ray.
/// These, and the shadow rays of each light, travel as packets where they go nearly the same way. A
/// sample does not depend on what is traced beside it.
class Tracer {
 public:
  /// All three must outlive the tracer, and nothing else may use the workspace meanwhile.
  Tracer(const Frame& frame, Workspace& work, Progress& progress);

  /// Gives samples an identity from now on.
  void identify() { context_.identifies = true; }

  /// Traces as many camera rays as there are samples, up to packet_size. `ids` has those of the
  /// samples, or nothing: then all draw the same numbers. Says of each what it meets first, if
  /// there is room for that in `first_hits`. Throws Error (cancelled) soon after the progress says
  /// so.
  void trace(std::span<const RayLanes> camera_rays, std::span<Sample> samples,
             std::span<const SampleId> ids = {}, std::span<FirstHit> first_hits = {});

  /// Finds where as many camera rays as there are places meet something first, and follows no
  /// light.
  void look(std::span<const RayLanes> camera_rays, std::span<FirstPlace> places);

 private:
  /// Returns the rays of the first round.
  PathRays& start(std::span<const RayLanes> camera_rays, std::span<Sample> samples,
                  std::span<const SampleId> ids);
  /// Finds the solids that these start in.
  void start_media(PathRays& rays);
  /// Lets what comes from surfaces within transparent solids that the camera does not see be within
  /// them.
  void enter_unseen_media(PathRays& rays, const Surfaces& surfaces);

  TraceContext context_;
  PathState camera_state_;  ///< of all rays that start in Frame::camera_media()
  // Memory that is reused from round to round:
  std::array<PathRays, 2> rays_;
  PathHits hits_;
  Surfaces surfaces_;
  ShadowRays shadow_rays_;
};

}  // namespace crt::core
