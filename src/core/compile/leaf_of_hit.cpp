#include "core/compile/leaf_of_hit.hpp"

namespace crt::core {

void LeafOfHit::place_instance(const CompiledScene& scene, const SceneObject& object) {
  const CompiledScene& prototype = scene.prototype_of(object);
  const auto number =
      static_cast<std::size_t>(leaf_->placement - prototype.stores[0]->placements.data());
  composed_.emplace().set(scene.instances[object.instance].to_world, prototype.chains[number],
                          prototype.precision);
  placement_ = &composed_->get();
}

}  // namespace crt::core
