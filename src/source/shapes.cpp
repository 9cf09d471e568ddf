#include "source/shapes.hpp"

#include <algorithm>

#include "core/geometry/height_field/grid.hpp"
#include "core/geometry/profile/profile.hpp"
#include "crt/error.hpp"
#include "crt/schema_primitives.hpp"
#include "source/values.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

template <class Kind>
ShapeCode code_of(const Kind& it) {
  return shape_code_of(it);
}
// In C and Python these have an axis, which may lie anywhere.
ShapeCode code_of(const Extrusion& it) {
  const double low = std::min(it.from, it.to);
  const double high = std::max(it.from, it.to);
  return {"Extrusion",
          "extrusion",
          {{"from", "", low},
           {"to", "", high},
           {"", "start", Vec3(0, 0, low)},
           {"", "end", Vec3(0, 0, high)}}};
}
ShapeCode code_of(const Revolution& it) {
  return {"Revolution",
          "revolution",
          {{"", "start", Vec3(0, 0, 0)},
           {"", "end", Vec3(0, 1, 0)},
           {"angle", "angle", it.angle, true}}};
}

/// A SharedPart is what a primitive has beside numbers. C may have several arguments for it.
struct SharedPart {
  const char* name = "";  ///< in C++ and Python
  std::vector<std::string> values{};
};

bool closes_itself(const Contour& contour) {
  return contour.front().x == contour.back().x && contour.front().y == contour.back().y;
}

std::string contour_list(const Syntax& syntax, const Contour& contour) {
  std::vector<std::string> corners;
  for (const auto& [x, y, bulge] : contour) {
    const std::string numbers =
        bulge == 0 ? text::format("{}, {}", x, y) : text::format("{}, {}, {}", x, y, bulge);
    corners.push_back(syntax.is_script()   ? "[" + numbers + "]"
                      : syntax.is_python() ? "(" + numbers + ")"
                                           : "{" + numbers + "}");
  }
  return syntax.list(corners);
}

std::string profile_name(Program& program, const std::shared_ptr<const Profile>& profile) {
  if (std::string known = program.known(profile.get()); !known.empty()) return known;
  const std::vector<Contour>& contours = profile->contours();
  std::string name;
  if (program.syntax().is_c()) {
    name = program.create("profile", "crt_profile_create", {});
    const auto add = [&](const char* function, const ProfilePoint& to) {
      const std::string bulge = to.bulge == 0 ? "" : ", " + Syntax::number(to.bulge);
      program.add_line(text::format("check(crt_profile_{}({}, {}, {}{}));", function, name, to.x,
                                    to.y, function[0] == 'a' ? bulge : ""));
    };
    for (const Contour& contour : contours) {
      add("move_to", contour.front());
      for (std::size_t i = 1; i < contour.size(); ++i)
        add(contour[i].bulge == 0 ? "line_to" : "arc_to", contour[i]);
      if (contour.front().bulge != 0 && !closes_itself(contour)) add("arc_to", contour.front());
    }
  } else {
    const std::string list = contour_lists(program.syntax(), *profile);
    name = program.define("profile", "auto",
                          program.syntax().is_cpp()
                              ? text::format("make_profile(std::vector<Contour>{})", list)
                              : list);
  }
  return program.remember(profile.get(), name);
}

std::string heights_name(Program& program, const std::shared_ptr<const HeightGrid>& grid) {
  if (std::string known = program.known(grid.get()); !known.empty()) return known;
  const Syntax& syntax = program.syntax();
  program.require_space(std::size_t{grid->columns()} * grid->rows());
  const bool has_rows = syntax.is_python() || syntax.is_script();
  std::vector<std::string> rows;
  std::vector<std::string> all;
  for (std::uint32_t row = 0; row < grid->rows(); ++row) {
    const auto items =
        number_items(std::span(grid->heights_from(0, row), std::size_t{grid->columns()}));
    if (has_rows) {
      rows.push_back(syntax.list(items));
    } else {
      all.insert(all.end(), items.begin(), items.end());
    }
  }
  std::string name = has_rows ? program.define("heights", "", syntax.list(rows))
                              : program.array("heights", "double", all);
  if (syntax.is_cpp()) {
    name = program.define(
        "height_grid", "auto",
        text::format("make_height_grid({{std::begin({0}), std::end({0})}}, {1}, {2})", name,
                     grid->columns(), grid->rows()));
  }
  return program.remember(grid.get(), name);
}

template <class Shape>
SharedPart shared_part(Program&, const Shape&) {
  return {};
}
SharedPart shared_part(Program& program, const Extrusion& it) {
  return {"profile", {profile_name(program, it.profile)}};
}
SharedPart shared_part(Program& program, const Revolution& it) {
  return {"profile", {profile_name(program, it.profile)}};
}
SharedPart shared_part(Program& program, const HeightField& it) {
  if (program.syntax().is_script()) {
    if (const auto file = heights_file_name(program, *it.heights))
      return {"image", {program.syntax().text(*file)}};
  }
  SharedPart part{"heights", {heights_name(program, it.heights)}};
  if (program.syntax().is_c()) {
    part.values.push_back(std::to_string(it.heights->columns()));
    part.values.push_back(std::to_string(it.heights->rows()));
  }
  return part;
}
SharedPart shared_part(Program& program, const Implicit& it) {
  if (program.syntax().is_script()) return {"field", {field_value(program, it.field)}};
  constexpr std::size_t most_bytes = std::size_t{1} << 20;
  const std::string content = field_text(it.field, most_bytes);
  const std::string text = program.syntax().text(content);
  if (program.syntax().is_cpp()) return {"field", {text::format("parse_field({})", text)}};
  SharedPart part{"field", {text}};
  if (program.syntax().is_c()) part.values.push_back(std::to_string(content.size()));
  return part;
}
SharedPart shared_part(Program&, const Custom& it) {
  throw Error(ErrorCode::unsupported,
              text::format("{} is computed by a program, which cannot be written as source code",
                           it.shape->name()));
}

std::string value_text(Program& program, const Argument& argument) {
  const Syntax& syntax = program.syntax();
  if (argument.is_angle && (syntax.is_python() || syntax.is_script()))
    return program.degrees(std::get<double>(argument.value));
  if (const auto* number = std::get_if<double>(&argument.value)) return Syntax::number(*number);
  return syntax.vector(std::get<Vec3>(argument.value));
}

std::string c_value(Program& program, const ShapeCode& code, SharedPart part) {
  std::vector<std::string> arguments = std::move(part.values);
  for (const Argument& argument : code.arguments) {
    if (!argument.python.empty()) arguments.push_back(value_text(program, argument));
  }
  return program.create("entity", text::format("crt_{}_create", code.c), std::move(arguments));
}

/// Returns an extrusion as scripts have it, which begins at z = 0.
std::string script_value(Program& program, const Extrusion& extrusion) {
  const double low = std::min(extrusion.from, extrusion.to);
  const double high = std::max(extrusion.from, extrusion.to);
  const bool is_at_origin = low == 0 || high == 0;
  Fields fields(program.syntax());
  fields.add_text("profile", "", profile_name(program, extrusion.profile));
  fields.add_text("height", "", Syntax::number(is_at_origin ? low + high : high - low));
  if (extrusion.material)
    fields.add_text("material", "", material_name(program, *extrusion.material));
  std::string text = fields.constructed("Extrusion");
  if (is_at_origin) return text;
  program.warn_once(
      "an extrusion that does not begin at z = 0 is moved there: single pixels may differ");
  return text::format("{} <translate {}>", text, program.syntax().vector({0, 0, low}));
}

}  // namespace

std::string contour_lists(const Syntax& syntax, const Profile& profile) {
  std::vector<std::string> lists;
  lists.reserve(profile.contours().size());
  for (const Contour& contour : profile.contours()) lists.push_back(contour_list(syntax, contour));
  return syntax.list(lists);
}

ShapeCode shape_code(const Primitive& primitive) {
  return std::visit([](const auto& shape) { return code_of(shape); }, primitive);
}

const std::optional<SharedMaterial>& material_of(const Primitive& primitive) {
  return std::visit(
      [](const auto& shape) -> const std::optional<SharedMaterial>& { return shape.material; },
      primitive);
}

std::string shape_value(Program& program, const Primitive& primitive) {
  if (const auto* mesh = std::get_if<Mesh>(&primitive)) return mesh_value(program, *mesh);
  const Syntax& syntax = program.syntax();
  if (const auto* extrusion = std::get_if<Extrusion>(&primitive); extrusion && syntax.is_script())
    return script_value(program, *extrusion);
  const ShapeCode code = shape_code(primitive);
  const SharedPart part =
      std::visit([&](const auto& shape) { return shared_part(program, shape); }, primitive);
  if (syntax.is_c()) return c_value(program, code, part);
  Fields fields(syntax);
  if (!part.values.empty()) fields.add_text(part.name, part.name, part.values.front());
  for (const Argument& argument : code.arguments)
    fields.add_text(argument.cpp, argument.python, value_text(program, argument));
  if (const auto& material = material_of(primitive))
    fields.add_text("material", "material", material_name(program, *material));
  return fields.constructed(code.name);
}

}  // namespace crt::source
