// These tests use libcrt as a plug-in: loaded, used, unloaded, loaded again; and twice at once.
#include <crt/crt.h>
#include <dlfcn.h>
#include <doctest/doctest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

namespace fs = std::filesystem;

namespace {

/// A Library holds the library's functions, found by name as a host of plug-ins finds them.
class Library {
 public:
  explicit Library(const std::string& file) : handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    INFO(file);
    REQUIRE(handle_ != nullptr);
  }
  ~Library() { dlclose(handle_); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  template <class Function>
  Function* find(const char* name) const {
    auto* const function = reinterpret_cast<Function*>(dlsym(handle_, name));
    INFO(name);
    REQUIRE(static_cast<bool>(function));
    return function;
  }

 private:
  void* handle_;
};

/// Renders a ball into an image file's bytes, and returns the sum of its pixels.
double use(const Library& crt) {
  const double center[3] = {0, 0, 2};
  crt_entity* ball = nullptr;
  crt_scene* scene = nullptr;
  crt_prepared* prepared = nullptr;
  crt_image* image = nullptr;
  REQUIRE(crt.find<decltype(crt_sphere_create)>("crt_sphere_create")(center, 1, &ball) == CRT_OK);
  REQUIRE(crt.find<decltype(crt_scene_create)>("crt_scene_create")(&scene) == CRT_OK);
  crt_settings settings;
  crt.find<decltype(crt_settings_init)>("crt_settings_init")(&settings, sizeof settings);
  settings.width = 32;
  settings.height = 24;
  REQUIRE(crt.find<decltype(crt_scene_set_settings)>("crt_scene_set_settings")(scene, &settings) ==
          CRT_OK);
  REQUIRE(crt.find<decltype(crt_scene_add_entity)>("crt_scene_add_entity")(scene, ball) == CRT_OK);
  REQUIRE(crt.find<decltype(crt_scene_prepare)>("crt_scene_prepare")(scene, &prepared) == CRT_OK);
  REQUIRE(crt.find<decltype(crt_render)>("crt_render")(prepared, nullptr, &image) == CRT_OK);
  const float* const pixels =
      crt.find<decltype(crt_image_pixels)>("crt_image_pixels")(image, nullptr);
  double sum = 0;
  for (std::size_t i = 0; i < std::size_t{4} * 32 * 24; ++i) sum += double{pixels[i]};
  crt.find<decltype(crt_image_release)>("crt_image_release")(image);
  crt.find<decltype(crt_prepared_release)>("crt_prepared_release")(prepared);
  crt.find<decltype(crt_scene_release)>("crt_scene_release")(scene);
  crt.find<decltype(crt_entity_release)>("crt_entity_release")(ball);
  return sum;
}

std::vector<std::string> maps() {
  std::ifstream file("/proc/self/maps");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

bool is_loaded(const std::string& name) {
  const std::vector<std::string> lines = maps();
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(name) != std::string::npos; });
}

std::ptrdiff_t thread_count() {
  const fs::directory_iterator tasks("/proc/self/task");
  return std::distance(begin(tasks), end(tasks));
}

}  // namespace

TEST_CASE("loading the library starts nothing and loads no OpenImageIO") {
  const std::ptrdiff_t before = thread_count();
  const Library crt(CRT_LIBRARY);
  CHECK(crt.find<decltype(crt_version)>("crt_version")() != 0);
  CHECK(thread_count() == before);
  CHECK_FALSE(is_loaded("libOpenImageIO"));
  CHECK(is_loaded("libcrt.so"));
}

TEST_CASE("load, unload and load again leaks nothing") {
  const auto cycle = [] {
    const Library crt(CRT_LIBRARY);
    return use(crt);
  };
  const double expected = cycle();
  for (int i = 0; i < 3; ++i) CHECK(cycle() == expected);
  const std::size_t heap = mallinfo2().uordblks;
  const std::size_t mappings = maps().size();
  const std::ptrdiff_t threads = thread_count();
  constexpr int cycles = 20;
  for (int i = 0; i < cycles; ++i) CHECK(cycle() == expected);
  // A cycle costs less than a small block. Mappings and threads stay as many, but for what the
  // allocator and TBB keep in reserve.
  CHECK(static_cast<double>(mallinfo2().uordblks) - static_cast<double>(heap) < cycles * 1024.0);
#ifdef __SANITIZE_THREAD__
  static_cast<void>(
      mappings);  // ThreadSanitizer maps memory of its own for each thread that ever ran
#else
  CHECK(maps().size() < mappings + cycles);
#endif
  CHECK(thread_count() <= threads + 2);
}

TEST_CASE("a copy of the library is a second instance beside the first") {
  const fs::path folder =
      fs::temp_directory_path() / ("crt-copy-" + fs::read_symlink("/proc/self").string());
  fs::create_directories(folder);
  const fs::path copy = folder / "libcrt-copy.so";
  fs::copy_file(CRT_LIBRARY, copy, fs::copy_options::overwrite_existing);
  {
    const Library first(CRT_LIBRARY);
    const Library second(copy.string());
    const bool distinct = first.find<decltype(crt_version)>("crt_version") !=
                          second.find<decltype(crt_version)>("crt_version");
    CHECK(distinct);
    CHECK(use(first) == use(second));
    // A message in one copy does not appear in the other.
    crt_entity* none = nullptr;
    const double center[3] = {0, 0, 0};
    const double radius = -1;
    CHECK(second.find<decltype(crt_sphere_create)>("crt_sphere_create")(center, radius, &none) !=
          CRT_OK);
    CHECK(std::strlen(second.find<decltype(crt_error_message)>("crt_error_message")()) > 0);
    CHECK(std::strlen(first.find<decltype(crt_error_message)>("crt_error_message")()) == 0);
    // Both copies render at once.
    double sum = 0;
    std::thread other([&] { sum = use(second); });
    const double mine = use(first);
    other.join();
    CHECK(mine == sum);
  }
  fs::remove_all(folder);
}

TEST_CASE("a thread that met the library may outlive it") {
  std::string said;
  auto crt = std::make_unique<Library>(CRT_LIBRARY);
  bool unloaded = false;
  std::thread host([&] {
    crt_entity* none = nullptr;
    const double center[3] = {0, 0, 0};
    crt->find<decltype(crt_sphere_create)>("crt_sphere_create")(center, NAN, &none);
    said = crt->find<decltype(crt_error_message)>("crt_error_message")();
    crt.reset();
    unloaded = true;
  });
  host.join();
  CHECK(unloaded);
  CHECK(said.find("radius") != std::string::npos);
}
