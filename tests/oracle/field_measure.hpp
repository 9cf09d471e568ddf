// These functions compare what both tiers report of polynomial fields with the truth in fractions.
//
// Where nothing is left undecided, the crossings of a ray must be those that there are, each within
// its error. A ray is *undecided* if the library says so. Then crossings must still take turns, and
// one of the field must have an odd number of true ones within its error: others may be lost, two
// by two. Where all of a ray, or its part beside the box, is undecided, it is inside or outside by
// the field in the middle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace crt::test {

/// Lists the kinds of fields. All have random numbers, sizes of 1e-3 to 1e3, and places up to ten
/// sizes from the origin.
enum class FieldKind {
  ball,
  torus,
  two_balls,    ///< a product of two balls' fields, less a number: one or two pieces
  cubic,        ///< twenty coefficients
  heart,        ///< of degree six, with a cusp
  cones,        ///< of degree four, with points like the apex of a cone
  thin_shell,   ///< a ball's field squared, less little
  crossed_rods  ///< a product of cylinders that pass through one another
};
inline constexpr std::size_t field_kinds = 8;
const char* name_of(FieldKind kind);

struct FieldTierRecord {
  std::uint64_t wrong = 0;
  std::uint64_t undecided = 0;
  std::uint64_t others = 0;  ///< of these, rays that have more or fewer crossings in truth
  double largest_ratio = 0;  ///< of an error to the bound, where all is decided
  double largest_bound = 0;  ///< there, over half a side of the field's box
};

struct FieldRecord {
  std::uint64_t fields = 0;
  std::uint64_t rays = 0;
  std::uint64_t crossings = 0;
  FieldTierRecord standard;
  FieldTierRecord exact;
  std::vector<std::string> failures;  ///< the first ones

  void add(const FieldRecord& other);
};

/// Measures so many fields of a kind with so many rays each. A quarter of the rays is nearly
/// tangent to the field, a quarter is parallel to an axis or aimed at the middle, and one in eight
/// starts far away.
FieldRecord measure_fields(FieldKind kind, std::uint64_t fields, std::uint64_t rays_each);

}  // namespace crt::test
