#include "core/shading/light_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/base/invalid_index.hpp"
#include "core/math/direction_and_length.hpp"

namespace crt::core {

namespace {

constexpr double half_turn = std::numbers::pi;

double sine_of(double cosine) {
  return std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
}

/// Returns the cosine of an angle less another one, or 1 if the other is larger.
double cosine_of_difference(double cosine, double less_cosine) {
  if (cosine > less_cosine) return 1;
  return cosine * less_cosine + sine_of(cosine) * sine_of(less_cosine);
}

double angle_between(const Vec3& a, const Vec3& b) {
  return elementary::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// Returns a unit vector turned about another one across it.
Vec3 turned(const Vec3& v, const Vec3& about, double angle) {
  return elementary::cos(angle) * v + elementary::sin(angle) * glm::cross(about, v);
}

Vec3 middle(const Bounds& box) {
  return 0.5 * box.lower + 0.5 * box.upper;
}

}  // namespace

LightTree::LightTree(std::span<const PreparedLight> lights)
    : leaves_(lights.size(), invalid_index) {
  std::vector<Member> members;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const LightExtent extent = lights[i].extent();
    if (extent.strength > 0) members.push_back({bounds_of(extent), i});
  }
  if (members.empty()) return;
  nodes_.reserve(2 * members.size() - 1);
  add(members, 0);
}

LightTree::LightBounds LightTree::bounds_of(const LightExtent& extent) {
  LightBounds result{
      .box = extent.bounds, .is_two_sided = extent.is_two_sided, .strength = extent.strength};
  if (extent.axis == Vec3(0)) return result;
  result.axis = extent.axis;
  result.cosine = 1;
  return result;
}

LightTree::LightBounds LightTree::together(const LightBounds& a, const LightBounds& b) {
  LightBounds result{.box = a.box,
                     .is_two_sided = a.is_two_sided || b.is_two_sided,
                     .strength = a.strength + b.strength};
  result.box.include(b.box);
  if (a.cosine <= -1 || b.cosine <= -1) return result;
  const double angle_a = elementary::acos(a.cosine);
  const double angle_b = elementary::acos(b.cosine);
  const double between = angle_between(a.axis, b.axis);
  const auto take = [&result](const LightBounds& whole) {
    result.axis = whole.axis;
    result.cosine = whole.cosine;
    return result;
  };
  if (between + angle_b <= angle_a) return take(a);
  if (between + angle_a <= angle_b) return take(b);
  const double angle = (angle_a + between + angle_b) / 2;
  const Vec3 across = glm::cross(a.axis, b.axis);
  if (angle >= half_turn || across == Vec3(0)) return result;
  result.axis = turned(a.axis, direction_and_length(across).direction, angle - angle_a);
  result.cosine = elementary::cos(angle);
  return result;
}

double LightTree::LightBounds::importance(const LitPoint& point) const {
  const Vec3 from_middle = point.position - middle(box);
  const Vec3 half = 0.5 * (box.upper - box.lower);
  const double squared_radius = glm::dot(half, half);
  const double squared_distance = glm::dot(from_middle, from_middle);
  const double squared = std::max(squared_distance, squared_radius);
  // From within anything may be anywhere.
  if (squared_distance <= squared_radius) return strength / squared;
  const Vec3 direction = (1 / std::sqrt(squared_distance)) * from_middle;
  const double seen_under = std::sqrt(1 - squared_radius / squared_distance);
  double leaving = 1;
  if (cosine > -1) {
    const double along = glm::dot(axis, direction);
    const double beyond_cone = cosine_of_difference(is_two_sided ? std::abs(along) : along, cosine);
    leaving = cosine_of_difference(beyond_cone, seen_under);
  }
  constexpr double error_of_normal = 0x1p-12;
  const double arriving =
      cosine_of_difference(-glm::dot(point.normal, direction), seen_under) + error_of_normal;
  if (leaving <= 0 || arriving <= 0) return 0;
  return strength * leaving * arriving / squared;
}

/// The cost is the strength times the solid angle that is shone into, times the surface of the box.
double LightTree::cost(const LightBounds& bounds, double longest_over_side) {
  const double angle = elementary::acos(bounds.cosine);
  const double reach = std::min(angle + half_turn / 2, half_turn);
  const double sine = elementary::sin(angle);
  const double angles = 2 * half_turn * (1 - bounds.cosine) +
                        half_turn / 2 *
                            (2 * reach * sine - elementary::cos(angle - 2 * reach) -
                             2 * angle * sine + bounds.cosine);
  const Vec3 size = bounds.box.upper - bounds.box.lower;
  const double surface = 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
  return bounds.strength * angles * longest_over_side * surface;
}

LightTree::Split LightTree::best_split(std::span<const Member> members, const Bounds& middles) {
  constexpr std::size_t buckets = 12;
  const Vec3 size = middles.upper - middles.lower;
  const double longest = std::max({size.x, size.y, size.z});
  Split best{.cost = std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(size[axis] > 0)) continue;
    const auto place_of = [&](std::size_t end) {
      return middles.lower[axis] + static_cast<double>(end) / buckets * size[axis];
    };
    std::array<LightBounds, buckets> in_bucket;
    std::array<std::size_t, buckets> counts{};
    for (const Member& member : members) {
      const double place = middle(member.bounds.box)[axis];
      std::size_t bucket = 0;
      while (bucket + 1 < buckets && place >= place_of(bucket + 1)) ++bucket;
      in_bucket[bucket] =
          counts[bucket]++ == 0 ? member.bounds : together(in_bucket[bucket], member.bounds);
    }
    for (std::size_t end = 1; end < buckets; ++end) {
      std::array<LightBounds, 2> sides;
      std::array<std::size_t, 2> side_counts{};
      for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        if (counts[bucket] == 0) continue;
        const std::size_t side = bucket < end ? 0 : 1;
        sides[side] =
            side_counts[side] == 0 ? in_bucket[bucket] : together(sides[side], in_bucket[bucket]);
        side_counts[side] += counts[bucket];
      }
      if (side_counts[0] == 0 || side_counts[1] == 0) continue;
      const double whole =
          cost(sides[0], longest / size[axis]) + cost(sides[1], longest / size[axis]);
      if (whole < best.cost) best = {axis, place_of(end), whole};
    }
  }
  return best;
}

std::uint32_t LightTree::add(std::span<Member> members, std::uint32_t parent) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  Node node{.bounds = members.front().bounds, .parent = parent, .light = members.front().light};
  Bounds middles;
  for (const Member& member : members) {
    node.bounds = &member == members.data() ? member.bounds : together(node.bounds, member.bounds);
    middles.include(middle(member.bounds.box));
  }
  nodes_.push_back(node);
  if (members.size() == 1) {
    leaves_[node.light] = number;
    return number;
  }
  const Split split = best_split(members, middles);
  auto second = members.begin() + static_cast<std::ptrdiff_t>(members.size() / 2);
  if (std::isfinite(split.cost)) {
    second = std::stable_partition(members.begin(), members.end(), [&](const Member& member) {
      return middle(member.bounds.box)[split.axis] < split.place;
    });
  }
  const auto count = static_cast<std::size_t>(second - members.begin());
  add(members.first(count), number);
  const std::uint32_t of_second = add(members.subspan(count), number);
  nodes_[number].second = of_second;
  return number;
}

double LightTree::share_of_first(std::uint32_t node, const LitPoint& point) const {
  const double first = nodes_[node + 1].bounds.importance(point);
  const double second = nodes_[nodes_[node].second].bounds.importance(point);
  return first + second > 0 ? first / (first + second) : -1;
}

LightTree::Choice LightTree::choose(const LitPoint& point, double number) const {
  std::uint32_t node = 0;
  double probability = 1;
  while (nodes_[node].second != 0) {
    const double first = share_of_first(node, point);
    if (first < 0) return {};
    const bool is_first = number < first;
    const double share = is_first ? first : 1 - first;
    number = std::min((is_first ? number : number - first) / share, 1 - 0x1p-53);
    probability *= share;
    node = is_first ? node + 1 : nodes_[node].second;
  }
  return {nodes_[node].light, probability};
}

double LightTree::probability(const LitPoint& point, std::uint32_t light) const {
  std::uint32_t node = leaves_[light];
  if (node == invalid_index) return 0;
  double probability = 1;
  while (node != 0) {
    const std::uint32_t parent = nodes_[node].parent;
    const double first = share_of_first(parent, point);
    if (first < 0) return 0;
    probability *= node == parent + 1 ? first : 1 - first;
    node = parent;
  }
  return probability;
}

std::size_t LightTree::bytes() const {
  return nodes_.capacity() * sizeof(Node) + leaves_.capacity() * sizeof(std::uint32_t);
}

}  // namespace crt::core
