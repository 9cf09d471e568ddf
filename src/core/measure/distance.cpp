// Distances: from points to the surface of a solid, and between two solids.
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/math/float_environment.hpp"
#include "core/measure/cell_reach.hpp"
#include "core/measure/cell_tree.hpp"
#include "core/measure/measure_clock.hpp"
#include "core/measure/nearest.hpp"
#include "core/tasks/parallel.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"

namespace crt {

namespace core {

namespace {

/// Where a direction is needed and there is none, it is this.
constexpr Vec3 any_direction(0, 0, 1);

/// Returns how narrow a distance is wanted: not beyond rounding.
double width_of(double least, double size, const MeasureOptions& options) {
  constexpr double smallest = 0x1p-40;
  return std::max(options.relative_width * least, smallest * size);
}

/// An OpenNode is a node of a tree that may have the nearest point.
struct OpenNode {
  std::uint32_t node = 0;
  double least = 0;
};

/// A PointSearch finds the nearest point to one of points, which are inside of solids or outside.
class PointSearch {
 public:
  PointSearch(const EntityCells& entity, const MeasureOptions& options, MeasureClock& clock)
      : entity_(entity),
        tree_(entity),
        options_(options),
        clock_(clock),
        size_(largest_component(CellFrame(entity.bounds()).half)) {}

  NearestPoint find(const Vec3& point) {
    point_ = point;
    search_ = {};
    nearest_ = point;
    const std::size_t cells_before = tree_.size();
    std::optional<std::uint32_t> inside;
    for (std::uint32_t i = 0; i < tree_.root_count(); ++i) {
      const CellSolid& solid = entity_.solids()[i];
      const Cell place = solid.cell({point, point});
      clock_.count(place.program->leaves.size() + tree_.take_looks());
      const CellLook look = solid.look(place);
      if (look.kind == CellLook::Kind::full) inside = i;
      if (look.is_open()) {
        const double off = distance_rounding * (size_ + largest_component(point));
        return {.distance = {-off, off}, .point = point};
      }
    }
    wanted_ = inside ? CellPoints::outside : CellPoints::inside;
    for (std::uint32_t i = 0; i < tree_.root_count(); ++i)
      if (!inside || *inside == i) add(i);
    std::size_t steps = 0;
    while (!search_.is_done(width_of(search_.least(), size_, options_)) && !clock_.is_over()) {
      const OpenNode open = search_.next();
      if (++steps > most_cells_of_search / 8) {
        search_.leave(open.least);
        break;
      }
      tree_.divide(open.node);
      const auto [first, count] =
          std::pair(tree_.node(open.node).first_part, tree_.node(open.node).part_count);
      clock_.count(tree_.take_looks() + count);
      if (count == 0) search_.leave(open.least);
      for (std::uint32_t i = first; i < first + count; ++i) add(i);
    }
    if (search_.most() == infinity) offer_any(inside);
    // What was looked into for this point is of little use for others if it is very much.
    if (tree_.size() > cells_before + most_cells_of_search) tree_ = CellTree(entity_);
    const Interval distance{search_.least(), search_.most()};
    if (inside) return {.distance = {-distance.hi, -distance.lo}, .point = nearest_};
    return {.distance = {distance.lo, distance.hi}, .point = nearest_};
  }

 private:
  /// Offers a point that is surely there, from the largest cell that has one. The nearest cells may
  /// have none, where surfaces merely touch.
  void offer_any(std::optional<std::uint32_t> root) {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t i = 0; i < tree_.root_count(); ++i)
      if (!root || *root == i) nodes.push_back(i);
    for (std::size_t i = 0; i < nodes.size() && i < most_cells_of_search; ++i) {
      const CellTree::Node& node = tree_.node(nodes[i]);
      const CellReach reach = reach_of(node.cell.box, node.look, any_direction, wanted_);
      if (reach.surely > -infinity) {
        const double off =
            distance_rounding * (node.cell.box.farthest() + largest_component(point_));
        search_.offer(glm::length(reach.point - point_) + off);
        nearest_ = reach.point;
        return;
      }
      tree_.divide(nodes[i]);
      clock_.count(tree_.take_looks());
      const CellTree::Node& whole = tree_.node(nodes[i]);
      for (std::uint32_t k = 0; k < whole.part_count; ++k) nodes.push_back(whole.first_part + k);
    }
  }

  void add(std::uint32_t number) {
    const CellTree::Node& node = tree_.node(number);
    const Bounds& box = node.cell.box;
    const Vec3 way = way_to(box, point_);
    const double to_box = glm::length(way);
    const Vec3 direction = to_box > 0 ? way / to_box : any_direction;
    const CellReach reach = reach_of(box, node.look, -direction, wanted_);
    if (reach.most == -infinity) return;
    const double off = distance_rounding * (box.farthest() + largest_component(point_));
    if (reach.surely > -infinity && search_.offer(glm::length(reach.point - point_) + off))
      nearest_ = reach.point;
    double least = 0;
    if (to_box > 0) least = std::max(to_box, -reach.most - glm::dot(direction, point_)) - off;
    // Of a cell that is all wanted, the nearest point is known.
    if (node.look.is_open()) {
      search_.add({number, std::max(0.0, least)});
    } else {
      const Vec3 place = point_ + way;
      if (search_.offer(to_box + off)) nearest_ = place;
      search_.leave(std::max(0.0, to_box - off));
    }
  }

  const EntityCells& entity_;
  CellTree tree_;
  const MeasureOptions& options_;
  MeasureClock& clock_;
  double size_;
  Vec3 point_{0, 0, 0};
  Vec3 nearest_{0, 0, 0};
  CellPoints wanted_ = CellPoints::inside;
  NearestSearch<OpenNode> search_;
};

/// The search for a distance is left after so many pairs of cells: some seconds.
constexpr std::size_t most_pairs_of_search = std::size_t{1} << 18;

/// To compare two cells takes as long as so many looks at leaves.
constexpr std::uint64_t looks_of_pair = 8;

class PairSearch {
 public:
  PairSearch(const EntityCells& a, const EntityCells& b, const MeasureOptions& options,
             MeasureClock& clock)
      : solids_b_(b.solids()),
        a_(a),
        b_(b),
        options_(options),
        clock_(clock),
        near_a_(a, options, clock_),
        near_b_(b, options, clock_),
        size_(std::min(largest_component(CellFrame(a.bounds()).half),
                       largest_component(CellFrame(b.bounds()).half))) {}

  Clearance run() {
    for (std::uint32_t i = 0; i < a_.root_count(); ++i)
      for (std::uint32_t j = 0; j < b_.root_count(); ++j) add(i, j);
    std::size_t steps = 0;
    while (!result_.overlap && !search_.is_done(width_of(search_.least(), size_, options_)) &&
           !clock_.is_over()) {
      const OpenPair open = search_.next();
      if (++steps > most_pairs_of_search) {
        search_.leave(open.least);
        break;
      }
      const bool divides_a =
          a_.node(open.a).look.is_open() &&
          (!b_.node(open.b).look.is_open() || size_of(a_, open.a) >= size_of(b_, open.b));
      CellTree& tree = divides_a ? a_ : b_;
      const std::uint32_t number = divides_a ? open.a : open.b;
      tree.divide(number);
      const std::uint32_t first = tree.node(number).first_part;
      const std::uint32_t count = tree.node(number).part_count;
      clock_.count(tree.take_looks() + looks_of_pair * count);
      if (count == 0) search_.leave(open.least);
      for (std::uint32_t i = first; i < first + count; ++i) {
        if (divides_a) add(i, open.b);
        if (!divides_a) add(open.a, i);
      }
    }
    if (search_.most() == infinity) offer_any();
    result_.distance = {search_.least(), search_.most()};
    if (result_.overlap) result_.distance = {0, 0};
    return result_;
  }

 private:
  static double size_of(const CellTree& tree, std::uint32_t number) {
    const Bounds& box = tree.node(number).cell.box;
    return largest_component(box.upper - box.lower);
  }

  void add(std::uint32_t number_a, std::uint32_t number_b) {
    const CellTree::Node& a = a_.node(number_a);
    const CellTree::Node& b = b_.node(number_b);
    const Vec3 way = way_between(a.cell.box, b.cell.box);
    const double apart = glm::length(way);
    const double off = distance_rounding * std::max(a.cell.box.farthest(), b.cell.box.farthest());
    // These directions say how near they may be: that between the boxes, that of the nearest pair
    // so far, which is the right one at once where edges or faces are parallel, and the normals.
    const Vec3 between =
        apart > 0 ? way : CellFrame(b.cell.box).middle - CellFrame(a.cell.box).middle;
    double least = apart;
    for (const Vec3& along : {glm::length(between) > 0 ? between : any_direction,
                              result_.on_b - result_.on_a, outward(a.look), -outward(b.look)}) {
      const double length = glm::length(along);
      if (!(length > 0)) continue;
      const Vec3 direction = along / length;
      const CellReach of_a = reach_of(a.cell.box, a.look, direction);
      if (of_a.most == -infinity) return;
      const CellReach of_b = reach_of(b.cell.box, b.look, -direction);
      if (of_b.most == -infinity) return;
      least = std::max(least, -of_a.most - of_b.most);
      if (least - off >= search_.most()) return;
      if (of_a.surely == -infinity || of_b.surely == -infinity) continue;
      offer(of_a.point, of_b.point, off);
      if (apart == 0) look_for_overlap(of_a.point, b.object);
    }
    least -= off;
    if (a.look.is_open() || b.look.is_open()) {
      search_.add({number_a, number_b, std::max(0.0, least)});
    } else {
      const Vec3 on_a = nearest_in(a.cell.box, b.cell.box);
      offer(on_a, on_a + way, off);
      search_.leave(std::max(0.0, apart - off));
      if (apart == 0) look_for_overlap(on_a, b.object);
    }
  }
  /// Returns a normal out of the solid in a cell that a single face crosses, or else 0.
  static Vec3 outward(const CellLook& look) {
    if (look.kind != CellLook::Kind::crossed || look.faces.size() != 1) return {0, 0, 0};
    const Vec3 slope = middle_of(look.faces.front().slopes);
    return look.is_inside(1) ? slope : -slope;
  }
  /// Says that two points are surely of the solids. If they are the nearest so far, nearer ones are
  /// looked for beside them, in the one solid and in the other by turns.
  void offer(const Vec3& on_a, const Vec3& on_b, double off) {
    if (!take(on_a, on_b, glm::length(on_b - on_a) + off)) return;
    constexpr int most_looks_beside = 64;
    while (looks_beside_ < most_looks_beside) {
      ++looks_beside_;
      const bool beside_b = looks_beside_ % 2 == 0;
      const Vec3& from = beside_b ? result_.on_a : result_.on_b;
      const NearestPoint nearest = (beside_b ? near_b_ : near_a_).find(from);
      if (!(nearest.distance.upper > 0)) return;
      const double before = search_.most();
      if (beside_b) {
        if (!take(from, nearest.point, nearest.distance.upper)) return;
      } else {
        if (!take(nearest.point, from, nearest.distance.upper)) return;
      }
      if (before - search_.most() < 0.1 * width_of(search_.most(), size_, options_)) return;
    }
  }
  /// Takes some pair of points, if time ended the search before one was known.
  void offer_any() {
    const Vec3 from = CellFrame(b_.node(0).cell.box).middle;
    const NearestPoint of_a = near_a_.find(from);
    const Vec3 on_a = of_a.distance.upper > 0 ? of_a.point : from;
    const NearestPoint of_b = near_b_.find(on_a);
    const bool is_apart = of_b.distance.upper > 0;
    take(on_a, is_apart ? of_b.point : on_a, is_apart ? of_b.distance.upper : 0);
  }
  bool take(const Vec3& on_a, const Vec3& on_b, double distance) {
    // The point that is in both stays.
    if (result_.overlap || !search_.offer(distance)) return false;
    result_.on_a = on_a;
    result_.on_b = on_b;
    return true;
  }
  /// Returns a point of a box that is nearest to another box.
  static Vec3 nearest_in(const Bounds& box, const Bounds& to) {
    const Vec3 middle = 0.5 * glm::max(box.lower, to.lower) + 0.5 * glm::min(box.upper, to.upper);
    return glm::clamp(middle, box.lower, box.upper);
  }
  void look_for_overlap(const Vec3& point_of_a, std::uint32_t object) {
    const CellSolid& solid = solids_b_[object];
    if (solid.look(solid.cell({point_of_a, point_of_a})).kind != CellLook::Kind::full) return;
    result_.overlap = true;
    result_.on_a = point_of_a;
    result_.on_b = point_of_a;
  }

  std::span<const CellSolid> solids_b_;
  CellTree a_;
  CellTree b_;
  const MeasureOptions& options_;
  MeasureClock& clock_;
  PointSearch near_a_;
  PointSearch near_b_;
  int looks_beside_ = 0;
  double size_;
  NearestSearch<OpenPair> search_;
  Clearance result_;
};

/// Finds an inner point of a solid, from its largest cells on. What merely touches has none, and is
/// left after many cells.
std::optional<Vec3> inner_point(const EntityCells& entity, MeasureClock& clock) {
  std::vector<std::pair<const CellSolid*, Cell>> cells;
  for (const CellSolid& solid : entity.solids())
    cells.emplace_back(&solid, solid.cell(first_box(solid.bounds())));
  for (std::size_t i = 0; i < cells.size() && !clock.is_over(); ++i) {
    const auto [solid, cell] = cells[i];
    clock.count(cell.program->leaves.size() + looks_of_cell);
    const CellLook look = solid->look(cell);
    if (look.kind == CellLook::Kind::full) return CellFrame(cell.box).middle;
    if (!look.is_open() || cells.size() >= most_cells_of_search) continue;
    const std::vector<Bounds> parts = halves_of(cell.box);
    if (parts.size() == 1) continue;
    for (const Bounds& part : parts)
      cells.emplace_back(solid, Cell{part, look.program ? look.program : cell.program});
  }
  return {};
}

/// Says whether solids that are at no distance overlap.
void look_for_overlap(const Entity& a, const Entity& b, MeasureClock& clock, Clearance& found) {
  if (found.overlap || found.distance.lower > 0) return;
  const std::optional<Vec3> common = inner_point(EntityCells(a ^ b), clock);
  if (common) found = {.distance = {0, 0}, .on_a = *common, .on_b = *common, .overlap = true};
}

[[noreturn]] void throw_no_points() {
  throw Error(ErrorCode::invalid_argument, "a solid without points is at no distance");
}

}  // namespace

}  // namespace core

void nearest_points(const Entity& entity, std::span<const Vec3> points,
                    std::span<NearestPoint> nearest, const MeasureOptions& options) {
  core::validate(options);
  core::check_points(points, nearest.size(), "nearest");
  core::measured([&] {
    const core::EntityCells cells(entity);
    cells.check_bounded();
    if (!cells.has_points()) core::throw_no_points();
    core::MeasureClock clock(options);
    constexpr std::size_t points_of_task = 64;
    core::for_ranges(points.size(), points_of_task, clock.workers(),
                     [&](std::size_t begin, std::size_t end) {
                       core::PointSearch search(cells, options, clock);
                       for (std::size_t i = begin; i < end; ++i)
                         nearest[i] = search.find(points[i]);
                     });
    clock.count(0);
  });
}

NearestPoint nearest_point(const Entity& entity, const Vec3& point, const MeasureOptions& options) {
  NearestPoint nearest;
  nearest_points(entity, std::span(&point, 1), std::span(&nearest, 1), options);
  return nearest;
}

Clearance clearance(const Entity& a, const Entity& b, const MeasureOptions& options) {
  core::validate(options);
  return core::measured([&] {
    const core::EntityCells cells_a(a);
    const core::EntityCells cells_b(b);
    cells_a.check_bounded();
    cells_b.check_bounded();
    if (!cells_a.has_points() || !cells_b.has_points()) core::throw_no_points();
    core::MeasureClock clock(options);
    Clearance found = core::PairSearch(cells_a, cells_b, options, clock).run();
    core::look_for_overlap(a, b, clock, found);
    return found;
  });
}

std::vector<Overlap> interference(std::span<const Entity> entities, const MeasureOptions& options) {
  core::validate(options);
  std::vector<BoundingBox> boxes;
  MeasureOptions rough = options;
  rough.relative_width = 1e-3;
  for (const Entity& entity : entities) boxes.push_back(tight_bounding_box(entity, rough));
  std::vector<Overlap> overlaps;
  const auto touch = [&](std::size_t i, std::size_t j) {
    return core::Bounds{boxes[i].lower, boxes[i].upper}.touches({boxes[j].lower, boxes[j].upper});
  };
  for (std::size_t i = 0; i < entities.size(); ++i) {
    if (!entities[i].is_solid()) continue;
    for (std::size_t j = i + 1; j < entities.size(); ++j) {
      if (!entities[j].is_solid() || !touch(i, j)) continue;
      const Interval common = volume(entities[i] ^ entities[j], options);
      // What rounding leaves open of parts that touch is no overlap.
      const Vec3 size = glm::min(boxes[i].upper - boxes[i].lower, boxes[j].upper - boxes[j].lower);
      constexpr double rounding = 1e-12;
      if (common.upper > rounding * size.x * size.y * size.z)
        overlaps.push_back({.first = i, .second = j, .volume = common});
    }
  }
  return overlaps;
}

}  // namespace crt
