// Of each of the six sides those cells are divided that may reach farthest, until a point of the
// solid is known that is near enough to where any point may be. In a crossed cell the faces' planes
// say how far it may reach, so the cells need not become small where a face is tangent to the side.
#include <algorithm>
#include <queue>

#include "core/math/float_environment.hpp"
#include "core/measure/cell_reach.hpp"
#include "core/measure/entity_cells.hpp"
#include "core/measure/measure_clock.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"

namespace crt {

namespace core {

namespace {

/// A ReachingCell is one with how far the solid may reach in it.
struct ReachingCell {
  Cell cell;
  std::uint32_t object = 0;
  double most = 0;
};

class ExtentSearch {
 public:
  ExtentSearch(std::span<const CellSolid> solids, const Vec3& direction, double width,
               MeasureClock& clock)
      : solids_(solids), direction_(direction), width_(width), clock_(clock) {}

  /// Returns a bound on how far the solids reach, or -infinity if they have no
  /// points.
  double run() {
    for (std::uint32_t i = 0; i < solids_.size(); ++i)
      add({solids_[i].cell(first_box(solids_[i].bounds())), i, infinity});
    while (!cells_.empty() && looks_ < solids_.size() + most_looks &&
           cells_.front().most > surely_ + width_ && !clock_.is_over()) {
      std::pop_heap(cells_.begin(), cells_.end(), less);
      const ReachingCell whole = std::move(cells_.back());
      cells_.pop_back();
      const std::vector<Bounds> parts = halves_of(whole.cell.box);
      const double size = largest_component(whole.cell.box.upper - whole.cell.box.lower);
      if (parts.size() == 1 || size < 0.25 * width_) {
        at_least_ = std::max(at_least_, whole.most);  // so little is not looked into
        continue;
      }
      for (const Bounds& part : parts) add({{part, whole.cell.program}, whole.object, whole.most});
    }
    double most = std::max(at_least_, surely_);
    if (!cells_.empty()) most = std::max(most, cells_.front().most);
    return most;
  }

 private:
  /// What no equations bound, such as custom shapes, and what is thinner than its own rounding
  /// would be divided for ever. So a side ends after so many looks at cells, and one at each solid.
  static constexpr std::size_t most_looks = std::size_t{1} << 16;

  static bool less(const ReachingCell& a, const ReachingCell& b) { return a.most < b.most; }

  void add(ReachingCell&& open) {
    ++looks_;
    clock_.count(open.cell.program->leaves.size());
    const CellSolid& solid = solids_[open.object];
    const CellLook look = solid.look(open.cell);
    const CellReach reach = reach_of(open.cell.box, look, direction_);
    if (reach.most == -infinity) return;
    surely_ = std::max(surely_, reach.surely);
    open.most = std::min(open.most, reach.most);
    if (look.kind == CellLook::Kind::full) {
      at_least_ = std::max(at_least_, open.most);
      return;
    }
    if (look.program) open.cell.program = look.program;
    cells_.push_back(std::move(open));
    std::push_heap(cells_.begin(), cells_.end(), less);
  }

  std::span<const CellSolid> solids_;
  Vec3 direction_;
  double width_;
  MeasureClock& clock_;
  std::vector<ReachingCell> cells_;  ///< a heap, that which may reach farthest first
  double surely_ = -infinity;        ///< a point of the solids is there
  double at_least_ = -infinity;      ///< cells that are done reach there
  std::size_t looks_ = 0;
};

}  // namespace

}  // namespace core

BoundingBox tight_bounding_box(const Entity& entity, const MeasureOptions& options) {
  core::validate(options);
  if (!entity.is_solid()) return bounding_box(entity);
  return core::measured([&]() -> BoundingBox {
    const core::EntityCells cells(entity);
    const core::Bounds& rough = cells.bounds();
    if (rough.empty() || !rough.finite()) return {rough.lower, rough.upper};
    core::MeasureClock clock(options);
    const double size = core::largest_component(core::CellFrame(rough).half);
    const double width = options.relative_width * size;
    core::Bounds tight = rough;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 direction(0, 0, 0);
      direction[axis] = 1;
      const double upper = core::ExtentSearch(cells.solids(), direction, width, clock).run();
      if (upper == -core::infinity) return {core::Bounds().lower, core::Bounds().upper};
      const double lower = core::ExtentSearch(cells.solids(), -direction, width, clock).run();
      tight.upper[axis] = std::min(rough.upper[axis], upper);
      tight.lower[axis] = std::max(rough.lower[axis], -lower);
    }
    return {tight.lower, tight.upper};
  });
}

}  // namespace crt
