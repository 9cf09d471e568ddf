#include "truth/point_oracle.hpp"

#include <algorithm>
#include <array>

#include "oracle/equations.hpp"

namespace crt::truth {

using namespace test;

namespace {

/// An Asked is a point, and a direction to points that are infinitely near.
struct Asked {
  Vec3 point;
  Vec3 direction;
  mutable bool is_on_leaf = false;
};

/// Returns the sign of a polynomial just above 0.
template <class Number>
int sign_above_zero(const Polynomial<Number>& p, bool& is_zero) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const int sign = p[i].sign();
    if (sign != 0) return sign;
    is_zero = true;
  }
  return 0;
}

bool is_in_leaf(const SolidTree& leaf, const Asked& asked, const std::vector<Transform>& around) {
  return until_certain([&]<class Number>(Using<Number>) {
    ExactLine<Number> line(asked.point, asked.direction, leaf.own, Vec3(0), around);
    line.move_to(0);
    bool is_zero = false;
    Few<int, max_equations> signs;
    for (const Polynomial<Number>& equation : equations(leaf.primitive, line))
      signs.push_back(sign_above_zero(equation, is_zero));
    if (is_zero) asked.is_on_leaf = true;
    return is_inside(leaf.primitive, signs);
  });
}

/// `around` has the maps that the tree is in, the innermost first, and is left as it was.
bool is_in(const SolidTree& tree, const Asked& asked, std::vector<Transform>& around) {
  if (tree.kind == SolidTree::Kind::leaf) return is_in_leaf(tree, asked, around);
  const bool is_moved = tree.own != Transform{};
  if (is_moved) around.insert(around.begin(), tree.own);
  const auto has = [&](const SolidTree& part) { return is_in(part, asked, around); };
  bool result = false;
  if (tree.kind == SolidTree::Kind::set_union) {
    result = std::ranges::any_of(tree.parts, has);
  } else if (tree.kind == SolidTree::Kind::intersection) {
    result = std::ranges::all_of(tree.parts, has);
  } else {
    result = has(tree.parts[0]) && std::none_of(tree.parts.begin() + 1, tree.parts.end(), has);
  }
  if (is_moved) around.erase(around.begin());
  return result;
}

/// Calls ask(direction) for directions all around, none of which is along what people write.
template <class Ask>
void for_directions(const Ask& ask) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        ask(Vec3(x + 0.011 * y + 0.003, y + 0.013 * z + 0.005, z + 0.017 * x + 0.007));
      }
    }
  }
}

bool is_in_tree(const SolidTree& tree, const Asked& asked) {
  std::vector<Transform> around;
  return is_in(tree, asked, around);
}

}  // namespace

bool PointOracle::is_inside(const Vec3& point, const Vec3& direction) const {
  return is_in_tree(tree_, {point, direction});
}

PointSide PointOracle::side(const Vec3& point) const {
  const Asked asked{point, {0.31, 0.83, -0.47}};
  const bool first = is_in_tree(tree_, asked);
  bool differs = false;
  if (asked.is_on_leaf)
    for_directions([&](const Vec3& way) { differs = differs || is_inside(point, way) != first; });
  if (differs) return PointSide::on;
  return first ? PointSide::inside : PointSide::outside;
}

bool PointOracle::is_near(const Vec3& point, PointSide side, double distance) const {
  bool found = false;
  for_directions(
      [&](const Vec3& way) { found = found || this->side(point + distance * way) == side; });
  return found;
}

}  // namespace crt::truth
