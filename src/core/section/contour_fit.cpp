#include "core/section/contour_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/section/boundary_edges.hpp"
#include "core/section/circle_fit.hpp"
#include "core/section/contour_arcs.hpp"
#include "core/section/contour_joints.hpp"
#include "crt/elementary.hpp"

namespace crt::core {

namespace {

/// A corner that turns by more is kept.
constexpr double plain_turn = 0.2;

class ContourFit {
 public:
  ContourFit(const BoundaryLoop& loop, double tolerance, double smallest)
      : tolerance_(tolerance), exact_(std::min(tolerance, smallest)), smallest_(smallest) {
    drop_tiny(loop);
  }

  FittedContour run() {
    if (points_.size() < 2) return {};
    const bool has_corner = begin_at_corner();
    if (std::optional<FittedContour> circle = whole_circle(has_corner)) return finished(*circle);
    find_segments();
    // The first segment may have begun in the midst of a line or an arc, and the last ends there.
    if (!has_corner && segments_.size() > 1) {
      std::size_t longest = 1;
      for (std::size_t i = 2; i + 1 < segments_.size(); ++i) {
        if (piece_of_segment(segments_[i]).chord() > piece_of_segment(segments_[longest]).chord())
          longest = i;
      }
      begin_at(segments_[longest].first);
      find_segments();
    }
    if (add_joints()) find_segments();
    merge_segments();
    // Where two touch, the point of both is known better than by either.
    off_ += tidy_joints(pieces_, exact_, tolerance_ - off_ - off_of_pieces_);
    FittedContour result{.contour = {}, .off = off_of_pieces_};
    result.contour.reserve(pieces_.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      // The bulge of a corner is that of the piece that ends there.
      const FittedPiece& before = pieces_[(i + pieces_.size() - 1) % pieces_.size()];
      const PlanePoint& place = pieces_[i].piece.from;
      result.contour.push_back({.x = place.x, .y = place.y, .bulge = before.piece.bulge});
    }
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
  const BoundaryPoint& at(std::size_t i) const { return points_[i % points_.size()]; }
  FittedContour finished(FittedContour result) const {
    result.off += off_;
    return result;
  }

  /// Leaves out the beginnings of pieces so short that only rounding made them.
  void drop_tiny(const BoundaryLoop& loop) {
    points_.reserve(loop.size());
    const auto is_tiny = [&](const BoundaryPoint& a, const BoundaryPoint& b) {
      return distance_between(a.place, b.place) <= 0.25 * smallest_;
    };
    for (const BoundaryPoint& point : loop) {
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
    const BoundaryPoint& before = at(i + points_.size() - 1);
    const BoundaryPoint& here = at(i);
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
    if (auto circle = fit_circle(points_, {.points = exact_, .between = tolerance_})) return circle;
    if (has_corner) return {};
    return fit_circle(points_, {.points = tolerance_, .between = tolerance_});
  }

  /// Fits one line or arc to the points from one to another.
  std::optional<FittedArc> fit(std::size_t first, std::size_t last,
                               const FitTolerance& tolerance) const {
    std::vector<BoundaryPoint> points;
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
      const std::size_t last = farthest(
          first + 1, corner, [&](std::size_t end) { return fit_exactly(first, end).has_value(); });
      segments_.push_back({first, last, fit_exactly(first, last).value_or(FittedArc{})});
      first = last;
    }
  }

  ContourPiece piece_of_segment(const Segment& segment) const {
    return {at(segment.first).place, at(segment.last).place, segment.arc.bulge};
  }

  /// Takes away what is between segments that touch each other there: these go on up to there.
  /// Returns whether there was any.
  bool add_joints() {
    bool is_any = false;
    bool is_last = false;
    std::vector<BoundaryPoint> points;
    points.reserve(points_.size());
    double most_off = 0;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const Segment& gap = segments_[i];
      std::optional<TangentJoint> joint;
      const Segment& after = segments_[(i + 1) % segments_.size()];
      if (i > 0 && segments_.size() > 2 && segments_[i - 1].is_sure() && after.is_sure() &&
          !is_corner(gap.first) && !is_corner(gap.last)) {
        joint = joint_between(piece_of_segment(segments_[i - 1]), piece_of_segment(gap),
                              piece_of_segment(after), exact_);
      }
      const double off = joint ? joint->off + gap.arc.off : 0;
      if (joint && off_ + off <= tolerance_) {
        points.push_back({.place = at(gap.first).place,
                          .bulge = joint->first_bulge,
                          .surface = at(segments_[i - 1].first).surface});
        points.push_back({.place = joint->place,
                          .bulge = joint->last_bulge,
                          .surface = at(after.first).surface});
        most_off = std::max(most_off, off);
        is_any = true;
        is_last = i + 1 == segments_.size();
      } else {
        for (std::size_t k = gap.first; k < gap.last; ++k) points.push_back(at(k));
      }
    }
    points_ = std::move(points);
    // What follows a joint at the end goes on over the beginning.
    if (is_last) begin_at(points_.size() - 1);
    off_ += most_off;
    return is_any;
  }

  /// Several segments become one line or arc where the tolerance allows it.
  void merge_segments() {
    pieces_.clear();
    const FitTolerance wanted{.points = tolerance_ - off_, .between = tolerance_ - off_};
    for (std::size_t i = 0; i < segments_.size();) {
      const std::size_t corner = next_corner(segments_[i].first);
      std::size_t most = i;
      while (most + 1 < segments_.size() && segments_[most + 1].last <= corner) ++most;
      const auto fit_to = [&](std::size_t end) {
        return fit(segments_[i].first, segments_[end].last, wanted);
      };
      std::size_t last =
          farthest(i, most, [&](std::size_t end) { return fit_to(end).has_value(); });
      bool are_sure = true;
      for (std::size_t j = i; j <= last; ++j) are_sure = are_sure && segments_[j].is_sure();
      // Lines and arcs that surely are some stay, unless several are spared.
      if (last - i < (are_sure ? 2U : 1U)) last = i;
      const FittedArc arc = last == i ? segments_[i].arc : fit_to(last).value_or(segments_[i].arc);
      pieces_.push_back(
          {.piece = {at(segments_[i].first).place, at(segments_[last].last).place, arc.bulge},
           .is_sure = last == i && segments_[i].is_sure(),
           .begins_at_corner = is_corner(segments_[i].first)});
      off_of_pieces_ = std::max(off_of_pieces_, arc.off);
      i = last + 1;
    }
  }

  double tolerance_;
  double exact_;
  double smallest_;
  double off_ = 0;
  double off_of_pieces_ = 0;
  std::vector<BoundaryPoint> points_;
  std::vector<Segment> segments_;
  std::vector<FittedPiece> pieces_;
};

}  // namespace

FittedContour fit_contour(const BoundaryLoop& loop, double tolerance, double smallest) {
  // Something narrow may need more corners than the tolerance does to enclose anything.
  constexpr double less = 1.0 / 8;
  for (double wanted = tolerance;; wanted *= less) {
    FittedContour result = ContourFit(loop, wanted, smallest).run();
    const Contour& contour = result.contour;
    if (contour.size() > 2 || (contour.size() == 2 && contour[0].bulge != -contour[1].bulge))
      return result;
    if (wanted < smallest) return {};
  }
}

}  // namespace crt::core
