
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "core/contours/fill.hpp"
#include "core/contours/font.hpp"
#include "crt/error.hpp"
#include "crt/text.hpp"
#include "text/format.hpp"

namespace crt {

using namespace core;

namespace {

constexpr std::size_t max_letters = std::size_t{1} << 16;
constexpr std::size_t max_corners = std::size_t{1} << 20;

[[noreturn]] void refuse_layout(const char* field, const std::string& range, double value) {
  throw Error(ErrorCode::invalid_argument,
              text::format("{} must be {} (it is {})", field, range, value), field);
}

void check(const TextLayout& layout) {
  constexpr double least_size = 1e-90;
  constexpr double largest_size = 1e90;
  constexpr double max_spacing = 1000;
  if (!(layout.size >= least_size && layout.size <= largest_size)) {
    refuse_layout("size", "in [1e-90, 1e90]", layout.size);
  }
  if (!(std::abs(layout.line_spacing) <= max_spacing)) {
    refuse_layout("line_spacing", "in [-1000, 1000]", layout.line_spacing);
  }
}

/// Returns the letter at a place of UTF-8, and goes behind it.
/// Source: RFC 3629, section 4.
char32_t next_letter(std::string_view text, std::size_t& place) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const std::size_t begin = place;
  const unsigned first = byte(place++);
  if (first < 0x80) return first;
  const unsigned following = first >= 0xf0 ? 3 : (first >= 0xe0 ? 2 : 1);
  char32_t letter = first & (0x3fU >> following);
  bool is_right = first >= 0xc2 && first <= 0xf4;
  for (unsigned i = 0; i < following; ++i) {
    is_right = is_right && (byte(place) & 0xc0U) == 0x80;
    letter = letter << 6 | (byte(place++) & 0x3fU);
  }
  constexpr char32_t least[] = {0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = letter >= 0xd800 && letter <= 0xdfff;
  if (!is_right || letter < least[following] || letter > 0x10ffff || is_surrogate) {
    throw Error(ErrorCode::invalid_argument,
                text::format("text must be UTF-8, which it is not at byte {}", begin), "text");
  }
  return letter;
}

std::vector<std::u32string> lines_of(std::string_view text) {
  std::vector<std::u32string> lines(1);
  std::size_t letters = 0;
  for (std::size_t place = 0; place < text.size();) {
    const char32_t letter = next_letter(text, place);
    if (++letters > max_letters) {
      throw Error(ErrorCode::limit, text::format("text must have at most {} letters", max_letters),
                  "text");
    }
    if (letter == U'\n') {
      lines.emplace_back();
    } else if (letter == U'\t') {
      lines.back() += U"    ";
    } else if (letter != U'\r' || place >= text.size() || text[place] != '\n') {
      lines.back() += letter;
    }
  }
  return lines;
}

/// A Typesetter puts letters side by side.
class Typesetter {
 public:
  Typesetter(const Font& font, const TextLayout& layout)
      : layout_(layout), reader_(font), scale_(layout.size / reader_.units_per_em()) {}

  TextContours set(std::string_view text) {
    double height = 0;
    for (const std::u32string& line : lines_of(text)) {
      set_line(line, height);
      height -= layout_.line_spacing * reader_.line_height();
    }
    if (layout_.options.fill == FillRule::nonzero) {
      result_.contours =
          fill_contours(result_.contours, WindingRule::nonzero, layout_.options.work);
    }
    return std::move(result_);
  }

 private:
  void set_line(const std::u32string& line, double height) {
    std::vector<std::uint32_t> numbers;
    std::vector<double> places;
    double end = 0;
    for (const char32_t letter : line) {
      const std::uint32_t number = reader_.glyph_of(letter);
      if (number == 0) report_missing(letter);
      if (!numbers.empty()) end += reader_.kerning(numbers.back(), number);
      numbers.push_back(number);
      places.push_back(end);
      end += glyph(number).advance;
    }
    result_.width = std::max(result_.width, scale_ * end);
    const double share = layout_.alignment == TextAlignment::left     ? 0
                         : layout_.alignment == TextAlignment::center ? 0.5
                                                                      : 1;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      add(glyph(numbers[i]), scale_ * (places[i] - share * end), scale_ * height);
    }
  }

  const Glyph& glyph(std::uint32_t number) {
    const auto [place, is_new] = glyphs_.try_emplace(number);
    if (is_new) {
      place->second =
          reader_.glyph(number, scale_, layout_.options.deviation, max_corners - corners_);
    }
    return place->second;
  }

  void add(const Glyph& glyph, double x, double y) {
    for (Contour contour : glyph.contours) {
      corners_ += contour.size();
      if (corners_ > max_corners) {
        throw Error(ErrorCode::limit, "the text has too many corners: make it several");
      }
      for (ProfilePoint& corner : contour) {
        corner.x += x;
        corner.y += y;
      }
      result_.contours.push_back(std::move(contour));
    }
  }

  void report_missing(char32_t letter) {
    std::u32string& missing = result_.missing_letters;
    if (missing.find(letter) == std::u32string::npos) missing += letter;
  }

  const TextLayout& layout_;
  FontReader reader_;
  double scale_;
  std::map<std::uint32_t, Glyph> glyphs_;
  std::size_t corners_ = 0;
  TextContours result_;
};

}  // namespace

TextContours text_contours(std::string_view text, const Font& font, const TextLayout& layout) {
  check(layout);
  return Typesetter(font, layout).set(text);
}

}  // namespace crt
