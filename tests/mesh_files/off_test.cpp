// These tests read OFF files as programs write them, and broken ones.
#include <doctest/doctest.h>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {
const std::vector<TriangleIndices> square = {{0, 1, 2}, {0, 2, 3}};
const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
}  // namespace

TEST_CASE("OFF files have comments, colours and counts in several ways") {
  CHECK(decode("OFF\n4 1 4\n" + rows).triangles == square);
  CHECK(decode("# made\n\nOFF # by\n# hand\n4 1 # counts\n\n0 0 0 # first\n1 0 0\n\n1 1 0\n0 1 0\n"
               "4 0 1 2 3 255 0 0 # red\n")
            .triangles == square);
  CHECK(decode("OFF 4 1 0\r\n" + rows).triangles == square);
  CHECK(decode("OFF4 1 0\n" + rows).triangles == square);
}

TEST_CASE("vertices may have colours, normals and texture coordinates") {
  const std::string colours =
      "4 1 4\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n1 1 0 9 9 9 9\n0 1 0 1 1 1 1\n4 0 1 2 3\n";
  CHECK(decode("COFF\n" + colours).triangles == square);
  CHECK(decode("STCNOFF\n" + colours).triangles == square);
  CHECK(decode("NOFF\n4 1 4\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n")
            .triangles == square);
}

TEST_CASE("without the word OFF a file is read if its name says that it is one, with a warning") {
  for (const std::string begin : {"4 1 4\n", "# made\n\n4 1\n"}) {
    const MeshFile file = decode(begin + rows, "a.off");
    CHECK(file.format == MeshFormat::off);
    CHECK(file.triangles == square);
    REQUIRE(file.warnings.size() == 1);
    CHECK(file.warnings[0].ends_with(
        "it does not begin with the word OFF, but is read as if it did"));
  }
  CHECK(decode("OFF\n4 1 4\n" + rows).warnings.empty());
  CHECK(decode_error("4 1 4\n" + rows, "a.mesh") == "it is no OBJ, PLY, STL, 3MF or OFF file");
  CHECK(decode_error("x 1 4\n" + rows, "a.off") == "line 1: it does not begin with the word OFF");
}

TEST_CASE("what is wrong with an OFF file is said with its line") {
  const auto error = [](const std::string& text) { return decode_error(text, "a.off"); };
  CHECK(error("4OFF\n4 1 0\n") ==
        "line 1: '4OFF' has vertices of other than three coordinates; CRT reads OFF, with C, N and "
        "ST before it");
  CHECK(error("nOFF\n3\n4 1 0\n").find("'nOFF'") != std::string::npos);
  CHECK(error("OFF BINARY\n") == "line 1: it is a binary OFF file; CRT reads those that are text");
  CHECK(error("OFF\n") == "line 2: the file ends where the number of vertices should be");
  CHECK(error("OFF\n4\n") == "line 3: the file ends where the number of faces should be");
  CHECK(error("OFF\n4 x\n") == "line 2: the number of faces is 'x', which is no integer");
  CHECK(error("OFF\n4 -1\n") == "line 2: a number of vertices or faces is negative");
  CHECK(error("OFF\n4 1 0\n0 0 0\n") == "line 4: the file ends after 1 of 4 vertices");
  CHECK(error("OFF\n9000000000000000000 9000000000000000000 0\n0 0 0\n") ==
        "line 4: the file ends after 1 of 9000000000000000000 vertices");
  CHECK(error("OFF\n4 2 0\n" + rows) == "line 8: the file ends after 1 of 2 faces");
  CHECK(error("OFF\n4 1 0\n" + rows + "3 0 1 2\n") ==
        "line 8: there is more than the 4 vertices and 1 faces that the file begins with");
  CHECK(error("OFF\n3 1 0\n" + rows) ==
        "line 6: a face needs at least three corners, and here it is 0");
  CHECK(error("OFF\n1 1 0\n0 0 0\n3 0 0 1\n") ==
        "line 4: a corner is '1'; it should be between 0 and 0");
  CHECK(error("OFF\n1 1 0\n0 0 0\n3 0 0 -1\n").find("a corner is '-1'") != std::string::npos);
  CHECK(error("OFF\n1 1 0\n0 0 0\n4 0 0 0\n0\n") ==
        "line 4: a face has 4 corners, and the line only 3");
  CHECK(error("OFF\n1 1 0\n0 0 1e101\n3 0 0 0\n") ==
        "line 3: the coordinate '1e101' is beyond 1e100");
}
