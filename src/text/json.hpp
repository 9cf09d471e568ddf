// JSON that comes from elsewhere is read here, and nowhere else. What is nested too deeply, or has
// too many values, is refused before it is there: copying and writing a value goes as deep on the
// stack as the value is nested.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace crt::text {

struct JsonLimits {
  int depth = 16;  ///< lists and objects within one another
  std::size_t values = 1'000'000;
};

/// A JsonError says why a text is not read as JSON.
struct JsonError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads JSON. Throws JsonError if it is none, or beyond the limits.
inline nlohmann::json parse_json(std::string_view text, JsonLimits limits) {
  using nlohmann::json;
  std::size_t values = 0;
  const auto check = [&](int depth, json::parse_event_t event, const json& /*value*/) {
    const bool begins =
        event == json::parse_event_t::array_start || event == json::parse_event_t::object_start;
    if (begins && depth >= limits.depth) throw JsonError("it is nested too deeply");
    if ((begins || event == json::parse_event_t::value) && ++values > limits.values)
      throw JsonError("it has too many values");
    return true;
  };
  try {
    return json::parse(text, check);
  } catch (const json::exception& error) {
    throw JsonError(error.what());
  }
}

/// Returns a whole number. Throws JsonError if it is none, or none that the type holds: to turn
/// other numbers into it has no meaning in C++.
template <std::integral Number>
Number whole_number(const nlohmann::json& value) {
  const auto fits = [](auto number) { return std::in_range<Number>(number); };
  if (value.is_number_unsigned() && fits(value.get<std::uint64_t>()))
    return static_cast<Number>(value.get<std::uint64_t>());
  if (value.is_number_integer() && !value.is_number_unsigned() && fits(value.get<std::int64_t>()))
    return static_cast<Number>(value.get<std::int64_t>());
  throw JsonError("it has no whole number where there must be one");
}

/// Says whether a value may be the id of a message: a number or a short text, as an answer repeats
/// it.
inline bool is_json_id(const nlohmann::json& value) {
  constexpr std::size_t longest = 128;
  return value.is_number() ||
         (value.is_string() && value.get_ref<const std::string&>().size() <= longest);
}

}  // namespace crt::text
