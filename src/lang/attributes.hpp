// convert() turns the values of attributes into fields of the core's structs. There is one overload
// for each type of field, which also says what the attribute takes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "crt/background.hpp"
#include "crt/camera.hpp"
#include "crt/field.hpp"
#include "crt/light.hpp"
#include "crt/material.hpp"
#include "crt/primitives.hpp"
#include "crt/schema.hpp"
#include "crt/settings.hpp"
#include "crt/text.hpp"
#include "lang/context.hpp"
#include "lang/objects.hpp"

namespace crt::lang {

/// A FileName is a file as a script names it, and where.
struct FileName {
  std::string name;
  std::filesystem::path directory;  ///< of the script
  Span span;
};

/// Heights of a height field are given as an image or as rows.
struct HeightImage {
  std::shared_ptr<const HeightGrid> grid;
};
struct HeightRows {
  std::shared_ptr<const HeightGrid> grid;
};

// Each throws a Failure at the value if it has another type, or numbers that are not finite.
void convert(const Given& given, Context& context, double& field);
void convert(const Given& given, Context& context, int& field);
void convert(const Given& given, Context& context, std::uint64_t& field);
void convert(const Given& given, Context& context, bool& field);
void convert(const Given& given, Context& context, std::string& field);
void convert(const Given& given, Context& context, Vec3& field);
void convert(const Given& given, Context& context, std::vector<Vec3>& field);
void convert(const Given& given, Context& context, std::vector<double>& field);
void convert(const Given& given, Context& context, std::vector<std::vector<std::uint32_t>>& field);
void convert(const Given& given, Context& context, Color& field);
void convert(const Given& given, Context& context, Pattern& field);
void convert(const Given& given, Context& context, std::variant<Color, Pattern>& field);
void convert(const Given& given, Context& context, Share& field);
void convert(const Given& given, Context& context, std::vector<ColorStop>& field);
void convert(const Given& given, Context& context, FillRule& field);
void convert(const Given& given, Context& context, SharedMaterial& field);
void convert(const Given& given, Context& context, std::shared_ptr<const Image>& field);
void convert(const Given& given, Context& context, FileName& field);
void convert(const Given& given, Context& context, std::shared_ptr<const Profile>& field);
/// Reads the contours of a profile, of which each is a List.
std::vector<Contour> contours_of(const Given& given, Context& context);
void convert(const Given& given, Context& context, std::shared_ptr<const Font>& field);
void convert(const Given& given, Context& context, TextAlignment& field);
void convert(const Given& given, Context& context, HeightImage& field);
void convert(const Given& given, Context& context, HeightRows& field);
void convert(const Given& given, Context& context, Field& field);
void convert(const Given& given, Context& context, Camera& field);
void convert(const Given& given, Context& context, std::vector<Light>& field);
void convert(const Given& given, Context& context, Background& field);
void convert(const Given& given, Context& context, std::optional<SharedMaterial>& field);

/// Returns the place of the word that was given among some, in small letters or large ones.
std::size_t choose(const Given& given, std::span<const schema::Name> words);

template <class Enum>
requires std::is_enum_v<Enum>
void convert(const Given& given, Context&, Enum& field) {
  field = static_cast<Enum>(choose(given, schema::choices<Enum>.script_names));
}

/// An optional field takes what the field itself takes.
template <class Field>
void convert(const Given& given, Context& context, std::optional<Field>& field) {
  Field value{};
  convert(given, context, value);
  field = std::move(value);
}

/// Names what convert() takes for a field of this type.
constexpr std::string_view type_text(const double*) {
  return "Float";
}
constexpr std::string_view type_text(const int*) {
  return "Integer";
}
constexpr std::string_view type_text(const std::uint64_t*) {
  return "Integer";
}
constexpr std::string_view type_text(const bool*) {
  return "Boolean";
}
constexpr std::string_view type_text(const std::string*) {
  return "String";
}
constexpr std::string_view type_text(const Vec3*) {
  return "Vec3";
}
constexpr std::string_view type_text(const std::vector<Vec3>*) {
  return "List of Vec3";
}
constexpr std::string_view type_text(const std::vector<std::vector<std::uint32_t>>*) {
  return "List of Lists of Integers";
}
constexpr std::string_view type_text(const std::vector<double>*) {
  return "List of Floats, or Float";
}
constexpr std::string_view type_text(const Color*) {
  return "Color";
}
constexpr std::string_view type_text(const Pattern*) {
  return "Pattern";
}
constexpr std::string_view type_text(const std::variant<Color, Pattern>*) {
  return "Color or Pattern";
}
constexpr std::string_view type_text(const Share*) {
  return "Float or Pattern";
}
constexpr std::string_view type_text(const std::vector<ColorStop>*) {
  return "List of colors";
}
constexpr std::string_view type_text(const SharedMaterial*) {
  return "Material";
}
constexpr std::string_view type_text(const std::shared_ptr<const Image>*) {
  return "String";
}
constexpr std::string_view type_text(const FileName*) {
  return "String";
}
constexpr std::string_view type_text(const std::shared_ptr<const Profile>*) {
  return "List of corners";
}
constexpr std::string_view type_text(const std::shared_ptr<const Font>*) {
  return "String";
}
constexpr std::string_view type_text(const HeightImage*) {
  return "String";
}
constexpr std::string_view type_text(const HeightRows*) {
  return "List of Lists";
}
/// In the value of such an attribute x, y and z are coordinates.
inline constexpr std::string_view field_type = "Field";
constexpr std::string_view type_text(const Field*) {
  return field_type;
}
constexpr std::string_view type_text(const Camera*) {
  return "Camera";
}
constexpr std::string_view type_text(const std::vector<Light>*) {
  return "List of lights";
}
constexpr std::string_view type_text(const Background*) {
  return "Background";
}
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::string_view type_text(const Enum*) {
  return "String";
}
template <class Field>
constexpr std::string_view type_text(const std::optional<Field>*) {
  return type_text(static_cast<const Field*>(nullptr));
}

}  // namespace crt::lang
