#include "core/measure/simplices.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace crt::core {

double LinearFunction::at(const Vec3& x) const {
  return value + glm::dot(slope, x);
}

std::span<const Tetrahedron> cube() {
  // Six tetrahedra around the diagonal, one for each order of the axes (Kuhn's).
  static const auto parts = [] {
    std::array<Tetrahedron, 6> result;
    constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (std::size_t i = 0; i < orders.size(); ++i) {
      Vec3 corner(-1);
      result[i][0] = corner;
      for (std::size_t step = 0; step < 3; ++step) {
        corner[orders[i][step]] = 1;
        result[i][step + 1] = corner;
      }
    }
    return result;
  }();
  return parts;
}

namespace {

/// Returns where a function is 0 between two points of which it has different signs.
Vec3 between(const Vec3& a, double at_a, const Vec3& b, double at_b) {
  return a + (at_a / (at_a - at_b)) * (b - a);
}

/// Splits corners by the sign of a function.
template <std::size_t corners>
struct Sides {
  std::array<Vec3, corners> below;
  std::array<Vec3, corners> above;
  std::array<double, corners> at_below;
  std::array<double, corners> at_above;
  std::size_t count_below = 0;
  std::size_t count_above = 0;

  Sides(const Simplex<corners>& simplex, const LinearFunction& function) {
    for (const Vec3& corner : simplex) {
      const double at = function.at(corner);
      if (at < 0) {
        below[count_below] = corner;
        at_below[count_below++] = at;
      } else {
        above[count_above] = corner;
        at_above[count_above++] = at;
      }
    }
  }
  Vec3 crossing(std::size_t b, std::size_t a) const {
    return between(below[b], at_below[b], above[a], at_above[a]);
  }
};

}  // namespace

void cut(const FlatTriangle& simplex, const LinearFunction& function,
         std::vector<FlatTriangle>& below, std::vector<FlatTriangle>& above) {
  const Sides<3> sides(simplex, function);
  if (sides.count_below == 0) return above.push_back(simplex);
  if (sides.count_above == 0) return below.push_back(simplex);
  if (sides.count_below == 1) {
    const Vec3 p = sides.crossing(0, 0);
    const Vec3 q = sides.crossing(0, 1);
    below.push_back({sides.below[0], p, q});
    above.push_back({sides.above[0], sides.above[1], p});
    above.push_back({sides.above[1], p, q});
    return;
  }
  const Vec3 p = sides.crossing(0, 0);
  const Vec3 q = sides.crossing(1, 0);
  above.push_back({sides.above[0], p, q});
  below.push_back({sides.below[0], sides.below[1], p});
  below.push_back({sides.below[1], p, q});
}

namespace {

/// Appends a prism between two triangles as three tetrahedra.
void add_prism(const FlatTriangle& a, const FlatTriangle& b, std::vector<Tetrahedron>& out) {
  out.push_back({a[0], a[1], a[2], b[2]});
  out.push_back({a[0], a[1], b[1], b[2]});
  out.push_back({a[0], b[0], b[1], b[2]});
}

}  // namespace

void cut(const Tetrahedron& simplex, const LinearFunction& function,
         std::vector<Tetrahedron>& below, std::vector<Tetrahedron>& above) {
  const Sides<4> sides(simplex, function);
  if (sides.count_below == 0) return above.push_back(simplex);
  if (sides.count_above == 0) return below.push_back(simplex);
  if (sides.count_below == 1) {
    const FlatTriangle middle = {sides.crossing(0, 0), sides.crossing(0, 1), sides.crossing(0, 2)};
    below.push_back({sides.below[0], middle[0], middle[1], middle[2]});
    add_prism({sides.above[0], sides.above[1], sides.above[2]}, middle, above);
  } else if (sides.count_above == 1) {
    const FlatTriangle middle = {sides.crossing(0, 0), sides.crossing(1, 0), sides.crossing(2, 0)};
    above.push_back({sides.above[0], middle[0], middle[1], middle[2]});
    add_prism({sides.below[0], sides.below[1], sides.below[2]}, middle, below);
  } else {
    const Vec3 p00 = sides.crossing(0, 0);
    const Vec3 p01 = sides.crossing(0, 1);
    const Vec3 p10 = sides.crossing(1, 0);
    const Vec3 p11 = sides.crossing(1, 1);
    add_prism({sides.below[0], p00, p01}, {sides.below[1], p10, p11}, below);
    add_prism({sides.above[0], p00, p10}, {sides.above[1], p01, p11}, above);
  }
}

void cut_plane(const Tetrahedron& simplex, const LinearFunction& function,
               std::vector<FlatTriangle>& plane) {
  const Sides<4> sides(simplex, function);
  if (sides.count_below == 1) {
    plane.push_back({sides.crossing(0, 0), sides.crossing(0, 1), sides.crossing(0, 2)});
  } else if (sides.count_above == 1) {
    plane.push_back({sides.crossing(0, 0), sides.crossing(1, 0), sides.crossing(2, 0)});
  } else if (sides.count_below == 2) {
    const Vec3 p = sides.crossing(0, 1);
    const Vec3 q = sides.crossing(1, 0);
    plane.push_back({sides.crossing(0, 0), p, q});
    plane.push_back({sides.crossing(1, 1), p, q});
  }
}

void BodyMoments::add(const Tetrahedron& body) {
  const Vec3 a = body[1] - body[0];
  const Vec3 b = body[2] - body[0];
  const Vec3 c = body[3] - body[0];
  const double part = std::abs(glm::dot(a, glm::cross(b, c))) / 6;
  const Vec3 sum = body[0] + body[1] + body[2] + body[3];
  volume += part;
  first += part / 4 * sum;
  // The integral of x y is that of the products of sums and of corners, over 20.
  const auto product = [&](int i, int j) {
    double corners = sum[i] * sum[j];
    for (const Vec3& corner : body) corners += corner[i] * corner[j];
    return part / 20 * corners;
  };
  second[0] += product(0, 0);
  second[1] += product(1, 1);
  second[2] += product(2, 2);
  second[3] += product(0, 1);
  second[4] += product(1, 2);
  second[5] += product(2, 0);
}

Vec3 double_area(const FlatTriangle& triangle) {
  return glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
}

}  // namespace crt::core
