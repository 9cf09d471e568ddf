// The renderer draws drafts and the picture here, and sends them.
#include <algorithm>
#include <crt/draft.hpp>
#include <crt/error.hpp>
#include <crt/job.hpp>
#include <utility>

#include "studio/channel_picture.hpp"
#include "studio/draft.hpp"
#include "studio/renderer.hpp"

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

}  // namespace

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

void Renderer::draw_draft(Scene draft, bool may_be_cancelled) {
  if (may_denoise()) draft.settings.denoise = true;
  RenderOptions options = render_options();
  options.progress = [&](double) { return may_be_cancelled ? !is_old() : !script_is_old(); };
  const Clock::time_point begin = Clock::now();
  const auto image = std::make_shared<const Image>(render(prepare_shown(draft), options));
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  samples_a_second_ = static_cast<double>(image->stats().camera_rays) / std::max(seconds, 1e-6);
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
  options.denoisable = may_denoise();
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
    bool is_shown_again = false;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, end_interval, [this] {
        return changes_ != change_ || is_cancelled_ || is_to_be_shown_again();
      });
      if (changes_ != change_) return;
      if (is_cancelled_) {
        job.cancel();
        break;
      }
      is_shown_again = is_to_be_shown_again();
    }
    if (is_shown_again) show_again();
    const Clock::time_point look = Clock::now();
    if (look - last_look < interval) continue;
    say(Phase::rendering, job.progress());
    if (may_send() && !job.finished())
      send(PictureKind::progress, std::make_shared<const Image>(job.snapshot()), denoised(job));
    last_look = Clock::now();
    interval = std::max<Clock::duration>(look_interval, looking_pause * (last_look - look));
  }
  try {
    finish(job);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) throw;
    say(Phase::cancelled, job.progress());
  }
}

/// Says whether what is rendered may be shown without noise, though the scene does not say so.
bool Renderer::may_denoise() const {
  return options_.display.denoise && options_.channel == Channel::color &&
         !view_->scene.settings.denoise;
}

/// Returns what a job has without its noise, or null if nobody wants that.
std::shared_ptr<const Image> Renderer::denoised(const RenderJob& job) const {
  if (!may_denoise()) return nullptr;
  try {
    return std::make_shared<const Image>(job.denoised([this] { return !is_old(); }));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) throw;
    return nullptr;
  }
}

/// Takes the picture of a job. Throws what ended that, if it has none.
void Renderer::finish(const RenderJob& job) {
  const auto image = std::make_shared<const Image>(job.wait());
  const bool is_part = clipped(options_.region, view_->scene.settings).has_value();
  if (!is_part && !is_geometric(options_.channel) && options_.mode == ViewMode::rendered) {
    const std::lock_guard lock(mutex_);
    picture_ = image;
  }
  send(is_part ? PictureKind::progress : PictureKind::final, image, denoised(job));
  events_.finished(revision_, *image);
  say(Phase::done, 1);
}

/// Says whether the page has taken so many pictures that another may go. The mutex is locked.
bool Renderer::has_taken() const {
  return pictures_ < std::uint64_t{acknowledged_} + max_on_their_way;
}

bool Renderer::may_send() const {
  const std::lock_guard lock(mutex_);
  return has_taken();
}

/// Says whether the page may have what it shows in another exposure. The mutex is locked.
bool Renderer::is_to_be_shown_again() const {
  return display_changes_ != display_change_ && has_taken();
}

void Renderer::send(PictureKind kind, std::shared_ptr<const Image> image,
                    std::shared_ptr<const Image> denoised) {
  const Settings& settings = view_->scene.settings;
  layers_.add({kind, std::move(image), options_.channel, revision_.number, settings.width,
               settings.height, clipped(options_.region, settings), std::move(denoised)});
  send(layers_.all().back());
}

void Renderer::send(const Layer& layer) {
  Display display;
  {
    const std::lock_guard lock(mutex_);
    display = asked_options_.display;
  }
  events_.picture(encoded(layer, display, ++pictures_));
}

void Renderer::show_again() {
  {
    const std::lock_guard lock(mutex_);
    display_change_ = display_changes_;
  }
  for (const Layer& layer : layers_.all()) send(layer);
}

}  // namespace crt::studio
