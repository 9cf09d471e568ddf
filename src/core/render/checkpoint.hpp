// A picture that is rendered pass by pass, kept in a file so that it can go on another time.
#pragma once

#include <filesystem>

#include "core/render/passes.hpp"
#include "core/render/workspace.hpp"

namespace crt::core {

/// Tells pictures apart: a number from the settings that it takes to go on, and from the light of some
/// samples that belong to no pixel's own, whose rays go by `rules`.
std::uint64_t fingerprint(const Frame& frame, const Region& region, bool with_first_hits,
                          const StepRules& rules);

class Checkpoint {
 public:
  /// All but the path must outlive it.
  Checkpoint(std::filesystem::path path, std::uint64_t fingerprint, Passes& passes, Canvas& canvas,
             WorkspacePool& pool)
      : path_(std::move(path)), fingerprint_(fingerprint), passes_(passes), canvas_(canvas), pool_(pool) {}

  /// Takes up what is in the file, if there is one; before the first pass. Throws Error: io (the file cannot
  /// be read or is damaged), invalid_argument (it is of another picture).
  void take_up();

  /// Between passes. Throws Error (io).
  void keep() const;

 private:
  std::filesystem::path path_;
  std::uint64_t fingerprint_;
  Passes& passes_;
  Canvas& canvas_;
  WorkspacePool& pool_;
};

}  // namespace crt::core
