#include "core/tessellate/deviation_proof.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/tessellate/surface_place.hpp"

namespace crt::core {

namespace {

/// Rounding in this file is less, relative to lengths and to coordinates.
constexpr double rounding = 0x1p-40;
constexpr int most_halvings_of_triangle = 4;
constexpr int most_halvings_of_cell = 18;

/// Returns the signs that a look's faces may have in a simplex of its cube: for each face whether
/// it may be below 0, and whether it may be above.
struct FaceSigns {
  std::uint32_t below = 0;
  std::uint32_t above = 0;

  /// Returns whether the solid is, or is not, where faces have any of these signs.
  bool are_all(const CellLook& look, bool inside) const {
    const std::uint32_t open = below & above;
    for (std::uint32_t some = open;; some = (some - 1) & open) {
      if (look.is_inside((below & ~open) | some) != inside) return false;
      if (some == 0) return true;
    }
  }
};

LinearFunction linear(const CellFace& face) {
  return {face.value, face.slope};
}

/// Returns how far a face's function may be from its linear one, as that is computed.
double error_of(const CellFace& face) {
  const Vec3& slope = face.slope;
  return face.error + rounding * (std::abs(face.value) + std::abs(slope.x) + std::abs(slope.y) +
                                  std::abs(slope.z));
}

FaceSigns signs_in(const CellLook& look, std::span<const Vec3> corners_in_cube) {
  FaceSigns signs;
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    const CellFace& face = look.faces[i];
    const double error = error_of(face);
    for (const Vec3& corner : corners_in_cube) {
      const double at = linear(face).at(corner);
      if (!(at - error > 0)) signs.below |= 1U << i;
      if (!(at + error < 0)) signs.above |= 1U << i;
    }
  }
  return signs;
}

/// Returns the four triangles between the corners of a triangle and the middles of its sides.
std::array<FlatTriangle, 4> quarters_of(const FlatTriangle& t) {
  const Vec3 ab = 0.5 * t[0] + 0.5 * t[1];
  const Vec3 bc = 0.5 * t[1] + 0.5 * t[2];
  const Vec3 ca = 0.5 * t[2] + 0.5 * t[0];
  return {{{t[0], ab, ca}, {ab, t[1], bc}, {ca, bc, t[2]}, {ab, bc, ca}}};
}

/// Returns a box around a triangle, and what rounding may make of it.
Bounds box_around(const FlatTriangle& triangle) {
  const Bounds box = box_of(triangle);
  return box.grown(rounding * (box.farthest() + largest_component(box.upper - box.lower)));
}

bool is_within(const FlatTriangle& triangle, std::span<const Vec3> points, double distance) {
  return std::ranges::all_of(
      points, [&](const Vec3& point) { return distance_from(triangle, point) <= distance; });
}

/// A Cover says whether all of a flat triangle is near one of several triangles.
class Cover {
 public:
  Cover(const DualMesh& mesh, std::span<const std::uint32_t> near, double distance)
      : mesh_(mesh), near_(near), distance_(distance) {}

  bool covers(const FlatTriangle& whole) {
    if (is_near_one(whole)) return true;
    pieces_.assign(1, whole);
    for (const std::uint32_t number : near_) {
      take_away(triangle_of(mesh_, number));
      if (pieces_.empty()) return true;
      constexpr std::size_t most_pieces = 256;
      if (pieces_.size() > most_pieces) return false;
    }
    return std::ranges::all_of(pieces_,
                               [&](const FlatTriangle& piece) { return is_near_one(piece); });
  }

 private:
  bool is_near_one(const FlatTriangle& piece) const {
    return std::ranges::any_of(near_, [&](std::uint32_t number) {
      return is_within(triangle_of(mesh_, number), piece, distance_);
    });
  }
  /// Takes away what is above or below a triangle and near to it.
  void take_away(const FlatTriangle& triangle) {
    const Vec3 across = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    std::vector<FlatTriangle> rest;
    std::vector<FlatTriangle> inside;
    std::vector<FlatTriangle> next;
    std::vector<FlatTriangle> outside;
    for (const FlatTriangle& piece : pieces_) {
      inside.assign(1, piece);
      outside.clear();
      for (std::size_t side = 0; side < 3 && !inside.empty(); ++side) {
        const Vec3 slope = glm::cross(triangle[(side + 1) % 3] - triangle[side], across);
        const LinearFunction beyond{-glm::dot(slope, triangle[side]), slope};
        next.clear();
        for (const FlatTriangle& part : inside) cut(part, beyond, next, outside);
        std::swap(inside, next);
      }
      const bool is_near = !inside.empty() && std::ranges::all_of(inside, [&](const auto& part) {
        return is_within(triangle, part, distance_);
      });
      if (is_near)
        rest.insert(rest.end(), outside.begin(), outside.end());
      else
        rest.push_back(piece);
    }
    pieces_ = std::move(rest);
  }

  const DualMesh& mesh_;
  std::span<const std::uint32_t> near_;
  double distance_;
  std::vector<FlatTriangle> pieces_;
};

/// Appends the parts of the plane of a face in a cell, and a margin around, where the face may be
/// surface of the solid. No surface is farther from them than `away`.
void add_surface(const CellLook& look, std::size_t number, const CellFrame& frame,
                 std::vector<FlatTriangle>& surface, double& away) {
  const CellFace& face = look.faces[number];
  const double steepness = glm::length(face.slope / frame.half);
  away = rounded_up(face.error / steepness * (1 + rounding));
  if (!(away < infinity)) return;
  const Vec3 margin = Vec3(1 + rounding) + away / frame.half;
  std::vector<Tetrahedron> parts;
  for (Tetrahedron part : cube()) {
    for (Vec3& corner : part) corner *= margin;
    parts.push_back(part);
  }
  std::vector<FlatTriangle> plane;
  for (const Tetrahedron& part : parts) cut_plane(part, linear(face), plane);
  // What the other faces say is cut off, with all that they leave open.
  const std::uint32_t bit = 1U << number;
  const std::uint32_t count = 1U << look.faces.size();
  for (std::uint32_t m = 0; m < count; ++m) {
    if ((m & bit) != 0 || look.is_inside(m) == look.is_inside(m | bit)) continue;
    std::vector<FlatTriangle> left = plane;
    for (std::size_t i = 0; i < look.faces.size() && !left.empty(); ++i) {
      if (i == number) continue;
      const CellFace& other = look.faces[i];
      const bool is_negative = ((m >> i) & 1U) != 0;
      const double slack = other.error + away * glm::length(other.slope / frame.half) +
                           rounding * std::abs(other.value);
      const LinearFunction function{other.value + (is_negative ? -slack : slack), other.slope};
      std::vector<FlatTriangle> below;
      std::vector<FlatTriangle> above;
      for (const FlatTriangle& part : left) cut(part, function, below, above);
      left = is_negative ? std::move(below) : std::move(above);
    }
    surface.insert(surface.end(), left.begin(), left.end());
  }
}

}  // namespace

bool SurfaceProof::is_near_surface(const DualTriangle& corners) const {
  const FlatTriangle triangle = {corners[0]->place, corners[1]->place, corners[2]->place};
  const Bounds box = box_of(triangle);
  // The ways from a point of the triangle are no longer than those from its corners.
  const double most = (deviation_ - slack()) * (1 - rounding) - rounding * box.farthest();
  if (!(most > 0)) return false;
  if (is_small(corners, most)) return true;
  CellLook unknown;
  unknown.program = partition_.program_in(box.grown(deviation_));
  const auto is_moved_to = [&](bool inside) {
    // Where the solid is thin, the way that leaves it again is too long.
    for (double reach = most; reach > 0x1p-10 * most; reach *= 0.25) {
      FlatTriangle moved = triangle;
      for (std::size_t i = 0; i < 3; ++i)
        moved[i] += corners[i]->outwards * (inside ? -reach : reach);
      if (is_all(moved, inside, unknown, 0)) return true;
    }
    return false;
  };
  return is_moved_to(true) && is_moved_to(false);
}

bool SurfaceProof::may_be_near_surface(const DualTriangle& corners) const {
  const auto is_far = [&](const Vec3& place) {
    return std::ranges::all_of(corners, [&](const DualVertex* corner) {
      const SurfacePlaces places(solid_, partition_.node(corner->cell));
      double distance = infinity;
      const std::vector<FacePull> pulls = places.pulls_at(place);
      return places.nearest(pulls, distance) != nullptr && distance > deviation_;
    });
  };
  const Vec3& a = corners[0]->place;
  const Vec3& b = corners[1]->place;
  const Vec3& c = corners[2]->place;
  return !is_far((a + b + c) / 3.0) && !is_far(0.5 * (a + b)) && !is_far(0.5 * (b + c)) &&
         !is_far(0.5 * (c + a));
}

bool SurfaceProof::is_small(const DualTriangle& corners, double distance) const {
  // The surface passes through the cells of the corners. No point of a triangle is farther from all
  // corners than the longest side over the root of 3.
  double cell_size = 0;
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Bounds& box = partition_.node(corners[i]->cell).box;
    cell_size = std::max(cell_size, glm::length(box.upper - box.lower));
    longest = std::max(longest, glm::length(corners[(i + 1) % 3]->place - corners[i]->place));
  }
  constexpr double inverse_root_of_3 = 0.5774;
  return cell_size + inverse_root_of_3 * longest <= distance;
}

bool SurfaceProof::is_all(const FlatTriangle& triangle, bool inside, const CellLook& around,
                          int halvings) const {
  const Bounds box = box_around(triangle);
  const CellLook look = around.kind == CellLook::Kind::crossed ? solid_.look_at_part(around, box)
                                                               : solid_.look({box, around.program});
  if (!look.is_open()) return (look.kind == CellLook::Kind::full) == inside;
  if (look.kind == CellLook::Kind::crossed) {
    const CellFrame frame(box);
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i] = (triangle[i] - frame.middle) / frame.half;
    if (signs_in(look, corners).are_all(look, inside)) return true;
    for (const Vec3& corner : corners)
      if (signs_in(look, std::span(&corner, 1)).are_all(look, !inside)) return false;
  }
  if (halvings == most_halvings_of_triangle) return false;
  return std::ranges::all_of(quarters_of(triangle), [&](const FlatTriangle& quarter) {
    return is_all(quarter, inside, look, halvings + 1);
  });
}

bool MeshProof::is_near_mesh(std::uint32_t cell) const {
  const PartitionNode& node = partition_.node(cell);
  if (!node.look.is_open()) return true;
  std::vector<std::uint32_t> near;
  boxes_.find(node.box.grown(deviation_), near);
  return is_near_mesh({node.box, node.look.program}, near, 0);
}

bool MeshProof::is_near_mesh(const Cell& cell, std::span<const std::uint32_t> near,
                             int halvings) const {
  const double distance = deviation_ * (1 - rounding) - rounding * cell.box.farthest();
  const CellFrame frame(cell.box);
  const CellLook look = solid_.look(cell);
  if (!look.is_open()) return true;
  std::array<Vec3, 8> corners;
  for (unsigned i = 0; i < corners.size(); ++i) corners[i] = cell.box.corner(i);
  const bool is_all_near = std::ranges::any_of(near, [&](std::uint32_t triangle) {
    return is_within(triangle_of(mesh_, triangle), corners, distance);
  });
  if (is_all_near) return true;
  if (look.kind == CellLook::Kind::crossed) {
    bool is_covered = true;
    for (std::size_t i = 0; i < look.faces.size() && is_covered; ++i) {
      if (!look.faces[i].is_surface) continue;
      std::vector<FlatTriangle> surface;
      double away = infinity;
      add_surface(look, i, frame, surface, away);
      is_covered = away < distance;
      if (!is_covered) break;
      Cover cover(mesh_, near, distance - away);
      for (FlatTriangle& part : surface) {
        for (Vec3& corner : part) corner = frame.middle + frame.half * corner;
        is_covered = is_covered && cover.covers(part);
      }
    }
    if (is_covered) return true;
  }
  if (halvings == most_halvings_of_cell) return false;
  const int axis =
      dividing_axis(solid_, cell.box, look, !outward_direction(look), share_of_gap * deviation_);
  const double place = frame.middle[axis];
  if (!(place > cell.box.lower[axis] && place < cell.box.upper[axis])) return false;
  for (const bool upper : {false, true}) {
    Cell half{cell.box, look.program ? look.program : cell.program};
    (upper ? half.box.lower : half.box.upper)[axis] = place;
    std::vector<std::uint32_t> nearer;
    const Bounds reach = half.box.grown(deviation_);
    for (const std::uint32_t triangle : near)
      if (box_of(triangle_of(mesh_, triangle)).touches(reach)) nearer.push_back(triangle);
    if (!is_near_mesh(half, nearer, halvings + 1)) return false;
  }
  return true;
}

}  // namespace crt::core
