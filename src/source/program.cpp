#include "source/program.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "core/base/sha256.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

constexpr double a_degree = std::numbers::pi / 180;

/// Returns degrees that are as many radians, to the last bit where there are such.
double degrees_of(double radians) {
  constexpr int most_steps = 4;
  const double nearest = radians / a_degree;
  double above = nearest;
  double below = nearest;
  for (int step = 0; step < most_steps; ++step) {
    if (above * a_degree == radians) return above;
    if (below * a_degree == radians) return below;
    above = std::nextafter(above, 2 * nearest);
    below = std::nextafter(below, 0);
  }
  return nearest;
}

/// Returns what the name of a file may begin with anywhere, also in an OBJ file.
std::string plain_name(const std::string& name) {
  constexpr std::size_t most_bytes = 100;
  std::string result = name.substr(0, most_bytes);
  for (char& c : result) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '.';
    if (!is_plain) c = '_';
  }
  if (result.empty() || std::isalnum(static_cast<unsigned char>(result[0])) == 0)
    result.insert(0, "_");
  return result;
}

}  // namespace

void Program::require_space(std::size_t numbers) const {
  constexpr std::size_t least_bytes = 2;  // a digit and a comma
  if (numbers > max_bytes_ / least_bytes) refuse();
}

void Program::grow(std::size_t bytes) {
  bytes_ += bytes;
  if (bytes_ > max_bytes_) refuse();
}

void Program::refuse() const {
  throw Error(
      ErrorCode::limit,
      text::format(
          "the source code would be longer than {} bytes{}", max_bytes_,
          syntax_.is_script() ? "" : ": load large meshes and images from their files instead"));
}

std::string Program::new_name(const std::string& kind) {
  return text::format("{}_{}", kind, ++numbers_[kind]);
}

void Program::add_line(const std::string& line) {
  const std::size_t indent = syntax_.is_script() ? 0 : syntax_.is_python() ? 4 : 2;
  add_block(wrapped(std::string(indent, ' ') + line, syntax_.is_script() ? 4 : 2 * indent + 2) +
            "\n");
}

void Program::add_block(const std::string& lines) {
  grow(lines.size());
  lines_ += lines;
}

std::string Program::add_file(std::span<const std::byte> content, const std::string& ending) {
  constexpr std::size_t digits = 16;
  std::string name =
      text::format("{}-{}.{}", plain_name(name_), core::sha256(content).substr(0, digits), ending);
  const bool is_known = std::any_of(files_.begin(), files_.end(),
                                    [&](const SourceFile& file) { return file.name == name; });
  if (!is_known) files_.push_back({name, {content.begin(), content.end()}});
  return name;
}

std::string Program::define(const std::string& kind, const std::string& type,
                            const std::string& value) {
  std::string name = new_name(kind);
  add_line(syntax_.is_cpp() ? text::format("const {} {} = {};", type, name, value)
                            : text::format("{} = {}", name, value));
  return name;
}

std::string Program::create(const std::string& kind, const std::string& function,
                            std::vector<std::string> arguments) {
  std::string name = new_name(kind);
  add_line(text::format("crt_{0}* {1} = NULL;", kind, name));
  arguments.push_back("&" + name);
  add_line(joined(text::format("check({}(", function), arguments, "));"));
  made_.push_back({kind, name});
  return name;
}

std::string Program::structure(const std::string& kind, const std::string& name,
                               const Fields& fields, const std::string& type) {
  if (!syntax_.is_c()) return fields.constructed(name);
  std::string variable = new_name(kind);
  add_line(text::format("crt_{} {};", kind, variable));
  add_line(type.empty() ? text::format("check(crt_{0}_init(&{1}, sizeof {1}));", kind, variable)
                        : text::format("check(crt_{0}_init_type(&{1}, sizeof {1}, {2}));", kind,
                                       variable, type));
  for (const StructField& field : fields.all()) {
    if (const auto* v = std::get_if<Vec3>(&field.value)) {
      add_line(text::format("set({}.{}, {}, {}, {});", variable, field.name, v->x, v->y, v->z));
    } else {
      add_line(
          text::format("{}.{} = {};", variable, field.name, std::get<std::string>(field.value)));
    }
  }
  return variable;
}

std::string Program::array(const std::string& kind, const std::string& type,
                           std::span<const std::string> items) {
  if (syntax_.is_python() || syntax_.is_script()) return define(kind, "", syntax_.list(items));
  std::string name = new_name(kind);
  const std::string text =
      wrapped(joined(text::format("static const {} {}[] = {{", type, name), items, "};\n"), 4);
  grow(text.size());
  arrays_ += text;
  return name;
}

std::string Program::local_array(const std::string& kind, const std::string& type,
                                 std::span<const std::string> items) {
  std::string name = new_name(kind);
  add_line(joined(text::format("{} {}[] = {{", type, name), items, "};"));
  return name;
}

std::string Program::degrees(double radians) {
  const double result = degrees_of(radians);
  if (result * a_degree != radians) {
    warn_once("an angle is rounded, as it is written in degrees: single pixels may differ");
  }
  return Syntax::number(result);
}

std::string Program::angle(double radians) {
  return syntax_.is_script() ? degrees(radians) : Syntax::number(radians);
}

void Program::warn_once(const std::string& warning) {
  if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
    warnings_.push_back(warning);
}

void Program::refuse_in_2015(const std::string& what) const {
  if (!is_of_2015_) return;
  throw Error(ErrorCode::unsupported,
              text::format("scripts of 2015 have no {}, so that this scene of theirs cannot be "
                           "written as one",
                           what));
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
    if (made.name != kept) result += text::format("  crt_{}_release({});\n", made.kind, made.name);
  }
  return result;
}

}  // namespace crt::source
