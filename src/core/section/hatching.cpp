#include "core/section/hatching.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "crt/elementary.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

constexpr double most_lines = 1e5;

/// A place is seen in turned axes: how far it is across the lines and along them.
struct Turned {
  double across = 0;
  double along = 0;
};

Turned turned(const PlanePoint& p) {
  const double share = std::numbers::sqrt2 / 2;
  return {share * (p.x - p.y), share * (p.x + p.y)};
}
PlanePoint turned_back(const Turned& p) {
  const double share = std::numbers::sqrt2 / 2;
  return {share * (p.along + p.across), share * (p.along - p.across)};
}

/// A MonotonePart goes from one place to another, always the same way across the lines.
struct MonotonePart {
  Turned from;
  Turned to;
  bool is_arc = false;
  Turned center{};
  double radius = 0;
  double side = 0;  ///< of the center that it is on, along the lines: 1 or -1

  double along_at(double across) const {
    if (is_arc) {
      const double off = across - center.across;
      return center.along + side * std::sqrt(std::max(0.0, radius * radius - off * off));
    }
    const double share = (across - from.across) / (to.across - from.across);
    return from.along + share * (to.along - from.along);
  }
};

void add_parts(const ContourPiece& piece, std::vector<MonotonePart>& parts) {
  const Turned from = turned(piece.from);
  const Turned to = turned(piece.to);
  if (!piece.is_arc()) {
    parts.push_back({.from = from, .to = to});
    return;
  }
  // An arc turns back where it is farthest across.
  const Turned center = turned(piece.center());
  const double radius = piece.radius();
  std::vector<Turned> places = {from};
  const double angle = piece.angle();
  const double begin = elementary::atan2(from.along - center.along, from.across - center.across);
  std::vector<double> shares = {0};
  const int step = angle > 0 ? 1 : -1;
  for (int k = -4 * step; k != 5 * step; k += step) {
    const double share = (k * std::numbers::pi - begin) / angle;
    if (!(share > 0 && share < 1)) continue;
    shares.push_back(share);
    places.push_back({center.across + (k % 2 == 0 ? radius : -radius), center.along});
  }
  shares.push_back(1);
  places.push_back(to);
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double middle = begin + 0.5 * (shares[i] + shares[i + 1]) * angle;
    parts.push_back({.from = places[i],
                     .to = places[i + 1],
                     .is_arc = true,
                     .center = center,
                     .radius = radius,
                     .side = elementary::sin(middle) > 0 ? 1.0 : -1.0});
  }
}

}  // namespace

std::vector<HatchLine> hatching(std::span<const Contour> contours, double distance) {
  std::vector<MonotonePart> parts;
  double least = infinity;
  double most = -infinity;
  for (const Contour& contour : contours) {
    for (std::size_t i = 0; i < contour.size(); ++i) add_parts(piece_of(contour, i), parts);
  }
  for (const MonotonePart& part : parts) {
    least = std::min({least, part.from.across, part.to.across});
    most = std::max({most, part.from.across, part.to.across});
  }
  std::vector<HatchLine> lines;
  if (parts.empty()) return lines;
  const double first = std::ceil(least / distance);
  const double count = std::floor(most / distance) - first + 1;
  if (!(count <= most_lines))
    throw Error(ErrorCode::limit, "there would be more than 100000 hatching lines", "hatch");
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(std::max(0.0, count)));
  for (const MonotonePart& part : parts) {
    const double low = std::min(part.from.across, part.to.across);
    const double high = std::max(part.from.across, part.to.across);
    // A line at an end of a part crosses it, or the next part, or both or none.
    for (double k = std::max(first, std::ceil(low / distance) - 1); k < first + count; ++k) {
      const double across = k * distance;
      if (across >= high) break;
      if (across < low) continue;
      crossings[static_cast<std::size_t>(k - first)].push_back(part.along_at(across));
    }
  }
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    std::vector<double>& line = crossings[i];
    std::sort(line.begin(), line.end());
    const double across = (first + static_cast<double>(i)) * distance;
    for (std::size_t k = 0; k + 1 < line.size(); k += 2) {
      if (!(line[k] < line[k + 1])) continue;
      lines.push_back({turned_back({across, line[k]}), turned_back({across, line[k + 1]})});
    }
  }
  return lines;
}

}  // namespace crt::core
