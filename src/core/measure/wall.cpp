// The thinnest wall of a solid: the shortest chord in it that is normal to the surface at both
// ends.
//
// Pairs of cells of the surface are kept, those first whose walls may be thinnest. A pair is
// dropped if no normals of its faces are opposite along any way between them. Chords that are
// surely there are found along normals from places in the pairs, and bound the answer from above.
//
// Tests: tests/measure/wall_test.cpp
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "core/geometry/face_functions.hpp"
#include "core/math/float_environment.hpp"
#include "core/measure/cell_tree.hpp"
#include "core/measure/line_runs.hpp"
#include "core/measure/measure_clock.hpp"
#include "core/measure/nearest.hpp"
#include "core/measure/wall_faces.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"

namespace crt {

namespace core {

namespace {

/// A chord begins along a normal to so many radians, as rounding does not let it be exact.
constexpr double exact_angle = 1e-5;

/// Features of this share of the solid's size (half of its box's diagonal) are not looked at: a
/// face that is narrower, and what is as near to a point without a normal. Where faces are tangent,
/// nothing tells them from what is left between them by rounding.
constexpr double smallest_feature = 0x1p-20;

/// The search is left after so many pairs: some seconds.
constexpr std::size_t most_pairs_of_walls = std::size_t{1} << 19U;

/// A chord takes as long to find as many pairs take to be looked at. So there are so many at first,
/// and then one for so many pairs.
constexpr std::size_t most_chords_at_first = 256;
constexpr std::size_t steps_of_chord = 256;

/// The ends of chords are known to this share of the longest that is looked for.
constexpr double ends_of_chords = 0x1p-36;

/// A Chord is a piece of a line in a solid from side to side.
struct Chord {
  double length = infinity;  ///< an upper bound
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 0};
};

/// Finds chords of one solid that are walls.
class ChordFinder {
 public:
  ChordFinder(const CellSolid& solid, const WallAngle& angle, MeasureClock& clock)
      : solid_(solid), angle_(angle), clock_(clock) {}

  /// Returns the wall that begins near a place on a face, unless it is longer than `most`.
  std::optional<Chord> find(const CellFace& face, bool is_turned, const Vec3& near,
                            double most) const {
    Vec3 place = near;
    Vec3 slope{0, 0, 0};
    constexpr int steps = 4;
    for (int i = 0; i < steps; ++i) {
      const Jet jet = solid_.value(face, jets_of(known_point(place)));
      slope = middle_of(jet.slope);
      const double size = largest_component(slope);
      if (!(size > 0) || !std::isfinite(size)) return {};
      const Vec3 scaled = slope / size;
      place -= scaled * (jet.value.middle() / size / glm::dot(scaled, scaled));
    }
    if (!Bounds{place, place}.finite()) return {};
    return along(place, is_turned ? slope : -slope, most);
  }

 private:
  std::optional<Chord> along(const Vec3& place, const Vec3& direction, double most) const {
    const SolidLine line(place, direction);
    const double outside = 0x1p-20 * most;
    const std::vector<LineRun> runs =
        runs_of_line(solid_, line, -outside, most, clock_, ends_of_chords * most);
    for (std::size_t i = 1; i + 1 < runs.size(); ++i) {
      if (runs[i].kind != LineRun::Kind::full) continue;
      const LineRun& first = runs[i - 1];
      const LineRun& last = runs[i + 1];
      // The piece at the place is wanted, and it must be known to begin and to end.
      if (first.from > outside) break;
      const bool ends = i >= 2 && i + 2 < runs.size() && runs[i - 2].kind == LineRun::Kind::empty &&
                        runs[i + 2].kind == LineRun::Kind::empty;
      if (!ends) return {};
      const double begins_off = angle_off(line, first, true);
      const double ends_off = angle_off(line, last, false);
      if (std::min(begins_off, ends_off) > angle_.exact ||
          std::max(begins_off, ends_off) > angle_.loose)
        return {};
      return Chord{.length = rounded_up(last.to - first.from),
                   .from = line.at(0.5 * first.from + 0.5 * first.to),
                   .to = line.at(0.5 * last.from + 0.5 * last.to)};
    }
    return {};
  }

  /// Returns a bound on how far a line is off the normal where it passes the surface.
  double angle_off(const SolidLine& line, const LineRun& run, bool enters) const {
    const Bounds box = line.box(run.from, run.to);
    const CellLook look = solid_.look(solid_.cell(box));
    const std::vector<WallFace> faces = wall_faces_of(look, CellFrame(box).half, 0);
    if (faces.size() != 1) return infinity;
    Directions way = directions_of(line.unit());
    if (enters) way.middle = -way.middle;
    return most_angle(faces.front().outward, way);
  }

  const CellSolid& solid_;
  WallAngle angle_;
  MeasureClock& clock_;
};

class WallSearch {
 public:
  WallSearch(const EntityCells& entity, const WallOptions& options)
      : solids_(entity.solids()),
        tree_(entity),
        options_(options),
        clock_(options.measure),
        size_(glm::length(CellFrame(entity.bounds()).half)) {
    const double loose = options.angle * std::numbers::pi / 180;
    angle_ = {.exact = exact_angle, .loose = std::max(exact_angle, loose)};
  }

  Wall run() {
    for (std::uint32_t i = 0; i < tree_.root_count(); ++i) add(i, i);
    while (!search_.is_done(wanted_width()) && !clock_.is_over()) {
      const OpenPair open = search_.next();
      if (++steps_ > most_pairs_of_walls) {
        search_.leave(open.least);
        break;
      }
      if (is_blocked(open)) continue;
      look_for_chord(open);
      divide(open);
    }
    return {.thickness = {search_.least(), search_.most()}, .from = best_.from, .to = best_.to};
  }

 private:
  double wanted_width() const {
    constexpr double rounding = 0x1p-40;
    return std::max(options_.measure.relative_width * search_.least(), rounding * size_);
  }

  static double side_of(const Bounds& box) { return largest_component(box.upper - box.lower); }

  void divide(const OpenPair& open) {
    const double apart = glm::length(CellFrame(tree_.node(open.a).cell.box).middle -
                                     CellFrame(tree_.node(open.b).cell.box).middle);
    const bool divides_a = left_open_by(open.a, apart) >= left_open_by(open.b, apart);
    const std::uint32_t number = divides_a ? open.a : open.b;
    const std::uint32_t other = divides_a ? open.b : open.a;
    tree_.divide(number);
    const std::uint32_t first = tree_.node(number).first_part;
    const std::uint32_t count = tree_.node(number).part_count;
    clock_.count(tree_.take_looks() + count);
    if (count == 0) search_.leave(open.least);
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (open.a != open.b) add(i, other);
      for (std::uint32_t k = i; open.a == open.b && k < first + count; ++k) add(i, k);
    }
  }

  /// Returns how much a node leaves open of the angles between a wall and its sides, in radians, by
  /// its normals and by its size. So what is far from the apex of a cone is not divided with it.
  double left_open_by(std::uint32_t number, double apart) {
    double spread = 0;
    for (const WallFace& face : faces_of(number)) spread = std::max(spread, face.outward.spread);
    return apart > 0 ? spread + side_of(tree_.node(number).cell.box) / apart : spread;
  }

  /// Adds a pair if there may be a wall between its faces.
  void add(std::uint32_t number_a, std::uint32_t number_b) {
    const CellTree::Node& a = tree_.node(number_a);
    const CellTree::Node& b = tree_.node(number_b);
    if (!may_have_sides(a) || !may_have_sides(b)) return;
    const double apart = glm::length(way_between(a.cell.box, b.cell.box));
    if (apart >= search_.most()) return;
    const double off = distance_rounding * std::max(a.cell.box.farthest(), b.cell.box.farthest());
    double least = infinity;
    for (const WallFace& face_a : faces_of(number_a))
      for (const WallFace& face_b : faces_of(number_b))
        if (may_be_wall(a.cell.box, face_a, b.cell.box, face_b, angle_))
          least = std::min(least, least_between(a.cell.box, face_a, b.cell.box, face_b));
    if (least < infinity) search_.add({number_a, number_b, std::max(0.0, least - off)});
  }

  /// Says whether walls may begin or end in a node. Faces of which nothing is known meet in one
  /// point, or are of a solid that knows nothing anywhere.
  bool may_have_sides(const CellTree::Node& node) const {
    if (node.look.kind != CellLook::Kind::unknown) return node.look.is_open();
    return side_of(node.cell.box) > smallest_feature * size_ ||
           !std::isfinite(node.look.max_crossings);
  }

  /// Returns the faces of a node, which are found once. The list is there as long as the search.
  const std::vector<WallFace>& faces_of(std::uint32_t number) {
    const auto [place, is_new] = faces_.try_emplace(number);
    if (is_new) {
      const CellTree::Node& node = tree_.node(number);
      place->second =
          wall_faces_of(node.look, CellFrame(node.cell.box).half, smallest_feature * size_);
    }
    return place->second;
  }

  /// Says whether all ways between two cells pass a place that is outside of the solid.
  bool is_blocked(const OpenPair& open) const {
    const CellTree::Node& a = tree_.node(open.a);
    const Bounds& box_a = a.cell.box;
    const Bounds& box_b = tree_.node(open.b).cell.box;
    if (4 * std::max(side_of(box_a), side_of(box_b)) > open.least) return false;
    const CellSolid& solid = solids_[a.object];
    for (const double share : {0.5, 0.25, 0.75}) {
      const Bounds between{(1 - share) * box_a.lower + share * box_b.lower,
                           (1 - share) * box_a.upper + share * box_b.upper};
      const Vec3 off = Vec3(distance_rounding * std::max(box_a.farthest(), box_b.farthest()));
      if (solid.look(tree_.cell(a.object, {between.lower - off, between.upper + off})).kind ==
          CellLook::Kind::empty)
        return true;
    }
    return false;
  }

  /// Looks along the normals of a pair's faces from the middle of what is known of them.
  void look_for_chord(const OpenPair& open) {
    for (const std::uint32_t number : {open.a, open.b}) {
      const CellTree::Node& node = tree_.node(number);
      const ChordFinder finder(solids_[node.object], angle_, clock_);
      const CellFrame frame(node.cell.box);
      for (const WallFace& face : faces_of(number)) {
        // A face of a cell is asked once, and its parts are asked when the cell is divided.
        if (!(open.least < search_.most()) ||
            asked_.size() > most_chords_at_first + steps_ / steps_of_chord)
          return;
        if (face.face == nullptr) continue;
        if (!asked_.emplace(number, face.face->surface, face.is_turned).second) continue;
        offer(finder.find(*face.face, face.is_turned, middle_of(frame, *face.face), most()));
      }
      if (open.a == open.b) break;
    }
  }
  /// Returns how long chords may be that are of use.
  double most() const { return std::min(2 * size_, search_.most()); }

  static Vec3 middle_of(const CellFrame& frame, const CellFace& face) {
    const double square_of_slope = glm::dot(face.slope, face.slope);
    if (!(square_of_slope > 0)) return frame.middle;
    const Vec3 place = (-face.value / square_of_slope) * face.slope;
    return frame.middle + frame.half * glm::clamp(place, Vec3(-1), Vec3(1));
  }

  void offer(const std::optional<Chord>& chord) {
    if (chord && search_.offer(chord->length)) best_ = *chord;
  }

  std::span<const CellSolid> solids_;
  CellTree tree_;
  const WallOptions& options_;
  MeasureClock clock_;
  double size_;
  WallAngle angle_;
  std::size_t steps_ = 0;
  std::unordered_map<std::uint32_t, std::vector<WallFace>> faces_;  ///< of nodes
  std::set<std::tuple<std::uint32_t, std::uint64_t, bool>> asked_;  ///< nodes, surfaces, sides
  NearestSearch<OpenPair> search_;
  Chord best_;
};

}  // namespace

}  // namespace core

Wall least_wall(const Entity& entity, const WallOptions& options) {
  core::validate(options.measure);
  constexpr double largest_angle = 45;
  if (!(options.angle >= 0 && options.angle <= largest_angle))
    throw Error(ErrorCode::invalid_argument, "angle must be from 0 to 45 degrees", "angle");
  return core::measured([&] {
    const core::EntityCells cells(entity);
    cells.check_bounded();
    return core::WallSearch(cells, options).run();
  });
}

}  // namespace crt
