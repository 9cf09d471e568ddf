#include "studio/solid_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/error.hpp>
#include <crt/measure.hpp>
#include <crt/schema_settings.hpp>
#include <crt/surface_mesh.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "studio/messages.hpp"

namespace crt::studio {

using nlohmann::json;

namespace {

/// This is as long as one waits for numbers that one did not ask for.
constexpr double most_seconds = 3;
constexpr double width_of_measures = 1e-4;
constexpr std::array<std::string_view, 5> surface_formats = {"stl", "obj", "ply", "3mf", "glb"};

/// What is infinite is null.
json number_json(double number) {
  return std::isfinite(number) ? json(number) : json(nullptr);
}
json interval_json(const Interval& interval) {
  return {number_json(interval.lower), number_json(interval.upper)};
}
json bound_json(const Vec3& corner) {
  return {number_json(corner.x), number_json(corner.y), number_json(corner.z)};
}

}  // namespace

json measures_json(const View& view, std::size_t entity, const std::function<bool()>& goes_on) {
  const Entity& solid = view.original->entities.at(entity);
  const MeasureOptions options{
      .relative_width = width_of_measures, .seconds = most_seconds, .go_on = goes_on};
  const Unit unit = view.original->settings.unit;
  json result = {{"entity", entity},
                 {"revision", view.revision.number},
                 {"unit", schema::script_name_of(unit)},
                 {"metres", metres_of(unit)}};
  const BoundingBox bounds = tight_bounding_box(solid, options);
  result["lower"] = bound_json(bounds.lower);
  result["upper"] = bound_json(bounds.upper);
  try {
    const MassProperties mass = mass_properties(solid, options);
    result["volume"] = interval_json(mass.volume);
    result["area"] = interval_json(mass.area);
    result["centroid"] = {interval_json(mass.centroid[0]), interval_json(mass.centroid[1]),
                          interval_json(mass.centroid[2])};
  } catch (const Error& error) {
    if (error.code() != ErrorCode::invalid_argument) throw;
    result["fault"] = error.what();
  }
  try {
    if (const double of_materials = density(solid); of_materials > 0)
      result["density"] = of_materials;
  } catch (const Error& error) {
    // Its parts have different ones.
    if (error.code() != ErrorCode::invalid_argument) throw;
  }
  return result;
}

SurfaceQuestion surface_question_of(const View& view, const json& message) {
  SurfaceQuestion question{
      .format = message.at("format").get<std::string>(), .deviation = 0, .entity = {}};
  if (std::ranges::find(surface_formats, question.format) == surface_formats.end())
    throw Error(ErrorCode::invalid_argument, "surfaces are stl, obj, ply, 3mf or glb");
  question.deviation = message.value("deviation", 0.0);
  if (!(question.deviation >= 0 && std::isfinite(question.deviation)))
    throw Error(ErrorCode::invalid_argument, "a deviation is a number above 0");
  if (message.contains("span")) question.entity = entity_of_span(view, message.at("span"));
  return question;
}

std::string surface_message(const View& view, const SurfaceQuestion& question,
                            const std::function<bool()>& goes_on) {
  const std::vector<Entity>& all = view.original->entities;
  const std::vector<Entity> entities =
      question.entity ? std::vector<Entity>{all.at(*question.entity)} : all;
  const double deviation = question.deviation > 0 ? question.deviation : usual_deviation(entities);
  std::vector<SurfaceMesh> meshes;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < entities.size(); ++i) {
    try {
      meshes.push_back(tessellate(entities[i], deviation, {.go_on = goes_on}));
      places.push_back(i);
    } catch (const Error& error) {
      // Of a whole scene the ground, which has no end, is left out.
      if (question.entity || error.code() != ErrorCode::invalid_argument) throw;
    }
  }
  std::vector<SurfaceMeshPart> parts;
  parts.reserve(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i)
    parts.push_back({.mesh = &meshes[i],
                     .name = "entity " + std::to_string(question.entity.value_or(places[i])),
                     .color = plain_color(entities[places[i]])});
  const std::vector<std::byte> bytes = encode_surface_mesh(
      parts, surface_mesh_format("a." + question.format), {.unit = view.original->settings.unit});
  std::string file = "CRTI" + question.format + " ";
  file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return file;
}

}  // namespace crt::studio
