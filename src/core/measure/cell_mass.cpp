#include "core/measure/cell_mass.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/face_functions.hpp"
#include "core/measure/column.hpp"
#include "core/measure/square_pieces.hpp"

namespace crt::core {

namespace {

Interval side_of(const Bounds& box, int axis) {
  return Interval::of(box.upper[axis]) - Interval::of(box.lower[axis]);
}

Interval hull_with(const Interval& a, double off) {
  return {sum_down(a.lo - off), sum_up(a.hi + off)};
}

/// Gives the integrals over a part of a cell from those about its middle.
void move_to_reference(const std::array<Interval, 3>& middle, const std::array<Interval, 3>& first,
                       const std::array<Interval, 6>& second, MassPart& part) {
  for (std::size_t i = 0; i < 3; ++i) part.first[i] = middle[i] * part.volume + first[i];
  for (std::size_t k = 0; k < moment_pairs.size(); ++k) {
    const auto [i, j] = moment_pairs[k];
    part.second[k] = middle[i] * middle[j] * part.volume + middle[i] * first[j] +
                     middle[j] * first[i] + second[k];
  }
}

std::array<Interval, 3> relative_middle(const CellFrame& frame, const MassQuestion& question) {
  std::array<Interval, 3> middle;
  for (int i = 0; i < 3; ++i) {
    middle[static_cast<std::size_t>(i)] =
        Interval::of(frame.middle[i]) - Interval::of(question.reference[i]);
  }
  return middle;
}

Interval volume_of(const Bounds& box) {
  return side_of(box, 0) * side_of(box, 1) * side_of(box, 2);
}

MassPart whole(const Bounds& box, const MassQuestion& question) {
  MassPart part{.volume = volume_of(box)};
  if (!question.with_moments) return part;
  const CellFrame frame(box);
  std::array<Interval, 3> first{};
  std::array<Interval, 6> second{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    // The middle is off by a rounding.
    const double off = 0x1p-52 * (std::abs(box.lower[axis]) + std::abs(box.upper[axis]));
    first[i] = part.volume * Interval{-off, off};
    const Interval half = hull_with(side_of(box, axis) * Interval::of(0.5), off);
    second[i] = part.volume * square(half) / Interval::of(3);
  }
  for (std::size_t k = 3; k < moment_pairs.size(); ++k) {
    const auto [i, j] = moment_pairs[k];
    const double off = 0x1p-52 * frame.half[static_cast<int>(i)] * frame.half[static_cast<int>(j)];
    second[k] = part.volume * Interval{-off, off};
  }
  move_to_reference(relative_middle(frame, question), first, second, part);
  return part;
}

/// Returns the most area that surfaces have in a cell which no line crosses more often. A convex
/// body's surface is met twice by lines: of all lines, the mean says what areas are (Crofton).
double most_area(const Bounds& box, double max_crossings) {
  const Interval x = side_of(box, 0);
  const Interval y = side_of(box, 1);
  const Interval z = side_of(box, 2);
  return ((x * y + y * z + z * x) * Interval::of(max_crossings)).hi;
}

double most_area_of_face(const CellSolid& solid, const Bounds& box, const CellFace& face) {
  const int crossings = solid.functions(face.leaf).max_crossings(face.face);
  return crossings == 0 ? infinity : most_area(box, crossings);
}

/// Cuts a cell by planes, one after the other.
class CutCell {
 public:
  CutCell(const CellSolid& solid, const Bounds& box, const CellLook& look,
          const MassQuestion& question)
      : solid_(solid), box_(box), frame_(box), look_(look), question_(question) {}

  MassPart mass() {
    MassPart part;
    const Interval whole = volume_of(box_);
    const double off = cut_into_moments();
    const Interval scale = whole * Interval::of(1.0 / cube_volume);
    const auto bounded = [&](double middle, double most) {
      const double spread = off * most + cut_rounding;
      return Interval{middle - spread, middle + spread} * scale;
    };
    const Interval volume = bounded(moments_.volume, 1);
    part.volume = {std::max(0.0, volume.lo), std::min(whole.hi, volume.hi)};
    if (question_.with_moments) {
      std::array<Interval, 3> first;
      std::array<Interval, 6> second;
      const auto half = [&](std::size_t i) {
        return Interval::of(frame_.half[static_cast<int>(i)]);
      };
      for (std::size_t i = 0; i < 3; ++i)
        first[i] = bounded(moments_.first[static_cast<int>(i)], 1) * half(i);
      for (std::size_t k = 0; k < moment_pairs.size(); ++k)
        second[k] =
            bounded(moments_.second[k], 1) * half(moment_pairs[k][0]) * half(moment_pairs[k][1]);
      move_to_reference(relative_middle(frame_, question_), first, second, part);
    }
    if (question_.with_area) {
      for (std::size_t face = 0; face < look_.faces.size(); ++face)
        part.area = part.area + area(face);
    }
    return part;
  }

  /// Encloses the area of a face that is surface of the solid in the cell.
  Interval area(std::size_t number) const {
    const CellFace& face = look_.faces[number];
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::abs(face.slope[i]) / frame_.half[i] > std::abs(face.slope[axis]) / frame_.half[axis])
        axis = i;
    }
    const Interval& steep = face.slopes[static_cast<std::size_t>(axis)];
    if (steep.contains(0)) return {0, most_area_of_face(solid_, box_, face)};
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    std::vector<FlatTriangle> plane;
    for (const Tetrahedron& part : cube()) cut_plane(part, function_of(face), plane);
    const double seen = seen_area(plane, number, 0, 0, axis);

    double off = cut_rounding;
    for (const double end : {-1.0, 1.0}) {
      off += area_in_doubt({face.value + end * face.slope[axis], {face.slope[a], face.slope[b], 0}},
                           face.error);
    }
    for (std::size_t j = 0; j < look_.faces.size(); ++j) {
      if (j == number) continue;
      // The other face as it is on the plane of this one.
      const CellFace& other = look_.faces[j];
      const double ratio = other.slope[axis] / face.slope[axis];
      off += area_in_doubt(
          {other.value - ratio * face.value,
           {other.slope[a] - ratio * face.slope[a], other.slope[b] - ratio * face.slope[b], 0}},
          other.error + std::abs(ratio) * face.error);
    }
    const Interval square_seen = {std::max(0.0, seen - off), std::min(4.0, seen + off)};
    const Interval scale = side_of(box_, a) * side_of(box_, b) * Interval::of(0.25);
    const Interval slant = root(squared_length(face.slopes)) / (steep.lo > 0 ? steep : -steep);
    const Interval result = square_seen * scale * slant;
    return {std::max(0.0, result.lo), std::min(result.hi, most_area_of_face(solid_, box_, face))};
  }

 private:
  static constexpr double cube_volume = 8;
  /// This bounds the rounding of all cuts of the cube.
  static constexpr double cut_rounding = 0x1p-42;

  static LinearFunction function_of(const CellFace& face) { return {face.value, face.slope}; }

  /// Adds up the moments of what is inside, and returns the volume of what may be on either side.
  double cut_into_moments() {
    add_parts({cube().begin(), cube().end()}, 0, 0);
    double off = 0;
    for (const CellFace& face : look_.faces) {
      const double steepest = largest_component(face.slope);
      // Along the steepest axis the function passes the part in doubt in 2 error / slope.
      off += face.error < steepest ? 2 * face.error / steepest * (cube_volume / 2) : cube_volume;
    }
    return std::min(off * (1 + 0x1p-40), cube_volume);
  }
  void add_parts(const std::vector<Tetrahedron>& parts, std::size_t face, std::uint32_t negative) {
    if (parts.empty()) return;
    if (face == look_.faces.size()) {
      if (!look_.is_inside(negative)) return;
      for (const Tetrahedron& part : parts) moments_.add(part);
      return;
    }
    std::vector<Tetrahedron> below;
    std::vector<Tetrahedron> above;
    for (const Tetrahedron& part : parts) cut(part, function_of(look_.faces[face]), below, above);
    add_parts(below, face + 1, negative | (1U << face));
    add_parts(above, face + 1, negative);
  }

  /// Adds up the area, seen along an axis, of what is surface of the solid among triangles of a
  /// face's plane.
  double seen_area(const std::vector<FlatTriangle>& parts, std::size_t own, std::size_t face,
                   std::uint32_t negative, int axis) const {
    if (parts.empty()) return 0;
    if (face == look_.faces.size()) {
      const std::uint32_t bit = 1U << own;
      if (look_.is_inside(negative | bit) == look_.is_inside(negative & ~bit)) return 0;
      double sum = 0;
      for (const FlatTriangle& part : parts) sum += std::abs(double_area(part)[axis]) / 2;
      return sum;
    }
    if (face == own) return seen_area(parts, own, face + 1, negative, axis);
    std::vector<FlatTriangle> below;
    std::vector<FlatTriangle> above;
    for (const FlatTriangle& part : parts) cut(part, function_of(look_.faces[face]), below, above);
    return seen_area(below, own, face + 1, negative | (1U << face), axis) +
           seen_area(above, own, face + 1, negative, axis);
  }

  const CellSolid& solid_;
  const Bounds& box_;
  CellFrame frame_;
  const CellLook& look_;
  const MassQuestion& question_;
  BodyMoments moments_;
};

}  // namespace

MassPart& MassPart::operator+=(const MassPart& other) {
  volume = volume + other.volume;
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = first[i] + other.first[i];
  for (std::size_t i = 0; i < second.size(); ++i) second[i] = second[i] + other.second[i];
  area = area + other.area;
  return *this;
}

CellMass mass_of(const CellSolid& solid, const Bounds& box, const CellLook& look,
                 const MassQuestion& question) {
  CellMass result;
  if (look.kind == CellLook::Kind::empty) return result;
  if (look.kind == CellLook::Kind::full) return {.part = whole(box, question)};
  if (look.kind == CellLook::Kind::unknown) {
    MassPart& part = result.part;
    part.volume = {0, volume_of(box).hi};
    if (question.with_moments) {
      const CellFrame frame(box);
      const std::array<Interval, 3> middle = relative_middle(frame, question);
      std::array<Interval, 3> place;
      for (std::size_t i = 0; i < 3; ++i) {
        const double half = frame.half[static_cast<int>(i)];
        place[i] = middle[i] + Interval{-half, half};
        part.first[i] = part.volume * place[i];
      }
      for (std::size_t k = 0; k < moment_pairs.size(); ++k)
        part.second[k] =
            part.volume * (moment_pairs[k][0] == moment_pairs[k][1]
                               ? square(place[moment_pairs[k][0]])
                               : place[moment_pairs[k][0]] * place[moment_pairs[k][1]]);
    }
    if (question.with_area) part.area = {0, most_area(box, look.max_crossings)};
    return result;
  }
  if (std::optional<CellMass> column = column_mass(solid, box, look, question)) {
    if (!question.with_area) return *column;
    double most = 0;
    for (const CellFace& face : look.faces) most += most_area_of_face(solid, box, face);
    Interval& area = column->part.area;
    area.hi = std::min(area.hi, rounded_up(most));
    return *column;
  }
  result.part = CutCell(solid, box, look, question).mass();
  return result;
}

}  // namespace crt::core
