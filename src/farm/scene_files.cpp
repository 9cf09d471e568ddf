#include "farm/scene_files.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/sha256.hpp"
#include "core/base/whole_file.hpp"
#include "crt/file.hpp"
#include "text/format.hpp"

namespace crt::farm {

namespace {

namespace fs = std::filesystem;

/// Nothing can lie below this on any machine. So a script finds what is in its job and no more.
const char* const root = "/dev/null";
constexpr const char* script_folder_name = "scene";
constexpr const char* resources_name = "resources";
constexpr std::size_t most_bytes = std::size_t{1} << 32;

/// Returns a text in which files have their names in the script's folder.
std::string without_root(std::string text) {
  const std::string prefix = text::format("{}/{}/", root, script_folder_name);
  for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;)
    text.erase(at, prefix.size());
  return text;
}

std::string all_errors(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (diagnostic.severity == Severity::error) text += format_diagnostic(diagnostic);
  }
  while (text.ends_with('\n')) text.pop_back();
  return without_root(std::move(text));
}

}  // namespace

ScriptResult run_job_script(const Manifest& manifest, double t, const OpenSceneFile& open,
                            const std::function<bool()>& go_on) {
  ScriptOptions options{.t = t,
                        .variables = manifest.variables,
                        .settings = manifest.settings,
                        .compat = manifest.compat};
  options.limits.steps = manifest.max_steps;
  options.limits.image_pixels = manifest.max_image_pixels;
  for (int i = 0; i < manifest.resource_folders; ++i)
    options.resource_directories.push_back(fs::path(root) / resources_name / std::to_string(i));
  options.open_file = [&](const fs::path& path) -> std::optional<Content> {
    const fs::path name = path.lexically_relative(root);
    if (name.empty() || *name.begin() == "..") return std::nullopt;
    return open(name.string());
  };
  options.go_on = go_on;
  ScriptResult result = run_script_file(fs::path(root) / manifest.script, options);
  for (const Diagnostic& diagnostic : result.diagnostics) {
    if (diagnostic.code == ErrorCode::cancelled) throw Error(diagnostic.code, diagnostic.message);
  }
  if (!result.scene) throw Error(ErrorCode::script, all_errors(result.diagnostics));
  return result;
}

/// Returns where a file of the job lies on this machine, if that is where scripts may read.
std::optional<fs::path> FileCollector::place_of(const std::string& name) const {
  const fs::path path(name);
  auto part = path.begin();
  fs::path folder = script_folder_;
  if (part != path.end() && *part == resources_name) {
    if (++part == path.end()) return std::nullopt;
    const std::size_t index = std::stoul(part->string());
    if (index >= resources_.size()) return std::nullopt;
    folder = resources_[index];
  }
  if (part == path.end()) return std::nullopt;
  fs::path rest;
  for (++part; part != path.end(); ++part) rest /= *part;
  std::error_code failed;
  const fs::path inside = fs::canonical(folder.empty() ? fs::path(".") : folder, failed);
  if (failed) return std::nullopt;
  const fs::path place = fs::canonical(inside / rest, failed);
  if (failed || !fs::is_regular_file(place, failed)) return std::nullopt;
  // A link may lead out of the folder.
  const auto is_in = [&](const fs::path& candidate) {
    const fs::path real = fs::canonical(candidate.empty() ? fs::path(".") : candidate, failed);
    return !failed &&
           std::mismatch(real.begin(), real.end(), place.begin(), place.end()).first == real.end();
  };
  if (!is_in(script_folder_) && std::none_of(resources_.begin(), resources_.end(), is_in))
    return std::nullopt;
  return place;
}

std::optional<Content> FileCollector::open(const std::string& name) {
  if (const auto known = hashes_.find(name); known != hashes_.end())
    return core::read_whole_file(job_.content_file(known->second), most_bytes);
  const std::optional<fs::path> place = place_of(name);
  if (!place) return std::nullopt;
  Content content = core::read_whole_file(*place, most_bytes);
  const std::string hash = core::sha256(content);
  hashes_[name] = hash;
  write_file(job_.content_file(hash), content);
  return content;
}

std::optional<Content> open_job_file(const Job& job, const std::string& name) {
  const auto known = job.manifest.files.find(name);
  if (known == job.manifest.files.end()) return std::nullopt;
  Content content = core::read_whole_file(job.content_file(known->second), most_bytes);
  if (core::sha256(content) != known->second) {
    throw Error(ErrorCode::io,
                text::format("'{}' is not what was planned: copy the job's folder again",
                             job.content_file(known->second).string()));
  }
  return content;
}

}  // namespace crt::farm
