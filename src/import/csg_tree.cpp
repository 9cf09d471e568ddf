#include "import/csg_tree.hpp"

#include <charconv>
#include <cmath>
#include <limits>

#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr int most_depth = 400;  // of modules within modules
constexpr int most_lists = 16;   // of lists within lists
constexpr std::size_t most_nodes = 1000000;
constexpr std::size_t most_values = 20000000;

bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '$';
}

class CsgParser {
 public:
  CsgParser(std::string_view text, int file) : text_(text) { place_.file = file; }

  std::vector<CsgNode> tree() {
    std::vector<CsgNode> nodes;
    skip();
    while (at_ < text_.size()) node_into(nodes, 0);
    return nodes;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Failure(place_, message); }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void step() {
    if (text_[at_] == '\n') {
      ++place_.line;
      place_.column = 1;
    } else {
      ++place_.column;
    }
    ++at_;
  }

  void skip() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
        step();
      } else if (text_.substr(at_, 2) == "//") {
        while (at_ < text_.size() && text_[at_] != '\n') step();
      } else if (text_.substr(at_, 2) == "/*") {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) fail("this comment has no end");
        while (at_ < end + 2) step();
      } else {
        return;
      }
    }
  }

  void expect(char c, const char* what) {
    if (peek() != c) {
      fail(text::format("'{}' is expected {}{}", c, what,
                        at_ < text_.size() ? "" : ", and the file ends"));
    }
    step();
    skip();
  }

  std::string word() {
    const std::size_t begin = at_;
    while (is_word(peek())) step();
    std::string result(text_.substr(begin, at_ - begin));
    skip();
    return result;
  }

  void node_into(std::vector<CsgNode>& nodes, int depth) {
    if (peek() == ';') {
      step();
      skip();
      return;
    }
    if (depth > most_depth)
      throw Failure(place_, text::format("modules lie over {} deep in one another", most_depth),
                    ErrorCode::limit);
    if (++nodes_ > most_nodes)
      throw Failure(place_, text::format("there are over {} modules", most_nodes),
                    ErrorCode::limit);
    CsgNode node;
    node.place = place_;
    while (peek() == '%' || peek() == '#' || peek() == '*' || peek() == '!') {
      // What is left out, or is the root, is more than what is shown in another colour.
      if (node.modifier == 0 || peek() == '*' || peek() == '!') node.modifier = peek();
      step();
      skip();
    }
    node.name = word();
    if (node.name.empty())
      fail("a module is expected here, as `openscad -o part.csg` writes it: \"cube(...);\"");
    expect('(', "behind the name of a module");
    while (peek() != ')') {
      node.arguments.push_back(argument());
      if (peek() != ')') expect(',', "between arguments");
    }
    expect(')', "");
    if (peek() == '{') {
      step();
      skip();
      while (peek() != '}') {
        if (at_ >= text_.size()) fail(text::format("the '{{' of '{}' has no '}}'", node.name));
        node_into(node.children, depth + 1);
      }
      step();
      skip();
    } else {
      expect(';', "behind a module");
    }
    nodes.push_back(std::move(node));
  }

  std::pair<std::string, CsgValue> argument() {
    if (is_word(peek()) && !(peek() >= '0' && peek() <= '9')) {
      std::string name = word();
      if (peek() != '=') return {"", value_of_word(name)};
      step();
      skip();
      return {std::move(name), value(0)};
    }
    return {"", value(0)};
  }

  CsgValue value_of_word(const std::string& name) const {
    using Kind = CsgValue::Kind;
    if (name == "true" || name == "false")
      return {.kind = Kind::boolean, .number = name == "true" ? 1.0 : 0.0};
    if (name == "inf")
      return {.kind = Kind::number, .number = std::numeric_limits<double>::infinity()};
    if (name == "nan")
      return {.kind = Kind::number, .number = std::numeric_limits<double>::quiet_NaN()};
    if (name != "undef") fail(text::format("'{}' is no value", name));
    return {};
  }

  CsgValue value(int depth) {
    using Kind = CsgValue::Kind;
    if (++values_ > most_values)
      throw Failure(place_, text::format("there are over {} values", most_values),
                    ErrorCode::limit);
    if (peek() == '"') return {.kind = Kind::text, .text = quoted()};
    if (peek() == '[') {
      if (depth >= most_lists)
        throw Failure(place_, "lists lie too deep in one another", ErrorCode::limit);
      CsgValue list{.kind = Kind::list};
      step();
      skip();
      while (peek() != ']') {
        list.items.push_back(value(depth + 1));
        if (peek() != ']') expect(',', "between the items of a list");
      }
      step();
      skip();
      return list;
    }
    if ((peek() >= 'a' && peek() <= 'z')) return value_of_word(word());
    return {.kind = Kind::number, .number = number()};
  }

  double number() {
    const bool is_negative = peek() == '-';
    if (is_negative || peek() == '+') step();
    if (peek() == 'i' || peek() == 'n') {
      const double big = value_of_word(word()).number;
      return is_negative ? -big : big;
    }
    double result = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, failed] = std::from_chars(begin, text_.data() + text_.size(), result);
    if (failed == std::errc::invalid_argument) fail("a value is expected here");
    if (failed == std::errc::result_out_of_range) result = 0;
    for (auto left = end - begin; left > 0; --left) step();
    skip();
    return is_negative ? -result : result;
  }

  /// OpenSCAD writes texts as they are, without a backslash before a quote. So the last quote is
  /// one with a comma or bracket behind it.
  std::string quoted() {
    step();
    std::string result;
    for (;;) {
      if (at_ >= text_.size()) fail("this text has no end");
      if (peek() == '"') {
        std::size_t next = at_ + 1;
        while (next < text_.size() && text_[next] == ' ') ++next;
        const char c = next < text_.size() ? text_[next] : ')';
        if (c == ',' || c == ')' || c == ']') break;
      }
      result += peek();
      step();
    }
    step();
    skip();
    return result;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Place place_;
  std::size_t nodes_ = 0;
  std::size_t values_ = 0;
};

}  // namespace

const CsgValue& CsgNode::argument(std::string_view called) const {
  static const CsgValue none;
  for (const auto& [key, value] : arguments)
    if (key == called) return value;
  return none;
}

double CsgNode::number(std::string_view called, double usual) const {
  const CsgValue& value = argument(called);
  using Kind = CsgValue::Kind;
  return value.kind == Kind::number || value.kind == Kind::boolean ? value.number : usual;
}

std::optional<std::vector<double>> CsgNode::numbers(std::string_view called,
                                                    std::size_t least) const {
  return numbers_of(argument(called), least);
}

std::optional<std::vector<double>> numbers_of(const CsgValue& list, std::size_t least) {
  if (list.kind != CsgValue::Kind::list || list.items.size() < least) return {};
  std::vector<double> numbers;
  for (const CsgValue& item : list.items) {
    if (item.kind != CsgValue::Kind::number || !std::isfinite(item.number)) return {};
    numbers.push_back(item.number);
  }
  return numbers;
}

std::vector<CsgNode> parse_csg(std::string_view text, int file) {
  return CsgParser(text, file).tree();
}

}  // namespace crt::importing
