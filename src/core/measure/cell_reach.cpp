#include "core/measure/cell_reach.hpp"

#include <algorithm>

#include "core/measure/simplices.hpp"

namespace crt::core {

namespace {

/// Finds the farthest corner of what faces leave of a cube, with each face moved by a share of its
/// error: 1 lets in all that may be inside, and -1 what surely is.
class FarthestCorner {
 public:
  FarthestCorner(const CellLook& look, double share, int axis, double sign)
      : look_(look), share_(share), axis_(axis), sign_(sign) {}

  /// Returns the corner's coordinate in the cube times the sign, or -infinity.
  double find() {
    const std::uint32_t count = 1U << look_.faces.size();
    for (std::uint32_t m = 0; m < count; ++m) {
      if (look_.is_inside(m)) cut_off({cube().begin(), cube().end()}, 0, m);
    }
    return farthest_;
  }

 private:
  void cut_off(const std::vector<Tetrahedron>& parts, std::size_t number, std::uint32_t negative) {
    if (parts.empty()) return;
    if (number == look_.faces.size()) {
      for (const Tetrahedron& part : parts) {
        for (const Vec3& corner : part) farthest_ = std::max(farthest_, sign_ * corner[axis_]);
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
  int axis_;
  double sign_;
  double farthest_ = -infinity;
};

}  // namespace

CellReach reach_of(const Bounds& box, const CellLook& look, int axis, double sign) {
  if (look.kind == CellLook::Kind::empty) return {};
  const double lower = std::min(sign * box.lower[axis], sign * box.upper[axis]);
  const double upper = std::max(sign * box.lower[axis], sign * box.upper[axis]);
  if (look.kind == CellLook::Kind::full) return {.surely = upper, .most = upper};
  if (look.kind == CellLook::Kind::unknown) return {.most = upper};
  const auto in_world = [&](double in_cube) {
    return 0.5 * lower + 0.5 * upper + in_cube * (0.5 * upper - 0.5 * lower);
  };
  // This is more than the roundings of cuts.
  const double off =
      0x1p-40 * (upper - lower) + 0x1p-51 * std::max(std::abs(lower), std::abs(upper));
  const double most = FarthestCorner(look, 1, axis, sign).find();
  if (most == -infinity) return {};
  const double surely = FarthestCorner(look, -1, axis, sign).find();
  return {.surely = surely == -infinity ? -infinity : in_world(surely) - off,
          .most = std::min(upper, in_world(most) + off)};
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
