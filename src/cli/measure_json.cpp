#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/measured.hpp"

namespace crt::cli {

namespace {

using Json = nlohmann::ordered_json;

/// What is infinite is null.
Json json_of(double number) {
  return std::isfinite(number) ? Json(number) : Json();
}
Json json_of(const Interval& number) {
  return {json_of(number.lower), json_of(number.upper)};
}
Json json_of(const Vec3& place) {
  return {json_of(place.x), json_of(place.y), json_of(place.z)};
}
Json json_of(const BoundingBox& box) {
  if (is_empty(box)) return {};
  return {{"lower", json_of(box.lower)}, {"upper", json_of(box.upper)}};
}
template <std::size_t count>
Json json_of(const std::array<Interval, count>& numbers) {
  Json list = Json::array();
  for (const Interval& number : numbers) list.push_back(json_of(number));
  return list;
}

Json json_of(const Section& section) {
  const auto place = [](const std::array<double, 2>& p) { return Json::array({p[0], p[1]}); };
  Json contours = Json::array();
  for (const Contour& contour : section.contours) {
    Json corners = Json::array();
    for (const ProfilePoint& corner : contour)
      corners.push_back({corner.x, corner.y, corner.bulge});
    contours.push_back(std::move(corners));
  }
  return {{"area", json_of(section.area)},           {"deviation", json_of(section.deviation)},
          {"lower", place(section.lower)},           {"upper", place(section.upper)},
          {"offset", section.frame.offset},          {"origin", json_of(section.frame.origin)},
          {"x_axis", json_of(section.frame.x_axis)}, {"y_axis", json_of(section.frame.y_axis)},
          {"contours", std::move(contours)}};
}

Json json_of(const Wall& wall) {
  Json object = {{"least", json_of(wall.thickness)}};
  if (!std::isfinite(wall.thickness.upper)) return object;
  object["from"] = json_of(wall.from);
  object["to"] = json_of(wall.to);
  return object;
}

Json json_of(const Measured& found) {
  Json object = {{"name", found.name}};
  const auto add_member = [&](const char* name, const auto& value) {
    if (value) object[name] = json_of(*value);
  };
  if (!found.fault.empty()) object["fault"] = found.fault;
  add_member("bounds", found.bounds);
  add_member("volume", found.volume);
  add_member("area", found.area);
  add_member("mass", found.mass);
  if (found.density > 0) object["density"] = found.density;
  if (found.mass_is_in_kg) object["mass_unit"] = "kg";
  add_member("centroid", found.centroid);
  add_member("inertia", found.inertia);
  add_member("section", found.section);
  add_member("thickness", found.wall);
  return object;
}

Json json_of(const MeasuredDistance& found) {
  return {{"first", found.first},
          {"second", found.second},
          {"distance", json_of(found.clearance.distance)},
          {"on_first", json_of(found.clearance.on_a)},
          {"on_second", json_of(found.clearance.on_b)},
          {"overlap", found.clearance.overlap}};
}
Json json_of(const Overlap& overlap) {
  return {
      {"first", overlap.first}, {"second", overlap.second}, {"volume", json_of(overlap.volume)}};
}
template <class Item>
Json json_of_all(const std::vector<Item>& items) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

}  // namespace

std::string measures_json(const MeasureRequest& request, const std::string& script,
                          std::string_view unit, const std::vector<Measured>& parts,
                          const MeasuredPairs& pairs) {
  Json object = {{"script", script}, {"unit", unit}, {"relative_width", request.relative_width}};
  if (request.mass) object["density"] = request.density.value_or(1);
  if (request.asks_for_entities()) {
    object["entities"] = Json::array();
    for (const Measured& part : parts) object["entities"].push_back(json_of(part));
    object["sum"] = json_of(sum_of(parts, request.density.has_value()));
  }
  if (!pairs.distances.empty()) object["distances"] = json_of_all(pairs.distances);
  if (pairs.overlaps) object["interference"] = json_of_all(*pairs.overlaps);
  // A script's name may be any bytes.
  return object.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace crt::cli
