// The tracer: what light comes along a camera ray. Source: Whitted, An improved illumination model for
// shaded display, Communications of the ACM 23(6), 1980.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/render/frame.hpp"
#include "core/render/progress.hpp"
#include "core/render/surface_hit.hpp"
#include "core/scene/ray_packet.hpp"
#include "core/shading/phong.hpp"

namespace crt::core {

/// Traces camera rays on one thread, and their shadow rays, as packets where all of them see the same media
/// around the camera. Mirrored and refracted rays wait on a stack, each with its weight: its share of the
/// light that the camera ray brings. A sample does not depend on what is traced beside it.
class Tracer {
 public:
  /// All three must outlive the tracer, and nothing else may use the workspace meanwhile.
  Tracer(const Frame& frame, Workspace& work, Progress& progress);

  struct Sample {
    Rgb color{0, 0, 0};  ///< premultiplied with alpha
    double alpha = 1;
  };

  /// Traces up to packet_size camera rays, best such that go nearly the same way. Throws Error (cancelled)
  /// soon after the progress says so.
  void trace(std::span<const CameraRay> rays, std::span<Sample> samples);

 private:
  /// What a camera ray sees, while it waits for the light there.
  struct Seen {
    PathRay path;
    RayHit hit;
    SurfaceHit surface;
    PhongSurface phong;
    Rgb weight{0, 0, 0};
    Rgb light{0, 0, 0};
    std::optional<StartPoint> start;  ///< of rays that leave to the viewer's side
    Sample* sample = nullptr;
  };
  /// A light as it reaches a surface if nothing hides it.
  struct Unhidden {
    Rgb light;
    WorldRay shadow_ray;
  };

  void trace_alone(const CameraRay& camera_ray, Sample& sample);
  void trace_together(std::span<const CameraRay> rays, std::span<Sample> samples);
  PathRay first_path(const CameraRay& camera_ray);
  /// Follows what waits on the stack, and what comes of it, as the rays of a sample after the first so many.
  void follow_pending(int rays, Sample& sample);
  void follow(const PathRay& path, Sample& sample);
  void see_background(const PathRay& path, const Rgb& weight, Sample& sample) const;
  /// Takes from the weight what the medium on the way to a hit absorbs; whether anything is left.
  bool pass_medium(const PathRay& path, double length, Rgb& weight) const;

  /// Looks up what the path has met, with the light that needs no shadow ray.
  void see(const PathRay& path, const RayHit& hit, Seen& seen);
  std::optional<Unhidden> unhidden(const PreparedLight& source, Seen& seen) const;
  /// The light of all lights that the surface sends back along the path.
  void light_alone(Seen& seen);
  void light_together(std::span<Seen> all);

  /// Puts the mirrored and the refracted ray on the stack, if they are worth it.
  void split(const Seen& seen);
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

  /// Counts rays; lets the progress speak now and then.
  void tick(unsigned rays = 1);

  const Frame& frame_;
  const PreparedData& data_;
  Workspace& work_;
  Progress& progress_;
  MediaLists::List camera_media_ = MediaLists::empty;
  /// Of the lists that all camera rays need.
  std::uint32_t camera_media_mark_ = 0;
  unsigned ticks_ = 0;
  std::array<Seen, packet_size> seen_;
};

}  // namespace crt::core
