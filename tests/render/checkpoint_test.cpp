// With a checkpoint a picture continues where it stopped, to the same picture, and only that one.
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <crt/error.hpp>
#include <crt/job.hpp>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/state_file.hpp"
#include "core/render/rendering.hpp"
#include "pictures.hpp"
#include "support/temporary_directory.hpp"

using namespace crt;
using namespace crt::test;

namespace {

bool same_counts(const RenderStats& a, const RenderStats& b) {
  return a.camera_rays == b.camera_rays && a.shadow_rays == b.shadow_rays &&
         a.refraction_rays == b.refraction_rays && a.pixels == b.pixels && a.passes == b.passes &&
         a.samples_mean == b.samples_mean && a.half_width_rms == b.half_width_rms &&
         a.pixels_unresolved == b.pixels_unresolved && a.cutoff_mean == b.cutoff_mean &&
         a.cutoff_max == b.cutoff_max && a.media_lookups == b.media_lookups;
}

std::optional<ErrorCode> failure(const PreparedScene& scene, const RenderOptions& options) {
  try {
    render(scene, options);
  } catch (const Error& error) {
    return error.code();
  }
  return std::nullopt;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE(
    "a picture that was stopped after any pass goes on to the same picture, and to the same "
    "counts") {
  const PreparedScene scene = prepare(varied_scene());
  const Image reference = render(scene);
  REQUIRE(reference.stats().passes > 80);
  for (const int passes : {1, 8, 11, 17, 64, 65, 68, 72, 75, 80, reference.stats().passes}) {
    const TemporaryDirectory directory;
    const auto checkpoint = directory / "picture.state";
    const Image part = render(scene, {.threads = 1, .passes = passes, .checkpoint = checkpoint});
    CHECK(same_pixels(part, render(scene, {.passes = passes})));
    const Image whole = render(scene, {.checkpoint = checkpoint});
    CHECK(same_pixels(whole, reference));
    CHECK(same_counts(whole.stats(), reference.stats()));
    CHECK(directory.entries() == 1);
  }
}

TEST_CASE("a picture that is done is there at once") {
  const TemporaryDirectory directory;
  const PreparedScene scene = prepare(varied_scene());
  const Image reference = render(scene, {.checkpoint = directory / "state"});
  const Image again = render(scene, {.checkpoint = directory / "state"});
  CHECK(same_pixels(again, reference));
  CHECK(same_counts(again.stats(), reference.stats()));
}

TEST_CASE("many breaks, with other threads and a time budget, and channels beside colours") {
  Scene description = varied_scene();
  const PreparedScene scene = prepare(description);
  const Aovs aovs{.normal = true, .albedo = true, .samples = true, .error = true};
  const Image reference = render(scene, {.aovs = aovs});
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  int breaks = 0;
  for (int passes = 2; passes < reference.stats().passes; passes += 9, ++breaks) {
    render(scene,
           {.threads = 1 + passes % 3, .passes = passes, .checkpoint = checkpoint, .aovs = aovs});
  }
  CHECK(breaks > 5);
  description.settings.time_budget = 1000;
  const Image whole = render(prepare(description), {.checkpoint = checkpoint, .aovs = aovs});
  CHECK(same_pixels(whole, reference));
  REQUIRE(whole.channels().size() == reference.channels().size());
  for (std::size_t i = 0; i < whole.channels().size(); ++i) {
    CHECK(whole.channels()[i].name == reference.channels()[i].name);
    CHECK(whole.channels()[i].values == reference.channels()[i].values);
  }
}

TEST_CASE("a part of a picture has its own checkpoint") {
  const PreparedScene scene = prepare(varied_scene());
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  const Region region{5, 4, 20, 13};
  render(scene, {.region = region, .passes = 70, .checkpoint = checkpoint});
  CHECK(failure(scene, {.checkpoint = checkpoint}) == ErrorCode::invalid_argument);
  CHECK(same_pixels(render(scene, {.region = region, .checkpoint = checkpoint}),
                    render(scene, {.region = region})));
}

TEST_CASE("a picture that is cancelled goes on from what was kept") {
  const PreparedScene scene = prepare(varied_scene());
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  render(scene, {.passes = 20, .checkpoint = checkpoint});
  const auto stop = [](double share) { return share < 0.3; };
  CHECK(failure(scene, {.progress = stop, .checkpoint = checkpoint}) == ErrorCode::cancelled);
  CHECK(same_pixels(render(scene, {.checkpoint = checkpoint}), render(scene)));
  RenderJob job(scene, {.checkpoint = checkpoint});
  CHECK(same_pixels(job.wait(), render(scene)));
}

TEST_CASE(
    "a picture that is cancelled anywhere, even before the first pass is whole, goes on to the "
    "same one") {
  Scene description = varied_scene();
  description.settings.max_samples = 16;
  const PreparedScene scene = prepare(description);
  const Aovs aovs{.normal = true, .samples = true, .error = true};
  const Image reference = render(scene, {.aovs = aovs});
  for (const int threads : {1, 2}) {
    for (const int calls : {1, 2, 3, 5, 8}) {  // calls of the clock, which rays make now and then
      const TemporaryDirectory directory;
      const auto checkpoint = directory / "state";
      std::optional<Image> whole;
      int breaks = 0;
      for (; !whole && breaks < 1000; ++breaks) {
        std::atomic<int> left = calls + breaks / 4;
        core::Rendering* running = nullptr;
        core::Rendering rendering(
            scene.data(), {.threads = threads, .checkpoint = checkpoint, .aovs = aovs}, [&] {
              if (--left == 0) running->cancel();
              return 0.0;
            });
        running = &rendering;
        try {
          rendering.run();
          whole = rendering.take();
        } catch (const Error& error) {
          REQUIRE(error.code() == ErrorCode::cancelled);
          REQUIRE(std::filesystem::exists(checkpoint));
        }
      }
      REQUIRE(whole);
      CHECK(breaks > 4);
      CHECK(same_pixels(*whole, reference));
      CHECK(same_counts(whole->stats(), reference.stats()));
      for (std::size_t i = 0; i < reference.channels().size(); ++i) {
        CHECK(whole->channels()[i].values == reference.channels()[i].values);
      }
      CHECK(directory.entries() == 1);
    }
  }
}

TEST_CASE(
    "the first checkpoint is there after 10 seconds, though no pass is whole, and is good to go on "
    "from") {
  Scene description = varied_scene();
  description.settings.width = description.settings.height = 100;
  description.settings.max_samples = 16;
  const PreparedScene scene = prepare(description);
  for (const int threads : {1, 2}) {
    const TemporaryDirectory directory;
    const auto checkpoint = directory / "state";
    std::atomic<int> now = 0;
    int seconds_of_first = 0;
    std::mutex looking;
    core::Rendering rendering(scene.data(), {.threads = threads, .checkpoint = checkpoint}, [&] {
      const int seconds = ++now;
      const std::lock_guard lock(looking);
      if (seconds_of_first == 0 && std::filesystem::exists(checkpoint)) {
        seconds_of_first = seconds;
        std::filesystem::copy_file(checkpoint, directory / "first");
      }
      return seconds;
    });
    rendering.run();
    CHECK(seconds_of_first > 0);
    // With other threads, which ask for the time as well, it flies while the file is written.
    if (threads == 1) CHECK(seconds_of_first <= 10);
    const Image reference = render(scene);
    CHECK(same_pixels(rendering.take(), reference));
    const Image continued = render(scene, {.checkpoint = directory / "first"});
    CHECK(same_pixels(continued, reference));
    CHECK(same_counts(continued.stats(), reference.stats()));
  }
}

TEST_CASE(
    "a picture that is cancelled at once leaves a checkpoint of nothing, and none that was there "
    "is lost") {
  const PreparedScene scene = prepare(varied_scene());
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  const auto refuse = [](double) { return false; };
  CHECK(failure(scene, {.progress = refuse, .checkpoint = checkpoint}) == ErrorCode::cancelled);
  REQUIRE(std::filesystem::exists(checkpoint));
  CHECK(same_pixels(render(scene, {.checkpoint = checkpoint}), render(scene)));
  const std::string done = content_of(checkpoint);
  CHECK(failure(scene, {.progress = refuse, .checkpoint = checkpoint}) == ErrorCode::cancelled);
  CHECK(content_of(checkpoint) == done);
  RenderJob job(scene, {.checkpoint = directory / "of_job"});
  job.cancel();
  try {
    job.wait();
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::cancelled);
  }
  CHECK(std::filesystem::exists(directory / "of_job"));
}

TEST_CASE("what fails while a picture is rendered leaves a checkpoint as well") {
  const PreparedScene scene = prepare(varied_scene());
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  const auto fail = [](double share) {
    if (share > 0.2) throw std::runtime_error("the host has had enough");
    return true;
  };
  CHECK_THROWS_AS(render(scene, {.progress = fail, .checkpoint = checkpoint}), std::runtime_error);
  REQUIRE(std::filesystem::exists(checkpoint));
  CHECK(same_pixels(render(scene, {.checkpoint = checkpoint}), render(scene)));
}

TEST_CASE("a checkpoint of another picture is refused") {
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  const Scene scene = varied_scene();
  render(prepare(scene), {.passes = 70, .checkpoint = checkpoint});
  const std::string before = content_of(checkpoint);
  std::vector<Scene> others(7, scene);
  others[0].settings.target_error = 4.0 / 255;
  others[1].settings.max_samples = 128;
  others[2].settings.filter = PixelFilter::blackman_harris;
  others[3].settings.width = 36;
  others[4].camera.position.x += 0.01;
  others[5].entities.pop_back();
  others[6].lights.pop_back();
  for (const Scene& other : others) {
    CHECK(failure(prepare(other), {.checkpoint = checkpoint}) == ErrorCode::invalid_argument);
  }
  CHECK(failure(prepare(scene), {.seed = 7, .checkpoint = checkpoint}) ==
        ErrorCode::invalid_argument);
  CHECK(failure(prepare(scene), {.passes = 69, .checkpoint = checkpoint}) ==
        ErrorCode::invalid_argument);
  CHECK(failure(prepare(scene), {.checkpoint = checkpoint, .aovs = {.normal = true}}) ==
        ErrorCode::invalid_argument);
  CHECK(content_of(checkpoint) == before);

  Scene grid = scene;
  grid.settings.target_error = 0;
  CHECK(failure(prepare(grid), {.checkpoint = directory / "of-grid"}) ==
        ErrorCode::invalid_argument);
}

TEST_CASE("a checkpoint that is damaged is an error, wherever it is") {
  const PreparedScene scene = prepare(varied_scene());
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  render(scene, {.passes = 74, .checkpoint = checkpoint});
  const std::string whole = content_of(checkpoint);
  const auto write = [&](const std::string& content) {
    std::ofstream(checkpoint, std::ios::binary) << content;
  };
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, std::size_t{8}, whole.size() / 2, whole.size() - 1}) {
    write(whole.substr(0, size));
    CHECK(failure(scene, {.checkpoint = checkpoint}) == ErrorCode::io);
  }
  for (std::size_t place = 3; place < whole.size(); place += whole.size() / 50) {
    std::string damaged = whole;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x20);
    write(damaged);
    CHECK(failure(scene, {.checkpoint = checkpoint}) == ErrorCode::io);
  }
  CHECK(failure(scene, {.checkpoint = directory.path()}) == ErrorCode::io);
}

TEST_CASE("nonsense with a right checksum does no harm") {
  const PreparedScene scene = prepare(varied_scene());
  const TemporaryDirectory directory;
  const auto checkpoint = directory / "state";
  int passes = 74;
  SUBCASE("after many passes") {}
  SUBCASE("before pixels are decided on") {
    passes = 9;
  }
  render(scene, {.passes = passes, .checkpoint = checkpoint});
  const std::string written = content_of(checkpoint);
  const std::string content = written.substr(0, written.size() - 8);
  const auto write = [&](const std::string& changed) {
    core::write_state_file(
        checkpoint, [&](core::StateWriter& out) { out.put_all(std::span<const char>(changed)); });
  };
  write(content);
  CHECK(content_of(checkpoint) == written);
  for (std::size_t place = 0; place < content.size();
       place += place < 200 ? 1 : 1 + content.size() / 150) {
    for (const char value : {'\0', '\xff', '\x7f'}) {
      std::string changed = content;
      changed[place] = value;
      write(changed);
      try {
        render(scene, {.passes = passes + 2, .checkpoint = checkpoint});
      } catch (const Error& error) {
        CHECK((error.code() == ErrorCode::io || error.code() == ErrorCode::invalid_argument));
      }
    }
  }
}

TEST_CASE("where no checkpoint can be written the picture is the same, and the log says so") {
  const PreparedScene scene = prepare(varied_scene());
  int warnings = 0;
  const Image image = render(
      scene,
      {.checkpoint = "/nowhere/at/all/state", .log = [&](LogLevel level, std::string_view line) {
         if (level == LogLevel::warning && line.find("checkpoint") != line.npos) ++warnings;
       }});
  CHECK(same_pixels(image, render(scene)));
  CHECK(warnings == 1);
}
