// The tracer: what light comes along a camera ray. Source: Whitted, An improved illumination model for
// shaded display, Communications of the ACM 23(6), 1980.
#pragma once

#include "core/render/frame.hpp"
#include "core/render/progress.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

/// Traces one camera ray after the other, on one thread. Mirrored and refracted rays wait on a stack,
/// each with its weight: its share of the light that the camera ray brings.
class Tracer {
 public:
  /// All three must outlive the tracer, and nothing else may use the workspace meanwhile.
  Tracer(const Frame& frame, Workspace& work, Progress& progress);

  struct Sample {
    Rgb color{0, 0, 0};  ///< premultiplied with alpha
    double alpha = 1;
  };

  /// Throws Error (cancelled) soon after the progress says so.
  Sample trace(const CameraRay& camera_ray);

 private:
  PathRay first_path(const CameraRay& camera_ray);
  void follow(const PathRay& path, Sample& sample);
  void see_background(const PathRay& path, const Rgb& weight, Sample& sample) const;

  /// The light of all lights that the surface sends back along the path.
  Rgb direct_light_at(const SurfaceHit& surface, const PathRay& path, const RayHit& hit);

  /// Puts the mirrored and the refracted ray on the stack, if they are worth it.
  void split(const SurfaceHit& surface, const PathRay& path, const RayHit& hit, const Rgb& weight);
  /// Whether the path was worth it.
  bool push(const PathRay& path);

  /// Of the surfaces at a hit's place the one that is seen: that which lets the least light through, of
  /// several the one whose object was written first.
  RayHit seen_of(const PathRay& path, const RayHit& hit);

  /// What a ray that goes on through a hit's place finds.
  struct Passage {
    double transparency = 0;  ///< of all surfaces there together
    Rgb color{1, 1, 1};
    MediaLists::List media = MediaLists::empty;  ///< behind them
  };
  Passage passage(const SurfaceHit& surface, const PathRay& path, const RayHit& hit,
                  const StartPoint& behind);
  /// Adds what other objects at the place do.
  void pass_company(const WorldRay& behind, const PathRay& path, const RayHit& hit, Passage& passage);
  double refractive_index(MediaLists::List media) const;

  /// Counts a ray; lets the progress speak now and then.
  void tick();

  const Frame& frame_;
  const PreparedData& data_;
  Workspace& work_;
  Progress& progress_;
  MediaLists::List camera_media_ = MediaLists::empty;
  /// Of the lists that all camera rays need.
  std::uint32_t camera_media_mark_ = 0;
  unsigned ticks_ = 0;
};

}  // namespace crt::core
