#include "cli/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <string>
#include <string_view>

#include "cli/ffmpeg_film.hpp"
#include "cli/gif_film.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view gif = ".gif";
constexpr std::array<std::string_view, 3> endings = {gif, ".webp", ".mp4"};

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace

bool is_film(const fs::path& file) {
  return std::find(endings.begin(), endings.end(), ending_of(file)) != endings.end();
}

std::string film_endings() {
  return fmt::format("{}", fmt::join(endings, ", "));
}

void check_film(const fs::path& file) {
  check_writable(file);
  if (ending_of(file) != gif && find_ffmpeg().empty()) {
    throw Error(ErrorCode::io,
                fmt::format("cannot write '{}': such films are made by the program ffmpeg, which "
                            "is not installed; a .gif needs no other program",
                            file.string()));
  }
}

std::unique_ptr<Film> begin_film(const fs::path& file, const FilmShape& shape) {
  if (ending_of(file) == gif) return std::make_unique<GifFilm>(file, shape);
  return std::make_unique<FfmpegFilm>(file, ending_of(file), shape);
}

std::vector<std::uint8_t> film_frame(const Image& image) {
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

}  // namespace crt::cli
