#include "cli/film.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/process.hpp"
#include "text/letters.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 3> endings = {".gif", ".webp", ".mp4"};

std::string ending_of(const fs::path& file) {
  return text::in_small_letters(file.extension().string());
}

std::vector<std::string> arguments_for(const std::string& ending, const FilmShape& shape,
                                       const fs::path& output) {
  std::vector<std::string> words = {"ffmpeg", "-loglevel", "error", "-y"};
  const auto add = [&](std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
  };
  add({"-f", "rawvideo", "-pixel_format", "rgb24"});
  add({"-video_size", fmt::format("{}x{}", shape.width, shape.height)});
  const bool is_gif = ending == ".gif";
  constexpr double max_of_a_gif = 50;  // viewers take more for a mistake
  const double rate =
      is_gif ? std::min(shape.frames_per_second, max_of_a_gif) : shape.frames_per_second;
  add({"-framerate", fmt::format("{}", rate), "-i", "-"});
  if (is_gif) {
    // Each frame has 256 colours of its own.
    add({"-vf", "split[a][b];[a]palettegen=stats_mode=single[c];[b][c]paletteuse=new=1"});
    add({"-loop", "0"});
  } else if (ending == ".mp4") {
    // What all players take has colours for 2 x 2 pixels, and so sides that are even.
    add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"});
    add({"-c:v", "libx264", "-crf", "16", "-movflags", "+faststart"});
  } else {
    add({"-c:v", "libwebp", "-quality", "90", "-loop", "0"});
  }
  // An absolute path is taken for no option and no protocol.
  add({fs::absolute(output).string()});
  return words;
}

/// Starts a program that reads from a pipe. Returns the error number, or 0.
int start(const fs::path& program, const std::vector<std::string>& words, int& process,
          int& pipe_end) {
  int ends[2] = {};
  if (pipe2(ends, O_CLOEXEC) != 0) return errno;
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, STDERR_FILENO, STDOUT_FILENO);
  // An interrupt is for this program, which ends the other.
  const int error = spawn(program.string(), words, streams, true, process);
  posix_spawn_file_actions_destroy(&streams);
  close(ends[0]);
  if (error != 0) {
    close(ends[1]);
    return error;
  }
  pipe_end = ends[1];
  return 0;
}

/// Returns the program's path, or nothing if it is in none of the folders of PATH.
fs::path find_ffmpeg() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path program = fs::path(folder) / "ffmpeg";
    if (!folder.empty() && access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

/// Returns 3 bytes a pixel, in front of black.
std::vector<std::uint8_t> rgb_of(const Image& image) {
  const std::vector<std::uint8_t> rgba = image.to_rgba8();
  std::vector<std::uint8_t> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    const int alpha = rgba[i + 3];
    for (std::size_t channel = 0; channel < 3; ++channel)
      rgb.push_back(static_cast<std::uint8_t>((rgba[i + channel] * alpha + 127) / 255));
  }
  return rgb;
}

}  // namespace

Film::Film(fs::path file, const FilmShape& shape) : file_(std::move(file)) {
  const std::string ending = ending_of(file_);
  unfinished_ = file_.parent_path() / fmt::format(".crt-{}{}", getpid(), ending);
  const int error =
      start(find_ffmpeg(), arguments_for(ending, shape, unfinished_), process_, frames_);
  if (error == 0) return;
  process_ = 0;
  fail("ffmpeg does not start: " + std::generic_category().message(error));
}

Film::~Film() {
  close_frames();
  if (process_ == 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
}

void Film::add(const Image& image) {
  const std::vector<std::uint8_t> rgb = rgb_of(image);
  std::size_t written = 0;
  while (written < rgb.size()) {
    const ssize_t count = write(frames_, rgb.data() + written, rgb.size() - written);
    if (count > 0) written += static_cast<std::size_t>(count);
    if (count < 0 && errno != EINTR) fail("ffmpeg takes no more frames");
  }
}

void Film::finish() {
  close_frames();
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = 0;
  std::error_code failed;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    fs::remove(unfinished_, failed);
    fail("ffmpeg ended without success");
  }
  fs::rename(unfinished_, file_, failed);
  if (failed) fail(failed.message());
}

void Film::close_frames() {
  if (frames_ >= 0) close(frames_);
  frames_ = -1;
}

void Film::fail(const std::string& reason) const {
  throw Error(ErrorCode::io, fmt::format("cannot write '{}': {}", file_.string(), reason));
}

bool is_film(const fs::path& file) {
  return std::find(endings.begin(), endings.end(), ending_of(file)) != endings.end();
}

std::string film_endings() {
  return fmt::format("{}", fmt::join(endings, ", "));
}

void check_film(const fs::path& file) {
  check_writable(file);
  if (find_ffmpeg().empty()) {
    throw Error(ErrorCode::io,
                fmt::format("cannot write '{}': films are made by the program ffmpeg, which is not "
                            "installed; without it, -o {}.png writes the frames",
                            file.string(), file.stem().string()));
  }
}

}  // namespace crt::cli
