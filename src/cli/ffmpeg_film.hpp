// An FfmpegFilm hands frames to the program ffmpeg, which makes the film.
#pragma once

#include <string>

#include "cli/film.hpp"

namespace crt::cli {

/// Returns the program's path, or nothing if it is in none of the folders of PATH.
std::filesystem::path find_ffmpeg();

class FfmpegFilm : public Film {
 public:
  FfmpegFilm(std::filesystem::path file, const std::string& ending, const FilmShape& shape);
  /// Ends the program and removes what it wrote, unless the film is finished.
  ~FfmpegFilm() override;
  FfmpegFilm(const FfmpegFilm&) = delete;
  FfmpegFilm& operator=(const FfmpegFilm&) = delete;

  void add(const std::vector<std::uint8_t>& rgb) override;
  void finish() override;

 private:
  void close_frames();
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path file_;
  std::filesystem::path unfinished_;  ///< what ffmpeg writes, in the same folder
  int process_ = 0;
  int frames_ = -1;  ///< the end of a pipe
};

}  // namespace crt::cli
