#include "core/section/boundary_cells.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/measure/entity_cells.hpp"

namespace crt::core {

namespace {

/// Returns whether two faces of a cell surely have no common point in it, by their linear parts.
bool are_apart(const CellFace& a, const CellFace& b) {
  const double squared = glm::dot(b.slope, b.slope);
  if (!(squared > 0)) return false;
  const double ratio = glm::dot(a.slope, b.slope) / squared;
  const Vec3 rest = a.slope - ratio * b.slope;
  const double off =
      std::abs(rest.x) + std::abs(rest.y) + std::abs(rest.z) + a.error + std::abs(ratio) * b.error;
  const double size = std::abs(a.value) + std::abs(ratio * b.value) + off;
  return std::abs(a.value - ratio * b.value) > off + 0x1p-48 * size;
}

}  // namespace

BoundaryGrid::BoundaryGrid(const SectionPlane& plane, const Bounds& bounds, int shift)
    : axes_{static_cast<std::size_t>(plane.first_axis),
            static_cast<std::size_t>(plane.second_axis)},
      across_(plane.across),
      place_(plane.place) {
  const Bounds box = first_box(bounds);
  double farthest = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto axis = static_cast<int>(axes_[i]);
    const double length = box.upper[axis] - box.lower[axis];
    // Something that is no simple share of the size is added for each attempt.
    const double more = (0x1.3a7p-7 + 0x1.1b5p-9 * static_cast<double>(i)) * shift * length;
    lower_[i] = box.lower[axis] - more;
    size_[i] = length + 1.5 * more;
    farthest = std::max({farthest, std::abs(lower_[i]), std::abs(lower_[i] + size_[i])});
  }
  rounding_ = 0x1p-50 * farthest;
}

std::array<double, 2> BoundaryGrid::size(const GridPoint& lower, const GridPoint& upper) const {
  return {size_[0] * (0x1p-44 * static_cast<double>(upper[0] - lower[0])),
          size_[1] * (0x1p-44 * static_cast<double>(upper[1] - lower[1]))};
}

BoundaryCell BoundaryLooks::root() const {
  return {.lower = {0, 0},
          .upper = {BoundaryGrid::whole, BoundaryGrid::whole},
          .program = solid_.cell({}).program};
}

double BoundaryLooks::size(const BoundaryCell& cell) const {
  const auto [x, y] = grid_.size(cell.lower, cell.upper);
  return std::max(x, y);
}

double BoundaryLooks::diagonal(const BoundaryCell& cell) const {
  const auto [x, y] = grid_.size(cell.lower, cell.upper);
  return std::sqrt(x * x + y * y) * (1 + 0x1p-40);
}

bool BoundaryLooks::lies_in_plane(const CellFace& face) const {
  constexpr double tolerance = 0x1p-38;
  const Interval& across = face.slopes[across_];
  if (across.contains(0)) return false;
  const double steep = std::min(std::abs(across.lo), std::abs(across.hi));
  for (std::size_t i = 0; i < 2; ++i) {
    if (!(face.slopes[grid_.axis(i)].magnitude() <= tolerance * steep)) return false;
  }
  return std::abs(face.value) + face.error <= tolerance * steep * size_;
}

BoundaryLooks::Found BoundaryLooks::look_at(BoundaryCell& cell) const {
  cell.look = solid_.look({grid_.box(cell.lower, cell.upper), cell.program});
  if (!cell.look.is_open()) return Found::nothing;
  if (cell.look.program) cell.program = cell.look.program;
  cell.is_simple = false;
  cell.first = cell.second = BoundaryCell::unknown_face;
  if (cell.look.kind != CellLook::Kind::crossed) return Found::crossed;
  for (const CellFace& face : cell.look.faces)
    if (lies_in_plane(face)) return Found::in_plane;
  find_form(cell);
  return Found::crossed;
}

void BoundaryLooks::find_form(BoundaryCell& cell) const {
  const std::vector<CellFace>& faces = cell.look.faces;
  const std::size_t a = grid_.axis(0);
  const std::size_t b = grid_.axis(1);
  for (const CellFace& face : faces)
    if (!is_steep(face, a) && !is_steep(face, b)) return;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      if (are_apart(faces[i], faces[j])) continue;
      const Interval turn =
          faces[i].slopes[a] * faces[j].slopes[b] - faces[i].slopes[b] * faces[j].slopes[a];
      if (turn.contains(0) || cell.first != BoundaryCell::unknown_face) return;
      cell.first = i;
      cell.second = j;
    }
  }
  cell.is_simple = true;
}

std::vector<BoundaryCell> BoundaryLooks::parts_of(const BoundaryCell& cell) const {
  std::vector<BoundaryCell> parts = {
      {.lower = cell.lower, .upper = cell.upper, .program = cell.program}};
  const std::array<double, 2> size = grid_.size(cell.lower, cell.upper);
  const double least = 0.75 * std::max(size[0], size[1]);
  for (std::size_t i = 0; i < 2; ++i) {
    if (size[i] < least || cell.upper[i] - cell.lower[i] < 2) continue;
    const std::int64_t middle = (cell.lower[i] + cell.upper[i]) / 2;
    const std::size_t count = parts.size();
    for (std::size_t part = 0; part < count; ++part) {
      BoundaryCell other = parts[part];
      parts[part].upper[i] = middle;
      other.lower[i] = middle;
      parts.push_back(std::move(other));
    }
  }
  if (parts.size() == 1) parts.clear();
  return parts;
}

}  // namespace crt::core
