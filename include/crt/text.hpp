// Text becomes contours of profiles: the letters of a font.
#pragma once

#include <crt/svg_path.hpp>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crt {

/// A Font has the shapes of letters. It is immutable, and any thread may use it.
class Font;

/// Reads a font file: TrueType, OpenType, Type 1 or another format with curves that FreeType knows.
/// Of a file with several fonts it is the first. Throws Error (io) if there is no such file, if it
/// has over 64 MiB, or if it is no such font. Throws Error (unsupported) if the library of FreeType
/// is not there, which is loaded on first use.
std::shared_ptr<const Font> read_font(const std::filesystem::path& path);

/// Takes a font file from memory, as the function above does. Messages call it `name`.
std::shared_ptr<const Font> decode_font(std::span<const std::byte> content,
                                        const std::string& name);

/// Returns the font that comes with the library: Liberation Sans, which has Latin, Greek and
/// Cyrillic letters. Throws Error (unsupported) as read_font() does.
std::shared_ptr<const Font> standard_font();

/// Says where lines of text are, from the origin of x on.
enum class TextAlignment {
  left,    ///< lines begin there
  center,  ///< lines have their middle there
  right,   ///< lines end there
};

/// A TextLayout says how letters are put side by side.
struct TextLayout {
  /// The size of the font's em in scene units, above 0. Capital letters are about 0.7 of it high,
  /// and lines are about 1.15 of it apart.
  double size = 1;
  TextAlignment alignment = TextAlignment::left;
  /// The distance of lines as a multiple of what the font says, in [-1000, 1000].
  double line_spacing = 1;
  /// How contours come near the curves of letters. By default the nonzero rule says what is inside,
  /// as in fonts. So letters whose contours overlap are one region.
  PathOptions options{};
};

/// A TextContours is text as contours for the even-odd rule.
struct TextContours {
  std::vector<Contour> contours{};   ///< none if the text has nothing to see
  std::u32string missing_letters{};  ///< of which the font has none, each once, in their order
  double width = 0;                  ///< of the longest line, in scene units
};

/// Returns the contours of text in UTF-8. The first line stands on y = 0, and others are below it.
/// Lines are ended by "\n" or "\r\n". A tab is as wide as four blanks. Pairs of letters come closer
/// where the font has a kern table. A letter that the font lacks is the box that it has for that.
/// There are no ligatures, and letters follow one another from left to right.
///
/// Throws Error (invalid_argument) if the text is not UTF-8, naming the byte, if a number of the
/// layout is out of its range, and as append_cubic() does. Throws Error (limit) for over 2^16
/// letters or 2^20 corners. Throws Error (io) if the font has a broken letter, and (unsupported)
/// and (limit) as svg_path_contours() does.
TextContours text_contours(std::string_view text, const Font& font, const TextLayout& layout = {});

}  // namespace crt
