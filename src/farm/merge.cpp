
#include <algorithm>

#include "farm/assembly.hpp"
#include "text/format.hpp"

namespace crt::farm {

namespace {

namespace fs = std::filesystem;

fs::path default_output(const Job& job, int frame) {
  const FarmPlan plan = plan_of(job);
  const char* const ending = plan.has_channels ? ".exr" : ".png";
  return job.folder / (plan.frames ? text::format("{}_{:04}{}", plan.picture_name, frame, ending)
                                   : plan.picture_name + ending);
}

class Merger {
 public:
  Merger(const Job& job, const FarmMergeOptions& options) : job_(job), options_(options) {}

  FarmMerge merge() {
    find_parts();
    const auto tasks = static_cast<int>(job_.manifest.tasks.size());
    for (int task = 0; task < tasks; ++task) {
      if (options_.go_on && !options_.go_on())
        throw Error(ErrorCode::cancelled, "merging was ended");
      if (is_wanted(task)) add_part(task);
    }
    return std::move(result_);
  }

 private:
  const std::vector<Piece>& pieces_of(int task) const {
    return job_.manifest.tasks[static_cast<std::size_t>(task)].pieces;
  }

  /// Notes which frames lack parts.
  void find_parts() {
    const auto tasks = static_cast<int>(job_.manifest.tasks.size());
    for (int task = 0; task < tasks; ++task) {
      std::error_code failed;
      if (!fs::exists(job_.part_file(task), failed)) {
        result_.missing.push_back(task);
      } else if (!has_part(job_, task)) {
        result_.refused.push_back({task, text::format("'{}' is damaged, or of another plan or task",
                                                      job_.part_file(task).string())});
      } else {
        continue;
      }
      give_up(task);
    }
  }

  void give_up(int task) {
    for (const Piece& piece : pieces_of(task)) {
      incomplete_.insert(piece.frame);
      assemblies_.erase(piece.frame);
    }
  }

  bool is_wanted(const Piece& piece) const {
    return !incomplete_.contains(piece.frame) && !options_.skip.contains(piece.frame);
  }
  bool is_wanted(int task) const {
    return std::any_of(pieces_of(task).begin(), pieces_of(task).end(),
                       [this](const Piece& piece) { return is_wanted(piece); });
  }

  void add_part(int task) {
    try {
      for (const RenderedPiece& rendered : read_part(job_, task)) {
        if (is_wanted(rendered.piece)) add(rendered);
      }
    } catch (const Error& error) {
      if (error.code() != ErrorCode::io || is_writing_) throw;
      result_.refused.push_back({task, error.what()});
      give_up(task);
    }
  }

  void add(const RenderedPiece& rendered) {
    const int frame = rendered.piece.frame;
    Assembly& assembly = assemblies_.try_emplace(frame, job_.manifest).first->second;
    assembly.add(rendered);
    if (!assembly.is_complete()) return;
    const Image image = assembly.finish();
    assemblies_.erase(frame);
    is_writing_ = true;
    const fs::path output = options_.output ? options_.output(frame) : default_output(job_, frame);
    if (!options_.output) check_replaceable(output);
    image.write(output, {.reproducible = true});
    is_writing_ = false;
    result_.frames.push_back(frame);
  }

  const Job& job_;
  const FarmMergeOptions& options_;
  FarmMerge result_;
  std::set<int> incomplete_;
  std::map<int, Assembly> assemblies_;
  bool is_writing_ = false;
};

}  // namespace

}  // namespace crt::farm

namespace crt {

FarmMerge merge_farm(const std::filesystem::path& job, const FarmMergeOptions& options) {
  const farm::Job opened = farm::open_job(job);
  return farm::Merger(opened, options).merge();
}

}  // namespace crt
