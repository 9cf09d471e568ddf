// Which pieces of a line are in a solid.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/math/float_environment.hpp"
#include "core/measure/entity_cells.hpp"
#include "core/measure/line_runs.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"

namespace crt {

namespace core {

namespace {

/// Makes pieces of runs: what is open is an end of the piece before it, or after it.
class PieceMaker {
 public:
  PieceMaker(const SolidLine& line, std::vector<LinePiece>& pieces)
      : line_(line), pieces_(pieces) {}

  void take(std::span<const LineRun> runs) {
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const LineRun& run = runs[i];
      const bool is_after_full = i > 0 && runs[i - 1].kind == LineRun::Kind::full;
      const bool is_before_full = i + 1 < runs.size() && runs[i + 1].kind == LineRun::Kind::full;
      if (run.kind == LineRun::Kind::full) {
        // Without something open before it, it goes on from the last or begins at once.
        if (!is_in_) begin({run.from, run.from});
        pieces_.back().to = {run.to, run.to};
      } else if (run.kind == LineRun::Kind::empty) {
        is_in_ = false;
      } else if (is_after_full && is_before_full) {
        if (is_short(run)) continue;
        end({run.from, run.to});
        begin({run.from, run.to});
      } else if (is_after_full) {
        end({run.from, run.to});
      } else if (is_before_full) {
        begin({run.from, run.to});
      } else if (!is_short(run)) {
        begin({run.from, run.to});
        end({run.from, run.to});
      }
    }
  }

 private:
  /// What is open for a moment alone is a touch, or where two parts meet.
  bool is_short(const LineRun& run) const {
    constexpr double short_for = 16;
    const double distance = std::max(std::abs(run.from), std::abs(run.to));
    return run.to - run.from <= short_for * line_.resolution(distance);
  }
  void begin(const crt::Interval& from) {
    pieces_.push_back({.from = from, .to = from});
    is_in_ = true;
  }
  void end(const crt::Interval& to) {
    pieces_.back().to = to;
    is_in_ = false;
  }

  const SolidLine& line_;
  std::vector<LinePiece>& pieces_;
  bool is_in_ = false;
};

void check_line(const Vec3& origin, const Vec3& direction) {
  if (!Bounds{origin, origin}.finite())
    throw Error(ErrorCode::invalid_argument, "the origin of a line must be finite", "origin");
  if (!Bounds{direction, direction}.finite() || largest_component(direction) == 0)
    throw Error(ErrorCode::invalid_argument, "the direction of a line must be finite and not 0",
                "direction");
}

std::vector<LinePiece> pieces_in(const EntityCells& cells, const Vec3& origin,
                                 const Vec3& direction, MeasureClock& clock) {
  const SolidLine line(origin, direction);
  std::vector<LinePiece> pieces;
  for (const CellSolid& solid : cells.solids()) {
    // All of a solid is within its box's diagonal of the place that is nearest to its middle.
    const CellFrame frame(first_box(solid.bounds()));
    const Vec3 way = frame.middle - origin;
    const double nearest = glm::dot(way, unit_vector(direction));
    const double reach = 1.001 * glm::length(frame.half) + 0x1p-40 * glm::length(way);
    clock.is_over();  // it may be cancelled, but time alone does not end it
    PieceMaker(line, pieces)
        .take(runs_of_line(solid, line, nearest - reach, nearest + reach, clock));
  }
  // None is within another, as the solids do not touch.
  std::ranges::sort(pieces, {}, [](const LinePiece& piece) { return piece.from.lower; });
  return pieces;
}

}  // namespace

}  // namespace core

std::vector<LinePiece> thickness_along(const Entity& entity, const Vec3& origin,
                                       const Vec3& direction, const MeasureOptions& options) {
  core::validate(options);
  core::check_line(origin, direction);
  return core::measured([&] {
    const core::EntityCells cells(entity);
    cells.check_bounded();
    core::MeasureClock clock(options);
    return core::pieces_in(cells, origin, direction, clock);
  });
}

}  // namespace crt
