// Random primitives and rays over many orders of size and distance, each a function of its number.
//
// Sizes are 10^-9 to 10^9, the offset of the scene 10^-9 to 10^9, the distance of the origin 10^-3
// to 10^12 sizes. Half of the rays are plain; a tenth each is of one of the other kinds. Of the
// rays at cylinders, cones and capsules one tenth more is along rulings and another at solids of
// extreme proportions (ruling_rays.hpp). One in ten of all has a direction of extreme length.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/math/random.hpp"
#include "crt/primitives.hpp"
#include "crt/transform.hpp"
#include "oracle/without_oracle.hpp"

namespace crt::test {

enum class RayKind : std::uint8_t {
  plain,
  grazing,         ///< along a tangent, moved in or out by 10^-16 to 0.1 sizes
  axis_parallel,   ///< along a coordinate axis
  edge,            ///< aimed at an edge, a corner, a rim
  on_surface,      ///< from a point on the surface, as near as doubles have it
  near_parallel,   ///< 10^-16 to 0.1 off parallel to a face or an axis
  along_ruling,    ///< of cylinders and their like: 10^-16 to 0.1 off a straight line of the side
  extreme_length,  ///< any of these, its direction scaled or its components made to differ by
                   ///< up to 10^280
};
inline constexpr std::size_t ray_kinds = 8;
std::string_view name_of(RayKind kind);

template <class... Primitives>
constexpr std::size_t count_with_oracle(std::variant<Primitives...>*) {
  return (std::size_t{!WithoutOracle<Primitives>} + ...);
}
/// Counts the primitives with an oracle, which are numbered by their place in the variant
/// `Primitive`. The others come last there.
inline constexpr std::size_t primitive_kinds = count_with_oracle(static_cast<Primitive*>(nullptr));
static_assert(!WithoutOracle<std::variant_alternative_t<primitive_kinds - 1, Primitive>>);
std::string_view name_of_primitive(std::size_t kind);

struct TestRay {
  Primitive primitive;
  RayKind kind = RayKind::plain;
  int decade = 0;  ///< distance is 10^decade to 10^(decade + 1) sizes
  Vec3 origin{0};
  Vec3 direction{0};
  Transform to_world{};  ///< where the primitive is
  /// This is a power of two. The library is asked about a ray with a direction so many times as
  /// long, which the numbers that t is compared with need not know.
  double scale = 1;
};
inline constexpr int lowest_decade = -3;
inline constexpr int highest_decade = 11;

/// Counted makes random numbers that depend on a seed, a number and how many were drawn before.
class Counted {
 public:
  Counted(std::uint64_t seed, std::uint64_t number) : seed_(seed), number_(number) {}

  double uniform(double low, double high);
  int integer(int low, int high);  ///< both included
  double power_of_ten(double low, double high);
  double sign() { return integer(0, 1) == 0 ? -1 : 1; }
  Vec3 in_cube();
  std::uint64_t number() const { return number_; }
  Vec3 direction();  ///< unit length to rounding; one in four is a coordinate axis

 private:
  std::uint64_t seed_;
  std::uint64_t number_;
  std::uint32_t drawn_ = 0;
};

/// Make a primitive of a size at a place, and a ray of a random kind for it.
Primitive make_primitive(Counted& random, std::size_t primitive_kind, const Vec3& at, double size);
TestRay make_ray_at(Counted& random, const Primitive& primitive, double size);

/// Returns a transform that rotates, scales by factors that differ by up to 10^8 and rotates again.
/// One in four rounds nothing.
Transform random_transform(Counted& random);

/// Moves a ray along with its primitive, by ray.to_world.
void move_to_world(TestRay& ray);

TestRay make_ray(std::size_t primitive_kind, std::uint64_t number);

/// Makes a test ray with the primitive and the ray moved by a transform: rotated, scaled by factors
/// that differ by up to 10^8, rotated again and shifted; or turned and scaled so that nothing is
/// rounded.
TestRay make_placed_ray(std::size_t primitive_kind, std::uint64_t number);

using RayMaker = TestRay (*)(std::size_t primitive_kind, std::uint64_t number);

}  // namespace crt::test
