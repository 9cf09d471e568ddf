// Sections as drawings: SVG and DXF.
#include <algorithm>
#include <cmath>
#include <string>

#include "core/section/contour_arcs.hpp"
#include "core/section/hatching.hpp"
#include "crt/error.hpp"
#include "crt/file.hpp"
#include "crt/section.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

namespace {

/// A DrawingUnit is what files say of a unit.
struct DrawingUnit {
  const char* css;  ///< the unit that SVG has for lengths
  double in_css;    ///< how many of those it is
  double millimetres;
  int insunits;  ///< of DXF
};

DrawingUnit drawing_unit(Unit unit) {
  switch (unit) {
    case Unit::m:
      return {"mm", 1000, 1000, 6};
    case Unit::cm:
      return {"cm", 1, 10, 5};
    case Unit::mm:
      return {"mm", 1, 1, 4};
    case Unit::in:
      return {"in", 1, 25.4, 1};
  }
  throw Error(ErrorCode::invalid_argument, "there is no such unit", "unit");
}

void check(const SectionDrawing& drawing) {
  if (!(drawing.hatch >= 0 && std::isfinite(drawing.hatch)))
    throw Error(ErrorCode::invalid_argument, "the hatch must be 0 or above", "hatch");
  if (!(drawing.line_width >= 0 && std::isfinite(drawing.line_width)))
    throw Error(ErrorCode::invalid_argument, "the line width must be 0 or above", "line_width");
}

std::vector<HatchLine> hatch_lines(const Section& section, const SectionDrawing& drawing) {
  if (drawing.hatch == 0) return {};
  return hatching(section.contours, drawing.hatch);
}

/// Returns the ending of a name in small letters.
std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return ending;
}

/// Returns a coordinate that grows downwards in the picture.
double downwards(double y) {
  return 0 - y;
}

std::string path_of(const Contour& contour) {
  std::string text = text::format("M{} {}", contour.front().x, downwards(contour.front().y));
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPiece piece = piece_of(contour, i);
    const double x = piece.to.x;
    const double y = downwards(piece.to.y);
    if (piece.is_arc()) {
      text += text::format(" A{0} {0} 0 {1} {2} {3} {4}", piece.radius(),
                           std::abs(piece.bulge) > 1 ? 1 : 0, piece.bulge > 0 ? 0 : 1, x, y);
    } else if (i + 1 < contour.size()) {
      text += text::format(" L{} {}", x, y);
    }
  }
  return text + " Z";
}

/// Writes pairs of lines of DXF: a code and a value.
class DxfText {
 public:
  template <class Value>
  void add(int code, const Value& value) {
    text += text::format("{}\n{}\n", code, value);
  }
  void add_point(int first_code, double x, double y) {
    add(first_code, x);
    add(first_code + 10, y);
    add(first_code + 20, 0.0);
  }
  std::string text;
};

void add_header(const Section& section, const DrawingUnit& unit, DxfText& dxf) {
  dxf.add(999, "A section, written by CRT");
  dxf.add(0, "SECTION");
  dxf.add(2, "HEADER");
  dxf.add(9, "$ACADVER");
  dxf.add(1, "AC1009");
  dxf.add(9, "$INSUNITS");
  dxf.add(70, unit.insunits);
  dxf.add(9, "$MEASUREMENT");
  dxf.add(70, unit.insunits == 1 ? 0 : 1);
  dxf.add(9, "$EXTMIN");
  dxf.add_point(10, section.lower[0], section.lower[1]);
  dxf.add(9, "$EXTMAX");
  dxf.add_point(10, section.upper[0], section.upper[1]);
  dxf.add(0, "ENDSEC");
}

void add_layers(DxfText& dxf) {
  dxf.add(0, "SECTION");
  dxf.add(2, "TABLES");
  dxf.add(0, "TABLE");
  dxf.add(2, "LTYPE");
  dxf.add(70, 1);
  dxf.add(0, "LTYPE");
  dxf.add(2, "CONTINUOUS");
  dxf.add(70, 0);
  dxf.add(3, "Solid line");
  dxf.add(72, 65);
  dxf.add(73, 0);
  dxf.add(40, 0.0);
  dxf.add(0, "ENDTAB");
  dxf.add(0, "TABLE");
  dxf.add(2, "LAYER");
  dxf.add(70, 3);
  for (const char* const name : {"0", "SECTION", "HATCH"}) {
    dxf.add(0, "LAYER");
    dxf.add(2, name);
    dxf.add(70, 0);
    dxf.add(62, 7);
    dxf.add(6, "CONTINUOUS");
  }
  dxf.add(0, "ENDTAB");
  dxf.add(0, "ENDSEC");
}

void add_contour(const Contour& contour, DxfText& dxf) {
  dxf.add(0, "POLYLINE");
  dxf.add(8, "SECTION");
  dxf.add(66, 1);
  dxf.add_point(10, 0, 0);
  dxf.add(70, 1);
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPiece piece = piece_of(contour, i);
    dxf.add(0, "VERTEX");
    dxf.add(8, "SECTION");
    dxf.add_point(10, piece.from.x, piece.from.y);
    // Here it is that of the piece which begins at the corner.
    if (piece.is_arc()) dxf.add(42, piece.bulge);
  }
  dxf.add(0, "SEQEND");
  dxf.add(8, "SECTION");
}

}  // namespace

}  // namespace core

std::string section_svg(const Section& section, const SectionDrawing& drawing) {
  core::check(drawing);
  const core::DrawingUnit unit = core::drawing_unit(drawing.unit);
  const double stroke = drawing.line_width / unit.millimetres;
  const double width = section.upper[0] - section.lower[0] + 2 * stroke;
  const double height = section.upper[1] - section.lower[1] + 2 * stroke;
  std::string text = text::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}{}\" height=\"{}{}\" "
      "viewBox=\"{} {} {} {}\">\n",
      width * unit.in_css, unit.css, height * unit.in_css, unit.css, section.lower[0] - stroke,
      core::downwards(section.upper[1]) - stroke, width, height);
  const std::vector<core::HatchLine> hatch = core::hatch_lines(section, drawing);
  if (!hatch.empty()) {
    text +=
        text::format("<path fill=\"none\" stroke=\"black\" stroke-width=\"{}\" d=\"", 0.5 * stroke);
    for (const core::HatchLine& line : hatch) {
      text += text::format("{}M{} {} L{} {}", &line == hatch.data() ? "" : "\n", line.from.x,
                           core::downwards(line.from.y), line.to.x, core::downwards(line.to.y));
    }
    text += "\"/>\n";
  }
  if (!section.contours.empty()) {
    text += text::format(
        "<path fill=\"none\" fill-rule=\"evenodd\" stroke=\"black\" stroke-width=\"{}\" d=\"",
        stroke);
    for (const Contour& contour : section.contours) {
      if (&contour != section.contours.data()) text += "\n";
      text += core::path_of(contour);
    }
    text += "\"/>\n";
  }
  return text + "</svg>\n";
}

std::string section_dxf(const Section& section, const SectionDrawing& drawing) {
  core::check(drawing);
  core::DxfText dxf;
  core::add_header(section, core::drawing_unit(drawing.unit), dxf);
  core::add_layers(dxf);
  dxf.add(0, "SECTION");
  dxf.add(2, "ENTITIES");
  for (const core::HatchLine& line : core::hatch_lines(section, drawing)) {
    dxf.add(0, "LINE");
    dxf.add(8, "HATCH");
    dxf.add_point(10, line.from.x, line.from.y);
    dxf.add_point(11, line.to.x, line.to.y);
  }
  for (const Contour& contour : section.contours) core::add_contour(contour, dxf);
  dxf.add(0, "ENDSEC");
  dxf.add(0, "EOF");
  return dxf.text;
}

void check_section_name(const std::filesystem::path& path) {
  const std::string ending = core::ending_of(path);
  if (ending != ".svg" && ending != ".dxf")
    throw Error(ErrorCode::unsupported,
                "sections are written as .svg or .dxf, not as \"" + path.string() + "\"", "path");
}

void write_section(const std::filesystem::path& path, const Section& section,
                   const SectionDrawing& drawing) {
  check_section_name(path);
  write_file(path, core::ending_of(path) == ".svg" ? section_svg(section, drawing)
                                                   : section_dxf(section, drawing));
}

}  // namespace crt
