// A scene keeps a workspace between queries, so that a query of a single ray need not make one.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "core/intersect/ray_workspace.hpp"

namespace crt::core {

/// A SpareWorkspace keeps one workspace that nobody uses. Any threads may take it and give one back
/// at the same time. Whoever finds none makes a new one, and of two that are given back one goes.
class SpareWorkspace {
 public:
  SpareWorkspace() = default;
  SpareWorkspace(const SpareWorkspace&) = delete;
  SpareWorkspace& operator=(const SpareWorkspace&) = delete;
  ~SpareWorkspace() { keep(nullptr); }

  std::unique_ptr<RayWorkspace> take() {
    std::unique_ptr<RayWorkspace> spare(spare_.exchange(nullptr, std::memory_order_acquire));
    return spare != nullptr ? std::move(spare) : std::make_unique<RayWorkspace>();
  }
  void keep(std::unique_ptr<RayWorkspace> workspace) {
    const std::unique_ptr<RayWorkspace> before(
        spare_.exchange(workspace.release(), std::memory_order_acq_rel));
  }

 private:
  std::atomic<RayWorkspace*> spare_ = nullptr;
};

}  // namespace crt::core
