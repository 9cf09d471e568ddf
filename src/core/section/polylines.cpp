// Contours of sections are cut into chords, in the world.
#include <algorithm>
#include <cmath>

#include "core/section/contour_arcs.hpp"
#include "crt/elementary.hpp"
#include "crt/section.hpp"

namespace crt {

namespace core {

namespace {

/// Returns how many chords an arc is cut into, so that they are within a deviation of it.
std::size_t chord_count(const ContourPiece& piece, double deviation) {
  if (!piece.is_arc()) return 1;
  constexpr double most_of_half_circle = 1 << 12;
  const double angle = std::abs(piece.angle());
  const double ratio = deviation / piece.radius();
  // The sagitta of an angle a is 1 - cos(a / 2), and a is at most half a turn.
  const double half = ratio < 1 ? elementary::acos(1 - ratio) : 1;
  const double count = std::ceil(angle / std::clamp(2 * half, 1e-4, 1.0));
  return static_cast<std::size_t>(std::clamp(count, 1.0, 2 * most_of_half_circle));
}

}  // namespace

}  // namespace core

std::vector<SectionPolyline> section_polylines(const Section& section, double deviation) {
  const bool has_own = deviation > 0 && std::isfinite(deviation);
  const double wanted = has_own ? deviation : section.deviation;
  std::vector<SectionPolyline> lines;
  lines.reserve(section.contours.size());
  for (const Contour& contour : section.contours) {
    SectionPolyline& line = lines.emplace_back();
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const core::ContourPiece piece = core::piece_of(contour, i);
      const std::size_t count = core::chord_count(piece, wanted);
      for (std::size_t k = 0; k < count; ++k) {
        const core::PlanePoint p = piece.at(static_cast<double>(k) / static_cast<double>(count));
        line.push_back(section.frame.at(p.x, p.y));
      }
    }
  }
  return lines;
}

}  // namespace crt
