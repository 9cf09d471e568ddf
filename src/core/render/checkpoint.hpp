// A checkpoint keeps a picture that is rendered pass by pass in a file, so that it can be continued
// another time.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string>

#include "core/render/passes.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

/// Says what is kept of pixels beside their colours.
struct KeptOfPixels {
  bool first_hits = false;
  bool guides = false;
};

/// Returns a number that distinguishes pictures. It is computed from the settings that continuing
/// takes, and from the light of some samples that belong to no pixel. Their rays are traced by
/// `rules`. Throws Error (cancelled) if the progress says so.
std::uint64_t fingerprint(const Frame& frame, const Region& region, const KeptOfPixels& kept,
                          Progress& progress, const StepRules& rules);

/// Makes a checkpoint of a picture of which nothing is known, unless there is a file. Any picture
/// can start from it. Throws Error (io).
void leave_empty_checkpoint(const std::filesystem::path& path);

class Checkpoint {
 public:
  /// `begin` is when the render began. All but the path must outlive the checkpoint.
  Checkpoint(std::filesystem::path path, std::uint64_t fingerprint, Passes& passes, Canvas& canvas,
             WorkspacePool& pool, const PassClock::Seconds& seconds, double begin);

  /// Continues from what is in the file, if there is one. It must be called before the first pass
  /// and before the other functions. Throws Error: io (the file cannot be read or is damaged),
  /// invalid_argument (it is of another picture).
  void take_up();

  /// Writes what is known. take_complaint() returns what prevented it. It may be called from any
  /// thread, at any time before Passes::finish().
  void keep() noexcept;
  /// Writes what is known if it is due.
  void keep_if_due() noexcept;

  /// Returns why nothing was written since this was last asked, or "" if nothing failed.
  std::string take_complaint();

 private:
  void read();
  void write() const;

  std::filesystem::path path_;
  std::uint64_t fingerprint_;
  Passes& passes_;
  Canvas& canvas_;
  WorkspacePool& pool_;
  const PassClock::Seconds& seconds_;
  std::atomic<double> next_;  ///< when it is due
  std::mutex writing_;
  std::mutex complaining_;
  std::string complaint_;
};

}  // namespace crt::core
