// Cells are divided until what is not known of them all together is little enough. In each round
// those are divided that add most to it. So the rounds, and the sums, do not depend on the threads.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "core/math/float_environment.hpp"
#include "core/measure/cell_mass.hpp"
#include "core/measure/cell_reach.hpp"
#include "core/measure/entity_cells.hpp"
#include "core/measure/measure_clock.hpp"
#include "core/tasks/parallel.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"

namespace crt {

namespace core {

namespace {

/// An OpenCell is one of which not all is known.
struct OpenCell {
  Cell cell;
  std::uint32_t object = 0;
  CellMass mass{};
  double score = 0;  ///< its share of the widths that are wanted, of which 1 is enough
};

/// Asks for some of the mass properties.
struct Wanted {
  bool volume = true;
  bool area = true;
  bool centroid = true;
  bool inertia = true;

  bool moments() const { return centroid || inertia; }
};

class MassSearch {
 public:
  MassSearch(const EntityCells& entity, const Wanted& wanted, const MeasureOptions& options)
      : solids_(entity.solids()), wanted_(wanted), options_(options), clock_(options) {
    if (solids_.empty()) return;
    const CellFrame frame(entity.bounds());
    const Vec3& half = frame.half;
    question_ = {.reference = frame.middle,
                 .with_moments = wanted.moments(),
                 .with_area = wanted.area,
                 .area_tolerance = options.relative_width};
    size_ = largest_component(half);
    box_volume_ = 8 * half.x * half.y * half.z;
    surface_of_box_ = 8 * (half.x * half.y + half.y * half.z + half.z * half.x);
  }

  MassPart run() {
    std::vector<OpenCell> cells;
    for (std::uint32_t i = 0; i < solids_.size(); ++i)
      cells.push_back({.cell = solids_[i].cell(first_box(solids_[i].bounds())), .object = i});
    for_ranges(cells.size(), cells_of_task, clock_.workers(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) look_at(cells[i]);
               });
    put_away(cells);
    while (!cells.empty() && cells.size() < most_cells && !clock_.is_over()) {
      const MassPart all = total(cells);
      score(cells, all);
      const std::size_t some = count_to_divide(cells);
      // The surface is about as large as that of the box around the solid.
      question_.height_tolerance =
          options_.relative_width * (all.volume.middle()) / (2 * surface_of_box_);
      if (some == 0) break;
      divide(cells, some);
      put_away(cells);
    }
    return total(cells);
  }
  const MassQuestion& question() const { return question_; }

 private:
  static constexpr std::size_t most_cells = std::size_t{1} << 20;
  static constexpr std::size_t cells_of_task = 32;
  /// Time is looked at after so many.
  static constexpr std::size_t cells_of_round = std::size_t{1} << 13;

  void look_at(OpenCell& open) const {
    const CellSolid& solid = solids_[open.object];
    const CellLook look = solid.look(open.cell);
    open.mass = mass_of(solid, open.cell.box, look, question_);
    if (look.program) open.cell.program = look.program;
  }

  MassPart total(const std::vector<OpenCell>& cells) const {
    MassPart sum = done_;
    for (const OpenCell& open : cells) sum += open.mass.part;
    return sum;
  }

  /// Returns how much of what is too wide in all is that of a part.
  double share_of(const MassPart& part, const MassPart& most) const {
    double share = 0;
    const auto count = [&](const Interval& number, double scale) {
      const double width = number.width();
      if (width > 0) share = std::max(share, width / (options_.relative_width * scale));
    };
    // Rounding leaves so much open of what is in the box.
    constexpr double floor = 0x1p-46;
    const double volume = std::max(most.volume.hi, floor * box_volume_);
    if (wanted_.volume || wanted_.moments()) count(part.volume, volume);
    if (wanted_.area) {
      const double area = std::max(most.area.lo, floor * size_ * size_);
      if (part.area.hi == infinity) return infinity;
      count(part.area, area);
    }
    if (wanted_.moments())
      for (const Interval& number : part.first) count(number, volume * size_);
    if (wanted_.inertia)
      for (const Interval& number : part.second) count(number, volume * size_ * size_);
    return share;
  }
  void score(std::vector<OpenCell>& cells, const MassPart& all) const {
    for (OpenCell& open : cells) open.score = share_of(open.mass.part, all);
  }

  /// Returns whether a cell adds more to what is not known than another. No two are equal to it, so
  /// that there is one order only.
  static bool goes_first(const OpenCell& a, const OpenCell& b) {
    const auto key = [](const OpenCell& open) {
      const Vec3& corner = open.cell.box.lower;
      return std::tuple(-open.score, open.object, corner.x, corner.y, corner.z);
    };
    return key(a) < key(b);
  }

  /// Puts those first that are to be divided, and returns how many these are. What the others add
  /// is half of what is wanted.
  std::size_t count_to_divide(std::vector<OpenCell>& cells) const {
    double sum = 0;
    bool is_finite = true;
    for (const OpenCell& open : cells) {
      if (open.score == infinity) is_finite = false;
      sum += open.score;
    }
    if (is_finite && sum <= 1) return 0;
    std::sort(cells.begin(), cells.end(), goes_first);
    double rest = 0;
    std::size_t some = cells.size();
    while (some > 1 && rest + cells[some - 1].score <= 0.5) rest += cells[--some].score;
    return std::min(some, cells_of_round);
  }

  /// Divides the first cells, and puts the parts behind the others.
  void divide(std::vector<OpenCell>& cells, std::size_t some) {
    std::vector<std::vector<OpenCell>> parts(some);
    for_ranges(some, cells_of_task, clock_.workers(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        parts[i] = parts_of(cells[i]);
        for (OpenCell& part : parts[i]) look_at(part);
      }
    });
    std::uint64_t looks = 0;
    for (std::size_t i = 0; i < some; ++i)
      looks += parts[i].size() * (cells[i].cell.program->leaves.size() + looks_of_cell);
    std::vector<OpenCell> next(
        std::make_move_iterator(cells.begin() + static_cast<std::ptrdiff_t>(some)),
        std::make_move_iterator(cells.end()));
    for (std::size_t i = 0; i < some; ++i) {
      if (parts[i].empty()) done_ += cells[i].mass.part;  // it cannot be divided
      for (OpenCell& part : parts[i]) next.push_back(std::move(part));
    }
    clock_.count(looks);
    cells = std::move(next);
  }

  /// A cell is divided along its longer sides, and a column across.
  static std::vector<OpenCell> parts_of(const OpenCell& whole) {
    std::vector<OpenCell> parts;
    const std::vector<Bounds> boxes = halves_of(whole.cell.box, whole.mass.column_axis);
    if (boxes.size() == 1) return parts;
    for (const Bounds& box : boxes)
      parts.push_back({.cell = {box, whole.cell.program}, .object = whole.object});
    return parts;
  }

  /// Adds up those cells of which all is known, to rounding.
  void put_away(std::vector<OpenCell>& cells) {
    const auto is_known = [&](const OpenCell& open) {
      const MassPart& part = open.mass.part;
      const auto narrow = [](const Interval& x, double scale) {
        return x.width() <= 0x1p-44 * scale;
      };
      const CellFrame frame(open.cell.box);
      const double volume = 8 * frame.half.x * frame.half.y * frame.half.z;
      return narrow(part.volume, volume) && (!wanted_.area || narrow(part.area, part.area.lo));
    };
    std::size_t kept = 0;
    for (OpenCell& open : cells) {
      if (is_known(open)) {
        done_ += open.mass.part;
      } else {
        if (&cells[kept] != &open) cells[kept] = std::move(open);
        ++kept;
      }
    }
    cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(kept), cells.end());
  }

  std::span<const CellSolid> solids_;
  Wanted wanted_;
  const MeasureOptions& options_;
  MeasureClock clock_;
  MassQuestion question_;
  double size_ = 0;
  double box_volume_ = 0;
  double surface_of_box_ = 0;
  MassPart done_;
};

/// A FoundMass has what was found of an entity, relative to a point.
struct FoundMass {
  MassPart part;
  Vec3 reference{0, 0, 0};

  /// Returns the centroid relative to that point.
  std::array<Interval, 3> center() const {
    std::array<Interval, 3> center;
    for (std::size_t i = 0; i < 3; ++i)
      center[i] = part.volume.lo > 0 ? part.first[i] / part.volume : Interval::everything();
    return center;
  }
};

FoundMass mass_of_entity(const Entity& entity, const Wanted& wanted,
                         const MeasureOptions& options) {
  validate(options);
  return measured([&] {
    const EntityCells cells(entity);
    cells.check_bounded();
    MassSearch search(cells, wanted, options);
    const Vec3 reference = search.question().reference;
    return FoundMass{search.run(), reference};
  });
}

crt::Interval answer(const Interval& number) {
  return {number.lo, number.hi};
}

std::array<crt::Interval, 3> centroid_of(const FoundMass& found) {
  const std::array<Interval, 3> center = found.center();
  std::array<crt::Interval, 3> centroid;
  for (std::size_t i = 0; i < 3; ++i)
    centroid[i] = answer(center[i] + Interval::of(found.reference[static_cast<int>(i)]));
  return centroid;
}

}  // namespace

}  // namespace core

Interval volume(const Entity& entity, const MeasureOptions& options) {
  constexpr core::Wanted wanted{.area = false, .centroid = false, .inertia = false};
  return core::answer(core::mass_of_entity(entity, wanted, options).part.volume);
}

Interval surface_area(const Entity& entity, const MeasureOptions& options) {
  constexpr core::Wanted wanted{.volume = false, .centroid = false, .inertia = false};
  return core::answer(core::mass_of_entity(entity, wanted, options).part.area);
}

std::array<Interval, 3> centroid(const Entity& entity, const MeasureOptions& options) {
  constexpr core::Wanted wanted{.volume = false, .area = false, .inertia = false};
  return core::centroid_of(core::mass_of_entity(entity, wanted, options));
}

MassProperties mass_properties(const Entity& entity, const MeasureOptions& options) {
  using core::answer;
  const core::FoundMass found = core::mass_of_entity(entity, {}, options);
  const core::MassPart& part = found.part;
  const std::array<core::Interval, 3> center = found.center();
  MassProperties result{.volume = answer(part.volume),
                        .area = answer(part.area),
                        .centroid = core::centroid_of(found)};
  // By Steiner's theorem.
  const auto about_center = [&](std::size_t k, std::size_t i, std::size_t j) {
    return part.second[k] - center[i] * part.first[j];
  };
  const core::Interval xx = about_center(0, 0, 0);
  const core::Interval yy = about_center(1, 1, 1);
  const core::Interval zz = about_center(2, 2, 2);
  result.inertia = {answer(yy + zz),
                    answer(zz + xx),
                    answer(xx + yy),
                    answer(-about_center(3, 0, 1)),
                    answer(-about_center(4, 1, 2)),
                    answer(-about_center(5, 2, 0))};
  return result;
}

}  // namespace crt
