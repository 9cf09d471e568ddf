#include "continued_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/implicit_shapes.hpp>
#include <limits>
#include <numbers>

namespace crt::test {

namespace {

/// Is a ball that a program computes in plain doubles, with the errors that it states.
class CustomBall final : public CustomShape {
 public:
  BoundingBox bounds() const override { return {Vec3(-1), Vec3(1)}; }
  void crossings(const Ray& ray, std::vector<CustomCrossing>& out) const override {
    const double b = glm::dot(ray.origin, ray.direction);
    const double c = glm::dot(ray.origin, ray.origin) - 1;
    const double discriminant = b * b - c;
    if (!(discriminant > 0)) return;
    const double root = std::sqrt(discriminant);
    const double error = 1e-14 / root;
    out.push_back({.t = -b - root, .error = error});
    out.push_back({.t = -b + root, .error = error});
  }
  CustomPoint point(const Vec3& position, std::uint32_t) const override {
    return {.normal = position};
  }
};

Entity cube_mesh() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    corners.emplace_back((i & 1) != 0 ? 0.7 : -0.7, (i & 2) != 0 ? 0.7 : -0.7,
                         (i & 4) != 0 ? 0.7 : -0.7);
  }
  const std::vector<TriangleIndices> triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                                  {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                                  {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return triangle_mesh(corners, triangles);
}

/// Makes a tent, which is convex.
Entity tent() {
  std::vector<double> heights(9);
  for (int i = 0; i < 9; ++i) heights[static_cast<std::size_t>(i)] = i % 3 == 1 ? 0.9 : 0.3;
  return HeightField{.heights = make_height_grid(heights, 3, 3),
                     .corner_a = {-0.6, -0.5, -0.6},
                     .corner_b = {0.6, 0.6, 0.6}};
}

std::shared_ptr<const Profile> profile_of(Contour contour) {
  return make_profile(std::array{std::move(contour)});
}

Transform product(const Transform& first, const Transform& then) {
  const auto row = [&](const Vec3& of) {
    return of.x * first.row_x + of.y * first.row_y + of.z * first.row_z;
  };
  const auto moved = [&](const Vec3& of, double by) {
    return glm::dot(of, first.translation) + by;
  };
  return {row(then.row_x),
          row(then.row_y),
          row(then.row_z),
          {moved(then.row_x, then.translation.x), moved(then.row_y, then.translation.y),
           moved(then.row_z, then.translation.z)}};
}

}  // namespace

std::vector<ConvexSolid> convex_solids() {
  const Field x = Field::x();
  const Field y = Field::y();
  const Field z = Field::z();
  const double quarter = std::tan(std::numbers::pi / 8);
  const Contour lens{{0, -0.2}, {0.9, 0.3, 0.2}, {0, 0.9, 0.3}};
  const Contour plate{{-0.8, -0.7}, {0.7, -0.8}, {0.5, 0.8, 0.2}, {-0.6, 0.6, quarter}};
  return {
      {"sphere", Sphere{.center = {0.3, -0.2, 0.4}, .radius = 0.9}},
      {"sphere about the origin", Sphere{}},
      {"box", Box{.corner_a = {-0.7, -0.6, -0.8}, .corner_b = {0.5, 0.7, 0.6}}},
      {"box from the origin", Box{.corner_a = {0, 0, 0}, .corner_b = {0.1, 0.1, 0.1}}},
      {"rounded box",
       RoundedBox{.corner_a = {-0.7, -0.6, -0.8}, .corner_b = {0.5, 0.7, 0.6}, .radius = 0.4}},
      {"plane", Plane{.normal = {0.3, 0.8, -0.2}, .position = {0.1, 0.4, -0.3}}, false},
      {"half plane", HalfPlane{.normal = {0.1, 1, 0.4}, .position = {-0.5, 0.1, 0}}, false},
      {"cylinder", Cylinder{.from = {-0.5, -0.4, 0.1}, .to = {0.5, 0.6, 0.2}, .radius = 0.6}},
      {"cone", Cone{.from = {0, -0.7, 0.1}, .to = {0.1, 0.8, 0}, .radius = 0.8}},
      {"cut cone", Cone{.from = {0, -0.7, 0}, .to = {0, 0.7, 0}, .radius = 0.9, .radius2 = 0.3}},
      {"capsule", Capsule{.from = {-0.4, -0.3, 0}, .to = {0.4, 0.2, 0.1}, .radius = 0.5}},
      {"disc", Disc{.center = {0.1, 0.1, 0.2}, .normal = {0.2, 1, 0.1}, .radius = 0.9}, false},
      {"triangle", Triangle{.a = {-0.8, 0, 0.1}, .b = {0.9, 0.2, -0.4}, .c = {0, 0.1, 0.9}}, false},
      {"mesh", cube_mesh()},
      {"extrusion", Extrusion{.profile = profile_of(plate), .from = -0.6, .to = 0.7}},
      {"revolution", Revolution{.profile = profile_of(lens)}},
      {"half a revolution",
       Revolution{.profile = profile_of(lens), .angle = std::numbers::pi * 0.8}},
      {"height field", tent()},
      {"quadric", Quadric{.squares = {1.3, 2, 1.1}, .products = {0.2, 0.1, -0.3}}},
      {"quadric beside the origin",
       Quadric{.squares = {1, 1.5, 1}, .linear = {-1, 0.8, 0.3}, .constant = -0.4}},
      {"implicit", Implicit{.field = x * x + y * y * y * y + 2.0 * z * z - 0.8}},
      {"superellipsoid", superellipsoid(0.7, 0.8)},
      {"custom", Custom{.shape = std::make_shared<CustomBall>()}},
      {"two boxes as one",
       Entity(Box{.corner_a = {-0.8, -0.6, -0.6}, .corner_b = {0.1, 0.6, 0.6}}) +
           Entity(Box{.corner_a = {0.1, -0.6, -0.6}, .corner_b = {0.8, 0.6, 0.6}})},
      {"a ball cut twice",
       (Entity(Sphere{}) - Entity(Plane{.normal = {0, -1, 0.2}, .position = {0, 0.5, 0}})) ^
           Entity(Cylinder{.from = {-2, 0, 0}, .to = {2, 0, 0}, .radius = 0.9})},
  };
}

Ray Placing::ray_at(const ConvexSolid& solid, Numbers& numbers) const {
  const double away = numbers.size(1.5, 4);
  Vec3 from = away * numbers.direction();
  Vec3 to = numbers.point(0.6);
  if (solid.name == "box from the origin") {
    from = 0.1 * from;
    to = 0.1 * numbers.point(1);
  }
  const Vec3 origin = to_world(from);
  return {.origin = origin, .direction = to_world(to) - origin};
}

std::vector<Placing> placings(Numbers& numbers) {
  const Transform turn = rotate_degrees(numbers.point(180));
  const Transform shear{{1, 0.4, 0}, {0, 1, 0.3}, {0.2, 0, 1}, {0, 0, 0}};
  std::vector<Placing> places = {
      {"as it is", {}, 1},
      {"turned", turn, 1},
      {"sheared", shear, 1},
      {"turned and sheared", product(turn, shear), 1},
  };
  for (const double by : {1.0, 100.0, 1e4, 1e7}) {
    places.push_back({"turned and moved", product(turn, translate(by * numbers.direction())), 1});
  }
  places.push_back({"moved", translate(5e6 * numbers.direction()), 1});
  for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
    places.push_back({"scaled", scale(size), size});
    places.push_back({"scaled, turned, sheared and moved",
                      product(product(product(scale(size), turn), shear),
                              translate(numbers.size(0.1, 1e3) * size * numbers.direction())),
                      size});
  }
  return places;
}

void check_nothing(RayQueries& queries, std::span<const Ray> rays, const std::string& what) {
  int met = 0;
  std::vector<Hit> all;
  for (const Ray& ray : rays) {
    queries.crossings(ray, all);
    const bool is_met = queries.occluded(ray);
    met += is_met;
    CHECK_MESSAGE(is_met == !all.empty(), what);
    CHECK_MESSAGE(is_met == queries.intersect(ray).has_value(), what);
  }
  CHECK_MESSAGE(met == 0, what);
  std::vector<std::optional<Hit>> hits(rays.size());
  const std::unique_ptr<bool[]> blocked(new bool[rays.size()]);
  std::vector<double> distances(rays.size());
  queries.intersect(rays, hits);
  queries.occluded(rays, std::span(blocked.get(), rays.size()));
  queries.distances(rays, distances);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    CHECK_MESSAGE(!hits[i], what);
    CHECK_MESSAGE(!blocked[i], what);
    CHECK_MESSAGE(std::isinf(distances[i]), what);
  }
}

void check_leaving(RayQueries& queries, std::span<const Ray> rays, const std::string& what) {
  std::vector<Hit> all;
  std::vector<std::optional<Hit>> hits(rays.size());
  queries.intersect(rays, hits);
  int returned = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    queries.crossings(rays[i], all);
    // Where a ray all but grazes, what it passes within the solid may be less than rounding.
    returned += all.size() > 1 || (!all.empty() && all[0].entering);
    CHECK_MESSAGE(hits[i].has_value() == !all.empty(), what);
    if (!all.empty()) CHECK_MESSAGE(hits[i]->t == all[0].t, what);
  }
  CHECK_MESSAGE(returned == 0, what);
}

}  // namespace crt::test
