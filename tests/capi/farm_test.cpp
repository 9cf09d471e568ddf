// Jobs are planned, worked on and merged through the C interface.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <vector>

#include "support.hpp"
#include "support/temporary_directory.hpp"

using namespace crt::test;

namespace {

const char* const scene_text = R"(Settings { width -> 31 height -> 23 targeterror -> 0.05
  lights -> [PointLight { origin -> vec3(3, 5, -9) color -> rgb(1, 1, 1) }] }
Scene { Sphere { center -> vec3(t / 4, 0, 2) radius -> size } }
)";

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A Place has a script, what it gets, and the path of a job.
struct Place {
  TemporaryDirectory folder;
  std::string script = (folder / "scene.crt").string();
  std::string job = (folder / "job").string();
  const char* name = "size";
  const char* value = "0.7";
  crt_script_options script_options;
  crt_render_options render_options;
  crt_farm_options options;

  explicit Place(const std::string& text = std::string("size = 1\n") + scene_text) {
    std::ofstream(script) << text;
    REQUIRE(crt_script_options_init(&script_options, sizeof script_options) == CRT_OK);
    REQUIRE(crt_render_options_init(&render_options, sizeof render_options) == CRT_OK);
    REQUIRE(crt_farm_options_init(&options, sizeof options) == CRT_OK);
    script_options.variable_names = &name;
    script_options.variable_values = &value;
    script_options.variable_count = 1;
    options.script = &script_options;
    options.render = &render_options;
  }

  crt_farm_job plan() const {
    crt_farm_job planned;
    planned.struct_size = sizeof planned;
    const crt_status status = crt_farm_plan(script.c_str(), job.c_str(), &options, &planned);
    INFO(message());
    REQUIRE(status == CRT_OK);
    return planned;
  }

  /// Renders a frame in one piece, and returns its file.
  std::string whole(double t, const char* format) const {
    crt_script_options at = script_options;
    at.t = t;
    const SceneHandle scene = made<SceneHandle>([&](crt_scene** out) {
      return crt_scene_from_script_file(script.c_str(), &at, nullptr, out);
    });
    const ImageHandle image = render(prepare(scene.get()).get(), &render_options);
    crt_write_options how;
    crt_write_options_init(&how, sizeof how);
    how.reproducible = 1;
    const BufferHandle bytes = made<BufferHandle>(
        [&](crt_buffer** out) { return crt_image_encode(image.get(), format, &how, out); });
    return {static_cast<const char*>(crt_buffer_data(bytes.get())), crt_buffer_size(bytes.get())};
  }
};

struct Report {
  std::int32_t kind;
  std::int32_t number;
  std::string why;
};

void keep_report(std::int32_t kind, std::int32_t number, const char* why, void* user) {
  static_cast<std::vector<Report>*>(user)->push_back({kind, number, why});
}

void work_on(const Place& place, std::int32_t task) {
  CHECK(crt_farm_work(place.job.c_str(), task, nullptr, nullptr) == CRT_OK);
}

}  // namespace

TEST_CASE("a job that is planned, worked on and merged has the bytes of one render") {
  Place place;
  place.options.tasks = 3;
  place.render_options.aovs = CRT_AOV_DEPTH;
  const crt_farm_job planned = place.plan();
  CHECK(planned.tasks == 3);
  CHECK(planned.width == 31);
  CHECK(planned.height == 23);
  CHECK(planned.has_frames == 0);
  CHECK(planned.has_channels == 1);
  CHECK(planned.seconds >= planned.longest_seconds);
  CHECK(planned.longest_seconds > 0);
  for (std::int32_t task = 0; task < 3; ++task) work_on(place, task);
  std::int32_t complete = 0;
  REQUIRE(crt_farm_merge(place.job.c_str(), nullptr, &complete) == CRT_OK);
  CHECK(complete == 1);
  CHECK(content_of(place.job + "/scene.exr") == place.whole(0, "exr"));
}

TEST_CASE("frames go where the caller wants them, and those that were merged may be left out") {
  Place place;
  place.options.has_frames = 1;
  place.options.first_frame = -1;
  place.options.last_frame = 2;
  place.options.tasks = 4;
  const crt_farm_job planned = place.plan();
  CHECK(planned.has_frames == 1);
  CHECK(planned.first_frame == -1);
  CHECK(planned.last_frame == 2);
  for (std::int32_t task = 0; task < planned.tasks; ++task) work_on(place, task);
  crt_farm_merge_options options;
  REQUIRE(crt_farm_merge_options_init(&options, sizeof options) == CRT_OK);
  const std::string output = (place.folder / "film_##.png").string();
  const std::int32_t skip[] = {0, 1};
  std::vector<Report> reports;
  options.output = output.c_str();
  options.skip = skip;
  options.skip_count = 2;
  options.report = keep_report;
  options.report_user = &reports;
  REQUIRE(crt_farm_merge(place.job.c_str(), &options, nullptr) == CRT_OK);
  CHECK(reports.size() == 2);
  for (const Report& report : reports) CHECK(report.kind == CRT_FARM_REPORT_WRITTEN);
  CHECK(content_of(place.folder / "film_-1.png") == place.whole(-1, "png"));
  CHECK(content_of(place.folder / "film_02.png") == place.whole(2, "png"));
  CHECK_FALSE(std::filesystem::exists(place.folder / "film_00.png"));
}

TEST_CASE("what is missing or damaged is reported, and status says how far tasks are") {
  Place place;
  place.options.tasks = 3;
  place.plan();
  work_on(place, 0);
  work_on(place, 1);
  std::filesystem::resize_file(place.job + "/parts/000001.part", 9);
  crt_farm_progress progress;
  progress.struct_size = sizeof progress;
  REQUIRE(crt_farm_status(place.job.c_str(), &progress) == CRT_OK);
  CHECK(progress.done + progress.waiting + progress.running + progress.lost == 3);
  CHECK(progress.done >= 1);
  CHECK(progress.share > 0);
  CHECK(progress.share < 1);
  CHECK(progress.seconds_left > 0);
  crt_farm_task tasks[2] = {};
  std::size_t count = 0;
  REQUIRE(crt_farm_tasks(place.job.c_str(), tasks, 1, &count) == CRT_OK);
  CHECK(count == 3);
  CHECK(tasks[0].state == CRT_FARM_TASK_DONE);
  CHECK(tasks[0].share == 1);
  CHECK(tasks[0].estimated > 0);
  CHECK(std::string(tasks[0].worker).find(':') != std::string::npos);
  CHECK(tasks[1].estimated == 0);  // was not written

  std::vector<Report> reports;
  crt_farm_merge_options options;
  REQUIRE(crt_farm_merge_options_init(&options, sizeof options) == CRT_OK);
  options.report = keep_report;
  options.report_user = &reports;
  std::int32_t complete = 7;
  REQUIRE(crt_farm_merge(place.job.c_str(), &options, &complete) == CRT_OK);
  CHECK(complete == 0);
  REQUIRE(reports.size() == 2);
  CHECK(reports[0].kind == CRT_FARM_REPORT_MISSING);
  CHECK(reports[0].number == 2);
  CHECK(reports[1].kind == CRT_FARM_REPORT_REFUSED);
  CHECK(reports[1].number == 1);
  CHECK(reports[1].why.find("000001.part") != std::string::npos);

  const ImageHandle sheet = made<ImageHandle>(
      [&](crt_image** out) { return crt_farm_sheet(place.job.c_str(), 20, out); });
  CHECK(crt_image_width(sheet.get()) == 20);
  std::int32_t rendered = 7;
  REQUIRE(crt_farm_work(place.job.c_str(), 0, nullptr, &rendered) == CRT_OK);
  CHECK(rendered == 0);
  REQUIRE(crt_farm_work(place.job.c_str(), 1, nullptr, &rendered) == CRT_OK);
  CHECK(rendered == 1);
}

TEST_CASE("what is planned can be read, as far as the caller's struct goes") {
  Place place;
  place.options.tasks = 2;
  place.plan();
  crt_farm_job planned;
  std::memset(&planned, 0x5a, sizeof planned);
  planned.struct_size = offsetof(crt_farm_job, height);
  REQUIRE(crt_farm_read_plan(place.job.c_str(), &planned) == CRT_OK);
  CHECK(planned.tasks == 2);
  CHECK(planned.width == 31);
  CHECK(planned.height == 0x5a5a5a5a);
}

TEST_CASE("planning, working and merging are cancelled, and the number is handed back") {
  Place place;
  place.options.tasks = 2;
  place.render_options.progress = [](double, void*) { return 21; };
  crt_farm_job planned;
  planned.struct_size = sizeof planned;
  CHECK(crt_farm_plan(place.script.c_str(), place.job.c_str(), &place.options, &planned) ==
        CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 21);
  place.render_options.progress = nullptr;
  place.plan();
  crt_farm_work_options work;
  REQUIRE(crt_farm_work_options_init(&work, sizeof work) == CRT_OK);
  work.progress = [](double, void*) { return 22; };
  std::int32_t rendered = 7;
  CHECK(crt_farm_work(place.job.c_str(), 0, &work, &rendered) == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 22);
  CHECK(rendered == 7);
  double last = -1;
  work.progress_user = &last;
  work.threads = 1;
  work.progress = [](double share, void* user) {
    double& before = *static_cast<double*>(user);
    const bool is_good = share >= before && share <= 1;
    before = share;
    return is_good ? 0 : 5;
  };
  CHECK(crt_farm_work(place.job.c_str(), 0, &work, &rendered) == CRT_OK);
  CHECK(last == 1);
  crt_farm_merge_options merge;
  REQUIRE(crt_farm_merge_options_init(&merge, sizeof merge) == CRT_OK);
  merge.poll = [](void*) { return 23; };
  CHECK(crt_farm_merge(place.job.c_str(), &merge, nullptr) == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 23);
}

TEST_CASE("what a job cannot have is refused by its name, and a wrong script with its place") {
  Place place;
  crt_farm_job planned;
  planned.struct_size = sizeof planned;
  const auto plan = [&] {
    return crt_farm_plan(place.script.c_str(), place.job.c_str(), &place.options, &planned);
  };
  const auto check = [&](const char* what, const std::function<void(Place&)>& spoil) {
    Place spoiled;
    spoil(spoiled);
    INFO(what);
    CHECK(crt_farm_plan(spoiled.script.c_str(), spoiled.job.c_str(), &spoiled.options, &planned) ==
          CRT_ERROR_INVALID_ARGUMENT);
    INFO(message());
    CHECK(says(what));
    CHECK_FALSE(std::filesystem::exists(spoiled.job));
  };
  check("tasks", [](Place& p) { p.options.tasks = -1; });
  check("tile", [](Place& p) { p.options.tile_width = 5; });
  check("least seconds", [](Place& p) { p.options.least_seconds = not_a_number; });
  check("frames", [](Place& p) {
    p.options.has_frames = 1;
    p.options.first_frame = std::numeric_limits<std::int32_t>::min();
  });
  check("whole pictures", [](Place& p) { p.render_options.region_width = 5; });
  check("checkpoint", [](Place& p) { p.render_options.checkpoint = "a"; });
  check("own folder", [](Place& p) { p.script_options.allow_outside_files = 1; });
  check("open_file", [](Place& p) {
    p.script_options.open_file = [](const char*, crt_file_content*, void*) -> int { return 1; };
  });
  check("options has a struct_size of 0", [](Place& p) { p.render_options.struct_size = 0; });
  check("aovs", [](Place& p) { p.render_options.aovs = 1u << 30; });
  place.value = "(";
  CHECK(plan() == CRT_ERROR_SCRIPT);
  std::ofstream(place.script) << "size = 1\nScene { Spere { } }\n";
  place.value = "1";
  CHECK(plan() == CRT_ERROR_SCRIPT);
  INFO(message());
  CHECK(says("2:9"));
  CHECK(std::filesystem::is_empty(place.job));
}

TEST_CASE("a path without a job is an error of files for all that read it") {
  crt_farm_job planned;
  planned.struct_size = sizeof planned;
  crt_farm_progress progress;
  progress.struct_size = sizeof progress;
  std::size_t count = 9;
  crt_image* image = nullptr;
  const TemporaryDirectory folder;
  for (const std::string& job : {std::string(), folder.path().string(), std::string(9000, 'x'),
                                 std::string("/dev/null/job"), std::string("\xff")}) {
    INFO(job);
    CHECK(crt_farm_read_plan(job.c_str(), &planned) == CRT_ERROR_IO);
    CHECK(crt_farm_work(job.c_str(), 0, nullptr, nullptr) == CRT_ERROR_IO);
    CHECK(crt_farm_merge(job.c_str(), nullptr, nullptr) == CRT_ERROR_IO);
    CHECK(crt_farm_status(job.c_str(), &progress) == CRT_ERROR_IO);
    CHECK(crt_farm_tasks(job.c_str(), nullptr, 0, &count) == CRT_ERROR_IO);
    CHECK(crt_farm_sheet(job.c_str(), 9, &image) == CRT_ERROR_IO);
  }
  CHECK(count == 9);
  CHECK(image == nullptr);
  for (const std::string& job : {std::string(9000, 'x'), std::string("/dev/null/job")})
    CHECK(crt_farm_plan("no.crt", job.c_str(), nullptr, &planned) == CRT_ERROR_IO);
}
