#include "source/syntax.hpp"

#include <cctype>
#include <cmath>

#include "crt/error.hpp"
#include "text/format.hpp"
#include "text/utf8.hpp"

namespace crt::source {

namespace {

/// Says whether a text begins with the name of an attribute and its arrow: "radius -> 1".
bool begins_attribute(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && std::isalnum(static_cast<unsigned char>(text[end])) != 0) ++end;
  return end > 0 && text.substr(end).starts_with(" -> ");
}

/// Says whether a bracket opens a vector or a colour of a script.
bool opens_vector(std::string_view text) {
  return text.ends_with("vec3(") || text.ends_with("rgb(") || text.ends_with("rgba(");
}

}  // namespace

std::string joined(std::string begin, std::span<const std::string> items, std::string_view end) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) begin += ", ";
    begin += items[i];
  }
  return begin.append(end);
}

std::string wrapped(std::string_view text, std::size_t indent) {
  std::string result;
  std::size_t line = 0;                   // where the line begins in the result
  std::size_t place = std::string::npos;  // where it may be broken
  bool is_quoted = false;
  bool is_escaped = false;
  bool is_in_vector = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && !is_escaped) is_quoted = !is_quoted;
    is_escaped = is_quoted && c == '\\' && !is_escaped;
    if (result.size() - line >= max_columns && place != std::string::npos) {
      result.replace(place, 1, "\n" + std::string(indent, ' '));
      line = place + 1;
      place = std::string::npos;
    }
    if (c == ')' || opens_vector(text.substr(0, i + 1))) is_in_vector = c == '(';
    if (c == '\n') {
      line = result.size() + 1;
      place = std::string::npos;
    } else if (c == ' ' && !is_quoted && !is_in_vector && i > 0 &&
               (text[i - 1] == ',' ||
                (text[i - 1] != ' ' && begins_attribute(text.substr(i + 1))))) {
      place = result.size();
    }
    result += c;
  }
  return result;
}

std::string Syntax::number(double number) {
  if (number == 0 && std::signbit(number)) return "-0.0";  // a whole number has no sign at 0
  return text::format("{}", number);
}

std::string Syntax::boolean(bool value) const {
  if (is_cpp() || is_script()) return value ? "true" : "false";
  if (is_python()) return value ? "True" : "False";
  return value ? "1" : "0";
}

std::string Syntax::text(const std::string& content) const {
  if (is_script() && !text::is_utf8(content))
    throw Error(ErrorCode::unsupported, "a text is not UTF-8, which scripts are written in");
  const std::size_t max_in_a_piece = is_script() ? std::string::npos : 72;
  std::string result = "\"";
  std::size_t piece = 0;
  for (const char c : content) {
    const auto byte = static_cast<unsigned char>(c);
    if (piece >= max_in_a_piece && (byte < 0x80 || byte >= 0xc0)) {
      result += "\"\n      \"";
      piece = 0;
    }
    const std::size_t before = result.size();
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (byte < ' ' || byte == 0x7f) {
      result += is_script() ? text::format("\\u{:04x}", byte) : text::format("\\{:03o}", byte);
    } else if (c == '?' && (is_cpp() || is_c())) {
      result += "\\?";  // two would begin a trigraph
    } else {
      result += c;
    }
    piece += result.size() - before;
  }
  return result + '"';
}

std::string Syntax::vector(const Vec3& v) const {
  const std::string numbers = text::format("{}, {}, {}", number(v.x), number(v.y), number(v.z));
  if (is_cpp()) return "{" + numbers + "}";
  if (is_python()) return "(" + numbers + ")";
  if (is_script()) return "vec3(" + numbers + ")";
  return "(const double[]){" + numbers + "}";
}

std::string Syntax::color(const Color& color) const {
  const std::string numbers =
      text::format("{}, {}, {}", number(color.r), number(color.g), number(color.b));
  if (color.a == 1) return is_script() ? "rgb(" + numbers + ")" : "Color{" + numbers + "}";
  const std::string with_alpha = numbers + ", " + number(color.a);
  return is_script() ? "rgba(" + with_alpha + ")" : "Color{" + with_alpha + "}";
}

std::string Syntax::list(std::span<const std::string> items) const {
  return is_python() || is_script() ? joined("[", items, "]") : joined("{", items, "}");
}

std::string Syntax::constructed(const std::string& name, std::span<const std::string> items) const {
  if (is_python()) return joined(text::format("crt.{}(", name), items, ")");
  if (!is_script()) return joined(name + "{", items, "}");
  std::string text = name + " { ";
  for (const std::string& item : items) text += item + " ";
  return text + "}";
}

std::string Syntax::enumerator(std::string_view type, std::string_view prefix,
                               std::string_view name) const {
  if (is_cpp()) return text::format("{}::{}", type, name);
  if (is_script()) {
    std::string word(name);
    std::erase(word, '_');
    return '"' + word + '"';
  }
  std::string upper(name);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return is_python() ? text::format("crt.{}.{}", type, upper)
                     : text::format("{}_{}", prefix, upper);
}

}  // namespace crt::source
