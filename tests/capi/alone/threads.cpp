// These tests check what the C interface promises about threads and about the process that it lives
// in.
#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <clocale>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#ifndef CRT_TASKS_THREADS
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#endif

#include "capi/support.hpp"

using namespace crt::test;

namespace {

std::ptrdiff_t thread_count() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

std::vector<float> pixels_of(const crt_image* image) {
  const float* const first = crt_image_pixels(image, nullptr);
  return {first, first + std::size_t{4} * crt_image_width(image) * crt_image_height(image)};
}

/// Callers are the threads from which a render's callbacks came.
struct Callers {
  std::mutex mutex;
  std::set<std::thread::id> threads;

  static int note(double, void* user) {
    auto* const callers = static_cast<Callers*>(user);
    const std::lock_guard lock(callers->mutex);
    callers->threads.insert(std::this_thread::get_id());
    return 0;
  }
};

crt_render_options options_with(Callers& callers, std::int32_t threads) {
  crt_render_options options;
  REQUIRE(crt_render_options_init(&options, sizeof options) == CRT_OK);
  options.threads = threads;
  options.progress = Callers::note;
  options.progress_user = &callers;
  return options;
}

std::int32_t threads_of(const crt_image* image) {
  crt_render_stats stats;
  stats.struct_size = sizeof stats;
  REQUIRE(crt_image_stats(image, &stats) == CRT_OK);
  return stats.threads;
}

#ifndef CRT_TASKS_THREADS
/// Returns how many threads TBB may start in this process.
std::size_t parallelism_allowed() {
  return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}
#endif

/// A ProcessState is what of the process a library could change without its host noticing.
struct ProcessState {
  std::string locale = std::setlocale(LC_ALL, nullptr);
  std::filesystem::path folder = std::filesystem::current_path();
  std::vector<std::string> environment;
  std::array<struct sigaction, 32> signals{};
  std::array<rlimit, RLIM_NLIMITS> limits{};
  cpu_set_t affinity{};
  unsigned float_mode = _mm_getcsr();
#ifndef CRT_TASKS_THREADS
  std::size_t parallelism =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  std::size_t stack_size =
      tbb::global_control::active_value(tbb::global_control::thread_stack_size);
#endif

  ProcessState() {
    for (char** variable = environ; *variable != nullptr; ++variable)
      environment.emplace_back(*variable);
    for (int i = 1; i < 32; ++i) sigaction(i, nullptr, &signals[static_cast<std::size_t>(i)]);
    for (int i = 0; i < RLIM_NLIMITS; ++i) {
      getrlimit(static_cast<__rlimit_resource>(i), &limits[static_cast<std::size_t>(i)]);
    }
    sched_getaffinity(0, sizeof affinity, &affinity);
  }

  void check_same(const ProcessState& other) const {
    CHECK(locale == other.locale);
    CHECK(folder == other.folder);
    CHECK(environment == other.environment);
    CHECK(float_mode == other.float_mode);
    for (std::size_t i = 1; i < signals.size(); ++i) {
      CHECK((signals[i].sa_handler == other.signals[i].sa_handler));
      CHECK(signals[i].sa_flags == other.signals[i].sa_flags);
    }
    CHECK(std::memcmp(limits.data(), other.limits.data(), sizeof limits) == 0);
    CHECK(CPU_EQUAL(&affinity, &other.affinity));
#ifndef CRT_TASKS_THREADS
    CHECK(parallelism == other.parallelism);
    CHECK(stack_size == other.stack_size);
#endif
  }
};

constexpr unsigned flush_to_zero = 0x8040;

}  // namespace

// This is the first test, while nothing has started a thread yet.
TEST_CASE("one thread means the caller's: none is started, and every callback comes from it") {
  const std::ptrdiff_t before = thread_count();
  const SceneHandle scene = small_scene(64, 48);
  const PreparedHandle prepared = prepare(scene.get());
  const std::ptrdiff_t ready = thread_count();
  Callers callers;
  const crt_render_options options = options_with(callers, 1);
  const ImageHandle image = render(prepared.get(), &options);
  CHECK(thread_count() == ready);
  CHECK(callers.threads == std::set{std::this_thread::get_id()});
  CHECK(threads_of(image.get()) == 1);
  // A small scene is prepared, and few rays are asked, on the calling thread, too.
  std::vector<crt_ray> rays(100, {{0, 0, 0}, {0, 0, 1}, 0, infinity});
  std::vector<crt_hit> hits(rays.size());
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), hits.data(), 0) == CRT_OK);
  CHECK(thread_count() == ready);
  CHECK(ready == before);
}

TEST_CASE("nothing of the process is changed") {
  const ProcessState before;
  {
    const SceneHandle scene = small_scene(64, 48);
    const PreparedHandle prepared = prepare(scene.get());
    const ImageHandle image = render(prepared.get());
    crt_buffer* png = nullptr;
    REQUIRE(crt_image_encode(image.get(), "png", nullptr, &png) == CRT_OK);
    const BufferHandle released(png);
    crt_scene* made_scene = nullptr;
    crt_scene_from_script("Scene { }", 9, "x", nullptr, nullptr, &made_scene);
    const SceneHandle also_released(made_scene);
  }
  const ProcessState after;
  before.check_same(after);
}

TEST_CASE(
    "a host's floating-point mode changes no picture, and is there in its callbacks and "
    "afterwards") {
  const SceneHandle scene = small_scene(64, 48);
  const std::vector<float> expected = [&] {
    const PreparedHandle prepared = prepare(scene.get());
    return pixels_of(render(prepared.get()).get());
  }();
  const unsigned usual = _mm_getcsr();
  for (const std::int32_t threads : {1, 0}) {
    constexpr unsigned round_up = 0x4000;
    _mm_setcsr((usual | flush_to_zero | round_up) & ~0x3fu);
    struct Modes {
      std::thread::id host = std::this_thread::get_id();
      std::atomic<int> wrong = 0;
      std::atomic<int> seen = 0;
    } modes;
    crt_render_options options;
    crt_render_options_init(&options, sizeof options);
    options.threads = threads;
    options.progress = [](double, void* user) {
      auto* const all = static_cast<Modes*>(user);
      if (std::this_thread::get_id() != all->host) return 0;
      ++all->seen;
      if ((_mm_getcsr() & (flush_to_zero | round_up)) != (flush_to_zero | round_up)) ++all->wrong;
      return 0;
    };
    options.progress_user = &modes;
    crt_prepared* prepared = nullptr;
    const crt_status ready = crt_scene_prepare(scene.get(), &prepared);
    crt_image* image = nullptr;
    const crt_status status = crt_render(prepared, &options, &image);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(usual);
    REQUIRE(ready == CRT_OK);
    REQUIRE(status == CRT_OK);
    CHECK((after & (flush_to_zero | round_up)) == (flush_to_zero | round_up));
    CHECK(modes.seen > 0);
    CHECK(modes.wrong == 0);
    CHECK(pixels_of(image) == expected);
    crt_image_release(image);
    crt_prepared_release(prepared);
  }
}

TEST_CASE("two threads render two scenes at once, each as if it were alone") {
  std::vector<std::vector<float>> alone;
  std::vector<SceneHandle> scenes;
  scenes.push_back(small_scene(80, 60));
  scenes.push_back(small_scene(60, 80));
  crt_background night;
  crt_background_init(&night, sizeof night);
  night.color[0] = night.color[1] = 0;
  REQUIRE(crt_scene_set_background(scenes[1].get(), &night) == CRT_OK);
  for (const SceneHandle& scene : scenes) {
    const PreparedHandle prepared = prepare(scene.get());
    alone.push_back(pixels_of(render(prepared.get()).get()));
  }
  std::array<int, 2> wrong = {0, 0};
  std::vector<std::thread> threads;
  for (std::size_t which = 0; which < 2; ++which) {
    threads.emplace_back([&, which] {
      for (int i = 0; i < 5; ++i) {
        crt_prepared* prepared = nullptr;
        crt_image* image = nullptr;
        if (crt_scene_prepare(scenes[which].get(), &prepared) != CRT_OK ||
            crt_render(prepared, nullptr, &image) != CRT_OK || pixels_of(image) != alone[which]) {
          ++wrong[which];
        }
        crt_image_release(image);
        crt_prepared_release(prepared);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == std::array<int, 2>{0, 0});
}

TEST_CASE("64 threads query one prepared scene") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  std::vector<crt_ray> rays;
  for (int i = 0; i < 1500; ++i) {
    rays.push_back({{-1.5 + i * 0.002, 0.1, 0}, {0, 0, 1}, 0, infinity});
  }
  std::vector<crt_hit> expected(rays.size());
  REQUIRE(crt_intersect(prepared.get(), rays.data(), 0, rays.size(), expected.data(), 0) == CRT_OK);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 64; ++i) {
    threads.emplace_back([&, i] {
      std::vector<crt_hit> hits(rays.size());
      // Some rays are asked in one batch, some one by one.
      crt_status status = CRT_OK;
      if (i % 2 == 0) {
        status = crt_intersect(prepared.get(), rays.data(), 0, rays.size(), hits.data(), 0);
      } else {
        for (std::size_t k = 0; k < rays.size() && status == CRT_OK; ++k) {
          status = crt_intersect(prepared.get(), &rays[k], 0, 1, &hits[k], 0);
        }
      }
      if (status != CRT_OK ||
          std::memcmp(hits.data(), expected.data(), hits.size() * sizeof(crt_hit)) != 0) {
        ++wrong;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

TEST_CASE("a job is watched, and cancelled, by many threads") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  const JobHandle job = made<JobHandle>(
      [&](crt_job** out) { return crt_render_start(prepared.get(), nullptr, out); });
  std::atomic<int> wrong = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 6; ++i) {
    threads.emplace_back([&, i] {
      double before = 0;
      for (int k = 0; k < 10; ++k) {
        double fraction = -1;
        if (crt_job_progress(job.get(), &fraction) != CRT_OK || fraction < before) ++wrong;
        before = fraction;
        crt_image* image = nullptr;
        if (crt_job_snapshot(job.get(), &image) != CRT_OK || crt_image_width(image) != 200) ++wrong;
        crt_image_release(image);
      }
      if (i == 0 && crt_job_cancel(job.get()) != CRT_OK) ++wrong;
      const crt_status end = crt_job_wait(job.get(), nullptr);
      if (end != CRT_OK && end != CRT_ERROR_CANCELLED) ++wrong;
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}

#ifndef CRT_TASKS_THREADS

TEST_CASE("rendering stays within the host's arena") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<float> expected = pixels_of(render(prepared.get()).get());
  for (const int size : {1, 2}) {
    tbb::task_arena arena(size);
    Callers callers;
    const crt_render_options options = options_with(callers, 0);
    ImageHandle image;
    arena.execute([&] { image = render(prepared.get(), &options); });
    CHECK(threads_of(image.get()) == size);
    CHECK(callers.threads.size() <= static_cast<std::size_t>(size));
    CHECK(pixels_of(image.get()) == expected);
  }
}

TEST_CASE("a job uses as many threads as the arena that it was started from has") {
  const SceneHandle scene = small_scene(200, 150);
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<float> expected = pixels_of(render(prepared.get()).get());
  for (const int size : {1, 2}) {
    tbb::task_arena arena(size);
    arena.execute([&] {
      Callers callers;
      const crt_render_options options = options_with(callers, 0);
      const JobHandle job = made<JobHandle>(
          [&](crt_job** out) { return crt_render_start(prepared.get(), &options, out); });
      const ImageHandle image =
          made<ImageHandle>([&](crt_image** out) { return crt_job_wait(job.get(), out); });
      CHECK(threads_of(image.get()) == std::min(size, static_cast<int>(parallelism_allowed())));
      CHECK(callers.threads.size() <= static_cast<std::size_t>(size));
      CHECK(pixels_of(image.get()) == expected);
    });
  }
}

TEST_CASE("a host may call from within its own parallel work") {
  const SceneHandle scene = small_scene(40, 30);
  const PreparedHandle prepared = prepare(scene.get());
  const std::vector<float> expected = pixels_of(render(prepared.get()).get());
  std::atomic<int> wrong = 0;
  tbb::parallel_for(0, 16, [&](int) {
    crt_image* image = nullptr;
    if (crt_render(prepared.get(), nullptr, &image) != CRT_OK || pixels_of(image) != expected)
      ++wrong;
    crt_image_release(image);
  });
  CHECK(wrong == 0);
}

#endif
