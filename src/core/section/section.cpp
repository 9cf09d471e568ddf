// A section is put together from the boundaries of all objects of a solid.
#include "crt/section.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/measure/entity_cells.hpp"
#include "core/measure/measure_clock.hpp"
#include "core/section/boundary.hpp"
#include "core/section/boundary_edges.hpp"
#include "core/section/circle_fit.hpp"
#include "core/section/contour_arcs.hpp"
#include "core/section/contour_fit.hpp"
#include "core/section/section_plane.hpp"
#include "core/tasks/parallel.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

namespace {

/// An AllBoundaries has those of all objects.
struct AllBoundaries {
  std::vector<Boundary> boundaries;
  double deviation = 0;
  bool lies_in_plane = false;
  std::size_t left_cells = 0;
};

/// Returns how far points of a line are apart along an axis at most.
double extent(const BoundaryLoop& line) {
  Bounds box;
  for (const BoundaryPoint& point : line) box.include({point.place.x, point.place.y, 0});
  return largest_component(box.upper - box.lower);
}

/// Returns how far points of a narrow line are from others, or infinity if there are none.
double farthest_point(const BoundaryLoop& line, const std::vector<BoundaryLoop>& others) {
  double farthest = 0;
  for (const BoundaryPoint& point : line) {
    double nearest = infinity;
    for (const BoundaryLoop& other : others) {
      for (const BoundaryPoint& place : other)
        nearest = std::min(nearest, distance_between(point.place, place.place));
    }
    const double reach = nearest + distance_between(point.place, line.front().place);
    farthest = std::max(farthest, reach + (std::isfinite(point.deviation) ? point.deviation : 0));
  }
  return farthest;
}

class SectionSearch {
 public:
  SectionSearch(const EntityCells& entity, const SectionPlane& plane, double deviation,
                const MeasureOptions& options)
      : solids_(entity.solids()), plane_(plane), clock_(options) {
    question_ = {.deviation = deviation,
                 .relative_width = options.relative_width,
                 .size = largest_component(CellFrame(entity.bounds()).half)};
  }

  Section run() {
    AllBoundaries all = boundaries();
    // Where a face lies in the plane, or an edge, that is moved by next to nothing.
    if (all.lies_in_plane || all.left_cells > most_left_cells) {
      const SectionPlane asked = plane_;
      plane_.move(-0x1p-32 * question_.size);
      AllBoundaries moved = boundaries();
      const bool is_better = all.lies_in_plane || (moved.deviation <= all.deviation &&
                                                   moved.left_cells < all.left_cells / 2);
      if (is_better) {
        all = std::move(moved);
      } else {
        plane_ = asked;
      }
    }
    return drawn(all);
  }

 private:
  /// More than so many cells that were left are no places where only points touch.
  static constexpr std::size_t most_left_cells = 64;
  static constexpr std::size_t objects_of_batch = 64;

  AllBoundaries boundaries() {
    std::vector<const CellSolid*> met;
    for (const CellSolid& solid : solids_) {
      const Bounds& bounds = solid.bounds();
      if (bounds.lower[plane_.across] <= plane_.place &&
          bounds.upper[plane_.across] >= plane_.place)
        met.push_back(&solid);
    }
    AllBoundaries all;
    all.boundaries.resize(met.size());
    for (std::size_t first = 0; first < met.size(); first += objects_of_batch) {
      const std::size_t count = std::min(objects_of_batch, met.size() - first);
      const Workers inner = count == 1 ? clock_.workers() : Workers(1, clock_.workers().stop);
      for_ranges(count, 1, clock_.workers(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = first + begin; i < first + end; ++i)
          all.boundaries[i] = boundary_of(*met[i], plane_, question_, clock_, inner);
      });
      std::uint64_t looks = 0;
      for (std::size_t i = first; i < first + count; ++i) looks += all.boundaries[i].looks;
      clock_.count(looks);
    }
    for (const Boundary& boundary : all.boundaries) {
      all.deviation = std::max(all.deviation, boundary.deviation);
      all.lies_in_plane = all.lies_in_plane || boundary.lies_in_plane;
      all.left_cells += boundary.left_cells;
    }
    if (all.lies_in_plane) all.deviation = infinity;
    return all;
  }

  /// Returns a line in the coordinates of the drawing, with the solid on its left.
  BoundaryLoop in_drawing(BoundaryLoop loop) const {
    for (BoundaryPoint& point : loop) point.place = plane_.to_drawing(point.place);
    if (!plane_.is_mirrored()) return loop;
    // What was said of a chord at its beginning is said at its end now.
    BoundaryLoop turned(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      turned[i] = loop[loop.size() - 1 - i];
      const BoundaryPoint& chord = loop[(2 * loop.size() - 2 - i) % loop.size()];
      // It is mirrored and turned back, so an arc keeps its bulge.
      turned[i].bulge = chord.bulge;
      turned[i].surface = chord.surface;
      turned[i].deviation = chord.deviation;
    }
    return turned;
  }

  Section drawn(const AllBoundaries& all) const {
    Section section{.frame = plane_.frame, .deviation = all.deviation};
    core::Interval area{0, 0};
    Bounds box;
    double off = 0;
    std::vector<std::pair<double, Contour>> contours;
    for (const Boundary& boundary : all.boundaries) {
      area = area + boundary.area;
      std::vector<BoundaryLoop> kept;
      std::vector<BoundaryLoop> narrow;
      for (const BoundaryLoop& line : boundary.loops) {
        BoundaryLoop loop = in_drawing(line);
        double proved = std::min(boundary.deviation, 0.75 * question_.deviation);
        for (const BoundaryPoint& point : loop) {
          if (point.surface != no_surface) proved = std::max(proved, point.deviation);
        }
        const double left = std::max(question_.deviation - proved, 0.25 * question_.deviation);
        FittedContour fitted = fit_contour(loop, left, 0x1p-34 * question_.size);
        if (fitted.contour.empty() && extent(loop) <= 0x1p-32 * question_.size) continue;
        (fitted.contour.empty() ? narrow : kept).push_back(std::move(loop));
        if (fitted.contour.empty()) continue;
        off = std::max(off, fitted.off);
        include_contour(fitted.contour, box);
        const double size = enclosed_area(fitted.contour);
        contours.emplace_back(size, std::move(fitted.contour));
      }
      // What is so narrow that it encloses nothing is no contour, but the boundary may be there.
      for (const BoundaryLoop& loop : narrow)
        section.deviation = std::max(section.deviation, farthest_point(loop, kept));
    }
    section.area = {std::max(0.0, area.lo), std::max(0.0, area.hi)};
    // Coordinates are rounded.
    off += 0x1p-48 * std::max(largest_component(box.lower), largest_component(box.upper));
    if (!contours.empty()) section.deviation += off;
    std::stable_sort(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
      return std::abs(a.first) > std::abs(b.first);
    });
    section.contours.reserve(contours.size());
    for (auto& [size, contour] : contours) section.contours.push_back(std::move(contour));
    if (!contours.empty()) {
      section.lower = {box.lower.x, box.lower.y};
      section.upper = {box.upper.x, box.upper.y};
    }
    return section;
  }

  std::span<const CellSolid> solids_;
  SectionPlane plane_;
  MeasureClock clock_;
  BoundaryQuestion question_;
};

}  // namespace

}  // namespace core

Section section(const Entity& entity, const Vec3& normal, double offset, double deviation,
                const MeasureOptions& options) {
  core::validate(options);
  if (!(deviation > 0 && std::isfinite(deviation)))
    throw Error(ErrorCode::invalid_argument, "the deviation must be above 0", "deviation");
  return core::measured([&] {
    Entity turned = entity;
    const core::SectionPlane plane = core::section_plane(normal, offset, turned);
    const core::EntityCells cells(turned);
    cells.check_bounded();
    return core::SectionSearch(cells, plane, deviation, options).run();
  });
}

}  // namespace crt
