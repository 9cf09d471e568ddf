// This header splits the rendering of a script into tasks for many machines, and puts their parts
// together. A job is a folder that all of them see, or that is copied to and fro. It holds the
// script, all files that it reads, and what is to be done. Nothing here starts a process or talks
// to a network: plan_farm(), work_farm() and merge_farm() are for whatever runs the tasks.
//
// The merged pictures are those of one machine, to the byte of their files (with
// WriteOptions::reproducible), whatever the tasks are and however often each of them ran.
#pragma once

#include <crt/image.hpp>
#include <crt/render.hpp>
#include <crt/script.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace crt {

/// FarmFrames are the frames first..last of an animation, both rendered. Each is a whole `t`.
struct FarmFrames {
  int first = 0;
  int last = 0;

  bool operator==(const FarmFrames&) const = default;
};

/// FarmOptions say what is to be rendered, and how it is split.
struct FarmOptions {
  /// Says what the script gets. All its files are copied into the job, which has a limit: they must
  /// lie in the script's directory or a resource directory. open_file and allow_outside_files are
  /// not for jobs.
  ScriptOptions script{};
  /// Renders these frames. Without them there is one picture, at ScriptOptions::t.
  std::optional<FarmFrames> frames{};
  /// This is the number of tasks, in [1, 1000000]. 0 takes as many as last `least_seconds` each.
  int tasks = 0;
  /// This is the least time that a task may take on one core, if their number is not given.
  double least_seconds = 60;
  /// Pixels across and down of the tiles that pictures are cut into. With 0 they are cut where that
  /// makes the tasks' costs equal.
  int tile_width = 0;
  int tile_height = 0;
  /// The tasks get `seed`, `passes`, `max_ray_steps` and `aovs`. Planning uses `threads` and
  /// `progress`. The others must be as they are.
  RenderOptions render{};
  std::uint64_t max_primitives = 0;  ///< see PrepareOptions
};

/// A FarmPlan is what a job consists of.
struct FarmPlan {
  std::string id{};  ///< the hash of the plan: 64 hexadecimal digits
  int tasks = 0;
  std::optional<FarmFrames> frames{};
  int width = 0;
  int height = 0;
  double seconds = 0;          ///< estimated, of one core, for all tasks
  double longest_seconds = 0;  ///< estimated, for the task that takes longest
  int passes = 0;              ///< see RenderOptions::passes; a time budget becomes such a number
  std::string picture_name{};  ///< what the pictures are called, without an ending
  bool has_channels = false;   ///< beside colours, so that they are EXR files
};

/// Makes a job of a script in a folder, which must not exist or be empty, and is empty if planning
/// fails. It renders a small picture of some frames to see where time goes. A time budget is taken
/// for what this machine does in that time with `render.threads`, and becomes a number of passes.
/// Throws Error: script (the message has the diagnostics), io, invalid_argument, limit, cancelled,
/// out_of_memory.
FarmPlan plan_farm(const std::filesystem::path& script, const std::filesystem::path& job,
                   const FarmOptions& options = {});

/// Reads what a job consists of. Throws Error (io) where it is no job or is damaged.
FarmPlan read_farm_plan(const std::filesystem::path& job);

/// FarmWorkOptions say how a task is worked on.
struct FarmWorkOptions {
  int threads = 0;  ///< see RenderOptions
  /// Is called as RenderOptions::progress is, with the share of the task.
  std::function<bool(double)> progress{};
};

/// Renders a task of a job, from 0 on, and leaves its part. A task whose part is there and whole is
/// not rendered again, and then false is returned. A part is written whole or not at all, and has
/// the same bytes whoever makes it. So any number of processes may work on one task. Throws Error:
/// invalid_argument (no such task), io, script, cancelled, limit, out_of_memory.
bool work_farm(const std::filesystem::path& job, int task, const FarmWorkOptions& options = {});

/// Returns the name of a frame's picture. A run of '#' or a "%04d" in the file's name becomes the
/// number (with that many digits at least). Where there is neither, _0001 goes before the ending.
std::filesystem::path frame_path(const std::filesystem::path& output, int frame);

/// FarmMergeOptions say where the pictures go.
struct FarmMergeOptions {
  /// Names the picture of a frame, which is 0 where there are no frames. Without it pictures go
  /// into the job's folder.
  std::function<std::filesystem::path(int frame)> output{};
  /// Leaves out frames, such as those that were merged before.
  std::set<int> skip{};
  /// Is asked between parts. Returning false ends with Error (cancelled).
  std::function<bool()> go_on{};
};

/// A RefusedPart is a part that is damaged or of another plan.
struct RefusedPart {
  int task = 0;
  std::string why{};  ///< names the file
};

/// A FarmMerge says what merging did.
struct FarmMerge {
  std::vector<int> frames{};   ///< that were written
  std::vector<int> missing{};  ///< tasks without a part
  /// Working on the tasks of these again replaces them.
  std::vector<RefusedPart> refused{};

  /// Says whether all pictures are there.
  bool complete() const { return missing.empty() && refused.empty(); }
};

/// Writes the pictures all of whose parts are there, and says what is missing. It may be called
/// again at any time. Throws Error: io, unsupported (see Image::write), cancelled, out_of_memory.
FarmMerge merge_farm(const std::filesystem::path& job, const FarmMergeOptions& options = {});

/// Says how far a task is.
enum class FarmTaskState {
  waiting,  ///< nobody works on it
  running,  ///< somebody does, or did within the last minute
  lost,     ///< somebody began, and has not been heard of for over a minute
  done,     ///< its part is there
};

/// A FarmTask is one task of a job.
struct FarmTask {
  FarmTaskState state = FarmTaskState::waiting;
  double seconds = 0;    ///< that rendering it took; 0 if it is not known
  double estimated = 0;  ///< the seconds that were planned for it, on one core
  double share = 0;      ///< the share done, of those that run
  std::string worker{};  ///< the machine and process
};

/// A FarmStatus is how far a job is.
struct FarmStatus {
  std::vector<FarmTask> tasks{};

  /// Returns how many tasks are in a state.
  int count(FarmTaskState state) const;
  /// Returns the estimated share of the work that is done, from 0 to 1.
  double share() const;
  /// Returns the seconds that all tasks done have taken together.
  double seconds_spent() const;
  /// Estimates the seconds of work that are left, by what the tasks done have taken.
  double seconds_left() const;
};

/// Reads how far a job is. It looks at the beginning of parts alone. Throws Error (io).
FarmStatus farm_status(const std::filesystem::path& job);

/// Returns a contact sheet of all that is there: the frames side by side, each at most `cell`
/// pixels across, with transparent black where parts are missing. Throws Error: io, out_of_memory.
Image farm_sheet(const std::filesystem::path& job, int cell = 160);

}  // namespace crt
