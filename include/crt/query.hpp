// Ray queries: what a program asks of the geometry without making a picture: the same crossings
// that pictures see. All functions are safe from any number of threads at once. They throw Error:
// invalid_argument for a ray with a number that is not finite (t_min and t_max may be infinite) or
// without a direction, limit for one that would be tested against more than 4194304 things (see
// RenderOptions::max_ray_steps), out_of_memory.
//
// A surface at the start of a ray, all queries alike: with Precision::standard it counts as behind
// the ray unless it is ahead of t_min by more than rounding may be off there. Of a lone primitive
// that is at most 32 u times the sum of its size and the largest coordinate of the start (u =
// 2^-53), measured across the surface; a ray that is flat to it passes what is farther along it
// accordingly. So a ray from a point that was computed to be on a surface does not meet that
// surface there again, and what is nearer than that is not seen. What is behind the start is never
// told as ahead of it. With Precision::exact the origin is taken for the point that its doubles
// say: a surface is met if t_min < t holds for the exact t, rounded to a double, and not otherwise,
// so that a ray from a point which rounding has put just below a surface meets it at once.
#pragma once

#include <crt/prepared_scene.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace crt {

/// The points origin + t * direction with t_min < t < t_max; t is in units of the direction's
/// length, which may be any but 0. Of a direction whose components are more than 2^1022 apart the
/// smaller ones count for as many digits as doubles have at 2^-1022 of the largest. A hit whose
/// place is beyond the largest double is none.
struct Ray {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
};

/// Where a ray meets a surface.
struct Hit {
  double t = 0;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 1, 0};  ///< unit length, out of the solid; for a surface as its maker turned it
  double u = 0;
  double v = 0;
  std::uint32_t entity_id = 0;
  bool entering = false;  ///< into the solid; for a surface: against its normal
};

/// From which side a surface is met.
enum class HitSide : std::uint32_t {
  none,      ///< there is no hit
  entering,  ///< into the solid; for a surface: against its normal
  leaving,
};

/// A hit as an array of many holds it: 56 bytes, without its position, which is origin + t *
/// direction.
struct PlainHit {
  double t = std::numeric_limits<double>::infinity();  ///< infinity: nothing is hit, and all that
                                                       ///< follows is 0
  Vec3 normal{0, 0, 0};                                ///< these as in Hit
  double u = 0;
  double v = 0;
  std::uint32_t entity_id = 0;
  HitSide side = HitSide::none;
};

/// The nearest hit.
std::optional<Hit> intersect(const PreparedScene& scene, const Ray& ray);

/// Whether anything at all is hit, transparent or not.
bool occluded(const PreparedScene& scene, const Ray& ray);

/// Every crossing along the ray in order: per entity, the solid intervals that CSG leaves.
std::vector<Hit> crossings(const PreparedScene& scene, const Ray& ray);

/// Throws Error (invalid_argument) for a ray that no query takes.
void validate(const Ray& ray);

/// Of several rays the index of the first one that validate() takes exception to; their number if
/// there is none.
std::size_t first_invalid(std::span<const Ray> rays);

/// The same questions for many rays one after the other, with memory that it keeps between them:
/// cheaper than the functions above. For one thread at a time.
class RayQueries {
 public:
  /// Shares the scene; throws Error (out_of_memory).
  explicit RayQueries(const PreparedScene& scene);
  ~RayQueries();
  /// What was moved from is good for nothing but being assigned to or destroyed, as in the next.
  RayQueries(RayQueries&&) noexcept;
  /// Lets go of what is here.
  RayQueries& operator=(RayQueries&&) noexcept;

  /// The nearest hit.
  std::optional<Hit> intersect(const Ray& ray);
  /// Whether anything at all is hit.
  bool occluded(const Ray& ray);

  /// The same for each of several rays, into as many places. Rays that go nearly the same way and
  /// follow one another, such as those through neighbouring pixels, are answered together, and
  /// faster than one by one; the answers are the same. Throws Error (invalid_argument) also where
  /// there are fewer places than rays.
  void intersect(std::span<const Ray> rays, std::span<std::optional<Hit>> hits);
  /// The same, as plain numbers.
  void intersect(std::span<const Ray> rays, std::span<PlainHit> hits);
  /// Whether anything at all is hit, likewise for each of several rays.
  void occluded(std::span<const Ray> rays, std::span<bool> occluded);

  /// How far the nearest hits are, in units of |direction|, and of which entities, which is all
  /// that a depth map or a laser scanner has to know: t and entity_id as a PlainHit has them, in
  /// less time, as nobody asks what the surface is like there. Several rays as above. `entity_ids`
  /// may be empty: then nobody asks for them.
  void distances(std::span<const Ray> rays, std::span<double> distances,
                 std::span<std::uint32_t> entity_ids = {});

  /// Every crossing in order, in place of what `out` holds.
  void crossings(const Ray& ray, std::vector<Hit>& out);

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// Work on the rays first ... last - 1 of a batch.
using RayBatchWork = std::function<void(RayQueries& queries, std::size_t first, std::size_t last)>;

/// Splits `count` rays into pieces and calls `work` for each, on up to `threads` threads (0: what
/// the calling TBB arena has; 1 starts none), this one among them. Small batches stay on this
/// thread. What `work` throws comes out.
void query_in_parallel(const PreparedScene& scene, std::size_t count, const RayBatchWork& work,
                       int threads = 0);

}  // namespace crt
