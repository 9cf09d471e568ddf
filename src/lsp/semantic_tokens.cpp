#include "lsp/semantic_tokens.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "lang/builtins.hpp"

namespace crt::lsp {

namespace {

using Kind = lang::Grammar::symbol_kind;

class TokenEncoder {
 public:
  TokenEncoder(const lang::Source& source, Encoding encoding)
      : source_(source), encoding_(encoding) {}

  void add(lang::Span span, TokenType type) {
    const std::uint32_t byte = span.begin - source_.base;
    std::uint32_t lines = 0;
    while (line_ + 1 < source_.line_starts.size() && source_.line_starts[line_ + 1] <= byte) {
      ++line_;
      ++lines;
    }
    if (lines > 0) place_ = source_.line_starts[line_];
    // Each character is counted once, however long its line is.
    const std::uint32_t distance = characters(place_, byte);
    const std::uint32_t end = span.end - source_.base;
    data_.insert(data_.end(),
                 {lines, distance, characters(byte, end), static_cast<std::uint32_t>(type), 0});
    place_ = byte;
  }

  std::vector<std::uint32_t> take() { return std::move(data_); }

 private:
  std::uint32_t characters(std::uint32_t begin, std::uint32_t end) const {
    return count_characters(std::string_view(source_.text).substr(begin, end - begin), encoding_);
  }

  const lang::Source& source_;
  Encoding encoding_;
  std::size_t line_ = 0;
  std::uint32_t place_ = 0;  ///< where the token before begins, or the line
  std::vector<std::uint32_t> data_;
};

TokenType type_of_name(const Program& program, lang::Span span) {
  const lang::NameUse* use = lang::use_at(program.names(), span.begin);
  if (!use || use->span != span) return TokenType::variable;
  if (use->declared == lang::NameUse::nothing) {
    const std::string_view name = program.symbols().name(use->symbol);
    const auto builtins = lang::builtins();
    const bool is_builtin =
        std::any_of(builtins.begin(), builtins.end(),
                    [&](const lang::Builtin& builtin) { return builtin.name == name; });
    return is_builtin ? TokenType::function : TokenType::variable;
  }
  switch (program.names().declared[use->declared].kind) {
    case lang::NameKind::macro:
      return TokenType::function;
    case lang::NameKind::parameter:
      return TokenType::parameter;
    default:
      return TokenType::variable;
  }
}

/// Returns the type of a token, or nothing for a sign. `next` is the kind of the next token.
std::optional<TokenType> type_of(const Program& program, const lang::Token& token, int next) {
  switch (token.kind) {
    case Kind::S_STRING:
      return TokenType::string;
    case Kind::S_INTEGER:
    case Kind::S_FLOAT:
      return TokenType::number;
    case Kind::S_OBJECT_NAME:
      return TokenType::object;
    case Kind::S_IDENTIFIER:
      return next == Kind::S_ARROW ? TokenType::attribute : type_of_name(program, token.span);
    default:
      break;
  }
  const char first = program.text_of(token.span)[0];
  const bool is_word = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
  return is_word ? std::optional(TokenType::keyword) : std::nullopt;
}

}  // namespace

std::vector<std::uint32_t> semantic_tokens(const Program& program, Encoding encoding) {
  TokenEncoder encoder(program.main(), encoding);
  const auto& [tokens, comments, open] = program.tokens();
  auto comment = comments.begin();
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    for (; comment != comments.end() && comment->begin < tokens[i].span.begin; ++comment)
      encoder.add(*comment, TokenType::comment);
    const int next = i + 1 < tokens.size() ? tokens[i + 1].kind : Kind::S_YYEOF;
    if (const auto type = type_of(program, tokens[i], next)) encoder.add(tokens[i].span, *type);
  }
  for (; comment != comments.end(); ++comment) encoder.add(*comment, TokenType::comment);
  return encoder.take();
}

}  // namespace crt::lsp
