#include "crt/render.hpp"

#include "core/render/rendering.hpp"

namespace crt {

Image render(const PreparedScene& scene, const RenderOptions& options) {
  core::Rendering rendering(scene.data(), options);
  rendering.run();
  return rendering.take();
}

}  // namespace crt
