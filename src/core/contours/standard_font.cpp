// The font that comes with the library is a part of it, as the standard materials are.
#include <cstddef>
#include <memory>

#include "core/contours/font.hpp"
#include "crt/text.hpp"

// The assembler puts the file's bytes here, which takes the compiler no time.
asm(R"(
  .pushsection .rodata
  .hidden crt_standard_font
  .hidden crt_standard_font_end
  .globl crt_standard_font
  .globl crt_standard_font_end
crt_standard_font:
  .incbin ")" CRT_STANDARD_FONT R"("
crt_standard_font_end:
  .popsection
)");

extern "C" {
extern const std::byte crt_standard_font[];
extern const std::byte crt_standard_font_end[];
}

namespace crt {

std::shared_ptr<const Font> standard_font() {
  return std::make_shared<const Font>(
      std::span<const std::byte>(crt_standard_font, crt_standard_font_end), "Liberation Sans");
}

}  // namespace crt
