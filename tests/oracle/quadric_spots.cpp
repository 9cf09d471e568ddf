#include "oracle/quadric_spots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace crt::test {
namespace {

double sum_at(const Quadric& q, const Vec3& p) {
  return glm::dot(q.squares, p * p) + glm::dot(q.products, Vec3(p.x * p.y, p.x * p.z, p.y * p.z)) +
         glm::dot(q.linear, p) + q.constant;
}
Vec3 curved(const Quadric& q, const Vec3& v) {
  const Vec3& c = q.products;
  return {2 * q.squares.x * v.x + c.x * v.y + c.y * v.z,
          c.x * v.x + 2 * q.squares.y * v.y + c.z * v.z,
          c.y * v.x + c.z * v.y + 2 * q.squares.z * v.z};
}
/// Returns the place where the slope is least that is nearest to the origin: about a center, an
/// apex, or a point of an axis.
Vec3 middle_of(const Quadric& q) {
  const std::array<Vec3, 3> units = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const double bend = glm::length(q.squares) + glm::length(q.products);
  if (bend == 0) return Vec3(0);
  // H (H p + b) = 0 has this as its solution of least length, as (H H + small) p = -H b has nearly.
  constexpr double small = 1e-9;
  std::array<Vec3, 3> m{};
  for (std::size_t i = 0; i < 3; ++i)
    m[i] = curved(q, curved(q, units[i])) / (bend * bend) + small * units[i];
  const Vec3 right = -curved(q, q.linear) / (bend * bend);
  const double determinant = glm::dot(m[0], glm::cross(m[1], m[2]));
  return (right.x * glm::cross(m[1], m[2]) + right.y * glm::cross(m[2], m[0]) +
          right.z * glm::cross(m[0], m[1])) /
         determinant;
}

/// Returns a length that is typical of a quadric about its middle.
double extent_of(const Quadric& q) {
  const Vec3 middle = middle_of(q);
  const double bend = glm::length(q.squares) + glm::length(q.products);
  const double slope = glm::length(curved(q, middle) + q.linear);
  return std::sqrt(std::abs(sum_at(q, middle) / bend)) + slope / bend;
}

}  // namespace

void make(Counted& random, const Vec3& at, double size, Quadric& q) {
  // Where the size is lost in the place, coefficients have no digits left for it.
  constexpr double max_sizes = 1e3;
  Vec3 center = at;
  if (glm::length(at) > max_sizes * size)
    center = size * random.power_of_ten(-2, 2) * random.direction();
  const Frame frame = across(random.direction() + 1e-3 * random.in_cube());
  std::array<Vec3, 3> axes = {frame.a, frame.b, glm::cross(frame.a, frame.b)};
  if (random.integer(0, 2) == 0) axes = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  constexpr std::array<std::array<int, 4>, 8> kinds = {{{1, 1, 1, -1},   // ellipsoid
                                                        {1, 1, -1, -1},  // hyperboloids
                                                        {1, 1, -1, 1},
                                                        {1, 1, -1, 0},  // cone
                                                        {1, 1, 0, 0},   // paraboloids
                                                        {1, -1, 0, 0},
                                                        {1, 1, 0, -1},  // cylinders
                                                        {1, -1, 0, -1}}};
  const auto& kind = kinds[static_cast<std::size_t>(random.integer(0, 7))];
  q = {.squares = {0, 0, 0}, .constant = static_cast<double>(kind[3])};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& e = axes[i];
    const double length = size * random.uniform(0.1, 1);
    const double k = kind[i] / (length * length);
    // A paraboloid rises along the axis without a square.
    const double lift = kind[i] == 0 && kind[3] == 0 ? 1 / length : 0;
    const double place = glm::dot(e, center);
    q.squares += k * e * e;
    q.products += 2 * k * Vec3(e.x * e.y, e.x * e.z, e.y * e.z);
    q.linear += (lift - 2 * k * place) * e;
    q.constant += k * place * place - lift * place;
  }
  if (random.integer(0, 1) == 0) return;
  // The sign and the unit of the sum mean nothing, but for which side is inside.
  const double factor = random.sign() * random.power_of_ten(-3, 3);
  q.squares *= factor;
  q.products *= factor;
  q.linear *= factor;
  q.constant *= factor;
}

Spot spot(Counted& random, const Quadric& q) {
  const double reach = extent_of(q);
  Vec3 p(0);
  for (int attempt = 0; attempt < 20; ++attempt) {
    const Vec3 o = middle_of(q) + reach * random.in_cube();
    const Vec3 d = random.direction();
    const double a = glm::dot(d, curved(q, d)) / 2;
    const double b = glm::dot(d, curved(q, o) + q.linear) / 2;
    const double discriminant = b * b - a * sum_at(q, o);
    if (!(discriminant > 0)) continue;
    const double sum = std::abs(b) + std::sqrt(discriminant);
    p = o + (b > 0 ? -1 : 1) *
                (random.integer(0, 1) == 0 && std::abs(a) > 1e-6 * sum / reach
                     ? sum / a
                     : sum_at(q, o) / sum) *
                d;
    break;
  }
  const Vec3 slope = curved(q, p) + q.linear;
  const Vec3 normal = glm::length(slope) > 0 ? glm::normalize(slope) : Vec3(0, 0, 1);
  const Frame frame = across(normal);
  // Along x a + b of the frame the form's own part is (aa x^2 + 2 ab x + bb) / 2.
  const double aa = glm::dot(frame.a, curved(q, frame.a));
  const double ab = glm::dot(frame.a, curved(q, frame.b));
  const double bb = glm::dot(frame.b, curved(q, frame.b));
  const double root = std::sqrt(std::max(0.0, ab * ab - aa * bb));
  const Vec3 along = aa == 0 ? frame.a : ((random.sign() * root - ab) / aa) * frame.a + frame.b;
  return {p, normal, glm::normalize(along)};
}

Vec3 edge(Counted&, const Quadric& q) {
  return middle_of(q);
}

}  // namespace crt::test
