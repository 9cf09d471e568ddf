#pragma once

#include <crt/scene.hpp>
#include <crt/stats.hpp>
#include <cstdint>
#include <functional>
#include <memory>

namespace crt {

namespace core {
class PreparedData;
}

/// A scene made ready for rays: checked, flattened and accelerated. Immutable; copies share, and
/// any number of threads may use it at once.
class PreparedScene {
 public:
  /// Internal: see prepare().
  explicit PreparedScene(std::shared_ptr<const core::PreparedData> data) : data_(std::move(data)) {}

  /// What it takes of memory. Scenes that were prepared from one another share some of it; each
  /// counts all.
  MemoryUse memory() const;

  /// Internal: what rays see.
  const core::PreparedData& data() const { return *data_; }
  /// Internal: the same, without holding on to it.
  std::weak_ptr<const core::PreparedData> watched_data() const { return data_; }

 private:
  std::shared_ptr<const core::PreparedData> data_;
};

/// Checks the scene (throws Error naming what is wrong) and builds what rays need.
PreparedScene prepare(const Scene& scene);

/// The same for a scene that was prepared before and edited since. As long as its entities are the
/// same (copies of one another, in the same order) and Settings::precision is, what rays meet is
/// not built again: a new camera, light, background or other setting costs next to nothing. The
/// picture is the same either way.
PreparedScene prepare(const Scene& scene, const PreparedScene& earlier);

/// What preparing may be asked beyond that.
struct PrepareOptions {
  /// What was prepared earlier, as above, or null. Only looked at while prepare() runs.
  const PreparedScene* earlier = nullptr;
  /// Asked some tens of times a second, from one thread at a time, which may be any of those that
  /// work; returning false ends it, within 0.1 s in scenes of up to a million primitives, with
  /// Error (cancelled).
  std::function<bool()> go_on{};
  /// The most primitives that the scene may have; with more preparing it ends with Error (limit)
  /// before it takes any memory. 0 is as many as the memory of the machine (or container) may be
  /// enough for, at 1350 bytes each and 2700 in the exact tier, which is what the greedy ones take:
  /// spheres by themselves take 600. More than 33554432 there can never be.
  std::uint64_t max_primitives = 0;
};

/// The same with these. Throws Error: cancelled, limit (max_primitives), out_of_memory and those of
/// prepare().
PreparedScene prepare(const Scene& scene, const PrepareOptions& options);

}  // namespace crt
