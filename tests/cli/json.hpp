// This reader of JSON accepts nothing but JSON (RFC 8259). Tests read what crt writes with it.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace crt::test {

struct Json {
  enum class Kind { null, boolean, number, string, array, object };

  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0;
  std::string string;  ///< escapes above ASCII are left as they were written
  std::vector<Json> items;
  std::map<std::string, Json> members;

  /// Returns the member of that name. Throws if there is none.
  const Json& operator[](const std::string& name) const { return members.at(name); }
  bool has(const std::string& name) const { return members.count(name) != 0; }
};

/// Parses JSON. Throws std::runtime_error, with the place, if `text` is not exactly one JSON value.
Json parse_json(std::string_view text);

}  // namespace crt::test
