#include "core/measure/column.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/face_functions.hpp"
#include "core/measure/simplices.hpp"

namespace crt::core {

namespace {

using SeriesJet = JetOf<PatchSeries>;

std::size_t at(int axis) {
  return static_cast<std::size_t>(axis);
}

/// A Height is where a face is over the square across a column, s and t from -1 to 1.
struct Height {
  std::size_t face = 0;
  bool grows = false;  ///< its function is below 0 under it
  PatchSeries place;
};

/// A Wall is a face along the column: its function depends on s and t alone, but for `error`.
struct Wall {
  std::size_t face = 0;
  LinearFunction function;
  double error = 0;
};

/// A Part of the square is a square with a middle and half of a width.
struct Part {
  double s = 0;
  double t = 0;
  double size = 1;
};

/// A Piece of the square is a part of it, or a triangle in a part.
struct Piece {
  Part part;
  FlatTriangle triangle{};
  bool is_whole = false;       ///< it is the part
  std::uint32_t negative = 0;  ///< the walls whose functions are below 0

  Vec3 middle() const {
    if (is_whole) return {part.s, part.t, 0};
    return (triangle[0] + triangle[1] + triangle[2]) * (1.0 / 3);
  }
  double area() const {
    if (is_whole) return 4 * part.size * part.size;
    return std::abs(double_area(triangle).z) / 2;
  }
};

/// A Segment is a part of the line in which a wall meets the square.
struct Segment {
  std::size_t wall = 0;
  Vec3 from;
  Vec3 to;
  std::uint32_t negative = 0;  ///< the other walls whose functions are below 0

  Vec3 at(double share) const { return from + share * (to - from); }
};

/// A NearlyLinear is a series as a linear function, with what it may differ from that.
struct NearlyLinear {
  LinearFunction function;
  double error = 0;

  explicit NearlyLinear(const PatchSeries& a) : function{a.terms[0], {a.terms[1], a.terms[2], 0}} {
    // Of a square the half is nearest.
    for (const std::size_t place : {PatchSeries::place(2, 0), PatchSeries::place(0, 2)}) {
      function.value += 0.5 * a.terms[place];
      error += 0.5 * std::abs(a.terms[place]);
    }
    error += std::abs(a.terms[PatchSeries::place(1, 1)]);
    for (std::size_t i = 6; i < PatchSeries::term_count; ++i) error += std::abs(a.terms[i]);
    error = (error + a.error) * (1 + 0x1p-40) + 0x1p-50 * std::abs(function.value);
  }
};

/// Returns how much of the square a linear function is within an error of 0 in, at most.
double doubtful(const LinearFunction& function, double error) {
  const double across = std::abs(function.slope.x) + std::abs(function.slope.y);
  if (std::abs(function.value) - across > error) return 0;
  const double steepest = std::max(std::abs(function.slope.x), std::abs(function.slope.y));
  return error < steepest ? 4 * (error / steepest) * (1 + 0x1p-40) : 4;
}

/// Integrates a series over a piece of the square. The rule for triangles is exact for its degree,
/// 6 (Dunavant, High degree efficient symmetrical Gaussian quadrature rules for the triangle,
/// 1985).
double integral_over(const Piece& piece, const PatchSeries& series) {
  if (piece.is_whole)
    return integral_over_part(series, piece.part.s, piece.part.t, piece.part.size);
  const FlatTriangle& triangle = piece.triangle;
  static_assert(PatchSeries::degree <= 6);
  struct Place {
    double weight;
    std::array<double, 3> shares;
  };
  constexpr auto rule = [] {
    std::array<Place, 12> places{};
    std::size_t count = 0;
    const auto add = [&](double weight, double a, double b, double c) {
      places[count++] = {weight, {a, b, c}};
      places[count++] = {weight, {b, c, a}};
      places[count++] = {weight, {c, a, b}};
    };
    add(0.116786275726379, 0.501426509658179, 0.249286745170910, 0.249286745170910);
    add(0.050844906370207, 0.873821971016996, 0.063089014491502, 0.063089014491502);
    add(0.082851075618374, 0.053145049844817, 0.310352451033784, 0.636502499121399);
    add(0.082851075618374, 0.053145049844817, 0.636502499121399, 0.310352451033784);
    return places;
  }();
  double sum = 0;
  for (const auto& [weight, shares] : rule) {
    const Vec3 place = shares[0] * triangle[0] + shares[1] * triangle[1] + shares[2] * triangle[2];
    sum += weight * value_at(series, place.x, place.y);
  }
  return piece.area() * sum;
}

class Column {
 public:
  Column(const CellSolid& solid, const Bounds& box, const CellLook& look,
         const MassQuestion& question, int axis)
      : solid_(solid), box_(box), look_(look), question_(question), frame_(box), c_(axis) {}

  /// Finds walls and heights. Returns false if a face is neither.
  bool find_faces() {
    for (std::size_t i = 0; i < look_.faces.size(); ++i) {
      const CellFace& face = look_.faces[i];
      const double along = std::abs(face.slope[c_]) + face.error;
      const double across = std::max(std::abs(face.slope[a_]), std::abs(face.slope[b_]));
      if (along <= straight * across) {
        walls_.push_back({i, {face.value, {face.slope[a_], face.slope[b_], 0}}, along});
        continue;
      }
      if (face.slopes[at(c_)].contains(0) || !solid_.functions(face.leaf).has_series() ||
          !find_height(i))
        return false;
    }
    return !heights_.empty();
  }

  MassPart mass() {
    make_levels();
    cut_square();
    MassPart part;
    for (const Piece& piece : pieces_) add_piece(piece);
    const Interval scale = side(a_) * side(b_) * Interval::of(0.25);
    const auto sum_of = [&](std::size_t quantity, double most) {
      const double off = sums_off_[quantity] + in_doubt_ * most;
      return Interval{sum_down(sums_[quantity] - off), sum_up(sums_[quantity] + off)} * scale;
    };
    const Interval whole = side(a_) * side(b_) * side(c_);
    const Interval volume = sum_of(0, 1);
    part.volume = {std::max(0.0, volume.lo), std::min(whole.hi, volume.hi)};
    if (question_.with_moments) {
      std::array<double, 3> farthest;
      for (int axis = 0; axis < 3; ++axis) {
        farthest[at(axis)] = rounded_up(std::abs(frame_.middle[axis] - question_.reference[axis]) +
                                        frame_.half[axis]);
      }
      for (int axis : {a_, b_, c_}) part.first[at(axis)] = sum_of(1 + at(axis), farthest[at(axis)]);
      for (std::size_t k = 0; k < 6; ++k) {
        const auto [i, j] = moment_pairs[k];
        part.second[k] = sum_of(4 + k, farthest[i] * farthest[j]);
      }
    }
    return part;
  }

  /// Encloses the area of the heights, of what is surface of the solid.
  Interval area() const {
    Interval sum{0, 0};
    const Interval scale = side(a_) * side(b_) * Interval::of(0.25);
    for (const Height& height : heights_) {
      const PatchSeries slant = slant_of(height);
      const Interval range = range_of(slant);
      double seen = 0;
      double size = 0;
      for (const Piece& piece : pieces_) {
        if (!is_surface(piece, height)) continue;
        seen += integral_over(piece, slant);
        size += piece.area();
      }
      const double off = (slant.error + rounding * range.magnitude()) * size +
                         std::min(areas_in_doubt_[level_of(height)], 4.0) * range.magnitude();
      const Interval of_height = Interval{sum_down(seen - off), sum_up(seen + off)} * scale;
      sum = sum + Interval{std::max(0.0, of_height.lo), std::max(0.0, of_height.hi)};
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
    const double height = rounded_up(box_.upper[c_] - box_.lower[c_]);
    for (const Segment& segment : segments_) {
      const double length = length_of(segment);
      const std::uint32_t bit = 1U << walls_[segment.wall].face;
      const auto is_surface = [&](std::uint32_t states) {
        return look_.is_inside(states | bit) != look_.is_inside(states & ~bit);
      };
      for_each_level(segment.at(0.5), segment.negative, is_surface,
                     [&](std::size_t level, bool below, bool above) {
                       if (below == above) return;
                       double mean = 0;
                       for (const auto& [share, weight] : rule) {
                         const Vec3 place = segment.at(share);
                         mean += weight * value_at(levels_[level], place.x, place.y);
                       }
                       sum += (below ? 1 : -1) * length * (mean - frame_.middle[c_]);
                       off += length * (levels_[level].error + rounding * height);
                     });
    }
    for (const Wall& wall : walls_) {
      // If the wall is off, its line may leave the square, or come in.
      const Vec3& slope = wall.function.slope;
      const double steepest = std::max(std::abs(slope.x), std::abs(slope.y));
      const double longest =
          rounded_up(box_.upper[a_] - box_.lower[a_]) + rounded_up(box_.upper[b_] - box_.lower[b_]);
      const double flat = std::min(std::abs(slope.x), std::abs(slope.y));
      const bool may_lie_in_side = flat <= wall.error && std::abs(std::abs(wall.function.value) -
                                                                  steepest) <= 2 * wall.error;
      off += (may_lie_in_side ? 1 : std::min(1.0, 4 * wall.error / steepest)) * longest * height;
    }
    off += rounding * std::abs(sum);
    return {std::max(0.0, sum_down(sum - off)), sum_up(sum + off)};
  }

 private:
  /// A function that changes less along the column than this, relative to across, is a wall.
  static constexpr double straight = 0x1p-44;
  /// This bounds the roundings of cuts and of sums over the pieces.
  static constexpr double rounding = 0x1p-44;

  Interval side(int axis) const {
    return Interval::of(box_.upper[axis]) - Interval::of(box_.lower[axis]);
  }
  /// Returns a coordinate across the column.
  PatchSeries across(int axis) const {
    const double half = 0.5 * box_.upper[axis] - 0.5 * box_.lower[axis];
    PatchSeries x = axis == a_ ? PatchSeries::linear(frame_.middle[axis], half, 0)
                               : PatchSeries::linear(frame_.middle[axis], 0, half);
    x.error = 0x1p-52 * (std::abs(box_.lower[axis]) + std::abs(box_.upper[axis]));
    return x;
  }
  std::array<PatchSeries, 3> places_of(const PatchSeries& height) const {
    std::array<PatchSeries, 3> place;
    place[at(a_)] = across(a_);
    place[at(b_)] = across(b_);
    place[at(c_)] = height;
    return place;
  }

  bool find_height(std::size_t number) {
    const CellFace& face = look_.faces[number];
    double middle = frame_.middle[c_];
    Vec3 slopes{0, 0, 0};
    for (int step = 0; step < 4; ++step) {
      std::array<Interval, 3> place;
      for (int axis = 0; axis < 3; ++axis) place[at(axis)] = Interval::of(frame_.middle[axis]);
      place[at(c_)] = Interval::of(middle);
      const Jet jet = solid_.value(face, jets_of(place));
      for (int axis = 0; axis < 3; ++axis)
        slopes[axis] = 0.5 * jet.slope[at(axis)].lo + 0.5 * jet.slope[at(axis)].hi;
      if (slopes[c_] == 0) return false;
      middle -= (0.5 * jet.value.lo + 0.5 * jet.value.hi) / slopes[c_];
      if (!std::isfinite(middle)) return false;
      // Of a face that is far beyond an end no more has to be known.
      middle = std::clamp(middle, box_.lower[c_] - 2 * frame_.half[c_],
                          box_.upper[c_] + 2 * frame_.half[c_]);
    }
    PatchSeries height = PatchSeries::linear(
        middle, -slopes[a_] / slopes[c_] * (0.5 * (box_.upper[a_] - box_.lower[a_])),
        -slopes[b_] / slopes[c_] * (0.5 * (box_.upper[b_] - box_.lower[b_])));
    // Each step finds the terms of one degree more.
    for (std::size_t step = 1; step < PatchSeries::degree; ++step) {
      const PatchSeries off = solid_.value(face, places_of(height));
      for (std::size_t i = 0; i < PatchSeries::term_count; ++i)
        height.terms[i] -= off.terms[i] / slopes[c_];
    }
    const double off = range_of(solid_.value(face, places_of(height))).magnitude();
    // By the mean value theorem the face is no farther away than this over the least slope. That is
    // taken where the height may be, and where the face crosses the cell.
    Interval range = range_of(height);
    const double margin = 0.125 * range.width() + 0x1p-40 * range.magnitude();
    range = {range.lo - margin, range.hi + margin};
    if (!(range.hi >= box_.lower[c_] && range.lo <= box_.upper[c_])) {
      return false;
    }
    std::array<Interval, 3> around = intervals_of(box_);
    around[at(c_)] = range;
    const Interval slope = solid_.value(face, jets_of(around)).slope[at(c_)];
    const bool grows = face.slopes[at(c_)].lo > 0;
    if (slope.contains(0) || (slope.lo > 0) != grows) {
      return false;
    }
    const double least = std::min(std::abs(slope.lo), std::abs(slope.hi));
    height.error = rounded_up(rounded_up(off) / least);
    if (!(height.error <= margin)) {
      return false;
    }
    heights_.push_back({number, grows, height});
    error_of_heights_ += height.error;
    return true;
  }

  /// Computes what is below each height, and below the ends of the column, for all that is asked.
  void make_levels() {
    PatchSeries lower = PatchSeries::of(Interval::of(box_.lower[c_]));
    PatchSeries upper = PatchSeries::of(Interval::of(box_.upper[c_]));
    levels_ = {lower};
    for (const Height& height : heights_) levels_.push_back(height.place);
    levels_.push_back(upper);
    const std::size_t count = question_.with_moments ? 10 : 1;
    const auto relative = [&](const PatchSeries& x, int axis) {
      return x - Interval::of(question_.reference[axis]);
    };
    const PatchSeries a = relative(across(a_), a_);
    const PatchSeries b = relative(across(b_), b_);
    for (const PatchSeries& level : levels_) {
      std::vector<PatchSeries>& below = below_.emplace_back(count);
      // Heights are relative to the middle of the column, so that nothing large cancels.
      below[0] = level - Interval::of(frame_.middle[c_]);
      if (!question_.with_moments) continue;
      const PatchSeries c = relative(level, c_);
      const PatchSeries half = square(c) * Interval::of(0.5);
      const PatchSeries a_below = a * below[0];
      const PatchSeries b_below = b * below[0];
      below[1 + at(a_)] = a_below;
      below[1 + at(b_)] = b_below;
      below[1 + at(c_)] = half;
      const auto second = [&](int i, int j) -> PatchSeries& {
        return below[4 + (i == j ? at(i) : i + j == 1 ? 3 : i + j == 3 ? 4 : 5)];
      };
      second(a_, a_) = a * a_below;
      second(b_, b_) = b * b_below;
      second(a_, b_) = a * b_below;
      second(a_, c_) = a * half;
      second(b_, c_) = b * half;
      second(c_, c_) = square(c) * c * (Interval::of(1) / Interval::of(3));
    }
  }

  /// A Crossing is where two levels may cross, or the one may pass an end, in a part of the square.
  struct Crossing {
    PatchSeries difference;
    std::size_t first = 0;
    std::size_t second = 0;
  };
  /// Cuts the square where walls are, and where levels cross.
  void cut_square() {
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      for (std::size_t j = i + 1; j < levels_.size(); ++j) {
        const bool are_ends = i == 0 && j + 1 == levels_.size();
        if (!are_ends) crossings.push_back({levels_[j] - levels_[i], i, j});
      }
    }
    areas_in_doubt_.assign(levels_.size(), 0);
    for (const Wall& wall : walls_) {
      const double area = doubtful(wall.function, wall.error);
      in_doubt_ += area * rounded_up(box_.upper[c_] - box_.lower[c_]);
      for (double& sum : areas_in_doubt_) sum += area;
    }
    cut_part({}, std::move(crossings), 0);
  }
  /// Divides a part until it matters no more where levels cross in it. It matters twice: what is on
  /// the wrong side of the line is so little because the two levels are so near there.
  void cut_part(const Part& part, std::vector<Crossing>&& crossings, int depth) {
    double volume = 0;
    double area = 0;
    std::erase_if(crossings, [&](const Crossing& crossing) {
      const NearlyLinear line(crossing.difference);
      const double doubt = doubtful(line.function, line.error) * part.size * part.size;
      volume += doubt * (2 * line.error);
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
        for (const Crossing& crossing : crossings)
          inner.push_back(
              {part_of(crossing.difference, s, t, 0.5), crossing.first, crossing.second});
        cut_part({part.s + s * part.size, part.t + t * part.size, 0.5 * part.size},
                 std::move(inner), depth + 1);
      }
    }
  }
  void cut_triangles(const Part& part, const std::vector<Crossing>& crossings) {
    if (crossings.empty() && walls_.empty())
      return pieces_.push_back({.part = part, .is_whole = true});
    std::vector<Piece> pieces = {
        {.part = part, .triangle = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)}},
        {.part = part, .triangle = {Vec3(-1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}}};
    const Vec3 middle(part.s, part.t, 0);
    for (const Wall& wall : walls_) {
      cut_pieces({wall.function.at(middle), wall.function.slope * part.size}, 1U << wall.face,
                 pieces);
    }
    for (const Crossing& crossing : crossings) {
      const NearlyLinear line(crossing.difference);
      cut_pieces(line.function, 0, pieces);
      const double doubt = doubtful(line.function, line.error) * part.size * part.size;
      areas_in_doubt_[crossing.first] += doubt;
      areas_in_doubt_[crossing.second] += doubt;
    }
    for (Piece& piece : pieces) {
      for (Vec3& corner : piece.triangle) corner = middle + part.size * corner;
      pieces_.push_back(piece);
    }
    if (question_.with_area) cut_walls(part, crossings);
  }
  /// Finds the segments of walls in a part of the square, without those where levels cross.
  void cut_walls(const Part& part, const std::vector<Crossing>& crossings) {
    const Vec3 middle(part.s, part.t, 0);
    double most_error = 0;
    for (const Crossing& crossing : crossings)
      most_error += 2 * NearlyLinear(crossing.difference).error;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      std::vector<Segment> segments = line_in(part, walls_[i].function, i);
      if (segments.empty()) continue;
      for (std::size_t j = 0; j < walls_.size(); ++j)
        if (j != i) cut_segments(walls_[j].function, 1U << walls_[j].face, segments);
      for (const Crossing& crossing : crossings) {
        const LinearFunction line = NearlyLinear(crossing.difference).function;
        const Vec3 slope = line.slope * (1 / part.size);
        cut_segments({line.value - glm::dot(slope, middle), slope}, 0, segments);
      }
      for (const Segment& segment : segments) {
        wall_off_ += length_of(segment) * most_error;
        segments_.push_back(segment);
      }
    }
  }
  /// Returns the line where a function is 0 in a part of the square.
  static std::vector<Segment> line_in(const Part& part, const LinearFunction& function,
                                      std::size_t wall) {
    std::array<Vec3, 4> corners;
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = Vec3(part.s + (i == 1 || i == 2 ? part.size : -part.size),
                        part.t + (i >= 2 ? part.size : -part.size), 0);
    }
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 4; ++i) {
      const double a = function.at(corners[i]);
      const double b = function.at(corners[(i + 1) % 4]);
      if ((a < 0) != (b < 0))
        ends.push_back(corners[i] + (a / (a - b)) * (corners[(i + 1) % 4] - corners[i]));
    }
    if (ends.size() < 2) return {};
    return {{.wall = wall, .from = ends[0], .to = ends[1]}};
  }
  static void cut_segments(const LinearFunction& function, std::uint32_t bit,
                           std::vector<Segment>& segments) {
    std::vector<Segment> result;
    for (const Segment& segment : segments) {
      const double a = function.at(segment.from);
      const double b = function.at(segment.to);
      Segment first = segment;
      if (a < 0) first.negative |= bit;
      if ((a < 0) != (b < 0)) {
        first.to = segment.at(a / (a - b));
        Segment second = segment;
        second.from = first.to;
        if (b < 0) second.negative |= bit;
        result.push_back(second);
      }
      result.push_back(first);
    }
    segments = std::move(result);
  }
  /// Returns the length of a segment in the world.
  double length_of(const Segment& segment) const {
    const Vec3 way = segment.to - segment.from;
    const double a = way.x * 0.5 * (box_.upper[a_] - box_.lower[a_]);
    const double b = way.y * 0.5 * (box_.upper[b_] - box_.lower[b_]);
    return std::sqrt(a * a + b * b);
  }

  static void cut_pieces(const LinearFunction& function, std::uint32_t bit,
                         std::vector<Piece>& pieces) {
    std::vector<Piece> result;
    std::vector<FlatTriangle> below;
    std::vector<FlatTriangle> above;
    for (const Piece& piece : pieces) {
      below.clear();
      above.clear();
      cut(piece.triangle, function, below, above);
      for (const FlatTriangle& triangle : below)
        result.push_back(
            {.part = piece.part, .triangle = triangle, .negative = piece.negative | bit});
      for (const FlatTriangle& triangle : above)
        result.push_back({.part = piece.part, .triangle = triangle, .negative = piece.negative});
    }
    pieces = std::move(result);
  }

  /// Calls f(level, is_inside_below, is_inside_above) for levels from one end of the column to the
  /// other, as they lie over a piece.
  template <class F>
  void for_each_level(const Piece& piece, const F& f) const {
    for_each_level(
        piece.middle(), piece.negative,
        [&](std::uint32_t states) { return look_.is_inside(states); }, f);
  }
  /// Does so at a place, for any function of the faces that are negative.
  template <class Inside, class F>
  void for_each_level(const Vec3& middle, std::uint32_t negative, const Inside& is_inside,
                      const F& f) const {
    std::vector<std::pair<double, std::size_t>> order;
    const double lower = box_.lower[c_];
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      const double place = value_at(heights_[i].place, middle.x, middle.y);
      const bool is_above_lower = place > lower;
      if (is_above_lower == heights_[i].grows) negative |= 1U << heights_[i].face;
      if (is_above_lower && place < box_.upper[c_]) order.emplace_back(place, i);
    }
    std::sort(order.begin(), order.end());
    f(std::size_t{0}, false, is_inside(negative));
    for (const auto& [place, i] : order) {
      const bool below = is_inside(negative);
      negative ^= 1U << heights_[i].face;
      f(i + 1, below, is_inside(negative));
    }
    f(levels_.size() - 1, is_inside(negative), false);
  }

  void add_piece(const Piece& piece) {
    const double area = piece.area();
    for_each_level(piece, [&](std::size_t level, bool inside_below, bool inside_above) {
      if (inside_below == inside_above) return;
      const double sign = inside_below ? 1 : -1;
      for (std::size_t k = 0; k < below_[level].size(); ++k) {
        const PatchSeries& below = below_[level][k];
        sums_[k] += sign * integral_over(piece, below);
        sums_off_[k] +=
            (below.error + rounding * (std::abs(below.terms[0]) + below.spread())) * area;
      }
    });
  }

  std::size_t level_of(const Height& height) const {
    return static_cast<std::size_t>(&height - heights_.data()) + 1;
  }
  bool is_surface(const Piece& piece, const Height& height) const {
    bool result = false;
    for_each_level(piece, [&](std::size_t level, bool below, bool above) {
      const bool is_own = level == level_of(height);
      if (is_own && below != above) result = true;
    });
    return result;
  }

  /// Returns how much area a height has over one across the column.
  PatchSeries slant_of(const Height& height) const {
    const std::array<PatchSeries, 3> on = places_of(height.place);
    const PatchSeries none;
    const PatchSeries one = PatchSeries::of(Interval::of(1));
    const std::array<SeriesJet, 3> jets = {SeriesJet{on[0], {one, none, none}},
                                           SeriesJet{on[1], {none, one, none}},
                                           SeriesJet{on[2], {none, none, one}}};
    const auto slope = solid_.value(look_.faces[height.face], jets).slope;
    const PatchSeries length = root(square(slope[0]) + square(slope[1]) + square(slope[2]));
    return length * inverse(height.grows ? slope[at(c_)] : -slope[at(c_)]);
  }

  const CellSolid& solid_;
  const Bounds& box_;
  const CellLook& look_;
  const MassQuestion& question_;
  CellFrame frame_;
  int c_ = 0;
  int a_ = (c_ + 1) % 3;
  int b_ = (c_ + 2) % 3;
  std::vector<Wall> walls_;
  std::vector<Height> heights_;
  std::vector<PatchSeries> levels_;              ///< the lower end, the heights, the upper end
  std::vector<std::vector<PatchSeries>> below_;  ///< each level's integrals along the column
  std::vector<Piece> pieces_;
  std::vector<Segment> segments_;
  double wall_off_ = 0;  ///< how far off the areas of walls may be where levels cross
  double error_of_heights_ = 0;
  double in_doubt_ = 0;  ///< the volume, over the square, that may be on either side of a line
  std::vector<double> areas_in_doubt_;  ///< and the area of the square, by level
  std::array<double, 10> sums_{};
  std::array<double, 10> sums_off_{};
};

/// Returns the axis along which all faces are surely heights, or walls, as steeply as can be. It is
/// -1 if there is none.
int axis_of(const CellLook& look, const Vec3& half) {
  int best = -1;
  double steepest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double least = infinity;
    bool has_height = false;
    for (const CellFace& face : look.faces) {
      const double length = largest_component(face.slope / half);
      const double slope = std::abs(face.slope[axis]) / half[axis];
      const bool is_wall =
          slope * half[axis] + face.error <= 0x1p-44 * largest_component(face.slope);
      if (is_wall) continue;
      has_height = true;
      if (face.slopes[at(axis)].contains(0)) least = 0;
      least = std::min(least, slope / length);
    }
    if (has_height && least > steepest) {
      steepest = least;
      best = axis;
    }
  }
  return best;
}

}  // namespace

std::optional<CellMass> column_mass(const CellSolid& solid, const Bounds& box, const CellLook& look,
                                    const MassQuestion& question) {
  const int axis = axis_of(look, CellFrame(box).half);
  constexpr std::size_t most_faces = 3;
  if (axis < 0 || look.faces.size() > most_faces) {
    return {};
  }
  Column column(solid, box, look, question, axis);
  if (!column.find_faces()) {
    return {};
  }
  CellMass result{.part = column.mass(), .column_axis = axis};
  if (question.with_area) {
    result.part.area = column.area();
    result.part.area = result.part.area + column.area_of_walls();
  }
  return result;
}

}  // namespace crt::core
