#include "core/render/frame.hpp"

#include <algorithm>
#include <iterator>

#include "core/render/media_order.hpp"

namespace crt::core {

namespace {

/// Brings the solids around a ray's start, given by their exits, into the order in which the ray's line
/// enters them; those that it enters at one place from the last one left to the first.
void sort_by_entry(const PreparedData& data, const WorldRay& ray, std::vector<RayHit>& exits,
                   Workspace& work) {
  WorldRay back = ray;
  back.direction = -ray.direction;
  struct Around {
    RayHit exit;
    RayHit entry;
  };
  std::vector<Around> solids;
  solids.reserve(exits.size());
  for (const RayHit& exit : exits) solids.push_back({exit, data.stay(back, exit.object, work.rays).exit});
  const auto comes_first = [](const Around& a, const Around& b) {
    if (!same_end(a.entry, b.entry)) return a.entry.t > b.entry.t;
    return same_end(a.exit, b.exit) ? a.exit.object < b.exit.object : a.exit.t > b.exit.t;
  };
  // By insertion, as in media_order.hpp.
  for (std::size_t i = 1; i < solids.size(); ++i) {
    for (std::size_t k = i; k > 0 && comes_first(solids[k], solids[k - 1]); --k) {
      std::swap(solids[k], solids[k - 1]);
    }
  }
  for (std::size_t i = 0; i < solids.size(); ++i) exits[i] = solids[i].exit;
}

}  // namespace

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
  std::vector<RayHit>& exits = work.crossings;
  data.surrounding(ray, exits, work.rays);
  std::erase_if(exits, [&](const RayHit& exit) { return data.materials()[data.hit_material(exit)].opaque; });
  if (exits.size() > 1) sort_by_entry(data, ray, exits, work);
  // Each goes where it would be if the ray had come from outside of all.
  for (const RayHit& exit : exits) {
    auto place = out.end();
    const auto is_inside_of = [&](const Medium& around) {
      if (exit.object > around.object) return true;
      const RayHit other = data.stay(ray, around.object, work.rays).exit;
      return exit.t < other.t || same_end(exit, other);
    };
    while (place != out.begin() && !is_inside_of(*std::prev(place))) --place;
    out.insert(place, {exit.object, data.hit_material(exit)});
  }
}

}  // namespace crt::core
