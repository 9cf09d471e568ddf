#include "core/render/workspace.hpp"

namespace crt::core {

namespace {

void add_counts(RenderStats& total, const Workspace& workspace) {
  const RenderStats& part = workspace.stats;
  for (const auto count : summed_counts) total.*count += part.*count;
  total.intersection_tests += workspace.rays.intersection_tests;
  total.interval_events += workspace.rays.interval_events();
  total.escalations += workspace.rays.escalations();
}

}  // namespace

RenderStats WorkspacePool::total_stats() const {
  RenderStats total = stats_before_;
  for (const std::unique_ptr<Workspace>& workspace : all_) add_counts(total, *workspace);
  return total;
}

CutoffSum WorkspacePool::total_cutoff() const {
  CutoffSum total = cutoff_before_;
  for (const std::unique_ptr<Workspace>& workspace : all_) total.add(workspace->cutoff);
  return total;
}

void WorkspacePool::set_totals(const RenderStats& stats, const CutoffSum& cutoff) {
  stats_before_ = stats;
  cutoff_before_ = cutoff;
  all_.clear();
  idle_.clear();
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
