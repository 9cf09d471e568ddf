// Hovering shows what a word is: the reference's text, or how a name was set.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lang/source_map.hpp"
#include "service/program.hpp"
#include "service/reference.hpp"

namespace crt::service {

struct Hover {
  std::string markdown;
  lang::Span span;
};

/// Returns what to show about the word at a byte of the main script, if there is anything.
std::optional<Hover> hover_at(const Program& program, std::uint32_t byte,
                              const Reference& reference);

}  // namespace crt::service
