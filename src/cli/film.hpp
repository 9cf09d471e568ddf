// A film is one file with all frames of an animation: a GIF, or a WebP or MP4 file that the program
// ffmpeg makes.
#pragma once

#include <crt/image.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace crt::cli {

/// A FilmShape is what all frames have in common.
struct FilmShape {
  int width = 0;
  int height = 0;
  double frames_per_second = 0;
};

class Film {
 public:
  virtual ~Film() = default;
  /// Takes the next frame: 3 bytes a pixel, rows from the top. Throws Error (io).
  virtual void add(const std::vector<std::uint8_t>& rgb) = 0;
  /// Puts the film in its place. Without this call there is none. Throws Error (io).
  virtual void finish() = 0;
};

/// Says whether the ending of the name is a film's.
bool is_film(const std::filesystem::path& file);

/// Returns the endings of films.
std::string film_endings();

/// Finds out, before anything is rendered, whether the film can be made. Throws Error (io).
void check_film(const std::filesystem::path& file);

/// Begins a film.
std::unique_ptr<Film> begin_film(const std::filesystem::path& file, const FilmShape& shape);

/// Returns a picture's bytes for a film: as displays want them, in front of black.
std::vector<std::uint8_t> film_frame(const Image& image);

}  // namespace crt::cli
