#include "oracle/rounded_spots.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/geometry/rounded_box/rounded_box.hpp"

namespace crt::test {

void make(Counted& random, const Vec3& at, double size, RoundedBox& b) {
  b.corner_a = at;
  b.corner_b =
      at + size * Vec3(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
  // Some are far flatter.
  const int axis = random.integer(0, 2);
  if (random.integer(0, 3) == 0) b.corner_b[axis] = at[axis] + size * random.power_of_ten(-6, 0);
  const double largest = core::largest_radius(b);
  const int form = random.integer(0, 5);
  b.radius = form == 0 ? largest
                       : largest * (form == 1 ? random.power_of_ten(-9, 0) : random.uniform(0, 1));
}
/// Returns a spot whose normal is that of one of the flat faces, of an edge or of a corner.
Spot spot(Counted& random, const RoundedBox& b) {
  const Vec3 lower = glm::min(b.corner_a, b.corner_b) + b.radius;
  const Vec3 upper = glm::max(b.corner_a, b.corner_b) - b.radius;
  const int form = random.integer(0, 2);
  const int along = random.integer(0, 2);
  Vec3 n = random.in_cube();
  for (int i = 0; i < 3; ++i) {
    if (form == 0 ? i != along : form == 1 && i == along) n[i] = 0;
  }
  n = glm::normalize(n);
  Vec3 p;
  for (int i = 0; i < 3; ++i)
    p[i] = n[i] < 0 ? lower[i] : (n[i] > 0 ? upper[i] : random.uniform(lower[i], upper[i]));
  Vec3 axis(0);
  axis[along] = 1;
  return {p + b.radius * n, n, form == 1 ? axis : around(across(n), angle(random))};
}
/// Returns a point of a seam, or a corner of a flat face.
Vec3 edge(Counted& random, const RoundedBox& b) {
  const Vec3 lower = glm::min(b.corner_a, b.corner_b) + b.radius;
  const Vec3 upper = glm::max(b.corner_a, b.corner_b) - b.radius;
  Vec3 p;
  for (int i = 0; i < 3; ++i) p[i] = random.integer(0, 1) == 0 ? lower[i] : upper[i];
  const int along = random.integer(0, 2);
  const double middle = lower[along] + random.uniform(0, 1) * (upper[along] - lower[along]);
  const bool is_seam = random.integer(0, 1) == 0;
  if (is_seam) p[along] = middle;
  // The seam of an edge and a corner is an arc.
  Vec3 n(0);
  const int first = (along + 1) % 3;
  const int second = (along + 2) % 3;
  const double turn = random.integer(0, 1) == 0 ? 0 : random.uniform(0, std::numbers::pi / 2);
  n[first] = (p[first] == lower[first] ? -1 : 1) * std::cos(is_seam ? 0 : turn);
  n[second] = (p[second] == lower[second] ? -1 : 1) * std::sin(is_seam ? 0 : turn);
  return p + b.radius * n;
}

}  // namespace crt::test
