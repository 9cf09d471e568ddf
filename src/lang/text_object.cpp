#include "lang/text_object.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "crt/text.hpp"
#include "lang/object_builder.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// A Lettering is what a script says of a Text.
struct Lettering {
  std::string text;
  double depth = 0;
  double size = 1;
  std::shared_ptr<const Font> font;
  TextAlignment alignment = TextAlignment::left;
  double line_spacing = 1;
  std::optional<SharedMaterial> material;
};

void warn_of_missing(const std::u32string& letters, const ObjectSite& site) {
  if (letters.empty()) return;
  constexpr std::size_t max_shown = 8;
  std::string shown;
  for (const char32_t letter : letters.substr(0, max_shown)) {
    shown += text::format("{}U+{:04X}", shown.empty() ? "" : ", ", static_cast<unsigned>(letter));
  }
  site.context.reporter.warning(
      find_given(site.attributes, "text")->value_span,
      text::format("the font has no letter for {} character{} of 'text': {}{}", letters.size(),
                   letters.size() == 1 ? "" : "s", shown,
                   letters.size() > max_shown ? ", ..." : ""));
}

Value nothing(const ObjectSite& site, std::string_view attribute, std::string_view reason) {
  site.context.reporter.warning(
      find_given(site.attributes, attribute)->value_span,
      text::format("'{}' {}: what has no size draws nothing", attribute, reason));
  return empty_entity();
}

Value finish_text(Lettering lettering, const ObjectSite& site) {
  Context& context = site.context;
  context.count_made(site.name_span);
  TextLayout layout{.size = lettering.size,
                    .alignment = lettering.alignment,
                    .line_spacing = lettering.line_spacing};
  // The work of so many steps of the core takes about as long as one of a script, and the memory of
  // a corner is paid for as in a profile.
  constexpr std::uint64_t work_per_step = 16;
  constexpr std::size_t steps_per_corner = 64;
  layout.options.work = [&](std::uint64_t work) {
    context.spend(site.name_span, static_cast<std::size_t>(work / work_per_step));
  };
  const std::shared_ptr<const Font> font = lettering.font ? lettering.font : standard_font();
  const TextContours made = text_contours(lettering.text, *font, layout);
  warn_of_missing(made.missing_letters, site);
  if (made.contours.empty()) return nothing(site, "text", "has nothing to see");
  if (lettering.depth == 0) return nothing(site, "depth", "is 0");
  for (const Contour& contour : made.contours) {
    context.spend(site.name_span, steps_per_corner * contour.size());
  }
  const Entity entity = Extrusion{.profile = make_profile(made.contours), .to = lettering.depth};
  return lettering.material ? entity.with_material(*lettering.material) : entity;
}

}  // namespace

ObjectType text_object() {
  return object<Lettering>(
      "Text",
      {required("text", &Lettering::text), required("depth", &Lettering::depth),
       attribute("size", &Lettering::size, "1"),
       attribute("font", &Lettering::font, "Liberation Sans"),
       attribute("alignment", &Lettering::alignment, "\"left\""),
       attribute("linespacing", &Lettering::line_spacing, "1"),
       attribute("material", &Lettering::material, "a grey of 0.5")},
      finish_text);
}

}  // namespace crt::lang
