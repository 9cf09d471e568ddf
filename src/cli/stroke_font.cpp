#include "cli/stroke_font.hpp"

#include <algorithm>
#include <iterator>

namespace crt::cli {

namespace {

/// A Glyph is a letter on a grid of its own. The strokes are divided by '|', their corners by
/// blanks. A corner is two digits, x to the right from 0 and y upwards. 2 is the line that letters
/// stand on, 6 the height of small ones, 8 that of capitals.
struct Glyph {
  char letter;
  int width;
  std::string_view strokes;
};

constexpr Glyph glyphs[] = {
    {' ', 2, ""},
    {'!', 2, "18 14|13 12"},
    {'"', 3, "18 16|28 26"},
    {'#', 5, "13 17|33 37|06 46|04 44"},
    {'%', 5, "02 48|08 18 17 07 08|32 42 43 33 32"},
    {'$', 4, "47 38 18 07 06 44 43 32 12 03|29 21"},
    {'&', 5, "52 07 18 28 37 14 03 12 32 54"},
    {'\'', 2, "18 16"},
    {'(', 2, "28 16 14 22"},
    {')', 2, "08 16 14 02"},
    {'*', 4, "17 33|13 37|05 45"},
    {'+', 4, "23 27|05 45"},
    {',', 2, "13 11"},
    {'-', 4, "05 35"},
    {'.', 2, "13 12"},
    {'/', 4, "01 49"},
    {'0', 4, "13 07 18 38 47 43 32 12 03 07|03 47"},
    {'1', 4, "06 28 22|02 42"},
    {'2', 4, "07 18 38 47 46 02 42"},
    {'3', 4, "08 48 25 45 43 32 12 03"},
    {'4', 4, "32 38 04 44"},
    {'5', 4, "48 08 05 35 44 43 32 02"},
    {'6', 4, "38 18 06 03 12 32 43 44 35 05"},
    {'7', 4, "08 48 12"},
    {'8', 4, "15 06 07 18 38 47 46 35 15 04 03 12 32 43 44 35"},
    {'9', 4, "12 32 44 47 38 18 07 06 15 45"},
    {':', 2, "16 15|13 12"},
    {';', 2, "16 15|13 11"},
    {'<', 4, "37 05 33"},
    {'=', 4, "06 46|04 44"},
    {'>', 4, "07 35 03"},
    {'?', 4, "07 18 38 47 46 25 24|23 22"},
    {'@', 5, "34 14 16 36 34 44 47 38 18 07 03 12 42"},
    {'A', 4, "02 28 42|13 33"},
    {'B', 4, "02 08 38 47 46 35 05|35 44 43 32 02"},
    {'C', 4, "47 38 18 07 03 12 32 43"},
    {'D', 4, "02 08 28 46 44 22 02"},
    {'E', 4, "48 08 02 42|05 35"},
    {'F', 4, "48 08 02|05 35"},
    {'G', 4, "47 38 18 07 03 12 32 43 45 25"},
    {'H', 4, "08 02|48 42|05 45"},
    {'I', 2, "18 12|08 28|02 22"},
    {'J', 4, "48 43 32 12 03"},
    {'K', 4, "08 02|48 05 42"},
    {'L', 4, "08 02 42"},
    {'M', 5, "02 08 25 48 42"},
    {'N', 4, "02 08 42 48"},
    {'O', 4, "13 07 18 38 47 43 32 12 03 07"},
    {'P', 4, "02 08 38 47 46 35 05"},
    {'Q', 4, "12 03 07 18 38 47 43 32 12|24 42"},
    {'R', 4, "02 08 38 47 46 35 05|25 42"},
    {'S', 4, "47 38 18 07 06 44 43 32 12 03"},
    {'T', 4, "28 22|08 48"},
    {'U', 4, "08 03 12 32 43 48"},
    {'V', 4, "08 22 48"},
    {'W', 5, "08 12 26 32 48"},
    {'X', 4, "08 42|48 02"},
    {'Y', 4, "08 25 48|25 22"},
    {'Z', 4, "08 48 02 42"},
    {'[', 2, "28 18 12 22"},
    {'\\', 4, "09 41"},
    {']', 2, "08 18 12 02"},
    {'^', 4, "06 28 46"},
    {'_', 4, "01 41"},
    {'`', 2, "08 17"},
    {'a', 4, "06 36 45 42|44 14 03 12 32 43"},
    {'b', 4, "08 02|05 16 36 45 43 32 12 03"},
    {'c', 4, "45 36 16 05 03 12 32 43"},
    {'d', 4, "48 42|45 36 16 05 03 12 32 43"},
    {'e', 4, "04 44 45 36 16 05 03 12 42"},
    {'f', 3, "38 28 17 12|06 36"},
    {'g', 4, "46 41 30 10|45 36 16 05 03 12 32 43"},
    {'h', 4, "08 02|05 16 36 45 42"},
    {'i', 2, "16 12|18 17"},
    {'j', 2, "16 11 00|18 17"},
    {'k', 4, "08 02|36 04 42"},
    {'l', 2, "18 13 22"},
    {'m', 6, "06 02|05 16 26 35 32|35 46 56 65 62"},
    {'n', 4, "06 02|05 16 36 45 42"},
    {'o', 4, "05 16 36 45 43 32 12 03 05"},
    {'p', 4, "06 00|05 16 36 45 43 32 12 03"},
    {'q', 4, "46 40|45 36 16 05 03 12 32 43"},
    {'r', 3, "06 02|04 16 36"},
    {'s', 4, "45 36 16 05 14 34 43 32 12 03"},
    {'t', 3, "17 13 22 32|06 36"},
    {'u', 4, "06 03 12 32 43|46 42"},
    {'v', 4, "06 22 46"},
    {'w', 6, "06 12 35 52 66"},
    {'x', 4, "06 42|46 02"},
    {'y', 4, "06 22|46 10"},
    {'z', 4, "06 46 02 42"},
    {'{', 3, "38 28 26 15 24 22 32"},
    {'|', 2, "19 11"},
    {'}', 3, "08 18 16 25 14 12 02"},
    {'~', 5, "04 15 34 45"},
};

constexpr int base_line = 2;
/// This is the distance from letter to letter, beside their widths.
constexpr double gap = 1.6;
/// The grid has this many rows for a line of height 1.
constexpr double grid_rows = 11;

const Glyph& glyph_of(char letter) {
  const auto* const found =
      std::find_if(std::begin(glyphs), std::end(glyphs),
                   [&](const Glyph& glyph) { return glyph.letter == letter; });
  return found == std::end(glyphs) ? glyph_of('?') : *found;
}

/// Says whether a byte continues a letter of UTF-8. Such bytes are no letters of their own.
bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

int digit(char c) {
  return c - '0';
}

}  // namespace

double width_of_text(std::string_view text, double size) {
  double width = 0;
  for (const char letter : text) {
    if (!is_continuation(letter)) width += glyph_of(letter).width + gap;
  }
  return width * size / grid_rows;
}

std::vector<std::vector<Place>> strokes_of_text(std::string_view text, double size) {
  const double unit = size / grid_rows;
  std::vector<std::vector<Place>> strokes;
  double left = 0;
  for (const char letter : text) {
    if (is_continuation(letter)) continue;
    const Glyph& glyph = glyph_of(letter);
    const std::string_view corners = glyph.strokes;
    for (std::size_t i = 0; i + 1 < corners.size(); i += 3) {
      if (i == 0 || corners[i - 1] == '|') strokes.emplace_back();
      strokes.back().push_back(
          {unit * (left + digit(corners[i])), unit * (base_line - digit(corners[i + 1]))});
    }
    left += glyph.width + gap;
  }
  return strokes;
}

}  // namespace crt::cli
