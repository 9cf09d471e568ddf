// A film is one file with all frames of an animation. The program ffmpeg makes it.
#pragma once

#include <crt/image.hpp>
#include <filesystem>
#include <string>

namespace crt::cli {

/// A FilmShape is what all frames have in common.
struct FilmShape {
  int width = 0;
  int height = 0;
  double frames_per_second = 0;
};

/// A Film hands frames to ffmpeg.
class Film {
 public:
  /// Starts the program. Throws Error (io).
  Film(std::filesystem::path file, const FilmShape& shape);
  /// Ends the program and removes what it wrote, unless the film is finished.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// Takes the next frame: what displays show of it, in front of black. Throws Error (io).
  void add(const Image& image);
  /// Puts the film in its place. Without this call there is none. Throws Error (io).
  void finish();

 private:
  void close_frames();
  [[noreturn]] void fail(const std::string& reason) const;

  std::filesystem::path file_;
  std::filesystem::path unfinished_;  ///< what ffmpeg writes, in the same folder
  int process_ = 0;
  int frames_ = -1;  ///< the end of a pipe
};

/// Says whether the ending of the name is a film's.
bool is_film(const std::filesystem::path& file);

/// Returns the endings of films.
std::string film_endings();

/// Finds out, before anything is rendered, whether the film can be made. Throws Error (io).
void check_film(const std::filesystem::path& file);

}  // namespace crt::cli
