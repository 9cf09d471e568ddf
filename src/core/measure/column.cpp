#include "core/measure/column.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "core/measure/column_faces.hpp"
#include "core/measure/square_pieces.hpp"

namespace crt::core {

namespace {

class Column {
 public:
  Column(const CellSolid& solid, const Bounds& box, const CellLook& look,
         const MassQuestion& question, int axis)
      : solid_(solid), look_(look), question_(question), frame_(box, axis) {}

  /// Finds walls and heights. Returns false if a face is neither.
  bool find_faces() {
    if (!faces_.find(solid_, look_, frame_, 0.25 * question_.height_tolerance)) return false;
    for (const ColumnHeight& height : faces_.heights) error_of_heights_ += height.place.error;
    return true;
  }

  MassPart mass() {
    make_levels();
    cut_square();
    MassPart part;
    level_sums_.resize(levels_.size());
    for (const SquarePiece& piece : pieces_) add_piece(piece);
    sum_up_levels();
    const Interval scale = frame_.side(frame_.a) * frame_.side(frame_.b) * Interval::of(0.25);
    const auto sum_of = [&](std::size_t quantity, double most) {
      const double off = sums_off_[quantity] + in_doubt_ * most;
      return Interval{sum_down(sums_[quantity] - off), sum_up(sums_[quantity] + off)} * scale;
    };
    const Interval whole = frame_.side(frame_.a) * frame_.side(frame_.b) * frame_.side(frame_.c);
    const Interval volume = sum_of(0, 1);
    part.volume = {std::max(0.0, volume.lo), std::min(whole.hi, volume.hi)};
    if (question_.with_moments) {
      std::array<double, 3> farthest;
      for (int axis = 0; axis < 3; ++axis) {
        farthest[at(axis)] =
            rounded_up(std::abs(frame_.frame.middle[axis] - question_.reference[axis]) +
                       frame_.frame.half[axis]);
      }
      for (int axis : {frame_.a, frame_.b, frame_.c})
        part.first[at(axis)] = sum_of(1 + at(axis), farthest[at(axis)]);
      for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = moment_pairs[k];
        part.second[k] = sum_of(4 + k, farthest[i] * farthest[j]);
      }
    }
    return part;
  }

  /// Encloses the area of the heights, of what is surface of the solid. It has no upper end where
  /// one may be too steep.
  Interval area() const {
    Interval sum{0, 0};
    const Interval scale = frame_.side(frame_.a) * frame_.side(frame_.b) * Interval::of(0.25);
    std::vector<PatchSeries> slants(levels_.size());
    for (const ColumnHeight& height : faces_.heights) {
      if (!look_.faces[height.face].is_surface) continue;
      const PatchSeries& slant = slants[level_of(height)] = slant_of(solid_, look_, frame_, height);
      const Interval range = range_of(slant);
      if (!std::isfinite(range.magnitude())) return {0, infinity};
      const LevelSums& sums = level_sums_[level_of(height)];
      const double seen = integral_of(slant, sums.seen);
      const double off = (slant.error + rounding * range.magnitude()) * sums.area +
                         std::min(areas_in_doubt_[level_of(height)], 4.0) * range.magnitude();
      const Interval of_height = Interval{sum_down(seen - off), sum_up(seen + off)} * scale;
      sum = sum + Interval{std::max(0.0, of_height.lo), std::max(0.0, of_height.hi)};
    }
    for (const Exchange& exchange : exchanges_) {
      const PatchSeries change = slants[exchange.first] - slants[exchange.second];
      const double off = exchange.area * range_of(change).magnitude();
      const Interval all = sum + Interval{-off, off} * scale;
      sum = {std::max(0.0, all.lo), all.hi};
    }
    return sum;
  }
  /// Encloses the area of the walls, of what is surface of the solid.
  Interval area_of_walls() const {
    // Gauss' rule with four points is exact for the degree of a series.
    constexpr std::array<std::array<double, 2>, 4> rule = {
        {{0.0694318442029737124, 0.173927422568726929},
         {0.330009478207571868, 0.326072577431273071},
         {0.669990521792428132, 0.326072577431273071},
         {0.930568155797026288, 0.173927422568726929}}};
    double sum = 0;
    double off = wall_off_;
    const double height = rounded_up(frame_.box.upper[frame_.c] - frame_.box.lower[frame_.c]);
    for (const WallSegment& segment : segments_) {
      const ColumnWall& wall = faces_.walls[segment.wall];
      if (!look_.faces[wall.face].is_surface) continue;
      const double length = length_of(segment);
      const auto is_surface_of_wall = [&](std::uint32_t m) {
        return (wall.surface >> m & 1U) != 0;
      };
      for_each_level(segment.at(0.5), segment.negative, is_surface_of_wall,
                     [&](std::size_t level, bool below, bool above) {
                       if (below == above) return;
                       double mean = 0;
                       for (const auto& [share, weight] : rule) {
                         const Vec3 place = segment.at(share);
                         mean += weight * value_at(levels_[level], place.x, place.y);
                       }
                       sum += (below ? 1 : -1) * length * (mean - frame_.frame.middle[frame_.c]);
                       off += length * (levels_[level].error + rounding * height);
                     });
    }
    for (const ColumnWall& wall : faces_.walls) {
      if (!look_.faces[wall.face].is_surface) continue;
      // If the wall is off, its line may leave the square, or come in.
      const Vec3& slope = wall.function.slope;
      const double steepest = std::max(std::abs(slope.x), std::abs(slope.y));
      const double longest = rounded_up(frame_.box.upper[frame_.a] - frame_.box.lower[frame_.a]) +
                             rounded_up(frame_.box.upper[frame_.b] - frame_.box.lower[frame_.b]);
      const double flat = std::min(std::abs(slope.x), std::abs(slope.y));
      const bool may_lie_in_side = flat <= wall.error && std::abs(std::abs(wall.function.value) -
                                                                  steepest) <= 2 * wall.error;
      off += (may_lie_in_side ? 1 : std::min(1.0, 4 * wall.error / steepest)) * longest * height;
    }
    off += rounding * std::abs(sum);
    return {std::max(0.0, sum_down(sum - off)), sum_up(sum + off)};
  }

 private:
  /// This bounds the roundings of cuts and of sums over the pieces.
  static constexpr double rounding = 0x1p-44;

  /// Computes what is below each height, and below the ends of the column, for all that is asked.
  void make_levels() {
    PatchSeries lower = PatchSeries::of(Interval::of(frame_.box.lower[frame_.c]));
    PatchSeries upper = PatchSeries::of(Interval::of(frame_.box.upper[frame_.c]));
    levels_ = {lower};
    for (const ColumnHeight& height : faces_.heights) levels_.push_back(height.place);
    levels_.push_back(upper);
    const std::size_t count = question_.with_moments ? 10 : 1;
    const auto relative = [&](const PatchSeries& x, int axis) {
      return x - Interval::of(question_.reference[axis]);
    };
    const PatchSeries a = relative(frame_.across(frame_.a), frame_.a);
    const PatchSeries b = relative(frame_.across(frame_.b), frame_.b);
    for (const PatchSeries& level : levels_) {
      std::vector<PatchSeries>& below = below_.emplace_back(count);
      // Heights are relative to the middle of the column, so that nothing large cancels.
      below[0] = level - Interval::of(frame_.frame.middle[frame_.c]);
      if (!question_.with_moments) continue;
      const PatchSeries c = relative(level, frame_.c);
      const PatchSeries half = square(c) * Interval::of(0.5);
      const PatchSeries a_below = a * below[0];
      const PatchSeries b_below = b * below[0];
      below[1 + at(frame_.a)] = a_below;
      below[1 + at(frame_.b)] = b_below;
      below[1 + at(frame_.c)] = half;
      const auto second = [&](int i, int j) -> PatchSeries& {
        return below[4 + (i == j ? at(i) : i + j == 1 ? 3 : i + j == 3 ? 4 : 5)];
      };
      second(frame_.a, frame_.a) = a * a_below;
      second(frame_.b, frame_.b) = b * b_below;
      second(frame_.a, frame_.b) = a * b_below;
      second(frame_.a, frame_.c) = a * half;
      second(frame_.b, frame_.c) = b * half;
      second(frame_.c, frame_.c) = square(c) * c * (Interval::of(1) / Interval::of(3));
    }
  }

  /// An Exchange is a wall in which two heights meet, the one of which is surface on its one side
  /// and the other on the other. It has the area of the square that may be on either side.
  struct Exchange {
    std::size_t first = 0;
    std::size_t second = 0;
    double area = 0;
  };

  /// A Crossing is where two levels may cross, or the one may pass an end, in a part of the square.
  struct Crossing {
    PatchSeries difference;
    std::size_t first = 0;
    std::size_t second = 0;
    NearlyLinear line{difference};

    /// Returns how much of a part may be on either side of the line.
    double area_in_doubt_of(const SquarePart& part) const {
      return area_in_doubt(line.function, line.error) * part.size * part.size;
    }
  };
  /// Returns whether it may matter which of two levels is above the other.
  bool may_matter(std::size_t lower, std::size_t upper) const {
    const std::size_t last = levels_.size() - 1;
    if (lower == 0 || upper == last) return lower > 0 || upper < last;
    return order_matters(look_, look_.inside, faces_.heights[lower - 1], faces_.heights[upper - 1]);
  }
  /// Returns whether it may matter for the area of walls alone. If the two are so near to each
  /// other that it is little, that is added to what is not known.
  bool may_matter_to_walls(std::size_t lower, std::size_t upper) {
    if (!question_.with_area || lower == 0 || upper == levels_.size() - 1) return false;
    const auto is_any = std::ranges::any_of(faces_.walls, [&](const ColumnWall& wall) {
      return order_matters(look_, wall.surface, faces_.heights[lower - 1],
                           faces_.heights[upper - 1]);
    });
    if (!is_any) return false;
    const double a = rounded_up(frame_.box.upper[frame_.a] - frame_.box.lower[frame_.a]);
    const double b = rounded_up(frame_.box.upper[frame_.b] - frame_.box.lower[frame_.b]);
    const double off = static_cast<double>(faces_.walls.size()) * (a + b) *
                       range_of(levels_[upper] - levels_[lower]).magnitude();
    if (off > question_.area_tolerance * (a * b)) return true;
    wall_off_ += off * (1 + 0x1p-40);
    return false;
  }
  /// Cuts the square where walls are, and where levels cross.
  void cut_square() {
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      for (std::size_t j = i + 1; j < levels_.size(); ++j) {
        if (may_matter(i, j) || may_matter_to_walls(i, j))
          crossings.push_back({levels_[j] - levels_[i], i, j});
      }
    }
    areas_in_doubt_.assign(levels_.size(), 0);
    for (const ColumnWall& wall : faces_.walls) doubt_wall(wall);
    cut_part({}, std::move(crossings), 0);
  }
  /// Adds what is in doubt since a wall may be off.
  void doubt_wall(const ColumnWall& wall) {
    const double area = area_in_doubt(wall.function, wall.error);
    const double height = rounded_up(frame_.box.upper[frame_.c] - frame_.box.lower[frame_.c]);
    const auto is_within = [&](std::size_t level) {
      const Interval range = range_of(levels_[level]);
      return range.lo > frame_.box.lower[frame_.c] && range.hi < frame_.box.upper[frame_.c];
    };
    for (std::size_t first = 1; first + 1 < levels_.size(); ++first) {
      for (std::size_t second = first + 1; second + 1 < levels_.size(); ++second) {
        if (!is_within(first) || !is_within(second)) continue;
        if (!only_exchanges(look_, wall, faces_.heights[first - 1], faces_.heights[second - 1]))
          continue;
        in_doubt_ +=
            area * std::min(height, range_of(levels_[second] - levels_[first]).magnitude());
        return exchanges_.push_back({first, second, area});
      }
    }
    in_doubt_ += area * height;
    for (double& sum : areas_in_doubt_) sum += area;
  }
  /// Divides a part until it matters no more where levels cross in it. It matters twice: what is on
  /// the wrong side of the line is so little because the two levels are so near there.
  void cut_part(const SquarePart& part, std::vector<Crossing>&& crossings, int depth) {
    double volume = 0;
    double area = 0;
    std::erase_if(crossings, [&](const Crossing& crossing) {
      const double doubt = crossing.area_in_doubt_of(part);
      volume += doubt * (2 * crossing.line.error);
      area += doubt;
      return doubt == 0;
    });
    const double square = 4 * part.size * part.size;
    const bool is_enough =
        volume <= std::max(0.25 * error_of_heights_, question_.height_tolerance) * square &&
        (!question_.with_area || area <= question_.area_tolerance * square);
    const int deepest = question_.with_area ? 6 : 3;
    if (is_enough || depth == deepest) {
      in_doubt_ += volume * (1 + 0x1p-40);
      cut_triangles(part, crossings);
      return;
    }
    for (const double s : {-0.5, 0.5}) {
      for (const double t : {-0.5, 0.5}) {
        std::vector<Crossing> inner;
        inner.reserve(crossings.size());
        for (const Crossing& crossing : crossings)
          inner.push_back(
              {part_of(crossing.difference, s, t, 0.5), crossing.first, crossing.second});
        cut_part({part.s + s * part.size, part.t + t * part.size, 0.5 * part.size},
                 std::move(inner), depth + 1);
      }
    }
  }
  void cut_triangles(const SquarePart& part, const std::vector<Crossing>& crossings) {
    if (crossings.empty() && faces_.walls.empty())
      return pieces_.push_back({.part = part, .is_whole = true});
    std::vector<SquarePiece> pieces = {
        {.part = part, .triangle = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)}},
        {.part = part, .triangle = {Vec3(-1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}}};
    const Vec3 middle(part.s, part.t, 0);
    for (const ColumnWall& wall : faces_.walls) {
      cut_pieces({wall.function.at(middle), wall.function.slope * part.size}, 1U << wall.face,
                 pieces);
    }
    for (const Crossing& crossing : crossings) {
      cut_pieces(crossing.line.function, 0, pieces);
      const double doubt = crossing.area_in_doubt_of(part);
      areas_in_doubt_[crossing.first] += doubt;
      areas_in_doubt_[crossing.second] += doubt;
    }
    for (SquarePiece& piece : pieces) {
      for (Vec3& corner : piece.triangle) corner = middle + part.size * corner;
      pieces_.push_back(piece);
    }
    if (question_.with_area) cut_walls(part, crossings);
  }
  /// Finds the segments of walls in a part of the square, without those where levels cross.
  void cut_walls(const SquarePart& part, const std::vector<Crossing>& crossings) {
    const Vec3 middle(part.s, part.t, 0);
    double most_error = 0;
    for (const Crossing& crossing : crossings) most_error += 2 * crossing.line.error;
    for (std::size_t i = 0; i < faces_.walls.size(); ++i) {
      std::vector<WallSegment> segments = line_in(part, faces_.walls[i].function, i);
      if (segments.empty()) continue;
      for (std::size_t j = 0; j < faces_.walls.size(); ++j)
        if (j != i) cut_segments(faces_.walls[j].function, 1U << faces_.walls[j].face, segments);
      for (const Crossing& crossing : crossings) {
        const LinearFunction& line = crossing.line.function;
        const Vec3 slope = line.slope * (1 / part.size);
        cut_segments({line.value - glm::dot(slope, middle), slope}, 0, segments);
      }
      for (const WallSegment& segment : segments) {
        wall_off_ += length_of(segment) * most_error;
        segments_.push_back(segment);
      }
    }
  }
  /// Returns the length of a segment in the world.
  double length_of(const WallSegment& segment) const {
    const Vec3 way = segment.to - segment.from;
    const double a = way.x * 0.5 * (frame_.box.upper[frame_.a] - frame_.box.lower[frame_.a]);
    const double b = way.y * 0.5 * (frame_.box.upper[frame_.b] - frame_.box.lower[frame_.b]);
    return std::sqrt(a * a + b * b);
  }

  /// Calls f(level, is_inside_below, is_inside_above) for levels from one end of the column to the
  /// other, as they lie over a piece.
  template <class F>
  void for_each_level(const SquarePiece& piece, const F& f) const {
    for_each_level(
        piece.middle(), piece.negative,
        [&](std::uint32_t states) { return look_.is_inside(states); }, f);
  }
  /// Does so at a place, for any function of the faces that are negative.
  template <class Inside, class F>
  void for_each_level(const Vec3& middle, std::uint32_t negative, const Inside& is_inside,
                      const F& f) const {
    std::vector<std::pair<double, std::size_t>> order;
    const double lower = frame_.box.lower[frame_.c];
    for (std::size_t i = 0; i < faces_.heights.size(); ++i) {
      const double place = value_at(faces_.heights[i].place, middle.x, middle.y);
      const bool is_above_lower = place > lower;
      if (is_above_lower == faces_.heights[i].grows) negative |= 1U << faces_.heights[i].face;
      if (is_above_lower && place < frame_.box.upper[frame_.c]) order.emplace_back(place, i);
    }
    std::sort(order.begin(), order.end());
    f(std::size_t{0}, false, is_inside(negative));
    for (const auto& [place, i] : order) {
      const bool below = is_inside(negative);
      negative ^= 1U << faces_.heights[i].face;
      f(i + 1, below, is_inside(negative));
    }
    f(levels_.size() - 1, is_inside(negative), false);
  }

  /// LevelSums are over the pieces where the solid differs above and below a level.
  struct LevelSums {
    SquareMoments below{};  ///< less those where it is above
    SquareMoments seen{};   ///< all of them
    double area = 0;
  };
  void add_piece(const SquarePiece& piece) {
    const double area = piece.area();
    std::optional<SquareMoments> moments_there;
    for_each_level(piece, [&](std::size_t level, bool inside_below, bool inside_above) {
      if (inside_below == inside_above) return;
      if (!moments_there) moments_there = moments_of(piece);
      const SquareMoments& moments = *moments_there;
      LevelSums& sums = level_sums_[level];
      const double sign = inside_below ? 1 : -1;
      for (std::size_t i = 0; i < moments.size(); ++i) {
        sums.below[i] += sign * moments[i];
        sums.seen[i] += moments[i];
      }
      sums.area += area;
    });
  }
  void sum_up_levels() {
    for (std::size_t level = 0; level < levels_.size(); ++level) {
      const LevelSums& sums = level_sums_[level];
      for (std::size_t k = 0; k < below_[level].size(); ++k) {
        const PatchSeries& below = below_[level][k];
        sums_[k] += integral_of(below, sums.below);
        sums_off_[k] +=
            (below.error + rounding * (std::abs(below.terms[0]) + below.spread())) * sums.area;
      }
    }
  }

  std::size_t level_of(const ColumnHeight& height) const {
    return static_cast<std::size_t>(&height - faces_.heights.data()) + 1;
  }

  const CellSolid& solid_;
  const CellLook& look_;
  const MassQuestion& question_;
  ColumnFrame frame_;
  ColumnFaces faces_;
  std::vector<PatchSeries> levels_;              ///< the lower end, the heights, the upper end
  std::vector<std::vector<PatchSeries>> below_;  ///< each level's integrals along the column
  std::vector<SquarePiece> pieces_;
  std::vector<LevelSums> level_sums_;
  std::vector<WallSegment> segments_;
  double wall_off_ = 0;  ///< how far off the areas of walls may be where levels cross
  double error_of_heights_ = 0;
  double in_doubt_ = 0;  ///< the volume, over the square, that may be on either side of a line
  std::vector<double> areas_in_doubt_;  ///< and the area of the square, by level
  std::vector<Exchange> exchanges_;     ///< whose areas are not in it
  std::array<double, 10> sums_{};
  std::array<double, 10> sums_off_{};
};

}  // namespace

std::optional<CellMass> column_mass(const CellSolid& solid, const Bounds& box, const CellLook& look,
                                    const MassQuestion& question) {
  const int axis = column_axis_of(look, CellFrame(box).half);
  constexpr std::size_t most_faces = 3;
  if (axis < 0 || look.faces.size() > most_faces) return {};
  Column column(solid, box, look, question, axis);
  if (!column.find_faces()) return {};
  CellMass result{.part = column.mass(), .column_axis = axis};
  if (question.with_area) {
    result.part.area = column.area() + column.area_of_walls();
  }
  return result;
}

}  // namespace crt::core
