#include "studio/renderer.hpp"

#include <algorithm>
#include <crt/draft.hpp>
#include <crt/error.hpp>
#include <crt/job.hpp>
#include <exception>
#include <new>
#include <utility>

#include "studio/channel_picture.hpp"
#include "studio/draft.hpp"
#include "studio/place_text.hpp"

namespace crt::studio {

namespace {

using std::chrono::milliseconds;
using Phase = RenderState::Phase;

/// A draft has a pixel for so many of the picture, across and down.
constexpr int coarsest_step = 16;
/// The first draft may take about so long.
constexpr double first_draft_seconds = 0.03;
/// What takes longer is refined evenly, all over the picture, though that takes some more time.
constexpr double uneven_seconds = 0.3;
/// A picture in progress is sent in this interval.
constexpr milliseconds look_interval{80};
/// It waits for so many times as long as the one before took, so that looking takes little time.
constexpr int looking_pause = 9;
/// A job is asked in this interval whether it has ended.
constexpr milliseconds end_interval{8};
/// So many pictures may be on their way to the page.
constexpr std::uint32_t max_on_their_way = 2;
/// A script prints so many lines at most.
constexpr int max_lines = 1000;

bool are_equal(const Camera& a, const Camera& b) {
  return a.position == b.position && a.pointing == b.pointing && a.fov == b.fov &&
         a.roll == b.roll && a.projection == b.projection && a.aperture == b.aperture &&
         a.lens_radius == b.lens_radius && a.focal_distance == b.focal_distance &&
         a.aperture_shape == b.aperture_shape;
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
  if (options.t != asked_options_.t) ++script_changes_;
  asked_options_ = std::move(options);
  is_cancelled_ = false;
  ++changes_;
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
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_ended_ || changes_ != change_; });
      if (is_ended_) return;
    }
    start_ = Clock::now();
    try {
      render_or_say_why();
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
    has_drafts = !script_is_new && are_equal(camera_, asked_camera_) &&
                 differ_in_region_alone(options_, asked_options_);
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
  if (camera_) scene.camera = *camera_;
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

int Renderer::first_step() const {
  const Settings& settings = scene_->settings;
  const double pixels = static_cast<double>(settings.width) * settings.height;
  if (samples_a_second_ == 0) return std::max(1, std::min(settings.width, settings.height) / 64);
  int step = 1;
  while (step < coarsest_step && pixels / (step * step) > first_draft_seconds * samples_a_second_)
    step *= 2;
  return step;
}

/// The first draft is always drawn, so that a camera that never rests is seen moving.
void Renderer::draw_drafts() {
  const Settings& settings = view_->scene.settings;
  const int least = shown_step(settings.width, settings.height);
  const int first = std::max(std::min(first_step(), coarsest_step), least);
  const bool has_last = is_its_own_draft(view_->scene) || is_geometric(options_.channel);
  const int last = std::max(has_last ? 2 : 1, least);
  for (int step = first; step >= last && (step == first || !is_old()); step /= 2) {
    const Scene draft = draft_of(view_->scene, step);
    draw_draft(is_geometric(options_.channel) ? geometry_of(draft) : draft, step != first);
  }
  if (has_last || least > 1 || !takes_longer(1)) return;
  for (const Scene& draft : finer_drafts(view_->scene)) {
    if (is_old()) return;
    draw_draft(draft, true);
  }
}

/// Says whether so many samples of each pixel take long, as far as drafts tell.
bool Renderer::takes_longer(int samples) const {
  const Settings& settings = view_->scene.settings;
  return static_cast<double>(settings.width) * settings.height * samples >
         uneven_seconds * samples_a_second_;
}

void Renderer::draw_draft(const Scene& draft, bool may_be_cancelled) {
  RenderOptions options = render_options();
  options.progress = [&](double) { return may_be_cancelled ? !is_old() : !script_is_old(); };
  const Clock::time_point begin = Clock::now();
  const Image image = render(prepare_shown(draft), options);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  samples_a_second_ = static_cast<double>(image.stats().camera_rays) / std::max(seconds, 1e-6);
  {
    // Pictures do not queue: the page must have taken those before.
    std::unique_lock lock(mutex_);
    changed_.wait(lock,
                  [&] { return has_taken() || is_ended_ || script_changes_ != script_change_; });
    if (is_ended_ || script_changes_ != script_change_) return;
  }
  send(PictureKind::draft, image);
}

RenderOptions Renderer::render_options() const {
  RenderOptions options;
  options.threads = threads_;
  options.aovs = aovs_of(options_.channel);
  options.evenly = takes_longer(view_->scene.settings.min_samples);
  return options;
}

void Renderer::render_whole() {
  if (is_old()) return say(Phase::cancelled);
  const bool is_geometry = is_geometric(options_.channel);
  RenderOptions options = render_options();
  options.region = clipped(options_.region, view_->scene.settings);
  RenderJob job(is_geometry ? prepare_shown(geometry_of(view_->scene)) : *prepared_, options);
  Clock::time_point last_look = Clock::now();
  Clock::duration interval = look_interval;
  while (!job.finished()) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, end_interval,
                        [this] { return changes_ != change_ || is_cancelled_; });
      if (changes_ != change_) return;
      if (is_cancelled_) {
        job.cancel();
        break;
      }
    }
    const Clock::time_point look = Clock::now();
    if (look - last_look < interval) continue;
    say(Phase::rendering, job.progress());
    if (may_send() && !job.finished()) send(PictureKind::progress, job.snapshot());
    last_look = Clock::now();
    interval = std::max<Clock::duration>(look_interval, looking_pause * (last_look - look));
  }
  try {
    finish(std::make_shared<const Image>(job.wait()));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) throw;
    say(Phase::cancelled, job.progress());
  }
}

void Renderer::finish(const std::shared_ptr<const Image>& image) {
  const bool is_part = clipped(options_.region, view_->scene.settings).has_value();
  if (!is_part && !is_geometric(options_.channel) && options_.mode == ViewMode::rendered) {
    const std::lock_guard lock(mutex_);
    picture_ = image;
  }
  send(is_part ? PictureKind::progress : PictureKind::final, *image);
  events_.finished(revision_, *image);
  say(Phase::done, 1);
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

/// Says whether the page has taken so many pictures that another may go. The mutex is locked.
bool Renderer::has_taken() const {
  return pictures_ < std::uint64_t{acknowledged_} + max_on_their_way;
}

bool Renderer::may_send() const {
  const std::lock_guard lock(mutex_);
  return has_taken();
}

void Renderer::send(PictureKind kind, const Image& image) {
  const Settings& settings = view_->scene.settings;
  EncodedPicture picture{kind,
                         ++pictures_,
                         revision_.number,
                         static_cast<std::uint32_t>(settings.width),
                         static_cast<std::uint32_t>(settings.height),
                         static_cast<std::uint32_t>(image.width()),
                         static_cast<std::uint32_t>(image.height()),
                         displayed(image, options_.channel)};
  const std::optional<Region> region = clipped(options_.region, settings);
  if (region && kind != PictureKind::draft) {
    picture.rgba = placed(picture.rgba, *region, settings.width, settings.height);
    picture.width = picture.full_width;
    picture.height = picture.full_height;
  }
  reduce(picture);
  events_.picture(picture);
}

}  // namespace crt::studio
