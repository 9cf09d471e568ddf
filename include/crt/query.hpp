// Ray queries ask about the geometry without making a picture, and report the same crossings that
// pictures see. All functions are safe from any number of threads at once. They throw Error:
// invalid_argument for a ray with a number that is not finite (t_min and t_max may be infinite) or
// without a direction, limit for one that would be tested against more than 4194304 things (see
// RenderOptions::max_ray_steps), out_of_memory.
//
// All queries treat a surface at the start of a ray alike. With Precision::standard it counts as
// behind the ray if it is within 32 u times the sum of the start's largest coordinate and the
// object's size, measured across the surface (u = 2^-53; the size is half of the longest side of
// the box around it), or within twice the error bound of its t if that is more. That is at most 64
// u times the sum for lone primitives but implicit and custom ones. At the end, t_max, the same
// holds of what is before it. So a ray from a point that was computed as origin + t * direction of
// a hit does not meet that surface there again, nor does one to such a point. What is nearer than
// that is not seen. What is behind the start is never reported as ahead of it. The point must not
// come from much farther away than the size and the coordinates are, as then it is off by more, and
// the ray must be at an angle of more than 2^-24 with the surface. A ray with a RayStart knows
// where it begins and needs none of this.
//
// With Precision::exact the origin is taken for the point that its doubles say. A surface is met
// exactly if t_min < t holds for the exact t, rounded to a double. So a ray from a point which
// rounding has put just below a surface meets it at once, unless it has a RayStart.
#pragma once

#include <array>
#include <crt/prepared_scene.hpp>
#include <crt/ray.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace crt {

/// A Hit is where a ray meets a surface.
struct Hit {
  double t = 0;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 1, 0};  ///< unit length, out of the solid; for a surface the side its maker chose
  double u = 0;
  double v = 0;
  std::uint32_t entity_id = 0;
  bool entering = false;  ///< into the solid; for a surface: against its normal
};

/// Says from which side a surface is met.
enum class HitSide : std::uint32_t {
  none,      ///< there is no hit
  entering,  ///< into the solid; for a surface: against its normal
  leaving,
};

/// A PlainHit is a hit as an array of many holds it: 56 bytes, without its position, which is
/// origin + t * direction.
struct PlainHit {
  double t = std::numeric_limits<double>::infinity();  ///< infinity: nothing is hit, and all that
                                                       ///< follows is 0
  Vec3 normal{0, 0, 0};                                ///< this and the next three are as in Hit
  double u = 0;
  double v = 0;
  std::uint32_t entity_id = 0;
  HitSide side = HitSide::none;
};

/// A HitPart says on which part of an entity a hit is. A ray that hits nothing has no_entity_id for
/// all three numbers. Where surfaces of several parts coincide, it is the part that was combined
/// first.
struct HitPart {
  std::uint32_t entity_id = no_entity_id;  ///< as in Hit
  /// This is the innermost Entity::with_id around the primitive that was hit, such as a cutter.
  /// Without any it is the entity's place in Scene::entities.
  std::uint32_t part_id = no_entity_id;
  /// Numbers the faces of the primitive. A box has 0 and 1 across x at its lower and upper end, 2
  /// and 3 across y, 4 and 5 across z. Cylinders, cones and capsules have 0 for the side, 1 at
  /// `from` and 2 at `to`. Extrusions have 0 and 1 for the lower and the upper end, and revolutions
  /// for where the turn begins and ends. Both have further numbers for their sides. Height fields
  /// have 0 and 1 across x at the lower and the upper end, 2 and 3 across z, 4 for the bottom, and
  /// further numbers for the triangles of their cells. Meshes have the place of the triangle among
  /// those with an area. All others have 0.
  std::uint32_t face = no_entity_id;
  double u = 0;  ///< as in Hit
  double v = 0;
};

/// A RayStart says on which surface a ray begins, or ends. Every FullHit has one, which is good for
/// the prepared scene of the hit alone. What is in it is nobody's business. One of zeros is
/// nowhere.
struct RayStart {
  std::array<std::uint64_t, 2> bits{};

  friend bool operator==(const RayStart&, const RayStart&) = default;
};

/// A FullHit is all that is known of a hit: 112 bytes. A ray that hits nothing has an infinite t,
/// no_entity_id for entity, part and face, and 0 elsewhere.
struct FullHit {
  double t = std::numeric_limits<double>::infinity();  ///< in units of |direction|
  Vec3 position{0, 0, 0};  ///< on the surface, with less error than origin + t * direction
  Vec3 normal{0, 0, 0};    ///< as in Hit
  double u = 0;
  double v = 0;
  std::uint32_t entity_id = no_entity_id;  ///< as in HitPart, like the next two
  std::uint32_t part_id = no_entity_id;
  std::uint32_t face = no_entity_id;
  HitSide side = HitSide::none;
  std::uint64_t user = 0;  ///< of Entity::with_user() innermost around what was hit, or 0
  RayStart start{};        ///< for rays that go on from here

  /// Returns whether anything is hit.
  bool found() const { return side != HitSide::none; }
};

/// A Location says in what a point is: the innermost solid, by the numbers that a FullHit has. The
/// part is the first, as written, that holds the point. In free space there is none.
struct Location {
  std::uint32_t entity_id = no_entity_id;
  std::uint32_t part_id = no_entity_id;
  std::uint64_t user = 0;
};

/// Returns the ray through a place of the picture and the middle of the camera's lens, as the
/// scene's settings have the picture. x and y count pixels from the left and from the top: (0.5,
/// 0.5) is the middle of the first pixel. Places beside the picture are legal. The direction has
/// unit length. Throws Error (invalid_argument) for numbers that are not finite or too far outside.
Ray camera_ray(const PreparedScene& scene, double x, double y);

/// Computes the rays through several places {x, y} of the picture, at less cost than one by one.
/// Throws Error (invalid_argument) as camera_ray(), and where there are fewer rays than places.
void camera_rays(const PreparedScene& scene, std::span<const std::array<double, 2>> places,
                 std::span<Ray> rays);

/// Finds the nearest hit, as RayQueries::trace() does.
FullHit trace(const PreparedScene& scene, const Ray& ray, const RayStart& start = {});

/// Finds the nearest hit. It is empty if the ray hits nothing.
std::optional<Hit> intersect(const PreparedScene& scene, const Ray& ray);

/// Asks whether any surface blocks the ray, transparent or not.
bool occluded(const PreparedScene& scene, const Ray& ray);

/// Finds every crossing along the ray in order: per entity, the solid intervals that CSG leaves.
std::vector<Hit> crossings(const PreparedScene& scene, const Ray& ray);

/// Throws Error (invalid_argument) for a ray that no query takes.
void validate(const Ray& ray);

/// Returns the index of the first of several rays that validate() rejects, or their number if there
/// is none.
std::size_t first_invalid(std::span<const Ray> rays);

/// Returns the index of the first of several starts that is not of a hit in this scene, as far as
/// one can see, or their number if there is none.
std::size_t first_invalid(const PreparedScene& scene, std::span<const RayStart> starts);

/// A RayQueries object answers many rays one after the other, with memory that it keeps between
/// them. That is cheaper than the functions above. One thread at a time may use it.
class RayQueries {
 public:
  /// Shares the scene. Throws Error (out_of_memory).
  explicit RayQueries(const PreparedScene& scene);
  ~RayQueries();
  /// Takes over the memory. What was moved from is good for nothing but being assigned to or
  /// destroyed.
  RayQueries(RayQueries&&) noexcept;
  /// Takes over the memory, and releases what was here.
  RayQueries& operator=(RayQueries&&) noexcept;

  /// Finds the nearest hit. It is empty if the ray hits nothing.
  std::optional<Hit> intersect(const Ray& ray);
  /// Asks whether any surface blocks the ray.
  bool occluded(const Ray& ray);

  /// Finds the nearest hit of each of several rays, and writes them into as many places. Rays that
  /// follow one another in nearly the same direction, such as those through neighbouring pixels,
  /// are answered together, and faster than one by one. The answers are the same. Throws Error
  /// (invalid_argument) also where there are fewer places than rays.
  void intersect(std::span<const Ray> rays, std::span<std::optional<Hit>> hits);
  /// Finds the nearest hits of several rays, as plain numbers.
  void intersect(std::span<const Ray> rays, std::span<PlainHit> hits);
  /// Finds on which parts of entities the nearest hits of several rays are.
  void parts(std::span<const Ray> rays, std::span<HitPart> parts);
  /// Asks for each of several rays whether any surface blocks it.
  void occluded(std::span<const Ray> rays, std::span<bool> occluded);

  /// Finds how far the nearest hits of several rays are, in units of |direction|, and of which
  /// entities. A depth map or a laser scanner has to know no more. t and entity_id are as a
  /// PlainHit has them. It takes less time, as normals, u and v are not computed. `entity_ids` may
  /// be empty if they are not needed.
  void distances(std::span<const Ray> rays, std::span<double> distances,
                 std::span<std::uint32_t> entity_ids = {});

  /// Finds every crossing in order, and replaces what `out` holds.
  void crossings(const Ray& ray, std::vector<Hit>& out);

  /// Finds the nearest hit with all that is known of it. A ray with a start begins on the surface
  /// of that hit, whatever its coordinates say: it never meets that surface there again, nor others
  /// that coincide with it there. It goes to the side that its direction says. With t_min = 0 the
  /// surface is at the ray's origin. A ray that goes on along its own line may also keep its origin
  /// and begin at t_min = t of the hit. Throws Error (invalid_argument) for a start of another
  /// scene, as far as one can see, also below.
  FullHit trace(const Ray& ray, const RayStart& start = {});
  /// Finds the nearest hits of several rays. There are as many starts as rays, or none.
  void trace(std::span<const Ray> rays, std::span<const RayStart> starts, std::span<FullHit> hits);

  /// Asks whether anything lies between the start of a ray and its end, as occluded() does. A ray
  /// with an `end` ends at t_max on the surface of that hit, which does not block it there.
  bool blocked(const Ray& ray, const RayStart& start, const RayStart& end = {});
  /// Asks it of several rays. There are as many starts as rays, or none, and so with the ends.
  void blocked(std::span<const Ray> rays, std::span<const RayStart> starts,
               std::span<const RayStart> ends, std::span<bool> blocked);

  /// Finds every crossing in order, with all that is known of it, and appends them to `out`. The
  /// start is as for trace().
  void trace_all(const Ray& ray, const RayStart& start, std::vector<FullHit>& out);

  /// Finds in what points are: each in the innermost of the solids around it. Of solids that
  /// overlap without one being in the other, the innermost is the one that a ray along (0.739,
  /// 0.567, 0.363) leaves first. What is exactly on a surface is on the side to which that points.
  /// Points must be finite. Throws Error (invalid_argument), also where there are fewer places than
  /// points.
  void locate(std::span<const Vec3> points, std::span<Location> locations);

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// Works on the rays first ... last - 1 of a batch.
using RayBatchWork = std::function<void(RayQueries& queries, std::size_t first, std::size_t last)>;

/// Splits `count` rays into pieces and calls `work` for each, on up to `threads` threads, the
/// calling one among them. 0 threads means what the calling TBB arena has; 1 starts none. Small
/// batches stay on the calling thread. What `work` throws comes out.
void query_in_parallel(const PreparedScene& scene, std::size_t count, const RayBatchWork& work,
                       int threads = 0);

}  // namespace crt
