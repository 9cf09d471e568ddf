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

}  // namespace

std::uint64_t primitive_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = bytes_of(scene.placements) + bytes_of(scene.leaves) +
                        bytes_of(scene.face_surfaces) + unlisted_bytes(scene) +
                        bytes_of(scene.objects) + scene.shape_bytes + scene.transforms.bytes() +
                        bytes_of(scene.instances) + scene.chains.capacity() * sizeof(void*);
  for (const auto& prototype : scene.prototypes)
    bytes += sizeof *prototype + primitive_bytes(*prototype);
  return bytes;
}

std::uint64_t csg_bytes(const CompiledScene& scene) {
  std::uint64_t bytes = bytes_of(scene.programs);
  for (const CsgProgram& program : scene.programs) {
    bytes += bytes_of(program.nodes) + bytes_of(program.leaf_parents) + program.tree.bytes() +
             program.paths.bytes() + program.filter.bytes();
  }
  for (const auto& prototype : scene.prototypes) bytes += csg_bytes(*prototype);
  return bytes;
}

}  // namespace crt::core
