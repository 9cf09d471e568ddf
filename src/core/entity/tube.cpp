// A tube is a chain of balls with cones between them. Where a curve bends little, the cones meet
// without a ball.
// Tests: tests/csg/sweep_test.cpp
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/entity/path.hpp"
#include "core/geometry/check_fields.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "crt/schema_primitives.hpp"
#include "crt/sweep.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

namespace {

/// A Ball is a point of a tube's path.
struct Ball {
  Vec3 center{0, 0, 0};
  double radius = 0;
};

/// A BallCurve is a cubic Bezier curve of balls.
using BallCurve = std::array<Ball, 4>;

Ball mixed(const Ball& a, const Ball& b, double share) {
  return {a.center + share * (b.center - a.center), a.radius + share * (b.radius - a.radius)};
}

Ball at_share(BallCurve curve, double share) {
  for (std::size_t count = curve.size(); count-- > 1;)
    for (std::size_t i = 0; i < count; ++i) curve[i] = mixed(curve[i], curve[i + 1], share);
  return curve[0];
}

class TubePath {
 public:
  explicit TubePath(const Tube& tube) : tube_(tube) { check(); }

  Entity solid() {
    find_balls();
    find_cones();
    find_joints();
    std::vector<Entity> parts;
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      if (joints_[i].has_ball) parts.push_back(ball(i));
      if (i < cones_.size() && cones_[i].is_there) parts.push_back(cone(i));
    }
    if (parts.empty()) reject("radii", "must not all be 0");
    return csg_union(parts);
  }

 private:
  void check() const {
    check_fields(tube_);
    const std::size_t count = tube_.path.size();
    check_path(tube_.path, tube_.closed);
    if (tube_.radii.size() != 1 && tube_.radii.size() != count)
      reject("radii", text::format("must be 1, or as many as there are points: {}, not {}", count,
                                   tube_.radii.size()));
    for (const double radius : tube_.radii) check_number("radii", schema::length_or_zero, radius);
  }

  const Vec3& point(std::size_t i) const { return tube_.path[i % tube_.path.size()]; }
  Ball given(std::size_t i) const {
    return {point(i),
            tube_.radii.size() == 1 ? tube_.radii[0] : tube_.radii[i % tube_.radii.size()]};
  }
  /// Returns a point of the path. Beyond an end that is open it goes on as it was.
  Ball known(std::ptrdiff_t i) const {
    const auto count = static_cast<std::ptrdiff_t>(tube_.path.size());
    if (tube_.closed) return given(static_cast<std::size_t>((i + count) % count));
    if (i < 0) return mixed(given(1), given(0), 2);
    if (i >= count)
      return mixed(given(static_cast<std::size_t>(count - 2)),
                   given(static_cast<std::size_t>(count - 1)), 2);
    return given(static_cast<std::size_t>(i));
  }

  void find_balls() {
    const std::size_t count = tube_.path.size();
    for (std::size_t i = 0; i < count; ++i) {
      balls_.push_back(given(i));
      if (tube_.smooth && (tube_.closed || i + 1 < count)) add_curve(i);
    }
  }
  /// Adds what is between a point and the next: Catmull, Rom, A class of local interpolating
  /// splines, 1974.
  void add_curve(std::size_t i) {
    const auto place = static_cast<std::ptrdiff_t>(i);
    const Ball from = known(place);
    const Ball to = known(place + 1);
    // A third of the slope at a point is a sixth of what is between those beside it.
    const auto beside = [&](const Ball& ball, const Ball& back, const Ball& on) {
      constexpr double share = 1.0 / 6;
      const double radius = ball.radius + share * (on.radius - back.radius);
      return Ball{
          ball.center + share * (on.center - back.center),
          std::clamp(radius, std::min(from.radius, to.radius), std::max(from.radius, to.radius))};
    };
    const BallCurve curve = {from, beside(from, known(place - 1), to),
                             beside(to, known(place + 2), from), to};
    // A chord is off by an eighth of the second derivative at most, and that is six times what the
    // corners bend. Where cones meet without a ball they are off by as much again.
    double bending = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec3 bend = curve[k].center - 2.0 * curve[k + 1].center + curve[k + 2].center;
      const double change = curve[k].radius - 2 * curve[k + 1].radius + curve[k + 2].radius;
      bending = std::max({bending, glm::length(bend), std::abs(change)});
    }
    constexpr double share_of_radius = 1e-3;
    const double largest = *std::max_element(tube_.radii.begin(), tube_.radii.end());
    const double deviation = tube_.deviation > 0 ? tube_.deviation : share_of_radius * largest;
    const double needed = std::sqrt(2 * 6 * bending / (8 * deviation));
    if (!(needed + static_cast<double>(balls_.size()) <= static_cast<double>(most_path_points)))
      throw Error(ErrorCode::limit,
                  text::format("the tube has over {} pieces by its deviation", most_path_points));
    const auto pieces = std::max(std::size_t{1}, static_cast<std::size_t>(std::ceil(needed)));
    for (std::size_t k = 1; k < pieces; ++k)
      balls_.push_back(at_share(curve, static_cast<double>(k) / static_cast<double>(pieces)));
  }

  /// A TouchingCone touches a ball and the next one all around, if neither holds the other.
  struct TouchingCone {
    bool is_there = false;
    Vec3 along{0, 0, 1};
    double length = 0;  ///< from one ball's center to the other's
    double sine = 0;    ///< of the angle by which it gets thinner
    double cosine = 1;

    /// Returns how far beyond the center it touches a ball.
    double beyond(const Ball& ball) const { return ball.radius * sine; }
    double tangent() const { return sine / cosine; }
  };
  void find_cones() {
    cones_.resize(balls_.size() - (tube_.closed ? 0 : 1));
    for (std::size_t i = 0; i < cones_.size(); ++i) {
      const Ball& from = balls_[i];
      const Ball& to = balls_[(i + 1) % balls_.size()];
      const Vec3 way = to.center - from.center;
      const double size = largest_component(way);
      if (size == 0) continue;
      TouchingCone& cone = cones_[i];
      cone.along = glm::normalize(way / size);
      cone.length = size * glm::length(way / size);
      cone.sine = (from.radius - to.radius) / cone.length;
      cone.is_there =
          std::abs(cone.sine) < 1 && std::max(from.radius, to.radius) >= smallest_length;
      cone.cosine = std::sqrt(std::max(0.0, (1 - cone.sine) * (1 + cone.sine)));
    }
  }

  /// A Joint is where a cone goes over into the next. What is on either side of a plane is cut by
  /// it, so that there is neither a gap nor a wall. So a ball is where it alone counts.
  struct Joint {
    bool has_ball = false;
    std::optional<Plane> before{};  ///< the end of the cone before
    std::optional<Plane> after{};   ///< the beginning of the cone after; both may be one
    double reach = 0;               ///< how far along the cones such a plane is at most
  };
  const TouchingCone* cone_before(std::size_t i) const {
    if (i == 0 && !tube_.closed) return nullptr;
    const TouchingCone& cone = cones_[(i + cones_.size() - 1) % cones_.size()];
    return cone.is_there ? &cone : nullptr;
  }
  const TouchingCone* cone_after(std::size_t i) const {
    return i < cones_.size() && cones_[i].is_there ? &cones_[i] : nullptr;
  }
  void find_joints() {
    joints_.resize(balls_.size());
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const TouchingCone* const before = cone_before(i);
      const TouchingCone* const after = cone_after(i);
      if (balls_[i].radius < smallest_length) continue;  // it is the tip of both
      if (before != nullptr && after != nullptr && join_cones(i, *before, *after)) continue;
      Joint& joint = joints_[i];
      joint.has_ball = true;
      const auto touching = [&](const TouchingCone& cone) {
        return Plane{.normal = cone.along,
                     .position = balls_[i].center + cone.beyond(balls_[i]) * cone.along};
      };
      if (before != nullptr) joint.before = touching(*before);
      if (after != nullptr) joint.after = touching(*after);
    }
  }
  /// Lets two cones of a curve that touch one ball meet without it. They meet in a plane then: on
  /// both |x|^2 - r^2 is the square of a.x - s by the cosine, where a is the direction of the cone
  /// and s how far beyond the center it touches the ball.
  bool join_cones(std::size_t i, const TouchingCone& before, const TouchingCone& after) {
    constexpr double of_18_degrees = 0.95;
    const double turn = glm::dot(before.along, after.along);
    if (!tube_.smooth || turn < of_18_degrees) return false;
    const Ball& ball = balls_[i];
    const double half_turn = glm::length(after.along - before.along) / 2;
    const double reach =
        4 * ball.radius * (half_turn + std::abs(before.tangent() - after.tangent()));
    for (const TouchingCone* cone : {&before, &after}) {
      if (reach > 0.5 * cone->length) return false;
      if (std::abs(cone->tangent()) * reach > 0.5 * ball.radius * cone->cosine) return false;
    }
    const Vec3 normal = before.along / before.cosine + after.along / after.cosine;
    const double offset = before.beyond(ball) / before.cosine + after.beyond(ball) / after.cosine;
    const Plane plane{.normal = normal,
                      .position = ball.center + (offset / glm::dot(normal, normal)) * normal};
    joints_[i] = {.before = plane, .after = plane, .reach = reach};
    return true;
  }

  /// Returns what is on the side of a plane to which its normal points.
  static Entity beyond(const Plane& plane) {
    return Plane{.normal = -plane.normal, .position = plane.position};
  }
  Entity ball(std::size_t i) const {
    Entity part = Sphere{.center = balls_[i].center, .radius = balls_[i].radius};
    if (joints_[i].before) part = part ^ beyond(*joints_[i].before);
    if (joints_[i].after) part = part ^ Entity(*joints_[i].after);
    return part;
  }
  Entity cone(std::size_t i) const {
    const TouchingCone& cone = cones_[i];
    const std::size_t next = (i + 1) % balls_.size();
    // Returns how far from an end's center the cone ends, beyond its plane if it has one.
    const auto end_of = [&](std::size_t number, const std::optional<Plane>& plane, double way) {
      const Ball& ball = balls_[number];
      if (!plane) return cone.beyond(ball);
      const double to_tip =
          way * cone.sine > 0 ? ball.radius * cone.cosine / std::abs(cone.tangent()) : cone.length;
      const double reach = joints_[number].has_ball ? std::min(0.125 * cone.length, 0.5 * to_tip)
                                                    : joints_[number].reach + 0x1p-20 * cone.length;
      return cone.beyond(ball) + way * reach;
    };
    const double from = end_of(i, joints_[i].after, -1);
    const double to = end_of(next, joints_[next].before, 1);
    const auto radius_at = [&](const Ball& ball, double place) {
      return std::max(0.0,
                      ball.radius * cone.cosine - (place - cone.beyond(ball)) * cone.tangent());
    };
    Entity part =
        frustum(balls_[i].center + from * cone.along, balls_[next].center + to * cone.along,
                radius_at(balls_[i], from), radius_at(balls_[next], to));
    if (joints_[i].after) part = part ^ beyond(*joints_[i].after);
    if (joints_[next].before) part = part ^ Entity(*joints_[next].before);
    return part;
  }
  static Entity frustum(const Vec3& from, const Vec3& to, double radius, double radius2) {
    if (radius == radius2) return Cylinder{.from = from, .to = to, .radius = radius};
    if (radius >= smallest_length)
      return Cone{.from = from, .to = to, .radius = radius, .radius2 = radius2};
    return Cone{.from = to, .to = from, .radius = radius2};
  }

  const Tube& tube_;
  std::vector<Ball> balls_;
  std::vector<TouchingCone> cones_;  ///< from each ball to the next
  std::vector<Joint> joints_;        ///< at each ball
};

}  // namespace

}  // namespace core

Tube::operator Entity() const {
  const Entity solid = core::TubePath(*this).solid();
  return material ? solid.with_material(*material) : solid;
}

}  // namespace crt
