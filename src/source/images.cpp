
#include <algorithm>

#include "core/geometry/height_field/grid.hpp"
#include "crt/error.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

const char* ending_of(const Image& image) {
  return image.display_encoded() ? "png" : "exr";
}

/// Returns a file with all that a scene uses of an image.
std::vector<std::byte> file_of(const Image& image) {
  Image plain(image.width(), image.height());
  std::copy(image.pixels().begin(), image.pixels().end(), plain.pixels().begin());
  plain.set_display_encoded(image.display_encoded());
  std::vector<std::byte> file = plain.encode(ending_of(image), {.reproducible = true});
  const Image again = Image::decode(file, "image");
  const bool is_same =
      again.display_encoded() == image.display_encoded() && again.width() == image.width() &&
      again.height() == image.height() &&
      std::equal(again.pixels().begin(), again.pixels().end(), image.pixels().begin());
  if (is_same) return file;
  throw Error(ErrorCode::unsupported,
              "an image with more than 8 bits a channel, or with values that are not finite, "
              "cannot be written as source code: read it from its file");
}

std::string python_bytes(const std::vector<std::byte>& file) {
  constexpr std::size_t bytes_of_a_line = 40;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < file.size(); i += bytes_of_a_line) {
    std::string line = "\"";
    for (std::size_t k = i; k < std::min(i + bytes_of_a_line, file.size()); ++k)
      line += text::format("{:02x}", std::to_integer<unsigned>(file[k]));
    lines.push_back(line + "\"");
  }
  std::string text = "bytes.fromhex(";
  for (const std::string& line : lines) text += "\n        " + line;
  return text + ")";
}

}  // namespace

std::string image_file_name(Program& program, const Image& image) {
  return program.add_file(file_of(image), ending_of(image));
}

std::optional<std::string> heights_file_name(Program& program, const HeightGrid& grid) {
  constexpr std::uint32_t max_in_text = 4096;
  const std::uint32_t columns = grid.columns();
  if (std::uint64_t{columns} * grid.rows() <= max_in_text) return std::nullopt;
  Image image(static_cast<int>(columns), static_cast<int>(grid.rows()));
  for (std::uint32_t row = 0; row < grid.rows(); ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double height = grid.height(column, row);
      if (double{static_cast<float>(height)} != height) return std::nullopt;
      // The first row of an image is at the upper z.
      image.set(static_cast<int>(column), static_cast<int>(grid.rows() - 1 - row),
                {height, height, height, 1});
    }
  }
  try {
    return program.add_file(image.encode("exr", {.reproducible = true}), "exr");
  } catch (const Error& error) {
    // Where OpenImageIO is missing, as beside wheels, the heights stand in the text.
    if (error.code() != ErrorCode::unsupported) throw;
    return std::nullopt;
  }
}

std::string image_name(Program& program, const std::shared_ptr<const Image>& image) {
  if (std::string known = program.known(image.get()); !known.empty()) return known;
  const Syntax& syntax = program.syntax();
  std::string name;
  if (syntax.is_script()) {
    name = syntax.text(image_file_name(program, *image));
    return program.remember(image.get(), name);
  }
  const std::vector<std::byte> file = file_of(*image);
  program.require_space(file.size());
  if (syntax.is_python()) {
    name = program.define("image", "", text::format("crt.Image.decode({})", python_bytes(file)));
    return program.remember(image.get(), name);
  }
  std::vector<std::string> items;
  items.reserve(file.size());
  for (const std::byte byte : file) items.push_back(std::to_string(std::to_integer<int>(byte)));
  const std::string bytes = program.array("image_file", "unsigned char", items);
  if (syntax.is_c()) {
    name = program.create("image", "crt_image_decode",
                          {bytes, text::format("sizeof {}", bytes), "\"image\""});
  } else {
    name = program.define("image", "auto",
                          text::format("std::make_shared<const Image>(\n      "
                                       "Image::decode(std::as_bytes(std::span({})), \"image\"))",
                                       bytes));
  }
  return program.remember(image.get(), name);
}

}  // namespace crt::source
