// Fonts and their glyphs, which FreeType reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/contours/free_type.hpp"
#include "crt/primitives.hpp"

namespace crt {

class Font {
 public:
  /// Takes a font file, which is to be valid. The bytes must outlive this unless they are `kept`.
  Font(std::span<const std::byte> content, std::string name);
  Font(std::vector<std::byte> kept, std::string name);

  std::span<const std::byte> content() const { return content_; }
  const std::string& name() const { return name_; }

 private:
  void check() const;

  std::vector<std::byte> kept_;
  std::span<const std::byte> content_;
  std::string name_;
};

namespace core {

/// A Glyph is the shape of a letter. Lengths are in units of the font.
struct Glyph {
  std::vector<Contour> contours;  ///< for the nonzero rule, in scene units, from the origin on
  double advance = 0;             ///< to the next letter
};

/// A FontReader is a font that is being used. One thread may use it at a time.
class FontReader {
 public:
  explicit FontReader(const Font& font);
  FontReader(const FontReader&) = delete;
  FontReader& operator=(const FontReader&) = delete;
  ~FontReader();

  double units_per_em() const;
  double line_height() const;
  /// Returns the number of a letter's glyph, or 0 if there is none.
  std::uint32_t glyph_of(char32_t letter) const;
  /// Returns how much closer than by its advance the second of two glyphs is, as a number below 0.
  double kerning(std::uint32_t first, std::uint32_t second) const;
  /// Reads a glyph with contours of at most `max_corners`. Throws Error (io, limit).
  Glyph glyph(std::uint32_t number, double scale, double deviation, std::size_t max_corners) const;

 private:
  const Font& font_;
  FT_Library library_ = nullptr;
  FT_Face face_ = nullptr;
};

}  // namespace core

}  // namespace crt
