#include "core/compile/merged_surfaces.hpp"

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <vector>

#include "core/compile/surface_table.hpp"

namespace crt::core {

namespace {

using Surfaces = std::span<const HashedSurface>;

bool has_lower_hash(const HashedSurface& a, const HashedSurface& b) {
  return a.hash < b.hash;
}

/// Puts the numbers of surfaces that are those of a source into those of the merged scene. A
/// surface has the number of the first face on it that is there.
void renumber(const SurfaceSource& source, std::span<FaceSurface> faces) {
  std::unordered_map<std::uint32_t, std::uint32_t> of_left_out;
  for (const std::uint32_t face : source.new_faces) {
    if (face == invalid_index) continue;
    std::uint32_t& surface = faces[face].surface;
    const std::uint32_t first = source.new_faces[surface];
    surface = first != invalid_index ? first : of_left_out.try_emplace(surface, face).first->second;
  }
}

class Merging {
 public:
  Merging(const SurfaceSource& kept, const SurfaceSource& added, CompiledScene& merged)
      : kept_(kept), added_(added), merged_(merged), meets_kept_(added.new_faces.size(), 0) {}

  bool run() {
    renumber(kept_, merged_.face_surfaces);
    renumber(added_, merged_.face_surfaces);
    const std::vector<HashedSurface>& surfaces = added_.scene.surfaces;
    for (auto begin = surfaces.begin(); begin != surfaces.end();) {
      const auto end = std::upper_bound(begin, surfaces.end(), *begin, has_lower_hash);
      merge(Surfaces(begin, end), of_hash(begin->hash));
      begin = end;
    }
    if (may_have_equal_leaves()) return false;
    list_surfaces();
    return true;
  }

 private:
  std::uint32_t& surface_of(std::uint32_t face) { return merged_.face_surfaces[face].surface; }
  const Leaf& leaf_of(std::uint32_t face) const {
    const auto after = std::upper_bound(
        merged_.leaves.begin(), merged_.leaves.end(), face,
        [](std::uint32_t wanted, const Leaf& leaf) { return wanted < leaf.first_face; });
    return *std::prev(after);
  }
  bool are_on_one(std::uint32_t a, std::uint32_t b) const {
    const Leaf& one = leaf_of(a);
    const Leaf& other = leaf_of(b);
    return are_on_one_surface(one, a - one.first_face, other, b - other.first_face);
  }
  /// Returns those kept, and those left out, that have a hash.
  Surfaces of_hash(std::uint32_t hash) const {
    const std::vector<HashedSurface>& surfaces = kept_.scene.surfaces;
    const auto [begin, end] =
        std::equal_range(surfaces.begin(), surfaces.end(), HashedSurface{hash, 0}, has_lower_hash);
    return {begin, end};
  }

  /// Brings together what is on one surface among faces that have one hash.
  void merge(Surfaces of_added, Surfaces of_kept) {
    if (of_kept.empty()) return;
    for (const HashedSurface& added : of_added) {
      const std::uint32_t first = added_.new_faces[added.face];
      if (surface_of(first) == first) merge_surface(first, of_added, of_kept);
    }
  }

  /// Brings the surface that an added face is the first of together with one that is kept.
  void merge_surface(std::uint32_t first_added, Surfaces of_added, Surfaces of_kept) {
    const auto is_first = [&](const HashedSurface& kept) {
      const std::uint32_t face = kept_.new_faces[kept.face];
      return face != invalid_index && surface_of(face) == face && are_on_one(face, first_added);
    };
    const auto found = std::find_if(of_kept.begin(), of_kept.end(), is_first);
    if (found == of_kept.end()) return;
    const std::uint32_t first_kept = kept_.new_faces[found->face];
    const std::uint32_t first = std::min(first_kept, first_added);
    for (const HashedSurface& added : of_added) {
      const std::uint32_t face = added_.new_faces[added.face];
      if (surface_of(face) != first_added) continue;
      meets_kept_[added.face] = 1;
      if (face != first_added) surface_of(face) = first;
    }
    surface_of(first_added) = first;
    if (first == first_kept) return;
    for (const HashedSurface& kept : of_kept) {
      const std::uint32_t face = kept_.new_faces[kept.face];
      if (face != invalid_index && face != first_kept && surface_of(face) == first_kept)
        surface_of(face) = first;
    }
    surface_of(first_kept) = first;
  }

  /// Returns whether a kept leaf may be equal to an added one. All of their faces are on the same
  /// surfaces then.
  bool may_have_equal_leaves() {
    std::vector<std::uint32_t> hashes(added_.new_faces.size());
    for (const HashedSurface& surface : added_.scene.surfaces) hashes[surface.face] = surface.hash;
    return std::any_of(
        added_.scene.leaves.begin(), added_.scene.leaves.end(), [&](const Leaf& leaf) {
          const auto meets = std::span(meets_kept_).subspan(leaf.first_face, leaf.face_count);
          return !meets.empty() && std::find(meets.begin(), meets.end(), 0) == meets.end() &&
                 has_equal(leaf, std::span(hashes).subspan(leaf.first_face, leaf.face_count));
        });
  }

  bool has_equal(const Leaf& added, std::span<const std::uint32_t> hashes) {
    // That face tells most on whose surface there are fewest others.
    std::uint32_t number = 0;
    Surfaces fewest = of_hash(hashes[0]);
    for (std::uint32_t i = 1; i < hashes.size(); ++i) {
      const Surfaces others = of_hash(hashes[i]);
      if (others.size() >= fewest.size()) continue;
      number = i;
      fewest = others;
    }
    const std::uint32_t first_face = added_.new_faces[added.first_face];
    return std::any_of(fewest.begin(), fewest.end(), [&](const HashedSurface& kept) {
      const std::uint32_t face = kept_.new_faces[kept.face];
      if (face == invalid_index) return false;
      const Leaf& leaf = leaf_of(face);
      if (face - leaf.first_face != number || leaf.face_count != added.face_count) return false;
      for (std::uint32_t i = 0; i < leaf.face_count; ++i) {
        if (surface_of(leaf.first_face + i) != surface_of(first_face + i)) return false;
      }
      return true;
    });
  }

  /// Lists all faces by their hashes.
  void list_surfaces() {
    const auto renumbered = [](const SurfaceSource& source) {
      std::vector<HashedSurface> result;
      result.reserve(source.scene.surfaces.size());
      for (const HashedSurface& surface : source.scene.surfaces) {
        const std::uint32_t face = source.new_faces[surface.face];
        if (face != invalid_index) result.push_back({surface.hash, face});
      }
      return result;
    };
    const std::vector<HashedSurface> kept = renumbered(kept_);
    const std::vector<HashedSurface> added = renumbered(added_);
    merged_.surfaces.reserve(kept.size() + added.size());
    std::merge(kept.begin(), kept.end(), added.begin(), added.end(),
               std::back_inserter(merged_.surfaces), has_lower_hash);
  }

  const SurfaceSource& kept_;
  const SurfaceSource& added_;
  CompiledScene& merged_;
  std::vector<char> meets_kept_;  ///< by added face, whether a kept one is on its surface
};

}  // namespace

bool merge_surfaces(const SurfaceSource& kept, const SurfaceSource& added, CompiledScene& merged) {
  return Merging(kept, added, merged).run();
}

}  // namespace crt::core
