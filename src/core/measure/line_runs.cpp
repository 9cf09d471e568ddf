#include "core/measure/line_runs.hpp"

#include <cmath>
#include <glm/geometric.hpp>

namespace crt::core {

namespace {

/// A line is left after so many boxes.
constexpr std::size_t most_boxes_of_line = std::size_t{1} << 13U;

struct OpenRun {
  LineRun run;
  std::shared_ptr<const OpenProgram> program;
};

LineRun::Kind kind_of(const CellLook& look) {
  if (look.kind == CellLook::Kind::full) return LineRun::Kind::full;
  return look.kind == CellLook::Kind::empty ? LineRun::Kind::empty : LineRun::Kind::open;
}

/// Divides a line, all parts that are open at once.
class LineDivision {
 public:
  LineDivision(const CellSolid& solid, const SolidLine& line, double from, double to,
               MeasureClock& clock, double shortest)
      : solid_(solid),
        line_(line),
        clock_(clock),
        resolution_(std::max(shortest, line.resolution(std::max(-from, to)))) {
    add(from, to, solid.cell(line.box(from, to)).program);
  }

  std::vector<LineRun> divide() {
    bool is_divided = true;
    while (is_divided && boxes_ < most_boxes_of_line) {
      std::vector<OpenRun> whole;
      whole.swap(runs_);
      is_divided = false;
      for (OpenRun& part : whole) {
        const LineRun& run = part.run;
        const double middle = 0.5 * run.from + 0.5 * run.to;
        if (run.kind != LineRun::Kind::open || !(run.to - run.from > resolution_)) {
          append(std::move(part));
          continue;
        }
        is_divided = true;
        add(run.from, middle, part.program);
        add(middle, run.to, part.program);
      }
    }
    return joined();
  }

 private:
  void add(double from, double to, const std::shared_ptr<const OpenProgram>& program) {
    ++boxes_;
    clock_.count(program->leaves.size() + looks_of_cell);
    const CellLook look = solid_.look({line_.box(from, to), program});
    append(
        {{.from = from, .to = to, .kind = kind_of(look)}, look.program ? look.program : program});
  }
  /// Appends a part, or makes the last run longer where both are known and of one kind.
  void append(OpenRun&& part) {
    const bool is_known = part.run.kind != LineRun::Kind::open;
    if (is_known && !runs_.empty() && runs_.back().run.kind == part.run.kind) {
      runs_.back().run.to = part.run.to;
    } else {
      runs_.push_back(std::move(part));
    }
  }
  std::vector<LineRun> joined() const {
    std::vector<LineRun> runs;
    for (const OpenRun& part : runs_) {
      if (!runs.empty() && runs.back().kind == part.run.kind) {
        runs.back().to = part.run.to;
      } else {
        runs.push_back(part.run);
      }
    }
    return runs;
  }

  const CellSolid& solid_;
  const SolidLine& line_;
  MeasureClock& clock_;
  double resolution_;
  std::size_t boxes_ = 0;
  std::vector<OpenRun> runs_;
};

}  // namespace

SolidLine::SolidLine(const Vec3& origin, const Vec3& direction) : origin_(origin), unit_{} {
  const Vec3 scaled = scaled_to_one(direction);  // its squares are doubles
  const Interval length =
      square_root(square(Interval::of(scaled.x)) + square(Interval::of(scaled.y)) +
                  square(Interval::of(scaled.z)));
  for (int axis = 0; axis < 3; ++axis) {
    const bool is_alone = scaled[(axis + 1) % 3] == 0 && scaled[(axis + 2) % 3] == 0;
    Interval& unit = unit_[static_cast<std::size_t>(axis)];
    if (is_alone) {
      unit = Interval::of(std::copysign(1.0, scaled[axis]));
    } else if (scaled[axis] != 0) {
      unit = Interval::of(scaled[axis]) / length;
    }
  }
}

Bounds SolidLine::box(double from, double to) const {
  Bounds box;
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& unit = unit_[static_cast<std::size_t>(axis)];
    Interval place = Interval::of(origin_[axis]);
    // What is 0 is not rounded, so that a line in a face is known to be there.
    if (unit.lo != 0 || unit.hi != 0) place = place + Interval{from, to} * unit;
    box.lower[axis] = place.lo;
    box.upper[axis] = place.hi;
  }
  return box;
}

Vec3 SolidLine::at(double distance) const {
  const Bounds place = box(distance, distance);
  return 0.5 * place.lower + 0.5 * place.upper;
}

double SolidLine::resolution(double distance) const {
  constexpr double last_places = 0x1p-46;
  return last_places * (largest_component(origin_) + distance) + std::numeric_limits<double>::min();
}

std::vector<LineRun> runs_of_line(const CellSolid& solid, const SolidLine& line, double from,
                                  double to, MeasureClock& clock, double shortest) {
  return LineDivision(solid, line, from, to, clock, shortest).divide();
}

}  // namespace crt::core
