#include "studio/analysis_message.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace crt::studio {

namespace {

constexpr std::array<std::string_view, 13> node_kinds = {
    "settings", "scene", "import", "assignment", "macro", "object", "combination",
    "placed",   "call",  "name",   "list",       "loop",  "choice"};
constexpr std::array<std::string_view, 6> literal_kinds = {"none",   "number", "boolean",
                                                           "string", "vector", "color"};

/// Writes JSON. What it is given is UTF-8, as all texts of pages are.
class AnalysisWriter {
 public:
  explicit AnalysisWriter(const Analysis& analysis) : analysis_(analysis) {}

  std::string write() {
    raw(R"({"type":"analysis","revision":)");
    number(analysis_.revision.number);
    raw(R"(,"tokens":[)");
    for (const ScriptToken& token : analysis_.service.tokens()) {
      separate();
      units(token.span);
      text_ += ',';
      number(static_cast<std::uint32_t>(token.kind));
    }
    raw(R"(],"tree":[)");
    for (const ScriptNode& node : analysis_.service.tree()) {
      separate();
      write(node);
    }
    raw("]}");
    return std::move(text_);
  }

 private:
  void write(const ScriptNode& node) {
    raw(R"({"kind":)");
    string(node_kinds.at(static_cast<std::size_t>(node.kind)));
    raw(R"(,"name":)");
    string(node.name);
    span("span", node.span);
    span("nameSpan", node.name_span);
    raw(R"(,"parent":)");
    if (node.parent == ScriptNode::no_parent) {
      raw("-1");
    } else {
      number(node.parent);
    }
    attributes("attributes", node.attributes);
    if (!node.base.empty()) {
      raw(R"(,"base":)");
      string(node.base);
      attributes("inherited", node.inherited);
    }
    text_ += '}';
  }

  void attributes(std::string_view name, const std::vector<ScriptAttribute>& list) {
    text_ += ',';
    string(name);
    raw(":[");
    for (const ScriptAttribute& attribute : list) {
      separate();
      write(attribute);
    }
    text_ += ']';
  }

  void write(const ScriptAttribute& attribute) {
    raw(R"({"name":)");
    string(attribute.name);
    span("nameSpan", attribute.name_span);
    span("span", attribute.value_span);
    raw(R"(,"literal":)");
    string(literal_kinds.at(static_cast<std::size_t>(attribute.literal)));
    if (!attribute.numbers.empty()) {
      raw(R"(,"numbers":[)");
      for (const double value : attribute.numbers) {
        separate();
        if (std::isfinite(value)) {
          number(value);
        } else {
          raw("null");
        }
      }
      text_ += ']';
    }
    if (attribute.literal == LiteralKind::string) {
      raw(R"(,"text":)");
      string(attribute.text);
    }
    if (!attribute.reason.empty()) {
      raw(R"(,"reason":)");
      string(attribute.reason);
    }
    if (!attribute.written.empty()) {
      raw(R"(,"written":)");
      string(attribute.written);
    }
    text_ += '}';
  }

  void span(std::string_view name, TextSpan span) {
    text_ += ',';
    string(name);
    raw(":[");
    units(span);
    text_ += ']';
  }

  void units(TextSpan span) {
    number(analysis_.places.unit_of(span.begin));
    text_ += ',';
    number(analysis_.places.unit_of(span.end));
  }

  void raw(std::string_view text) { text_ += text; }

  /// Puts a comma between the items of a list.
  void separate() {
    if (text_.back() != '[') text_ += ',';
  }

  template <class Number>
  void number(Number value) {
    std::array<char, 32> digits;  // a double has at most 24
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text_.append(digits.data(), end);
  }

  void string(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    text_ += '"';
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte < ' ') {
        raw("\\u00");
        text_ += digits[byte / 16];
        text_ += digits[byte % 16];
        continue;
      }
      if (c == '"' || c == '\\') text_ += '\\';
      text_ += c;
    }
    text_ += '"';
  }

  const Analysis& analysis_;
  std::string text_;
};

}  // namespace

std::string analysis_message(const Analysis& analysis) {
  return AnalysisWriter(analysis).write();
}

}  // namespace crt::studio
