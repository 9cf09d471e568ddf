// These tests check how a render behaves towards the program that asks for it.
#include <doctest/doctest.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <crt/error.hpp>
#include <crt/query.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Scene lit_scene(int width, int height) {
  Scene scene;
  scene.settings.width = width;
  scene.settings.height = height;
  scene.camera = {.position = {0, 1, -4}, .pointing = {0, 0.5, 0}};
  scene.lights = {PointLight{.origin = {2, 4, -3}}};
  scene.entities = {Plane{}, Sphere{.center = {0, 1, 0}, .radius = 0.8, .material = glass(1.5)}};
  return scene;
}

template <class Call>
ErrorCode error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return ErrorCode::internal;
}

#ifdef __linux__
std::ptrdiff_t thread_count() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}
#endif

}  // namespace

TEST_CASE("progress starts at 0, never falls, ends at 1, and comes from one thread at a time") {
  const PreparedScene scene = prepare(lit_scene(200, 150));
  for (const int threads : {1, 4}) {
    std::vector<double> shares;
    std::atomic<int> inside = 0;
    bool overlapped = false;
    render(scene, {.threads = threads, .progress = [&](double share) {
                     overlapped = overlapped || ++inside != 1;
                     shares.push_back(share);
                     --inside;
                     return true;
                   }});
    CHECK_FALSE(overlapped);
    REQUIRE(shares.size() > 10);
    CHECK(shares.size() < 150);
    CHECK(shares.front() == 0);
    CHECK(shares.back() == 1);
    CHECK(std::is_sorted(shares.begin(), shares.end()));
  }
}

TEST_CASE("a render is cancelled at the start, in the middle, and at the end") {
  const PreparedScene scene = prepare(lit_scene(100, 100));
  for (const int threads : {0, 1, 3}) {
    for (const double limit : {0.0, 0.3, 1.0}) {
      double last = -1;
      const auto cancelled = error_of([&] {
        render(scene, {.threads = threads, .progress = [&](double share) {
                         last = share;
                         return share < limit;
                       }});
      });
      CHECK(cancelled == ErrorCode::cancelled);
      CHECK(last >= limit);
      CHECK(last < limit + 0.2);
    }
  }
}

TEST_CASE("a single pixel that would take days is cancelled in its middle") {
  Scene scene = lit_scene(1, 1);
  scene.settings.supersampling = 64;
  scene.settings.dof_samples = 65536;
  scene.camera.aperture = 10;
  scene.settings.recursion_depth = 50;
  scene.settings.min_weight = 0;
  for (const int threads : {1, 2}) {
    int calls = 0;
    CHECK(error_of([&] {
            render(prepare(scene),
                   {.threads = threads, .progress = [&](double) { return ++calls < 3; }});
          }) == ErrorCode::cancelled);
    CHECK(calls == 3);
  }
}

TEST_CASE("what a progress callback throws comes out of the render") {
  const PreparedScene scene = prepare(lit_scene(64, 64));
  for (const int threads : {0, 1, 3}) {
    CHECK_THROWS_AS(render(scene, {.threads = threads,
                                   .progress = [](double share) -> bool {
                                     if (share > 0.3) throw std::domain_error("mine");
                                     return true;
                                   }}),
                    std::domain_error);
  }
}

TEST_CASE("a progress callback may render another picture") {
  const PreparedScene scene = prepare(lit_scene(64, 64));
  const Image reference = render(scene);
  int inner = 0;
  const Image image = render(scene, {.progress = [&](double) {
                               if (++inner < 5) CHECK(same_pixels(render(scene), reference));
                               return true;
                             }});
  CHECK(same_pixels(image, reference));
}

TEST_CASE("several programs' threads may render one prepared scene at once") {
  const PreparedScene scene = prepare(lit_scene(48, 48));
  const Image reference = render(scene, {.threads = 1});
  std::atomic<int> equal = 0;
  {
    std::vector<std::jthread> hosts;
    for (const int threads : {0, 1, 2, 3}) {
      hosts.emplace_back([&, threads] {
        if (same_pixels(render(scene, {.threads = threads}), reference)) ++equal;
      });
    }
  }
  CHECK(equal == 4);
}

TEST_CASE("a region outside the picture, or of no pixels, is refused") {
  const PreparedScene scene = prepare(lit_scene(20, 10));
  const int most = std::numeric_limits<int>::max();
  for (const Region& region :
       {Region{-1, 0, 5, 5}, Region{0, -1, 5, 5}, Region{16, 0, 5, 5}, Region{0, 6, 5, 5},
        Region{0, 0, 0, 5}, Region{0, 0, 5, 0}, Region{0, 0, 21, 1}, Region{most, 0, most, 1},
        Region{1, 1, most, most}, Region{0, 0, -5, 5}}) {
    try {
      render(scene, {.region = region});
      FAIL("not refused");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      CHECK(error.argument() == "region");
    }
  }
  CHECK(render(scene, {.region = Region{19, 9, 1, 1}}).width() == 1);
  CHECK(error_of([&] { render(scene, {.threads = -1}); }) == ErrorCode::invalid_argument);
}

TEST_CASE("more threads than anyone has are no harm") {
  const PreparedScene scene = prepare(lit_scene(20, 10));
  CHECK(same_pixels(render(scene, {.threads = std::numeric_limits<int>::max()}),
                    render(scene, {.threads = 1})));
}

TEST_CASE("the host's floating-point mode has no influence, and is there again afterwards") {
  const PreparedScene scene = prepare(lit_scene(40, 30));
  const Image reference = render(scene, {.threads = 1});
  const Ray ray{.origin = {0, 1, -4}, .direction = {0, 0, 1}};
  const auto hit = intersect(scene, ray);
  const unsigned before = _mm_getcsr();
  // The control word flushes to zero, takes denormals for zero and rounds towards zero. All
  // exceptions are masked, and one flag is raised.
  const unsigned odd = 0x8040u | 0x6000u | 0x1f80u | 0x0004u;
  for (const int threads : {0, 1, 3}) {
    _mm_setcsr(odd);
    const Image image = render(scene, {.threads = threads});
    const auto same_hit = intersect(scene, ray);
    const unsigned after = _mm_getcsr();
    _mm_setcsr(before);
    CHECK(after == odd);
    CHECK(same_pixels(image, reference));
    CHECK(same_hit->t == hit->t);
  }
}

#ifdef __linux__
TEST_CASE("one thread means the calling one: none is started") {
  const PreparedScene scene = prepare(lit_scene(100, 100));
  const std::ptrdiff_t before = thread_count();
  std::ptrdiff_t most = 0;
  const std::thread::id caller = std::this_thread::get_id();
  bool always_here = true;
  render(scene, {.threads = 1, .progress = [&](double) {
                   most = std::max(most, thread_count());
                   always_here = always_here && std::this_thread::get_id() == caller;
                   return true;
                 }});
  CHECK(most == before);
  CHECK(always_here);
}
#endif

TEST_CASE(
    "values of a picture that are not finite are warned of once, whatever it serves for, and count "
    "as 0") {
  auto image = std::make_shared<Image>(8, 4);
  const float infinity = std::numeric_limits<float>::infinity();
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) image->set(x, y, {infinity, 0.5, 0.25, 1});
  }
  Scene scene = lit_scene(8, 6);
  scene.background = PanoramaBackground{.image = image};
  scene.entities = {Sphere{.material = Material{.color = Pattern(ImageMap{.image = image})}}};
  scene.camera = {.position = {0, 0, -4}, .pointing = {0, 5, 0}};
  std::vector<std::string> warnings;
  const RenderOptions options{.log = [&](LogLevel level, std::string_view line) {
    if (level == LogLevel::warning) warnings.emplace_back(line);
  }};
  const Image picture = render(prepare(scene), options);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("an image has 32 pixels with values that are not finite") !=
        std::string::npos);
  CHECK(warnings[0].find("(0, 0)") != std::string::npos);
  CHECK(picture.at(4, 0) == Color{0, 0.5, 0.25, 1});

  // This picture is known to have had some in its file.
  auto read = std::make_shared<Image>(8, 4);
  read->set_not_finite({.file = "sky.exr", .pixels = 1, .x = 3, .y = 2});
  scene.background = PanoramaBackground{.image = read};
  scene.entities = {Sphere{}};
  render(prepare(scene), options);
  REQUIRE(warnings.size() == 2);
  CHECK(warnings[1] == read->not_finite().message());
}
