#include "cli/stats_json.hpp"

#include <crt/schema_scene.hpp>
#include <crt/schema_settings.hpp>
#include <crt/version.hpp>
#include <nlohmann/json.hpp>
#include <type_traits>

namespace crt::cli {

namespace {

using Json = nlohmann::ordered_json;

Json settings_json(const Settings& settings, Projection projection) {
  Json object;
  schema::for_each_field<Settings>([&](const auto& row) {
    const auto& value = settings.*row.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    Json& member = object[std::string(row.script_name())];
    if constexpr (std::is_enum_v<Value>) {
      member = schema::script_name_of(value);
    } else {
      member = value;
    }
  });
  object["projection"] = schema::script_name_of(projection);
  return object;
}

Json report_json(const PictureReport& report) {
  const RenderStats& stats = report.stats;
  Json object = {{"version", version()}, {"script", report.script}, {"output", report.output}};
  if (report.frame) object["frame"] = *report.frame;
  if (const std::optional<Region>& region = report.region)
    object["region"] = {region->x, region->y, region->width, region->height};
  object["pixels"] = stats.pixels;
  object["threads"] = stats.threads;
  object["seconds"] = {{"parse", stats.parse_seconds},
                       {"prepare", stats.prepare_seconds},
                       {"trace", stats.trace_seconds},
                       {"write", stats.write_seconds}};
  object["memory_bytes"] = {{"primitives", stats.memory.primitives},
                            {"csg", stats.memory.csg},
                            {"tree", stats.memory.tree},
                            {"materials", stats.memory.materials}};
  object["accuracy"] = {{"passes", stats.passes},
                        {"samples_min", stats.samples_min},
                        {"samples_mean", stats.samples_mean},
                        {"samples_max", stats.samples_max},
                        {"half_width_rms", stats.half_width_rms},
                        {"half_width_95", stats.half_width_95},
                        {"half_width_max", stats.half_width_max},
                        {"pixels_unresolved", stats.pixels_unresolved},
                        {"unseen_share", stats.unseen_share},
                        {"cutoff_mean", stats.cutoff_mean},
                        {"cutoff_max", stats.cutoff_max}};
  object["rays"] = {{"camera", stats.camera_rays},
                    {"shadow", stats.shadow_rays},
                    {"reflection", stats.reflection_rays},
                    {"refraction", stats.refraction_rays},
                    {"below_min_weight", stats.rays_below_min_weight},
                    {"beyond_depth", stats.rays_beyond_depth}};
  object["counters"] = {{"samples_over_ray_bound", stats.samples_over_ray_bound},
                        {"intersection_tests", stats.intersection_tests},
                        {"interval_events", stats.interval_events},
                        {"escalations", stats.escalations},
                        {"undecided", stats.undecided},
                        {"media_lookups", stats.media_lookups},
                        {"media_changes", stats.media_changes},
                        {"pattern_lookups", stats.pattern_lookups},
                        {"lens_samples", stats.lens_samples}};
  object["settings"] = settings_json(report.settings, report.projection);
  return object;
}

/// Bytes that are no UTF-8 (a path may have them) become U+FFFD.
std::string text_of(const Json& json) {
  constexpr int indentation = 2;
  return json.dump(indentation, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const PictureReport& report) {
  return text_of(report_json(report));
}

std::string to_json(const std::vector<PictureReport>& reports) {
  Json list = Json::array();
  for (const PictureReport& report : reports) list.push_back(report_json(report));
  return text_of(list);
}

}  // namespace crt::cli
