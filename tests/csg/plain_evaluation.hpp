// CSG is evaluated along a ray in the plainest way. Every leaf is asked, all crossings are sorted,
// and the tree is evaluated anew at each place. The library's evaluation must agree with it, to the
// bit.
#pragma once

#include <vector>

#include "core/compile/compile.hpp"
#include "core/csg/evaluate.hpp"

namespace crt::test {

struct PlainEvaluation {
  bool starts_inside = false;
  std::vector<core::CsgHit> hits;
};
PlainEvaluation evaluate_plainly(const core::CompiledScene& scene, const core::CsgObject& object,
                                 const core::WorldRay& ray);

/// Returns the objects of a scene that are made of several leaves.
inline std::vector<core::CsgObject> csg_objects(const core::CompiledScene& scene) {
  std::vector<core::CsgObject> objects;
  for (const core::SceneObject& object : scene.objects) {
    if (object.is_csg()) objects.push_back(scene.csg_object(object));
  }
  return objects;
}

}  // namespace crt::test
