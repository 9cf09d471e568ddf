#include "source/program.hpp"

#include <fmt/format.h>

#include "crt/error.hpp"

namespace crt::source {

void Program::require_space(std::size_t numbers) const {
  constexpr std::size_t least_bytes = 2;  // a digit and a comma
  if (numbers > most_bytes_ / least_bytes) refuse();
}

void Program::grow(std::size_t bytes) {
  bytes_ += bytes;
  if (bytes_ > most_bytes_) refuse();
}

void Program::refuse() const {
  throw Error(ErrorCode::limit,
              fmt::format("the source code would be longer than {} bytes: load large meshes and "
                          "images from their files instead",
                          most_bytes_));
}

std::string Program::new_name(const std::string& kind) {
  return fmt::format("{}_{}", kind, ++numbers_[kind]);
}

void Program::add_line(const std::string& line) {
  const std::size_t indent = syntax_.is_python() ? 4 : 2;
  const std::string text = wrapped(std::string(indent, ' ') + line, 2 * indent + 2) + "\n";
  grow(text.size());
  lines_ += text;
}

std::string Program::define(const std::string& kind, const std::string& type,
                            const std::string& value) {
  std::string name = new_name(kind);
  add_line(syntax_.is_cpp() ? fmt::format("const {} {} = {};", type, name, value)
                            : fmt::format("{} = {}", name, value));
  return name;
}

std::string Program::create(const std::string& kind, const std::string& function,
                            std::vector<std::string> arguments) {
  std::string name = new_name(kind);
  add_line(fmt::format("crt_{0}* {1} = NULL;", kind, name));
  arguments.push_back("&" + name);
  add_line(joined(fmt::format("check({}(", function), arguments, "));"));
  made_.push_back({kind, name});
  return name;
}

std::string Program::structure(const std::string& kind, const std::string& name,
                               const Fields& fields, const std::string& type) {
  if (!syntax_.is_c()) return fields.constructed(name);
  std::string variable = new_name(kind);
  add_line(fmt::format("crt_{} {};", kind, variable));
  add_line(type.empty() ? fmt::format("check(crt_{0}_init(&{1}, sizeof {1}));", kind, variable)
                        : fmt::format("check(crt_{0}_init_type(&{1}, sizeof {1}, {2}));", kind,
                                      variable, type));
  for (const StructField& field : fields.all()) {
    if (const auto* v = std::get_if<Vec3>(&field.value)) {
      add_line(fmt::format("set({}.{}, {}, {}, {});", variable, field.name, v->x, v->y, v->z));
    } else {
      add_line(
          fmt::format("{}.{} = {};", variable, field.name, std::get<std::string>(field.value)));
    }
  }
  return variable;
}

std::string Program::array(const std::string& kind, const std::string& type,
                           std::span<const std::string> items) {
  if (syntax_.is_python()) return define(kind, "", syntax_.list(items));
  std::string name = new_name(kind);
  const std::string text =
      wrapped(joined(fmt::format("static const {} {}[] = {{", type, name), items, "};\n"), 4);
  grow(text.size());
  arrays_ += text;
  return name;
}

std::string Program::local_array(const std::string& kind, const std::string& type,
                                 std::span<const std::string> items) {
  std::string name = new_name(kind);
  add_line(joined(fmt::format("{} {}[] = {{", type, name), items, "};"));
  return name;
}

std::string Program::known(const void* thing) const {
  const auto found = known_.find(thing);
  return found == known_.end() ? std::string() : found->second;
}

std::string Program::known_value(const std::string& value) const {
  const auto found = values_.find(value);
  return found == values_.end() ? std::string() : found->second;
}

std::string Program::remember(const void* thing, std::string name) {
  known_[thing] = name;
  return name;
}

std::string Program::releases(const std::string& kept) const {
  std::string result;
  for (const Made& made : made_) {
    if (made.name != kept) result += fmt::format("  crt_{}_release({});\n", made.kind, made.name);
  }
  return result;
}

}  // namespace crt::source
