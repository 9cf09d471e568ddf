#include "oracle/solid_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "oracle/equations.hpp"
#include "oracle/places.hpp"

namespace crt::test {
namespace {

Vec3 whole_vector(Counted& random, int most) {
  const double x = random.integer(-most, most);
  const double y = random.integer(-most, most);
  return {x, y, static_cast<double>(random.integer(-most, most))};
}

Vec3 random_axis(Counted& random) {
  Vec3 axis(0);
  axis[random.integer(0, 2)] = random.sign();
  return axis;
}

/// Returns a quadric whose numbers are small integers: what a sphere or a cylinder is, a double
/// cone or a hyperboloid about the axis, or a slab across it.
Quadric grid_quadric(Counted& random, const Vec3& at, const Vec3& axis, double size) {
  const Vec3 along = axis * axis;
  const int kind = random.integer(0, 3);
  const Vec3 squares = kind < 3 ? Vec3(1) - static_cast<double>(kind) * along : along;
  const bool has_apex = kind == 2 && random.integer(0, 1) == 0;
  return {.squares = squares,
          .linear = -2.0 * squares * at,
          .constant = glm::dot(squares, at * at) - (has_apex ? 0 : size * size)};
}

/// Returns a leaf whose numbers are small integers.
Primitive grid_leaf(Counted& random) {
  const Vec3 at = whole_vector(random, 2);
  const Vec3 axis = random_axis(random);
  const double size = random.integer(1, 2);
  const double other = random.integer(1, 2);
  switch (random.integer(0, 11)) {
    case 0:
      return Sphere{.center = at, .radius = size};
    case 1:
      return Plane{.normal = axis, .position = at};
    case 2:
      return Cylinder{.from = at, .to = at + other * axis, .radius = size};
    case 3:
      return Cone{.from = at,
                  .to = at + other * axis,
                  .radius = size,
                  .radius2 = static_cast<double>(random.integer(0, 2))};
    case 4:
      return Torus{.center = at, .axis = axis, .radius = size, .thickness = other / 2};
    case 5:
      return Capsule{.from = at, .to = at + other * axis, .radius = size};
    case 6:
      return grid_quadric(random, at, axis, size);
    case 7:
      return RoundedBox{.corner_a = at,
                        .corner_b = at + Vec3(size, other, random.integer(1, 3)),
                        .radius = random.integer(1, 2) / 4.0};
    default:
      return Box{.corner_a = at, .corner_b = at + Vec3(size, other, random.integer(1, 3))};
  }
}

/// Applies the linear part to v, exactly for the numbers here.
Vec3 apply(const Transform& transform, const Vec3& v) {
  return {glm::dot(transform.row_x, v), glm::dot(transform.row_y, v), glm::dot(transform.row_z, v)};
}

Transform compose(const Transform& second, const Transform& first) {
  const auto row = [&](const Vec3& r) {
    return r.x * first.row_x + r.y * first.row_y + r.z * first.row_z;
  };
  return {row(second.row_x), row(second.row_y), row(second.row_z),
          apply(second, first.translation) + second.translation};
}

/// Returns a turn by quarters. Now and then it is by an eighth, which takes planes of the grid to
/// diagonal ones (and makes all of it the root of 2 larger across), or half or twice the size.
Transform grid_transform(Counted& random) {
  Transform result;
  if (random.integer(0, 2) > 0) return result;
  const double x = 90.0 * random.integer(0, 3);
  const double y = 90.0 * random.integer(0, 3);
  result = rotate_degrees({x, y, 90.0 * random.integer(0, 3)});
  if (random.integer(0, 3) == 0)
    result = compose({.row_x = {1, -1, 0}, .row_y = {1, 1, 0}, .row_z = {0, 0, 1}}, result);
  if (random.integer(0, 3) == 0)
    result = compose(scale(random.integer(0, 1) == 0 ? 0.5 : 2.0), result);
  result.translation = whole_vector(random, 1);
  return result;
}

SolidTree part_of_depth(Counted& random, int depth, const Transform& outer) {
  SolidTree tree;
  tree.own = grid_transform(random);
  tree.to_world = compose(outer, tree.own);
  if (depth == 0) {
    tree.primitive = grid_leaf(random);
    return tree;
  }
  // Unions are more frequent, as the others leave little.
  const int tenth = random.integer(0, 9);
  tree.kind = tenth < 5   ? SolidTree::Kind::set_union
              : tenth < 8 ? SolidTree::Kind::difference
                          : SolidTree::Kind::intersection;
  const int count = random.integer(2, 3);
  for (int i = 0; i < count; ++i) {
    // The same part comes twice, which makes most of what coincides by design.
    const bool again = i > 0 && random.integer(0, 9) == 0;
    tree.parts.push_back(again ? tree.parts[0] : part_of_depth(random, depth - 1, tree.to_world));
  }
  return tree;
}

bool value_of(SolidTree::Kind kind, const std::vector<bool>& parts) {
  const auto is_true = [](bool part) { return part; };
  if (kind == SolidTree::Kind::set_union) return std::any_of(parts.begin(), parts.end(), is_true);
  if (kind == SolidTree::Kind::intersection)
    return std::all_of(parts.begin(), parts.end(), is_true);
  return parts[0] && std::none_of(parts.begin() + 1, parts.end(), is_true);
}

/// Returns the value of a tree from that of its leaves, in their order.
template <class LeafValue>
bool value_of(const SolidTree& tree, const LeafValue& leaf_value, std::size_t& leaf) {
  if (tree.kind == SolidTree::Kind::leaf) return leaf_value(leaf++);
  std::vector<bool> parts;
  for (const SolidTree& part : tree.parts) parts.push_back(value_of(part, leaf_value, leaf));
  return value_of(tree.kind, parts);
}

/// Returns -1, 0 or 1: outside, open, inside.
int certain_value(const SolidTree& tree, const std::vector<int>& leaf_sides, std::size_t& leaf) {
  if (tree.kind == SolidTree::Kind::leaf) return leaf_sides[leaf++];
  std::vector<bool> smallest;
  std::vector<bool> largest;
  for (const SolidTree& part : tree.parts) {
    const int side = certain_value(part, leaf_sides, leaf);
    const bool cuts = tree.kind == SolidTree::Kind::difference && !smallest.empty();
    smallest.push_back(cuts ? side >= 0 : side > 0);
    largest.push_back(cuts ? side > 0 : side >= 0);
  }
  if (value_of(tree.kind, smallest)) return 1;
  return value_of(tree.kind, largest) ? 0 : -1;
}

/// The tree's numbers are so small that nothing is gained by a shift.
template <class Number>
Equations<Number> equations_along(const GridRay& ray, const SolidTree& leaf) {
  ExactLine<Number> line(ray.origin, ray.direction, leaf.to_world, Vec3(0));
  line.move_to(0);
  return equations(leaf.primitive, line);
}

/// Says whether an equation is of a face. A torus has another one, and so have the caps within a
/// capsule; and an apex has a plane. Of a rounded box only the flat faces count.
bool is_of_face(const Primitive& primitive, std::size_t equation) {
  if (std::holds_alternative<Torus>(primitive)) return equation == 0;
  if (std::holds_alternative<Capsule>(primitive)) return equation == 0 || equation > 2;
  if (std::holds_alternative<RoundedBox>(primitive)) return equation < flat_equations;
  const Cone* cone = std::get_if<Cone>(&primitive);
  return cone == nullptr || equation < 2 || cone->radius2 > 0;
}

}  // namespace

Entity SolidTree::entity() const {
  const auto combined = [&]() -> Entity {
    if (kind == Kind::leaf) return std::visit([](const auto& p) { return Entity(p); }, primitive);
    std::vector<Entity> made;
    for (const SolidTree& part : parts) made.push_back(part.entity());
    if (kind == Kind::set_union) return csg_union(made);
    if (kind == Kind::intersection) return csg_intersection(made);
    return csg_difference(made[0], std::span(made).subspan(1));
  };
  return own == Transform{} ? combined() : combined().transformed(own);
}

SolidTree random_tree(std::uint64_t number) {
  Counted random(100, number);
  return part_of_depth(random, random.integer(1, 3), Transform{});
}

GridRay random_ray(std::uint64_t tree, std::uint64_t number) {
  constexpr std::uint64_t max_rays = 1 << 20;
  Counted random(101, tree * max_rays + number);
  GridRay ray{9.0 * random.in_cube(), Vec3(0)};
  const auto share = [&] { return random.integer(-1 << 20, 1 << 20) * 0x1p-18; };
  switch (random.integer(0, 5)) {
    case 0:  // through a corner of the grid
      ray.direction = whole_vector(random, 3) - ray.origin;
      break;
    case 1:  // from corner to corner: through edges, and within faces
      ray.origin = whole_vector(random, 9);
      do ray.direction = whole_vector(random, 3);
      while (ray.direction == Vec3(0));
      break;
    case 2: {  // within a plane of the grid
      const int axis = random.integer(0, 2);
      ray.direction = random.in_cube();
      ray.direction[axis] = 0;
      ray.origin[axis] = random.integer(-6, 6) / 2.0;
      break;
    }
    case 3: {  // along an edge of the grid
      const int axis = random.integer(0, 2);
      ray.direction[axis] = random.sign() * random.uniform(0.5, 2);
      for (int i = 0; i < 3; ++i)
        ray.origin[i] = i == axis ? ray.origin[i] : random.integer(-6, 6) / 2.0;
      break;
    }
    case 4:  // within a diagonal plane
      ray.origin = whole_vector(random, 3) + share() * Vec3(1, -1, 0);
      ray.direction = Vec3(1, -1, 0) + Vec3(0, 0, share());
      break;
    default:  // anywhere
      ray.direction = 3.0 * random.in_cube() - ray.origin;
  }
  return ray;
}

TreeOracle::TreeOracle(const SolidTree& tree) : tree_(tree) {
  collect(tree);
  find_coincident();
}

void TreeOracle::collect(const SolidTree& tree) {
  if (tree.kind == SolidTree::Kind::leaf) leaves_.push_back(&tree);
  for (const SolidTree& part : tree.parts) collect(part);
}

/// Two surfaces are one if their equations are equal, but for a factor, along some lines of small
/// whole numbers, where everything is computed without rounding. There are more lines than surfaces
/// of these kinds have coefficients.
void TreeOracle::find_coincident() {
  constexpr std::uint64_t probes = 12;
  using Number = Ball<4>;
  std::vector<std::vector<Equations<Number>>> along(leaves_.size());
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    for (std::uint64_t probe = 0; probe < probes; ++probe) {
      Counted random(102, probe);
      const Vec3 origin = whole_vector(random, 40);
      along[leaf].push_back(
          equations_along<Number>({origin, whole_vector(random, 40)}, *leaves_[leaf]));
    }
  }
  std::vector<int> leaves_of_surface;
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    equations_.emplace_back();
    for (std::size_t i = 0; i < along[leaf][0].size(); ++i) {
      const auto is_same = [&](const Surface& surface) {
        for (std::size_t probe = 0; probe < probes; ++probe) {
          if (!are_proportional(along[leaf][probe][i],
                                along[surface.leaf][probe][surface.equation]))
            return false;
        }
        return true;
      };
      const auto found = std::find_if(surfaces_.begin(), surfaces_.end(), is_same);
      const auto place = static_cast<std::size_t>(found - surfaces_.begin());
      if (found == surfaces_.end()) surfaces_.push_back({leaf, i});
      const Surface& surface = surfaces_[place];
      int orientation = 0;
      for (std::size_t probe = 0; orientation == 0; ++probe) {
        orientation = along[leaf][probe][i].back().sign() *
                      along[surface.leaf][probe][surface.equation].back().sign();
      }
      equations_.back().push_back({place, orientation});
    }
  }
  const auto is_on = [&](std::size_t leaf, std::size_t surface) {
    return std::any_of(equations_[leaf].begin(), equations_[leaf].end(),
                       [&](const Equation& equation) { return equation.surface == surface; });
  };
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    for (std::size_t i = 0; i < equations_[leaf].size(); ++i) {
      if (!is_of_face(leaves_[leaf]->primitive, i)) continue;
      ++faces_;
      bool shared = false;
      for (std::size_t other = 0; other < leaves_.size(); ++other)
        shared = shared || (other != leaf && is_on(other, equations_[leaf][i].surface));
      coincident_faces_ += shared ? 1 : 0;
    }
  }
}

TreeOracle::Flips TreeOracle::flips(const GridRay& ray) const {
  return until_certain([&]<class Number>(Using<Number>) {
    std::vector<Polynomial<Number>> polynomials;
    std::size_t solved = leaves_.size();
    Equations<Number> of_leaf;
    for (const Surface& surface : surfaces_) {
      if (surface.leaf != solved) of_leaf = equations_along<Number>(ray, *leaves_[surface.leaf]);
      solved = surface.leaf;
      polynomials.push_back(of_leaf[surface.equation]);
    }
    const Places<Number> places(polynomials);
    Few<int, max_equations> leaf_signs;
    const auto inside = [&](const std::vector<int>& signs) {
      const auto leaf_value = [&](std::size_t leaf) {
        leaf_signs = {};
        for (const Equation& equation : equations_[leaf])
          leaf_signs.push_back(equation.orientation * signs[equation.surface]);
        return is_inside(leaves_[leaf]->primitive, leaf_signs);
      };
      std::size_t leaf = 0;
      return value_of(tree_, leaf_value, leaf);
    };
    Flips result;
    result.inside_before = follow(places, inside, [&](const Place<Number>& place, bool entering) {
      result.flips.push_back({as_ball(place.x), entering});
    });
    return result;
  });
}

int TreeOracle::certain_side(const GridRay& ray, double t) const {
  std::vector<int> sides;
  for (const SolidTree* leaf : leaves_) {
    const Question question{leaf->primitive, ray.origin, ray.direction, leaf->to_world};
    const double outside = true_distance(question, t);
    const PointAndSpeed at = point_and_speed(question, t);
    const double from_center = glm::length(at.point - center_of(leaf->primitive));
    const double allowed =
        8 * unit_of_rounding * (size_of(leaf->primitive) + from_center) + ulp(t) * at.speed;
    sides.push_back(std::abs(outside) <= allowed ? 0 : (outside < 0 ? 1 : -1));
  }
  std::size_t leaf = 0;
  return certain_value(tree_, sides, leaf);
}

}  // namespace crt::test
