// These tests read PLY files as programs write them, and broken ones.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const std::vector<TriangleIndices> square = {{0, 1, 2}, {0, 2, 3}};

const std::string vertices =
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string rows = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

std::string text_file(const std::string& header, const std::string& numbers = rows) {
  return "ply\nformat ascii 1.0\n" + header + "end_header\n" + numbers;
}

/// Returns a file with the square, whose corners have colours and whose list has these types.
template <class Count, class Index>
std::string binary_square(const char* count_name, const char* index_name, std::endian order) {
  std::string file = fmt::format(
      "ply\nformat binary_{}_endian 1.0\ncomment made by a test\nobj_info nothing\n"
      "element vertex 4\nproperty uchar red\nproperty double x\nproperty short s\n"
      "property float y\nproperty list ushort double weights\nproperty int z\n"
      "element face 1\nproperty float quality\nproperty list {} {} vertex_index\n"
      "property list uchar float texcoord\nelement edge 2\nproperty int32 vertex1\n"
      "property uint16 vertex2\nend_header\n",
      order == std::endian::little ? "little" : "big", count_name, index_name);
  const float places[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    file += '\x7f' + packed(static_cast<double>(places[i][0]), order) +
            packed(std::int16_t{-1}, order) + packed(places[i][1], order) +
            packed(static_cast<std::uint16_t>(i), order) +
            repeated(packed(0.5, order), static_cast<std::size_t>(i)) +
            packed(std::int32_t{-3}, order);
  }
  file += packed(1.0f, order) + packed(Count{4}, order);
  for (const int corner : {0, 1, 2, 3}) file += packed(static_cast<Index>(corner), order);
  file += '\0' + repeated(packed(std::int32_t{7}, order) + packed(std::uint16_t{7}, order), 2);
  return file;
}

template <class Count, class Index>
void check_types(const char* count_name, const char* index_name) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const MeshFile file = decode(binary_square<Count, Index>(count_name, index_name, order));
    CHECK(file.triangles == square);
    CHECK(file.positions[2] == Vec3(1, 1, -3));
  }
}

}  // namespace

TEST_CASE("lists have counts and indices of all types") {
  check_types<std::uint8_t, std::int32_t>("uchar", "int");
  check_types<std::int8_t, std::uint32_t>("char", "uint");
  check_types<std::uint16_t, std::int16_t>("ushort", "short");
  check_types<std::int16_t, std::uint16_t>("int16", "uint16");
  check_types<std::uint32_t, std::uint8_t>("uint32", "uint8");
  check_types<std::int32_t, std::int8_t>("int32", "int8");
  check_types<float, double>("float32", "float64");
  check_types<double, float>("double", "float");
}

TEST_CASE("texts have elements in any lines, and other elements are left alone") {
  CHECK(decode(text_file(vertices + faces)).triangles == square);
  CHECK(decode(text_file("element material 1\nproperty list int float a\nproperty int b\n" +
                             vertices + faces + "element empty 7\n",
                         "3 1 2 3\n9 " + rows))
            .triangles == square);
  std::string crlf;
  for (const char c : text_file(vertices + faces)) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(decode(crlf).triangles == square);
  CHECK(
      decode(text_file(vertices + faces, "0.1 0 0 1 0 0 1\n1 0 0 1 0 4 0 1 2 3")).positions[0].x ==
      0.1);
}

TEST_CASE("a binary file's header may end its lines with two bytes") {
  std::string file = binary_square<std::uint8_t, std::int32_t>("uchar", "int", std::endian::little);
  std::string crlf;
  const std::size_t header = file.find("end_header\n") + 11;
  for (const char c : file.substr(0, header)) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(decode(crlf + file.substr(header)).triangles == square);
  CHECK(decode(file + "\r\n").triangles == square);
}

TEST_CASE("what is wrong with a PLY file's header is said with its line") {
  const auto header_error = [](const std::string& lines) {
    return decode_error("ply\n" + lines + "end_header\n");
  };
  CHECK(decode_error("ply\n") == "line 2: the header has no end: there is no line 'end_header'");
  CHECK(header_error("") == "line 2: the header has no line 'format'");
  CHECK(header_error("format ascii 2.0\n") ==
        "line 2: the version is '2.0'; CRT reads version 1.0");
  CHECK(header_error("format binary 1.0\n") ==
        "line 2: the format is 'binary'; it should be ascii, binary_little_endian or "
        "binary_big_endian");
  CHECK(header_error("property float x\n") == "line 2: a property stands before the first element");
  CHECK(header_error("element vertex -1\n") ==
        "line 2: an element needs a name and a number of rows, and here the number is '-1'");
  CHECK(header_error("element vertex 1\nproperty half x\n") ==
        "line 3: 'half' is no type of PLY files: they have char, uchar, short, ushort, int, uint, "
        "float and double");
  CHECK(header_error("element vertex 1\nproperty float\n") == "line 3: a property has no name");
  CHECK(header_error("vertex 1\n") ==
        "line 2: a line of the header begins with 'vertex'; it should be format, element, property "
        "or comment");
  CHECK(decode_error(text_file(faces, "")).find("no element 'vertex'") == std::string::npos);
  CHECK(decode_error(text_file("")) == "it has no element 'vertex'");
  CHECK(decode_error(text_file(vertices, "0 0 0 1 0 0 1 1 0 0 1 0")) ==
        "it has no element 'face' or 'tristrips', so it has points and no surface");
  CHECK(decode_error(text_file("element vertex 1\nproperty float x\n" + faces)) ==
        "its vertices have no property 'y'");
  CHECK(decode_error(text_file(vertices + "element face 1\nproperty int vertex_indices\n")) ==
        "its faces have no list 'vertex_indices'");
  CHECK(decode_error(text_file(faces + vertices, "4 0 1 2 3 0 0 0 0 0 0 0 0 0 0 0 0")) ==
        "line 10: a corner is vertex 0; it should be a whole number from 0, less than 0");
}

TEST_CASE("what is wrong with a PLY file's rows is said with its line or byte") {
  const auto error = [](const std::string& numbers) {
    return decode_error(text_file(vertices + faces, numbers));
  };
  const std::string good = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  CHECK(error("0 0 0\n1 0 0\n1 1 nan\n0 1 0\n4 0 1 2 3\n") ==
        "line 12: the coordinate z of a vertex is not finite");
  CHECK(error("0 0 0\n1 0 0\n1 1 1e101\n0 1 0\n4 0 1 2 3\n") ==
        "line 12: the coordinate z of a vertex is beyond 1e100");
  CHECK(error(good + "3 0 1 4\n") ==
        "line 14: a corner is vertex 4; it should be a whole number from 0, less than 4");
  CHECK(error(good + "3 0 1 -1\n").find("vertex -1") != std::string::npos);
  CHECK(error(good + "3 0 1 1.5\n").find("vertex 1.5") != std::string::npos);
  CHECK(error(good + "2 0 1\n") == "line 14: a face needs at least three corners, and here are 2");
  CHECK(error(good + "-3 0 1 2\n") ==
        "line 14: a list of -3 numbers: it should be a whole number from 0");
  CHECK(error(good + "nan 0 1 2\n").find("a list of nan numbers") != std::string::npos);
  CHECK(error(good + "4000000000 0 1 2\n") ==
        "line 14: a list of 4000000000 numbers, and the file has room for 4 at most");
  CHECK(error(good + "4 0 1 2\n") == "line 15: the file ends where a number should be");
  CHECK(error(good + "x 0 1 2\n") == "line 14: a number is 'x', which is no number");
  CHECK(error(rows + "1 2 3\n") == "line 15: after this there is more than the header says");
}

TEST_CASE("a PLY file that claims more than it holds costs nothing") {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string start = fmt::format("ply\nformat {} 1.0\n", format);
    const std::string much = "element vertex 9000000000000000000\n";
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    CHECK(decode_error(start + much + xyz + faces + "end_header\n0 0 0\n")
              .find("rows of 'vertex', and the file has room for") != std::string::npos);
    CHECK(decode_error(start + "element a 9000000000000000000\n" + much + "end_header\n") != "");
    CHECK(decode_error(start + "element a 9000000000000000000\nproperty list uchar int b\n" +
                       "end_header\n" + std::string(100, '\0')) != "");
  }
  const std::string file =
      binary_square<std::uint8_t, std::int32_t>("uchar", "int", std::endian::little);
  for (std::size_t size = 0; size < file.size(); ++size)
    CHECK(decode_error(file.substr(0, size), "a.ply") != "");
}

TEST_CASE("vertices have normals and texture coordinates by any of their names") {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
  for (const auto& [u, v] : {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}}) {
    const std::string header = fmt::format(
        "element vertex 3\nproperty float nz\n{}property float {}\nproperty float nx\n"
        "property double ny\nproperty float {}\n",
        xyz, v, u);
    const MeshFile file = decode(text_file(
        header + faces, "3 0 0 0 0.5 1 2 0.25\n6 1 0 0 7 4 5 8\n9 0 1 0 11 7 8 10\n3 2 1 0\n"));
    const MeshAttributes& attributes = file.attributes;
    CHECK(attributes.normals == std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
    CHECK(attributes.normal_indices == std::vector<TriangleIndices>{{2, 1, 0}});
    CHECK(attributes.uv == std::vector<std::array<double, 2>>{{0.25, 0.5}, {8, 7}, {10, 11}});
    CHECK(attributes.uv_indices == std::vector<TriangleIndices>{{2, 1, 0}});
  }
  // Two components are no normal, and a list is no component.
  const std::string header = "element vertex 3\n" + xyz +
                             "property float nx\nproperty float ny\n"
                             "property list uchar float nz\nproperty float u\n";
  const MeshFile file = decode(
      text_file(header + faces, "0 0 0 nan 2 1 3 nan\n1 0 0 1 2 0 4\n0 1 0 1 2 0 4\n3 0 1 2\n"));
  CHECK(file.attributes.normals.empty());
  CHECK(file.attributes.uv.empty());
}

TEST_CASE("a normal or texture coordinate that is not finite is refused at its line") {
  const std::string header =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nproperty float u\n"
      "property float v\n";
  CHECK(decode_error(text_file(header + faces, "0 0 0 0 nan 0 0 0\n")) ==
        "line 15: ny of a vertex is nan; it should be at most 1e+100 in magnitude");
  CHECK(decode_error(text_file(header + faces, "0 0 0 0 0 1 inf 0\n")) ==
        "line 15: u of a vertex is inf; it should be at most 1e+30 in magnitude");
}

TEST_CASE("vertices in two tables have normals if both tables have them") {
  const std::string table =
      "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";
  const MeshFile mixed = decode(text_file(table + normals + table + faces,
                                          "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0\n1 1 0\n3 0 1 3\n"));
  CHECK(mixed.attributes.normals.empty());
  const MeshFile both =
      decode(text_file(table + normals + table + normals + faces,
                       "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n1 1 0 0 0 2\n3 0 1 3\n"));
  CHECK(both.attributes.normals.size() == 4);
}

TEST_CASE("triangle strips are turned in turns, and end at -1") {
  const std::string header =
      vertices + "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string places = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const auto triangles = [&](const std::string& strip) {
    return decode(text_file(header, places + strip)).triangles;
  };
  using List = std::vector<TriangleIndices>;
  CHECK(triangles("4 0 1 2 3\n") == List{{0, 1, 2}, {2, 1, 3}});
  CHECK(triangles("9 0 1 2 -1 -1 3 2 1 -1\n") == List{{0, 1, 2}, {3, 2, 1}});
  // Two equal vertices in a row turn what follows.
  CHECK(triangles("5 0 1 1 2 3\n") == List{{1, 2, 3}});
  CHECK(decode_error(text_file(header, places + "2 0 1\n")) == "it has no faces");
  CHECK(decode_error(text_file(header, places + "3 0 1 4\n")) ==
        "line 14: a corner is vertex 4; it should be a whole number from 0, less than 4");
  CHECK(decode_error(text_file(header, places + "3 0 1 -2\n")).find("vertex -2") !=
        std::string::npos);
  CHECK(
      decode_error(text_file(vertices + "element tristrips 1\nproperty int a\n", places + "1\n")) ==
      "its triangle strips have no list 'vertex_indices'");
  // Faces may stand beside them.
  CHECK(decode(text_file(header + faces, places + "3 0 1 2\n3 1 3 2\n")).triangles ==
        List{{0, 1, 2}, {1, 3, 2}});
}

TEST_CASE("a cube of one strip, as scanners write them, is closed and turned one way") {
  const std::string header =
      "element vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\n"
      "property list int int vertex_indices\n";
  const std::string places = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n1 1 1\n";
  const MeshFile file = decode(text_file(header, places + "14 6 7 4 5 1 7 3 6 2 4 0 1 2 3\n"));
  CHECK(file.triangles.size() == 12);
  const Entity entity = load_mesh(file, "it");
  CHECK(entity.is_solid());
  // Else the nonzero rule would not be chosen.
  CHECK(mesh_report(entity)->fill == FillRule::nonzero);
}
