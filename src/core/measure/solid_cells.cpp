#include "core/measure/solid_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/invalid_index.hpp"
#include "core/geometry/face_functions.hpp"

namespace crt::core {

CellFrame::CellFrame(const Bounds& box) {
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * box.lower[axis] + 0.5 * box.upper[axis];
    half[axis] =
        rounded_up(std::max(box.upper[axis] - middle[axis], middle[axis] - box.lower[axis]));
  }
}

std::array<Interval, 3> intervals_of(const Bounds& box) {
  return {Interval{box.lower.x, box.upper.x}, Interval{box.lower.y, box.upper.y},
          Interval{box.lower.z, box.upper.z}};
}

std::array<Jet, 3> jets_of(const std::array<Interval, 3>& place) {
  constexpr Interval none{0, 0};
  constexpr Interval one{1, 1};
  return {Jet{place[0], {one, none, none}}, Jet{place[1], {none, one, none}},
          Jet{place[2], {none, none, one}}};
}

Interval narrowed(const Interval& at_middle, const Jet& in_box, const Vec3& half) {
  Interval change{0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    change =
        change + in_box.slope[static_cast<std::size_t>(axis)] * Interval{-half[axis], half[axis]};
  }
  const Interval by_slopes = at_middle + change;
  return {std::max(in_box.value.lo, by_slopes.lo), std::min(in_box.value.hi, by_slopes.hi)};
}

namespace {

constexpr std::size_t max_faces = CellLook::max_faces;
/// This is the surface of what is unknown, which is no other's.
constexpr std::uint64_t unknown_surface = ~std::uint64_t{0};

/// Returns the surface of a function that is of no face, which no other leaf has.
std::uint64_t own_surface(std::uint32_t leaf, std::uint32_t face) {
  return (std::uint64_t{leaf} + 1) << 32 | face;
}

/// A NearFace is a face of an open leaf in a cell.
struct NearFace {
  std::size_t leaf = 0;    ///< place among the open leaves
  std::size_t number = 0;  ///< among the faces of the look
  bool flipped = false;    ///< its function is that of the other face with the sign changed
};

/// A LeafRule says where an open leaf is inside, by the signs of its faces.
struct LeafRule {
  bool is_any = false;
  bool by_signs = false;
  std::uint32_t table = 0;

  /// Returns whether a point is inside where some of `count` faces are below 0.
  bool is_inside(std::uint32_t negative, std::size_t count) const {
    if (by_signs) return (table >> negative & 1U) != 0;
    return is_any ? negative != 0 : negative == (1U << count) - 1;
  }
};

/// Returns what a table says where the sign of one of its faces is known.
std::uint32_t without_face(std::uint32_t table, std::size_t face, bool is_negative) {
  std::uint32_t rest = 0;
  const std::uint32_t bit = 1U << face;
  for (std::uint32_t m = 0; m < 1U << (NearFaces::most_by_signs - 1); ++m) {
    const std::uint32_t low = m & (bit - 1);
    const std::uint32_t with_face = ((m & ~(bit - 1)) << 1) | low | (is_negative ? bit : 0);
    rest |= (table >> with_face & 1U) << m;
  }
  return rest;
}

/// Sets the linear function of a face in a box, and how far it is off.
void make_linear(CellFace& face, const Interval& at_middle, const Jet& jet, const Vec3& half) {
  face.slopes = jet.slope;
  face.value = at_middle.middle();
  double error = at_middle.width();
  for (int axis = 0; axis < 3; ++axis) {
    const Interval& slope = jet.slope[static_cast<std::size_t>(axis)];
    const double middle = slope.middle();
    face.slope[axis] = middle * half[axis];
    error += (slope.width() + 0x1p-51 * std::abs(middle)) * half[axis];
  }
  // Widths are twice what they may be off, and the last bits are within that but for these.
  face.error = 0.5 * error * (1 + 0x1p-40) + 0x1p-50 * std::abs(face.value) +
               std::numeric_limits<double>::min();
  if (!(std::isfinite(face.error) && std::isfinite(face.value))) {
    face.value = 0;
    face.slope = {0, 0, 0};
    face.error = infinity;
  }
}

/// Leaves out faces of a look that make no difference. Without any it is full or empty.
void drop_faces(CellLook& look) {
  for (std::size_t i = look.faces.size(); i-- > 0;) {
    const std::uint32_t count = 1U << look.faces.size();
    const std::uint32_t bit = 1U << i;
    bool matters = false;
    for (std::uint32_t m = 0; m < count && !matters; ++m)
      matters = look.is_inside(m) != look.is_inside(m ^ bit);
    if (matters) continue;
    look.inside = without_face(look.inside, i, false);
    look.faces.erase(look.faces.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (look.faces.empty())
    look.kind = look.is_inside(0) ? CellLook::Kind::full : CellLook::Kind::empty;
}

}  // namespace

/// A Workspace has what is found of one leaf.
struct CellSolid::Workspace {
  NearFaces near;
  std::vector<CellFace> faces;  ///< those that may be negative or positive
  bool is_unknown = false;
  bool is_any = false;    ///< the leaf is inside where any of its faces is negative, and not all
  bool by_signs = false;  ///< it is inside where `table` says so, as NearFaces have it
  std::uint32_t table = 0;
  double max_crossings = 0;  ///< of all faces that may be in the cell
};

CellSolid::CellSolid(const CompiledScene& scene, const SceneObject& object) {
  const CompiledScene& own = object.is_instance() ? scene.prototype_of(object) : scene;
  surfaces_ = own.face_surfaces;
  bounds_ = object.bounds;
  const SceneObject& shape = object.is_instance() ? own.objects.front() : object;
  const CsgProgram* const program = shape.is_csg() ? own.programs[shape.program] : nullptr;
  program_ = std::make_shared<const OpenProgram>(program != nullptr ? OpenProgram::of(*program)
                                                                    : OpenProgram::of_leaf());
  InstancePlacements placements;
  for (const Leaf& leaf : scene.leaves_of(object)) {
    CellLeaf& entry = leaves_.emplace_back();
    entry.leaf = &leaf;
    entry.placement = leaf.placement;
    entry.functions = leaf.shape->face_functions();
    if (!object.is_instance()) continue;
    // A frame's placement is there until another is asked for. The standard tier's is a value.
    entry.own_placement =
        std::make_unique<const Placement>(scene.frame_of(object, placements).placement_of(leaf));
    entry.placement = entry.own_placement.get();
  }
}

bool CellSolid::has_all_functions() const {
  return std::ranges::all_of(leaves_,
                             [](const CellLeaf& leaf) { return leaf.functions != nullptr; });
}

std::vector<Triangle> CellSolid::own_triangles() const {
  if (leaves_.size() != 1 || leaves_.front().leaf->complemented) return {};
  const Placement& placement = *leaves_.front().placement;
  std::vector<Triangle> triangles = leaves_.front().leaf->shape->own_triangles();
  const Vec3 x = placement.direction_to_world({1, 0, 0});
  const Vec3 y = placement.direction_to_world({0, 1, 0});
  const Vec3 z = placement.direction_to_world({0, 0, 1});
  const bool is_mirrored = glm::dot(glm::cross(x, y), z) < 0;
  for (Triangle& triangle : triangles) {
    for (Vec3* corner : {&triangle.a, &triangle.b, &triangle.c})
      *corner = placement.point_to_world(*corner);
    if (is_mirrored) std::swap(triangle.b, triangle.c);
  }
  return triangles;
}

LeafValue CellSolid::look_at(const CellLeaf& leaf, const Cell& cell, const CellFrame& frame,
                             Workspace& work) const {
  work.faces.clear();
  work.is_unknown = false;
  work.is_any = false;
  work.by_signs = false;
  work.max_crossings = 0;
  const LeafValue inside =
      leaf.leaf->complemented ? LeafValue::always_false : LeafValue::always_true;
  const LeafValue outside =
      leaf.leaf->complemented ? LeafValue::always_true : LeafValue::always_false;
  const std::array<Interval, 3> place = intervals_of(cell.box);
  const std::array<Interval, 3> object_box = leaf.placement->to_object(place);
  if (leaf.functions == nullptr) {
    const Bounds bounds = leaf.leaf->shape->bounds();
    for (int axis = 0; axis < 3; ++axis) {
      const Interval& side = object_box[static_cast<std::size_t>(axis)];
      if (side.lo > bounds.upper[axis] || side.hi < bounds.lower[axis]) return outside;
    }
    work.is_unknown = true;
    work.max_crossings = infinity;
    return LeafValue::open;
  }
  leaf.functions->look(object_box, work.near);
  if (work.near.kind == NearFaces::Kind::inside) return inside;
  if (work.near.kind == NearFaces::Kind::outside) return outside;
  if (work.near.kind == NearFaces::Kind::unknown) {
    work.is_unknown = true;
    if (work.near.faces.empty()) work.max_crossings = infinity;
    for (const std::uint32_t face : work.near.faces) {
      const int crossings = leaf.functions->max_crossings(face);
      work.max_crossings += crossings > 0 ? crossings : infinity;
    }
    return LeafValue::open;
  }
  work.is_any = work.near.kind == NearFaces::Kind::where_any_negative;
  work.by_signs = work.near.kind == NearFaces::Kind::by_signs;
  const std::array<Jet, 3> jets = leaf.placement->to_object(jets_of(place));
  const std::array<Interval, 3> middle = leaf.placement->to_object(known_point(frame.middle));
  std::uint32_t table = work.near.inside;
  for (const std::uint32_t face : work.near.faces) {
    const Jet jet = leaf.functions->value(face, jets);
    const Interval at_middle = leaf.functions->value(face, middle);
    const Interval range = narrowed(at_middle, jet, frame.half);
    if (range.lo > 0 || range.hi < 0) {
      const bool is_negative = range.hi < 0;
      if (work.by_signs) {
        table = without_face(table, work.faces.size(), is_negative);
        continue;
      }
      if (is_negative == work.is_any) return is_negative ? inside : outside;
      continue;
    }
    CellFace found;
    make_linear(found, at_middle, jet, frame.half);
    found.leaf = static_cast<std::uint32_t>(&leaf - leaves_.data());
    found.face = face;
    found.surface = own_surface(found.leaf, face);
    found.is_surface = leaf.functions->is_surface(face);
    if (face < leaf.leaf->shape->face_count()) {
      const FaceSurface surface = leaf.leaf->surface_of(face, surfaces_);
      found.surface = surface.surface;
      found.flipped = surface.flipped;
    }
    work.faces.push_back(found);
    const int crossings = leaf.functions->max_crossings(face);
    work.max_crossings += crossings > 0 ? crossings : infinity;
  }
  if (work.by_signs) {
    work.table = table;
    const std::uint32_t all = (std::uint32_t{2} << ((1U << work.faces.size()) - 1)) - 1;
    if ((table & all) == 0) return outside;
    if ((table & all) == all) return inside;
  }
  if (!work.faces.empty()) return LeafValue::open;
  return work.is_any ? outside : inside;
}

bool CellSolid::are_near(const CellFace& one, const CellFace& other, const Bounds& box) const {
  // In a small cell all that touches is near.
  constexpr double small = 0x1p-16;
  if (!(largest_component(box.upper - box.lower) > small * bounds_.farthest())) return false;
  constexpr double rounding = 0x1p-40;
  const double near = rounding * bounds_.farthest();
  const Vec3 of_one = middle_of(one.slopes);
  const Vec3 of_other = middle_of(other.slopes);
  const double sign = glm::dot(of_one, of_other) < 0 ? -1 : 1;
  const auto are_at = [&](double value, const Vec3& slope, double other_value,
                          const Vec3& other_slope) {
    return std::abs(value / glm::length(slope) - sign * other_value / glm::length(other_slope)) <=
           near;
  };
  if (!are_at(one.value, of_one, other.value, of_other)) return false;
  for (unsigned i = 0; i < 8; ++i) {
    const std::array<Jet, 3> place = jets_of(known_point(box.corner(i)));
    const Jet a = value(one, place);
    const Jet b = value(other, place);
    if (!are_at(a.value.middle(), middle_of(a.slope), b.value.middle(), middle_of(b.slope)))
      return false;
  }
  return true;
}

CellLook CellSolid::look_at_part(const CellLook& look, const Bounds& part) const {
  CellLook result = look;
  result.faces.clear();
  const CellFrame frame(part);
  const std::array<Jet, 3> jets = jets_of(intervals_of(part));
  const std::array<Interval, 3> middle = known_point(frame.middle);
  for (const CellFace& face : look.faces) {
    const Jet jet = value(face, jets);
    const Interval at_middle = value(face, middle);
    const Interval range = narrowed(at_middle, jet, frame.half);
    if (range.lo > 0 || range.hi < 0) {
      result.inside = without_face(result.inside, result.faces.size(), range.hi < 0);
      continue;
    }
    CellFace found = face;
    make_linear(found, at_middle, jet, frame.half);
    result.faces.push_back(found);
  }
  drop_faces(result);
  return result;
}

CellLook CellSolid::look(const Cell& cell) const {
  if (has_united_ == nullptr) return look(cell, nullptr);
  std::vector<UnitedFaces> united;
  CellLook result = look(cell, &united);
  if (united.empty() || *has_united_) return result;
  // Faces that go on as one are near enough. They may also be gone, with what was between.
  const CellLook apart = look(cell, nullptr);
  const auto shows = [](const CellLook& some, const UnitedFaces& faces) {
    return std::ranges::any_of(some.faces, [&](const CellFace& face) {
      return face.surface == faces.one || face.surface == faces.other;
    });
  };
  for (const UnitedFaces& faces : united)
    if (shows(apart, faces) && !shows(result, faces)) *has_united_ = true;
  return result;
}

CellLook CellSolid::look(const Cell& cell, std::vector<UnitedFaces>* united) const {
  CellLook look;
  const OpenProgram& program = *cell.program;
  const CellFrame frame(cell.box);
  Workspace work;
  std::vector<LeafValue> values(program.leaves.size());
  std::vector<NearFace> near;
  std::vector<LeafRule> rules(program.leaves.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = look_at(leaves_[program.leaves[i].leaf], cell, frame, work);
    if (values[i] != LeafValue::open) continue;
    look.max_crossings += work.max_crossings;
    rules[i] = {.is_any = work.is_any, .by_signs = work.by_signs, .table = work.table};
    // Of what is unknown there is one face, of which nothing is known.
    if (work.is_unknown) {
      work.faces = {
          {.leaf = program.leaves[i].leaf, .surface = unknown_surface, .error = infinity}};
    }
    for (const CellFace& face : work.faces) {
      auto found = face.surface == unknown_surface
                       ? look.faces.end()
                       : std::ranges::find(look.faces, face.surface, &CellFace::surface);
      bool is_flipped = found != look.faces.end() && found->flipped != face.flipped;
      if (found == look.faces.end() && united != nullptr && face.is_surface &&
          face.surface != unknown_surface) {
        found = std::ranges::find_if(look.faces, [&](const CellFace& other) {
          return other.is_surface && are_near(other, face, cell.box);
        });
        if (found != look.faces.end()) {
          united->push_back({found->surface, face.surface});
          is_flipped = glm::dot(middle_of(found->slopes), middle_of(face.slopes)) < 0;
        }
      }
      near.push_back({.leaf = i,
                      .number = static_cast<std::size_t>(found - look.faces.begin()),
                      .flipped = is_flipped});
      if (found == look.faces.end()) look.faces.push_back(face);
    }
  }
  auto rest = std::make_shared<OpenProgram>();
  const std::optional<bool> root = decide(program, values, *rest);
  if (root) {
    look.kind = *root ? CellLook::Kind::full : CellLook::Kind::empty;
    return look;
  }
  const bool is_less = rest->leaves.size() < program.leaves.size();
  look.program = is_less ? rest : cell.program;

  // What is left of the open leaves, with the faces that they need.
  std::vector<std::size_t> places(program.leaves.size(), rest->leaves.size());
  for (std::size_t i = 0, j = 0; i < program.leaves.size() && j < rest->leaves.size(); ++i) {
    if (program.leaves[i].leaf == rest->leaves[j].leaf) places[i] = j++;
  }
  std::vector<std::size_t> numbers(look.faces.size(), max_faces);
  std::vector<CellFace> faces;
  for (NearFace& face : near) {
    if (places[face.leaf] == rest->leaves.size()) continue;
    std::size_t& number = numbers[face.number];
    if (number == max_faces) {
      number = faces.size();
      faces.push_back(look.faces[face.number]);
      if (faces.size() > max_faces) return look;
    }
  }
  look.faces = std::move(faces);
  const auto leaf_true = std::make_unique<bool[]>(rest->leaves.size());
  const std::uint32_t count = 1U << look.faces.size();
  for (std::uint32_t m = 0; m < count; ++m) {
    // The faces of a leaf follow one another.
    for (std::size_t i = 0; i < near.size();) {
      const std::size_t leaf = near[i].leaf;
      std::uint32_t negative = 0;
      std::size_t faces_of_leaf = 0;
      for (; i < near.size() && near[i].leaf == leaf; ++i, ++faces_of_leaf) {
        if (places[leaf] == rest->leaves.size()) continue;
        const bool is_set = ((m >> numbers[near[i].number]) & 1U) != 0;
        if (is_set != near[i].flipped) negative |= 1U << faces_of_leaf;
      }
      if (places[leaf] != rest->leaves.size())
        leaf_true[places[leaf]] = rules[leaf].is_inside(negative, faces_of_leaf);
    }
    for (std::size_t i = 0; i < rest->leaves.size(); ++i) {
      if (leaves_[rest->leaves[i].leaf].leaf->complemented) leaf_true[i] = !leaf_true[i];
    }
    const bool value = rest->value(std::span(leaf_true.get(), rest->leaves.size()));
    look.inside |= static_cast<std::uint32_t>(value) << m;
  }
  const auto is_unknown = [](const CellFace& face) { return face.error == infinity; };
  drop_faces(look);
  if (look.faces.empty()) return look;
  look.kind = std::ranges::any_of(look.faces, is_unknown) ? CellLook::Kind::unknown
                                                          : CellLook::Kind::crossed;
  return look;
}

}  // namespace crt::core
