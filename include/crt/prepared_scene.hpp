#pragma once

#include <crt/scene.hpp>
#include <memory>

namespace crt {

namespace core {
class PreparedData;
}

/// A scene made ready for rays: checked, flattened and accelerated. Immutable; copies share, and any
/// number of threads may use it at once.
class PreparedScene {
 public:
  /// Internal: see prepare().
  explicit PreparedScene(std::shared_ptr<const core::PreparedData> data) : data_(std::move(data)) {}

  /// Internal: what rays see.
  const core::PreparedData& data() const { return *data_; }

 private:
  std::shared_ptr<const core::PreparedData> data_;
};

/// Checks the scene (throws Error naming what is wrong) and builds what rays need.
PreparedScene prepare(const Scene& scene);

}  // namespace crt
