#include "core/compile/recompile.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

#include "core/compile/material_numbering.hpp"
#include "core/compile/merged_surfaces.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// A scene is made of parts from this many stores at most. With more it is compiled anew.
constexpr std::size_t max_stores = 256;

/// A Source is a compiled scene of which parts are taken.
struct Source {
  const CompiledScene& scene;
  const MaterialTable& materials;
  std::vector<std::uint32_t> new_faces;  ///< by face its number in the result, or invalid_index
  std::vector<std::uint32_t> new_materials;
  std::vector<std::uint32_t> new_prototypes;
  std::vector<std::uint32_t> new_stores;

  Source(const CompiledScene& of, const MaterialTable& with)
      : scene(of),
        materials(with),
        new_faces(of.face_surfaces.size(), invalid_index),
        new_materials(with.list.size(), invalid_index),
        new_prototypes(of.prototypes.size(), invalid_index),
        new_stores(of.stores.size(), invalid_index) {}

  /// Returns the number of the first face of a leaf, or of all leaves.
  std::uint32_t first_face(std::uint32_t leaf) const {
    return leaf < scene.leaves.size() ? scene.leaves[leaf].first_face
                                      : static_cast<std::uint32_t>(scene.face_surfaces.size());
  }
};

class Recompiler {
 public:
  Recompiler(const CompiledScene& earlier, const MaterialTable& earlier_materials,
             const CompiledScene& added, std::span<const std::uint32_t> kept,
             const Workers& workers)
      : kept_(kept),
        workers_(workers),
        earlier_(earlier, earlier_materials),
        added_(added, *added.materials) {}

  /// Returns false if something is there twice.
  bool run();
  RecompiledScene take_result() { return std::move(result_); }

 private:
  void take_stores();
  void reserve();
  void take_entity(Source& source, std::size_t entity, std::uint32_t place);
  /// Returns by how much the numbers of faces are more than they were, modulo 2^32.
  std::uint32_t take_leaves(Source& source, const EntityEnds& begin, const EntityEnds& end,
                            std::uint32_t place);
  void take_instances(Source& source, const EntityEnds& begin, const EntityEnds& end,
                      std::uint32_t place);
  std::uint32_t material_number(Source& source, const Leaf& leaf, std::uint32_t number);
  void take_materials();
  bool has_equal_instances() const;

  std::span<const std::uint32_t> kept_;
  Workers workers_;
  Source earlier_;
  Source added_;
  MaterialNumbering numbering_;
  MaterialTable materials_;
  std::vector<std::uint32_t> of_many_faces_;  ///< leaves
  std::map<std::pair<const EntityNode*, const Material*>, std::uint32_t> prototype_numbers_;
  RecompiledScene result_;
};

bool Recompiler::run() {
  CompiledScene& scene = result_.scene;
  take_stores();
  reserve();
  std::size_t next_added = 0;
  for (std::uint32_t place = 0; place < kept_.size(); ++place) {
    workers_.poll_at(place);
    if (kept_[place] == invalid_index) {
      take_entity(added_, next_added++, place);
    } else {
      take_entity(earlier_, kept_[place], place);
    }
  }
  take_materials();
  workers_.poll();
  if (!merge_surfaces({earlier_.scene, earlier_.new_faces}, {added_.scene, added_.new_faces},
                      scene))
    return false;
  workers_.poll();
  if (has_equal_instances()) return false;
  for (const std::uint32_t leaf : of_many_faces_)
    list_shared_faces(scene.leaves[leaf], scene.face_surfaces);
  finish_numbers(scene);
  return true;
}

/// Takes those stores that something kept is in, and then that of what is added.
void Recompiler::take_stores() {
  for (const std::uint32_t entity : kept_) {
    if (entity != invalid_index) earlier_.new_stores[earlier_.scene.entity_ends[entity].store] = 0;
  }
  std::vector<std::shared_ptr<CompiledStore>>& stores = result_.scene.stores;
  for (Source* source : {&earlier_, &added_}) {
    for (std::size_t i = 0; i < source->new_stores.size(); ++i) {
      if (source == &earlier_ && source->new_stores[i] == invalid_index) continue;
      source->new_stores[i] = static_cast<std::uint32_t>(stores.size());
      stores.push_back(source->scene.stores[i]);
    }
  }
  result_.scene.shared_nodes = added_.scene.shared_nodes;
  result_.scene.count = added_.scene.count;
  result_.scene.expanded_primitives = added_.scene.expanded_primitives;
}

void Recompiler::reserve() {
  CompiledScene& scene = result_.scene;
  const auto reserve_both = [&](auto& list, auto CompiledScene::*member) {
    list.reserve((earlier_.scene.*member).size() + (added_.scene.*member).size());
  };
  reserve_both(scene.leaves, &CompiledScene::leaves);
  reserve_both(scene.entity_ids, &CompiledScene::leaves);
  reserve_both(scene.face_surfaces, &CompiledScene::face_surfaces);
  reserve_both(scene.objects, &CompiledScene::objects);
  reserve_both(result_.earlier_objects, &CompiledScene::objects);
  reserve_both(scene.programs, &CompiledScene::programs);
  reserve_both(scene.instances, &CompiledScene::instances);
  reserve_both(materials_.of_leaves, &CompiledScene::leaves);
  scene.entity_ends.reserve(kept_.size());
}

void Recompiler::take_entity(Source& source, std::size_t entity, std::uint32_t place) {
  CompiledScene& scene = result_.scene;
  const std::vector<EntityEnds>& ends = source.scene.entity_ends;
  const EntityEnds begin = entity == 0 ? EntityEnds{} : ends[entity - 1];
  const EntityEnds& end = ends[entity];
  const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  // These may be below 0, modulo 2^32.
  const std::uint32_t leaf_shift = size(scene.leaves) - begin.leaf;
  const std::uint32_t program_shift = size(scene.programs) - begin.program;
  const std::uint32_t instance_shift = size(scene.instances) - begin.instance;
  const std::uint32_t face_shift = take_leaves(source, begin, end, place);
  if (&source == &earlier_ &&
      (leaf_shift != 0 || face_shift != 0 || size(scene.objects) != begin.object))
    result_.keeps_numbers = false;
  for (std::uint32_t i = begin.object; i < end.object; ++i) {
    SceneObject& object = scene.objects.emplace_back(source.scene.objects[i]);
    if (object.is_instance()) {
      object.instance += instance_shift;
    } else {
      object.first_leaf += leaf_shift;
    }
    if (object.is_csg()) object.program += program_shift;
    result_.earlier_objects.push_back(&source == &earlier_ ? i : invalid_index);
  }
  const auto programs = source.scene.programs.begin();
  scene.programs.insert(scene.programs.end(), programs + begin.program, programs + end.program);
  take_instances(source, begin, end, place);
  scene.entity_ends.push_back({size(scene.leaves), size(scene.objects), size(scene.programs),
                               size(scene.instances), source.new_stores[end.store]});
}

std::uint32_t Recompiler::take_leaves(Source& source, const EntityEnds& begin,
                                      const EntityEnds& end, std::uint32_t place) {
  CompiledScene& scene = result_.scene;
  const std::uint32_t first_face = source.first_face(begin.leaf);
  const std::uint32_t end_face = source.first_face(end.leaf);
  const std::uint32_t face_shift =
      static_cast<std::uint32_t>(scene.face_surfaces.size()) - first_face;
  for (std::uint32_t i = begin.leaf; i < end.leaf; ++i) {
    Leaf& leaf = scene.leaves.emplace_back(source.scene.leaves[i]);
    leaf.first_face += face_shift;
    if (leaf.takes_entity_id) leaf.entity_id = place;
    if (leaf.takes_part_id) leaf.part_id = place;
    const auto number = static_cast<std::uint32_t>(scene.leaves.size() - 1);
    if (leaf.face_count > Leaf::few_faces) of_many_faces_.push_back(number);
    if (leaf.is_mesh) scene.meshes.push_back(number);
    scene.entity_ids.push_back(leaf.entity_id);
    materials_.of_leaves.push_back(material_number(source, leaf, source.materials.of_leaves[i]));
  }
  const auto faces = source.scene.face_surfaces.begin();
  scene.face_surfaces.insert(scene.face_surfaces.end(), faces + first_face, faces + end_face);
  for (std::uint32_t face = first_face; face < end_face; ++face)
    source.new_faces[face] = face + face_shift;
  return face_shift;
}

void Recompiler::take_instances(Source& source, const EntityEnds& begin, const EntityEnds& end,
                                std::uint32_t place) {
  CompiledScene& scene = result_.scene;
  for (std::uint32_t i = begin.instance; i < end.instance; ++i) {
    Instance& instance = scene.instances.emplace_back(source.scene.instances[i]);
    if (!instance.id_is_of_all) instance.entity_id = place;
    if (!instance.has_part_id) instance.part_id = place;
    std::uint32_t& number = source.new_prototypes[instance.prototype];
    if (number == invalid_index) {
      const Prototype& prototype = source.scene.prototypes[instance.prototype];
      const auto [entry, added] =
          prototype_numbers_.try_emplace({prototype.node, prototype.material},
                                         static_cast<std::uint32_t>(scene.prototypes.size()));
      if (added) scene.prototypes.push_back(prototype);
      number = entry->second;
    }
    instance.prototype = number;
  }
}

/// Returns the number that a material of a leaf gets.
std::uint32_t Recompiler::material_number(Source& source, const Leaf& leaf, std::uint32_t number) {
  std::uint32_t& result = source.new_materials[number];
  if (result != invalid_index) return result;
  if (leaf.has_materials) {
    result = numbering_.number(*leaf.shape->facet_attributes());
  } else if (number == source.materials.default_material) {
    result = numbering_.number(nullptr);
  } else {
    result = numbering_.number(&source.materials.list[number]);
  }
  return result;
}

void Recompiler::take_materials() {
  materials_.default_material = numbering_.default_number();
  materials_.list = numbering_.take_materials();
  for (const Prototype& prototype : result_.scene.prototypes) {
    const std::vector<SharedMaterial>& list = prototype.scene->materials->list;
    materials_.of_prototypes.push_back(static_cast<std::uint32_t>(materials_.list.size()));
    materials_.list.insert(materials_.list.end(), list.begin(), list.end());
  }
  result_.scene.materials = std::make_shared<const MaterialTable>(std::move(materials_));
}

/// Returns whether an instance that was added may be the same as one that was kept.
bool Recompiler::has_equal_instances() const {
  const CompiledScene& scene = result_.scene;
  std::map<std::array<double, 3>, std::vector<const SceneObject*>> added;
  const auto corner = [](const SceneObject& object) {
    const Vec3& lower = object.bounds.lower;
    return std::array<double, 3>{lower.x, lower.y, lower.z};
  };
  const auto prototype_of = [&](const SceneObject& object) {
    return scene.instances[object.instance].prototype;
  };
  const auto is_added = [&](std::size_t object) {
    return scene.objects[object].is_instance() && result_.earlier_objects[object] == invalid_index;
  };
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (is_added(i)) added[corner(scene.objects[i])].push_back(&scene.objects[i]);
  }
  if (added.empty()) return false;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const SceneObject& object = scene.objects[i];
    if (!object.is_instance() || is_added(i)) continue;
    const auto found = added.find(corner(object));
    if (found == added.end()) continue;
    for (const SceneObject* const other : found->second) {
      if (prototype_of(object) == prototype_of(*other)) return true;
    }
  }
  return false;
}

/// Returns whether more is in the stores of the parts that are kept than is worth keeping.
bool has_grown(const CompiledScene& earlier, std::span<const std::uint32_t> kept) {
  std::vector<bool> used(earlier.stores.size(), false);
  std::size_t kept_leaves = 0;
  for (const std::uint32_t entity : kept) {
    if (entity == invalid_index) continue;
    const std::uint32_t begin = entity == 0 ? 0 : earlier.entity_ends[entity - 1].leaf;
    kept_leaves += earlier.entity_ends[entity].leaf - begin;
    used[earlier.entity_ends[entity].store] = true;
  }
  std::size_t stored = 0;
  std::size_t stores = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    ++stores;
    stored += earlier.stores[i]->shapes.size();
  }
  constexpr std::size_t few = 64;
  return stores >= max_stores || stored > 2 * kept_leaves + few;
}

}  // namespace

std::optional<RecompiledScene> recompile(const CompiledScene& earlier,
                                         const MaterialTable& earlier_materials,
                                         std::span<const Entity> entities,
                                         std::span<const std::uint32_t> kept,
                                         std::span<const EntityNode* const> removed,
                                         Precision precision, const Workers& workers,
                                         const PrimitiveLimit& limit) {
  std::vector<std::uint32_t> places;
  for (std::uint32_t place = 0; place < kept.size(); ++place) {
    if (kept[place] == invalid_index) places.push_back(place);
  }
  const bool can_be_kept = !earlier.entity_ends.empty() && earlier.expanded_primitives == 0 &&
                           2 * places.size() <= kept.size();
  if (!can_be_kept || has_grown(earlier, kept)) return std::nullopt;
  Instancing instancing;
  Instancing::Count count = earlier.count;
  for (const EntityNode* const entity : removed) Instancing::remove(*entity, count);
  for (const std::uint32_t place : places) Instancing::add(entities[place].node(), count);
  if (!earlier.shared_nodes.empty() || Instancing::may_share(count)) {
    instancing = Instancing(entities);
    if (instancing.shared_nodes() != earlier.shared_nodes) return std::nullopt;
    count = instancing.count(entities, PrimitiveLimit::max_numbered);
  }
  const CompiledScene added = compile_some(entities, places, std::move(instancing), count,
                                           earlier.prototypes, precision, workers, limit);
  if (added.entity_ends.size() != places.size()) return std::nullopt;
  Recompiler recompiler(earlier, earlier_materials, added, kept, workers);
  if (!recompiler.run()) return std::nullopt;
  return recompiler.take_result();
}

}  // namespace crt::core
