#include "cli/json.hpp"

#include <charconv>
#include <cstddef>
#include <utility>

namespace crt::test {

namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Json whole_text() {
    Json value = parse_value();
    skip_blanks();
    if (at_ != text_.size()) fail("more after the end");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& why) const {
    throw std::runtime_error("no JSON at byte " + std::to_string(at_) + ": " + why);
  }

  void skip_blanks() {
    while (at_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
  }

  bool take(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  void expect(std::string_view word) {
    if (!take(word)) fail("expected " + std::string(word));
  }

  Json parse_value() {
    skip_blanks();
    Json value;
    if (take("{")) {
      value.kind = Json::Kind::object;
      parse_members(value);
    } else if (take("[")) {
      value.kind = Json::Kind::array;
      parse_items(value);
    } else if (text_.substr(at_, 1) == "\"") {
      value.kind = Json::Kind::string;
      value.string = parse_string();
    } else if (take("true") || take("false")) {
      value.kind = Json::Kind::boolean;
      value.boolean = text_[at_ - 2] == 'u';
    } else if (!take("null")) {
      value.kind = Json::Kind::number;
      value.number = parse_number();
    }
    return value;
  }

  void parse_members(Json& object) {
    skip_blanks();
    if (take("}")) return;
    do {
      skip_blanks();
      std::string name = parse_string();
      skip_blanks();
      expect(":");
      if (!object.members.emplace(std::move(name), parse_value()).second)
        fail("a name occurs twice");
      skip_blanks();
    } while (take(","));
    expect("}");
  }

  void parse_items(Json& array) {
    skip_blanks();
    if (take("]")) return;
    do {
      array.items.push_back(parse_value());
      skip_blanks();
    } while (take(","));
    expect("]");
  }

  std::string parse_string() {
    expect("\"");
    std::string result;
    while (!take("\"")) {
      if (at_ == text_.size()) fail("a string without an end");
      const char c = text_[at_++];
      if (static_cast<unsigned char>(c) < 0x20) fail("a control character in a string");
      if (c != '\\') {
        result += c;
      } else {
        result += parse_escape();
      }
    }
    return result;
  }

  std::string parse_escape() {
    constexpr std::string_view letters = "\"\\/bfnrt";
    constexpr std::string_view meanings = "\"\\/\b\f\n\r\t";
    const char letter = at_ < text_.size() ? text_[at_++] : '\0';
    if (const std::size_t index = letters.find(letter);
        letter != '\0' && index != std::string_view::npos) {
      return std::string(1, meanings[index]);
    }
    if (letter != 'u') fail("an unknown escape");
    constexpr std::size_t digit_count = 4;
    const std::string_view digits = text_.substr(at_, digit_count);
    unsigned code = 0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (error != std::errc() || end != digits.data() + digit_count) fail("\\u needs four digits");
    at_ += digit_count;
    return code < 0x80 ? std::string(1, static_cast<char>(code)) : "\\u" + std::string(digits);
  }

  double parse_number() {
    const std::size_t start = at_;
    take("-");
    if (!take("0")) digits();
    if (take(".")) digits();
    if (take("e") || take("E")) {
      if (!take("+")) take("-");
      digits();
    }
    double number = 0;
    std::from_chars(text_.data() + start, text_.data() + at_, number);
    return number;
  }

  void digits() {
    const std::size_t start = at_;
    while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
    if (at_ == start) fail("expected a digit");
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

Json parse_json(std::string_view text) {
  return Parser(text).whole_text();
}

}  // namespace crt::test
