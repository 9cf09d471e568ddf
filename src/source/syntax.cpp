#include "source/syntax.hpp"

#include <fmt/format.h>

#include <cctype>

namespace crt::source {

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
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' && !is_escaped) is_quoted = !is_quoted;
    is_escaped = is_quoted && c == '\\' && !is_escaped;
    if (result.size() - line >= most_columns && place != std::string::npos) {
      result.replace(place, 1, "\n" + std::string(indent, ' '));
      line = place + 1;
      place = std::string::npos;
    }
    if (c == '\n') {
      line = result.size() + 1;
      place = std::string::npos;
    } else if (c == ' ' && !is_quoted && i > 0 && text[i - 1] == ',') {
      place = result.size();
    }
    result += c;
  }
  return result;
}

std::string Syntax::number(double number) {
  return fmt::format("{}", number);
}

std::string Syntax::boolean(bool value) const {
  if (is_cpp()) return value ? "true" : "false";
  if (is_python()) return value ? "True" : "False";
  return value ? "1" : "0";
}

std::string Syntax::text(const std::string& content) const {
  constexpr std::size_t most_in_a_piece = 72;
  std::string result = "\"";
  std::size_t piece = 0;
  for (const char c : content) {
    const auto byte = static_cast<unsigned char>(c);
    if (piece >= most_in_a_piece && (byte < 0x80 || byte >= 0xc0)) {
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
      result += fmt::format("\\{:03o}", byte);
    } else if (c == '?' && !is_python()) {
      result += "\\?";  // two would begin a trigraph
    } else {
      result += c;
    }
    piece += result.size() - before;
  }
  return result + '"';
}

std::string Syntax::vector(const Vec3& v) const {
  const std::string numbers = fmt::format("{}, {}, {}", v.x, v.y, v.z);
  if (is_cpp()) return "{" + numbers + "}";
  if (is_python()) return "(" + numbers + ")";
  return "(const double[]){" + numbers + "}";
}

std::string Syntax::list(std::span<const std::string> items) const {
  return is_python() ? joined("[", items, "]") : joined("{", items, "}");
}

std::string Syntax::call(const std::string& function, std::span<const std::string> arguments) {
  return joined(function + "(", arguments, ")");
}

std::string Syntax::enumerator(const char* type, const char* prefix, std::string_view name) const {
  if (is_cpp()) return fmt::format("{}::{}", type, name);
  std::string upper(name);
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return is_python() ? fmt::format("crt.{}.{}", type, upper) : fmt::format("{}_{}", prefix, upper);
}

}  // namespace crt::source
