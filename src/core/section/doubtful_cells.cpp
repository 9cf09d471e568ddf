#include "core/section/doubtful_cells.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geometry/bounds.hpp"

namespace crt::core {

namespace {

/// PointBuckets have the points of lines sorted into squares of a grid.
class PointBuckets {
 public:
  explicit PointBuckets(std::span<const BoundaryLoop> loops) {
    for (const BoundaryLoop& loop : loops) {
      for (const BoundaryPoint& point : loop) {
        bounds_.include({point.place.x, point.place.y, 0});
        ++count_;
      }
    }
    const Vec3 size = bounds_.upper - bounds_.lower;
    width_ = std::max({size.x, size.y, std::numeric_limits<double>::min()}) / side;
    first_.assign(std::size_t{side} * side + 1, 0);
    for (const BoundaryLoop& loop : loops)
      for (const BoundaryPoint& point : loop) ++first_[square_of(point.place) + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::size_t> next = first_;
    points_.resize(count_);
    for (const BoundaryLoop& loop : loops)
      for (const BoundaryPoint& point : loop) points_[next[square_of(point.place)]++] = point.place;
  }

  /// Returns the distance of a point from the nearest one.
  double distance(const PlanePoint& from) const {
    const int x = column(from.x - bounds_.lower.x);
    const int y = column(from.y - bounds_.lower.y);
    double least = infinity;
    for (int ring = 0; ring < side; ++ring) {
      // Nothing in the ring is nearer than the ring, for a point in the grid or beside it.
      if (least <= (ring - 1) * width_) break;
      for (int i = std::max(0, x - ring); i <= std::min(side - 1, x + ring); ++i) {
        const bool is_border = i == x - ring || i == x + ring;
        const int step = is_border || ring == 0 ? 1 : 2 * ring;
        for (int j = y - ring; j <= y + ring; j += step)
          if (j >= 0 && j < side) look_into(i, j, from, least);
      }
    }
    return least;
  }

 private:
  static constexpr int side = 256;

  static int clamped(double x) { return static_cast<int>(std::clamp(x, 0.0, side - 1.0)); }
  int column(double from_lower) const { return clamped(from_lower / width_); }
  std::size_t square_of(const PlanePoint& p) const {
    return static_cast<std::size_t>(column(p.x - bounds_.lower.x)) * side +
           static_cast<std::size_t>(column(p.y - bounds_.lower.y));
  }
  void look_into(int x, int y, const PlanePoint& from, double& least) const {
    const std::size_t square = static_cast<std::size_t>(x) * side + static_cast<std::size_t>(y);
    for (std::size_t i = first_[square]; i < first_[square + 1]; ++i) {
      const double dx = points_[i].x - from.x;
      const double dy = points_[i].y - from.y;
      least = std::min(least, std::sqrt(dx * dx + dy * dy));
    }
  }

  Bounds bounds_;
  double width_ = 0;
  std::size_t count_ = 0;
  std::vector<std::size_t> first_;
  std::vector<PlanePoint> points_;
};

}  // namespace

double farthest_doubt(const BoundaryLooks& looks, std::span<const BoundaryCell> cells,
                      std::span<const BoundaryLoop> loops) {
  if (cells.empty()) return 0;
  if (loops.empty()) return infinity;
  const PointBuckets buckets(loops);
  double farthest = 0;
  for (const BoundaryCell& cell : cells) {
    const PlanePoint lower = looks.grid().at(cell.lower);
    const PlanePoint upper = looks.grid().at(cell.upper);
    const PlanePoint middle{0.5 * lower.x + 0.5 * upper.x, 0.5 * lower.y + 0.5 * upper.y};
    farthest = std::max(farthest, buckets.distance(middle) + 0.5 * looks.diagonal(cell));
  }
  return farthest * (1 + 0x1p-40) + looks.grid().rounding();
}

}  // namespace crt::core
