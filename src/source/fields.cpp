#include "source/fields.hpp"

#include <utility>

#include "text/format.hpp"

namespace crt::source {

std::string Fields::name_of(std::string_view cpp, std::string_view c) const {
  if (syntax_.is_script()) return std::string(schema::script_name(cpp).text());
  return std::string(syntax_.is_cpp() ? cpp : c);
}

void Fields::add_text(std::string_view cpp, std::string_view c, std::string text) {
  const std::string name = name_of(cpp, c);
  if (!name.empty()) fields_.push_back({name, std::move(text)});
}

void Fields::add_vector(std::string_view cpp, std::string_view c, const Vec3& value) {
  const std::string name = name_of(cpp, c);
  if (!name.empty()) fields_.push_back({name, value});
}

std::vector<std::string> Fields::assignments() const {
  const bool is_code = !syntax_.is_script() && !syntax_.is_python();
  const char* const sign = syntax_.is_script() ? " -> " : syntax_.is_python() ? "=" : " = ";
  std::vector<std::string> items;
  for (const StructField& field : fields_) {
    const auto* const vector = std::get_if<Vec3>(&field.value);
    const std::string value =
        vector != nullptr ? syntax_.vector(*vector) : std::get<std::string>(field.value);
    items.push_back(text::format("{}{}{}{}", is_code ? "." : "", field.name, sign, value));
  }
  return items;
}

std::string Fields::constructed(const std::string& name) const {
  return syntax_.constructed(name, assignments());
}

}  // namespace crt::source
