#include "core/section/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/base/invalid_index.hpp"
#include "core/math/jet.hpp"
#include "core/section/arc_series.hpp"
#include "core/section/cell_links.hpp"
#include "core/section/doubtful_cells.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

constexpr std::size_t cells_of_task = 16;

class BoundarySearch {
 public:
  BoundarySearch(const CellSolid& solid, const SectionPlane& plane,
                 const BoundaryQuestion& question, MeasureClock& clock, const Workers& workers,
                 int attempt)
      : grid_(plane, solid.bounds(), attempt),
        looks_(solid, grid_, plane.across, question.size),
        edges_(looks_),
        question_(question),
        clock_(clock),
        workers_(workers) {}

  /// Returns false if a line is not closed, as it may be if a face lies along a side of a cell.
  bool run() {
    BoundaryCell root = looks_.root();
    const BoundaryLooks::Found found = look_at(root);
    if (found == BoundaryLooks::Found::in_plane) {
      boundary_.lies_in_plane = true;
      return true;
    }
    if (found == BoundaryLooks::Found::nothing) return true;
    std::vector<BoundaryCell> open;
    sort_in(std::move(root), open);
    for (;;) {
      divide(std::move(open));
      if (boundary_.lies_in_plane) return true;
      open = link();
      boundary_.looks += edges_.take_looks();
      if (open.empty()) break;
    }
    const bool is_closed = trace();
    find_deviation();
    return is_closed;
  }
  Boundary take() { return std::move(boundary_); }

 private:
  static constexpr std::size_t most_cells = std::size_t{1} << 16;
  /// So few may be divided until they are as small as rounding.
  static constexpr std::size_t few_cells = 512;
  /// All cells are linked anew after some were divided. That ends after so many.
  static constexpr std::size_t most_cells_linked = std::size_t{1} << 19;
  static constexpr std::size_t most_chords = std::size_t{1} << 18;
  static constexpr double least_size = 0x1p-40;

  BoundaryLooks::Found look_at(BoundaryCell& cell) {
    boundary_.looks += cell.program->leaves.size();
    return looks_.look_at(cell);
  }

  void sort_in(BoundaryCell&& cell, std::vector<BoundaryCell>& open) {
    (cell.is_simple ? simple_ : open).push_back(std::move(cell));
  }

  /// Returns whether a cell is to be divided further, of `count` that might be.
  bool may_divide(const BoundaryCell& cell, std::size_t count) {
    const double size = looks_.size(cell);
    if (simple_.size() + left_.size() + count > most_cells) return false;
    if (size <= least_size * grid_.size()) return false;
    return size > 0.25 * question_.deviation || count <= few_cells;
  }

  /// Divides cells until they are simple, or left.
  void divide(std::vector<BoundaryCell>&& open) {
    while (!open.empty()) {
      const bool is_over = clock_.is_over();
      std::vector<BoundaryCell> cells;
      for (BoundaryCell& cell : open)
        (!is_over && may_divide(cell, open.size()) ? cells : left_).push_back(std::move(cell));
      std::vector<std::vector<BoundaryCell>> parts(cells.size());
      std::vector<std::uint64_t> looks(cells.size());
      std::vector<unsigned char> in_plane(cells.size());
      for_ranges(cells.size(), cells_of_task, workers_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          for (BoundaryCell& part : looks_.parts_of(cells[i])) {
            looks[i] += part.program->leaves.size();
            const BoundaryLooks::Found found = looks_.look_at(part);
            if (found == BoundaryLooks::Found::in_plane) in_plane[i] = 1;
            if (found == BoundaryLooks::Found::crossed) parts[i].push_back(std::move(part));
          }
        }
      });
      for (const std::uint64_t count : looks) boundary_.looks += count;
      if (std::ranges::count(in_plane, 1) > 0) {
        boundary_.lies_in_plane = true;
        return;
      }
      open.clear();
      for (std::vector<BoundaryCell>& of_cell : parts)
        for (BoundaryCell& part : of_cell) sort_in(std::move(part), open);
    }
  }

  /// Links what crosses the borders of all cells. Returns simple cells where that failed, which are
  /// to be divided.
  std::vector<BoundaryCell> link() {
    std::vector<BoundaryCell> cells = simple_;
    cells.insert(cells.end(), left_.begin(), left_.end());
    edges_.find(cells, workers_);
    cells_linked_ += cells.size();
    std::vector<std::vector<CellLink>> links(cells.size());
    std::vector<unsigned char> failed(cells.size());
    for_ranges(cells.size(), cells_of_task, workers_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::vector<BorderCrossing> border = edges_.around(cells[i]);
        std::optional<std::vector<CellLink>> found;
        if (cells[i].is_simple) found = links_of(looks_, cells[i], border);
        failed[i] = cells[i].is_simple && !found ? 1 : 0;
        links[i] = found ? std::move(*found) : straight_links(border);
      }
    });
    std::vector<BoundaryCell> again;
    const auto count = static_cast<std::size_t>(std::ranges::count(failed, 1));
    const bool is_over = clock_.is_over();
    if (count > 0) {
      std::vector<BoundaryCell> kept;
      kept.reserve(simple_.size());
      for (std::size_t i = 0; i < simple_.size(); ++i) {
        if (failed[i] == 0) {
          kept.push_back(std::move(simple_[i]));
        } else if (!is_over && cells_linked_ < most_cells_linked && may_divide(simple_[i], count) &&
                   !looks_.parts_of(simple_[i]).empty()) {
          again.push_back(std::move(simple_[i]));
        } else {
          simple_[i].is_simple = false;
          left_.push_back(std::move(simple_[i]));
        }
      }
      simple_ = std::move(kept);
    }
    if (!again.empty()) return again;
    cells_ = std::move(cells);
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (failed[i] != 0) cells_[i].is_simple = false;
    links_ = std::move(links);
    return again;
  }

  struct LinkPlace {
    std::uint32_t cell = invalid_index;
    std::uint32_t link = 0;
  };

  /// Follows the links around.
  bool trace() {
    std::vector<LinkPlace> from(edges_.crossing_count());
    for (std::uint32_t i = 0; i < links_.size(); ++i) {
      for (std::uint32_t j = 0; j < links_[i].size(); ++j) from[links_[i][j].from] = {i, j};
    }
    bool is_closed = true;
    std::vector<unsigned char> done(from.size());
    std::vector<std::vector<BoundaryPiece>> loops;
    // A line that is not closed begins where no other link ends.
    std::vector<unsigned char> is_end(from.size());
    for (const std::vector<CellLink>& links : links_)
      for (const CellLink& link : links) is_end[link.to] = 1;
    std::vector<std::uint32_t> starts;
    for (std::uint32_t i = 0; i < from.size(); ++i)
      if (from[i].cell != invalid_index && is_end[i] == 0) starts.push_back(i);
    for (std::uint32_t i = 0; i < from.size(); ++i)
      if (from[i].cell != invalid_index && is_end[i] != 0) starts.push_back(i);
    for (const std::uint32_t start : starts) {
      std::vector<BoundaryPiece> pieces;
      std::uint32_t crossing = start;
      while (from[crossing].cell != invalid_index && done[crossing] == 0) {
        done[crossing] = 1;
        const LinkPlace place = from[crossing];
        const CellLink& link = links_[place.cell][place.link];
        const bool has_corner = link.first_face != link.last_face;
        pieces.push_back({.from = link.begin,
                          .to = has_corner ? link.corner : link.end,
                          .cell = place.cell,
                          .face = link.first_face});
        if (has_corner) {
          pieces.push_back(
              {.from = link.corner, .to = link.end, .cell = place.cell, .face = link.last_face});
        }
        crossing = link.to;
      }
      if (pieces.empty()) continue;
      if (crossing != start) is_closed = false;
      loops.push_back(std::move(pieces));
    }
    prove(loops);
    return is_closed;
  }

  /// Returns the deviation that is wanted of chords, also for the sake of the area.
  double wanted_deviation(const std::vector<std::vector<BoundaryPiece>>& loops) const {
    double area = 0;
    double length = 0;
    for (const std::vector<BoundaryPiece>& pieces : loops) {
      for (const BoundaryPiece& piece : pieces) {
        const PlanePoint& begin = pieces.front().from;
        area += 0.5 * ((piece.from.x - begin.x) * (piece.to.y - begin.y) -
                       (piece.from.y - begin.y) * (piece.to.x - begin.x));
        length += std::abs(piece.to.x - piece.from.x) + std::abs(piece.to.y - piece.from.y);
      }
    }
    const double for_area =
        length > 0 ? 0.5 * question_.relative_width * std::abs(area) / length : infinity;
    return std::max(std::min(0.25 * question_.deviation, for_area), 0x1p-42 * question_.size);
  }

  void prove(const std::vector<std::vector<BoundaryPiece>>& loops) {
    std::vector<const BoundaryPiece*> pieces;
    for (const std::vector<BoundaryPiece>& loop : loops)
      for (const BoundaryPiece& piece : loop) pieces.push_back(&piece);
    std::vector<std::vector<BoundaryPoint>> points(pieces.size());
    const auto count =
        static_cast<std::size_t>(std::ranges::count_if(pieces, [](const BoundaryPiece* piece) {
          return piece->face != BoundaryCell::unknown_face;
        }));
    int most_halvings = 4;
    while (most_halvings < 14 && count << (most_halvings + 1) <= most_chords) ++most_halvings;
    const PieceProver prover(looks_, wanted_deviation(loops), most_halvings);
    for_ranges(pieces.size(), cells_of_task, workers_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        prover.prove(cells_[pieces[i]->cell], *pieces[i], points[i]);
    });
    std::size_t next = 0;
    for (const std::vector<BoundaryPiece>& loop : loops) {
      BoundaryLoop line;
      for (std::size_t i = 0; i < loop.size(); ++i, ++next) {
        boundary_.looks += points[next].size();
        line.insert(line.end(), points[next].begin(), points[next].end());
      }
      add_loop(std::move(line));
    }
  }

  /// Adds the area within a line, and what its chords may be off.
  void add_loop(BoundaryLoop&& line) {
    const PlanePoint begin = line.front().place;
    const auto from_begin = [&](const PlanePoint& p) {
      return std::pair(Interval::of(p.x) - Interval::of(begin.x),
                       Interval::of(p.y) - Interval::of(begin.y));
    };
    Interval area{0, 0};
    double off = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const auto [x, y] = from_begin(line[i].place);
      const auto [next_x, next_y] = from_begin(line[(i + 1) % line.size()].place);
      area = area + (x * next_y - y * next_x) * Interval::of(0.5);
      const Interval chord = root(square(next_x - x) + square(next_y - y));
      area = area + segment_area(chord, line[i].bulge);
      const double length = chord.hi + grid_.rounding();
      if (line[i].surface != no_surface) off += length * line[i].deviation;
      boundary_.deviation = std::max(boundary_.deviation, line[i].deviation);
    }
    off *= 1 + 0x1p-30;
    boundary_.area = boundary_.area + area + Interval{-off, off};
    boundary_.loops.push_back(std::move(line));
  }

  /// Finds how far from the boundary what may be in cells that were left can be.
  void find_deviation() {
    std::vector<BoundaryCell> doubtful;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].is_simple) continue;
      const std::array<double, 2> size = grid_.size(cells_[i].lower, cells_[i].upper);
      const double area = size[0] * size[1] * (1 + 0x1p-40);
      boundary_.area = boundary_.area + Interval{-area, area};
      if (looks_.size(cells_[i]) > 0x1p-30 * grid_.size()) ++boundary_.left_cells;
      // What is so small is left out of all that is promised.
      if (looks_.size(cells_[i]) > 4 * least_size * grid_.size())
        doubtful.push_back(std::move(cells_[i]));
    }
    boundary_.deviation =
        std::max(boundary_.deviation, farthest_doubt(looks_, doubtful, boundary_.loops));
    boundary_.area.lo = std::max(0.0, boundary_.area.lo);
    boundary_.area.hi = std::max(0.0, boundary_.area.hi);
  }

  BoundaryGrid grid_;
  BoundaryLooks looks_;
  BoundaryEdges edges_;
  const BoundaryQuestion& question_;
  MeasureClock& clock_;
  Workers workers_;
  std::vector<BoundaryCell> simple_;
  std::vector<BoundaryCell> left_;
  std::vector<BoundaryCell> cells_;  ///< all of them, once they are linked
  std::vector<std::vector<CellLink>> links_;
  std::size_t cells_linked_ = 0;
  Boundary boundary_;
};

}  // namespace

Boundary boundary_of(const CellSolid& solid, const SectionPlane& plane,
                     const BoundaryQuestion& question, MeasureClock& clock,
                     const Workers& workers) {
  std::uint64_t looks = 0;
  Boundary boundary;
  constexpr int most_attempts = 3;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    BoundarySearch search(solid, plane, question, clock, workers, attempt);
    const bool is_closed = search.run();
    boundary = search.take();
    looks += boundary.looks;
    boundary.looks = looks;
    if (is_closed) return boundary;
  }
  boundary.deviation = infinity;
  return boundary;
}

}  // namespace crt::core
