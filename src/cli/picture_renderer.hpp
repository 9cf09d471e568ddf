// This is the way from a script to a picture that `crt render` and `crt watch` have in common.
#pragma once

#include <chrono>
#include <crt/image.hpp>
#include <crt/scene.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cli/progress.hpp"
#include "cli/reporter.hpp"
#include "cli/script_source.hpp"

namespace crt::cli {

/// Runs a script. What it prints goes to standard output, or to standard error if standard output
/// has another use. There is no scene if the script is wrong, which is then reported. Throws Error
/// (cancelled) if the option go_on said so.
ScriptResult run_scene(const ScriptSource& script, const ScriptOptions& options,
                       bool output_is_free, Reporter& reporter);

/// A PictureTask says which picture is to be made of a scene.
struct PictureTask {
  const PictureRequest& request;
  std::filesystem::path picture;  ///< whose ending says the format
  std::string name;               ///< for messages
  ProgressStyle style = ProgressStyle::none;
  std::function<bool()> go_on;               ///< false gives it up
  std::function<void(Image)> in_progress{};  ///< takes the picture now and then, unless it is empty
};

/// Prepares and renders a scene, and loads what writing the picture needs meanwhile. Warnings are
/// reported. Throws Error: cancelled if go_on said so.
Image render_scene(const Scene& scene, const PictureTask& task, Reporter& reporter);

/// Returns what the user should know of how a picture was made: that many rays ended before they
/// had shown all. Returns nothing if all is well.
std::optional<std::string> warning_of(const Image& image);

/// Returns the line that reports a picture: its size, and the rays and seconds that it took.
std::string summary(const std::string& name, const Image& image);

/// Measures seconds from its making on.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace crt::cli
