// These tests check rendering: progress, cancelling, regions, jobs, and what the callbacks may do.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "support.hpp"
#include "support/temporary_directory.hpp"

using namespace crt::test;

namespace {

crt_render_options options_with(crt_progress_fn progress, void* user) {
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.progress = progress;
  options.progress_user = user;
  return options;
}

std::vector<float> pixels_of(const crt_image* image) {
  std::size_t stride = 0;
  const float* const first = crt_image_pixels(image, &stride);
  CHECK(stride == crt_image_width(image) * 4 * sizeof(float));
  return {first, first + std::size_t{4} * crt_image_width(image) * crt_image_height(image)};
}

JobHandle start(crt_prepared* prepared, const crt_render_options* options = nullptr) {
  return made<JobHandle>([&](crt_job** out) { return crt_render_start(prepared, options, out); });
}

/// A Gate stops a render at its first callback and holds it there until it is opened.
struct Gate {
  std::atomic<bool> reached = false;
  std::atomic<bool> open = false;

  static int hold(double fraction, void* user) {
    auto* const gate = static_cast<Gate*>(user);
    if (fraction > 0) gate->reached = true;
    while (gate->reached && !gate->open) std::this_thread::yield();
    return 0;
  }
  void wait() const {
    while (!reached) std::this_thread::yield();
  }
};

}  // namespace

TEST_CASE("progress starts at 0, never goes back and ends at 1") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  std::vector<double> seen;
  const crt_render_options options = options_with(
      [](double fraction, void* user) {
        static_cast<std::vector<double>*>(user)->push_back(fraction);
        return 0;
      },
      &seen);
  const ImageHandle image = render(prepared.get(), &options);
  REQUIRE(seen.size() > 2);
  CHECK(seen.front() == 0);
  CHECK(seen.back() == 1);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
}

TEST_CASE("a progress callback cancels, and its number is handed back") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  for (const std::int32_t threads : {1, 0}) {
    for (const int number : {1, -17, 123456}) {
      int answer = number;
      crt_render_options options = options_with(
          [](double fraction, void* user) { return fraction > 0.2 ? *static_cast<int*>(user) : 0; },
          &answer);
      options.threads = threads;
      crt_image* image = nullptr;
      CHECK(crt_render(prepared.get(), &options, &image) == CRT_ERROR_CANCELLED);
      CHECK(image == nullptr);
      CHECK(crt_cancel_value() == number);
      const JobHandle job = start(prepared.get(), &options);
      CHECK(crt_job_wait(job.get(), &image) == CRT_ERROR_CANCELLED);
      CHECK(image == nullptr);
      CHECK(crt_cancel_value() == number);
    }
  }
  crt_image* image = nullptr;
  CHECK(crt_render(prepared.get(), nullptr, nullptr) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_cancel_value() == 0);
  CHECK(image == nullptr);
}

TEST_CASE("preparing is cancelled by its callback, and its number is handed back") {
  const SceneHandle scene = small_scene();
  crt_prepare_options options;
  REQUIRE(crt_prepare_options_init(&options, sizeof options) == CRT_OK);
  int answer = -17;
  options.poll = [](void* user) { return *static_cast<int*>(user); };
  options.poll_user = &answer;
  crt_prepared* prepared = nullptr;
  CHECK(crt_scene_prepare_with(scene.get(), &options, &prepared) == CRT_ERROR_CANCELLED);
  CHECK(prepared == nullptr);
  CHECK(crt_cancel_value() == -17);
  answer = 0;
  const PreparedHandle asked = made<PreparedHandle>(
      [&](crt_prepared** out) { return crt_scene_prepare_with(scene.get(), &options, out); });
  const PreparedHandle not_asked = made<PreparedHandle>(
      [&](crt_prepared** out) { return crt_scene_prepare_with(scene.get(), nullptr, out); });
  CHECK(pixels_of(render(asked.get()).get()) == pixels_of(render(not_asked.get()).get()));
  CHECK(crt_scene_prepare_with(scene.get(), nullptr, nullptr) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_scene_prepare_with(nullptr, nullptr, &prepared) == CRT_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("a ray of more steps than the options allow is an error") {
  const SceneHandle scene = new_scene();
  std::vector<EntityHandle> parts;
  std::vector<crt_entity*> handles;
  for (int i = 0; i < 5000; ++i) {
    parts.push_back(sphere({0, 0, 5 + 1e-7 * i}, 1));
    handles.push_back(parts.back().get());
  }
  const EntityHandle common = made<EntityHandle>([&](crt_entity** out) {
    return crt_intersection_create(handles.data(), handles.size(), out);
  });
  REQUIRE(crt_scene_add_entity(scene.get(), common.get()) == CRT_OK);
  crt_settings settings;
  REQUIRE(crt_settings_init(&settings, sizeof settings) == CRT_OK);
  settings.width = settings.height = 1;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  crt_render_options options = options_with(nullptr, nullptr);
  options.max_ray_steps = 2000;
  crt_image* image = nullptr;
  CHECK(crt_render(prepared.get(), &options, &image) == CRT_ERROR_LIMIT);
  CHECK(says("max_ray_steps"));
  options.max_ray_steps = 0;
  render(prepared.get(), &options);
}

TEST_CASE("a job gives the picture that rendering at once gives") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<float> expected = pixels_of(render(prepared.get()).get());
  const JobHandle job = start(prepared.get());
  REQUIRE(crt_job_wait(job.get(), nullptr) == CRT_OK);
  const auto wait = [&](crt_image** out) { return crt_job_wait(job.get(), out); };
  CHECK(pixels_of(made<ImageHandle>(wait).get()) == expected);
  CHECK(pixels_of(made<ImageHandle>(wait).get()) == expected);
  double fraction = 0;
  REQUIRE(crt_job_progress(job.get(), &fraction) == CRT_OK);
  CHECK(fraction == 1);
  const ImageHandle snapshot =
      made<ImageHandle>([&](crt_image** out) { return crt_job_snapshot(job.get(), out); });
  CHECK(pixels_of(snapshot.get()) == expected);
  crt_render_stats stats;
  stats.struct_size = sizeof stats;
  REQUIRE(crt_image_stats(snapshot.get(), &stats) == CRT_OK);
  CHECK(stats.pixels == 40 * 30);
  REQUIRE(crt_job_cancel(job.get()) == CRT_OK);
  CHECK(crt_job_wait(job.get(), nullptr) == CRT_OK);
}

TEST_CASE(
    "a snapshot has the tiles that are done, and nothing where none is; cancelling keeps them") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<float> whole = pixels_of(render(prepared.get()).get());
  Gate gate;
  crt_render_options options = options_with(Gate::hold, &gate);
  options.threads = 1;
  const JobHandle job = start(prepared.get(), &options);
  gate.wait();
  double fraction = -1;
  REQUIRE(crt_job_progress(job.get(), &fraction) == CRT_OK);
  CHECK(fraction > 0);
  CHECK(fraction < 1);
  const auto take = [&](crt_image** out) { return crt_job_snapshot(job.get(), out); };
  const std::vector<float> early = pixels_of(made<ImageHandle>(take).get());
  REQUIRE(crt_job_cancel(job.get()) == CRT_OK);
  gate.open = true;
  crt_image* none = nullptr;
  CHECK(crt_job_wait(job.get(), &none) == CRT_ERROR_CANCELLED);
  CHECK(none == nullptr);
  CHECK(crt_cancel_value() == 0);
  const std::vector<float> late = pixels_of(made<ImageHandle>(take).get());
  REQUIRE(early.size() == whole.size());
  std::size_t done_early = 0;
  std::size_t done_late = 0;
  for (std::size_t i = 0; i < whole.size(); i += 4) {
    const auto is = [&](const std::vector<float>& a, const float* b) {
      return std::equal(b, b + 4, &a[i]);
    };
    const float nothing[4] = {0, 0, 0, 0};
    const bool early_done = is(early, &whole[i]);
    const bool late_done = is(late, &whole[i]);
    CHECK((early_done || is(early, nothing)));
    CHECK((late_done || is(late, nothing)));
    CHECK((late_done || !early_done));
    done_early += early_done ? 1 : 0;
    done_late += late_done ? 1 : 0;
  }
  CHECK(done_early > 0);
  CHECK(done_late < whole.size() / 4);
}

TEST_CASE("releasing a running job cancels it, also from its own callback") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  { const JobHandle job = start(prepared.get()); }
  struct Self {
    std::atomic<crt_job*> job = nullptr;
    std::atomic<bool> done = false;
    crt_status waited = CRT_OK;
  } self;
  const crt_render_options options = options_with(
      [](double fraction, void* user) {
        auto* const mine = static_cast<Self*>(user);
        if (fraction == 0 || mine->done) return 0;
        while (mine->job == nullptr) std::this_thread::yield();
        mine->waited = crt_job_wait(mine->job, nullptr);
        crt_job_release(mine->job);
        mine->done = true;
        return 0;
      },
      &self);
  crt_job* job = nullptr;
  REQUIRE(crt_render_start(prepared.get(), &options, &job) == CRT_OK);
  self.job = job;
  while (!self.done) std::this_thread::yield();
  CHECK(self.waited == CRT_ERROR_INVALID_ARGUMENT);
  // The job's thread may still be returning from `options`' callback. It touches nothing of ours.
}

TEST_CASE("a callback may render, query and use everything itself") {
  const SceneHandle scene = small_scene(64, 64);
  const PreparedHandle prepared = prepare(scene.get());
  struct Nested {
    crt_prepared* prepared;
    int rendered = 0;
  } nested{prepared.get()};
  const crt_render_options options = options_with(
      [](double, void* user) {
        auto* const mine = static_cast<Nested*>(user);
        crt_image* image = nullptr;
        const crt_ray ray = {{-0.4, 0, 0}, {0, 0, 1}, 0, infinity};
        crt_hit hit;
        if (crt_render(mine->prepared, nullptr, &image) == CRT_OK &&
            crt_intersect(mine->prepared, &ray, 0, 1, &hit, 0) == CRT_OK && hit.t < infinity) {
          ++mine->rendered;
        }
        crt_image_release(image);
        return mine->rendered > 3 ? 9 : 0;
      },
      &nested);
  crt_image* image = nullptr;
  CHECK(crt_render(prepared.get(), &options, &image) == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 9);
  CHECK(nested.rendered == 4);
}

TEST_CASE("an exception that a C++ host's callback throws ends the call, not the process") {
  const SceneHandle scene = small_scene(64, 64);
  const PreparedHandle prepared = prepare(scene.get());
  for (const std::int32_t threads : {1, 0}) {
    crt_render_options options = options_with(
        [](double fraction, void*) -> int {
          if (fraction > 0.3) throw std::runtime_error("the host fell over");
          return 0;
        },
        nullptr);
    options.threads = threads;
    crt_image* image = nullptr;
    CHECK(crt_render(prepared.get(), &options, &image) == CRT_ERROR_INTERNAL);
    CHECK(says("the host fell over"));
    const JobHandle job = start(prepared.get(), &options);
    CHECK(crt_job_wait(job.get(), &image) == CRT_ERROR_INTERNAL);
    CHECK(says("the host fell over"));
    options.progress = [](double, void*) -> int { throw 17; };
    CHECK(crt_render(prepared.get(), &options, &image) == CRT_ERROR_INTERNAL);
    CHECK(image == nullptr);
  }
}

TEST_CASE("a region has the pixels of the whole, and one outside is refused") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<float> whole = pixels_of(render(prepared.get()).get());
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.region_x = 5;
  options.region_y = 7;
  options.region_width = 20;
  options.region_height = 11;
  const ImageHandle image = render(prepared.get(), &options);
  CHECK(crt_image_width(image.get()) == 20);
  CHECK(crt_image_height(image.get()) == 11);
  const std::vector<float> part = pixels_of(image.get());
  for (std::size_t y = 0; y < 11; ++y) {
    CHECK(std::equal(&part[y * 80], &part[y * 80] + 80, &whole[((y + 7) * 40 + 5) * 4]));
  }
  options.region_x = 21;
  crt_image* none = nullptr;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("region"));
  options.region_width = 0;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  options = {};
  options.struct_size = sizeof options;
  options.threads = -1;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("threads"));
  CHECK(none == nullptr);
}

TEST_CASE("a seed of the options takes the place of the scene's") {
  const SceneHandle scene = small_scene();
  crt_camera camera;
  REQUIRE(crt_camera_init(&camera, sizeof camera) == CRT_OK);
  camera.aperture = 200;
  REQUIRE(crt_scene_set_camera(scene.get(), &camera) == CRT_OK);
  crt_settings settings;
  settings.struct_size = sizeof settings;
  REQUIRE(crt_scene_get_settings(scene.get(), &settings) == CRT_OK);
  settings.dof_samples = 2;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  settings.seed = 5;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  const PreparedHandle with_seed = prepare(scene.get());
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.seed = 5;
  const ImageHandle overridden = render(prepared.get(), &options);
  CHECK(pixels_of(overridden.get()) == pixels_of(render(with_seed.get()).get()));
  CHECK(pixels_of(overridden.get()) != pixels_of(render(prepared.get()).get()));
  REQUIRE(crt_image_settings(overridden.get(), &settings) == CRT_OK);
  CHECK(settings.seed == 5);
}

TEST_CASE("a target error is kept, reported, and met again by the number of passes") {
  const SceneHandle scene = small_scene();
  crt_settings settings;
  settings.struct_size = sizeof settings;
  REQUIRE(crt_scene_get_settings(scene.get(), &settings) == CRT_OK);
  settings.target_error = 4.0 / 255;
  REQUIRE(crt_scene_set_settings(scene.get(), &settings) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  const ImageHandle image = render(prepared.get());
  crt_render_stats stats;
  stats.struct_size = sizeof stats;
  REQUIRE(crt_image_stats(image.get(), &stats) == CRT_OK);
  CHECK(stats.samples_min == 16);
  CHECK(stats.samples_max > 16);
  CHECK(stats.samples_mean * static_cast<double>(stats.pixels) ==
        doctest::Approx(static_cast<double>(stats.camera_rays)));
  CHECK(stats.passes >= 16);
  CHECK(stats.half_width_rms > 0);
  CHECK(stats.half_width_95 <= stats.half_width_max);
  CHECK(stats.unseen_share == doctest::Approx(3.0 / 16));
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.passes = stats.passes;
  CHECK(pixels_of(render(prepared.get(), &options).get()) == pixels_of(image.get()));
  options.passes = 24;
  const ImageHandle rough = render(prepared.get(), &options);
  REQUIRE(crt_image_stats(rough.get(), &stats) == CRT_OK);
  CHECK(stats.samples_max == 3);
  options.passes = -1;
  crt_image* none = nullptr;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("passes"));
}

TEST_CASE("a picture goes on from its checkpoint, and an option struct without one still does") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const TemporaryDirectory directory;
  const std::string checkpoint = (directory / "state").string();
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  CHECK(options.checkpoint == nullptr);
  options.passes = 75;
  const auto expected = pixels_of(render(prepared.get(), &options).get());
  options.passes = 66;
  options.checkpoint = checkpoint.c_str();
  CHECK(pixels_of(render(prepared.get(), &options).get()) != expected);
  options.passes = 75;
  CHECK(pixels_of(render(prepared.get(), &options).get()) == expected);
  options.passes = 70;
  crt_image* none = nullptr;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("75"));
  options.passes = 0;
  CHECK(crt_render(prepared.get(), &options, &none) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("checkpoint"));
  options.struct_size = offsetof(crt_render_options, checkpoint);
  CHECK(render(prepared.get(), &options));
}

TEST_CASE("what a render has to tell goes to the log") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  struct Lines {
    std::vector<std::string> text;
    std::vector<std::int32_t> levels;
  } lines;
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.log = [](std::int32_t level, const char* text, void* user) {
    static_cast<Lines*>(user)->text.emplace_back(text);
    static_cast<Lines*>(user)->levels.push_back(level);
  };
  options.log_user = &lines;
  options.threads = 1;
  render(prepared.get(), &options);
  REQUIRE(lines.text.size() == 1);
  CHECK(lines.levels[0] == CRT_LOG_INFO);
  CHECK(lines.text[0].find("1200 pixels") != std::string::npos);
  CHECK(lines.text[0].find("on 1 thread") != std::string::npos);
  options.threads = 1 << 20;
  render(prepared.get(), &options);
  REQUIRE(lines.text.size() == 3);
  CHECK(lines.levels[2] == CRT_LOG_WARNING);
  CHECK(lines.text[2].find("1048576 threads") != std::string::npos);
}
