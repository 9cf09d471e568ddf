#include "core/render/frame.hpp"

namespace crt::core {

Frame::Frame(const PreparedData& data, const Settings& settings, Workspace& work)
    : data_(data), settings_(settings), camera_(data.scene().camera, settings.width, settings.height) {
  lights_.reserve(data.scene().lights.size());
  for (const Light& light : data.scene().lights) {
    lights_.emplace_back(light, settings.falloff_model);
    ambient_ += lights_.back().ambient();
  }
  if (features().transparency && one_viewpoint()) {
    const CameraRay middle = camera_.ray(0.5 * settings.width, 0.5 * settings.height);
    find_surrounding_media(data, {.origin = middle.origin, .direction = middle.direction}, camera_media_,
                           work);
  }
}

bool Frame::one_viewpoint() const {
  return data_.scene().camera.projection != Projection::orthographic && !features().lens;
}

void find_surrounding_media(const PreparedData& data, const WorldRay& ray, std::vector<Medium>& out,
                            Workspace& work) {
  ++work.stats.media_lookups;
  out.clear();
  data.surrounding(ray, work.crossings, work.rays);
  for (const RayHit& exit : work.crossings) {
    const std::uint32_t material = data.hit_material(exit);
    if (!data.materials()[material].opaque) out.push_back({exit.object, material});
  }
}

}  // namespace crt::core
