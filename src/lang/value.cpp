#include "lang/value.hpp"

#include <array>
#include <cmath>

#include "text/format.hpp"

namespace crt::lang {

std::string_view type_name(const Value& value) {
  constexpr std::array<std::string_view, std::variant_size_v<Value>> names = {
      "nothing",  "unknown value", "Integer", "Float",  "Boolean",    "Vec3",
      "Color",    "String",        "List",    "Macro",  "Macro",      "Entity",
      "Material", "Pattern",       "Light",   "Camera", "Background", "Field"};
  return names[value.index()];
}

std::string_view article(std::string_view word) {
  constexpr std::string_view vowels = "AEIOUaeiou";
  return !word.empty() && vowels.find(word[0]) != std::string_view::npos ? "an" : "a";
}

std::string type_with_article(const Value& value) {
  const std::string_view name = type_name(value);
  if (std::holds_alternative<Nothing>(value)) return std::string(name);
  return text::format("{} {}", article(name), name);
}

std::string float_text(double number) {
  // The sign of a NaN depends on the machine.
  return std::isnan(number) ? "nan" : text::format("{}", number);
}

}  // namespace crt::lang
