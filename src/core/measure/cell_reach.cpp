#include "core/measure/cell_reach.hpp"

#include <algorithm>
#include <array>
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
    if (look_.faces.size() == 1) return find_beside(look_.faces.front());
    const std::uint32_t count = 1U << look_.faces.size();
    for (std::uint32_t m = 0; m < count; ++m) {
      if (look_.is_inside(m) == wanted_) cut_off({cube().begin(), cube().end()}, 0, m);
    }
  }

 private:
  /// Finds the farthest point beside one face: the best corner of the cube, less what brings it to
  /// the right side of the face at the least loss of distance.
  void find_beside(const CellFace& face) {
    const double sign = look_.is_inside(1) == wanted_ ? 1 : -1;
    const Vec3 rise = sign * face.slope;
    Vec3 place(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis)
      place[axis] = std::copysign(1.0, direction_[axis] == 0 ? -rise[axis] : direction_[axis]);
    double too_high = sign * face.value + glm::dot(rise, place) - share_ * face.error;
    std::array<int, 3> axes = {0, 1, 2};
    std::ranges::sort(axes, [&](int a, int b) {
      return std::abs(direction_[a] * rise[b]) < std::abs(direction_[b] * rise[a]);
    });
    for (const int axis : axes) {
      const double fall = rise[axis] * place[axis];
      if (!(too_high > 0 && fall > 0)) continue;
      const double share = std::min(1.0, too_high / (2 * fall));
      place[axis] *= 1 - 2 * share;
      too_high = share < 1 ? 0 : too_high - 2 * fall;
    }
    if (too_high > 0) return;
    corner = place;
    distance = glm::dot(direction_, place);
  }

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
