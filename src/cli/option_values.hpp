// These functions turn the words of a command line into the values of options.
#pragma once

#include <charconv>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "cli/options.hpp"

namespace crt::cli {

/// Every complaint about an option's value reads "--option needs ..., not '...'".
class WrongValue : public std::runtime_error {
 public:
  WrongValue(std::string_view option, std::string_view needed, std::string_view value);
};

/// Reads a number of this type, and says whether all of the text is one.
template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}
bool parse_finite(std::string_view text, double& value);

// The next functions throw WrongValue.

enum class SettingKind { integer, number, text, flag };

struct SettingOption {
  std::string_view name;
  SettingKind kind;
  std::string_view help;
};

/// Lists the settings of a script, by their names there.
std::span<const SettingOption> setting_options();

/// Returns the value of an option as a script expression.
std::string setting_expression(const SettingOption& setting, const std::string& value);

/// Takes "NAME=VALUE".
void take_variable(ScriptOptions& script, const std::string& assignment);

/// Takes the year whose program a script is of: 2015, or 0 for none.
void take_compat(ScriptOptions& script, const std::string& year);

FrameRange parse_frames(const std::string& text);
Region parse_region(const std::string& text);
/// Reads the value of --section: "z=0.3" or "nx,ny,nz=offset".
SectionPlane parse_plane(const std::string& text);
double parse_positive(const std::string& option, const std::string& text);
int parse_threads(const std::string& text);
/// Returns a power of 2 that Settings::max_samples can be.
int parse_sample_count(const std::string& option, const std::string& text);

/// Returns an IP address without the brackets that it may have.
std::string parse_ip_address(const std::string& option, const std::string& text);
/// Returns the name of a machine, or an IP address, as URLs have it.
std::string parse_host_name(const std::string& option, const std::string& text);

/// Returns "depth,normal,...".
std::string all_aov_names();
/// Adds the channels of a list to those that are asked for.
void take_aovs(const std::string& list, Aovs& aovs);

}  // namespace crt::cli
