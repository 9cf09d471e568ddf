#include "source/fields.hpp"

#include <cctype>
#include <limits>
#include <utility>

#include "text/format.hpp"

namespace crt::source {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::string script_name(const std::string& cpp) {
  std::string name;
  for (std::size_t i = 0; i < cpp.size(); ++i) {
    const bool is_last_letter = i > 0 && i + 1 == cpp.size() && cpp[i - 1] == '_';
    if (is_last_letter) {
      name += static_cast<char>(std::toupper(static_cast<unsigned char>(cpp[i])));
    } else if (cpp[i] != '_') {
      name += cpp[i];
    }
  }
  return name;
}

std::string Fields::name_of(const char* cpp, const char* c) const {
  if (syntax_.is_script()) return script_name(cpp);
  return syntax_.is_cpp() ? cpp : c;
}

void Fields::add_text(const char* cpp, const char* c, std::string text) {
  const std::string name = name_of(cpp, c);
  if (!name.empty()) fields_.push_back({name, std::move(text)});
}

void Fields::add(const char* cpp, const char* c, double value, double usual) {
  if (value != usual) add_text(cpp, c, Syntax::number(value));
}

void Fields::add(const char* cpp, const char* c, const Vec3& value, const Vec3& usual) {
  const std::string name = name_of(cpp, c);
  if (value != usual && !name.empty()) fields_.push_back({name, value});
}

void Fields::add(const char* cpp, const char* c, const char* alpha, const Color& value,
                 const Color& usual) {
  if (syntax_.is_cpp() || syntax_.is_script()) {
    if (value != usual) add_text(cpp, c, syntax_.color(value));
    return;
  }
  add(cpp, c, Vec3(value.r, value.g, value.b), Vec3(usual.r, usual.g, usual.b));
  add("", alpha, value.a, usual.a);
}

void Fields::add_string(const char* name, const std::string& value) {
  if (!value.empty()) add_text(name, name, syntax_.text(value));
}

void Fields::add_flag(const char* cpp, const char* c, bool value, bool usual) {
  if (value != usual) add_text(cpp, c, syntax_.boolean(value));
}

double Fields::required(double usual) const {
  return syntax_.is_script() ? no_number : usual;
}

Vec3 Fields::required(const Vec3& usual) const {
  return syntax_.is_script() ? Vec3(no_number) : usual;
}

Color Fields::required(const Color& usual) const {
  return syntax_.is_script() ? Color{no_number, no_number, no_number, no_number} : usual;
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
