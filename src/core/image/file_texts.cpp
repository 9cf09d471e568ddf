#include "core/image/file_texts.hpp"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

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

/// Adds how pixels were sampled, as far as that differs from the defaults.
void add_sampling(FileTexts& texts, const Settings& settings) {
  if (settings.target_error > 0)
    add(texts, "crt:targeterror", text::format("{}", settings.target_error));
  if (settings.time_budget > 0)
    add(texts, "crt:timebudget", text::format("{}", settings.time_budget));
  if (settings.target_error > 0 || settings.time_budget > 0) {
    add(texts, "crt:minsamples", text::format("{}", settings.min_samples));
    add(texts, "crt:maxsamples", text::format("{}", settings.max_samples));
  }
  if (settings.filter == PixelFilter::box) return;
  add(texts, "crt:filter", "blackmanharris");
  add(texts, "crt:filterwidth", text::format("{}", settings.filter_width));
}

void add_settings(FileTexts& texts, const Settings& settings) {
  add(texts, "crt:gamma", text::format("{}", settings.gamma));
  add(texts, "crt:supersampling", text::format("{}", settings.supersampling));
  add(texts, "crt:dofsamples", text::format("{}", settings.dof_samples));
  add_sampling(texts, settings);
  add(texts, "crt:recursiondepth", text::format("{}", settings.recursion_depth));
  add(texts, "crt:minweight", text::format("{}", settings.min_weight));
  add(texts, "crt:falloffmodel", settings.falloff_model == FalloffModel::path ? "path" : "light");
  if (settings.ambient_model == AmbientModel::surface) add(texts, "crt:ambientmodel", "surface");
  if (!settings.head_light) add(texts, "crt:headlight", "false");
  add(texts, "crt:showclip", settings.show_clip ? "true" : "false");
  add(texts, "crt:seed", text::format("{}", settings.seed));
  if (settings.precision == Precision::exact) add(texts, "crt:precision", "exact");
  if (settings.compat != 0) add(texts, "crt:compat", text::format("{}", settings.compat));
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
void add_accuracy(FileTexts& texts, const RenderStats& stats) {
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
  add_accuracy(texts, image.stats());
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
