#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "truth/check_truth.hpp"
#include "truth/point_oracle.hpp"
#include "truth/random_solids.hpp"

namespace crt::truth {
namespace {

constexpr std::size_t points_of_solid = 100;
constexpr double reach = 5;

/// Returns points next to where rays meet the surface, 10^-16 to 10^-1 away or not at all.
void add_near_surface(const Entity& entity, const Transform& map, Random& random,
                      std::vector<Vec3>& points) {
  Scene scene;
  scene.entities = {entity};
  RayQueries queries(prepare(scene));
  for (int ray = 0; ray < 30 && points.size() < points_of_solid; ++ray) {
    const Vec3 from = moved(map, 3 * reach * random.direction());
    const Vec3 to = moved(map, 2.0 * random.in_cube());
    const auto hit = queries.intersect({.origin = from, .direction = to - from});
    if (!hit) continue;
    points.push_back(hit->position);
    const double away = random.power_of_ten(-16, -1) * glm::length(to - from);
    points.push_back(hit->position + (random.one_in(2) ? away : -away) * hit->normal);
  }
}

std::vector<Vec3> points_of(const Entity& entity, const Transform& map, Random& random) {
  std::vector<Vec3> points;
  add_near_surface(entity, map, random, points);
  while (points.size() < points_of_solid) {
    const Vec3 point = reach * random.in_cube();
    // On the grid are corners, edges and faces.
    Vec3 on_grid = glm::round(2.0 * point) / 2.0;
    if (random.one_in(2)) on_grid[static_cast<int>(random.bits() % 3)] = point.x;
    points.push_back(moved(map, points.size() % 2 == 0 ? point : on_grid));
  }
  return points;
}

/// Returns whether a part is moved by more than one map: those are composed and rounded.
bool has_composed_maps(const SolidTree& tree, int maps = 0) {
  if (tree.own != Transform{}) ++maps;
  if (maps > 1) return true;
  return std::ranges::any_of(tree.parts,
                             [&](const SolidTree& part) { return has_composed_maps(part, maps); });
}

}  // namespace

void check_points(std::uint64_t number, Account& account) {
  SolidTree tree = random_solid(number, Leaves::with_oracle);
  Random random(1000003 * number + 29);
  double factor = 1;
  if (random.one_in(2)) tree.own = random_even_map(random, factor);
  const Entity entity = tree.entity();
  const std::vector<Vec3> points = points_of(entity, tree.own, random);
  std::vector<PointSide> sides(points.size());
  contains(entity, points, sides, 1);
  const PointOracle oracle(tree);
  const bool is_composed = has_composed_maps(tree);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& point = points[i];
    const PointSide truth = oracle.side(point);
    account.count("points");
    if (truth == sides[i]) {
      if (truth == PointSide::on) account.count("on the surface");
      continue;
    }
    const auto text = [&](const char* what) {
      return fmt::format("({:.17g}, {:.17g}, {:.17g}) is {}: truly {}, said {}", point.x, point.y,
                         point.z, what, static_cast<int>(truth), static_cast<int>(sides[i]));
    };
    const double size = glm::length(point) + glm::length(tree.own.translation) + reach * factor;
    if (sides[i] != PointSide::on) {
      account.count("where composed maps are rounded");
      if (!is_composed || !oracle.is_near(point, sides[i], 0x1p-50 * size))
        account.fail(text("on the wrong side"));
      continue;
    }
    // Rounding lets one know no more, or a surface of a part is none of the solid.
    account.count("on a surface to rounding");
    const double near = 1e-11 * size;
    const PointSide other = truth == PointSide::inside ? PointSide::outside : PointSide::inside;
    if (!oracle.is_near(point, other, near)) account.count("where parts touch");
  }
}

}  // namespace crt::truth
