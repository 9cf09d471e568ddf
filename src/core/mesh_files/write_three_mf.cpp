// Writes 3MF files: 3MF Core Specification 1.3.0, with the base materials of chapter 5.
#include "core/mesh_files/surface_writers.hpp"
#include "core/mesh_files/zip_writer.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

constexpr std::string_view xml_head = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

constexpr std::string_view content_types =
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
    "</Types>\n";

constexpr std::string_view relationships =
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n"
    "</Relationships>\n";

constexpr std::uint64_t materials_id = 1;

std::string_view three_mf_unit(Unit unit) {
  switch (unit) {
    case Unit::m:
      return "meter";
    case Unit::cm:
      return "centimeter";
    case Unit::mm:
      return "millimeter";
    case Unit::in:
      break;
  }
  return "inch";
}

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += letter;
    }
  }
  return escaped;
}

void append_attribute(std::string& xml, std::string_view begin, double number) {
  xml += begin;
  append_number(xml, number);
  xml += '"';
}

void append_attribute(std::string& xml, std::string_view begin, std::uint32_t number) {
  xml += begin;
  append_number(xml, std::uint64_t{number});
  xml += '"';
}

void append_mesh(std::string& xml, const SurfaceMesh& mesh) {
  xml += "<mesh><vertices>\n";
  for (const Vec3& position : mesh.positions) {
    append_attribute(xml, "<vertex x=\"", position.x);
    append_attribute(xml, " y=\"", position.y);
    append_attribute(xml, " z=\"", position.z);
    xml += "/>\n";
  }
  xml += "</vertices><triangles>\n";
  for (const auto& [a, b, c] : mesh.triangles) {
    append_attribute(xml, "<triangle v1=\"", a);
    append_attribute(xml, " v2=\"", b);
    append_attribute(xml, " v3=\"", c);
    xml += "/>\n";
  }
  xml += "</triangles></mesh>";
}

/// Appends a material for each part that has a colour. Its number among them is the part's.
void append_materials(std::string& xml, const SurfaceFile& file) {
  xml += text::format("<basematerials id=\"{}\">\n", materials_id);
  for (const SurfacePart& part : file.parts) {
    const Color color = part.color.value_or(grey(1));
    xml += text::format("<base name=\"{}\" displaycolor=\"#{:02X}{:02X}{:02X}{:02X}\"/>\n",
                        xml_text(part.name), srgb_of(color.r), srgb_of(color.g), srgb_of(color.b),
                        byte_of(color.a));
  }
  xml += "</basematerials>\n";
}

std::string model_of(const SurfaceFile& file) {
  std::string xml = text::format(
      "{}<model unit=\"{}\" xml:lang=\"en\" "
      "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
      "<metadata name=\"Application\">CRT</metadata>\n"
      "<metadata name=\"Description\">{}</metadata>\n<resources>\n",
      xml_head, three_mf_unit(file.unit), deviation_text(file));
  append_materials(xml, file);
  std::uint64_t id = materials_id;
  std::string items;
  for (std::size_t i = 0; i < file.parts.size(); ++i) {
    const SurfacePart& part = file.parts[i];
    ++id;
    xml += text::format("<object id=\"{}\" type=\"model\" name=\"{}\"", id, xml_text(part.name));
    if (part.color) xml += text::format(" pid=\"{}\" pindex=\"{}\"", materials_id, i);
    xml += '>';
    append_mesh(xml, *part.mesh);
    xml += "</object>\n";
    items += text::format("<item objectid=\"{}\"/>\n", id);
  }
  return xml + "</resources>\n<build>\n" + items + "</build>\n</model>\n";
}

}  // namespace

std::string three_mf_bytes(const SurfaceFile& file) {
  ZipWriter archive;
  archive.add("[Content_Types].xml", std::string(xml_head) + std::string(content_types));
  archive.add("_rels/.rels", std::string(xml_head) + std::string(relationships));
  archive.add("3D/3dmodel.model", model_of(file));
  return archive.finish();
}

}  // namespace crt::core
