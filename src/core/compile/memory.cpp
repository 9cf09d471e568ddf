#include "core/compile/memory.hpp"

namespace crt::core {

namespace {

std::uint64_t unlisted_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = 0;
  for (const Leaf& leaf : scene.leaves) {
    if (leaf.unlisted) bytes += sizeof(UnlistedFaces) + bytes_of(leaf.unlisted->some);
  }
  return bytes;
}

std::uint64_t store_bytes(const CompiledStore& store) {
  return bytes_of(store.placements) + bytes_of(store.shapes) + bytes_of(store.exact_shapes) +
         store.shape_bytes + store.transforms.bytes();
}

}  // namespace

std::uint64_t primitive_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = bytes_of(scene.leaves) + bytes_of(scene.face_surfaces) +
                        unlisted_bytes(scene) + bytes_of(scene.objects) +
                        bytes_of(scene.instances) + scene.chains.capacity() * sizeof(void*) +
                        bytes_of(scene.entity_ends) + bytes_of(scene.surfaces);
  for (const auto& store : scene.stores) bytes += store_bytes(*store);
  for (const Prototype& prototype : scene.prototypes)
    bytes += sizeof *prototype.scene + primitive_bytes(*prototype.scene);
  return bytes;
}

std::uint64_t csg_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = scene.programs.capacity() * sizeof(void*);
  for (const auto& store : scene.stores) {
    bytes += bytes_of(store->programs);
    for (const CsgProgram& program : store->programs) {
      bytes += bytes_of(program.nodes) + bytes_of(program.leaf_parents) + program.tree.bytes() +
               program.paths.bytes() + program.filter.bytes();
    }
  }
  for (const Prototype& prototype : scene.prototypes) bytes += csg_bytes(*prototype.scene);
  return bytes;
}

std::uint64_t solid_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = 0;
  for (const auto& store : scene.stores) {
    bytes += bytes_of(store->solids);
    for (const auto& solid : store->solids) bytes += solid->bytes();
  }
  return bytes;
}

}  // namespace crt::core
