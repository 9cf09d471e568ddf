#include "core/contours/winding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crt/error.hpp"

namespace crt::core {

void Budget::spend(std::uint64_t steps) {
  if (steps > left_) {
    throw Error(ErrorCode::limit,
                "the contours have too many pieces near each other for the nonzero rule: use the "
                "even-odd rule, or draw them as several");
  }
  left_ -= steps;
  unreported_ += steps;
  constexpr std::uint64_t steps_a_report = 1 << 20;
  if (unreported_ >= steps_a_report) report();
}

void Budget::report() {
  if (work_) work_(unreported_);
  unreported_ = 0;
}

WindingIndex::WindingIndex(std::span<const PlanePiece> pieces, Budget& budget)
    : pieces_(pieces), budget_(budget) {
  double highest = -std::numeric_limits<double>::infinity();
  lowest_ = -highest;
  for (const PlanePiece& piece : pieces) {
    lowest_ = std::min(lowest_, piece.lower().y);
    highest = std::max(highest, piece.upper().y);
  }
  const double bands = std::ceil(4 * std::sqrt(static_cast<double>(pieces.size())));
  bands_.resize(static_cast<std::size_t>(bands));
  bands_per_unit_ = highest > lowest_ ? bands / (highest - lowest_) : 0;
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const std::size_t last = band_of(pieces[i].upper().y);
    const std::size_t first = band_of(pieces[i].lower().y);
    constexpr std::size_t steps_per_entry = 64;  // so that the memory is bounded as well
    budget_.spend(steps_per_entry * (1 + last - first));
    for (std::size_t band = first; band <= last; ++band) bands_[band].push_back(i);
  }
}

std::size_t WindingIndex::band_of(double y) const {
  const double last = static_cast<double>(bands_.size() - 1);
  return static_cast<std::size_t>(std::clamp((y - lowest_) * bands_per_unit_, 0.0, last));
}

int WindingIndex::winding_of(const Vec2& point) const {
  int winding = 0;
  const std::vector<std::uint32_t>& band = bands_[band_of(point.y)];
  budget_.spend(band.size());
  for (const std::uint32_t i : band) {
    winding += pieces_[i].winding_of_chord(point) + pieces_[i].winding_of_segment(point);
  }
  return winding;
}

}  // namespace crt::core
