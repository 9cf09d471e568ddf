#include "source/fields.hpp"

#include <fmt/format.h>

#include <utility>

namespace crt::source {

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
  if (syntax_.is_cpp()) {
    if (value == usual) return;
    const std::string numbers = fmt::format("{}, {}, {}", value.r, value.g, value.b);
    return add_text(cpp, c,
                    value.a == 1 ? fmt::format("Color{{{}}}", numbers)
                                 : fmt::format("Color{{{}, {}}}", numbers, value.a));
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

std::string Fields::constructed(const std::string& name) const {
  const bool is_python = syntax_.is_python();
  std::vector<std::string> items;
  for (const StructField& field : fields_) {
    const auto* const vector = std::get_if<Vec3>(&field.value);
    const std::string value =
        vector != nullptr ? syntax_.vector(*vector) : std::get<std::string>(field.value);
    items.push_back(is_python ? fmt::format("{}={}", field.name, value)
                              : fmt::format(".{} = {}", field.name, value));
  }
  return is_python ? joined(fmt::format("crt.{}(", name), items, ")")
                   : joined(name + "{", items, "}");
}

}  // namespace crt::source
