// This stands for fonts.
#include "crt/error.hpp"
#include "crt/text.hpp"
#include "text/left_out.hpp"

namespace crt {

namespace {

[[noreturn]] void refuse_font() {
  throw Error(ErrorCode::unsupported, text::left_out("fonts", "FONTS"));
}

}  // namespace

std::shared_ptr<const Font> read_font(const std::filesystem::path&) {
  refuse_font();
}

std::shared_ptr<const Font> decode_font(std::span<const std::byte>, const std::string&) {
  refuse_font();
}

std::shared_ptr<const Font> standard_font() {
  refuse_font();
}

TextContours text_contours(std::string_view, const Font&, const TextLayout&) {
  refuse_font();
}

}  // namespace crt
