#include "cli/option_values.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <crt/schema_settings.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <type_traits>
#include <vector>

namespace crt::cli {

namespace {

bool is_ipv6(const std::string& text) {
  in6_addr address{};
  return inet_pton(AF_INET6, text.c_str(), &address) == 1;
}

/// Returns a string as a script writes it.
std::string script_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    switch (c) {
      case '"':
        quoted += "\\\"";
        break;
      case '\\':
        quoted += "\\\\";
        break;
      case '\n':
        quoted += "\\n";
        break;
      case '\t':
        quoted += "\\t";
        break;
      default:
        if (static_cast<unsigned char>(c) < 0x20) {
          quoted += fmt::format("\\u{:04x}", c);
        } else {
          quoted += c;
        }
    }
  }
  return quoted + '"';
}

template <class Value>
constexpr SettingKind kind_of = std::is_same_v<Value, bool>       ? SettingKind::flag
                                : std::is_integral_v<Value>       ? SettingKind::integer
                                : std::is_floating_point_v<Value> ? SettingKind::number
                                                                  : SettingKind::text;

/// Lists what the schema has of settings. Texts of a picture come last.
std::vector<SettingOption> make_setting_options() {
  std::vector<SettingOption> options;
  std::vector<SettingOption> texts;
  schema::for_each_field<Settings>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    if (row.uses.option.empty()) return;
    auto& list = std::is_same_v<Value, std::string> ? texts : options;
    list.push_back({row.script_name(), kind_of<Value>, row.uses.option});
  });
  options.push_back(
      {"projection", SettingKind::text, "pinhole, spherical, cylindrical or orthographic"});
  options.insert(options.end(), texts.begin(), texts.end());
  return options;
}

struct AovName {
  std::string_view name;
  bool Aovs::*asked;
};

constexpr AovName aov_names[] = {
    {"depth", &Aovs::depth}, {"normal", &Aovs::normal}, {"id", &Aovs::id},
    {"part", &Aovs::part},   {"albedo", &Aovs::albedo}, {"samples", &Aovs::samples},
    {"error", &Aovs::error},
};

}  // namespace

WrongValue::WrongValue(std::string_view option, std::string_view needed, std::string_view value)
    : std::runtime_error(fmt::format("{} needs {}, not '{}'", option, needed, value)) {}

bool parse_finite(std::string_view text, double& value) {
  return parse_whole(text, value) && std::isfinite(value);
}

std::span<const SettingOption> setting_options() {
  static const std::vector<SettingOption> options = make_setting_options();
  return options;
}

std::string setting_expression(const SettingOption& setting, const std::string& value) {
  const std::string option = fmt::format("--{}", setting.name);
  std::int64_t whole = 0;
  double number = 0;
  switch (setting.kind) {
    case SettingKind::integer:
      if (!parse_whole(value, whole)) throw WrongValue(option, "a whole number", value);
      return value;
    case SettingKind::number:
      if (!parse_finite(value, number)) throw WrongValue(option, "a number", value);
      return value;
    case SettingKind::flag:
      if (value != "true" && value != "false") throw WrongValue(option, "true or false", value);
      return value;
    case SettingKind::text:
      break;
  }
  return script_string(value);
}

void take_variable(ScriptOptions& script, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == assignment.size()) {
    throw WrongValue("--set", "NAME=VALUE, such as n=18", assignment);
  }
  script.variables.emplace_back(assignment.substr(0, equals), assignment.substr(equals + 1));
}

void take_compat(ScriptOptions& script, const std::string& year) {
  int number = 0;
  if (!parse_whole(year, number) || (number != 0 && number != compat_2015)) {
    throw WrongValue("--compat", fmt::format("{}, or 0 for none", compat_2015), year);
  }
  script.settings.emplace_back("compat", year);
}

FrameRange parse_frames(const std::string& text) {
  FrameRange frames;
  const std::size_t dash = text.find('-');
  const std::string_view view = text;
  const bool fine = dash == std::string::npos
                        ? parse_whole(view, frames.first) && parse_whole(view, frames.last)
                        : parse_whole(view.substr(0, dash), frames.first) &&
                              parse_whole(view.substr(dash + 1), frames.last);
  if (!fine || frames.first < 0 || frames.last < frames.first) {
    throw WrongValue("--frames", "FIRST-LAST, such as 0-99", text);
  }
  constexpr int largest_frame = 1'000'000'000;
  constexpr int max_frames = 1'000'000;
  if (frames.last > largest_frame || frames.last - frames.first >= max_frames) {
    throw WrongValue("--frames",
                     fmt::format("at most {} frames, none above {}", max_frames, largest_frame),
                     text);
  }
  return frames;
}

Region parse_region(const std::string& text) {
  Region region;
  int* const fields[] = {&region.x, &region.y, &region.width, &region.height};
  std::string_view rest = text;
  bool fine = true;
  for (int* field : fields) {
    const std::size_t comma = rest.find(',');
    fine = fine && parse_whole(rest.substr(0, comma), *field) &&
           (comma == std::string_view::npos) == (field == &region.height);
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
  }
  if (!fine || region.x < 0 || region.y < 0 || region.width < 1 || region.height < 1) {
    throw WrongValue("--region", "X,Y,WIDTH,HEIGHT in pixels from the top left, such as 0,0,64,64",
                     text);
  }
  return region;
}

double parse_positive(const std::string& option, const std::string& text) {
  double value = 0;
  if (!parse_finite(text, value) || value <= 0) throw WrongValue(option, "a number above 0", text);
  return value;
}

int parse_threads(const std::string& text) {
  int threads = 0;
  if (!parse_whole(text, threads) || threads < 0) {
    throw WrongValue("--threads", "a whole number, 0 for all cores", text);
  }
  return threads;
}

int parse_sample_count(const std::string& option, const std::string& text) {
  constexpr int least = 4;
  constexpr int most = 65536;
  int count = 0;
  const bool fine = parse_whole(text, count) && count >= least && count <= most;
  if (!fine || (count & (count - 1)) != 0) {
    throw WrongValue(option, fmt::format("a power of 2 from {} to {}", least, most), text);
  }
  return count;
}

std::string parse_ip_address(const std::string& option, const std::string& text) {
  const bool has_brackets = text.starts_with('[') && text.ends_with(']');
  std::string plain = has_brackets ? text.substr(1, text.size() - 2) : text;
  in_addr address{};
  if (is_ipv6(plain)) return plain;
  if (!has_brackets && inet_pton(AF_INET, plain.c_str(), &address) == 1) return plain;
  throw WrongValue(option, "an IP address, such as 0.0.0.0 or ::1", text);
}

std::string parse_host_name(const std::string& option, const std::string& text) {
  constexpr std::string_view allowed =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-.";
  if (!text.empty() && text.find_first_not_of(allowed) == std::string::npos) return text;
  if (text.starts_with('[') && text.ends_with(']') && is_ipv6(text.substr(1, text.size() - 2)))
    return text;
  throw WrongValue(option, "the name of a machine, without a port", text);
}

std::string all_aov_names() {
  std::string names;
  for (const AovName& aov : aov_names)
    names += fmt::format("{}{}", names.empty() ? "" : ",", aov.name);
  return names;
}

void take_aovs(const std::string& list, Aovs& aovs) {
  std::string_view rest = list;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view name = rest.substr(0, comma);
    const auto* const found = std::find_if(std::begin(aov_names), std::end(aov_names),
                                           [&](const AovName& aov) { return aov.name == name; });
    if (found == std::end(aov_names)) {
      throw WrongValue("--aov", fmt::format("one or several of {}", all_aov_names()), list);
    }
    aovs.*(found->asked) = true;
    if (comma == std::string_view::npos) return;
    rest.remove_prefix(comma + 1);
  }
}

SectionPlane parse_plane(const std::string& text) {
  const auto refuse = [&]() -> SectionPlane {
    throw WrongValue("--section", "a plane as z=0.3 or 1,0,1=0.3", text);
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return refuse();
  SectionPlane plane;
  if (!parse_finite(text.substr(equals + 1), plane.offset)) return refuse();
  const std::string direction = text.substr(0, equals);
  if (direction == "x" || direction == "y" || direction == "z") {
    plane.normal = {direction == "x" ? 1 : 0, direction == "y" ? 1 : 0, direction == "z" ? 1 : 0};
    return plane;
  }
  std::size_t begin = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = direction.find(',', begin);
    if ((comma == std::string::npos) != (axis == 2)) return refuse();
    const std::size_t count = comma == std::string::npos ? comma : comma - begin;
    if (!parse_finite(direction.substr(begin, count), plane.normal[axis])) return refuse();
    begin = comma + 1;
  }
  if (plane.normal == Vec3(0, 0, 0)) return refuse();
  return plane;
}

}  // namespace crt::cli
