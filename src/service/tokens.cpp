#include "service/tokens.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "lang/builtins.hpp"

namespace crt::service {

namespace {

using Kind = lang::Grammar::symbol_kind;

TokenKind kind_of_name(const Program& program, lang::Span span) {
  const lang::NameUse* use = lang::use_at(program.names(), span.begin);
  if (!use || use->span != span) {
    constexpr std::array jumps = {"return", "break", "continue"};
    const bool is_jump =
        std::find(jumps.begin(), jumps.end(), program.text_of(span)) != jumps.end();
    return is_jump ? TokenKind::keyword : TokenKind::variable;
  }
  if (use->declared == lang::NameUse::nothing) {
    const std::string_view name = program.symbols().name(use->symbol);
    const auto builtins = lang::builtins();
    const bool is_builtin =
        std::any_of(builtins.begin(), builtins.end(),
                    [&](const lang::Builtin& builtin) { return builtin.name == name; });
    return is_builtin ? TokenKind::function : TokenKind::variable;
  }
  switch (program.names().declared[use->declared].kind) {
    case lang::NameKind::macro:
      return TokenKind::function;
    case lang::NameKind::parameter:
      return TokenKind::parameter;
    default:
      return TokenKind::variable;
  }
}

/// Returns the kind of a token, or nothing for a sign. `next` is the kind of the next token.
std::optional<TokenKind> token_kind(const Program& program, const lang::Token& token, int next) {
  switch (token.kind) {
    case Kind::S_STRING:
    case Kind::S_STRING_START:
    case Kind::S_STRING_MIDDLE:
    case Kind::S_STRING_END:
      return TokenKind::string;
    case Kind::S_INTEGER:
    case Kind::S_FLOAT:
      return TokenKind::number;
    case Kind::S_OBJECT_NAME:
      return TokenKind::object;
    case Kind::S_IDENTIFIER:
      return next == Kind::S_ARROW ? TokenKind::attribute : kind_of_name(program, token.span);
    default:
      break;
  }
  const char first = program.text_of(token.span)[0];
  const bool is_word = (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
  return is_word ? std::optional(TokenKind::keyword) : std::nullopt;
}

}  // namespace

std::vector<ScriptToken> tokens_of(const Program& program) {
  std::vector<ScriptToken> result;
  const auto add = [&](lang::Span span, TokenKind kind) {
    result.push_back({span_in(program.main(), span), kind});
  };
  const auto& [tokens, comments, open] = program.tokens();
  auto comment = comments.begin();
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    for (; comment != comments.end() && comment->begin < tokens[i].span.begin; ++comment)
      add(*comment, TokenKind::comment);
    const int next = i + 1 < tokens.size() ? tokens[i + 1].kind : Kind::S_YYEOF;
    if (const auto kind = token_kind(program, tokens[i], next)) add(tokens[i].span, *kind);
  }
  for (; comment != comments.end(); ++comment) add(*comment, TokenKind::comment);
  return result;
}

}  // namespace crt::service
