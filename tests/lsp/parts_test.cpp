// These tests check the parts of the server that cut and name: frames and URIs.
#include <doctest/doctest.h>

#include <string>

#include "lsp/frames.hpp"
#include "lsp/uri.hpp"

using namespace crt::lsp;

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
