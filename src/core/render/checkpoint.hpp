// A picture that is rendered pass by pass, kept in a file so that it can go on another time.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <string>

#include "core/render/passes.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

/// Tells pictures apart: a number from the settings that it takes to go on, and from the light of
/// some samples that belong to no pixel's own, whose rays go by `rules`. Throws Error (cancelled)
/// if the progress says so.
std::uint64_t fingerprint(const Frame& frame, const Region& region, bool with_first_hits,
                          Progress& progress, const StepRules& rules);

/// Of a picture that nothing is known of yet: leaves a checkpoint from which any picture goes on,
/// at its beginning, unless there is a file. Throws Error (io).
void leave_empty_checkpoint(const std::filesystem::path& path);

class Checkpoint {
 public:
  /// `begin` is when the render began. All but the path must outlive it.
  Checkpoint(std::filesystem::path path, std::uint64_t fingerprint, Passes& passes, Canvas& canvas,
             WorkspacePool& pool, const PassClock::Seconds& seconds, double begin);

  /// Takes up what is in the file, if there is one; before the first pass. From then on the rest
  /// can be called. Throws Error: io (the file cannot be read or is damaged), invalid_argument (it
  /// is of another picture).
  void take_up();

  /// Writes what is known. What hinders it can be asked for afterwards. From any thread, at any
  /// time before Passes::finish().
  void keep() noexcept;
  /// The same if it is time.
  void keep_if_due() noexcept;

  /// Why nothing was written, if so, since this was last asked; "" if there is nothing to complain
  /// of.
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
  std::atomic<double> next_;  ///< when it is time
  std::mutex writing_;
  std::mutex complaining_;
  std::string complaint_;
};

}  // namespace crt::core
