#include "farm/manifest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "core/base/sha256.hpp"
#include "core/base/whole_file.hpp"
#include "text/format.hpp"
#include "text/json.hpp"

namespace crt::farm {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int format_version = 1;
constexpr std::size_t max_manifest_bytes = std::size_t{32} << 20;
/// Pieces are the deepest: lists in lists of objects in a list. As many bytes have fewer values.
constexpr text::JsonLimits manifest_limits{.depth = 6, .values = max_manifest_bytes};

constexpr std::pair<const char*, bool Aovs::*> aov_names[] = {
    {"depth", &Aovs::depth}, {"normal", &Aovs::normal}, {"id", &Aovs::id},
    {"part", &Aovs::part},   {"albedo", &Aovs::albedo}, {"samples", &Aovs::samples},
    {"error", &Aovs::error},
};

[[noreturn]] void fail(const std::string& why) {
  throw Error(ErrorCode::io, text::format("this is no manifest of a job: {}", why));
}

Json to_json(const Task& task) {
  Json pieces = Json::array();
  for (const auto& [frame, region] : task.pieces)
    pieces.push_back({frame, region.x, region.y, region.width, region.height});
  return {{"seconds", task.seconds}, {"pieces", std::move(pieces)}};
}

/// Returns a member of an object, which must be there.
const Json& member(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) fail(text::format("there is no '{}'", name));
  return object.at(name);
}

template <class Number>
Number whole(const Json& value, const char* name, Number least,
             Number most = std::numeric_limits<Number>::max()) {
  if (value.is_number_unsigned()) {
    const auto given = value.get<std::uint64_t>();
    const bool is_large_enough = least <= 0 || given >= static_cast<std::uint64_t>(least);
    if (is_large_enough && given <= static_cast<std::uint64_t>(most))
      return static_cast<Number>(given);
  } else if (value.is_number_integer()) {  // which is negative
    const auto given = value.get<std::int64_t>();
    if (std::is_signed_v<Number> && given >= static_cast<std::int64_t>(least))
      return static_cast<Number>(given);
  }
  fail(text::format("'{}' must be a whole number from {} to {}", name, least, most));
}

template <class Number>
Number whole_member(const Json& object, const char* name, Number least,
                    Number most = std::numeric_limits<Number>::max()) {
  return whole(member(object, name), name, least, most);
}

double number(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
  fail(text::format("'{}' must be a number", name));
}

std::string text(const Json& value, const char* name) {
  if (!value.is_string()) fail(text::format("'{}' must be a text", name));
  return value.get<std::string>();
}

/// Returns a name that leads nowhere but below the folder that it is looked up in.
std::string inner_path(const std::string& name) {
  const fs::path path(name);
  const bool leads_out = name.empty() || name.find('\0') != std::string::npos ||
                         path.is_absolute() || path.lexically_normal().string() != name ||
                         std::find(path.begin(), path.end(), "..") != path.end();
  if (leads_out) fail(text::format("'{}' is not the path of a file in the job", name));
  return name;
}

std::string hash(const Json& value) {
  std::string digits = text(value, "files");
  const bool is_hash =
      digits.size() == 64 && digits.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!is_hash) fail("the hash of a file has 64 hexadecimal digits");
  return digits;
}

std::vector<std::pair<std::string, std::string>> pairs(const Json& object, const char* name) {
  const Json& list = member(object, name);
  if (!list.is_array()) fail(text::format("'{}' must be a list", name));
  std::vector<std::pair<std::string, std::string>> result;
  for (const Json& pair : list) {
    if (!pair.is_array() || pair.size() != 2) fail(text::format("'{}' must have pairs", name));
    result.emplace_back(text(pair[0], name), text(pair[1], name));
  }
  return result;
}

Piece piece(const Json& numbers, const Manifest& manifest) {
  if (!numbers.is_array() || numbers.size() != 5) fail("a piece has five numbers");
  const FarmFrames frames = frames_of(manifest);
  Piece piece;
  piece.frame = whole(numbers[0], "frame", frames.first, frames.last);
  piece.region.x = whole(numbers[1], "x", 0, manifest.width - 1);
  piece.region.y = whole(numbers[2], "y", 0, manifest.height - 1);
  piece.region.width = whole(numbers[3], "width", 1, manifest.width - piece.region.x);
  piece.region.height = whole(numbers[4], "height", 1, manifest.height - piece.region.y);
  return piece;
}

/// Makes sure that the pieces of each frame have as many pixels as it has. Merging finds those that
/// lie on one another.
void check_frames(const Manifest& manifest) {
  const FarmFrames frames = frames_of(manifest);
  const std::int64_t pixels = std::int64_t{manifest.width} * manifest.height;
  std::vector<std::int64_t> missing(static_cast<std::size_t>(frames.last - frames.first) + 1,
                                    pixels);
  for (const Task& task : manifest.tasks) {
    for (const auto& [frame, region] : task.pieces) {
      std::int64_t& left = missing[static_cast<std::size_t>(frame - frames.first)];
      left -= std::int64_t{region.width} * region.height;
      if (left < 0) fail(text::format("pieces of frame {} lie on one another", frame));
    }
  }
  for (const std::int64_t left : missing) {
    if (left != 0) fail("a frame lacks pieces");
  }
}

void read_tasks(const Json& list, Manifest& manifest) {
  if (!list.is_array() || list.empty() || list.size() > std::size_t{max_tasks})
    fail(text::format("there must be 1 to {} tasks", max_tasks));
  manifest.tasks.reserve(list.size());
  for (const Json& given : list) {
    Task& task = manifest.tasks.emplace_back();
    task.seconds = number(given, "seconds");
    if (task.seconds < 0) fail("'seconds' must not be negative");
    const Json& pieces = member(given, "pieces");
    if (!pieces.is_array()) fail("'pieces' must be a list");
    task.pieces.reserve(pieces.size());
    for (const Json& numbers : pieces) task.pieces.push_back(piece(numbers, manifest));
  }
  check_frames(manifest);
}

void read_picture(const Json& object, Manifest& manifest) {
  constexpr int max_side = 65536;
  manifest.width = whole_member(object, "width", 1, max_side);
  manifest.height = whole_member(object, "height", 1, max_side);
  if (std::int64_t{manifest.width} * manifest.height > (std::int64_t{1} << 27))
    fail("a picture has at most 2^27 pixels");
  if (object.contains("seed")) manifest.seed = whole_member<std::uint64_t>(object, "seed", 0);
  manifest.passes = whole_member(object, "passes", 0);
  manifest.max_ray_steps = whole_member<std::uint64_t>(object, "max_ray_steps", 0);
  manifest.max_primitives = whole_member<std::uint64_t>(object, "max_primitives", 0);
  const Json& aovs = member(object, "aovs");
  if (!aovs.is_array()) fail("'aovs' must be a list");
  for (const Json& given : aovs) {
    const std::string name = text(given, "aovs");
    const auto* const known = std::find_if(std::begin(aov_names), std::end(aov_names),
                                           [&](const auto& aov) { return aov.first == name; });
    if (known == std::end(aov_names)) fail(text::format("there are no aovs '{}'", name));
    manifest.aovs.*known->second = true;
  }
}

Manifest read(const Json& object) {
  if (whole_member(object, "crt_farm", 0) != format_version)
    fail("it is of another version of CRT");
  Manifest manifest;
  manifest.script = inner_path(text(member(object, "script"), "script"));
  const Json& files = member(object, "files");
  if (!files.is_object()) fail("'files' must be an object");
  for (const auto& [name, digits] : files.items())
    manifest.files.emplace(inner_path(name), hash(digits));
  constexpr int max_folders = 1000;
  manifest.resource_folders = whole_member(object, "resource_folders", 0, max_folders);
  manifest.t = number(object, "t");
  manifest.variables = pairs(object, "variables");
  manifest.settings = pairs(object, "settings");
  manifest.compat = whole_member(object, "compat", 0);
  manifest.max_steps = whole_member<std::uint64_t>(object, "max_steps", 0);
  if (object.contains("max_image_pixels")) {
    manifest.max_image_pixels = whole_member<std::uint64_t>(object, "max_image_pixels", 0);
  }
  if (object.contains("frames")) {
    const Json& frames = object.at("frames");
    if (!frames.is_array() || frames.size() != 2) fail("'frames' must have two numbers");
    constexpr int most = std::numeric_limits<int>::max() - max_frames;
    manifest.frames = {.first = whole(frames[0], "frames", -most, most), .last = 0};
    manifest.frames->last =
        whole(frames[1], "frames", manifest.frames->first, manifest.frames->first + max_frames - 1);
  }
  read_picture(object, manifest);
  read_tasks(member(object, "tasks"), manifest);
  return manifest;
}

}  // namespace

std::string to_text(const Manifest& manifest) {
  Json object = {{"crt_farm", format_version},
                 {"script", manifest.script},
                 {"files", manifest.files},
                 {"resource_folders", manifest.resource_folders},
                 {"t", manifest.t},
                 {"variables", manifest.variables},
                 {"settings", manifest.settings},
                 {"compat", manifest.compat},
                 {"max_steps", manifest.max_steps},
                 {"width", manifest.width},
                 {"height", manifest.height},
                 {"passes", manifest.passes},
                 {"max_ray_steps", manifest.max_ray_steps},
                 {"max_primitives", manifest.max_primitives}};
  // An empty list of pairs is a list, too.
  if (manifest.variables.empty()) object["variables"] = Json::array();
  if (manifest.settings.empty()) object["settings"] = Json::array();
  if (manifest.files.empty()) object["files"] = Json::object();
  if (manifest.frames) object["frames"] = {manifest.frames->first, manifest.frames->last};
  if (manifest.seed) object["seed"] = *manifest.seed;
  if (manifest.max_image_pixels > 0) object["max_image_pixels"] = manifest.max_image_pixels;
  object["aovs"] = Json::array();
  for (const auto& [name, asked] : aov_names) {
    if (manifest.aovs.*asked) object["aovs"].push_back(name);
  }
  object["tasks"] = Json::array();
  for (const Task& task : manifest.tasks) object["tasks"].push_back(to_json(task));
  try {
    return object.dump() + "\n";
  } catch (const Json::exception&) {
    throw Error(ErrorCode::invalid_argument, "a job's names and expressions must be UTF-8");
  }
}

Manifest parse_manifest(std::string_view text) {
  if (text.size() > max_manifest_bytes) fail("it is too long");
  try {
    return read(text::parse_json(text, manifest_limits));
  } catch (const text::JsonError& error) {
    fail(error.what());
  } catch (const Json::exception& error) {
    fail(error.what());
  }
}

fs::path Job::part_file(int task) const {
  return folder / parts_folder / text::format("{:06}.part", task);
}
fs::path Job::log_file(int task) const {
  return folder / log_folder / text::format("{:06}.txt", task);
}
fs::path Job::content_file(const std::string& hash) const {
  return folder / contents_folder / hash;
}

Job open_job(const fs::path& folder) {
  const std::vector<std::byte> bytes =
      core::read_whole_file(folder / manifest_name, max_manifest_bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    return {.folder = folder, .id = core::sha256(bytes), .manifest = parse_manifest(text)};
  } catch (const Error& error) {
    throw Error(error.code(),
                text::format("'{}': {}", (folder / manifest_name).string(), error.what()));
  }
}

FarmPlan plan_of(const Job& job) {
  const Manifest& manifest = job.manifest;
  FarmPlan plan{.id = job.id,
                .tasks = static_cast<int>(manifest.tasks.size()),
                .frames = manifest.frames,
                .width = manifest.width,
                .height = manifest.height,
                .passes = manifest.passes,
                .picture_name = fs::path(manifest.script).stem().string(),
                .has_channels = manifest.aovs != Aovs{}};
  for (const Task& task : manifest.tasks) {
    plan.seconds += task.seconds;
    plan.longest_seconds = std::max(plan.longest_seconds, task.seconds);
  }
  return plan;
}

}  // namespace crt::farm

namespace crt {

FarmPlan read_farm_plan(const std::filesystem::path& job) {
  return farm::plan_of(farm::open_job(job));
}

}  // namespace crt
