#include "crt/text.hpp"

#include <doctest/doctest.h>

#include <random>

#include "contours/winding_oracle.hpp"
#include "core/contours/font.hpp"
#include "crt/error.hpp"

using namespace crt;
using namespace crt::test;

namespace {

std::vector<std::byte> bytes_of_standard_font() {
  const auto content = standard_font()->content();
  return {content.begin(), content.end()};
}

/// A TextBox holds the corners of text.
struct TextBox {
  double left = 1e300;
  double right = -1e300;
  double low = 1e300;
  double high = -1e300;

  explicit TextBox(const TextContours& text) {
    for (const Contour& contour : text.contours) {
      for (const ProfilePoint& corner : contour) {
        left = std::min(left, corner.x);
        right = std::max(right, corner.x);
        low = std::min(low, corner.y);
        high = std::max(high, corner.y);
      }
    }
  }
};

TextBox box_of(std::string_view text, const TextLayout& layout = {}) {
  return TextBox(text_contours(text, *standard_font(), layout));
}

/// Returns the share of the em's square that FreeType's rasterizer fills of a glyph, as an oracle
/// for the area. A pixel is a `pixels`-th of the em.
double rasterized_area(const std::vector<std::byte>& font, std::uint32_t glyph, int pixels);

}  // namespace

TEST_CASE("letters have the sizes that the font says") {
  // Of Liberation Sans, in 2048ths of the em: H is 1409 high, and x is 1082 high.
  CHECK(box_of("H").high == doctest::Approx(1409 / 2048.0));
  CHECK(box_of("H").low == 0);
  CHECK(box_of("x", {.size = 4096}).high == doctest::Approx(2164));
  CHECK(text_contours("H", *standard_font()).width == doctest::Approx(1479 / 2048.0));
  // Lines are 2355 apart: ascent, descent and gap.
  CHECK(box_of("H\nH").low == doctest::Approx(-2355 / 2048.0));
  CHECK(box_of("\r\n\nH", {.line_spacing = 0.5}).low == doctest::Approx(-2355 / 2048.0));
  CHECK(box_of("\r\n\nH", {.line_spacing = -1}).low == doctest::Approx(2 * 2355 / 2048.0));
}

TEST_CASE("a letter of straight lines has the area of its font's numbers") {
  // An I is one rectangle, an L two, and an H three.
  const auto area = [](std::string_view text) {
    return area_of(text_contours(text, *standard_font(), {.size = 2048}).contours);
  };
  const TextBox i = box_of("I", {.size = 2048});
  CHECK(area("I") == doctest::Approx((i.right - i.left) * 1409));
  CHECK(area("II") == doctest::Approx(2 * area("I")));
  CHECK(text_contours("I", *standard_font()).contours.size() == 1);
  CHECK(text_contours("I", *standard_font()).contours[0].size() <= 5);
  CHECK(text_contours("B", *standard_font()).contours.size() == 3);
}

TEST_CASE("lines are aligned by their widths") {
  const double width = text_contours("HH", *standard_font()).width;
  const TextBox left = box_of("HH\nH");
  const TextBox center = box_of("HH\nH", {.alignment = TextAlignment::center});
  const TextBox right = box_of("HH\nH", {.alignment = TextAlignment::right});
  CHECK(left.left > 0);
  CHECK(center.left == doctest::Approx(left.left - width / 2));
  CHECK(right.left == doctest::Approx(left.left - width));
  CHECK(right.right < 0);
  CHECK(box_of("H\nHH", {.alignment = TextAlignment::right}).left == doctest::Approx(right.left));
  CHECK(text_contours("\tH", *standard_font()).width ==
        doctest::Approx(text_contours("    H", *standard_font()).width));
}

TEST_CASE("pairs of letters come closer, and letters that overlap are one region") {
  const auto width = [](std::string_view text) {
    return text_contours(text, *standard_font()).width;
  };
  CHECK(width("AV") < width("A") + width("V") - 0.05);
  CHECK(width("HH") == doctest::Approx(2 * width("H")));
  // Lines upon each other.
  const TextLayout pressed{.size = 2048, .line_spacing = 0};
  const auto area = [&](std::string_view text) {
    return area_of(text_contours(text, *standard_font(), pressed).contours);
  };
  CHECK(area("O\nO") == doctest::Approx(area("O")));
  CHECK(area("I\n-\nI") < area("I") + area("-") + 1);
  CHECK(area("H\nO") < area("H") + area("O") - 1000);
  CHECK(area("H\nO") > area("O") + 1000);
}

TEST_CASE("a letter that the font lacks is its box for that, and is reported") {
  const TextContours text =
      text_contours("a\xe6\xbc\xa2\xe5\xad\x97\xe6\xbc\xa2", *standard_font());
  CHECK(text.missing_letters == U"\u6f22\u5b57");
  CHECK(text.contours.size() > 6);
  CHECK(text_contours("\xc3\xa9\xce\xa9\xd0\x96", *standard_font()).missing_letters.empty());
  CHECK(text_contours("", *standard_font()).contours.empty());
  CHECK(text_contours(" \t\n ", *standard_font()).contours.empty());
}

TEST_CASE("text that is wrong is refused") {
  const auto refuses = [](std::string_view text, const TextLayout& layout, const char* message) {
    CHECK_THROWS_WITH_AS(text_contours(text, *standard_font(), layout), doctest::Contains(message),
                         Error);
  };
  for (const char* wrong :
       {"abc\x80", "abc\xc3", "abc\xc3(", "abc\xc0\x80", "abc\xe0\x80\x80", "abc\xed\xa0\x80",
        "abc\xf4\x90\x80\x80", "abc\xf8\x88\x80\x80\x80", "abc\xff", "abc\xf0\x80\x80\x80"}) {
    refuses(wrong, {}, "text must be UTF-8, which it is not at byte 3");
  }
  refuses("a", {.size = 0}, "size must be in [1e-90, 1e90] (it is 0)");
  refuses("a", {.size = std::nan("")}, "size must be");
  refuses("a", {.line_spacing = 1e4}, "line_spacing must be");
  refuses("o", {.options = {.deviation = 1e-20}}, "deviation must be 0 or at least");
  refuses(std::string(70000, 'a'), {}, "at most 65536 letters");
  refuses(std::string(60000, 'o'), {}, "too many corners");
}

TEST_CASE("a file that is no font is refused, whatever is in it") {
  const auto refuses = [](std::span<const std::byte> content) {
    CHECK_THROWS_WITH_AS(decode_font(content, "my.ttf"), doctest::Contains("'my.ttf' is no font"),
                         Error);
  };
  refuses({});
  const std::vector<std::byte> zeros(1000);
  refuses(zeros);
  CHECK_THROWS_WITH_AS(read_font("/no/such/font.ttf"), doctest::Contains("/no/such/font.ttf"),
                       Error);
  const std::vector<std::byte> font = bytes_of_standard_font();
  std::mt19937_64 random(7);
  int readable = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<std::byte> broken = font;
    if (i % 4 == 0) broken.resize(random() % broken.size());
    const auto changes = random() % 2000;
    for (std::uint64_t k = 0; k < changes && !broken.empty(); ++k) {
      broken[random() % broken.size()] = static_cast<std::byte>(random());
    }
    try {
      const auto made = decode_font(broken, "broken");
      const TextContours text = text_contours("Hamburgefonstiv", *made);
      if (!text.contours.empty()) CHECK_NOTHROW(make_profile(text.contours));
      ++readable;
    } catch (const Error& error) {
      INFO(error.what());
      CHECK((error.code() == ErrorCode::io || error.code() == ErrorCode::unsupported));
    }
  }
  CHECK(readable > 10);
}

TEST_CASE("every letter of the standard font becomes a profile with the area of its pixels") {
  const std::vector<std::byte> content = bytes_of_standard_font();
  const auto font = standard_font();
  const crt::core::FontReader reader(*font);
  int letters = 0;
  for (char32_t letter = 33; letter < 0x500; ++letter) {
    const std::uint32_t glyph = reader.glyph_of(letter);
    if (glyph == 0) continue;
    std::string text;
    if (letter < 0x80) {
      text += static_cast<char>(letter);
    } else {
      text += static_cast<char>(0xc0 | (letter >> 6));
      text += static_cast<char>(0x80 | (letter & 0x3f));
    }
    CAPTURE(text);
    const TextContours made = text_contours(text, *font);
    if (made.contours.empty()) continue;
    CHECK_NOTHROW(make_profile(made.contours));
    ++letters;
    constexpr int every = 7;
    if (letters % every != 0) continue;
    CHECK(area_of(made.contours) ==
          doctest::Approx(rasterized_area(content, glyph, 512)).epsilon(0.003));
  }
  CHECK(letters > 700);
}

namespace {

double rasterized_area(const std::vector<std::byte>& font, std::uint32_t glyph, int pixels) {
  using namespace crt::core;
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  REQUIRE(FT_Init_FreeType(&library) == 0);
  REQUIRE(FT_New_Memory_Face(library, reinterpret_cast<const FT_Byte*>(font.data()),
                             static_cast<FT_Long>(font.size()), 0, &face) == 0);
  REQUIRE(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(pixels)) == 0);
  REQUIRE(FT_Load_Glyph(face, glyph, FT_LOAD_NO_HINTING | FT_LOAD_RENDER) == 0);
  const FT_Bitmap& bitmap = face->glyph->bitmap;
  double sum = 0;
  for (unsigned row = 0; row < bitmap.rows; ++row) {
    for (unsigned column = 0; column < bitmap.width; ++column) {
      sum += bitmap.buffer[row * static_cast<unsigned>(bitmap.pitch) + column];
    }
  }
  FT_Done_FreeType(library);
  constexpr double full = 255;
  return sum / full / pixels / pixels;
}

}  // namespace
