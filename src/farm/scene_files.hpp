// The script of a job and the files that it reads have names of their own, which say nothing of
// where they were: scene/NAME in the script's folder, resources/0/NAME in the first resource
// folder.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "farm/manifest.hpp"

namespace crt::farm {

using Content = std::vector<std::byte>;

/// An OpenSceneFile returns the content of a file by its name in the job, or nothing if there is
/// none.
using OpenSceneFile = std::function<std::optional<Content>(const std::string& name)>;

/// Runs the script of a job for a time. It sees the files of `open` and nothing of this machine.
/// `options` says what beside the manifest's texts is for the script. Throws Error (script) with
/// all diagnostics as its message.
ScriptResult run_job_script(const Manifest& manifest, double t, const OpenSceneFile& open,
                            const std::function<bool()>& go_on);

/// A FileCollector copies files into a job as scripts ask for them.
class FileCollector {
 public:
  /// `resources` are the folders of the caller.
  FileCollector(std::filesystem::path script_folder, std::vector<std::filesystem::path> resources,
                const Job& job)
      : script_folder_(std::move(script_folder)), resources_(std::move(resources)), job_(job) {}

  /// Returns the content of a file, and keeps it. Throws Error (io, limit).
  std::optional<Content> open(const std::string& name);

  const std::map<std::string, std::string>& hashes() const { return hashes_; }

 private:
  std::optional<std::filesystem::path> place_of(const std::string& name) const;

  std::filesystem::path script_folder_;
  std::vector<std::filesystem::path> resources_;
  const Job& job_;
  std::map<std::string, std::string> hashes_;
};

/// Returns the content of a file of a job. Throws Error (io) if it is not the one that was planned.
std::optional<Content> open_job_file(const Job& job, const std::string& name);

}  // namespace crt::farm
