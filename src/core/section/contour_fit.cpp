#include "core/section/contour_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/section/circle_fit.hpp"
#include "core/section/contour_arcs.hpp"
#include "core/section/outline_edges.hpp"
#include "crt/elementary.hpp"

namespace crt::core {

namespace {

/// A corner that turns by more is kept.
constexpr double plain_turn = 0.2;

/// Returns how far a point is from the line through the ends of a piece.
double distance_from_chord(const ContourPiece& piece, const PlanePoint& point) {
  const double x = piece.to.x - piece.from.x;
  const double y = piece.to.y - piece.from.y;
  const double turn = x * (point.y - piece.from.y) - y * (point.x - piece.from.x);
  return std::abs(turn) / distance_between(piece.from, piece.to);
}

/// A TangentJoint is where two lines or arcs touch, of which the one is to continue the other.
class TangentJoint {
 public:
  TangentJoint(const ContourPiece& before, const ContourPiece& after)
      : before_(before), after_(after) {}

  /// Returns the point, if there is one next to a piece between the two.
  std::optional<PlanePoint> place(const ContourPiece& gap, double tolerance) const {
    const double length = distance_between(gap.from, gap.to);
    for (const PlanePoint& p : candidates()) {
      const bool touch = off(before_, p) <= tolerance && off(after_, p) <= tolerance;
      const bool is_between =
          distance_between(p, gap.from) <= length && distance_between(p, gap.to) <= length;
      if (touch && is_between) return p;
    }
    return {};
  }
  double bulge_to(const PlanePoint& place, const PlanePoint& from) const {
    return bulge_of(before_, from, place);
  }
  double bulge_from(const PlanePoint& place, const PlanePoint& to) const {
    return bulge_of(after_, place, to);
  }

 private:
  std::vector<PlanePoint> candidates() const {
    if (!before_.is_arc() && !after_.is_arc()) return {};
    if (before_.is_arc() && after_.is_arc()) {
      const PlanePoint center = before_.center();
      const PlanePoint other = after_.center();
      const double share = before_.radius() / distance_between(center, other);
      const double x = share * (other.x - center.x);
      const double y = share * (other.y - center.y);
      return {{center.x + x, center.y + y}, {center.x - x, center.y - y}};
    }
    const ContourPiece& line = before_.is_arc() ? after_ : before_;
    const PlanePoint center = (before_.is_arc() ? before_ : after_).center();
    const double x = line.to.x - line.from.x;
    const double y = line.to.y - line.from.y;
    const double share =
        ((center.x - line.from.x) * x + (center.y - line.from.y) * y) / (x * x + y * y);
    return {{line.from.x + share * x, line.from.y + share * y}};
  }
  /// Returns how far a point is from the whole line or circle of a piece.
  static double off(const ContourPiece& piece, const PlanePoint& point) {
    return piece.is_arc() ? std::abs(distance_between(point, piece.center()) - piece.radius())
                          : distance_from_chord(piece, point);
  }
  /// Returns the bulge of a small part of a piece's circle.
  static double bulge_of(const ContourPiece& piece, const PlanePoint& from,
                         const PlanePoint& to) {
    if (!piece.is_arc()) return 0;
    const double half = 0.5 * distance_between(from, to);
    const double radius = piece.radius();
    const double height = std::sqrt(std::max(0.0, radius * radius - half * half));
    return std::copysign(half / (radius + height), piece.bulge);
  }

  ContourPiece before_;
  ContourPiece after_;
};

class ContourFit {
 public:
  ContourFit(const OutlineLoop& loop, double tolerance, double smallest)
      : tolerance_(tolerance), exact_(std::min(tolerance, smallest)), smallest_(smallest) {
    drop_tiny(loop);
  }

  FittedContour run() {
    if (points_.size() < 2) return {};
    const bool has_corner = begin_at_corner();
    if (std::optional<FittedContour> circle = whole_circle(has_corner)) return finished(*circle);
    find_segments();
    if (!has_corner && segments_.size() > 1) {
      begin_at(segments_.front().last);
      find_segments();
    }
    if (add_joints()) find_segments();
    FittedContour result;
    merge_segments(result);
    return finished(result);
  }

 private:
  /// A Segment is a line or an arc from one point to a later one, to rounding.
  struct Segment {
    std::size_t first = 0;
    std::size_t last = 0;
    FittedArc arc;

    /// An arc of one piece only may be a part of some other curve.
    bool is_sure() const { return arc.bulge == 0 || last > first + 1; }
  };

  /// Returns a point of the line. That after the last one is the first.
  const OutlinePoint& at(std::size_t i) const { return points_[i % points_.size()]; }
  FittedContour finished(FittedContour result) const {
    result.off += off_;
    return result;
  }

  /// Leaves out the beginnings of pieces so short that only rounding made them.
  void drop_tiny(const OutlineLoop& loop) {
    points_.reserve(loop.size());
    const auto is_tiny = [&](const OutlinePoint& a, const OutlinePoint& b) {
      return distance_between(a.place, b.place) <= 0.25 * smallest_;
    };
    for (const OutlinePoint& point : loop) {
      if (!points_.empty() && is_tiny(points_.back(), point)) {
        // The later piece begins where the tiny one did.
        points_.back().surface = point.surface;
        points_.back().bulge = point.bulge;
        off_ = 0.5 * smallest_;
      } else {
        points_.push_back(point);
      }
    }
    while (points_.size() > 1 && is_tiny(points_.back(), points_.front())) {
      points_.pop_back();
      off_ = 0.5 * smallest_;
    }
  }

  /// Returns whether there is a corner: another surface begins, and the line turns.
  bool is_corner(std::size_t i) const {
    const OutlinePoint& before = at(i + points_.size() - 1);
    const OutlinePoint& here = at(i);
    if (before.surface == here.surface) return false;
    const ContourPiece in{before.place, here.place, before.bulge};
    const ContourPiece out{here.place, at(i + 1).place, here.bulge};
    const double ax = in.to.x - in.from.x;
    const double ay = in.to.y - in.from.y;
    const double bx = out.to.x - out.from.x;
    const double by = out.to.y - out.from.y;
    const double between_chords = elementary::atan2(ax * by - ay * bx, ax * bx + ay * by);
    return std::abs(between_chords - 0.5 * in.angle() - 0.5 * out.angle()) > plain_turn;
  }

  /// Makes a point the first.
  void begin_at(std::size_t i) {
    std::rotate(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(i % points_.size()),
                points_.end());
  }
  bool begin_at_corner() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!is_corner(i)) continue;
      begin_at(i);
      return true;
    }
    return false;
  }

  std::optional<FittedContour> whole_circle(bool has_corner) const {
    if (const auto circle = fit_circle(points_, {.points = exact_, .between = tolerance_}))
      return circle;
    if (has_corner) return {};
    return fit_circle(points_, {.points = tolerance_, .between = tolerance_});
  }

  /// Fits one line or arc to the points from one to another.
  std::optional<FittedArc> fit(std::size_t first, std::size_t last,
                               const FitTolerance& tolerance) const {
    std::vector<OutlinePoint> points;
    points.reserve(last - first + 1);
    for (std::size_t i = first; i <= last; ++i) points.push_back(at(i));
    return fit_arc(points, tolerance);
  }
  std::optional<FittedArc> fit_exactly(std::size_t first, std::size_t last) const {
    return fit(first, last, {.points = exact_, .between = std::min(tolerance_, 256 * exact_)});
  }

  /// Returns the largest number up to `most` for which is_fine() holds, if it holds up to there.
  /// It holds for the least.
  template <class IsFine>
  static std::size_t farthest(std::size_t least, std::size_t most, const IsFine& is_fine) {
    std::size_t good = least;
    std::size_t step = 1;
    std::size_t bad = most + 1;
    while (good < most) {
      const std::size_t next = std::min(good + step, most);
      if (!is_fine(next)) {
        bad = next;
        break;
      }
      good = next;
      step *= 2;
    }
    while (good + 1 < bad) {
      const std::size_t middle = good + (bad - good) / 2;
      (is_fine(middle) ? good : bad) = middle;
    }
    return good;
  }

  /// Returns the place of the next corner, or of the end.
  std::size_t next_corner(std::size_t from) const {
    std::size_t i = from + 1;
    while (i < points_.size() && !is_corner(i)) ++i;
    return i;
  }

  void find_segments() {
    segments_.clear();
    std::size_t corner = 0;
    for (std::size_t first = 0; first < points_.size();) {
      if (corner <= first) corner = next_corner(first);
      const std::size_t last = farthest(first + 1, corner, [&](std::size_t end) {
        return fit_exactly(first, end).has_value();
      });
      segments_.push_back({first, last, fit_exactly(first, last).value_or(FittedArc{})});
      first = last;
    }
  }

  ContourPiece piece_of_segment(const Segment& segment) const {
    return {at(segment.first).place, at(segment.last).place, segment.arc.bulge};
  }

  /// A piece between two segments that touch each other there is replaced by what these are up to
  /// where they touch. Returns whether there was one.
  bool add_joints() {
    std::vector<OutlinePoint> joints;
    std::vector<std::size_t> places;
    const std::size_t count = segments_.size();
    for (std::size_t i = 1; i + 1 < count; ++i) {
      const Segment& gap = segments_[i];
      const Segment& before = segments_[i - 1];
      const Segment& after = segments_[i + 1];
      if (gap.last != gap.first + 1 || !before.is_sure() || !after.is_sure()) continue;
      const TangentJoint joint(piece_of_segment(before), piece_of_segment(after));
      const std::optional<PlanePoint> place = joint.place(piece_of_segment(gap), exact_);
      if (!place) continue;
      const ContourPiece whole = piece_of_segment(gap);
      const double first_bulge = joint.bulge_to(*place, whole.from);
      const double last_bulge = joint.bulge_from(*place, whole.to);
      const double off = distance_between(whole.from, whole.to) * std::abs(whole.bulge) +
                         distance_between(whole.from, *place) * std::abs(first_bulge) +
                         distance_between(*place, whole.to) * std::abs(last_bulge) +
                         distance_from_chord(whole, *place);
      if (!(off_ + off <= tolerance_)) continue;
      joints.push_back({.place = *place,
                        .bulge = last_bulge,
                        .surface = at(after.first).surface});
      places.push_back(gap.first);
      points_[gap.first].bulge = first_bulge;
      points_[gap.first].surface = at(before.first).surface;
      joint_off_ = std::max(joint_off_, off);
      ++i;  // what comes next begins there
    }
    for (std::size_t i = joints.size(); i-- > 0;) {
      points_.insert(points_.begin() + static_cast<std::ptrdiff_t>(places[i] + 1), joints[i]);
    }
    off_ += joint_off_;
    return !joints.empty();
  }

  /// Several segments become one line or arc where the tolerance allows it.
  void merge_segments(FittedContour& result) {
    std::vector<double> bulges;
    double off = 0;
    for (std::size_t i = 0; i < segments_.size();) {
      const std::size_t corner = next_corner(segments_[i].first);
      std::size_t most = i;
      while (most + 1 < segments_.size() && segments_[most + 1].last <= corner) ++most;
      const FitTolerance wanted{.points = tolerance_ - off_, .between = tolerance_ - off_};
      const auto fit_to = [&](std::size_t end) {
        return fit(segments_[i].first, segments_[end].last, wanted);
      };
      std::size_t last =
          farthest(i, most, [&](std::size_t end) { return fit_to(end).has_value(); });
      bool are_sure = true;
      for (std::size_t j = i; j <= last; ++j) are_sure = are_sure && segments_[j].is_sure();
      // Lines and arcs that surely are some stay, unless several are spared.
      if (last - i < (are_sure ? 2U : 1U)) last = i;
      const FittedArc arc =
          last == i ? segments_[i].arc : fit_to(last).value_or(segments_[i].arc);
      const PlanePoint& place = at(segments_[i].first).place;
      result.contour.push_back({.x = place.x, .y = place.y, .bulge = 0});
      bulges.push_back(arc.bulge);
      off = std::max(off, arc.off);
      i = last + 1;
    }
    // The bulge of a corner is that of the piece that ends there.
    for (std::size_t i = 0; i < bulges.size(); ++i)
      result.contour[(i + 1) % bulges.size()].bulge = bulges[i];
    result.off = off;
  }

  double tolerance_;
  double exact_;
  double smallest_;
  double off_ = 0;
  double joint_off_ = 0;
  std::vector<OutlinePoint> points_;
  std::vector<Segment> segments_;
};

}  // namespace

FittedContour fit_contour(const OutlineLoop& loop, double tolerance, double smallest) {
  FittedContour result = ContourFit(loop, tolerance, smallest).run();
  const bool encloses = result.contour.size() > 2 ||
                        (result.contour.size() == 2 &&
                         result.contour[0].bulge != -result.contour[1].bulge);
  if (!encloses) result.contour.clear();
  return result;
}

}  // namespace crt::core
