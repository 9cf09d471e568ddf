#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "crt/prepared_scene.hpp"
#include "crt/primitives.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "truth/check_truth.hpp"
#include "truth/random_solids.hpp"

namespace crt::truth {
namespace {

constexpr double seconds = 0.2;  ///< for each answer

// ---- distances by formulas ----

/// Two solids, and how far they are apart: less than 0 if they overlap.
struct KnownPair {
  std::string name;
  Entity a;
  Entity b;
  double distance = 0;
};

/// Returns how far two segments are apart: at their ends, or where the lines are nearest.
double between_segments(const Vec3& a, const Vec3& u, const Vec3& b, const Vec3& v) {
  const auto to_segment = [](const Vec3& p, const Vec3& from, const Vec3& along) {
    const double share = glm::clamp(glm::dot(p - from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(p - from - share * along);
  };
  double least = std::min(
      {to_segment(a, b, v), to_segment(a + u, b, v), to_segment(b, a, u), to_segment(b + v, a, u)});
  const Vec3 w = a - b;
  const double uu = glm::dot(u, u);
  const double uv = glm::dot(u, v);
  const double vv = glm::dot(v, v);
  const double determinant = uu * vv - uv * uv;
  if (determinant <= 1e-12 * uu * vv) return least;
  const double s = (uv * glm::dot(v, w) - vv * glm::dot(u, w)) / determinant;
  const double t = (uu * glm::dot(v, w) - uv * glm::dot(u, w)) / determinant;
  if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, glm::length(w + s * u - t * v));
  return least;
}

KnownPair spheres(Random& random, double spread) {
  const Sphere a{.center = spread * random.in_cube(), .radius = random.uniform(0.1, 2)};
  const Sphere b{.center = spread * random.in_cube(), .radius = random.uniform(0.1, 2)};
  return {"spheres", a, b, glm::distance(a.center, b.center) - a.radius - b.radius};
}

KnownPair boxes(Random& random, double spread) {
  std::array<Vec3, 2> low{};
  std::array<Vec3, 2> high{};
  for (std::size_t i = 0; i < 2; ++i) {
    low[i] = spread * random.in_cube();
    if (random.one_in(2)) low[i] = glm::round(low[i]);
    for (int axis = 0; axis < 3; ++axis)
      high[i][axis] = low[i][axis] + static_cast<double>(1 + random.bits() % 3);
  }
  const Vec3 gap = glm::max(low[0] - high[1], low[1] - high[0]);
  const double most = std::max({gap.x, gap.y, gap.z});
  return {"boxes", Box{.corner_a = low[0], .corner_b = high[0]},
          Box{.corner_a = low[1], .corner_b = high[1]},
          most < 0 ? most : glm::length(glm::max(gap, Vec3(0)))};
}

KnownPair capsules(Random& random, double spread) {
  const Vec3 a = spread * random.in_cube();
  const Vec3 b = spread * random.in_cube();
  const Vec3 u = 3.0 * random.direction();
  const Vec3 v = 3.0 * random.direction();
  const double r = random.uniform(0.1, 1);
  const double q = random.uniform(0.1, 1);
  return {"capsules", Capsule{.from = a, .to = a + u, .radius = r},
          Capsule{.from = b, .to = b + v, .radius = q}, between_segments(a, u, b, v) - r - q};
}

KnownPair sphere_and_torus(Random& random, double spread) {
  const Torus torus{.radius = random.uniform(0.5, 2), .thickness = random.uniform(0.05, 0.45)};
  const Sphere sphere{.center = spread * random.in_cube(), .radius = random.uniform(0.05, 0.5)};
  const Vec3& p = sphere.center;
  const double from_axis = std::hypot(p.x, p.z);
  const double tube = std::hypot(from_axis - torus.radius, p.y) - torus.thickness;
  return {"sphere and torus", torus, sphere, tube - sphere.radius};
}

KnownPair sphere_and_cylinder(Random& random, double spread) {
  const double height = random.uniform(0.5, 3);
  const Cylinder cylinder{
      .from = {0, 0, 0}, .to = {0, height, 0}, .radius = random.uniform(0.1, 2)};
  const Sphere sphere{.center = spread * random.in_cube(), .radius = random.uniform(0.05, 1)};
  const Vec3& p = sphere.center;
  const double beside = std::hypot(p.x, p.z) - cylinder.radius;
  const double beyond = std::max(-p.y, p.y - height);
  const double outside = beside < 0 && beyond < 0
                             ? std::max(beside, beyond)
                             : std::hypot(std::max(beside, 0.0), std::max(beyond, 0.0));
  return {"sphere and cylinder", cylinder, sphere, outside - sphere.radius};
}

KnownPair sphere_and_plate(Random& random, double spread) {
  // The ball is above a hole that is as wide as the plate is far away, or beside it.
  const double hole = random.uniform(0.3, 1);
  const Entity plate = Entity(Box{.corner_a = {-5, -1, -5}, .corner_b = {5, 0, 5}}) -
                       Entity(Cylinder{.from = {0, -2, 0}, .to = {0, 2, 0}, .radius = hole});
  Vec3 p = 0.5 * spread * random.in_cube();
  p.y = std::abs(p.y) + 1e-3;
  const double from_axis = std::hypot(p.x, p.z);
  const double away = from_axis < hole ? std::hypot(hole - from_axis, p.y) : p.y;
  const double radius = random.uniform(0.05, 0.5);
  const bool is_above = std::abs(p.x) < 5 && std::abs(p.z) < 5;
  if (!is_above) return spheres(random, spread);
  return {"ball above a hole", plate, Sphere{.center = p, .radius = radius}, away - radius};
}

void check_known_pair(Random& random, Account& account) {
  using Make = KnownPair (*)(Random&, double);
  constexpr std::array<Make, 6> makers = {
      spheres, boxes, capsules, sphere_and_torus, sphere_and_cylinder, sphere_and_plate};
  KnownPair pair = makers[random.bits() % makers.size()](random, random.uniform(1, 8));
  account.count(pair.name);
  double factor = 1;
  Transform map;
  if (random.one_in(2)) {
    map = random_even_map(random, factor);
    pair.a = pair.a.transformed(map);
    pair.b = pair.b.transformed(map);
  }
  const MeasureOptions options{
      .relative_width = random.power_of_ten(-6, -1), .seconds = seconds, .threads = 1};
  const Clearance found = clearance(pair.a, pair.b, options);
  const double reach = factor * 10 + glm::length(map.translation);
  const double error = 1e-12 * reach;
  const double distance = factor * pair.distance;
  check_holds(account, "known distances", found.distance, std::max(distance, 0.0), error);
  if (found.overlap) account.check(distance < error, "solids apart are said to overlap");
  if (found.overlap) return;
  account.check(std::abs(glm::distance(found.on_a, found.on_b) - found.distance.upper) <= error,
                "the pair of points is not as far apart as the upper end says");
}

// ---- distances by points ----

/// Returns points in a solid next to its surface, where rays meet it.
std::vector<Vec3> points_in(const Entity& entity, const Transform& map, Random& random) {
  Scene scene;
  scene.entities = {entity};
  RayQueries queries(prepare(scene));
  std::vector<Hit> hits;
  std::vector<Vec3> points;
  for (int ray = 0; ray < 60; ++ray) {
    const Vec3 from = moved(map, 12.0 * random.direction());
    const Vec3 way = moved(map, 3.0 * random.in_cube()) - from;
    queries.crossings({.origin = from, .direction = way}, hits);
    double entered = 0;
    for (const Hit& hit : hits) {
      if (hit.entering) entered = hit.t;
      if (hit.entering || hit.t - entered < 1e-7) continue;
      for (const double share : {1e-4, 0.5, 1 - 1e-4})
        points.push_back(from + (entered + share * (hit.t - entered)) * way);
    }
  }
  return points;
}

double least_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : a)
    for (const Vec3& q : b) least = std::min(least, glm::distance(p, q));
  return least;
}

/// A TreePair is two trees, of which the second is moved aside.
class TreePair {
 public:
  TreePair(std::uint64_t number, Random& random, Account& account)
      : random_(random), account_(account) {
    SolidTree one = random_solid(2 * number, Leaves::all);
    SolidTree other = random_solid(2 * number + (random.one_in(2) ? 1 : 2), Leaves::all);
    one.own = random.one_in(2) ? random_even_map(random, factor_) : Transform{};
    other.own = one.own;
    const double aside = random.one_in(4) ? 0 : random.uniform(0, 12);
    const Vec3 way = aside * random.direction();
    other.own.translation = moved(one.own, random.one_in(2) ? glm::round(way) : way);
    maps_ = {one.own, other.own};
    solids_ = {one.entity(), other.entity()};
  }

  void run() {
    for (std::size_t i = 0; i < 2; ++i) points_[i] = points_in(solids_[i], maps_[i], random_);
    if (points_[0].empty() || points_[1].empty()) {
      account_.count("empty");
      return;
    }
    account_.count("trees");
    found_ = clearance(solids_[0], solids_[1], options());
    check_points();
    check_pair_of_points();
    check_nearest(0);
    check_nearest(1);
  }

 private:
  MeasureOptions options() {
    return {.relative_width = random_.power_of_ten(-6, -1), .seconds = seconds, .threads = 1};
  }
  double error() const { return 1e-12 * (20 * factor_ + glm::length(maps_[0].translation)); }

  /// No two points of the solids are nearer to each other than they are.
  void check_points() {
    const double least = least_distance(points_[0], points_[1]);
    account_.count("distances of points");
    account_.check(
        least >= found_.distance.lower - error(),
        fmt::format("points are {:.17g} apart, solids {}", least, text_of(found_.distance)));
    if (found_.overlap) return;
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<PointSide> sides(points_[i].size());
      contains(solids_[1 - i], points_[i], sides, 1);
      for (std::size_t k = 0; k < sides.size(); ++k) {
        if (sides[k] == PointSide::inside && found_.distance.lower > error())
          account_.fail("a point is in both solids, which are said to be apart");
      }
    }
  }

  void check_pair_of_points() {
    const std::array<Vec3, 2> on = {found_.on_a, found_.on_b};
    if (found_.overlap) {
      for (const Entity& solid : solids_)
        account_.check(contains(solid, on[0]) != PointSide::outside,
                       "the point in both solids is outside of one");
      return;
    }
    account_.check(std::abs(glm::distance(on[0], on[1]) - found_.distance.upper) <= error(),
                   fmt::format("the pair of points is {:.17g} apart, not {}",
                               glm::distance(on[0], on[1]), text_of(found_.distance)));
    for (std::size_t i = 0; i < 2; ++i) {
      if (contains(solids_[i], on[i]) != PointSide::outside) continue;
      const NearestPoint near = nearest_point(solids_[i], on[i], {.seconds = seconds});
      account_.check(
          near.distance.lower <= 1e3 * error(),
          fmt::format("a point of the pair is {:.3g} off its solid", near.distance.lower));
    }
  }

  /// Compares with how far points of one solid are from the other.
  void check_nearest(std::size_t one) {
    std::vector<Vec3> points = points_[one];
    constexpr std::size_t most = 12;
    if (points.size() > most) points.resize(most);
    std::vector<NearestPoint> nearest(points.size());
    nearest_points(solids_[1 - one], points, nearest, options());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Interval& distance = nearest[i].distance;
      account_.count("nearest points");
      account_.check(std::max(distance.upper, 0.0) >= found_.distance.lower - error(),
                     fmt::format("a point is {} from the other solid, the solids {}",
                                 text_of(distance), text_of(found_.distance)));
      for (const Vec3& inside : points_[1 - one]) {
        const double away = glm::distance(inside, points[i]);
        if (distance.lower > away + error())
          account_.fail(
              fmt::format("a point in a solid is {:.17g} away, not {}", away, text_of(distance)));
      }
    }
  }

  Random& random_;
  Account& account_;
  double factor_ = 1;
  std::array<Transform, 2> maps_{};
  std::array<Entity, 2> solids_ = {Sphere{}, Sphere{}};
  std::array<std::vector<Vec3>, 2> points_;
  Clearance found_;
};

}  // namespace

void check_pair(std::uint64_t number, Account& account) {
  Random random(1000003 * number + 53);
  if (number % 2 == 0) {
    check_known_pair(random, account);
  } else {
    TreePair(number, random, account).run();
  }
}

}  // namespace crt::truth
