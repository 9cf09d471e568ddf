#include "studio/renderer.hpp"

#include <crt/error.hpp>
#include <exception>
#include <new>
#include <utility>

#include "studio/place_text.hpp"

namespace crt::studio {

namespace {

using Phase = RenderState::Phase;

/// A script prints so many lines at most.
constexpr int max_lines = 1000;

bool are_equal(const Camera& a, const Camera& b) {
  return a.position == b.position && a.pointing == b.pointing && a.fov == b.fov &&
         a.roll == b.roll && a.projection == b.projection && a.aperture == b.aperture &&
         a.lens_radius == b.lens_radius && a.focal_distance == b.focal_distance &&
         a.aperture_shape == b.aperture_shape && a.section_normal == b.section_normal &&
         a.section_offset == b.section_offset && a.section_hatch == b.section_hatch;
}

bool are_equal(const std::optional<Camera>& a, const std::optional<Camera>& b) {
  return a && b ? are_equal(*a, *b) : a.has_value() == b.has_value();
}

/// Returns the entities under numbers that say their places, for hits to report.
std::vector<Entity> numbered(const std::vector<Entity>& entities) {
  std::vector<Entity> result;
  result.reserve(entities.size());
  for (const Entity& entity : entities)
    result.push_back(entity.with_id(static_cast<std::uint32_t>(result.size())));
  return result;
}

}  // namespace

Renderer::Renderer(RenderEvents events, int threads)
    : events_(std::move(events)), threads_(threads), thread_([this] { work(); }) {}

Renderer::~Renderer() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
    ++changes_;
    ++script_changes_;
  }
  changed_.notify_all();
  thread_.join();
}

void Renderer::set_script(Revision revision, std::optional<ViewOptions> options) {
  const std::lock_guard lock(mutex_);
  asked_script_ = std::move(revision);
  if (options) asked_options_ = std::move(*options);
  is_cancelled_ = false;
  ++changes_;
  ++script_changes_;
  changed_.notify_all();
}

void Renderer::set_options(ViewOptions options) {
  const std::lock_guard lock(mutex_);
  // Only a render that was begun for it keeps what a filter needs.
  const bool needs_guides = options.display.denoise && !options_.display.denoise &&
                            options.channel == Channel::color && changes_ == change_;
  if (differ_in_display_alone(options, asked_options_) && !needs_guides) {
    ++display_changes_;
  } else {
    if (options.t != asked_options_.t) ++script_changes_;
    is_cancelled_ = false;
    ++changes_;
  }
  asked_options_ = std::move(options);
  changed_.notify_all();
}

void Renderer::set_camera(const std::optional<Camera>& camera) {
  const std::lock_guard lock(mutex_);
  asked_camera_ = camera;
  is_cancelled_ = false;
  ++changes_;
  changed_.notify_all();
}

void Renderer::acknowledge(std::uint32_t picture) {
  const std::lock_guard lock(mutex_);
  acknowledged_ = std::max(acknowledged_, picture);
  changed_.notify_all();
}

void Renderer::cancel() {
  const std::lock_guard lock(mutex_);
  is_cancelled_ = true;
  changed_.notify_all();
}

void Renderer::restart() {
  const std::lock_guard lock(mutex_);
  is_cancelled_ = false;
  ++changes_;
  changed_.notify_all();
}

std::shared_ptr<const View> Renderer::view() const {
  const std::lock_guard lock(mutex_);
  return view_;
}

std::shared_ptr<const Image> Renderer::picture() const {
  const std::lock_guard lock(mutex_);
  return picture_;
}

void Renderer::work() {
  while (true) {
    bool has_changed = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock,
                    [this] { return is_ended_ || changes_ != change_ || is_to_be_shown_again(); });
      if (is_ended_) return;
      has_changed = changes_ != change_;
    }
    try {
      if (has_changed) {
        start_ = Clock::now();
        render_or_say_why();
      } else {
        show_again();
      }
    } catch (const std::exception&) {
      // There is not even memory to say so.
    }
  }
}

void Renderer::render_or_say_why() {
  try {
    render_newest();
  } catch (const Error& error) {
    const bool is_cancelled = error.code() == ErrorCode::cancelled;
    say(is_cancelled ? Phase::cancelled : Phase::failed, 0, is_cancelled ? "" : error.what());
  } catch (const std::bad_alloc&) {
    say(Phase::failed, 0, "there is not enough memory");
  } catch (const std::exception& error) {  // of the system: there is no thread to be had
    say(Phase::failed, 0, error.what());
  }
}

void Renderer::render_newest() {
  bool script_is_new = false;
  bool has_drafts = false;
  {
    const std::lock_guard lock(mutex_);
    script_is_new = script_changes_ != script_change_;
    const bool is_to_be_denoised = options_.display.denoise != asked_options_.display.denoise &&
                                   differ_in_display_alone(options_, asked_options_);
    has_drafts = !script_is_new && are_equal(camera_, asked_camera_) &&
                 (differ_in_region_alone(options_, asked_options_) || is_to_be_denoised);
    options_ = asked_options_;
    script_change_ = script_changes_;
    change_ = changes_;
    revision_ = asked_script_;
    camera_ = asked_camera_;
  }
  if (!revision_.text) return;
  if (script_is_new) {
    scene_.reset();
    prepared_.reset();
    shown_.reset();
    boxes_.reset();
    if (!run_script()) return;
  }
  if (!scene_) return;
  prepare_scene();
  say(Phase::rendering);
  if (!has_drafts) draw_drafts();
  render_whole();
}

bool Renderer::run_script() {
  if (revision_.scene) {
    take_scene(revision_.scene, revision_.places);
    reads_time_ = false;
    return true;
  }
  say(Phase::script);
  int lines = 0;
  ScriptOptions options;
  options.t = options_.t;
  options.go_on = [this] { return !script_is_old(); };
  options.print = [&](std::string_view line) {
    if (++lines < max_lines) events_.print(std::string(line));
    if (lines == max_lines) events_.print("...");
  };
  ScriptResult result = crt::run_script(*revision_.text, revision_.name, options);
  if (script_is_old()) return false;
  if (!result.scene) {
    say(Phase::failed, 0, first_error(result.diagnostics, revision_.name));
    return false;
  }
  take_scene(std::make_shared<const Scene>(std::move(*result.scene)),
             std::move(result.entity_places));
  reads_time_ = result.reads_time;
  return true;
}

void Renderer::take_scene(std::shared_ptr<const Scene> scene, std::vector<EntityPlace> places) {
  // Whoever changes the script's camera wants to see that one. In another frame it moves by itself.
  const bool is_other_frame = scene_revision_ == revision_.number && scene_t_ != options_.t;
  scene_revision_ = revision_.number;
  scene_t_ = options_.t;
  if (!is_other_frame && script_camera_ && !are_equal(*script_camera_, scene->camera)) {
    const std::lock_guard lock(mutex_);
    if (changes_ == change_) asked_camera_.reset();
    camera_.reset();
  }
  original_ = std::move(scene);
  script_camera_ = original_->camera;
  scene_ = *original_;
  scene_->entities = numbered(scene_->entities);
  places_ = std::move(places);
}

const std::vector<BoundingBox>& Renderer::boxes() {
  if (!boxes_) boxes_ = boxes_of(*scene_);
  return *boxes_;
}

/// Returns the scene as it is shown. As long as its entities are the same, they are that to
/// prepare().
Scene Renderer::shown_scene() {
  const bool has_entities = shown_ && show_same_entities(shown_->options, options_);
  Scene scene =
      has_entities ? *scene_
                   : visible_scene(*scene_, places_, options_,
                                   [this]() -> const std::vector<BoundingBox>& { return boxes(); });
  if (has_entities) scene.entities.clear();
  if (camera_) {
    // The page says where the camera is. How the scene is cut open stays as the script says.
    const Camera of_script = std::exchange(scene.camera, *camera_);
    scene.camera.section_normal = of_script.section_normal;
    scene.camera.section_offset = of_script.section_offset;
    scene.camera.section_hatch = of_script.section_hatch;
  }
  scene = scene_in_mode(std::move(scene), options_.mode, *script_camera_);
  if (has_entities) {
    scene.entities = shown_->entities;
  } else {
    shown_ = ShownEntities{options_, scene.entities};
  }
  return scene;
}

PreparedScene Renderer::prepare_shown(const Scene& scene) const {
  PrepareOptions options;
  options.earlier = prepared_ ? &*prepared_ : nullptr;
  options.go_on = [this] { return !script_is_old(); };
  options.material = materials_of(options_.mode);
  return prepare(scene, options);
}

void Renderer::prepare_scene() {
  if (!prepared_) say(Phase::preparing);
  Scene scene = shown_scene();
  prepared_ = prepare_shown(scene);
  auto view = std::make_shared<const View>(View{revision_, std::move(scene), *prepared_, places_,
                                                camera_.value_or(*script_camera_),
                                                camera_.has_value(), reads_time_, original_});
  {
    const std::lock_guard lock(mutex_);
    view_ = view;
  }
  events_.scene(*view);
}

bool Renderer::is_old() const {
  const std::lock_guard lock(mutex_);
  return changes_ != change_ || is_cancelled_;
}

bool Renderer::script_is_old() const {
  const std::lock_guard lock(mutex_);
  return script_changes_ != script_change_;
}

void Renderer::say(Phase phase, double progress, std::string message) const {
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  events_.state({phase, revision_.number, progress, seconds, std::move(message)});
}

}  // namespace crt::studio
