// These tests let memory run out. Every allocation of a call fails once, and each time an error
// comes back and nothing is lost.
#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <new>

#include "capi/support.hpp"

using namespace crt::test;

namespace {

constexpr std::size_t usual_alignment = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

/// Counts the blocks of all threads that are not given back yet.
std::atomic<long> blocks = 0;
/// This thread gets so many more allocations before one fails. Negative means all.
thread_local long until_failure = -1;
thread_local bool failed = false;

/// Says whether any caller of this one is code of Embree.
bool called_by_embree() {
  std::array<void*, 64> callers;
  const int count = backtrace(callers.data(), static_cast<int>(callers.size()));
  return std::any_of(callers.begin(), callers.begin() + count, [](const void* code) {
    Dl_info info{};
    return dladdr(code, &info) != 0 && std::strstr(info.dli_fname, "libembree") != nullptr;
  });
}

bool fails_now() {
  if (until_failure < 0) return false;
  if (until_failure > 0) {
    --until_failure;
    return false;
  }
  if (called_by_embree())
    return false;  // Embree 3.13 uses what it has freed once memory has run out
  until_failure = -1;
  failed = true;
  return true;
}

void* allocate(std::size_t size, std::size_t alignment) {
  if (fails_now()) return nullptr;
  const std::size_t rounded =
      (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* const block = std::aligned_alloc(alignment, rounded);
  if (block != nullptr) ++blocks;
  return block;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment = usual_alignment) {
  void* const block = allocate(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void free_block(void* block) {
  if (block != nullptr) --blocks;
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate_or_throw(size);
}
void* operator new[](std::size_t size) {
  return allocate_or_throw(size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, usual_alignment);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size, usual_alignment);
}
void operator delete(void* block) noexcept {
  free_block(block);
}
void operator delete[](void* block) noexcept {
  free_block(block);
}
void operator delete(void* block, std::size_t) noexcept {
  free_block(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  free_block(block);
}
void operator delete(void* block, std::align_val_t) noexcept {
  free_block(block);
}
void operator delete[](void* block, std::align_val_t) noexcept {
  free_block(block);
}
void operator delete(void* block, std::size_t, std::align_val_t) noexcept {
  free_block(block);
}
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept {
  free_block(block);
}

namespace {

/// An Outcome is the status of a call, and how many blocks are left over when everything that it
/// gave is released.
struct Outcome {
  crt_status status;
  long left;
};

/// Runs `call` with its allocation number `number` failing. Negative means none.
Outcome with_failure(const std::function<crt_status()>& call, long number) {
  const long before = blocks;
  failed = false;
  until_failure = number;
  const crt_status status = call();
  until_failure = -1;
  return {status, blocks - before};
}

/// Lets each allocation of `call` fail in turn. `call` releases what it is given.
void check_every_failure(const std::function<crt_status()>& call) {
  // The call runs once or twice without a failure: what is made once and kept (workers of TBB, a
  // module) is no loss.
  REQUIRE(with_failure(call, -1).status == CRT_OK);
  REQUIRE(with_failure(call, -1).left == 0);
  long failures = 0;
  for (;; ++failures) {
    const Outcome outcome = with_failure(call, failures);
    if (!failed) break;
    INFO("allocation " << failures << ": " << message());
    REQUIRE(outcome.status == CRT_ERROR_OUT_OF_MEMORY);
    REQUIRE(message().size() > 3);
    REQUIRE(outcome.left == 0);
  }
  CHECK(failures > 0);
  REQUIRE(with_failure(call, -1).status == CRT_OK);
}

/// Makes a handle and releases it at once.
template <class Handle, class Make>
crt_status made_and_released(const Make& make) {
  typename Handle::pointer out = nullptr;
  const crt_status status = make(&out);
  const Handle released(out);
  return status;
}

const Numbers zero = {0, 0, 0};

crt_material patterned(crt_pattern& pattern) {
  crt_pattern_init(&pattern, sizeof pattern);
  crt_material material;
  crt_material_init(&material, sizeof material);
  material.pattern = &pattern;
  return material;
}

}  // namespace

TEST_CASE("making, combining and placing entities") {
  check_every_failure([] {
    return made_and_released<EntityHandle>(
        [](crt_entity** out) { return crt_sphere_create(zero.data(), 1, out); });
  });
  const EntityHandle a = sphere(zero, 1);
  const EntityHandle b = box(zero, {1, 1, 1});
  crt_entity* const both[] = {a.get(), b.get()};
  check_every_failure([&] {
    return made_and_released<EntityHandle>(
        [&](crt_entity** out) { return crt_union_create(both, 2, out); });
  });
  check_every_failure([&] {
    return made_and_released<EntityHandle>(
        [&](crt_entity** out) { return crt_difference_create(a.get(), both, 2, out); });
  });
  const double shift[12] = {1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
  check_every_failure([&] {
    return made_and_released<EntityHandle>(
        [&](crt_entity** out) { return crt_entity_with_transform(a.get(), shift, out); });
  });
  crt_pattern pattern;
  const crt_material material = patterned(pattern);
  check_every_failure([&] {
    return made_and_released<EntityHandle>(
        [&](crt_entity** out) { return crt_entity_with_material(a.get(), &material, out); });
  });
  const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const std::uint32_t indices[] = {0, 1, 2, 1, 3, 2};
  check_every_failure([&] {
    return made_and_released<EntityHandle>(
        [&](crt_entity** out) { return crt_mesh_create(corners, 4, indices, 2, out); });
  });
}

TEST_CASE("measuring") {
  // Little has to be looked at where all faces are flat.
  const EntityHandle a = box(zero, {2, 1, 1});
  const EntityHandle b = box({1, 0, 0}, {3, 1, 1});
  const EntityHandle part = difference(a.get(), b.get());
  crt_mass mass;
  crt_mass_init(&mass, sizeof mass);
  check_every_failure([&] { return crt_entity_mass(part.get(), 1, 0, &mass); });
  double lower[3];
  double upper[3];
  check_every_failure([&] { return crt_entity_bounds(part.get(), lower, upper); });
  std::int8_t side = 0;
  check_every_failure([&] { return crt_entity_contains(part.get(), lower, 0, 1, &side); });
  double distance = 0;
  check_every_failure(
      [&] { return crt_entity_distance(part.get(), upper, 0, 1, &distance, nullptr, 0); });
  const EntityHandle apart = box({4, 0, 0}, {5, 1, 1});
  crt_interval clearance;
  check_every_failure(
      [&] { return crt_entity_clearance(part.get(), apart.get(), 1, &clearance, lower, upper); });
  check_every_failure(
      [&] { return crt_entity_thickness(apart.get(), 1, &clearance, lower, upper); });
  check_every_failure([&] {
    crt_surface_mesh* surface = nullptr;
    const crt_status status = crt_entity_tessellate(apart.get(), 0.5, &surface);
    crt_surface_mesh_release(surface);
    return status;
  });
  crt_entity* const both[2] = {a.get(), b.get()};
  std::size_t count = 0;
  check_every_failure([&] { return crt_interference(both, 2, 1, 0, nullptr, 0, &count); });
}

TEST_CASE("putting a scene together and copying it") {
  const EntityHandle ball = sphere(zero, 1);
  crt_light light;
  crt_light_init(&light, sizeof light);
  crt_settings settings;
  crt_settings_init(&settings, sizeof settings);
  settings.title = "a title that is too long for the buffer that short texts have";
  check_every_failure([&] {
    return made_and_released<SceneHandle>([&](crt_scene** out) {
      crt_status status = crt_scene_create(out);
      if (status == CRT_OK) status = crt_scene_add_entity(*out, ball.get());
      if (status == CRT_OK) status = crt_scene_add_light(*out, &light);
      if (status == CRT_OK) status = crt_scene_set_settings(*out, &settings);
      return status;
    });
  });
  const SceneHandle scene = small_scene();
  check_every_failure([&] {
    return made_and_released<SceneHandle>(
        [&](crt_scene** out) { return crt_scene_copy(scene.get(), out); });
  });
  // A call that failed has changed nothing.
  std::size_t added = crt_scene_entity_count(scene.get());
  crt_status status = CRT_OK;
  while (status == CRT_OK) {
    until_failure = 0;
    status = crt_scene_add_entity(scene.get(), ball.get());
    until_failure = -1;
    if (status == CRT_OK) ++added;
  }
  CHECK(status == CRT_ERROR_OUT_OF_MEMORY);
  CHECK(crt_scene_entity_count(scene.get()) == added);
}

TEST_CASE("preparing a scene") {
  const SceneHandle scene = small_scene();
  check_every_failure([&] {
    return made_and_released<PreparedHandle>(
        [&](crt_prepared** out) { return crt_scene_prepare(scene.get(), out); });
  });
}

TEST_CASE("rendering, at once and as a job") {
  const SceneHandle scene = small_scene(16, 12);
  const PreparedHandle prepared = prepare(scene.get());
  crt_render_options options;
  crt_render_options_init(&options, sizeof options);
  options.threads = 1;
  options.progress = [](double, void*) { return 0; };
  check_every_failure([&] {
    return made_and_released<ImageHandle>(
        [&](crt_image** out) { return crt_render(prepared.get(), &options, out); });
  });
  check_every_failure([&] {
    return made_and_released<JobHandle>(
        [&](crt_job** out) { return crt_render_start(prepared.get(), &options, out); });
  });
}

TEST_CASE("asking rays") {
  const SceneHandle scene = small_scene();
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray rays[3] = {{{-0.4, 0, 0}, {0, 0, 1}, 0, infinity},
                           {{0.7, 0, 0}, {0, 0, 1}, 0, infinity},
                           {{0.4, 0.4, 0}, {0, 0, 1}, 0, infinity}};
  check_every_failure([&] {
    crt_hit hits[3];
    return crt_intersect(prepared.get(), rays, 0, 3, hits, 0);
  });
  check_every_failure([&] {
    std::uint8_t occluded[3];
    return crt_occluded(prepared.get(), rays, 0, 3, occluded);
  });
  check_every_failure([&] {
    double distances[3];
    return crt_distances(prepared.get(), rays, 0, 3, distances, nullptr);
  });
  check_every_failure([&] {
    crt_hit hits[4];
    std::size_t count = 0;
    return crt_crossings(prepared.get(), &rays[1], hits, 4, &count);
  });
}

TEST_CASE("running scripts, good and bad") {
  const std::string good =
      "f = Macro (n) { Sphere { center -> vec3(n, 0, 0) radius -> 1 } }\nl = [1, 2.5, \"three\"]\n"
      "Settings { title -> \"a title that is too long for the buffer that short texts have\" }\n"
      "Scene { for (i in range(3)) { f(i) } Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, "
      "1) } }\n";
  const std::string bad = "f = Macro (n) { g(n) }\nScene { f(2) }\n";
  const auto run = [](const std::string& text) {
    crt_diagnostics* diagnostics = nullptr;
    crt_scene* scene = nullptr;
    const crt_status status = crt_scene_from_script(text.data(), text.size(), "some/test.crt",
                                                    nullptr, &diagnostics, &scene);
    const DiagnosticsHandle released(diagnostics);
    const SceneHandle also(scene);
    return status;
  };
  check_every_failure([&] { return run(good); });
  check_every_failure([&] {
    const crt_status status = run(bad);
    return status == CRT_ERROR_SCRIPT ? CRT_OK : status;
  });
}

TEST_CASE("images in memory") {
  const float pixel[4] = {1, 1, 1, 1};
  check_every_failure([&] {
    return made_and_released<ImageHandle>(
        [&](crt_image** out) { return crt_image_create(1, 1, pixel, 0, out); });
  });
  const std::uint8_t bytes[4] = {1, 2, 3, 4};
  check_every_failure([&] {
    return made_and_released<ImageHandle>(
        [&](crt_image** out) { return crt_image_from_rgba8(1, 1, bytes, 0, out); });
  });
  const ImageHandle image =
      made<ImageHandle>([&](crt_image** out) { return crt_image_create(1, 1, pixel, 0, out); });
  check_every_failure([&] {
    std::uint8_t out[4];
    return crt_image_to_rgba8(image.get(), out, 0);
  });
  crt_settings settings;
  crt_settings_init(&settings, sizeof settings);
  check_every_failure([&] {
    return made_and_released<ImageHandle>(
        [&](crt_image** out) { return crt_image_with_settings(image.get(), &settings, out); });
  });
}
