// This says what names consist of.
#pragma once

namespace crt::lang {

/// Says whether a byte is part of a name or a number: a letter of English, a digit or '_'.
inline bool is_word_byte(int c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

}  // namespace crt::lang
