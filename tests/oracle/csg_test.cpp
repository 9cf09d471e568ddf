// Trees of solids whose faces coincide, against membership by exact roots.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"
#include "core/scene/prepared_data.hpp"
#include "crt/entity.hpp"
#include "oracle/equations.hpp"
#include "oracle/places.hpp"
#include "oracle/ray_maker.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Tree {
  enum class Kind { leaf, set_union, intersection, difference };

  Kind kind = Kind::leaf;
  Primitive primitive = Sphere{};
  std::vector<Tree> parts;

  Entity entity() const {
    if (kind == Kind::leaf) return std::visit([](const auto& p) { return Entity(p); }, primitive);
    std::vector<Entity> made;
    for (const Tree& part : parts) made.push_back(part.entity());
    if (kind == Kind::set_union) return csg_union(made);
    if (kind == Kind::intersection) return csg_intersection(made);
    return csg_difference(made[0], std::span(made).subspan(1));
  }
};

/// A leaf whose numbers are small integers.
Primitive grid_leaf(Counted& random) {
  const auto integer = [&](int low, int high) { return static_cast<double>(random.integer(low, high)); };
  const double x = integer(-2, 2);
  const double y = integer(-2, 2);
  const double z = integer(-2, 2);
  const Vec3 at(x, y, z);
  Vec3 axis(0);
  axis[random.integer(0, 2)] = random.sign();
  const double size = integer(1, 2);
  const double other = integer(1, 2);
  switch (random.integer(0, 9)) {
    case 0:
      return Sphere{.center = at, .radius = size};
    case 1:
      return Plane{.normal = axis, .position = at};
    case 2:
      return Cylinder{.from = at, .to = at + other * axis, .radius = size};
    case 3:
      return Cone{.from = at, .to = at + other * axis, .radius = size, .radius2 = integer(0, 2)};
    case 4:
      return Torus{.center = at, .axis = axis, .radius = size, .thickness = other / 2};
    default:
      return Box{.corner_a = at, .corner_b = at + Vec3(size, other, integer(1, 3))};
  }
}

Tree random_tree(Counted& random, int depth) {
  Tree tree;
  if (depth == 0) {
    tree.primitive = grid_leaf(random);
    return tree;
  }
  tree.kind = static_cast<Tree::Kind>(random.integer(1, 3));
  const int count = random.integer(2, 3);
  for (int i = 0; i < count; ++i) tree.parts.push_back(random_tree(random, depth - 1));
  return tree;
}

void collect_leaves(const Tree& tree, std::vector<Primitive>& leaves) {
  if (tree.kind == Tree::Kind::leaf) leaves.push_back(tree.primitive);
  for (const Tree& part : tree.parts) collect_leaves(part, leaves);
}

/// Whether a point is inside, by the signs of all equations there, leaf by leaf in the order of
/// collect_leaves.
bool contains(const Tree& tree, const std::vector<std::size_t>& first_equation, const std::vector<int>& signs,
              std::size_t& leaf) {
  if (tree.kind == Tree::Kind::leaf) {
    const std::size_t first = first_equation[leaf++];
    return is_inside(tree.primitive, std::span(signs).subspan(first, first_equation[leaf] - first));
  }
  bool all = true;
  bool any = false;
  bool any_later = false;
  bool first = false;
  for (std::size_t i = 0; i < tree.parts.size(); ++i) {
    const bool inside = contains(tree.parts[i], first_equation, signs, leaf);
    all = all && inside;
    any = any || inside;
    if (i == 0) first = inside;
    if (i > 0) any_later = any_later || inside;
  }
  if (tree.kind == Tree::Kind::set_union) return any;
  if (tree.kind == Tree::Kind::intersection) return all;
  return first && !any_later;
}

std::vector<double> true_flips(const Tree& tree, const std::vector<Primitive>& leaves, const Vec3& origin,
                               const Vec3& direction, bool& inside_before) {
  return until_certain([&]<class Number>(Using<Number>) {
    const ExactLine<Number> line(origin, direction, Transform{}, Vec3(0));
    std::vector<Polynomial<Number>> all;
    std::vector<std::size_t> first_equation = {0};
    for (const Primitive& leaf : leaves) {
      const Equations<Number> of_leaf = equations(leaf, line);
      all.insert(all.end(), of_leaf.begin(), of_leaf.end());
      first_equation.push_back(all.size());
    }
    const auto inside = [&](const std::vector<int>& signs) {
      std::size_t leaf = 0;
      return contains(tree, first_equation, signs, leaf);
    };
    std::vector<double> result;
    inside_before = follow(Places<Number>(all), inside, [&](const Place<Number>& place, bool) {
      result.push_back((place.x + Number(line.shift)).value());
    });
    return result;
  });
}

/// The longest stretch in which one of the two is inside and the other is not, in units of t.
double longest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = a;
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  double longest = 0;
  for (std::size_t i = 0; i < all.size(); i += 2) {
    longest = std::max(longest, i + 1 < all.size() ? all[i + 1] - all[i] : infinity);
  }
  return longest;
}

/// How many of the leaves' faces lie on a surface that another leaf has too.
void count_coincident(const std::vector<Primitive>& leaves, int& coincident, int& faces) {
  std::vector<std::pair<std::size_t, core::Surface>> surfaces;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const auto shape = core::make_shape(leaves[i]);
    for (std::uint32_t face = 0; face < shape->face_count(); ++face)
      surfaces.emplace_back(i, shape->surface(face));
  }
  const auto same = [](const core::Surface& a, const core::Surface& b) {
    if (a.kind != b.kind || a.position != b.position || a.sizes != b.sizes) return false;
    return a.direction == b.direction ||
           core::canonical_axis(a.direction) == core::canonical_axis(b.direction);
  };
  for (const auto& [leaf, surface] : surfaces) {
    const std::size_t own = leaf;
    const core::Surface& one = surface;
    ++faces;
    if (std::any_of(surfaces.begin(), surfaces.end(),
                    [&](const auto& other) { return other.first != own && same(other.second, one); }))
      ++coincident;
  }
}

}  // namespace

TEST_CASE("trees of solids on a grid are what exact roots say along every ray") {
  constexpr std::uint64_t trees = 100;
  constexpr int rays_per_tree = 20;
  // Where a ray grazes an edge or a curve, the stretch that is lost is as long as the root of its depth.
  constexpr double grazing = 1e-6;
  constexpr double rounding = 1e-12;
  int faces = 0;
  int coincident = 0;
  int crossings = 0;
  int grazed = 0;
  for (std::uint64_t number = 0; number < trees; ++number) {
    Counted random(100, number);
    const Tree tree = random_tree(random, 3);
    std::vector<Primitive> leaves;
    collect_leaves(tree, leaves);
    count_coincident(leaves, coincident, faces);
    Scene description;
    description.entities.push_back(tree.entity());
    const core::PreparedData scene(description);
    core::RayWorkspace work;
    for (int i = 0; i < rays_per_tree; ++i) {
      const Vec3 origin = 9.0 * random.in_cube();
      // A third of the rays pass a corner of the grid, where edges of many solids meet.
      Vec3 target = 3.0 * random.in_cube();
      if (random.integer(0, 2) == 0) target = glm::floor(target);
      const Vec3 direction = target - origin;
      bool inside_before = false;
      const std::vector<double> expected = true_flips(tree, leaves, origin, direction, inside_before);
      std::vector<core::RayHit> hits;
      scene.crossings(
          {.origin = origin, .direction = direction, .t_min = -infinity, .t_max = infinity, .start = {}},
          false, hits, work);
      std::vector<double> found;
      for (const core::RayHit& hit : hits) found.push_back(hit.t);
      const double difference = longest_difference(expected, found) * glm::length(direction);
      CAPTURE(number);
      CAPTURE(i);
      CAPTURE(expected);
      CAPTURE(found);
      CHECK(difference <= grazing);
      if (difference > rounding) ++grazed;
      crossings += static_cast<int>(expected.size());
    }
  }
  CHECK(2 * coincident >= faces);
  CHECK(crossings > 500);
  CHECK(grazed <= static_cast<int>(trees) * rays_per_tree / 1000);
}
