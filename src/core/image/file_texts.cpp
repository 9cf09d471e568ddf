#include "core/image/file_texts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <type_traits>

#include "crt/schema_settings.hpp"
#include "crt/version.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

// These are OpenImageIO's names, which it turns into those of the format. In PNG they become Title,
// Author, Description and Software. "Creation Time" is PNG's own for a date in free form.
constexpr std::string_view title_name = "DocumentName";
constexpr std::string_view author_name = "Artist";
constexpr std::string_view notes_name = "ImageDescription";
constexpr std::string_view software_name = "Software";
constexpr std::string_view date_name = "Creation Time";

void add(FileTexts& texts, std::string_view name, std::string value) {
  if (!value.empty()) texts.emplace_back(name, std::move(value));
}

/// Says whether a setting stands in files with any value, also with the first one of its kind.
bool is_always_written(std::string_view name) {
  constexpr std::string_view names[] = {"gamma",           "supersampling", "dof_samples",
                                        "recursion_depth", "min_weight",    "falloff_model",
                                        "cutoff",          "show_clip",     "seed"};
  return std::ranges::find(names, name) != std::end(names);
}

/// Returns what a setting is called in files, where the statistics may have its name.
std::string name_in_files(std::string_view name, std::string_view script_name) {
  if (name == "cutoff") return "crt:cutoffshows";
  return name == "denoise" ? "crt:denoised" : text::format("crt:{}", script_name);
}

/// Says whether a setting has an effect in this picture, and is not the size.
bool is_in_use(std::string_view name, const Settings& settings) {
  if (name == "width" || name == "height") return false;
  if (name == "cutoff") return settings.cutoff != Cutoff::background;
  if (name == "light_samples") return settings.light_samples > 1;
  if (name == "filter_width") return settings.filter != PixelFilter::box;
  if (name != "min_samples" && name != "max_samples") return true;
  return settings.target_error > 0 || settings.time_budget > 0;
}

/// Adds settings, of which most are left out where C has 0 for them.
void add_settings(FileTexts& texts, const Settings& settings) {
  schema::for_each_field<Settings>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    const Value& value = settings.*row.member;
    if constexpr (!std::is_same_v<Value, std::string>) {
      const bool is_zero_in_c = (value == Value{}) != row.c_name().starts_with("no_");
      if (!is_in_use(row.name, settings) || (is_zero_in_c && !is_always_written(row.name))) return;
      const std::string name = name_in_files(row.name, row.script_name());
      if constexpr (std::is_enum_v<Value>) {
        add(texts, name, std::string(schema::script_name_of(value)));
      } else {
        add(texts, name, text::format("{}", value));
      }
    }
  });
}

/// JPEG holds texts in segments of 64 KiB, several texts in one, and some with up to six bytes for
/// one. A longer text would make the JPEG library end the program.
constexpr std::size_t longest_short_text = 4000;

/// Returns the beginning of a text, not ending within a character of UTF-8.
std::string shortened(std::string text) {
  if (text.size() <= longest_short_text) return text;
  std::size_t end = longest_short_text;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) --end;
  text.resize(end);
  return text;
}

/// Adds how near to the truth a picture is that was rendered pass by pass.
void add_accuracy(FileTexts& texts, const RenderStats& stats, bool is_denoised) {
  if (stats.passes == 0) return;
  const auto add_numbers = [&](std::string_view name, std::initializer_list<double> numbers) {
    std::string list;
    for (const double number : numbers) {
      list += text::format("{}{:.6g}", list.empty() ? "" : " ", number);
    }
    add(texts, name, list);
  };
  add(texts, "crt:passes", text::format("{}", stats.passes));
  add_numbers("crt:samples", {static_cast<double>(stats.samples_min), stats.samples_mean,
                              static_cast<double>(stats.samples_max)});
  if (is_denoised) return;  // The rest is of what was before the filter.
  add_numbers("crt:halfwidth", {stats.half_width_rms, stats.half_width_95, stats.half_width_max});
  add(texts, "crt:unresolvedpixels", text::format("{}", stats.pixels_unresolved));
  add_numbers("crt:unseenshare", {stats.unseen_share});
  add_numbers("crt:cutoff", {stats.cutoff_mean, stats.cutoff_max});
}

/// Adds the counts that do not depend on how the work was done.
void add_counts(FileTexts& texts, const RenderStats& stats) {
  const auto add_count = [&](std::string_view name, std::uint64_t count) {
    if (count > 0) add(texts, name, text::format("{}", count));
  };
  add_count("crt:camerarays", stats.camera_rays);
  add_count("crt:shadowrays", stats.shadow_rays);
  add_count("crt:reflectionrays", stats.reflection_rays);
  add_count("crt:refractionrays", stats.refraction_rays);
}

}  // namespace

FileTexts file_texts(const Image& image, bool reproducible) {
  const Settings& settings = image.settings();
  FileTexts texts;
  add(texts, title_name, settings.title);
  add(texts, author_name, settings.author);
  add(texts, date_name, settings.date);
  add(texts, notes_name, settings.notes);
  add(texts, software_name, std::string("CRT ") + version());
  add_settings(texts, settings);
  add_accuracy(texts, image.stats(), settings.denoise);
  add_counts(texts, image.stats());
  const double seconds = image.stats().prepare_seconds + image.stats().trace_seconds;
  if (!reproducible && seconds > 0)
    add(texts, "crt:renderseconds", text::format("{:.3f}", seconds));
  return texts;
}

FileTexts gathered_texts(const FileTexts& texts) {
  FileTexts gathered;
  std::string description;
  for (const auto& [name, value] : texts) {
    if (name == author_name || name == software_name) {
      gathered.emplace_back(name, shortened(value));
    } else if (name == title_name || name == notes_name) {
      description += value + "\n";
    } else {
      description += text::format("{}: {}\n", name, value);
    }
  }
  add(gathered, notes_name, shortened(std::move(description)));
  return gathered;
}

}  // namespace crt::core
