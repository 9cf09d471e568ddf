// A GifFilm writes an animated GIF. Each frame has its own 256 colours.
#pragma once

#include <string>

#include "cli/film.hpp"

namespace crt::cli {

class GifFilm : public Film {
 public:
  GifFilm(std::filesystem::path file, const FilmShape& shape);
  void add(const std::vector<std::uint8_t>& rgb) override;
  void finish() override;

 private:
  void add_number(int number);
  int delay_of_next_frame();

  std::filesystem::path file_;
  FilmShape shape_;
  std::string content_;
  int frames_ = 0;
  int hundredths_ = 0;  ///< that all frames so far take
};

}  // namespace crt::cli
