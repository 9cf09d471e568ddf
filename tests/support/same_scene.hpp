// Compiled scenes are compared by all that their lists say.
#pragma once

#include <algorithm>
#include <vector>

#include "core/compile/compile.hpp"

namespace crt::test {

inline bool same_box(const core::Bounds& a, const core::Bounds& b) {
  return a.lower == b.lower && a.upper == b.upper;
}

inline bool same_shared_faces(const core::SharedFaces* a, const core::SharedFaces* b) {
  if (a == nullptr || b == nullptr) return a == b;
  return std::ranges::equal(a->faces, b->faces, [](const auto& one, const auto& other) {
    return one.surface == other.surface && one.face == other.face;
  });
}

inline bool same_leaf(const core::Leaf& a, const core::Leaf& b) {
  return same_box(a.bounds, b.bounds) && a.placement->to_world() == b.placement->to_world() &&
         a.family == b.family && a.entity_id == b.entity_id && a.part_id == b.part_id &&
         a.user == b.user && a.first_face == b.first_face && a.face_count == b.face_count &&
         a.has_normals == b.has_normals && a.has_materials == b.has_materials &&
         a.complemented == b.complemented && a.of_solid == b.of_solid &&
         (a.exact == nullptr) == (b.exact == nullptr) &&
         same_shared_faces(a.shared_faces.get(), b.shared_faces.get());
}

inline bool same_face(const core::FaceSurface& a, const core::FaceSurface& b) {
  return a.surface == b.surface && a.flipped == b.flipped && a.shared == b.shared;
}

inline bool same_node(const core::CsgNode& a, const core::CsgNode& b) {
  return a.parent == b.parent && a.needed == b.needed && a.count_outside == b.count_outside;
}

inline bool same_program(const core::CsgProgram* a, const core::CsgProgram* b) {
  return std::ranges::equal(a->nodes, b->nodes, same_node) && a->leaf_parents == b->leaf_parents &&
         a->tree == b->tree && a->shared_surfaces == b->shared_surfaces &&
         a->filter.empty() == b->filter.empty() && same_box(a->bounds, b->bounds);
}

inline bool same_object(const core::SceneObject& a, const core::SceneObject& b) {
  return a.first_leaf == b.first_leaf && a.program == b.program && a.instance == b.instance &&
         same_box(a.bounds, b.bounds) && a.solid == b.solid &&
         a.shares_surfaces == b.shares_surfaces && a.passed_by == b.passed_by;
}

inline bool same_instance(const core::Instance& a, const core::Instance& b) {
  const bool same_map = a.to_world == nullptr || b.to_world == nullptr
                            ? a.to_world == b.to_world
                            : a.to_world->product.rounded() == b.to_world->product.rounded();
  return same_map && a.prototype == b.prototype && a.entity_id == b.entity_id &&
         a.part_id == b.part_id && a.user == b.user && a.id_is_of_all == b.id_is_of_all;
}

inline bool same_materials(const core::MaterialTable& a, const core::MaterialTable& b) {
  // Each scene makes the default material for itself.
  const auto same_one = [](const SharedMaterial& one, const SharedMaterial& other) {
    const auto is_plain = [](const SharedMaterial& material) {
      const auto* const color = std::get_if<Color>(&material->color);
      return color != nullptr && *color == std::get<Color>(Material{}.color);
    };
    return &*one == &*other || (is_plain(one) && is_plain(other));
  };
  return std::ranges::equal(a.list, b.list, same_one) && a.default_material == b.default_material &&
         a.of_leaves == b.of_leaves && a.of_prototypes == b.of_prototypes;
}

/// Returns whether two scenes have the same lists, with the same numbers, but for their materials.
inline bool same_scene(const core::CompiledScene& a, const core::CompiledScene& b) {
  return std::ranges::equal(a.leaves, b.leaves, same_leaf) &&
         std::ranges::equal(a.face_surfaces, b.face_surfaces, same_face) &&
         std::ranges::equal(a.objects, b.objects, same_object) &&
         std::ranges::equal(a.programs, b.programs, same_program) &&
         std::ranges::equal(a.instances, b.instances, same_instance) &&
         a.prototypes.size() == b.prototypes.size() && a.surfaces.size() == b.surfaces.size();
}

}  // namespace crt::test
