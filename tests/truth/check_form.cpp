#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "crt/primitives.hpp"
#include "truth/check_truth.hpp"
#include "truth/known_forms.hpp"
#include "truth/random_solids.hpp"

namespace crt::truth {
namespace {

/// Formulas are known so well, relative to the numbers that they are of.
constexpr double rounding = 1e-12;

void check_box(Account& account, const BoundingBox& box, const Vec3& lower, const Vec3& upper) {
  const double error = rounding * (glm::length(lower) + glm::length(upper));
  account.count("boxes");
  for (int axis = 0; axis < 3; ++axis) {
    account.check(box.lower[axis] <= lower[axis] + error && box.upper[axis] >= upper[axis] - error,
                  fmt::format("the box from {:.17g} to {:.17g} along {} does not hold {:.17g} to "
                              "{:.17g}",
                              box.lower[axis], box.upper[axis], axis, lower[axis], upper[axis]));
  }
}

}  // namespace

void check_form(std::uint64_t number, Account& account) {
  Random random(1000003 * number + 17);
  Known known = random_known(random);
  account.count(known.name);
  const bool is_custom = known.name == "custom";
  const double width = is_custom ? 1 : random.power_of_ten(-7, -0.5);
  // What is known when the time is over must be true, too.
  const MeasureOptions options{
      .relative_width = width, .seconds = random.power_of_ten(-3, -1.3), .threads = 1};
  const std::uint64_t place = random.bits() % 3;
  double factor = 1;
  Transform map;
  if (place == 1) map = random_even_map(random, factor);
  if (place == 2) map = random_map(random);
  if (place > 0) known.solid = known.solid.transformed(map);
  const double determinant = std::abs(determinant_of(map));
  const double volume = known.volume * determinant;
  check_holds(account, known.name + " volumes", crt::volume(known.solid, options), volume,
              rounding * volume);
  if (place != 2 && !is_custom && !std::isnan(known.area)) {
    const double area = known.area * factor * factor;
    check_holds(account, known.name + " areas", surface_area(known.solid, options), area,
                rounding * area);
  }
  if (place == 0 && known.lower.x <= known.upper.x) {
    check_box(account, tight_bounding_box(known.solid, options), known.lower, known.upper);
  }
  if (!known.has_centroid || is_custom || !random.one_in(4)) return;
  const std::array<Interval, 3> center = centroid(known.solid, options);
  const Vec3 truth = moved(map, known.centroid);
  for (int axis = 0; axis < 3; ++axis) {
    check_holds(account, "centroids", center[static_cast<std::size_t>(axis)], truth[axis],
                rounding * (glm::length(truth) + 10 * factor));
  }
}

}  // namespace crt::truth
