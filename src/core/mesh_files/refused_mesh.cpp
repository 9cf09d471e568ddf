#include "core/mesh_files/refused_mesh.hpp"

#include "text/format.hpp"

namespace crt::core {

void refuse_line(std::size_t line, const std::string& reason) {
  throw RefusedMesh(text::format("line {}: {}", line, reason));
}

void refuse_byte(std::size_t byte, const std::string& reason) {
  throw RefusedMesh(text::format("byte {}: {}", byte, reason));
}

std::string in_quotes(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string result = "'";
  for (const char c : word.substr(0, longest)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f) {
      result += c;
    } else {
      result += text::format("\\x{:02x}", byte);
    }
  }
  return result + (word.size() > longest ? "...'" : "'");
}

}  // namespace crt::core
