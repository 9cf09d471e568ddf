// The values of options: from the words of a command line to what they mean.
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

/// "--option needs ..., not '...'": how every complaint about an option's value reads.
class WrongValue : public std::runtime_error {
 public:
  WrongValue(std::string_view option, std::string_view needed, std::string_view value);
};

/// Whether all of a text is a number of this type, which it then becomes.
template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}
bool parse_finite(std::string_view text, double& value);

// The next throw WrongValue.

enum class SettingKind { integer, number, text, flag };

struct SettingOption {
  const char* name;
  SettingKind kind;
  const char* help;
};

/// The settings of a script, by their names there.
std::span<const SettingOption> setting_options();

/// The value of an option as a script expression.
std::string setting_expression(const SettingOption& setting, const std::string& value);

/// Takes "NAME=VALUE".
void take_variable(ScriptOptions& script, const std::string& assignment);

/// Takes the year whose program a script is of: 2015, or 0 for none.
void take_compat(ScriptOptions& script, const std::string& year);

FrameRange parse_frames(const std::string& text);
Region parse_region(const std::string& text);
double parse_positive(const std::string& option, const std::string& text);
int parse_threads(const std::string& text);
/// A power of 2 that Settings::max_samples can be.
int parse_sample_count(const std::string& option, const std::string& text);

/// "depth,normal,...".
std::string all_aov_names();
/// Adds those of a list to what is asked for.
void take_aovs(const std::string& list, Aovs& aovs);

}  // namespace crt::cli
