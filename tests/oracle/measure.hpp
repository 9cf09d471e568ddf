// Compares crossings with the true ones, and keeps account.
//
// The promise about t is |t - true t| <= 0.5 ulp(t) + 8 u (R + |x|) / |n . d|, with u = 2^-53, R
// the size of the primitive (the radius of a ball that holds it, 0 for planes and half planes), x
// the point relative to its centre, n the unit normal.
//
// The promise about hit or miss is that the line is never reported inside (or outside) at a point
// that is farther outside (or inside) than 8 u (R + |x|) plus the spacing of t's doubles there, in
// length. For surfaces: where the line meets the plane is not farther beyond (or within) the rim
// than the bound on t is long plus 8 u (R + |x|). A ray whose decision differs from the true one
// within this is a *close call*.
//
// The exact tier promises more: no close calls, and t within 0.51 ulp (of a torus 1 ulp).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/geometry/shape.hpp"
#include "oracle/line_oracle.hpp"
#include "oracle/ray_maker.hpp"

namespace crt::test {

enum class Promise : std::uint8_t {
  none,
  standard,  ///< the bounds above, and Crossing::error
  exact,
};

/// A Contestant makes the crossings that are measured. A tier is a way to make shapes.
struct Contestant {
  std::string name;
  Promise promise = Promise::none;
  /// Works as Shape::crossings, and counts what only exact arithmetic answered.
  std::function<bool(const TestRay& ray, core::CrossingList& out, std::uint64_t& escalations)>
      crossings;
};
Contestant standard_tier();
Contestant exact_tier();
Contestant naive_formulas();

/// A Histogram counts how often each size of error occurred, in 8 bins an octave.
class Histogram {
 public:
  void add(double value);
  void add(const Histogram& other);
  std::uint64_t count() const { return count_; }
  double largest() const { return largest_; }
  /// Returns the value (to a bin) that this share of all do not exceed.
  double quantile(double share) const;

 private:
  static constexpr int bins_per_octave = 8;
  static constexpr int lowest_exponent = -20;
  static constexpr int octaves = 120;

  std::array<std::uint64_t, octaves * bins_per_octave> bins_{};
  std::uint64_t count_ = 0;
  double largest_ = 0;
};

struct Record {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;         ///< rays that truly hit
  std::uint64_t close_calls = 0;  ///< decided otherwise, but within the bound
  std::uint64_t wrong = 0;        ///< decided otherwise beyond it
  std::array<std::uint64_t, ray_kinds> rays_by_kind{};
  std::array<std::uint64_t, ray_kinds> close_calls_by_kind{};
  std::uint64_t escalations = 0;  ///< questions that only exact arithmetic answered
  double largest_ratio = 0;       ///< error over the promised bound
  double largest_claim = 0;  ///< error over Crossing::error; in the exact tier that of t + t_low
  std::array<Histogram, ray_kinds> ulps_by_kind;  ///< error in units of the last place of t
  std::array<Histogram, highest_decade - lowest_decade + 1> ulps_by_decade;  ///< of plain rays
  std::vector<std::uint64_t> failures;  ///< numbers of the first rays that broke a promise

  void add(const Record& other);
};

/// Holds the truth about a ray, to measure several contestants with.
struct Truth {
  TestRay ray;
  TrueLine line;
};
Truth truth_of(const TestRay& ray, FirstTry first = FirstTry::two_doubles);

/// Takes one ray into the account, and says whether every promise was kept.
bool measure(const Truth& truth, const Contestant& contestant, std::uint64_t number,
             Record& record);

/// Measures rays first to last (not included) of a primitive on all cores.
std::vector<Record> measure_all(std::size_t primitive_kind, std::uint64_t first, std::uint64_t last,
                                const std::vector<Contestant>& contestants,
                                RayMaker maker = make_ray);

/// Describes a ray in full, to repeat it.
std::string description(const TestRay& ray);

}  // namespace crt::test
