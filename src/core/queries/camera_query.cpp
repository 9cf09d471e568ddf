// Programs that trace rays by themselves ask for those of the camera.
#include <cmath>

#include "core/camera/camera_rays.hpp"
#include "core/math/float_environment.hpp"
#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "crt/query.hpp"
#include "text/format.hpp"

namespace crt {

void camera_rays(const PreparedScene& scene, std::span<const std::array<double, 2>> places,
                 std::span<Ray> rays) {
  if (rays.size() < places.size()) {
    throw Error(ErrorCode::invalid_argument, "there are fewer rays than places", "rays");
  }
  const core::FloatEnvironment ieee;
  const Scene& given = scene.data().scene();
  const core::CameraRays camera(given.camera, given.settings.width, given.settings.height,
                                given.settings.compat);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [x, y] = places[i];
    const core::CameraRay found = camera.ray(x, y);
    rays[i] = {.origin = found.origin, .direction = found.direction};
    // What is not finite, or overflows, leaves no ray that can be traced.
    if (!std::isfinite(x) || !std::isfinite(y) || first_invalid(rays.subspan(i, 1)) == 0) {
      throw Error(ErrorCode::invalid_argument,
                  text::format("places[{}] is not finite, or too far outside the picture", i),
                  "places");
    }
  }
}

Ray camera_ray(const PreparedScene& scene, double x, double y) {
  const std::array place = {x, y};
  Ray ray;
  camera_rays(scene, std::span(&place, 1), std::span(&ray, 1));
  return ray;
}

}  // namespace crt
