#include "core/contours/font.hpp"

#include <exception>
#include <utility>

#include "core/base/whole_file.hpp"
#include "core/contours/append.hpp"
#include "core/contours/fill.hpp"
#include "crt/curves.hpp"
#include "crt/error.hpp"
#include "crt/text.hpp"
#include "text/format.hpp"

namespace crt {

using namespace core;

namespace {

constexpr std::size_t most_bytes = std::size_t{64} << 20;

[[noreturn]] void refuse_font(const std::string& name, const std::string& reason) {
  throw Error(ErrorCode::io, text::format("'{}' {}", name, reason));
}

}  // namespace

Font::Font(std::span<const std::byte> content, std::string name)
    : content_(content), name_(std::move(name)) {
  check();
}

Font::Font(std::vector<std::byte> kept, std::string name)
    : kept_(std::move(kept)), content_(kept_), name_(std::move(name)) {
  check();
}

void Font::check() const {
  if (content_.size() > most_bytes) refuse_font(name_, "is too large for a font: over 64 MiB");
  const FontReader reader(*this);
}

std::shared_ptr<const Font> decode_font(std::span<const std::byte> content,
                                        const std::string& name) {
  return std::make_shared<const Font>(std::vector<std::byte>(content.begin(), content.end()), name);
}

namespace core {

namespace {

/// A GlyphDrawer turns what FreeType says of a glyph into contours. Nothing may be thrown through
/// FreeType, so an exception is kept.
struct GlyphDrawer {
  double scale = 1;
  double deviation = 0;
  std::size_t max_corners = 0;
  std::vector<Contour> contours{};
  Contour contour{};
  std::size_t corners = 0;
  std::exception_ptr exception{};

  CurvePoint place(const FT_Vector& v) const {
    return {scale * static_cast<double>(v.x), scale * static_cast<double>(v.y)};
  }

  template <class Step>
  static int guarded(void* user, const Step& step) {
    auto& drawer = *static_cast<GlyphDrawer*>(user);
    try {
      step(drawer);
      if (drawer.corners + drawer.contour.size() > drawer.max_corners) {
        throw Error(ErrorCode::limit, "the text has too many corners: make it several");
      }
      return 0;
    } catch (...) {
      drawer.exception = std::current_exception();
      return 1;
    }
  }
  static int move(const FT_Vector* to, void* user) {
    return guarded(user, [&](GlyphDrawer& drawer) {
      drawer.finish_contour();
      drawer.contour.push_back({drawer.place(*to).x, drawer.place(*to).y});
    });
  }
  static int line(const FT_Vector* to, void* user) {
    return guarded(user, [&](GlyphDrawer& drawer) {
      append_corner(drawer.contour, {drawer.place(*to).x, drawer.place(*to).y});
    });
  }
  static int conic(const FT_Vector* control, const FT_Vector* to, void* user) {
    return guarded(user, [&](GlyphDrawer& drawer) {
      append_quadratic(drawer.contour, drawer.place(*control), drawer.place(*to), drawer.deviation);
    });
  }
  static int cubic(const FT_Vector* control1, const FT_Vector* control2, const FT_Vector* to,
                   void* user) {
    return guarded(user, [&](GlyphDrawer& drawer) {
      append_cubic(drawer.contour, drawer.place(*control1), drawer.place(*control2),
                   drawer.place(*to), drawer.deviation);
    });
  }

  void finish_contour() {
    corners += contour.size();
    if (encloses_area(contour)) contours.push_back(std::move(contour));
    contour.clear();
  }
};

}  // namespace

FontReader::FontReader(const Font& font) : font_(font) {
  const FreeType& functions = free_type();
  if (functions.init(&library_) != 0) {
    throw Error(ErrorCode::out_of_memory, "FreeType cannot begin");
  }
  const std::span<const std::byte> content = font.content();
  const FT_Error failure =
      functions.new_face(library_, reinterpret_cast<const FT_Byte*>(content.data()),
                         static_cast<FT_Long>(content.size()), 0, &face_);
  const bool has_curves =
      failure == 0 && FT_IS_SCALABLE(face_) && face_->units_per_EM != 0 && face_->num_glyphs > 0;
  if (has_curves) return;
  functions.done(library_);  // with the face
  refuse_font(font.name(),
              failure == 0 ? "is a font without curves" : "is no font that FreeType can read");
}

FontReader::~FontReader() {
  free_type().done(library_);  // with the face
}

double FontReader::units_per_em() const {
  return face_->units_per_EM;
}

double FontReader::line_height() const {
  constexpr double usual = 1.2;
  return face_->height > 0 ? face_->height : usual * units_per_em();
}

std::uint32_t FontReader::glyph_of(char32_t letter) const {
  return free_type().glyph_index(face_, letter);
}

double FontReader::kerning(std::uint32_t first, std::uint32_t second) const {
  if (!FT_HAS_KERNING(face_)) return 0;
  FT_Vector closer{};
  if (free_type().kerning(face_, first, second, FT_KERNING_UNSCALED, &closer) != 0) return 0;
  return static_cast<double>(closer.x);
}

Glyph FontReader::glyph(std::uint32_t number, double scale, double deviation,
                        std::size_t max_corners) const {
  const FreeType& functions = free_type();
  constexpr FT_Int32 flags = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;
  if (functions.load_glyph(face_, number, flags) != 0 ||
      face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE) {
    refuse_font(font_.name(), text::format("has a broken glyph (number {})", number));
  }
  GlyphDrawer drawer{.scale = scale, .deviation = deviation, .max_corners = max_corners};
  const FT_Outline_Funcs steps{.move_to = &GlyphDrawer::move,
                               .line_to = &GlyphDrawer::line,
                               .conic_to = &GlyphDrawer::conic,
                               .cubic_to = &GlyphDrawer::cubic,
                               .shift = 0,
                               .delta = 0};
  const FT_Error failure = functions.decompose(&face_->glyph->outline, &steps, &drawer);
  if (drawer.exception) std::rethrow_exception(drawer.exception);
  if (failure != 0)
    refuse_font(font_.name(), text::format("has a broken glyph (number {})", number));
  drawer.finish_contour();
  return {.contours = std::move(drawer.contours),
          .advance = static_cast<double>(face_->glyph->advance.x)};
}

}  // namespace core

std::shared_ptr<const Font> read_font(const std::filesystem::path& path) {
  return std::make_shared<const Font>(read_whole_file(path, most_bytes), path.string());
}

}  // namespace crt
