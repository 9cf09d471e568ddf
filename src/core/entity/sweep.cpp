// A sweep is the union of extrusions along the lines of its path and of revolutions in its bends.
// Each reaches beyond its ends, and is cut by the plane between it and the next one. As the same
// plane cuts both, there is neither a gap nor a wall between them, whatever rounding does.
// Tests: tests/csg/sweep_test.cpp
#include "crt/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "core/entity/path.hpp"
#include "core/entity/placed.hpp"
#include "core/geometry/check_fields.hpp"
#include "core/geometry/profile_contours.hpp"
#include "core/math/vector.hpp"
#include "crt/elementary.hpp"
#include "crt/schema_primitives.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

namespace {

/// A Corner is where one line of a path goes over into the next.
struct Corner {
  Vec3 place{0, 0, 0};
  Vec3 axis{0, 0, 1};     ///< about which the path turns counterclockwise
  Vec3 inwards{1, 0, 0};  ///< across the line before, to where it turns
  double cosine = 1;
  double sine = 0;
  double room = 0;  ///< what the bend takes of both lines
  bool has_bend = false;
  /// The planes between what comes before, the bend, and what comes after. Without a bend both are
  /// one.
  Plane before{};
  Plane after{};

  double angle() const { return elementary::atan2(sine, cosine); }
  double tangent_of_half() const { return sine / (1 + cosine); }
  Vec3 turned(const Vec3& way) const {
    return way * cosine + glm::cross(axis, way) * sine +
           axis * (glm::dot(axis, way) * (1 - cosine));
  }
};

/// A Frame has the axes of the profile on a line of the path.
struct Frame {
  Vec3 x;
  Vec3 y;
  Vec3 along;
};

/// Multiples of a quarter of a turn, which rounding has put beside them, count as just that.
double without_rounding(double share) {
  constexpr double rounding = 0x1p-48;
  const double whole = std::round(share);
  return std::abs(share - whole) <= rounding ? whole : share;
}

class SweptPath {
 public:
  explicit SweptPath(const Sweep& sweep) : sweep_(sweep) {
    check();
    find_lines();
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (sweep_.closed || i > 0) corners_[i] = corner_before(i);
    }
    reach_ = reach_of_profile();
  }

  Entity solid() {
    Frame frame = first_frame();
    const Frame first = frame;
    std::vector<Entity> parts;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (i > 0) {
        add_bend(i, frame, parts);
        frame = turned(frame, corners_[i], lines_[i]);
      }
      add_line(i, frame, parts);
    }
    if (sweep_.closed) {
      add_bend(0, frame, parts);
      check_return(turned(frame, corners_[0], lines_[0]), first);
    }
    return csg_union(parts);
  }

 private:
  void check() const {
    check_fields(sweep_);
    check_path(sweep_.path, sweep_.closed);
    if (sweep_.bend == 0) return;
    std::size_t corners = 0;
    for (const Contour& contour : contours_of(*sweep_.profile)) corners += contour.size();
    constexpr std::size_t most_corners = std::size_t{1} << 20;
    check_count("the bends have", "corners of profiles", corners * sweep_.path.size(),
                most_corners);
  }

  const Vec3& point(std::size_t i) const { return sweep_.path[i % sweep_.path.size()]; }

  void find_lines() {
    const std::size_t count = sweep_.path.size() - (sweep_.closed ? 0 : 1);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 way = point(i + 1) - point(i);
      const double size = largest_component(way);
      lines_.push_back(glm::normalize(way / size));
      lengths_.push_back(size * glm::length(way / size));
    }
    corners_.resize(count);
  }

  /// Returns the corner at the beginning of a line.
  Corner corner_before(std::size_t i) const {
    const Vec3& before = lines_[(i + lines_.size() - 1) % lines_.size()];
    const Vec3& after = lines_[i];
    const Vec3 across = glm::cross(before, after);
    Corner corner{.place = point(i), .cosine = glm::dot(before, after)};
    corner.sine = glm::length(across);
    constexpr double of_180_degrees = 0.0017;  // as a sine, to 0.1 degrees
    if (corner.cosine < 0 && corner.sine < of_180_degrees)
      reject("path", text::format("turns straight back at point {}", i));
    constexpr double straight = 0x1p-40;
    const Vec3 halfway = glm::normalize(before + after);
    corner.before = {.normal = halfway, .position = corner.place};
    corner.after = {.normal = -halfway, .position = corner.place};
    if (corner.sine <= straight) return corner;
    corner.axis = across / corner.sine;
    corner.inwards = glm::cross(corner.axis, before);
    corner.has_bend = sweep_.bend > 0;
    if (!corner.has_bend) return corner;
    corner.room = sweep_.bend * corner.tangent_of_half();
    corner.before = {.normal = before, .position = corner.place - corner.room * before};
    corner.after = {.normal = -after, .position = corner.place + corner.room * after};
    return corner;
  }

  double reach_of_profile() const {
    const Bounds& bounds = bounds_of(*sweep_.profile);
    double reach = 0;
    for (const double x : {bounds.lower.x, bounds.upper.x})
      for (const double y : {bounds.lower.y, bounds.upper.y})
        reach = std::max(reach, elementary::hypot(x, y));
    return reach;
  }

  Frame first_frame() const {
    const Vec3& along = lines_[0];
    const auto across = [&](const Vec3& way) { return way - glm::dot(way, along) * along; };
    constexpr double least = 0x1p-20;
    Vec3 y = across(sweep_.up / largest_component(sweep_.up));
    if (!(glm::length(y) > least)) y = across({0, 0, 1});
    if (!(glm::length(y) > least)) y = across({1, 0, 0});
    y = glm::normalize(y);
    return {glm::cross(y, along), y, along};
  }
  static Frame turned(const Frame& frame, const Corner& corner, const Vec3& along) {
    // What rounding does to one axis the others follow.
    Vec3 y = corner.turned(frame.y);
    y = glm::normalize(y - glm::dot(y, along) * along);
    return {glm::cross(y, along), y, along};
  }

  bool has_corner(std::size_t i) const { return sweep_.closed || (i > 0 && i < lines_.size()); }
  const Corner& corner(std::size_t i) const { return corners_[i % lines_.size()]; }

  void add_line(std::size_t i, const Frame& frame, std::vector<Entity>& parts) {
    const bool has_before = has_corner(i);
    const bool has_after = has_corner(i + 1);
    const double from = has_before ? corner(i).room : 0;
    const double to = lengths_[i] - (has_after ? corner(i + 1).room : 0);
    check_room(i, frame, from, to);
    // Where two bends meet there is no line between them.
    constexpr double rounding = 0x1p-40;
    if (to - from <= rounding * lengths_[i]) return join_bends(i);
    // A mitre reaches farther on its outer side.
    const auto beyond = [&](bool has, std::size_t number) {
      if (!has) return 0.0;
      const Corner& at = corner(number);
      return at.has_bend ? 0.25 * sweep_.bend : (1.125 * at.tangent_of_half() + 0.125) * reach_;
    };
    Entity part = placed(Extrusion{.profile = sweep_.profile,
                                   .from = from - beyond(has_before, i),
                                   .to = to + beyond(has_after, i + 1)},
                         frame.x, frame.y, frame.along, point(i));
    if (has_before) part = part ^ Entity(corner(i).after);
    if (has_after) part = part ^ Entity(corner(i + 1).before);
    parts.push_back(std::move(part));
  }
  /// Lets the bend before a line end where the one after it begins.
  void join_bends(std::size_t i) {
    corners_[(i + 1) % lines_.size()].before = {.normal = -corner(i).after.normal,
                                                .position = corner(i).after.position};
  }

  /// Checks that a line is long enough for the profile to turn at both of its ends.
  void check_room(std::size_t i, const Frame& frame, double from, double to) const {
    const Bounds& bounds = bounds_of(*sweep_.profile);
    // Returns how far along the line a mitre's plane is at a place of the profile.
    const auto at_mitre = [&](std::size_t number, const Vec3& offset) {
      if (!has_corner(number) || corner(number).has_bend) return 0.0;
      const Vec3& normal = corner(number).before.normal;
      return -glm::dot(offset, normal) / glm::dot(frame.along, normal);
    };
    constexpr double rounding = 0x1p-40;
    for (const double x : {bounds.lower.x, bounds.upper.x}) {
      for (const double y : {bounds.lower.y, bounds.upper.y}) {
        const Vec3 offset = x * frame.x + y * frame.y;
        const double first = from + at_mitre(i, offset);
        const double last = to + at_mitre(i + 1, offset);
        if (last - first >= -rounding * lengths_[i]) continue;
        reject("path", text::format("has too little room to turn between points {} and {}", i,
                                    (i + 1) % sweep_.path.size()));
      }
    }
  }

  /// Adds the bend at the beginning of a line. The frame is that of the line before.
  void add_bend(std::size_t i, const Frame& frame, std::vector<Entity>& parts) {
    const Corner& at = corners_[i];
    if (!at.has_bend) return;
    // The revolution starts along its z, and turns towards its x.
    // Its own ends are well beyond the planes, so that few cells of measures have both.
    const double beyond = 0.25 * (std::numbers::pi - at.angle());
    const Vec3 start =
        -at.inwards * elementary::cos(beyond) - frame.along * elementary::sin(beyond);
    const Vec3 onwards =
        frame.along * elementary::cos(beyond) - at.inwards * elementary::sin(beyond);
    const Vec3 middle = at.before.position + sweep_.bend * at.inwards;
    Entity part =
        placed(Revolution{.profile = turning(i, frame, at), .angle = at.angle() + 2 * beyond},
               onwards, at.axis, start, middle);
    part = part ^ Entity(Plane{.normal = -at.before.normal, .position = at.before.position});
    part = part ^ Entity(Plane{.normal = -at.after.normal, .position = at.after.position});
    parts.push_back(std::move(part));
  }

  /// Returns the profile as the axis of a bend sees it.
  std::shared_ptr<const Profile> turning(std::size_t i, const Frame& frame,
                                         const Corner& at) const {
    const double xx = without_rounding(-glm::dot(frame.x, at.inwards));
    const double xy = without_rounding(-glm::dot(frame.y, at.inwards));
    const double yx = without_rounding(glm::dot(frame.x, at.axis));
    const double yy = without_rounding(glm::dot(frame.y, at.axis));
    std::vector<Contour> contours = contours_of(*sweep_.profile);
    for (Contour& contour : contours) {
      for (ProfilePoint& corner : contour) {
        // It is seen from behind.
        corner = {.x = sweep_.bend + xx * corner.x + xy * corner.y,
                  .y = yx * corner.x + yy * corner.y,
                  .bulge = -corner.bulge};
      }
    }
    std::shared_ptr<const Profile> profile = make_profile(contours);
    if (bounds_of(*profile).lower.x < 0)
      reject("bend",
             text::format("must be as large as the profile reaches inwards at point {}", i));
    return profile;
  }

  static void check_return(const Frame& last, const Frame& first) {
    constexpr double rounding = 0x1p-30;
    const double sine = glm::dot(last.x, first.y);
    const double cosine = glm::dot(last.x, first.x);
    if (cosine > 0 && std::abs(sine) <= rounding) return;
    constexpr double degrees = 180 / std::numbers::pi;
    reject("path", text::format(
                       "must be flat if it is closed: this one turns its profile by {:.3g} degrees",
                       elementary::atan2(sine, cosine) * degrees));
  }

  const Sweep& sweep_;
  std::vector<Vec3> lines_;      ///< the direction from each point to the next
  std::vector<double> lengths_;  ///< and how far it is
  std::vector<Corner> corners_;  ///< at the beginning of each line
  double reach_ = 0;             ///< how far the profile reaches from the path
};

}  // namespace

}  // namespace core

Sweep::operator Entity() const {
  const Entity solid = core::SweptPath(*this).solid();
  return material ? solid.with_material(*material) : solid;
}

}  // namespace crt
