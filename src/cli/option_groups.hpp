// What the options of several commands have in common.
#pragma once

#include <CLI/App.hpp>
#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "cli/options.hpp"

namespace crt::cli {

/// Whether all of a text is a number of this type, which it then becomes.
template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}
bool parse_finite(std::string_view text, double& value);

/// "needs ..., not '...'": how every complaint about an option's value reads.
CLI::ValidationError wrong_value(const std::string& option, std::string_view needed,
                                 const std::string& value);

/// What says how a script is run, and how its errors are told.
void add_script_options(CLI::App& command, CommonRequest& request);

/// The settings of a script, by their names there.
void add_settings(CLI::App& command, ScriptOptions& script);

void add_threads(CLI::App& command, int& threads);
void add_region(CLI::App& command, std::optional<Region>& region, const std::string& help);

/// The options of `crt trade`.
void add_trade_options(CLI::App& command, TradeRequest& request);

}  // namespace crt::cli
