#include "lsp/semantic_tokens.hpp"

#include <string_view>

#include "service/tokens.hpp"

namespace crt::lsp {

namespace {

class TokenEncoder {
 public:
  TokenEncoder(const lang::Source& source, Encoding encoding)
      : source_(source), encoding_(encoding) {}

  void add(TextSpan span, TokenKind kind) {
    const std::uint32_t byte = span.begin;
    std::uint32_t lines = 0;
    while (line_ + 1 < source_.line_starts.size() && source_.line_starts[line_ + 1] <= byte) {
      ++line_;
      ++lines;
    }
    if (lines > 0) place_ = source_.line_starts[line_];
    // Each character is counted once, however long its line is.
    const std::uint32_t distance = characters(place_, byte);
    data_.insert(data_.end(), {lines, distance, characters(byte, span.end),
                               static_cast<std::uint32_t>(kind), 0});
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

}  // namespace

std::vector<std::uint32_t> semantic_tokens(const service::Program& program, Encoding encoding) {
  TokenEncoder encoder(program.main(), encoding);
  for (const ScriptToken& token : service::tokens_of(program)) encoder.add(token.span, token.kind);
  return encoder.take();
}

}  // namespace crt::lsp
