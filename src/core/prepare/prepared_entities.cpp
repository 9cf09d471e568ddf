#include "core/prepare/prepared_entities.hpp"

#include <utility>
#include <vector>

#include "core/prepare/geometry.hpp"
#include "core/prepare/recolour.hpp"

namespace crt::core {

PreparedEntities PreparedEntities::of(const Scene& scene, const PreparedEntities* earlier,
                                      std::uint64_t max_primitives, const Workers& workers) {
  const Precision precision = scene.settings.precision;
  const PrimitiveLimit limit(precision, max_primitives);
  PreparedEntities result;
  const bool may_be_shared = earlier != nullptr && earlier->geometry->precision == precision;
  if (!may_be_shared || !result.take(scene, *earlier, limit, workers)) {
    result.geometry = std::make_shared<const Geometry>(
        compile(scene.entities, precision, workers, limit), precision, workers);
    result.materials = result.geometry->accelerator.compiled().materials;
  }
  result.nodes = NodeList(scene.entities, earlier == nullptr ? NodeList() : earlier->nodes);
  return result;
}

bool PreparedEntities::take(const Scene& scene, const PreparedEntities& earlier,
                            const PrimitiveLimit& limit, const Workers& workers) {
  const std::vector<Entity>& entities = scene.entities;
  const CompiledScene& compiled = earlier.geometry->accelerator.compiled();
  const std::vector<std::uint32_t> places = earlier.nodes.places_of(entities);
  if (entities.size() == earlier.nodes.size()) {
    std::vector<std::uint32_t> others;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      if (places[i] == invalid_index) others.push_back(i);
    }
    materials = others.empty() ? earlier.materials
                               : recoloured(compiled, *earlier.materials, earlier.nodes, entities,
                                            others, earlier.geometry->precision, workers);
    if (materials != nullptr) {
      limit.check(compiled.count);
      geometry = earlier.geometry;
      return true;
    }
  }
  const std::vector<const EntityNode*> removed = earlier.nodes.others_than(places);
  auto recompiled = recompile(compiled, *earlier.materials, entities, places, removed,
                              earlier.geometry->precision, workers, limit);
  if (!recompiled) return false;
  materials = recompiled->scene.materials;
  geometry = std::make_shared<const Geometry>(std::move(*recompiled), *earlier.geometry, workers);
  return true;
}

}  // namespace crt::core
