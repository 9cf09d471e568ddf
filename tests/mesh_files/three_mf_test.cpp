// These tests read 3MF files as programs write them, and broken ones.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include "mesh_texts.hpp"

using namespace crt;
using namespace crt::test;

namespace {

const std::vector<TriangleIndices> one = {{0, 1, 2}};

const std::string vertices =
    "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices>";
const std::string triangles = "<triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles>";

std::string object(int id, const std::string& content) {
  return fmt::format("<object id=\"{}\">{}</object>\n", id, content);
}
const std::string mesh = "<mesh>" + vertices + triangles + "</mesh>";

std::string components(const std::vector<std::string>& list) {
  std::string text = "<components>";
  for (const std::string& attributes : list) text += "<component " + attributes + "/>";
  return text + "</components>";
}

const std::string item = "<item objectid=\"1\"/>";

std::string error(const std::string& resources, const std::string& build = item) {
  return decode_error(three_mf(model(resources, build)), "a.3mf");
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

}  // namespace

TEST_CASE("the build places objects, also several and moved ones") {
  CHECK(decode(three_mf(model(object(1, mesh), item))).triangles == one);
  const MeshFile file = decode(three_mf(model(
      object(1, mesh), "<item objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 5 6 7\"/>" + item)));
  CHECK(file.triangles.size() == 2);
  CHECK(file.positions[1] == Vec3(6, 6, 7));
  CHECK(file.positions[3] == Vec3(0, 0, 0));
}

TEST_CASE("components are placed within components, and mirrored ones stay outside out") {
  const MeshFile file = decode(three_mf(
      model(object(1, mesh) +
                object(2, components({"objectid=\"1\" transform=\"0 1 0 1 0 0 0 0 1 0 0 0\"",
                                      "objectid=\"1\""})) +
                object(3, components({"objectid=\"2\" transform=\"2 0 0 0 2 0 0 0 2 10 0 0\""})),
            "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 0 0 3\"/>")));
  const std::vector<Vec3> positions = {{10, 0, 3}, {10, 2, 3}, {12, 0, 3}};
  const std::vector<TriangleIndices> faces = {{0, 2, 1}, {0, 2, 1}};
  CHECK(file.positions == positions);
  CHECK(file.triangles == faces);
}

TEST_CASE("the package names its model, whose objects may lie in other parts") {
  const std::string relations =
      "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
      "<Relationship Target=\"/3D/Box.model\" Id=\"rel0\" "
      "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>";
  const std::string file = zip_archive(
      {{.name = "[Content_Types].xml", .content = "<Types/>"},
       {.name = "_rels/.rels", .content = relations, .deflate = false},
       {.name = "3D/box.model",
        .content = model(object(2, components({"objectid=\"1\" p:path=\"/3D/Objects/a.model\""})),
                         "<item objectid=\"2\"/>")},
       {.name = "3D/Objects/a.model", .content = model(object(1, mesh), "")}},
      "a comment");
  CHECK(decode(file).triangles == one);
}

TEST_CASE("what extensions and other tags have is left alone") {
  const std::string text =
      "<metadata name=\"Title\">a &amp; b</metadata><!-- <vertex/> -->"
      "<s:slicestack xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\">"
      "<s:vertex x=\"nan\"/></s:slicestack><basematerials id=\"9\"/>";
  CHECK(decode(three_mf(model(text + object(1, mesh), item))).triangles == one);
}

TEST_CASE("what is wrong with a model is said with its part and line") {
  CHECK(error(object(1, "<mesh><vertices><vertex x=\"1\" y=\"2\"/>")) ==
        "'3D/3dmodel.model', line 4: <vertex> has no attribute 'z'");
  CHECK(contains(error(object(1, "<mesh><vertices><vertex x=\"1\" y=\"2\" z=\"inf\"/>")),
                 "line 4: the coordinate z 'inf' is not finite"));
  CHECK(contains(error(object(1, "<mesh><vertices><vertex x=\"1\" y=\"\" z=\"1\"/>")),
                 "line 4: the coordinate y '' is no number"));
  CHECK(contains(error("<vertex x=\"1\" y=\"1\" z=\"1\"/>"),
                 "line 4: <vertex> stands outside of an <object>"));
  CHECK(contains(
      error(object(1, "<mesh>" + vertices + "<triangle v1=\"0\" v2=\"1\" v3=\"3\"/></mesh>")),
      "line 4: v3 of <triangle> is '3'; the object has vertices from 0 to 2"));
  CHECK(contains(error(object(1, mesh) + object(1, mesh)),
                 "line 5: there are two objects with the id 1"));
  CHECK(contains(error(object(0, mesh)), "id of <object> is '0'; it should be a whole number"));
  CHECK(contains(error("<object>"), "<object> has no attribute 'id'"));
  CHECK(contains(error("<mesh>"), "line 4: it is no XML: mismatched tag"));
  CHECK(contains(error(object(1, mesh), "<item objectid=\"1\" transform=\"1 2 3\"/>"),
                 "a transform has ''; it should be 12 numbers"));
  CHECK(error(object(1, mesh), "") == "its build has no <item>, so it places no object");
  CHECK(error(object(2, mesh)) == "'3D/3dmodel.model' has no object with the id 1");
  CHECK(error(object(1, "")) == "it has no faces");
  CHECK(error(object(1, components({"objectid=\"1\" path=\"x\" p:path=\"/x\""}))) ==
        "it has no part 'x'");
  CHECK(contains(
      error(object(1, mesh), "<item objectid=\"1\" transform=\"1e99 0 0 0 1 0 0 0 1 1e100 0 0\"/>"),
      "a coordinate of a vertex in its place is beyond 1e100"));
}

TEST_CASE("a 3MF file cannot grow without bounds or nest without end") {
  CHECK(contains(error(object(1, components({"objectid=\"1\""}))),
                 "object 1 of '3D/3dmodel.model' is nested in others 64 deep, or in itself"));
  std::string doubling = object(100, mesh);
  for (int i = 99; i > 39; --i) {
    const std::string next = fmt::format("objectid=\"{}\"", i + 1);
    doubling += object(i, components({next, next}));
  }
  const std::string first = "<item objectid=\"40\"/>";
  CHECK(contains(error(doubling, first), "its components repeat objects so often"));
  doubling.replace(0, object(100, mesh).size(), object(100, ""));
  CHECK(contains(error(doubling, first), "its components repeat objects so often"));
  CHECK(contains(error(std::string(64 << 20, ' ')), "it unpacks to more than 100 times its size"));
  CHECK(contains(error("<!--" + repeated("abcdefghijk", 500000) + "-->"),
                 "a tag or comment is longer than 4 MB"));
  CHECK(contains(error(repeated("<a>", 1000)), "line 4: tags are nested more than 100 deep"));
  const std::string entities =
      "<!DOCTYPE m [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]><m>&b;</m>";
  CHECK(contains(decode_error(three_mf(entities)), "it has a document type (DOCTYPE)"));
}

TEST_CASE("an archive may have its numbers in 64 bits") {
  const std::string file = three_mf(model(object(1, mesh), item));
  const std::size_t end = file.size() - 22;
  const std::size_t list = file.rfind("PK\x01\x02");
  // The sizes and the place of the only file move into an extra field behind its name.
  std::string entry = file.substr(list, end - list);
  const std::string extra = packed(std::uint16_t{1}) + packed(std::uint16_t{24}) +
                            entry.substr(24, 4) + std::string(4, '\0') + entry.substr(20, 4) +
                            std::string(4, '\0') + std::string(8, '\0');
  entry.replace(20, 8, 8, '\xff');
  entry.replace(30, 2, packed(static_cast<std::uint16_t>(extra.size())));
  entry.replace(42, 4, 4, '\xff');
  using U64 = std::uint64_t;
  const std::string end_64 = "PK\x06\x06" + packed(U64{44}) + std::string(12, '\0') +
                             packed(U64{1}) + packed(U64{1}) +
                             packed(U64{entry.size() + extra.size()}) + packed(U64{list});
  const std::string locator = "PK\x06\x07" + std::string(4, '\0') +
                              packed(U64{list + entry.size() + extra.size()}) +
                              packed(std::uint32_t{1});
  const std::string begin = file.substr(0, list) + entry + extra + end_64;
  const std::string last =
      "PK\x05\x06" + std::string(4, '\0') + std::string(12, '\xff') + std::string(2, '\0');
  CHECK(decode(begin + locator + last).triangles == one);
  CHECK(decode_error(begin + "PK\x06\x07" + std::string(4, '\0') + std::string(8, '\xff') +
                     packed(std::uint32_t{1}) + last) != "");
}

TEST_CASE("a 3MF file that is no good archive is refused") {
  const std::string good = model(object(1, mesh), item);
  const std::string name = "3D/3dmodel.model";
  CHECK(contains(decode_error(zip_archive({{.name = "a", .content = good}})),
                 "it has no part '3D/3dmodel.model'"));
  CHECK(contains(decode_error(zip_archive({{.name = name, .content = good, .flags = 1}})),
                 "'3D/3dmodel.model' in it is encrypted"));
  CHECK(contains(decode_error(zip_archive({{.name = name, .content = good, .method = 12}})),
                 "is packed by method 12; CRT reads stored (0) and deflated (8)"));
  CHECK(contains(decode_error(zip_archive({{.name = name, .content = good, .wrong_checksum = 1}})),
                 "is not what was packed"));
  CHECK(contains(decode_error(zip_archive({{.name = name, .content = "<a/>"}})),
                 "it should begin with <model>"));
  std::string broken = three_mf(good);
  broken[60] = static_cast<char>(broken[60] ^ 0x55);
  CHECK(decode_error(broken) != "");
  const std::string file = three_mf(good);
  for (std::size_t size = 4; size < file.size(); ++size)
    CHECK(decode_error(file.substr(0, size)) != "");
}
