#include "studio/view_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/cutters.hpp>
#include <crt/error.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "studio/material_ball.hpp"
#include "text/format.hpp"
#include "text/json.hpp"

namespace crt::studio {

using nlohmann::json;

namespace {

constexpr std::array<const char*, 8> channels = {"color", "depth",  "normal",  "id",
                                                 "part",  "albedo", "samples", "error"};
constexpr std::array<const char*, 3> modes = {"rendered", "material", "clay"};
constexpr std::array<const char*, 2> tone_maps = {"none", "filmic"};
/// Exposures go this far, as those of settings do.
constexpr double most_stops = 100;
/// Boxes are computed for so many entities, of so many primitives together.
constexpr std::size_t max_boxes = 2000;
constexpr std::uint64_t most_primitives = 100'000;
/// Regions end here. No picture is larger.
constexpr int largest_side = 65536;

/// Finds what has a name. `what` says what that is.
template <class Kind, std::size_t count>
Kind named(const std::array<const char*, count>& names, const std::string& name, const char* what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw Error(ErrorCode::invalid_argument, text::format("there is no {} '{}'", what, name));
  return static_cast<Kind>(found - names.begin());
}

double finite_number(const json& value) {
  const double number = value.get<double>();
  if (!std::isfinite(number))
    throw Error(ErrorCode::invalid_argument, "the options of the view must be finite numbers");
  return number;
}

SectionPlane section_of(const json& value) {
  const SectionPlane section{text::whole_number<int>(value.at("axis")),
                             finite_number(value.at("offset")), value.at("isFlipped").get<bool>()};
  if (section.axis < 0 || section.axis > 2)
    throw Error(ErrorCode::invalid_argument, "an axis is 0, 1 or 2");
  return section;
}

Region region_of(const json& value) {
  const auto number = [&](const char* name) {
    return static_cast<int>(std::clamp(finite_number(value.at(name)), 0.0, double{largest_side}));
  };
  return {number("x"), number("y"), number("width"), number("height")};
}

/// Without any the picture is shown as files are.
Display display_of(const json& value) {
  Display display;
  if (value.contains("exposure"))
    display.exposure = std::clamp(finite_number(value.at("exposure")), -most_stops, most_stops);
  if (value.contains("toneMap") && !value.at("toneMap").is_null())
    display.tone_map =
        named<ToneMap>(tone_maps, value.at("toneMap").get<std::string>(), "tone map");
  display.denoise = value.value("denoise", false);
  return display;
}

json corner_json(const Vec3& corner) {
  json result = json::array();
  for (const double x : {corner.x, corner.y, corner.z})
    result.push_back(std::isfinite(x) ? json(x) : json(nullptr));
  return result;
}

void add_box(json& boxes, const Entity& entity) {
  const BoundingBox box = bounding_box(entity);
  if (box.lower.x > box.upper.x) return;
  boxes.push_back({{"lower", corner_json(box.lower)}, {"upper", corner_json(box.upper)}});
}

}  // namespace

ViewOptions view_options_of(const json& value, const TextPlaces& places) {
  ViewOptions options;
  options.channel = named<Channel>(channels, value.at("channel").get<std::string>(), "channel");
  options.mode = named<ViewMode>(modes, value.value("mode", modes[0]), "mode");
  for (const json& span : value.at("hidden")) {
    options.hidden.push_back({places.byte_of(text::whole_number<std::uint32_t>(span.at(0))),
                              places.byte_of(text::whole_number<std::uint32_t>(span.at(1)))});
  }
  if (!value.at("section").is_null()) options.section = section_of(value.at("section"));
  if (!value.at("region").is_null()) options.region = region_of(value.at("region"));
  options.t = finite_number(value.at("t"));
  options.display = display_of(value);
  return options;
}

json boxes_json(const View& view) {
  json boxes = json::array();
  json cut_boxes = json::array();
  std::uint64_t primitives = 0;
  for (const Entity& entity : view.scene.entities) {
    primitives += entity.primitive_count();
    if (boxes.size() == max_boxes || primitives > most_primitives) break;
    add_box(boxes, entity);
    for (const Entity& cutter : cutters(entity, max_boxes - cut_boxes.size()))
      add_box(cut_boxes, cutter);
  }
  return {{"revision", view.revision.number},
          {"boxes", std::move(boxes)},
          {"cutters", std::move(cut_boxes)}};
}

json preview_json(const Analysis& analysis, std::uint32_t unit) {
  const auto file = material_ball(*analysis.revision.text, analysis.revision.name,
                                  analysis.service.tree(), analysis.places.byte_of(unit));
  return file ? json(*file) : json(nullptr);
}

json machine_message(const MachineState& state) {
  json message = {{"type", "machine"}, {"cores", state.cores}};
  if (state.load) message["load"] = *state.load;
  if (state.memory) message["memory"] = *state.memory;
  if (state.free_memory) message["freeMemory"] = *state.free_memory;
  if (state.studio_memory) message["studioMemory"] = *state.studio_memory;
  return message;
}

}  // namespace crt::studio
