#include "core/compile/compile.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/compile/duplicates.hpp"
#include "core/compile/flatten.hpp"
#include "core/compile/surface_table.hpp"
#include "core/compile/unlisted_faces.hpp"
#include "core/tasks/parallel.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Counts each node's children, and those that are true where every leaf is outside.
void finish_nodes(CsgProgram& program, std::span<const Leaf> leaves) {
  std::vector<CsgNode>& nodes = program.nodes;
  std::vector<std::uint32_t> children(nodes.size(), 0);
  for (std::size_t node = 1; node < nodes.size(); ++node) ++children[nodes[node].parent];
  for (const std::uint32_t parent : program.leaf_parents) ++children[parent];
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (nodes[node].needed == all_children) nodes[node].needed = children[node];
  }
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i].complemented) ++nodes[program.leaf_parents[i]].count_outside;
  }
  // Children come after their parents.
  for (std::size_t node = nodes.size(); node-- > 1;) {
    const CsgNode& child = nodes[node];
    if (child.count_outside >= child.needed) ++nodes[child.parent].count_outside;
  }
}

/// Numbers the surfaces that several faces of a program are on. Until then `shared` is the first
/// face of the program on the surface.
std::uint32_t number_shared(std::span<const Leaf> leaves, std::span<FaceSurface> faces) {
  std::uint32_t count = 0;
  for (const Leaf& leaf : leaves) {
    for (std::uint32_t face = leaf.first_face; face < leaf.first_face + leaf.face_count; ++face) {
      std::uint32_t& shared = faces[face].shared;
      if (shared == FaceSurface::not_shared) continue;
      shared = shared == face ? count++ : faces[shared].shared;
    }
  }
  return count;
}

/// Narrows the boxes of the leaves to where they matter. Returns the box around the object.
//
// Every node has a box outside of which its value is its outside value: the one that it has where
// all leaves are outside of their primitives. If one child's outside value is enough for that, the
// boxes of all such children are boxes of the node, and so is their intersection. What a leaf does
// outside of the boxes of all nodes above it does not matter. So the leaf's own box is clipped by
// these, and a ray that misses the rest may leave out the leaf.
Bounds narrow_bounds(const CsgProgram& program, std::span<Leaf> leaves) {
  const auto outside_value = [&](std::size_t node) {
    return program.nodes[node].count_outside >= program.nodes[node].needed;
  };
  const auto one_is_enough = [&](std::size_t node) {
    return outside_value(node) == (program.nodes[node].needed == 1);
  };
  std::vector<Bounds> bounds(program.nodes.size());
  for (std::size_t node = 0; node < bounds.size(); ++node) {
    if (one_is_enough(node)) bounds[node] = Bounds::everything();
  }
  const auto add = [&](std::uint32_t node, const Bounds& child, bool child_value) {
    if (!one_is_enough(node)) {
      if (!child.empty()) bounds[node].include(child);
    } else if (child_value == outside_value(node)) {
      bounds[node] = bounds[node].clipped(child);
    }
  };
  // Children come after their parents.
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = leaves[i];
    add(program.leaf_parents[i], leaf.bounds, leaf.complemented);
  }
  for (std::size_t node = bounds.size(); node-- > 1;) {
    add(program.nodes[node].parent, bounds[node], outside_value(node));
  }
  for (std::size_t node = 1; node < bounds.size(); ++node) {
    bounds[node] = bounds[node].clipped(bounds[program.nodes[node].parent]);
  }
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    Leaf& leaf = leaves[i];
    leaf.bounds = leaf.bounds.clipped(bounds[program.leaf_parents[i]]);
  }
  return bounds[0];
}

class Compiler {
 public:
  /// Prototypes that `earlier` has are not compiled again.
  Compiler(FlatScene flat, std::span<const Prototype> earlier, Precision precision,
           const Workers& workers)
      : precision_(precision),
        workers_(workers),
        flat_(std::move(flat)),
        earlier_(earlier),
        keeps_chains_(precision == Precision::exact || !flat_.instances.empty()) {
    result_.stores.push_back(std::make_shared<CompiledStore>());
  }

  CompiledScene compile();
  /// Compiles what instances share.
  CompiledScene compile_prototype();

 private:
  CompiledStore& store() { return *result_.stores[0]; }
  void make_placements();
  void make_leaves();
  void make_faces();
  void finish_program(const SceneObject& object);
  void finish_programs();
  void make_prototypes();
  void finish_objects();
  Bounds bounds_of(const SceneObject& object) const;

  Precision precision_;
  Workers workers_;
  FlatScene flat_;
  std::span<const Prototype> earlier_;
  bool keeps_chains_;  ///< whether something refers to the maps of placements later
  MaterialTable materials_;
  CompiledScene result_;
};

CompiledScene Compiler::compile() {
  make_placements();
  // The placements may take half of all memory, and are not needed again.
  flat_.placements = {};
  flat_.transforms = {};
  make_leaves();
  make_faces();
  const std::size_t object_count = flat_.objects.size();
  remove_equal_instances(flat_, workers_);
  if (remove_duplicates(flat_, result_.leaves, result_.face_surfaces, workers_)) {
    make_leaves();
    make_faces();
  }
  // Where an object counts once that is there twice, what is kept depends on what goes.
  const bool is_unlisted = std::any_of(result_.leaves.begin(), result_.leaves.end(),
                                       [](const Leaf& leaf) { return leaf.unlisted != nullptr; });
  if (flat_.objects.size() == object_count && !is_unlisted)
    result_.entity_ends = std::move(flat_.entity_ends);
  if (result_.entity_ends.empty()) result_.surfaces = {};
  result_.count = flat_.count;
  result_.expanded_primitives = flat_.expanded_primitives;
  materials_.list = std::move(flat_.materials);
  materials_.default_material = flat_.default_material;
  store().programs = std::move(flat_.programs);
  store().programs.shrink_to_fit();
  finish_programs();
  make_prototypes();
  result_.materials = std::make_shared<const MaterialTable>(std::move(materials_));
  result_.instances = std::move(flat_.instances);
  finish_objects();
  finish_numbers(result_);
  return std::move(result_);
}

CompiledScene Compiler::compile_prototype() {
  keeps_chains_ = true;
  result_.chains = flat_.placements;
  result_.precision = precision_;
  CompiledScene prototype = compile();
  for (Leaf& leaf : prototype.leaves) {
    leaf.family = nullptr;  // as instances may move it
    for (const Vec3& corner : {leaf.bounds.lower, leaf.bounds.upper}) {
      for (int axis = 0; axis < 3; ++axis) {
        if (std::isfinite(corner[axis]))
          prototype.farthest = std::max(prototype.farthest, std::abs(corner[axis]));
      }
    }
  }
  return prototype;
}

void Compiler::make_prototypes() {
  for (const PrototypeSource& source : flat_.prototypes) {
    workers_.poll();
    const Material* const material = source.material == nullptr ? nullptr : &**source.material;
    const auto found =
        std::find_if(earlier_.begin(), earlier_.end(), [&](const Prototype& prototype) {
          return prototype.node == source.node && prototype.material == material;
        });
    Prototype prototype{source.node, material, nullptr};
    prototype.scene =
        found != earlier_.end()
            ? found->scene
            : std::make_shared<const CompiledScene>(
                  Compiler(flatten(source, precision_, workers_), {}, precision_, workers_)
                      .compile_prototype());
    // Those of facets stand side by side, so all of them are taken as they stand.
    const std::vector<SharedMaterial>& list = prototype.scene->materials->list;
    materials_.of_prototypes.push_back(static_cast<std::uint32_t>(materials_.list.size()));
    materials_.list.insert(materials_.list.end(), list.begin(), list.end());
    result_.prototypes.push_back(std::move(prototype));
  }
}

void Compiler::make_placements() {
  const bool exact = precision_ == Precision::exact;
  std::vector<Placement>& placements = store().placements;
  placements.resize(flat_.placements.size());
  for_ranges(flat_.placements.size(), items_for_a_thread / 4, workers_,
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t i = std::max<std::size_t>(begin, 1); i < end; ++i) {
                 const TransformChain& to_world = *flat_.placements[i];
                 placements[i] = exact ? Placement(to_world) : Placement(to_world.product);
               }
             });
  if (keeps_chains_) store().transforms = std::move(flat_.transforms);
}

void Compiler::make_leaves() {
  const std::size_t count = flat_.leaves.size();
  const bool is_exact = precision_ == Precision::exact;
  CompiledStore& store = this->store();
  result_.leaves.clear();
  result_.leaves.resize(count);
  materials_.of_leaves.resize(count);
  result_.entity_ids.resize(count);
  store.shapes.clear();
  store.shapes.resize(count);
  store.exact_shapes.clear();
  store.exact_shapes.resize(is_exact ? count : 0);
  std::atomic<std::uint64_t> shape_bytes = 0;
  for_ranges(count, items_for_a_thread / 4, workers_, [&](std::size_t begin, std::size_t end) {
    std::uint64_t bytes = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const LeafSource& source = flat_.leaves[i];
      Leaf& leaf = result_.leaves[i];
      store.shapes[i] = make_shape(*source.primitive);
      leaf.shape = store.shapes[i].get();
      if (is_exact) {
        store.exact_shapes[i] = make_exact_shape(*source.primitive);
        leaf.exact = store.exact_shapes[i].get();
      }
      leaf.placement = &store.placements[source.placement];
      leaf.bounds = leaf.placement->bounds_to_world(leaf.shape->bounds());
      materials_.of_leaves[i] = source.material;
      leaf.entity_id = source.entity_id;
      leaf.part_id = source.part_id;
      leaf.user = source.user;
      leaf.complemented = source.complemented;
      leaf.has_materials = source.has_materials;
      leaf.is_mesh = source.is_mesh;
      result_.entity_ids[i] = source.entity_id;
      leaf.takes_entity_id = source.takes_entity_id;
      leaf.takes_part_id = source.takes_part_id;
      leaf.takes_user = source.takes_user;
      const FacetAttributes* const facets = leaf.shape->facet_attributes();
      leaf.has_normals = facets != nullptr && facets->has_normals();
      const bool is_plain = !leaf.complemented && leaf.placement->is_identity();
      leaf.family = is_plain ? leaf.shape->family() : nullptr;
      leaf.face_count = leaf.shape->listed_face_count();
      bytes += leaf.shape->bytes() + (leaf.exact ? leaf.exact->bytes() : 0);
    }
    shape_bytes += bytes;
  });
  store.shape_bytes = shape_bytes;
  result_.meshes.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if (flat_.leaves[i].is_mesh) result_.meshes.push_back(i);
  }
}

void Compiler::make_faces() {
  find_unlisted_faces(result_.leaves, workers_);
  constexpr std::uint64_t max_faces = 0xfffffff0u;
  std::uint64_t count = 0;
  std::uint64_t unlisted = 0;
  for (const Leaf& leaf : result_.leaves) {
    if (leaf.unlisted) unlisted += leaf.shape->face_count();
  }
  for (Leaf& leaf : result_.leaves) {
    leaf.first_face = static_cast<std::uint32_t>(count);
    count += leaf.face_count;
    if (count + unlisted > max_faces) {
      throw Error(ErrorCode::limit,
                  text::format("the primitives of the scene have more than {} faces", max_faces),
                  "entities");
    }
  }
  result_.face_surfaces.assign(count, {});
  for (Leaf& leaf : result_.leaves) {
    if (!leaf.unlisted) continue;
    leaf.unlisted->first_surface = static_cast<std::uint32_t>(count);
    count += leaf.shape->face_count();
  }
  result_.surfaces =
      number_surfaces(result_.leaves, flat_.programs_of_leaves, result_.face_surfaces, workers_);
  for (Leaf& leaf : result_.leaves) list_shared_faces(leaf, result_.face_surfaces);
}

void Compiler::finish_programs() {
  // A large program uses all threads by itself, and many small ones are done side by side.
  constexpr std::uint32_t large = 2 * items_for_a_thread;
  std::vector<const SceneObject*> small;
  for (const CsgProgram& program : store().programs) result_.programs.push_back(&program);
  for (const SceneObject& object : flat_.objects) {
    if (!object.is_csg()) continue;
    if (result_.program_of(object).leaf_count() >= large) {
      finish_program(object);
    } else {
      small.push_back(&object);
    }
  }
  constexpr std::size_t programs_at_once = 64;
  for_ranges(small.size(), programs_at_once, workers_, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) finish_program(*small[i]);
  });
}

void Compiler::finish_program(const SceneObject& object) {
  CsgProgram& program = store().programs[object.program];
  const std::span<Leaf> leaves =
      std::span(result_.leaves).subspan(object.first_leaf, program.leaf_count());
  workers_.poll();
  finish_nodes(program, leaves);
  workers_.poll();
  program.paths = HeavyPaths(program.nodes);
  workers_.poll();
  program.nodes.shrink_to_fit();
  program.leaf_parents.shrink_to_fit();
  program.shared_surfaces = number_shared(leaves, result_.face_surfaces);
  program.bounds = narrow_bounds(program, leaves);
  workers_.poll();
  std::vector<Bounds> boxes;
  boxes.reserve(leaves.size());
  for (const Leaf& leaf : leaves) boxes.push_back(leaf.bounds);
  program.tree = Bvh(boxes, workers_);
  program.filter = IntervalFilter(program, leaves);
}

void Compiler::finish_objects() {
  result_.objects.reserve(flat_.objects.size());
  auto entity = result_.entity_ends.begin();
  for (std::uint32_t i = 0; i < flat_.objects.size(); ++i) {
    SceneObject& object = flat_.objects[i];
    workers_.poll_at(i);
    for (; entity != result_.entity_ends.end() && entity->object <= i; ++entity)
      entity->object = static_cast<std::uint32_t>(result_.objects.size());
    object.bounds = bounds_of(object);
    // A surface that is no solid is an object by itself.
    if (!object.solid && !object.is_instance()) result_.leaves[object.first_leaf].of_solid = false;
    if (!object.bounds.empty()) result_.objects.push_back(object);
  }
  for (; entity != result_.entity_ends.end(); ++entity)
    entity->object = static_cast<std::uint32_t>(result_.objects.size());
}

Bounds Compiler::bounds_of(const SceneObject& object) const {
  if (object.is_csg()) return result_.program_of(object).bounds;
  if (!object.is_instance()) return result_.leaves[object.first_leaf].bounds;
  const CompiledScene& prototype = result_.prototype_of(object);
  if (prototype.objects.empty()) return {};
  const TransformChain* const to_world = result_.instances[object.instance].to_world;
  const Bounds& bounds = prototype.objects[0].bounds;
  return to_world == nullptr ? bounds : moved_bounds(to_world->product.rounded(), bounds);
}

}  // namespace

CompiledScene compile_some(std::span<const Entity> entities, std::span<const std::uint32_t> places,
                           Instancing instancing, const Instancing::Count& count,
                           std::span<const Prototype> earlier, Precision precision,
                           const Workers& workers, const PrimitiveLimit& limit) {
  std::vector<const EntityNode*> shared_nodes = instancing.shared_nodes();
  FlatScene flat =
      flatten(entities, places, std::move(instancing), count, precision, workers, limit);
  const bool refers_to_entities = precision == Precision::exact || !flat.instances.empty();
  CompiledScene result = Compiler(std::move(flat), earlier, precision, workers).compile();
  result.shared_nodes = std::move(shared_nodes);
  if (refers_to_entities) {
    for (const std::uint32_t place : places)
      result.stores[0]->entities.push_back(entities[place].shared_node());
  }
  return result;
}

CompiledScene compile(std::span<const Entity> entities, Precision precision, const Workers& workers,
                      const PrimitiveLimit& limit) {
  std::vector<std::uint32_t> places(entities.size());
  std::iota(places.begin(), places.end(), 0u);
  Instancing instancing(entities);
  const Instancing::Count count = instancing.count(entities, PrimitiveLimit::max_numbered);
  return compile_some(entities, places, std::move(instancing), count, {}, precision, workers,
                      limit);
}

}  // namespace crt::core
