#include "import/region.hpp"

#include <algorithm>
#include <cmath>
#include <crt/curves.hpp>
#include <crt/elementary.hpp>
#include <crt/error.hpp>
#include <crt/svg_path.hpp>
#include <limits>
#include <numbers>

#include "import/arc.hpp"
#include "import/solid.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr std::uint64_t most_work = 1'000'000'000;  // steps of a few nanoseconds
constexpr double most_comparisons = 1e9;

std::string path_of(const Region& region) {
  std::string path;
  for (const Contour& contour : region) {
    for (std::size_t i = 0; i <= contour.size(); ++i) {
      const ProfilePoint& corner = contour[i % contour.size()];
      const double y = corner.y == 0 ? 0.0 : -corner.y;
      if (i == 0) {
        path += text::format("M{} {}", corner.x, y);
      } else if (corner.bulge == 0) {
        path += text::format("L{} {}", corner.x, y);
      } else {
        const ProfilePoint& before = contour[i - 1];
        const double radius = arc_between(before, corner).radius;
        path +=
            text::format("A{0} {0} 0 {1} {2} {3} {4}", radius, std::abs(corner.bulge) > 1 ? 1 : 0,
                         corner.bulge > 0 ? 0 : 1, corner.x, y);
      }
    }
    path += "Z";
  }
  return path;
}

double area_of(const Contour& contour) {
  double area = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ProfilePoint& from = contour[i == 0 ? contour.size() - 1 : i - 1];
    const ProfilePoint& to = contour[i];
    area += (from.x * to.y - to.x * from.y) / 2;
    if (to.bulge == 0) continue;
    const Arc arc = arc_between(from, to);
    area += arc.radius * arc.radius * (arc.sweep - elementary::sin(arc.sweep)) / 2;
  }
  return area;
}

/// Returns a contour whose arcs are cut into chords, to ask where it is.
std::vector<CurvePoint> chords_of(const Contour& contour) {
  std::vector<CurvePoint> points;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    if (contour[i].bulge != 0) {
      const Arc arc = arc_between(contour[i == 0 ? contour.size() - 1 : i - 1], contour[i]);
      constexpr int pieces = 16;
      for (int piece = 1; piece < pieces; ++piece)
        points.push_back(arc.at(static_cast<double>(piece) / pieces));
    }
    points.push_back({contour[i].x, contour[i].y});
  }
  return points;
}

bool is_inside(const std::vector<CurvePoint>& polygon, const CurvePoint& p) {
  bool inside = false;
  for (std::size_t i = 0, last = polygon.size() - 1; i < polygon.size(); last = i++) {
    const CurvePoint& a = polygon[last];
    const CurvePoint& b = polygon[i];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
  }
  return inside;
}

Region nonzero(const Region& contours) {
  PathOptions options;
  std::uint64_t done = 0;
  options.work = [&](std::uint64_t work) {
    done += work;
    if (done > most_work) throw Error(ErrorCode::limit, "its contours cross too often");
  };
  return oriented(svg_path_contours(path_of(contours), options));
}

/// Returns what is outside of a region, within a frame around all.
Region complement_in(const Contour& frame, const Region& region) {
  Region result{frame};
  for (const Contour& contour : region) result.push_back(reversed(contour));
  return result;
}

/// Takes the frame away again.
Region without_frame(const Region& region) {
  const auto largest =
      std::max_element(region.begin(), region.end(),
                       [](const Contour& a, const Contour& b) { return area_of(a) < area_of(b); });
  Region result;
  for (auto contour = region.begin(); contour != region.end(); ++contour)
    if (contour != largest) result.push_back(reversed(*contour));
  return result;
}

Contour frame_around(const std::vector<Region>& regions) {
  RegionBounds all{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  for (const Region& region : regions) {
    const RegionBounds bounds = bounds_of(region);
    all = {std::min(all.low_x, bounds.low_x), std::min(all.low_y, bounds.low_y),
           std::max(all.high_x, bounds.high_x), std::max(all.high_y, bounds.high_y)};
  }
  const double room = std::max(all.high_x - all.low_x, all.high_y - all.low_y);
  return rectangle_contour(all.low_x - room, all.low_y - room, all.high_x + room,
                           all.high_y + room);
}

bool is_empty(const Region& region) {
  return region.empty();
}

Region joined(const std::vector<Region>& regions) {
  Region all;
  for (const Region& region : regions) all.insert(all.end(), region.begin(), region.end());
  return all;
}

}  // namespace

Contour reversed(const Contour& contour) {
  Contour result;
  for (std::size_t i = contour.size(); i-- > 0;) {
    result.push_back(contour[i]);
    result.back().bulge = -contour[(i + 1) % contour.size()].bulge;
  }
  return result;
}

Region oriented(Region contours) {
  std::vector<std::vector<CurvePoint>> polygons;
  for (const Contour& contour : contours) polygons.push_back(chords_of(contour));
  double comparisons = 0;
  for (const auto& polygon : polygons)
    comparisons += static_cast<double>(polygon.size() * contours.size());
  if (comparisons > most_comparisons) throw Error(ErrorCode::limit, "it has too many contours");
  Region result;
  for (std::size_t i = 0; i < contours.size(); ++i) {
    const double area = area_of(contours[i]);
    if (area == 0) continue;
    // The middle of a piece is on no other contour, as these do not cross.
    const std::vector<CurvePoint>& polygon = polygons[i];
    const CurvePoint middle{(polygon[0].x + polygon[1 % polygon.size()].x) / 2,
                            (polygon[0].y + polygon[1 % polygon.size()].y) / 2};
    bool is_hole = false;
    for (std::size_t j = 0; j < contours.size(); ++j)
      if (j != i && is_inside(polygons[j], middle)) is_hole = !is_hole;
    result.push_back((area < 0) == is_hole ? std::move(contours[i]) : reversed(contours[i]));
  }
  return result;
}

Region united(const std::vector<Region>& regions) {
  Region all = joined(regions);
  if (all.empty()) return {};
  // A lone region is what it is.
  if (static_cast<std::size_t>(std::count_if(regions.begin(), regions.end(), is_empty)) + 1 ==
      regions.size())
    return all;
  return nonzero(all);
}

Region intersected(const std::vector<Region>& regions) {
  if (regions.empty() || std::any_of(regions.begin(), regions.end(), is_empty)) return {};
  if (regions.size() == 1) return regions.front();
  const Contour frame = frame_around(regions);
  Region all;
  for (const Region& region : regions) {
    const Region outside = complement_in(frame, region);
    all.insert(all.end(), outside.begin(), outside.end());
  }
  return without_frame(nonzero(all));
}

Region subtracted(const Region& from, const std::vector<Region>& cutters) {
  const Region cut = joined(cutters);
  if (from.empty() || cut.empty()) return from;
  Region all = complement_in(frame_around({from, cut}), from);
  all.insert(all.end(), cut.begin(), cut.end());
  return without_frame(nonzero(all));
}

Region mapped(const Region& region, const Matrix& m) {
  const double a = m[0][0], b = m[0][1], c = m[1][0], d = m[1][1];
  const double area = a * d - b * c;
  if (area == 0) return {};
  const double size = std::max({std::abs(a), std::abs(b), std::abs(c), std::abs(d)});
  const bool is_even = (std::abs(a - d) <= 3e-6 * size && std::abs(b + c) <= 3e-6 * size) ||
                       (std::abs(a + d) <= 3e-6 * size && std::abs(b - c) <= 3e-6 * size);
  const auto map = [&](const CurvePoint& p) {
    return CurvePoint{a * p.x + b * p.y + m[0][3], c * p.x + d * p.y + m[1][3]};
  };
  Region result;
  for (const Contour& contour : region) {
    Contour made;
    const CurvePoint last = map({contour.back().x, contour.back().y});
    const bool closes_by_curve = contour.front().bulge != 0 && !is_even;
    if (closes_by_curve) made.push_back({last.x, last.y, 0});
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const CurvePoint to = map({contour[i].x, contour[i].y});
      if (contour[i].bulge == 0 || is_even) {
        made.push_back({to.x, to.y, area < 0 ? -contour[i].bulge : contour[i].bulge});
      } else {
        const Arc arc = arc_between(contour[i == 0 ? contour.size() - 1 : i - 1], contour[i]);
        append_mapped_arc(made, arc, map);
      }
    }
    result.push_back(area < 0 ? reversed(made) : made);
  }
  return result;
}

RegionBounds bounds_of(const Region& region) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  RegionBounds bounds{infinite, infinite, -infinite, -infinite};
  const auto add = [&](double x, double y) {
    bounds = {std::min(bounds.low_x, x), std::min(bounds.low_y, y), std::max(bounds.high_x, x),
              std::max(bounds.high_y, y)};
  };
  for (const Contour& contour : region) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      add(contour[i].x, contour[i].y);
      if (contour[i].bulge == 0) continue;
      const Arc arc = arc_between(contour[i == 0 ? contour.size() - 1 : i - 1], contour[i]);
      for (int quarter = 0; quarter < 4; ++quarter) {
        if (!arc.has_angle(quarter * std::numbers::pi / 2)) continue;
        add(arc.x + (quarter == 0   ? arc.radius
                     : quarter == 2 ? -arc.radius
                                    : 0),
            arc.y + (quarter == 1   ? arc.radius
                     : quarter == 3 ? -arc.radius
                                    : 0));
      }
    }
  }
  return bounds;
}

Contour circle_contour(double x, double y, double radius, int fragments) {
  if (fragments == 0) return {{x - radius, y, 1}, {x + radius, y, 1}};
  Contour contour;
  for (int i = 0; i < fragments; ++i) {
    const double degrees = 360.0 * i / fragments;
    contour.push_back(
        {x + radius * cosine_of_degrees(degrees), y + radius * sine_of_degrees(degrees), 0});
  }
  return contour;
}

Contour rectangle_contour(double low_x, double low_y, double high_x, double high_y) {
  return {{low_x, low_y, 0}, {high_x, low_y, 0}, {high_x, high_y, 0}, {low_x, high_y, 0}};
}

bool has_arcs(const Region& region) {
  return std::any_of(region.begin(), region.end(), [](const Contour& contour) {
    return std::any_of(contour.begin(), contour.end(),
                       [](const ProfilePoint& corner) { return corner.bulge != 0; });
  });
}

std::string profile_text(const Region& region) {
  std::vector<std::string> contours;
  for (const Contour& contour : region) {
    std::vector<std::string> corners;
    for (const ProfilePoint& corner : contour) {
      std::vector<std::string> numbers{number_text(corner.x), number_text(corner.y)};
      if (corner.bulge != 0) numbers.push_back(number_text(corner.bulge));
      corners.push_back(list_text(numbers));
    }
    contours.push_back(list_text(corners));
  }
  return contours.size() == 1 ? contours.front() : list_text(contours);
}

}  // namespace crt::importing
