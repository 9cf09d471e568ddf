// These tests read STL files as programs write them, and broken ones.
#include <doctest/doctest.h>

#include <limits>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const std::vector<TriangleIndices> one = {{0, 1, 2}};

const std::string facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string binary(const std::string& header, std::uint32_t claimed, int triangles,
                   float coordinate = 1) {
  std::string file = header;
  file.resize(80, '\0');
  file += packed(claimed);
  for (int i = 0; i < triangles; ++i) {
    for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, coordinate, 0.f, 0.f, 0.f, 1.f, 0.f})
      file += packed(value);
    file += packed(std::uint16_t{0x1234});
  }
  return file;
}

}  // namespace

TEST_CASE("words of a text are in any case, with any blanks between them") {
  CHECK(decode("solid a\n" + facet + "endsolid a\n").triangles == one);
  CHECK(decode("SOLID\n  FACET NORMAL 0 0 1  OUTER LOOP\n\n\tVERTEX 0 0 0\tVERTEX 1\n0 0\n"
               "VERTEX 0 1 0 ENDLOOP ENDFACET\r\nENDSOLID")
            .triangles == one);
  CHECK(decode("  solid facet\n" + facet + "endsolid\nsolid second\n" + facet + "endsolid\n")
            .triangles.size() == 2);
}

TEST_CASE("normals need not be numbers") {
  std::string text = "solid a\n" + facet + "endsolid a\n";
  text.replace(text.find("0 0 1"), 5, "nan -nan(ind) 1,5");
  CHECK(decode(text).triangles == one);
}

TEST_CASE("a binary file may begin with the word of a text") {
  CHECK(decode(binary("", 1, 1)).triangles == one);
  CHECK(decode(binary("solid exported\n", 1, 1)).triangles == one);
  CHECK(decode(binary("solid\nfacet normal", 1, 1)).triangles == one);
}

TEST_CASE("triangles with equal corners are dropped and counted") {
  const MeshFile file = decode(binary("", 2, 1) + binary("", 0, 1, 0).substr(84));
  CHECK(file.triangles == one);
  CHECK(file.dropped_triangles == 1);
}

TEST_CASE("what is wrong with an STL file is said with its line or byte") {
  const auto error = [](const std::string& text) { return decode_error(text, "a.stl"); };
  CHECK(error("solid a\n") == "line 2: the file ends where facet or endsolid should be");
  CHECK(error("solid a\nendsolid a\n") == "it has no faces");
  CHECK(error("solid a\n" + facet) == "line 9: the file ends where facet or endsolid should be");
  CHECK(error("solid a\n" + facet.substr(0, 40)).find("the file ends where") != std::string::npos);
  CHECK(error("solid a\nfacet\nfacet\n") == "line 3: here is 'facet' where outer loop should be");
  std::string four = facet;
  four.insert(four.find("endloop"), "vertex 1 1 0\n");
  CHECK(error("solid a\n" + four + "endsolid") ==
        "line 7: here is 'vertex' where endloop should be");
  std::string letters = facet;
  letters.replace(letters.find("1 0 0"), 1, "l");
  CHECK(error("solid a\n" + letters) == "line 5: a coordinate is 'l', which is no number");
  letters.replace(letters.find("vertex l") + 7, 1, "inf");
  CHECK(error("solid a\n" + letters) == "line 5: a coordinate is not finite");
  CHECK(error("more\n") ==
        "it has 5 bytes; a binary STL file begins with a header of 84, and text "
        "with 'solid'");
  CHECK(error(binary("", 0, 0)) == "it has no faces");
  CHECK(error(binary("", 1, 1, std::numeric_limits<float>::quiet_NaN())) ==
        "byte 108: a coordinate of triangle 0 is not finite");
  CHECK(error(binary("", 0x80000000, 1)) ==
        "byte 80: the file says that it has 2147483648 triangles, which take 107374182484 bytes; "
        "but it has 134 bytes, which are 1 triangles");
  CHECK(error(binary("solid", 5, 2) + "xx").find("2 triangles and a part of one") !=
        std::string::npos);
}

TEST_CASE("a wrong count of triangles and what stands behind them are warnings") {
  const auto read = [](const std::string& text, std::size_t triangles) {
    const MeshFile file = decode(text, "a.stl");
    REQUIRE(file.warnings.size() == 1);
    // Triangles that are the same are all read.
    CHECK(file.triangles.size() == triangles);
    return file.warnings[0];
  };
  CHECK(
      read(binary("", 0, 2), 2) ==
      "byte 80: the file says that it has 0 triangles, which take 84 bytes; but it has 184 bytes, "
      "which are 2 triangles: it is read as 2");
  CHECK(read(binary("", 0xffffffff, 2), 2).ends_with("it is read as 2"));
  CHECK(read(binary("", 1, 2), 2).ends_with("it is read as 2"));
  CHECK(read(binary("", 3, 2), 2).ends_with("it is read as 2"));
  CHECK(
      read(binary("", 3, 2) + "xx", 2).ends_with("2 triangles and a part of one: it is read as 2"));
  CHECK(read(binary("", 2, 2) + "xx", 2).ends_with("it is read as 2"));
  CHECK(read(binary("", 1, 2) + "xx", 1).ends_with("it is read as 1"));
  CHECK(read("solid a\n" + facet + "endsolid a\nmore\nand more\n", 1) ==
        "line 10: here is 'more' where solid or the end should be: it is left out, with all that "
        "follows");
  CHECK(decode(binary("", 2, 2), "a.stl").warnings.empty());
}
