#include "import/pov_token.hpp"

#include <array>
#include <charconv>

#include "text/format.hpp"

namespace crt::importing {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

class PovLexer {
 public:
  PovLexer(std::string_view text, int file) : text_(text) { place_.file = file; }

  std::vector<PovToken> all() {
    std::vector<PovToken> tokens;
    for (skip(); at_ < text_.size(); skip()) tokens.push_back(token());
    return tokens;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw Failure(place_, message); }

  char at(std::size_t ahead) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

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
      if (at(0) == '/' && at(1) == '/') {
        while (at_ < text_.size() && at(0) != '\n') step();
      } else if (at(0) == '/' && at(1) == '*') {
        skip_comment();
      } else if (static_cast<unsigned char>(at(0)) <= ' ' || at(0) == '\x1a') {
        step();
      } else {
        return;
      }
    }
  }

  /// Comments may lie within one another.
  void skip_comment() {
    int depth = 0;
    const Place begin = place_;
    do {
      if (at_ >= text_.size()) throw Failure(begin, "this comment has no end");
      const bool begins = at(0) == '/' && at(1) == '*';
      const bool ends = at(0) == '*' && at(1) == '/';
      depth += begins ? 1 : ends ? -1 : 0;
      step();
      if (begins || ends) step();
    } while (depth > 0);
  }

  std::string word() {
    const std::size_t begin = at_;
    while (is_letter(at(0)) || is_digit(at(0))) step();
    return std::string(text_.substr(begin, at_ - begin));
  }

  PovToken token() {
    PovToken token;
    token.place = place_;
    const char c = at(0);
    if (is_digit(c) || (c == '.' && is_digit(at(1)))) {
      token.kind = PovToken::Kind::number;
      token.number = number();
    } else if (is_letter(c)) {
      token.kind = PovToken::Kind::word;
      token.text = word();
    } else if (c == '"') {
      token.kind = PovToken::Kind::text;
      token.text = quoted();
    } else if (c == '#') {
      step();
      while (at(0) == ' ' || at(0) == '\t') step();
      token.kind = PovToken::Kind::directive;
      token.text = word();
      if (token.text.empty()) fail("a directive is expected behind '#'");
    } else {
      token.kind = PovToken::Kind::sign;
      token.text = sign();
    }
    return token;
  }

  double number() {
    double result = 0;
    const char* const begin = text_.data() + at_;
    const auto [end, failed] = std::from_chars(begin, text_.data() + text_.size(), result);
    if (failed != std::errc()) {
      if (failed != std::errc::result_out_of_range) fail("this is no number");
      result = 0;
    }
    for (auto left = end - begin; left > 0; --left) step();
    return result;
  }

  std::string quoted() {
    const Place begin = place_;
    step();
    std::string result;
    while (at(0) != '"') {
      if (at_ >= text_.size()) throw Failure(begin, "this text has no end");
      if (at(0) == '\\') {
        step();
        const char c = at(0);
        result += c == 'n' ? '\n' : c == 't' ? '\t' : c;
      } else {
        result += at(0);
      }
      if (at_ < text_.size()) step();
    }
    step();
    return result;
  }

  std::string sign() {
    static constexpr std::array<std::string_view, 3> pairs = {"<=", ">=", "!="};
    for (const std::string_view pair : pairs) {
      if (text_.substr(at_, 2) != pair) continue;
      step();
      step();
      return std::string(pair);
    }
    static constexpr std::string_view signs = "{}()[]<>,;=+-*/?:&|!.@";
    const char c = at(0);
    if (signs.find(c) == std::string_view::npos) fail("this character begins nothing");
    step();
    return std::string(1, c);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Place place_;
};

}  // namespace

std::vector<PovToken> pov_tokens(std::string_view text, int file) {
  return PovLexer(text, file).all();
}

}  // namespace crt::importing
