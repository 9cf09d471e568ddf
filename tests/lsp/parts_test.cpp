// These tests check the parts of the server that count and cut: frames, positions, URIs.
#include <doctest/doctest.h>

#include <string>

#include "lsp/frames.hpp"
#include "lsp/positions.hpp"
#include "lsp/uri.hpp"

using namespace crt::lsp;

TEST_CASE("bytes become positions and positions bytes, in both encodings") {
  crt::lang::SourceMap sources;
  // The lines have a letter of two bytes, and one of four bytes that is two units of UTF-16.
  const crt::lang::Source& source = sources.add("test", "a\r\n\xC3\xA9\xF0\x9D\x84\x9Ez\rb");
  struct Place {
    std::uint32_t byte;
    Position utf8;
    Position utf16;
  };
  for (const Place& place :
       {Place{0, {0, 0}, {0, 0}}, Place{1, {0, 1}, {0, 1}}, Place{3, {1, 0}, {1, 0}},
        Place{5, {1, 2}, {1, 1}}, Place{9, {1, 6}, {1, 3}}, Place{10, {1, 7}, {1, 4}},
        Place{11, {2, 0}, {2, 0}}, Place{12, {2, 1}, {2, 1}}}) {
    CAPTURE(place.byte);
    CHECK(position_of(source, place.byte, Encoding::utf8) == place.utf8);
    CHECK(position_of(source, place.byte, Encoding::utf16) == place.utf16);
    CHECK(byte_at(source, place.utf8, Encoding::utf8) == place.byte);
    CHECK(byte_at(source, place.utf16, Encoding::utf16) == place.byte);
  }
  // Within the two units, behind the line, behind the text.
  CHECK(byte_at(source, {1, 2}, Encoding::utf16) == 5);
  CHECK(byte_at(source, {0, 99}, Encoding::utf16) == 1);
  CHECK(byte_at(source, {99, 0}, Encoding::utf8) == 12);
  CHECK(position_of(source, 99, Encoding::utf16) == Position{2, 1});
}

TEST_CASE("a stream of bytes is cut into messages, however the pieces come") {
  const std::string stream = framed("one") + framed("") + framed("three");
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    FrameReader reader;
    std::string bodies;
    for (std::size_t i = 0; i < stream.size(); i += piece) {
      reader.add(stream.substr(i, piece));
      while (const auto frame = reader.next()) {
        CHECK(frame->problem.empty());
        bodies += frame->body + ";";
      }
    }
    CHECK(bodies == "one;;three;");
  }
}

TEST_CASE("a header without a length is reported, and the next message is read") {
  FrameReader reader;
  reader.add("Nonsense: 3\r\n\r\n" + framed("next"));
  CHECK_FALSE(reader.next()->problem.empty());
  CHECK(reader.next()->body == "next");
  CHECK_FALSE(reader.next().has_value());
}

TEST_CASE("paths and URIs of files translate into each other") {
  CHECK(path_of("file:///a/b%20c/%C3%A9.crt") == "/a/b c/\xC3\xA9.crt");
  CHECK(uri_of("/a/b c/\xC3\xA9.crt") == "file:///a/b%20c/%C3%A9.crt");
  CHECK(path_of("file://localhost/a.crt") == "/a.crt");
  for (const char* other : {"untitled:Untitled-1", "http://x/a.crt", "file://elsewhere/a.crt",
                            "file:///a%00b", "file:///a%zz", ""})
    CHECK(path_of(other).empty());
}
