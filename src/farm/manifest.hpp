// A manifest is the file of a job that says what is to be done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "crt/farm.hpp"

namespace crt::farm {

/// A Piece is a part of the picture of a frame.
struct Piece {
  int frame = 0;
  Region region{};
};

/// A Task is the pieces that one part file has.
struct Task {
  double seconds = 0;  ///< estimated, of one core
  std::vector<Piece> pieces{};
};

struct Manifest {
  std::string script{};                        ///< its name, in the folder that scripts see
  std::map<std::string, std::string> files{};  ///< hashes by names, in folders that scripts see
  int resource_folders = 0;
  double t = 0;
  std::vector<std::pair<std::string, std::string>> variables{};
  std::vector<std::pair<std::string, std::string>> settings{};
  int compat = 0;
  std::uint64_t max_steps = 0;
  std::uint64_t max_image_pixels = 0;
  std::optional<FarmFrames> frames{};
  int width = 0;
  int height = 0;
  std::optional<std::uint64_t> seed{};
  int passes = 0;
  std::uint64_t max_ray_steps = 0;
  std::uint64_t max_primitives = 0;
  Aovs aovs{};
  std::vector<Task> tasks{};
};

inline constexpr int max_tasks = 1'000'000;
inline constexpr int max_frames = 1'000'000;

/// Returns the text of a manifest.
std::string to_text(const Manifest& manifest);

/// Reads a text that somebody may have changed. Throws Error (io) where it is no manifest, or one
/// that nobody may follow: with a path that leads out of the job, or tasks that do not make the
/// pictures.
Manifest parse_manifest(std::string_view text);

/// Returns the frames of a manifest: one of number 0 where there is a single picture.
inline FarmFrames frames_of(const Manifest& manifest) {
  return manifest.frames.value_or(FarmFrames{});
}

/// A Job is a manifest with its place and its hash.
struct Job {
  std::filesystem::path folder;
  std::string id;
  Manifest manifest;

  std::filesystem::path part_file(int task) const;
  std::filesystem::path log_file(int task) const;
  std::filesystem::path content_file(const std::string& hash) const;
};

/// Reads the manifest of a job. Throws Error (io).
Job open_job(const std::filesystem::path& folder);

/// Returns what the public interface says of a job.
FarmPlan plan_of(const Job& job);

inline constexpr const char* manifest_name = "manifest.json";
inline constexpr const char* parts_folder = "parts";
inline constexpr const char* log_folder = "log";
inline constexpr const char* contents_folder = "files";

}  // namespace crt::farm
