#include "studio/messages.hpp"

#include <algorithm>
#include <array>
#include <crt/error.hpp>
#include <crt/query.hpp>
#include <crt/schema_settings.hpp>
#include <crt/source_code.hpp>
#include <crt/validate.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "studio/place_text.hpp"
#include "text/json.hpp"

namespace crt::studio {

using nlohmann::json;

namespace {

constexpr std::array<const char*, 7> completion_kinds = {
    "attribute", "object", "variable", "macro", "function", "constant", "keyword"};
constexpr std::array<const char*, 6> phases = {"script", "preparing", "rendering",
                                               "done",   "cancelled", "failed"};
constexpr std::array<const char*, 4> languages = {"cpp", "python", "c", "script"};
constexpr std::array<const char*, 4> projections = {"pinhole", "spherical", "cylindrical",
                                                    "orthographic"};

json span_json(const TextPlaces& places, TextSpan span) {
  return {places.unit_of(span.begin), places.unit_of(span.end)};
}

json vector_json(const Vec3& v) {
  return {v.x, v.y, v.z};
}

TextPlaces places_of(const View& view) {
  return TextPlaces(view.revision.text ? std::string_view(*view.revision.text) : "");
}

/// Returns the first entity that comes from within a piece of the text, or else around it.
std::size_t entity_within(const View& view, std::uint32_t begin, std::uint32_t end) {
  const TextPlaces places = places_of(view);
  const TextSpan piece{places.byte_of(begin), places.byte_of(end)};
  const auto is_within = [](const TextSpan& inner, const TextSpan& outer) {
    return outer.begin <= inner.begin && inner.end <= outer.end;
  };
  for (std::size_t i = 0; i < view.places.size(); ++i) {
    if (is_within(view.places[i].origin, piece) || is_within(view.places[i].statement, piece))
      return i;
  }
  for (std::size_t i = 0; i < view.places.size(); ++i) {
    if (is_within(piece, view.places[i].origin)) return i;
  }
  throw Error(ErrorCode::invalid_argument, "no entity of the scene comes from there");
}

json location_json(const Analysis& analysis, const ScriptLocation& location) {
  const bool is_main = location.file == analysis.revision.name;
  json result = {{"file", is_main ? "" : location.file}};
  if (is_main) result["span"] = span_json(analysis.places, location.span);
  return result;
}

/// Finds what the camera sees along a ray.
std::optional<Hit> seen_along(const View& view, const Ray& ray) {
  const std::vector<Entity>& entities = view.original->entities;
  const auto is_seen = [&](const Hit& hit) {
    return hit.entity_id >= entities.size() || entities[hit.entity_id].is_visible();
  };
  RayQueries queries(view.prepared);
  std::optional<Hit> hit = queries.intersect(ray);
  if (!hit || is_seen(*hit)) return hit;
  std::vector<Hit> hits;
  queries.crossings(ray, hits);
  const auto found = std::find_if(hits.begin(), hits.end(), is_seen);
  return found == hits.end() ? std::nullopt : std::optional(*found);
}

}  // namespace

json diagnostics_message(const Analysis& analysis) {
  json list = json::array();
  for (const Diagnostic& diagnostic : analysis.service.diagnostics()) {
    const bool is_main = diagnostic.place.file == analysis.revision.name;
    const TextSpan span = is_main ? analysis.places.span_of(diagnostic.place) : TextSpan{};
    std::string message = diagnostic.message;
    if (!is_main) {
      message.insert(0, ": ");
      message.insert(0, place_text(diagnostic.place, analysis.revision.name));
    }
    list.push_back({{"severity", diagnostic.severity == Severity::error ? "error" : "warning"},
                    {"message", std::move(message)},
                    {"line", is_main ? diagnostic.place.line : 0},
                    {"span", span_json(analysis.places, span)}});
  }
  return {{"type", "diagnostics"},
          {"revision", analysis.revision.number},
          {"diagnostics", std::move(list)}};
}

json state_message(const RenderState& state) {
  return {{"type", "state"},
          {"revision", state.revision},
          {"phase", phases.at(static_cast<std::size_t>(state.phase))},
          {"progress", state.progress},
          {"seconds", state.seconds},
          {"message", state.message}};
}

json scene_message(const View& view) {
  const Camera& camera = view.camera;
  const Settings& settings = view.scene.settings;
  std::uint64_t primitives = 0;
  for (const Entity& entity : view.scene.entities) primitives += entity.primitive_count();
  return {{"type", "scene"},
          {"revision", view.revision.number},
          {"width", settings.width},
          {"height", settings.height},
          {"entities", view.scene.entities.size()},
          {"primitives", primitives},
          {"lights", view.original->lights.size()},
          {"memory", view.prepared.memory().total()},
          {"warnings", view.prepared.warnings()},
          {"isOverridden", view.camera_is_overridden},
          {"readsTime", view.reads_time},
          {"frames", settings.frames},
          {"unit", schema::script_name_of(settings.unit)},
          {"camera",
           {{"position", vector_json(camera.position)},
            {"pointing", vector_json(camera.pointing)},
            {"fov", camera.fov},
            {"roll", camera.roll},
            {"aperture", camera.aperture},
            {"lensRadius", camera.lens_radius},
            {"focalDistance", camera.focal_distance},
            {"projection", projections.at(static_cast<std::size_t>(camera.projection))},
            {"apertureShape", static_cast<int>(camera.aperture_shape)}}}};
}

json finished_message(const Revision& revision, const Image& image) {
  const RenderStats& stats = image.stats();
  json result = {{"type", "finished"},
                 {"revision", revision.number},
                 {"stats",
                  {{"camera rays", stats.camera_rays},
                   {"shadow rays", stats.shadow_rays},
                   {"reflection rays", stats.reflection_rays},
                   {"refraction rays", stats.refraction_rays},
                   {"intersection tests", stats.intersection_tests},
                   {"exact fallbacks", stats.escalations},
                   {"samples of a pixel (mean)", stats.samples_mean},
                   {"passes", stats.passes},
                   {"threads", stats.threads},
                   {"seconds of preparing", stats.prepare_seconds},
                   {"seconds of tracing", stats.trace_seconds},
                   {"bytes of memory", stats.memory.total()}}}};
  if (image.settings().denoise) return result;  // nothing is known of its error
  result["stats"]["error of 95 of 100 pixels"] = stats.half_width_95;
  result["stats"]["error of pixels (root mean square)"] = stats.half_width_rms;
  return result;
}

json objects_json() {
  json objects = json::array();
  for (const ObjectDescription& object : describe_objects()) {
    json attributes = json::array();
    for (const AttributeDescription& attribute : object.attributes) {
      attributes.push_back({{"name", attribute.name},
                            {"type", attribute.type},
                            {"required", attribute.required},
                            {"default", attribute.default_text},
                            {"about", attribute.documentation}});
      if (!attribute.choices.empty()) attributes.back()["choices"] = attribute.choices;
    }
    objects.push_back({{"name", object.name}, {"attributes", std::move(attributes)}});
  }
  return objects;
}

json completion_json(const Analysis& analysis, std::uint32_t unit) {
  const CompletionList list = analysis.service.complete(analysis.places.byte_of(unit));
  json items = json::array();
  for (const Completion& item : list.items)
    items.push_back({{"kind", completion_kinds.at(static_cast<std::size_t>(item.kind))},
                     {"label", item.label},
                     {"detail", item.detail},
                     {"about", item.documentation},
                     {"text", item.text},
                     {"snippet", item.snippet},
                     {"rank", item.rank}});
  return {{"span", span_json(analysis.places, {list.begin, list.end})},
          {"items", std::move(items)}};
}

json hover_json(const Analysis& analysis, std::uint32_t unit) {
  const auto hover = analysis.service.hover(analysis.places.byte_of(unit));
  if (!hover) return nullptr;
  return {{"markdown", hover->markdown}, {"span", span_json(analysis.places, hover->span)}};
}

json definition_json(const Analysis& analysis, std::uint32_t unit) {
  const auto location = analysis.service.definition(analysis.places.byte_of(unit));
  return location ? location_json(analysis, *location) : json(nullptr);
}

json places_json(const Analysis& analysis, std::uint32_t unit) {
  json places = json::array();
  for (const ScriptLocation& location : analysis.service.places(analysis.places.byte_of(unit)))
    places.push_back(location_json(analysis, location));
  return places;
}

json rename_json(const Analysis& analysis, std::uint32_t unit, const std::string& name) {
  json spans = json::array();
  std::set<std::string> others;
  for (const ScriptLocation& place : analysis.service.rename(analysis.places.byte_of(unit), name)) {
    if (place.file == analysis.revision.name) {
      spans.push_back(span_json(analysis.places, place.span));
    } else {
      others.insert(place.file);
    }
  }
  return {{"spans", std::move(spans)}, {"others", others}};
}

json format_json(const Analysis& analysis) {
  const FormattedScript formatted = format_script(*analysis.revision.text, analysis.revision.name);
  return formatted.text ? json(*formatted.text) : json(nullptr);
}

json pick_json(const View& view, double x, double y) {
  const std::optional<Hit> hit = seen_along(view, camera_ray(view.prepared, x, y));
  if (!hit || hit->entity_id >= view.places.size()) return nullptr;
  const EntityPlace& place = view.places[hit->entity_id];
  const TextPlaces places = places_of(view);
  return {{"entity", hit->entity_id},
          {"revision", view.revision.number},
          {"distance", hit->t},
          {"position", vector_json(hit->position)},
          {"normal", vector_json(hit->normal)},
          {"statement", span_json(places, place.statement)},
          {"origin", span_json(places, place.origin)}};
}

std::size_t entity_of_span(const View& view, const json& span) {
  return entity_within(view, text::whole_number<std::uint32_t>(span.at(0)),
                       text::whole_number<std::uint32_t>(span.at(1)));
}

json code_json(const View& view, const json& question) {
  const auto language = question.at("language").get<std::string>();
  const auto found = std::find(languages.begin(), languages.end(), language);
  if (found == languages.end())
    throw Error(ErrorCode::invalid_argument, "code is written in cpp, python, c or script");
  const SourceOptions options{.language = static_cast<SourceLanguage>(found - languages.begin())};
  SourceCode code;
  if (!question.contains("span")) {
    code = source_code(*view.original, options);
  } else {
    const std::size_t entity = entity_of_span(view, question.at("span"));
    code = source_code(view.original->entities.at(entity), options);
  }
  if (!code.files.empty()) {
    throw Error(ErrorCode::unsupported,
                "the meshes and images of a script are files beside it, which cannot be copied: "
                "crt export --as script -o writes them");
  }
  return {{"text", code.text}, {"warnings", code.warnings}};
}

Camera camera_of(const json& value) {
  const auto vector = [&](const char* name) {
    const json& numbers = value.at(name);
    return Vec3{numbers.at(0).get<double>(), numbers.at(1).get<double>(),
                numbers.at(2).get<double>()};
  };
  Camera camera;
  camera.position = vector("position");
  camera.pointing = vector("pointing");
  camera.fov = value.at("fov").get<double>();
  camera.roll = value.at("roll").get<double>();
  camera.aperture = value.at("aperture").get<double>();
  camera.lens_radius = value.value("lensRadius", 0.0);
  camera.focal_distance = value.at("focalDistance").get<double>();
  const auto projection = value.at("projection").get<std::string>();
  const auto found = std::find(projections.begin(), projections.end(), projection);
  if (found == projections.end())
    throw Error(ErrorCode::invalid_argument, "there is no such projection");
  camera.projection = static_cast<Projection>(found - projections.begin());
  const int shape = text::whole_number<int>(value.at("apertureShape"));
  if (shape < 0 || shape > static_cast<int>(ApertureShape::line))
    throw Error(ErrorCode::invalid_argument, "there is no such shape of a lens");
  camera.aperture_shape = static_cast<ApertureShape>(shape);
  return camera;
}

std::string text_of(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace crt::studio
