// This file implements the scenes of the C interface.
#include <atomic>
#include <optional>

#include "capi/structs.hpp"
#include "crt/source_code.hpp"
#include "crt/validate.hpp"
#include "text/format.hpp"

namespace crt::capi {

namespace {

void require_index(std::size_t index, std::size_t count) {
  if (index >= count) reject("index", text::format("is {}, but there are only {}", index, count));
}

/// Returns the handle of the background's picture, which the scene keeps, or NULL if it has none.
const crt_image* lent_background(const crt_scene& scene) {
  const auto* panorama = std::get_if<PanoramaBackground>(&scene.value.background);
  if (panorama == nullptr || !panorama->image) return nullptr;
  crt_image* const lent = scene.lent_background.get();
  if (lent != nullptr && lent->value == panorama->image) return lent;
  scene.lent_background = Reference<crt_image>(new crt_image(panorama->image));
  return scene.lent_background.get();
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_scene_create(crt_scene** out) {
  return guarded([&] {
    require(out, "out");
    *out = new crt_scene;
  });
}

crt_status crt_scene_copy(const crt_scene* scene, crt_scene** out) {
  return guarded([&] {
    require(scene, "scene");
    require(out, "out");
    auto copy = std::make_unique<crt_scene>();
    copy->value = scene->value;
    copy->prepared = scene->prepared;
    *out = copy.release();
  });
}

crt_status crt_scene_add_entity(crt_scene* scene, crt_entity* entity) {
  return guarded([&] {
    require(scene, "scene");
    require(entity, "entity");
    scene->value.entities.push_back(entity->value);
  });
}

crt_status crt_scene_add_light(crt_scene* scene, const crt_light* light) {
  return guarded([&] {
    require(scene, "scene");
    const crt::Light value = to_light(light);
    crt::validate(value);
    scene->value.lights.push_back(value);
  });
}

crt_status crt_scene_set_camera(crt_scene* scene, const crt_camera* camera) {
  return guarded([&] {
    require(scene, "scene");
    const crt::Camera value = to_camera(camera);
    crt::validate(value);
    scene->value.camera = value;
  });
}

crt_status crt_scene_set_background(crt_scene* scene, const crt_background* background) {
  return guarded([&] {
    require(scene, "scene");
    crt::Background value = to_background(background);
    crt::validate(value);
    scene->value.background = std::move(value);
  });
}

crt_status crt_scene_set_settings(crt_scene* scene, const crt_settings* settings) {
  return guarded([&] {
    require(scene, "scene");
    crt::Settings value = to_settings(settings);
    crt::validate(value);
    scene->value.settings = std::move(value);
  });
}

crt_status crt_scene_replace_entity(crt_scene* scene, size_t index, crt_entity* entity) {
  return guarded([&] {
    require(scene, "scene");
    require(entity, "entity");
    require_index(index, scene->value.entities.size());
    scene->value.entities[index] = entity->value;
  });
}

crt_status crt_scene_remove_entity(crt_scene* scene, size_t index) {
  return guarded([&] {
    require(scene, "scene");
    std::vector<crt::Entity>& entities = scene->value.entities;
    require_index(index, entities.size());
    entities.erase(entities.begin() + static_cast<std::ptrdiff_t>(index));
  });
}

crt_status crt_scene_clear_entities(crt_scene* scene) {
  return guarded([&] {
    require(scene, "scene");
    scene->value.entities.clear();
  });
}

crt_status crt_scene_clear_lights(crt_scene* scene) {
  return guarded([&] {
    require(scene, "scene");
    scene->value.lights.clear();
  });
}

size_t crt_scene_entity_count(const crt_scene* scene) {
  return scene == nullptr ? 0 : scene->value.entities.size();
}

size_t crt_scene_light_count(const crt_scene* scene) {
  return scene == nullptr ? 0 : scene->value.lights.size();
}

crt_status crt_scene_get_entity(const crt_scene* scene, size_t index, crt_entity** out) {
  return guarded([&] {
    require(scene, "scene");
    require(out, "out");
    require_index(index, scene->value.entities.size());
    *out = new crt_entity(scene->value.entities[index]);
  });
}

crt_status crt_scene_get_light(const crt_scene* scene, size_t index, crt_light* light) {
  return guarded([&] {
    require(scene, "scene");
    require_index(index, scene->value.lights.size());
    fill_in(light, "light", to_c(scene->value.lights[index]));
  });
}

crt_status crt_scene_get_camera(const crt_scene* scene, crt_camera* camera) {
  return guarded([&] {
    require(scene, "scene");
    fill_in(camera, "camera", to_c(scene->value.camera));
  });
}

crt_status crt_scene_get_background(const crt_scene* scene, crt_background* background) {
  return guarded([&] {
    require(scene, "scene");
    fill_in(background, "background", to_c(scene->value.background, lent_background(*scene)));
  });
}

crt_status crt_scene_get_settings(const crt_scene* scene, crt_settings* settings) {
  return guarded([&] {
    require(scene, "scene");
    fill_in(settings, "settings", to_c(scene->value.settings));
  });
}

crt_status crt_scene_save_script(crt_scene* scene, const char* path) {
  return guarded([&] {
    require(scene, "scene");
    require(path, "path");
    crt::save_script(scene->value, path);
  });
}

crt_status crt_scene_prepare(crt_scene* scene, crt_prepared** out) {
  return crt_scene_prepare_with(scene, nullptr, out);
}

crt_status crt_scene_prepare_with(crt_scene* scene, const crt_prepare_options* options,
                                  crt_prepared** out) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(scene, "scene");
    require(out, "out");
    const auto given = taken_or_default(options, "options");
    crt::PrepareOptions how{.max_primitives = given.max_primitives};
    how.go_on = to_go_on(given.poll, given.poll_user, cancel_value);
    std::optional<crt::PreparedScene> earlier;
    if (given.previous != nullptr) {
      how.earlier = &given.previous->value;
    } else if (auto data = scene->prepared.lock()) {
      earlier.emplace(std::move(data));
      how.earlier = &*earlier;
    }
    crt::PreparedScene prepared = crt::prepare(scene->value, how);
    scene->prepared = prepared.watched_data();
    *out = new crt_prepared(std::move(prepared));
  });
}

crt_status crt_scene_prepare_from(crt_scene* scene, crt_prepared* previous, crt_prepared** out) {
  crt_prepare_options options;
  const crt_status status = crt_prepare_options_init(&options, sizeof options);
  if (status != CRT_OK) return status;
  options.previous = previous;
  return crt_scene_prepare_with(scene, &options, out);
}
