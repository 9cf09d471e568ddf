#include "core/intersect/isolated.hpp"

#include <algorithm>

#include "core/shading/opacity.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// At most so many boxes are looked at for one object.
constexpr int max_looks = 1024;

/// A BoxLevels has boxes of objects that lie in memory as they lie in space, then boxes around
/// every few of them, and so on.
class BoxLevels {
 public:
  BoxLevels(const CompiledScene& scene, std::span<const std::uint32_t> objects)
      : scene_(scene), objects_(objects) {
    for (std::size_t count = objects.size(); count > 1; count = levels_.back().size()) {
      std::vector<Bounds> level((count + width - 1) / width);
      for (std::size_t i = 0; i < count; ++i) level[i / width].include(box(levels_.size(), i));
      levels_.push_back(std::move(level));
    }
  }

  /// Returns whether a box touches that of any object but one.
  bool touches_other(const Bounds& margin, std::uint32_t object) const {
    int looks = 0;
    return touches(margin, object, levels_.size(), 0, looks);
  }

 private:
  static constexpr std::size_t width = 8;

  const Bounds& box(std::size_t level, std::size_t index) const {
    if (level > 0) return levels_[level - 1][index];
    return objects_[index] == invalid_index ? nothing_ : scene_.objects[objects_[index]].bounds;
  }
  std::size_t size(std::size_t level) const {
    return level == 0 ? objects_.size() : levels_[level - 1].size();
  }

  bool touches(const Bounds& margin, std::uint32_t object, std::size_t level, std::size_t index,
               int& looks) const {
    if (++looks > max_looks) return true;
    if (!box(level, index).touches(margin)) return false;
    if (level == 0) return objects_[index] != object;
    const std::size_t end = std::min((index + 1) * width, size(level - 1));
    for (std::size_t child = index * width; child < end; ++child) {
      if (touches(margin, object, level - 1, child, looks)) return true;
    }
    return false;
  }

  const CompiledScene& scene_;
  std::span<const std::uint32_t> objects_;
  Bounds nothing_;
  std::vector<std::vector<Bounds>> levels_;
};

}  // namespace

bool all_pass_by(const CompiledScene& scene, const BoundingProxies& proxies, const Bounds& box) {
  return std::all_of(proxies.list.begin(), proxies.list.end(), [&](const BoundingProxy& proxy) {
    return proxy.object == invalid_index || !scene.objects[proxy.object].bounds.touches(box) ||
           (proxy.is_met_with_solid() && proxy.solid->passes_by(box));
  });
}

std::vector<std::uint32_t> isolated_objects(const CompiledScene& scene,
                                            std::span<const std::uint32_t> bounded,
                                            const BoundingProxies& unbounded, double margin,
                                            const Workers& workers) {
  const std::span<const SharedMaterial> materials = scene.materials->list;
  const bool is_light_let_in =
      std::any_of(materials.begin(), materials.end(),
                  [](const auto& material) { return lets_light_in(*material); });
  if (!is_light_let_in || bounded.empty()) return {};

  std::vector<std::uint32_t> isolated(scene.objects.size(), invalid_index);
  const BoxLevels boxes(scene, bounded);
  const auto is_isolated = [&](std::uint32_t index) {
    const SceneObject& object = scene.objects[index];
    if (object.is_instance()) return false;
    const std::span<const Leaf> leaves = scene.leaves_of(object);
    if (!object.solid || std::none_of(leaves.begin(), leaves.end(), [&](const Leaf& leaf) {
          const auto number = static_cast<std::size_t>(&leaf - scene.leaves.data());
          const auto of_leaf =
              materials.subspan(scene.materials->of_leaves[number], leaf.material_count());
          return std::any_of(of_leaf.begin(), of_leaf.end(),
                             [](const auto& material) { return lets_light_in(*material); });
        })) {
      return false;
    }
    const Bounds around = object.bounds.grown(2 * margin);
    return all_pass_by(scene, unbounded, around) && !boxes.touches_other(around, index);
  };
  for_ranges(bounded.size(), items_for_a_thread, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      if (bounded[place] != invalid_index && is_isolated(bounded[place]))
        isolated[bounded[place]] = static_cast<std::uint32_t>(place);
    }
  });
  const bool is_none = std::all_of(isolated.begin(), isolated.end(),
                                   [](std::uint32_t place) { return place == invalid_index; });
  return is_none ? std::vector<std::uint32_t>() : isolated;
}

}  // namespace crt::core
