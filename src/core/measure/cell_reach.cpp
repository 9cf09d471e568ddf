#include "core/measure/cell_reach.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/measure/simplices.hpp"

namespace crt::core {

namespace {

/// Finds the farthest corner of what faces leave of a cube, with each face moved by a share of its
/// error: 1 lets in all that may be there, and -1 what surely is.
class FarthestCorner {
 public:
  FarthestCorner(const CellLook& look, double share, const Vec3& direction, bool wanted)
      : look_(look), share_(share), direction_(direction), wanted_(wanted) {}

  Vec3 corner{0, 0, 0};
  double distance = -infinity;  ///< along the direction, from the middle

  void find() {
    const std::uint32_t count = 1U << look_.faces.size();
    for (std::uint32_t m = 0; m < count; ++m) {
      if (look_.is_inside(m) == wanted_) cut_off({cube().begin(), cube().end()}, 0, m);
    }
  }

 private:
  void cut_off(const std::vector<Tetrahedron>& parts, std::size_t number, std::uint32_t negative) {
    if (parts.empty()) return;
    if (number == look_.faces.size()) {
      for (const Tetrahedron& part : parts) {
        for (const Vec3& place : part) {
          const double along = glm::dot(direction_, place);
          if (!(along > distance)) continue;
          distance = along;
          corner = place;
        }
      }
      return;
    }
    const CellFace& face = look_.faces[number];
    const bool is_negative = ((negative >> number) & 1U) != 0;
    const double error = share_ * face.error;
    std::vector<Tetrahedron> below;
    std::vector<Tetrahedron> above;
    const LinearFunction function{face.value + (is_negative ? -error : error), face.slope};
    for (const Tetrahedron& part : parts) cut(part, function, below, above);
    cut_off(is_negative ? below : above, number + 1, negative);
  }

  const CellLook& look_;
  double share_;
  Vec3 direction_;
  bool wanted_;
};

}  // namespace

CellReach reach_of(const Bounds& box, const CellLook& look, const Vec3& direction,
                   CellPoints points) {
  const bool wanted = points == CellPoints::inside;
  const CellLook::Kind none = wanted ? CellLook::Kind::empty : CellLook::Kind::full;
  if (look.kind == none) return {};
  const CellFrame frame(box);
  const double at_middle = glm::dot(direction, frame.middle);
  const Vec3 in_cube = direction * frame.half;
  const double to_corner = std::abs(in_cube.x) + std::abs(in_cube.y) + std::abs(in_cube.z);
  // This is more than the roundings of cuts and of places.
  const double off =
      0x1p-40 * to_corner + 0x1p-50 * (std::abs(at_middle) + largest_component(frame.middle));
  const auto at = [&](const Vec3& corner) { return frame.middle + frame.half * corner; };
  if (look.kind == CellLook::Kind::full || look.kind == CellLook::Kind::empty) {
    Vec3 corner;
    for (int axis = 0; axis < 3; ++axis)
      corner[axis] = in_cube[axis] < 0 ? box.lower[axis] : box.upper[axis];
    return {.surely = at_middle + to_corner - off,
            .point = corner,
            .most = at_middle + to_corner + off};
  }
  CellReach reach{.most = at_middle + to_corner + off};
  if (look.kind == CellLook::Kind::unknown) return reach;
  FarthestCorner farthest(look, 1, in_cube, wanted);
  farthest.find();
  if (farthest.distance == -infinity) return {};
  reach.most = std::min(reach.most, at_middle + farthest.distance + off);
  FarthestCorner sure(look, -1, in_cube, wanted);
  sure.find();
  if (sure.distance == -infinity) return reach;
  reach.surely = at_middle + sure.distance - off;
  reach.point = at(sure.corner);
  return reach;
}

std::vector<Bounds> halves_of(const Bounds& box, int whole_axis) {
  Vec3 size = box.upper - box.lower;
  if (whole_axis >= 0) size[whole_axis] = 0;
  const double least = 0.5 * largest_component(size);
  std::vector<Bounds> boxes = {box};
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == whole_axis || size[axis] < least) continue;
    const double middle = 0.5 * box.lower[axis] + 0.5 * box.upper[axis];
    if (!(middle > box.lower[axis] && middle < box.upper[axis])) continue;
    const std::size_t count = boxes.size();
    for (std::size_t i = 0; i < count; ++i) {
      boxes.push_back(boxes[i]);
      boxes[i].upper[axis] = middle;
      boxes.back().lower[axis] = middle;
    }
  }
  return boxes;
}

}  // namespace crt::core
