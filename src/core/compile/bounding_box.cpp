// An entity by itself is compiled as in a scene, and its objects have boxes.
#include <new>
#include <span>

#include "core/compile/compile.hpp"
#include "core/math/float_environment.hpp"
#include "crt/error.hpp"

namespace crt {

BoundingBox bounding_box(const Entity& entity) {
  const core::FloatEnvironment ieee;
  try {
    core::Bounds bounds;
    for (const core::SceneObject& object : core::compile(std::span(&entity, 1)).objects) {
      bounds.include(object.bounds);
    }
    return {bounds.lower, bounds.upper};
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory, "there is not enough memory to compile the entity");
  }
}

}  // namespace crt
