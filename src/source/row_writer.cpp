#include "source/row_writer.hpp"

#include <cctype>
#include <cstdint>
#include <limits>

#include "crt/error.hpp"
#include "crt/schema_materials.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

std::string pattern_value(Program& program, const Pattern& pattern);

/// Returns what a field has that holds a pattern: its value, or its address in C.
std::string pattern_in_field(Program& program, const Pattern& pattern) {
  const std::string value = pattern_value(program, pattern);
  return program.syntax().is_c() ? "&" + value : value;
}

template <class Kind>
void add_pattern_fields(Program& program, Fields& fields, Kind pattern) {
  RowWriter writer(program, fields);
  if constexpr (requires { pattern.pattern_a; }) {
    if (program.syntax().is_script()) {
      // The other pattern stands in the place of the colour, which is not written if it is as
      // usual.
      if (pattern.pattern_a) pattern.color_a = Kind{}.color_a;
      if (pattern.pattern_b) pattern.color_b = Kind{}.color_b;
    }
  }
  writer.add_all(pattern);
}

std::string pattern_value(Program& program, const Pattern& pattern) {
  const KindNames names = std::visit(
      []<class Kind>(const Kind&) { return names_of("Pattern", schema::table<Kind>.name); },
      pattern);
  Fields fields(program.syntax());
  std::visit([&](const auto& kind) { add_pattern_fields(program, fields, kind); }, pattern);
  return program.structure("pattern", program.syntax().is_python() ? names.python : names.cpp,
                           fields, names.c);
}

/// Returns a pattern that takes the place of what a struct has otherwise.
std::string replacing_pattern(Program& program, const Pattern& pattern) {
  const std::string value = pattern_in_field(program, pattern);
  return program.syntax().is_cpp() ? text::format("Pattern{{{}}}", value) : value;
}

}  // namespace

KindNames names_of(std::string_view family, std::string_view kind) {
  if (kind == "ImageMap") return {"ImageMap", "Pattern.of_image", "CRT_PATTERN_IMAGE"};
  const bool has_family = kind.ends_with(family);
  const schema::Name word =
      schema::c_name(kind.substr(0, kind.size() - (has_family ? family.size() : 0)));
  std::string c = text::format("CRT_{}_{}", family, word.text());
  for (char& letter : c) letter = static_cast<char>(std::toupper(letter));
  return {std::string(kind), text::format("{}.{}", family, word.text()), c};
}

void RowWriter::add(Text cpp, Text c, const Uses& uses, double value, double usual) {
  if (value == usual && !must_be_there_) return;
  fields_.add_text(cpp, c, uses.degrees.empty() ? Syntax::number(value) : program_.angle(value));
}

void RowWriter::add(Text cpp, Text c, const Uses&, int value, int usual) {
  if (value != usual) fields_.add_text(cpp, c, std::to_string(value));
}

void RowWriter::add(Text cpp, Text c, const Uses&, const Vec3& value, const Vec3& usual) {
  if (value != usual || must_be_there_) fields_.add_vector(cpp, c, value);
}

void RowWriter::add(Text cpp, Text c, const Uses& uses, const Color& value, const Color& usual) {
  if (syntax_.is_cpp() || syntax_.is_script()) {
    if (value != usual || must_be_there_) fields_.add_text(cpp, c, syntax_.color(value));
    return;
  }
  const Vec3 rgb(value.r, value.g, value.b);
  if (rgb != Vec3(usual.r, usual.g, usual.b)) fields_.add_vector(cpp, c, rgb);
  if (value.a == usual.a) return;
  if (uses.alpha.empty() && cpp == "color")
    throw Error(ErrorCode::unsupported, "C and Python have no alpha of this colour");
  fields_.add_text("", uses.alpha, Syntax::number(value.a));
}

void RowWriter::add(Text cpp, Text c, const Uses&, const std::string& value, const std::string&) {
  if (!value.empty()) fields_.add_text(cpp, c, syntax_.text(value));
}

void RowWriter::add(Text cpp, Text c, const Uses&, bool value, bool usual) {
  if (value == usual) return;
  const bool has_booleans = syntax_.is_cpp() || syntax_.is_script();
  const bool in_c = value != c.starts_with("no_");
  fields_.add_text(cpp, c, has_booleans ? syntax_.boolean(value) : in_c ? "1" : "0");
}

void RowWriter::add(Text cpp, Text c, const Uses&, std::uint64_t value, std::uint64_t usual) {
  if (value == usual) return;
  if (syntax_.is_script() && value > std::numeric_limits<std::int64_t>::max())
    throw Error(ErrorCode::unsupported,
                text::format("a {} of 2^63 or more cannot be written in a script", cpp));
  const bool has_suffix = syntax_.is_cpp() || syntax_.is_c();
  fields_.add_text(cpp, c, std::to_string(value) + (has_suffix ? "U" : ""));
}

void RowWriter::add(Text cpp, Text c, const Uses&, const std::optional<double>& value,
                    const std::optional<double>&) {
  if (value) fields_.add_text(cpp, c, Syntax::number(*value));
}

void RowWriter::add(Text cpp, Text c, const Uses& uses, const std::variant<Color, Pattern>& value,
                    const std::variant<Color, Pattern>& usual) {
  if (const auto* color = std::get_if<Color>(&value))
    return add(cpp, c, uses, *color, std::get<Color>(usual));
  fields_.add_text(cpp, uses.map, replacing_pattern(program_, std::get<Pattern>(value)));
}

void RowWriter::add(Text cpp, Text c, const Uses& uses, const Share& value, const Share& usual) {
  if (const auto* number = std::get_if<double>(&value))
    return add(cpp, c, uses, *number, std::get<double>(usual));
  fields_.add_text(cpp, uses.map, replacing_pattern(program_, std::get<Pattern>(value)));
}

void RowWriter::add(Text cpp, Text c, const Uses&, const std::optional<Pattern>& value,
                    const std::optional<Pattern>&) {
  if (value) fields_.add_text(cpp, c, replacing_pattern(program_, *value));
}

void RowWriter::add(Text cpp, Text c, const Uses&, const SharedPattern& value,
                    const SharedPattern&) {
  if (!value) return;
  if (syntax_.is_script()) cpp = cpp == "pattern_a" ? "color_a" : "color_b";
  const std::string inner = pattern_in_field(program_, value->pattern);
  fields_.add_text(cpp, c, syntax_.is_cpp() ? text::format("nested({})", inner) : inner);
}

void RowWriter::add(Text cpp, Text c, const Uses&, const std::shared_ptr<const Image>& value,
                    const std::shared_ptr<const Image>&) {
  fields_.add_text(cpp, c, image_name(program_, value));
}

void RowWriter::add(Text, Text, const Uses&, const std::vector<ColorStop>& stops,
                    const std::vector<ColorStop>&) {
  if (stops.empty()) return;
  std::vector<std::string> items;
  items.reserve(stops.size());
  const bool is_python = syntax_.is_python();
  for (const auto& [position, color] : stops) {
    if (syntax_.is_script()) {
      items.push_back(text::format("[{}, {}]", position, syntax_.color(color)));
      continue;
    }
    const std::string rgb = text::format("{}, {}, {}", color.r, color.g, color.b);
    items.push_back(is_python ? text::format("({}, ({}), {})", position, rgb, color.a)
                    : syntax_.is_cpp()
                        ? text::format("{{{}, {{{}, {}}}}}", position, rgb, color.a)
                        : text::format("{{{}, {{{}}}, {}}}", position, rgb, color.a));
  }
  if (!syntax_.is_c()) return fields_.add_text("colors", "colors", syntax_.list(items));
  fields_.add_text("", "colors", program_.array("colors", "crt_color_stop", items));
  fields_.add_text("", "color_count", std::to_string(stops.size()));
}

}  // namespace crt::source
