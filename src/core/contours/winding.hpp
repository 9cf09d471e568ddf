// Winding numbers of points about many pieces.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/geometry/plane_piece.hpp"

namespace crt::core {

/// A Budget ends what would take too long. It counts steps of a few nanoseconds, and reports them
/// to PathOptions::work.
class Budget {
 public:
  using Work = std::function<void(std::uint64_t)>;
  explicit Budget(const Work& work) : work_(work) {}
  /// Throws Error (limit) if there are not so many steps left.
  void spend(std::uint64_t steps);
  /// Reports what has not been reported yet.
  void report();

 private:
  const Work& work_;
  std::uint64_t left_ = std::uint64_t{1} << 31;
  std::uint64_t unreported_ = 0;
};

/// A WindingIndex has the pieces of closed contours by their height.
class WindingIndex {
 public:
  /// The pieces must outlive this.
  WindingIndex(std::span<const PlanePiece> pieces, Budget& budget);

  /// Returns how often the contours go about a point, counterclockwise.
  int winding_of(const Vec2& point) const;

 private:
  std::size_t band_of(double y) const;

  std::span<const PlanePiece> pieces_;
  Budget& budget_;
  double lowest_ = 0;
  double bands_per_unit_ = 0;
  std::vector<std::vector<std::uint32_t>> bands_;
};

}  // namespace crt::core
