#include "core/render/workspace.hpp"

namespace crt::core {

namespace {

void add_counts(WorkspacePool::Counts& total, const Workspace& workspace) {
  const RenderStats& part = workspace.stats;
  for (const auto count : summed_counts) total.stats.*count += part.*count;
  total.stats.intersection_tests += workspace.rays.intersection_tests;
  total.stats.interval_events += workspace.rays.interval_events();
  total.stats.escalations += workspace.rays.escalations();
  total.stats.undecided += workspace.rays.undecided();
  total.cutoff.add(workspace.cutoff);
}

/// Adds what a workspace has counted, and resets its counts.
void move_counts(WorkspacePool::Counts& total, Workspace& workspace) {
  add_counts(total, workspace);
  workspace.stats = {};
  workspace.cutoff = {};
  RayWorkspace& rays = workspace.rays;
  rays.intersection_tests = rays.leaf_escalations = rays.csg.events = rays.csg.escalations = 0;
  rays.forget_undecided();
}

}  // namespace

WorkspacePool::Counts WorkspacePool::total() const {
  Counts total = settled_;
  for (const std::unique_ptr<Workspace>& workspace : all_) add_counts(total, *workspace);
  return total;
}

void WorkspacePool::set_total(const Counts& counts) {
  settled_ = counts;
  all_.clear();
  idle_.clear();
}

void WorkspacePool::settle(Workspace& workspace) {
  const std::lock_guard lock(mutex_);
  move_counts(settled_, workspace);
}

void WorkspacePool::settle_all() {
  for (const std::unique_ptr<Workspace>& workspace : all_) move_counts(settled_, *workspace);
}

WorkspacePool::Counts WorkspacePool::settled() const {
  const std::lock_guard lock(mutex_);
  return settled_;
}

Workspace* WorkspacePool::take() {
  const std::lock_guard lock(mutex_);
  if (idle_.empty()) {
    all_.push_back(std::make_unique<Workspace>());
    all_.back()->rays.csg.steps.rules = &rules_;
    idle_.reserve(all_.size());  // so that giving back never allocates
    return all_.back().get();
  }
  Workspace* workspace = idle_.back();
  idle_.pop_back();
  return workspace;
}

void WorkspacePool::give_back(Workspace* workspace) {
  const std::lock_guard lock(mutex_);
  idle_.push_back(workspace);
}

}  // namespace crt::core
