// This file has the built-ins that make contours of profiles.
#include <array>
#include <functional>
#include <string>
#include <utility>

#include "crt/offset.hpp"
#include "crt/svg_path.hpp"
#include "lang/attributes.hpp"
#include "lang/builtins.hpp"
#include "lang/failure.hpp"
#include "lang/fields.hpp"

namespace crt::lang {

namespace {

/// The work of so many steps of the core takes about as long as one of a script.
constexpr std::uint64_t work_per_step = 16;

/// Returns a contour as scripts write it: corners [x, y] or [x, y, bulge].
Value list_of(const Arguments& arguments, const Contour& contour) {
  Context& context = arguments.context;
  std::vector<Value> corners;
  corners.reserve(contour.size());
  for (const ProfilePoint& corner : contour) {
    context.step(arguments.call);
    std::vector<Value> numbers = {corner.x, corner.y};
    if (corner.bulge != 0) numbers.emplace_back(corner.bulge);
    corners.push_back(context.make_list(arguments.call, std::move(numbers)));
  }
  return context.make_list(arguments.call, std::move(corners));
}

Value list_of(const Arguments& arguments, const std::vector<Contour>& contours) {
  std::vector<Value> lists;
  lists.reserve(contours.size());
  for (const Contour& contour : contours) lists.push_back(list_of(arguments, contour));
  return arguments.context.make_list(arguments.call, std::move(lists));
}

/// Returns what takes the work of the core as steps of the script.
std::function<void(std::uint64_t)> work_of(const Arguments& arguments) {
  return [&arguments](std::uint64_t work) {
    arguments.context.spend(arguments.call, static_cast<std::size_t>(work / work_per_step));
  };
}

FillRule fill_rule(const Arguments& arguments, std::size_t i) {
  const auto* rule = std::get_if<String>(&arguments[i]);
  if (rule && (*rule)->text == "nonzero") return FillRule::nonzero;
  if (rule && (*rule)->text == "evenodd") return FillRule::even_odd;
  arguments.wrong_type(i, "\"nonzero\" or \"evenodd\"");
}

/// Computes svg(path), svg(path, deviation) or svg(path, deviation, rule).
Value svg(const Arguments& arguments) {
  Context& context = arguments.context;
  const auto* path = std::get_if<String>(&arguments[0]);
  if (!path) arguments.wrong_type(0, "a String");
  PathOptions options;
  if (arguments.size() > 1) options.deviation = arguments.number(1);
  if (arguments.size() > 2) options.fill = fill_rule(arguments, 2);
  options.work = work_of(arguments);
  context.spend(arguments.call, (*path)->text.size());
  try {
    return list_of(arguments, svg_path_contours((*path)->text, options));
  } catch (const Error& error) {
    const std::size_t wrong = error.argument() == "deviation" ? 1 : 0;
    throw Failure{.span = arguments.span(wrong < arguments.size() ? wrong : 0),
                  .message = std::string("svg: ") + error.what(),
                  .code = error.code()};
  }
}

/// Returns the contours that the first argument is.
std::vector<Contour> first_contours(const Arguments& arguments) {
  AttributeType type;
  type.name = "contours";
  type.type = "List";
  const Given given{.type = &type,
                    .name_span = arguments.span(0),
                    .value_span = arguments.span(0),
                    .value = arguments[0]};
  return contours_of(given, arguments.context);
}

/// Computes offset(contours, distance).
Value offset(const Arguments& arguments) {
  const std::vector<Contour> contours = first_contours(arguments);
  const double distance = arguments.number(1);
  try {
    return list_of(arguments, offset_contours(contours, distance, work_of(arguments)));
  } catch (const Error& error) {
    throw Failure{.span = arguments.span(error.argument() == "distance" ? 1 : 0),
                  .message = std::string("offset: ") + error.what(),
                  .code = error.code()};
  }
}

/// Computes profileDistance(contours, x, y), which is a field.
Value distance_from_profile(const Arguments& arguments) {
  const std::vector<Contour> contours = first_contours(arguments);
  const Field x = arguments.field(1);
  const Field y = arguments.field(2);
  std::uint64_t corners = 0;
  for (const Contour& contour : contours) corners += contour.size();
  // Each piece is compared with each other one.
  arguments.context.spend(arguments.call, static_cast<std::size_t>(corners * corners / 16));
  return make_field(arguments.context, arguments.span(0),
                    [&] { return profile_distance(make_profile(contours), x, y); });
}

constexpr std::array table = {
    Builtin{"offset", "offset(contours, distance)", 2, 2, offset},
    Builtin{"profileDistance", "profileDistance(contours, x, y)", 3, 3, distance_from_profile},
    Builtin{"svg", "svg(path, deviation, rule)", 1, 3, svg},
};

}  // namespace

std::span<const Builtin> contour_builtins() {
  return table;
}

}  // namespace crt::lang
