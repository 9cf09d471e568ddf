#include "core/compile/duplicates.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>
#include <tuple>
#include <vector>

#include "core/compile/surface_table.hpp"
#include "core/geometry/description.hpp"
#include "core/ray/world_ray.hpp"
#include "core/shading/opacity.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

struct Hash {
  std::uint64_t value = 0xcbf29ce484222325u;

  void mix(std::uint64_t word) {
    value = (value ^ word) * 0x9e3779b97f4a7c15u;
    value ^= value >> 32;
  }
  void mix(const Transform& map) {
    for (const Vec3& v : {map.row_x, map.row_y, map.row_z, map.translation}) {
      for (int axis = 0; axis < 3; ++axis) mix(std::bit_cast<std::uint64_t>(v[axis] + 0.0));
    }
  }
};

class Duplicates {
 public:
  Duplicates(FlatScene& scene, std::span<const Leaf> leaves, std::span<const FaceSurface> faces,
             const Workers& workers)
      : scene_(scene), leaves_(leaves), faces_(faces), workers_(workers) {}

  bool remove() {
    if (!find_equal_leaves()) return false;
    keeps_leaf_.assign(leaves_.size(), true);
    next_class_ = static_cast<std::uint32_t>(leaves_.size());
    choose();
    if (std::find(keeps_leaf_.begin(), keeps_leaf_.end(), false) == keeps_leaf_.end()) return false;
    compact();
    return true;
  }

 private:
  struct HashedLeaf {
    std::uint64_t hash;
    std::uint32_t leaf;
  };
  /// A Child is a leaf or a node below a node.
  struct Child {
    std::uint32_t equal = 0;             ///< the class of all that is equal to it
    std::uint32_t first_leaf = 0;        ///< its first leaf in the program
    std::uint32_t node = invalid_index;  ///< the node, if it is one
  };

  // ---- leaves ----

  bool find_equal_leaves();
  std::uint64_t hash(std::uint32_t leaf) const;
  bool equal(std::uint32_t a, std::uint32_t b) const;

  // ---- trees and objects ----

  void choose();
  bool is_involved(const SceneObject& object) const;
  std::uint32_t leaf_count(const SceneObject& object) const {
    return object.is_csg() ? scene_.programs[object.program].leaf_count() : 1;
  }
  /// Drops equal children of nodes. Returns the class of what is left.
  std::uint32_t reduce(const CsgProgram& program, std::uint32_t first_program_leaf);
  std::uint32_t class_of(std::vector<std::uint32_t> signature) {
    const auto [entry, added] = classes_.try_emplace(std::move(signature), next_class_);
    if (added) ++next_class_;
    return entry->second;
  }
  void compact();
  void compact(CsgProgram& program, std::uint32_t first_program_leaf);

  FlatScene& scene_;
  std::span<const Leaf> leaves_;
  std::span<const FaceSurface> faces_;
  Workers workers_;
  std::vector<std::uint32_t> equal_;  ///< by leaf: the first that is equal
  std::vector<bool> has_equal_;       ///< by leaf
  std::vector<bool> keeps_leaf_;
  std::uint32_t next_class_ = 0;
  std::map<std::vector<std::uint32_t>, std::uint32_t> classes_;
};

/// Finds equal leaves and returns whether there are any. Their first faces are equal and lie on one
/// surface, which shows for most leaves that there is no other.
bool Duplicates::find_equal_leaves() {
  const auto first_surface = [&](const Leaf& leaf) { return faces_[leaf.first_face].surface; };
  const bool all_differ = std::all_of(leaves_.begin(), leaves_.end(), [&](const Leaf& leaf) {
    return leaf.face_count == 0 || first_surface(leaf) == leaf.first_face;
  });
  if (all_differ) return false;
  std::vector<std::uint8_t> begun(faces_.size(), 0);  // how many leaves begin with that surface, 2
                                                      // for more
  for (const Leaf& leaf : leaves_) {
    if (leaf.face_count == 0) continue;
    std::uint8_t& count = begun[first_surface(leaf)];
    count = static_cast<std::uint8_t>(std::min(count + 1, 2));
  }
  std::vector<HashedLeaf> hashed;
  equal_.resize(leaves_.size());
  has_equal_.assign(leaves_.size(), false);
  for (std::uint32_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    workers_.poll_at(leaf);
    equal_[leaf] = leaf;
    if (leaves_[leaf].face_count == 0 || begun[first_surface(leaves_[leaf])] < 2) continue;
    hashed.push_back({hash(leaf), leaf});
  }
  sort_in_parallel(std::span(hashed), workers_, [](const HashedLeaf& a, const HashedLeaf& b) {
    return std::tie(a.hash, a.leaf) < std::tie(b.hash, b.leaf);
  });
  bool any = false;
  for (std::size_t i = 1; i < hashed.size(); ++i) {
    // Where leaves differ though their hashes do not, some equal ones may be overlooked.
    workers_.poll_at(i);
    const std::uint32_t first = equal_[hashed[i - 1].leaf];
    const std::uint32_t leaf = hashed[i].leaf;
    if (hashed[i].hash != hashed[i - 1].hash || !equal(first, leaf)) continue;
    equal_[leaf] = first;
    has_equal_[leaf] = has_equal_[first] = true;
    any = true;
  }
  return any;
}

std::uint64_t Duplicates::hash(std::uint32_t leaf) const {
  Hash hash;
  const Primitive& primitive = *scene_.leaves[leaf].primitive;
  hash.mix(primitive.index() * 2 + (leaves_[leaf].complemented ? 1 : 0));
  const std::span<const std::byte> bytes = description_of(primitive);
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, &bytes[i], sizeof word);
    hash.mix(word);
  }
  hash.mix(leaves_[leaf].placement->to_world());
  return hash.value;
}

bool Duplicates::equal(std::uint32_t a, std::uint32_t b) const {
  const Primitive& one = *scene_.leaves[a].primitive;
  const Primitive& other = *scene_.leaves[b].primitive;
  return one.index() == other.index() && leaves_[a].complemented == leaves_[b].complemented &&
         leaves_[a].placement->has_map_of(*leaves_[b].placement) &&
         (&one == &other || std::ranges::equal(description_of(one), description_of(other)));
}

bool Duplicates::is_involved(const SceneObject& object) const {
  if (object.is_instance()) return false;
  const auto begin = has_equal_.begin() + object.first_leaf;
  return std::find(begin, begin + leaf_count(object), true) != begin + leaf_count(object);
}

void Duplicates::choose() {
  constexpr std::uint32_t opaque = invalid_index;  // stands in for a material's number
  std::vector<std::uint32_t> looks;
  for (std::uint32_t i = 0; i < scene_.materials.size(); ++i) {
    looks.push_back(lets_light_in(*scene_.materials[i]) ? i : opaque);
  }
  const auto look_of = [&](std::uint32_t leaf) {
    const std::uint32_t material = scene_.leaves[leaf].material;
    const auto* const first = looks.data() + material;
    const auto* const end = first + leaves_[leaf].material_count();
    return std::all_of(first, end, [&](std::uint32_t look) { return look == opaque; }) ? opaque
                                                                                       : material;
  };
  std::map<std::vector<std::uint32_t>, bool> seen;
  std::erase_if(scene_.objects, [&](const SceneObject& object) {
    workers_.poll_at(object.first_leaf);
    if (!is_involved(object)) return false;
    std::vector<std::uint32_t> key = {
        object.is_csg() ? reduce(scene_.programs[object.program], object.first_leaf)
                        : equal_[object.first_leaf],
        object.passed_by};
    const std::uint32_t end = object.first_leaf + leaf_count(object);
    for (std::uint32_t leaf = object.first_leaf; leaf < end; ++leaf) {
      if (keeps_leaf_[leaf]) key.push_back(look_of(leaf));
    }
    if (seen.try_emplace(std::move(key), true).second) return false;
    std::fill(keeps_leaf_.begin() + object.first_leaf, keeps_leaf_.begin() + end, false);
    return true;
  });
}

std::uint32_t Duplicates::reduce(const CsgProgram& program, std::uint32_t first_program_leaf) {
  const std::vector<CsgNode>& nodes = program.nodes;
  // The children of each node are side by side, those of the first node first.
  std::vector<std::uint32_t> ends(nodes.size() + 1, 0);
  for (std::size_t node = 1; node < nodes.size(); ++node) ++ends[nodes[node].parent + 1];
  for (const std::uint32_t parent : program.leaf_parents) ++ends[parent + 1];
  for (std::size_t node = 0; node < nodes.size(); ++node) ends[node + 1] += ends[node];
  std::vector<Child> children(ends.back());
  std::vector<std::uint32_t> next(ends.begin(), ends.end() - 1);
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    children[next[program.leaf_parents[i]]++] = {equal_[first_program_leaf + i], i};
  }
  std::vector<bool> drops_node(nodes.size(), false);
  std::uint32_t equal = 0;
  // Children come after their parents.
  for (auto node = static_cast<std::uint32_t>(nodes.size()); node-- > 0;) {
    workers_.poll_at(node);
    const std::span<Child> of_node =
        std::span(children).subspan(ends[node], ends[node + 1] - ends[node]);
    std::sort(of_node.begin(), of_node.end(), [](const Child& a, const Child& b) {
      return std::tie(a.equal, a.first_leaf) < std::tie(b.equal, b.first_leaf);
    });
    std::vector<std::uint32_t> signature = {nodes[node].needed};
    std::uint32_t first_leaf = invalid_index;
    for (const Child& child : of_node) {
      first_leaf = std::min(first_leaf, child.first_leaf);
      if (signature.size() > 1 && signature.back() == child.equal) {
        if (child.node == invalid_index) {
          keeps_leaf_[first_program_leaf + child.first_leaf] = false;
        } else {
          drops_node[child.node] = true;
        }
      } else {
        signature.push_back(child.equal);
      }
    }
    equal = signature.size() == 2 ? signature[1] : class_of(std::move(signature));
    if (node > 0) children[next[nodes[node].parent]++] = {equal, first_leaf, node};
  }
  for (std::size_t node = 1; node < nodes.size(); ++node) {
    if (drops_node[nodes[node].parent]) drops_node[node] = true;
  }
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    if (drops_node[program.leaf_parents[i]]) keeps_leaf_[first_program_leaf + i] = false;
  }
  return equal;
}

void Duplicates::compact() {
  std::vector<CsgProgram> programs;
  std::vector<std::uint32_t> kept_programs(scene_.programs.size() + 1, 0);  // before each
  for (SceneObject& object : scene_.objects) {
    if (!object.is_csg()) continue;
    CsgProgram program = std::move(scene_.programs[object.program]);
    compact(program, object.first_leaf);
    object.first_leaf += static_cast<std::uint32_t>(
        std::find(keeps_leaf_.begin() + object.first_leaf, keeps_leaf_.end(), true) -
        (keeps_leaf_.begin() + object.first_leaf));
    const std::uint32_t number = object.program;
    object.program = no_program;
    if (program.leaf_count() > 1) {
      object.program = static_cast<std::uint32_t>(programs.size());
      programs.push_back(std::move(program));
    }
    kept_programs[number + 1] = static_cast<std::uint32_t>(programs.size());
  }
  for (EntityEnds& ends : scene_.entity_ends) ends.program = kept_programs[ends.program];
  scene_.programs = std::move(programs);
  // Leaves move up.
  std::vector<std::uint32_t> places(leaves_.size(), 0);
  std::uint32_t count = 0;
  for (std::uint32_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    places[leaf] = count;
    if (keeps_leaf_[leaf]) scene_.leaves[count++] = scene_.leaves[leaf];
  }
  for (EntityEnds& ends : scene_.entity_ends)
    ends.leaf = ends.leaf < places.size() ? places[ends.leaf] : count;
  scene_.leaves.resize(count);
  scene_.programs_of_leaves.assign(count, no_program);
  for (SceneObject& object : scene_.objects) {
    if (object.is_instance()) continue;
    object.first_leaf = places[object.first_leaf];
    if (!object.is_csg()) continue;
    std::fill_n(scene_.programs_of_leaves.begin() + object.first_leaf, leaf_count(object),
                object.program);
  }
}

void Duplicates::compact(CsgProgram& program, std::uint32_t first_program_leaf) {
  std::vector<std::uint32_t> leaf_parents;
  std::vector<bool> keeps(program.nodes.size(), false);
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    if (!keeps_leaf_[first_program_leaf + i]) continue;
    leaf_parents.push_back(program.leaf_parents[i]);
    keeps[program.leaf_parents[i]] = true;
  }
  // A node is kept for what is below it. Children come after their parents.
  for (std::size_t node = program.nodes.size(); node-- > 1;) {
    if (keeps[node]) keeps[program.nodes[node].parent] = true;
  }
  std::vector<std::uint32_t> places(program.nodes.size(), 0);
  std::uint32_t count = 0;
  for (std::size_t node = 0; node < program.nodes.size(); ++node) {
    if (!keeps[node]) continue;
    places[node] = count;
    program.nodes[count] = program.nodes[node];
    program.nodes[count].parent = places[program.nodes[node].parent];
    ++count;
  }
  program.nodes.resize(count);
  for (std::uint32_t& parent : leaf_parents) parent = places[parent];
  program.leaf_parents = std::move(leaf_parents);
}

}  // namespace

void remove_equal_instances(FlatScene& scene, const Workers& workers) {
  struct Hashed {
    std::uint64_t hash;
    std::uint32_t object;
  };
  std::vector<Hashed> hashed;
  const auto instance_of = [&](const Hashed& entry) -> const Instance& {
    return scene.instances[scene.objects[entry.object].instance];
  };
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].is_instance()) continue;
    const Instance& instance = instance_of({0, i});
    Hash hash;
    hash.mix(instance.prototype);
    if (instance.to_world != nullptr) hash.mix(instance.to_world->product.rounded());
    hashed.push_back({hash.value, i});
  }
  sort_in_parallel(std::span(hashed), workers, [](const Hashed& a, const Hashed& b) {
    return std::tie(a.hash, a.object) < std::tie(b.hash, b.object);
  });
  const auto are_equal = [&](const Hashed& a, const Hashed& b) {
    const Instance& one = instance_of(a);
    const Instance& other = instance_of(b);
    if (a.hash != b.hash || one.prototype != other.prototype) return false;
    if (scene.objects[a.object].passed_by != scene.objects[b.object].passed_by) return false;
    if (one.to_world == other.to_world) return true;
    return one.to_world != nullptr && other.to_world != nullptr && one.to_world->is_plain() &&
           other.to_world->is_plain() &&
           one.to_world->product.rounded() == other.to_world->product.rounded();
  };
  std::vector<bool> drops(scene.objects.size(), false);
  for (std::size_t i = 1; i < hashed.size(); ++i) {
    // Equal ones follow one another, unless others have their hash, which may hide some.
    drops[hashed[i].object] = are_equal(hashed[i - 1], hashed[i]);
  }
  // Each is looked at where it stood.
  std::erase_if(scene.objects, [&](const SceneObject& object) {
    return drops[static_cast<std::size_t>(&object - scene.objects.data())];
  });
}

bool remove_duplicates(FlatScene& scene, std::span<const Leaf> leaves,
                       std::span<const FaceSurface> faces, const Workers& workers) {
  return Duplicates(scene, leaves, faces, workers).remove();
}

}  // namespace crt::core
