#include "core/geometry/implicit/profile_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/profile/profile.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Holds the rounding of a few operations.
constexpr double few_roundings = 0x1p-49;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "profile: " + message, "profile");
}

Interval widened(double lo, double hi) {
  return {std::max(-1.0, lo - few_roundings), std::min(1.0, hi + few_roundings)};
}

Interval common(const Interval& a, const Interval& b) {
  const Interval both{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  return both.lo <= both.hi ? both : a;
}

/// Returns the direction in which a piece goes at a point of it.
Vec2 direction_at(const PlanePiece& piece, const Vec2& point) {
  return quarter_turned(piece.normal_at(point));
}

}  // namespace

/// Returns the directions on the shorter way from one to another.
ProfileDistance::Directions ProfileDistance::between(const Vec2& a, const Vec2& b) {
  Directions result{widened(std::min(a.x, b.x), std::max(a.x, b.x)),
                    widened(std::min(a.y, b.y), std::max(a.y, b.y))};
  const double turn = cross(a, b);
  const auto is_between = [&](const Vec2& axis) {
    return turn >= 0 ? cross(a, axis) >= 0 && cross(axis, b) >= 0
                     : cross(a, axis) <= 0 && cross(axis, b) <= 0;
  };
  // Of opposite directions any may be between.
  const bool is_opposite = dot(a, b) < 0 && std::abs(turn) < few_roundings;
  for (const double sign : {-1.0, 1.0}) {
    if (is_opposite || (is_between({sign, 0}) && dot(a + b, Vec2(sign, 0)) > 0))
      result.x = hull(result.x, Interval::of(sign));
    if (is_opposite || (is_between({0, sign}) && dot(a + b, Vec2(0, sign)) > 0))
      result.y = hull(result.y, Interval::of(sign));
  }
  return result;
}

ProfileDistance::ProfileDistance(std::shared_ptr<const Profile> profile)
    : profile_(std::move(profile)) {
  const Bounds& box = profile_->bounds();
  origin_ = {box.lower.x, box.lower.y};
  unit_ = power_of_two_below(std::max(box.upper.x - box.lower.x, box.upper.y - box.lower.y));
  for (const Contour& contour : profile_->contours()) add_contour(contour);
  check_apart();
  const double magnitude = std::max({std::abs(box.lower.x), std::abs(box.lower.y),
                                     std::abs(box.upper.x), std::abs(box.upper.y)}) /
                           unit_;
  double largest = 2 + magnitude;
  for (Wall& wall : walls_) {
    largest = std::max(largest, 4 * wall.radius);
    // Which side is outside shows next to the middle.
    constexpr double beside = 0x1p-24;
    const Vec2 middle = wall.piece.middle();
    const Vec2 step = beside * wall.length * wall.piece.normal_at(middle);
    wall.is_outward = is_inside(middle - step);
    if (wall.is_outward == is_inside(middle + step)) refuse("contours must not touch one another");
  }
  error_ = few_roundings * largest;
  std::size_t first = 0;
  for (const Contour& contour : profile_->contours()) {
    const std::size_t end = first + corners_of(contour).kept.size();
    finish_contour(first, end);
    first = end;
  }
}

void ProfileDistance::add_contour(const Contour& contour) {
  const ContourCorners corners = corners_of(contour);
  const std::size_t count = corners.kept.size();
  if (walls_.size() + count > max_pieces)
    refuse(text::format("a field's profile has at most {} pieces", max_pieces));
  const auto place = [&](std::size_t i) {
    const ProfilePoint& corner = contour[corners.kept[i % count]];
    return Vec2((corner.x - origin_.x) / unit_, (corner.y - origin_.y) / unit_);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double bulge = contour[i + 1 < count ? corners.kept[i + 1] : corners.closing].bulge;
    const Vec2 from = place(i);
    const Vec2 to = place(i + 1);
    Wall wall{.piece = PlanePiece(from, to, bulge)};
    wall.length = glm::length(to - from);
    wall.along = (to - from) / wall.length;
    if (bulge != 0) {
      wall.center =
          wall.piece.middle() + (1 + bulge * bulge) / (4 * bulge) * quarter_turned(to - from);
      wall.radius = wall.length * (1 + bulge * bulge) / (4 * std::abs(bulge));
    }
    walls_.push_back(wall);
  }
}

/// Finds the normals of the walls of a contour and of the corners between them.
void ProfileDistance::finish_contour(std::size_t first, std::size_t end) {
  for (std::size_t i = first; i < end; ++i) {
    Wall& wall = walls_[i];
    const Wall& next = walls_[i + 1 < end ? i + 1 : first];
    const double sign = wall.is_outward ? 1 : -1;
    const Vec2 begin_normal = sign * wall.piece.normal_at(wall.piece.from());
    const Vec2 middle_normal = sign * wall.piece.normal_at(wall.piece.middle());
    const Vec2 end_normal = sign * wall.piece.normal_at(wall.piece.to());
    const Directions before = between(begin_normal, middle_normal);
    const Directions after = between(middle_normal, end_normal);
    wall.normals = {hull(before.x, after.x), hull(before.y, after.y)};
    wall.end_direction = direction_at(wall.piece, wall.piece.to());
    wall.next_direction = direction_at(next.piece, next.piece.from());
    const Vec2 next_normal = sign * next.piece.normal_at(next.piece.from());
    constexpr double smooth = 0x1p-44;
    wall.is_smooth =
        dot(end_normal, next_normal) > 0 && std::abs(cross(end_normal, next_normal)) < smooth;
    wall.corner_normals = between(end_normal, next_normal);
  }
}

void ProfileDistance::check_apart() const {
  constexpr double tolerance = 0x1p-40;
  const auto overlap = [](const PlanePiece& a, const PlanePiece& b) {
    return a.lower().x <= b.upper().x && b.lower().x <= a.upper().x && a.lower().y <= b.upper().y &&
           b.lower().y <= a.upper().y;
  };
  for (std::size_t i = 0; i < walls_.size(); ++i) {
    for (std::size_t k = i + 1; k < walls_.size(); ++k) {
      const PlanePiece& a = walls_[i].piece;
      const PlanePiece& b = walls_[k].piece;
      if (!overlap(a, b)) continue;
      for (const Vec2& point : common_points(a, b, tolerance)) {
        const auto is_at = [&](const Vec2& end) {
          return glm::length(point - end) <= 4 * tolerance;
        };
        const bool is_corner =
            (is_at(a.to()) && is_at(b.from())) || (is_at(b.to()) && is_at(a.from()));
        if (!is_corner) refuse("contours must not cross or touch one another");
      }
    }
  }
}

bool ProfileDistance::is_inside(const Vec2& point) const {
  int winding = 0;
  for (const Wall& wall : walls_)
    winding += wall.piece.winding_of_chord(point) + wall.piece.winding_of_segment(point);
  return winding % 2 != 0;
}

double ProfileDistance::Wall::distance_to(const Vec2& point) const {
  const auto to_ends = [&] {
    return std::sqrt(std::min(dot(point - piece.from(), point - piece.from()),
                              dot(point - piece.to(), point - piece.to())));
  };
  if (radius == 0) {
    const Vec2 offset = point - piece.from();
    const double place = dot(offset, along);
    return place >= 0 && place <= length ? std::abs(cross(along, offset)) : to_ends();
  }
  // The circle's point that is next to this one is on the arc if it is beyond the chord.
  const Vec2 offset = point - center;
  const double away = glm::length(offset);
  if (away == 0) return radius;
  const Vec2 foot = center + radius / away * offset;
  const double beyond = cross(along, foot - piece.from());
  return (piece.bulge() > 0 ? beyond <= 0 : beyond >= 0) ? std::abs(away - radius) : to_ends();
}

/// Returns the slopes at points of a box, in the middle of which is a point, that are nearest to a
/// wall or to the corner at its end.
ProfileDistance::Directions ProfileDistance::slopes_near(const Wall& wall, const Vec2& point,
                                                         const Vec2& reach) const {
  Directions result = wall.normals;
  if (wall.radius > 0) {
    const Interval x{point.x - wall.center.x - reach.x, point.x - wall.center.x + reach.x};
    const Interval y{point.y - wall.center.y - reach.y, point.y - wall.center.y + reach.y};
    const Interval squares = square(x) + square(y);
    if (squares.lo > 0) {
      // The normal points away from the center if that is within the region.
      const bool is_away = wall.is_outward == (wall.piece.bulge() > 0);
      const Interval sign = Interval::of(is_away ? 1 : -1);
      const Interval size = square_root(squares);
      const auto direction = [&](const Interval& along) {
        const Interval share = sign * along / size;
        return widened(share.lo, share.hi);
      };
      result = {common(result.x, direction(x)), common(result.y, direction(y))};
    }
  }
  if (wall.is_smooth) return result;
  const auto reach_along = [&](const Vec2& direction) {
    return std::abs(direction.x) * reach.x + std::abs(direction.y) * reach.y + error_;
  };
  const Vec2 offset = point - wall.piece.to();
  const bool may_be_nearest = dot(offset, wall.end_direction) >= -reach_along(wall.end_direction) &&
                              dot(offset, wall.next_direction) <= reach_along(wall.next_direction);
  if (!may_be_nearest) return result;
  return {hull(result.x, wall.corner_normals.x), hull(result.y, wall.corner_normals.y)};
}

ProfileDistance::Values ProfileDistance::evaluate(const std::array<Interval, 2>& middle,
                                                  const std::array<Interval, 2>& box) const {
  const std::array<double, 2> origin = {origin_.x, origin_.y};
  Vec2 point(0, 0);
  Vec2 narrow(0, 0);  // how far the middle reaches
  Vec2 reach(0, 0);   // and the box
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const int i = static_cast<int>(axis);
    const double place = middle[axis].middle();
    const auto size = [&](const Interval& of) {
      return (1 + few_roundings) * std::max(of.hi - place, place - of.lo) / unit_;
    };
    point[i] = (place - origin[axis]) / unit_;
    narrow[i] = size(middle[axis]);
    reach[i] = size(box[axis]);
  }
  constexpr double far = 0x1p100;
  if (!(std::abs(point.x) + std::abs(point.y) + reach.x + reach.y < far))
    return {Interval::everything(), Interval::everything(), {-1, 1}, {-1, 1}};
  const double error = error_ + few_roundings * (std::abs(point.x) + std::abs(point.y));
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) nearest = std::min(nearest, wall.distance_to(point));
  const double radius = glm::length(reach) + error;
  const double farthest = (1 + few_roundings) * (nearest + 2 * radius + 2 * error);
  constexpr double none = 2;
  Directions slopes{{none, -none}, {none, -none}};
  for (const Wall& wall : walls_) {
    if (!(wall.distance_to(point) <= farthest)) continue;
    const Directions here = slopes_near(wall, point, reach);
    slopes = {hull(slopes.x, here.x), hull(slopes.y, here.y)};
  }
  const double distance = is_inside(point) ? -nearest : nearest;
  const auto within = [&](const Vec2& reached) {
    const double change =
        (1 + few_roundings) * std::min(glm::length(reached), slopes.x.magnitude() * reached.x +
                                                                 slopes.y.magnitude() * reached.y) +
        error;
    return Interval{unit_ * (distance - change), unit_ * (distance + change)};
  };
  return {within(narrow), within(reach), slopes.x, slopes.y};
}

std::size_t ProfileDistance::bytes() const {
  return sizeof *this + walls_.capacity() * sizeof(Wall) + profile_->bytes();
}

}  // namespace crt::core
