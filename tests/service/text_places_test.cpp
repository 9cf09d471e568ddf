// These tests check that places of a text translate: bytes, units of UTF-16, lines and columns.
#include <doctest/doctest.h>

#include <crt/text_places.hpp>
#include <string>
#include <string_view>

using namespace crt;

namespace {

// The lines have a letter of two bytes, and one of four bytes that is two units of UTF-16.
constexpr std::string_view text = "a\r\n\xC3\xA9\xF0\x9D\x84\x9Ez\rb";

}  // namespace

TEST_CASE("bytes become lines with columns and back, whatever columns count") {
  const TextPlaces places(text);
  struct Place {
    std::uint32_t byte;
    LineColumn utf8;
    LineColumn utf16;
    std::uint32_t unit;
  };
  for (const Place& place :
       {Place{0, {0, 0}, {0, 0}, 0}, Place{1, {0, 1}, {0, 1}, 1}, Place{3, {1, 0}, {1, 0}, 3},
        Place{5, {1, 2}, {1, 1}, 4}, Place{9, {1, 6}, {1, 3}, 6}, Place{10, {1, 7}, {1, 4}, 7},
        Place{11, {2, 0}, {2, 0}, 8}, Place{12, {2, 1}, {2, 1}, 9}}) {
    CAPTURE(place.byte);
    CHECK(places.position_of(place.byte, ColumnUnit::utf8) == place.utf8);
    CHECK(places.position_of(place.byte, ColumnUnit::utf16) == place.utf16);
    CHECK(places.byte_at(place.utf8, ColumnUnit::utf8) == place.byte);
    CHECK(places.byte_at(place.utf16, ColumnUnit::utf16) == place.byte);
    CHECK(places.unit_of(place.byte) == place.unit);
    CHECK(places.byte_of(place.unit) == place.byte);
  }
}

TEST_CASE("a place within a character or a line's end is its beginning") {
  const TextPlaces places(text);
  CHECK(places.byte_at({1, 2}, ColumnUnit::utf16) == 5);
  CHECK(places.byte_of(5) == 5);
  CHECK(places.unit_of(7) == 4);
  CHECK(places.position_of(2, ColumnUnit::utf16) == LineColumn{0, 1});
}

TEST_CASE("a place behind a line or the text is the end") {
  const TextPlaces places(text);
  CHECK(places.byte_at({0, 99}, ColumnUnit::utf16) == 1);
  CHECK(places.byte_at({0, 99}, ColumnUnit::utf8) == 1);
  CHECK(places.byte_at({99, 0}, ColumnUnit::utf8) == 12);
  CHECK(places.byte_at({1, 0xffffffff}, ColumnUnit::utf16) == 10);
  CHECK(places.position_of(0xffffffff, ColumnUnit::utf16) == LineColumn{2, 1});
  CHECK(places.unit_of(0xffffffff) == 9);
  CHECK(places.byte_of(0xffffffff) == 12);
  CHECK(TextPlaces("").position_of(1, ColumnUnit::utf8) == LineColumn{0, 0});
}

TEST_CASE("what a diagnostic marks is found by code points, and stays on its line") {
  const TextPlaces places(text);
  CHECK(places.span_of({.line = 2, .column = 2, .length = 2}) == TextSpan{5, 10});
  CHECK(places.span_of({.line = 2, .column = 3, .length = 9}) == TextSpan{9, 10});
  CHECK(places.span_of({.line = 1, .column = 2}) == TextSpan{1, 1});
  CHECK(places.span_of({.line = 9, .column = 1}) == TextSpan{12, 12});
  CHECK(places.span_of({}) == TextSpan{0, 1});
}

TEST_CASE("bytes that are not UTF-8 are a unit each, as a diagnostic counts them") {
  const std::string broken =
      "\xF0\x9D"
      "a\x84"
      "b";
  const TextPlaces places(broken);
  for (std::uint32_t i = 0; i <= broken.size(); ++i) CHECK(places.unit_of(i) == i);
  CHECK(places.span_of({.line = 1, .column = 4}) == TextSpan{3, 4});
}
