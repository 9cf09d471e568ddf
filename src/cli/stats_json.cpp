#include "cli/stats_json.hpp"

#include <fmt/format.h>

#include <crt/version.hpp>
#include <cstdint>
#include <string_view>

namespace crt::cli {

namespace {

/// Returns how many bytes the UTF-8 sequence at the start of `text` has, or 0 if it is none.
std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xc2 ? 0
                             : lead < 0xe0 ? 2
                             : lead < 0xf0 ? 3
                             : lead < 0xf5 ? 4
                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  }
  if (length < 3) return length;
  // Overlong forms, surrogates, and what lies beyond U+10FFFF are not valid.
  const auto second = static_cast<unsigned char>(text[1]);
  const bool wrong = (lead == 0xe0 && second < 0xa0) || (lead == 0xed && second >= 0xa0) ||
                     (lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second >= 0x90);
  return wrong ? 0 : length;
}

/// Returns a JSON string. Bytes that are no UTF-8 (a path may have them) become U+FFFD.
std::string json_string(std::string_view text) {
  std::string result = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text[0];
    if (length == 0) {
      result += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", c);
    } else {
      result += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result + '"';
}

std::string value(const std::string& text) {
  return json_string(text);
}
std::string value(double number) {
  return fmt::format("{}", number);
}
std::string value(std::uint64_t number) {
  return fmt::format("{}", number);
}
std::string value(int number) {
  return fmt::format("{}", number);
}
std::string value(bool truth) {
  return truth ? "true" : "false";
}

/// Collects the members of an object, indented by two blanks a level.
class ObjectWriter {
 public:
  explicit ObjectWriter(int level) : margin_(static_cast<std::size_t>(2 * level), ' ') {}

  template <class Value>
  ObjectWriter& add(std::string_view name, const Value& member) {
    return add_raw(name, value(member));
  }

  /// `json` is well-formed JSON already.
  ObjectWriter& add_raw(std::string_view name, std::string_view json) {
    text_ +=
        fmt::format("{}\n{}  {}: {}", text_.empty() ? "" : ",", margin_, json_string(name), json);
    return *this;
  }

  std::string text() const { return "{" + text_ + "\n" + margin_ + "}"; }

 private:
  std::string margin_;
  std::string text_;
};

std::string name_of(Projection projection) {
  switch (projection) {
    case Projection::pinhole:
      return "pinhole";
    case Projection::spherical:
      return "spherical";
    case Projection::cylindrical:
      return "cylindrical";
    case Projection::orthographic:
      return "orthographic";
  }
  return "";
}

std::string name_of(FalloffModel model) {
  return model == FalloffModel::path ? "path" : "light";
}

std::string name_of(AmbientModel model) {
  return model == AmbientModel::light ? "light" : "surface";
}

std::string name_of(Precision precision) {
  return precision == Precision::exact ? "exact" : "standard";
}

std::string name_of(PixelFilter filter) {
  return filter == PixelFilter::box ? "box" : "blackmanharris";
}

std::string settings_json(const Settings& settings, Projection projection, int level) {
  return ObjectWriter(level)
      .add("title", settings.title)
      .add("author", settings.author)
      .add("date", settings.date)
      .add("notes", settings.notes)
      .add("width", settings.width)
      .add("height", settings.height)
      .add("gamma", settings.gamma)
      .add("supersampling", settings.supersampling)
      .add("dofsamples", settings.dof_samples)
      .add("targeterror", settings.target_error)
      .add("timebudget", settings.time_budget)
      .add("minsamples", settings.min_samples)
      .add("maxsamples", settings.max_samples)
      .add("filter", name_of(settings.filter))
      .add("filterwidth", settings.filter_width)
      .add("recursiondepth", settings.recursion_depth)
      .add("minweight", settings.min_weight)
      .add("falloffmodel", name_of(settings.falloff_model))
      .add("ambientmodel", name_of(settings.ambient_model))
      .add("headlight", settings.head_light)
      .add("showclip", settings.show_clip)
      .add("seed", settings.seed)
      .add("precision", name_of(settings.precision))
      .add("compat", settings.compat)
      .add("projection", name_of(projection))
      .text();
}

std::string seconds_json(const RenderStats& stats, int level) {
  return ObjectWriter(level)
      .add("parse", stats.parse_seconds)
      .add("prepare", stats.prepare_seconds)
      .add("trace", stats.trace_seconds)
      .add("write", stats.write_seconds)
      .text();
}

std::string memory_json(const MemoryUse& memory, int level) {
  return ObjectWriter(level)
      .add("primitives", memory.primitives)
      .add("csg", memory.csg)
      .add("tree", memory.tree)
      .add("materials", memory.materials)
      .text();
}

std::string rays_json(const RenderStats& stats, int level) {
  return ObjectWriter(level)
      .add("camera", stats.camera_rays)
      .add("shadow", stats.shadow_rays)
      .add("reflection", stats.reflection_rays)
      .add("refraction", stats.refraction_rays)
      .add("below_min_weight", stats.rays_below_min_weight)
      .add("beyond_depth", stats.rays_beyond_depth)
      .text();
}

std::string accuracy_json(const RenderStats& stats, int level) {
  return ObjectWriter(level)
      .add("passes", stats.passes)
      .add("samples_min", stats.samples_min)
      .add("samples_mean", stats.samples_mean)
      .add("samples_max", stats.samples_max)
      .add("half_width_rms", stats.half_width_rms)
      .add("half_width_95", stats.half_width_95)
      .add("half_width_max", stats.half_width_max)
      .add("pixels_unresolved", stats.pixels_unresolved)
      .add("unseen_share", stats.unseen_share)
      .add("cutoff_mean", stats.cutoff_mean)
      .add("cutoff_max", stats.cutoff_max)
      .text();
}

std::string counters_json(const RenderStats& stats, int level) {
  return ObjectWriter(level)
      .add("samples_over_ray_bound", stats.samples_over_ray_bound)
      .add("intersection_tests", stats.intersection_tests)
      .add("interval_events", stats.interval_events)
      .add("escalations", stats.escalations)
      .add("undecided", stats.undecided)
      .add("media_lookups", stats.media_lookups)
      .add("media_changes", stats.media_changes)
      .add("pattern_lookups", stats.pattern_lookups)
      .add("lens_samples", stats.lens_samples)
      .text();
}

std::string report_json(const PictureReport& report, int level) {
  ObjectWriter object(level);
  object.add("version", std::string(version()))
      .add("script", report.script)
      .add("output", report.output);
  if (report.frame) object.add("frame", *report.frame);
  if (report.region) {
    const Region& region = *report.region;
    object.add_raw(
        "region", fmt::format("[{}, {}, {}, {}]", region.x, region.y, region.width, region.height));
  }
  return object.add("pixels", report.stats.pixels)
      .add("threads", report.stats.threads)
      .add_raw("seconds", seconds_json(report.stats, level + 1))
      .add_raw("memory_bytes", memory_json(report.stats.memory, level + 1))
      .add_raw("accuracy", accuracy_json(report.stats, level + 1))
      .add_raw("rays", rays_json(report.stats, level + 1))
      .add_raw("counters", counters_json(report.stats, level + 1))
      .add_raw("settings", settings_json(report.settings, report.projection, level + 1))
      .text();
}

}  // namespace

std::string to_json(const PictureReport& report) {
  return report_json(report, 0) + "\n";
}

std::string to_json(const std::vector<PictureReport>& reports) {
  std::string text;
  for (const PictureReport& report : reports) {
    text += fmt::format("{}\n  {}", text.empty() ? "" : ",", report_json(report, 1));
  }
  return "[" + text + "\n]\n";
}

}  // namespace crt::cli
