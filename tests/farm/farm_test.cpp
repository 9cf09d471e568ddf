// The pictures of a job have the bytes of one render, however it is split and worked on.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <crt/farm.hpp>
#include <crt/file.hpp>
#include <crt/prepared_scene.hpp>
#include <fstream>
#include <iterator>

#include "support/temporary_directory.hpp"

using namespace crt;
using crt::test::TemporaryDirectory;

namespace {

/// This picture has glass, mirrors and a soft shadow, so that its pixels need different numbers of
/// samples, and some paths are cut off.
const std::string scene_text = R"(Settings {
  width -> 53 height -> 37 recursiondepth -> 2 title -> "A job"
  camera -> Camera { position -> vec3(0, 1, -5) pointing -> vec3(0, 0, 0) }
  lights -> [PointLight { origin -> vec3(3, 5, -9) color -> rgb(1, 1, 1) }]
}
Scene {
  Sphere { center -> vec3(t / 4 - 1, 0, 0) radius -> 1
           material -> Material { transparency -> 0.7 refractiveindex -> 1.5 } }
  Sphere { center -> vec3(1, 0, 0) radius -> 1 material -> Material { reflectivity -> 0.5 } }
  Sphere { center -> vec3(0, 0.8, -1) radius -> 0.02 }
}
)";

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct Place {
  TemporaryDirectory folder;
  std::filesystem::path script = folder / "scene.crt";
  std::filesystem::path job = folder / "job";

  explicit Place(const std::string& text = scene_text) { write_file(script, text); }

  /// Renders a frame in one piece, on one thread, and returns its file.
  std::string whole(const FarmOptions& options, int frame, int passes, const char* format) const {
    ScriptOptions with_time = options.script;
    if (options.frames) with_time.t = frame;
    const ScriptResult result = run_script_file(script, with_time);
    REQUIRE(result.scene);
    RenderOptions render_options = options.render;
    render_options.threads = 1;
    render_options.passes = passes;
    const Image image = render(prepare(*result.scene), render_options);
    const std::vector<std::byte> bytes = image.encode(format, {.reproducible = true});
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
};

void work_on_all(const std::filesystem::path& job, int tasks) {
  for (int task = tasks - 1; task >= 0; --task) CHECK(work_farm(job, task));
}

using SettingTexts = std::vector<std::pair<std::string, std::string>>;

/// Checks that a job has the picture of one render.
void check_same(const FarmOptions& options) {
  const Place place;
  const FarmPlan plan = plan_farm(place.script, place.job, options);
  CHECK(plan.width == 53);
  work_on_all(place.job, plan.tasks);
  const FarmMerge merged = merge_farm(place.job);
  CHECK(merged.complete());
  const FarmFrames frames = options.frames.value_or(FarmFrames{});
  CHECK(merged.frames.size() == static_cast<std::size_t>(frames.last - frames.first + 1));
  const std::string format = plan.has_channels ? "exr" : "png";
  for (int frame = frames.first; frame <= frames.last; ++frame) {
    std::string name = "scene";
    if (options.frames) name += "_000" + std::to_string(frame);
    const std::string file = content_of(place.job / (name + "." + format));
    CHECK(file == place.whole(options, frame, plan.passes, format.c_str()));
  }
}

}  // namespace

TEST_CASE("a merged picture has the bytes of the whole one, for every way to sample pixels") {
  const SettingTexts bell = {{"filter", "\"blackmanharris\""}, {"filterwidth", "5"}};
  const std::vector<SettingTexts> all = {
      {},
      {{"supersampling", "3"}},
      {{"targeterror", "0.02"}, {"maxsamples", "128"}},
      {{"targeterror", "0.001"}, {"minsamples", "4"}, {"maxsamples", "64"}},
      {{"timebudget", "0.02"}},
      {{"precision", "\"exact\""}},
  };
  for (const SettingTexts& settings : all) {
    for (const bool with_bell : {false, true}) {
      FarmOptions options{.tasks = 5};
      options.script.settings = settings;
      if (with_bell)
        options.script.settings.insert(options.script.settings.end(), bell.begin(), bell.end());
      check_same(options);
      options.tile_width = 7;
      options.tile_height = 11;
      check_same(options);
    }
  }
}

TEST_CASE("a merged film has the bytes of its frames, with channels and a number of passes") {
  FarmOptions options{.frames = FarmFrames{3, 6}, .tasks = 3};
  check_same(options);
  options.tasks = 11;
  options.render.passes = 37;
  options.render.seed = 5;
  options.render.aovs = {.depth = true, .normal = true, .samples = true};
  check_same(options);
  options.tasks = 1;
  options.render.aovs = {.id = true, .error = true};
  check_same(options);
}

TEST_CASE("a lens, whose statistics reach two pixels, makes no difference") {
  const Place place(
      "Settings { width -> 40 height -> 30 dofsamples -> 8 targeterror -> 0.02 maxsamples -> 64\n"
      "camera -> Camera { position -> vec3(0, 0, -5) pointing -> vec3(0, 0, 0) aperture -> 0.3\n"
      "focaldistance -> 3 } }\n"
      "Scene { Sphere { center -> vec3(0, 0, 0) radius -> 1 } }\n");
  const FarmOptions options{.tasks = 4, .tile_width = 9, .tile_height = 5};
  const FarmPlan plan = plan_farm(place.script, place.job, options);
  work_on_all(place.job, plan.tasks);
  CHECK(merge_farm(place.job).complete());
  CHECK(content_of(place.job / "scene.png") == place.whole(options, 0, 0, "png"));
}

TEST_CASE("there may be more tasks than there is to do") {
  const Place place("Settings { width -> 3 height -> 2 } Scene {}");
  const FarmOptions options{.tasks = 20};
  work_on_all(place.job, plan_farm(place.script, place.job, options).tasks);
  CHECK(merge_farm(place.job).complete());
  CHECK(content_of(place.job / "scene.png") == place.whole(options, 0, 0, "png"));
}

TEST_CASE("a task that is done is not done again, and its part has the same bytes anywhere") {
  const Place place;
  plan_farm(place.script, place.job, {.tasks = 2});
  CHECK(work_farm(place.job, 1, {.threads = 1}));
  CHECK_FALSE(work_farm(place.job, 1));
  const std::filesystem::path part = place.job / "parts/000001.part";
  const std::string first = content_of(part);
  std::filesystem::remove(part);
  CHECK(work_farm(place.job, 1, {.threads = 2}));
  CHECK(content_of(part) == first);
}

TEST_CASE("a part that is cut short or changed is refused by its name, and done again") {
  const Place place;
  plan_farm(place.script, place.job, {.tasks = 2});
  work_on_all(place.job, 2);
  const std::filesystem::path part = place.job / "parts/000001.part";
  const std::string whole = content_of(part);
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{70}, whole.size() / 2, whole.size() - 1}) {
    write_file(part, std::string_view(whole).substr(0, length));
    const FarmMerge merged = merge_farm(place.job);
    REQUIRE(merged.refused.size() == 1);
    CHECK(merged.refused[0].task == 1);
    CHECK(merged.refused[0].why.find("000001.part") != std::string::npos);
    CHECK(merged.frames.empty());
  }
  std::string changed = whole;
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
  write_file(part, changed);
  CHECK(merge_farm(place.job).refused.size() == 1);
  CHECK(work_farm(place.job, 1));
  CHECK(content_of(part) == whole);
  CHECK(merge_farm(place.job).complete());
}

TEST_CASE("a part of another plan or task is refused, and what is missing is named") {
  const Place place;
  plan_farm(place.script, place.job, {.tasks = 2});
  const std::filesystem::path other = place.folder / "other";
  FarmOptions options{.tasks = 2};
  options.render.seed = 9;
  plan_farm(place.script, other, options);
  work_on_all(other, 2);
  std::filesystem::copy(other / "parts/000000.part", place.job / "parts/000000.part");
  FarmMerge merged = merge_farm(place.job);
  CHECK(merged.refused.size() == 1);
  CHECK(merged.missing == std::vector<int>{1});
  work_farm(place.job, 1);
  std::filesystem::copy_file(place.job / "parts/000001.part", place.job / "parts/000000.part",
                             std::filesystem::copy_options::overwrite_existing);
  merged = merge_farm(place.job);
  CHECK(merged.refused.size() == 1);
  CHECK(work_farm(place.job, 0));
  CHECK(merge_farm(place.job).complete());
}

TEST_CASE("frames that are there are merged while others are missing") {
  const Place place;
  plan_farm(place.script, place.job, {.frames = FarmFrames{0, 7}, .tasks = 2});
  work_farm(place.job, 0);
  FarmMerge merged = merge_farm(place.job);
  CHECK(merged.missing == std::vector<int>{1});
  REQUIRE_FALSE(merged.frames.empty());
  CHECK(merged.frames.front() == 0);
  CHECK(merged.frames.back() < 7);
  const std::set<int> before(merged.frames.begin(), merged.frames.end());
  CHECK(merge_farm(place.job, {.skip = before}).frames.empty());
  work_farm(place.job, 1);
  merged = merge_farm(place.job, {.skip = before});
  CHECK(merged.complete());
  CHECK(merged.frames.size() == 8 - before.size());
}

TEST_CASE("a job has all files of its script, and notices if one is changed") {
  const Place place("import \"part.crt\"\nSettings { width -> size height -> 4 }\nScene {}\n");
  write_file(place.folder / "part.crt", "size = 6\n");
  CHECK(plan_farm(place.script, place.job, {.tasks = 1}).width == 6);
  std::filesystem::remove(place.folder / "part.crt");
  std::filesystem::remove(place.script);
  CHECK(work_farm(place.job, 0));
  std::filesystem::remove(place.job / "parts/000000.part");
  for (const auto& entry : std::filesystem::directory_iterator(place.job / "files"))
    write_file(entry.path(), "size = 7\n");
  CHECK_THROWS_WITH_AS(work_farm(place.job, 0), doctest::Contains("not what was planned"), Error);
}

TEST_CASE("a script of a job reads nothing but what is in the job") {
  const Place place("import \"../secret.crt\"\nScene {}\n");
  CHECK_THROWS_AS(plan_farm(place.script, place.job, {}), Error);
  FarmOptions outside;
  outside.script.allow_outside_files = true;
  CHECK_THROWS_AS(plan_farm(place.script, place.folder / "b", outside), Error);
}

TEST_CASE("a picture that is denoised is not cut into parts") {
  const Place place("Settings { denoise -> true }\nScene {}\n");
  CHECK_THROWS_WITH_AS(plan_farm(place.script, place.job, {}), doctest::Contains("denoise"), Error);
}

TEST_CASE("the status and the contact sheet show what is done") {
  const Place place;
  plan_farm(place.script, place.job, {.frames = FarmFrames{1, 4}, .tasks = 4});
  CHECK(farm_status(place.job).count(FarmTaskState::waiting) == 4);
  CHECK(farm_sheet(place.job).at(1, 1).a == 0);
  work_farm(place.job, 0);
  const FarmStatus status = farm_status(place.job);
  CHECK(status.count(FarmTaskState::done) == 1);
  CHECK(status.share() > 0);
  CHECK(status.share() < 1);
  CHECK(status.seconds_spent() > 0);
  const Image sheet = farm_sheet(place.job, 26);
  CHECK(sheet.width() == 52);
  CHECK(sheet.at(1, 1).a == 1);
  CHECK(sheet.at(51, 1).a == 0);
}

TEST_CASE("pipes and links in place of parts and logs stop nobody, and lead nowhere") {
  const Place place;
  const FarmPlan plan = plan_farm(place.script, place.job, {.tasks = 3});
  REQUIRE(plan.tasks == 3);
  const auto part = [&](int task) {
    return place.job / "parts" / ("00000" + std::to_string(task) + ".part");
  };
  const std::filesystem::path outside = place.folder / "outside";
  write_file(outside, "mine");
  REQUIRE(mkfifo(part(0).c_str(), 0600) == 0);
  REQUIRE(mkfifo((place.job / "log/000000.txt").c_str(), 0600) == 0);
  REQUIRE(mkfifo((place.job / "log/000001.txt").c_str(), 0600) == 0);
  std::filesystem::create_symlink(outside, part(2));
  for (const FarmTask& task : farm_status(place.job).tasks)
    CHECK(task.state == FarmTaskState::waiting);
  const FarmMerge merged = merge_farm(place.job);
  CHECK(merged.missing == std::vector<int>{1});
  CHECK(merged.refused.size() == 2);
  CHECK_THROWS_AS(work_farm(place.job, 0), Error);
  CHECK(work_farm(place.job, 1));
  CHECK_THROWS_AS(work_farm(place.job, 2), Error);
  CHECK(content_of(outside) == "mine");
  CHECK(farm_status(place.job).tasks[1].state == FarmTaskState::done);
  std::filesystem::remove(part(0));
  std::filesystem::remove(part(2));
  CHECK(work_farm(place.job, 0));
  CHECK(work_farm(place.job, 2));
  REQUIRE(mkfifo((place.job / "scene.png").c_str(), 0600) == 0);
  CHECK_THROWS_AS(merge_farm(place.job), Error);
}

TEST_CASE("a log shows no control characters") {
  const Place place;
  plan_farm(place.script, place.job, {.tasks = 1});
  write_file(place.job / "log/000000.txt", "\x1b[31mhost:1 0.5 0\n");
  const FarmTask task = farm_status(place.job).tasks[0];
  CHECK(task.state == FarmTaskState::running);
  CHECK(task.worker == "\uFFFD[31mhost:1");
}

TEST_CASE("nothing is planned where something is, and no task that is not there") {
  const Place place;
  plan_farm(place.script, place.job, {.tasks = 1});
  CHECK_THROWS_AS(plan_farm(place.script, place.job, {.tasks = 1}), Error);
  CHECK_THROWS_AS(work_farm(place.job, 1), Error);
  CHECK_THROWS_AS(work_farm(place.job, -1), Error);
  CHECK_THROWS_AS(merge_farm(place.folder / "nothing"), Error);
}
