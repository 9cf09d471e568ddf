// The tree of an OpenSCAD .csg file: modules with arguments and children.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "import/notes.hpp"

namespace crt::importing {

/// A CsgValue is an argument.
struct CsgValue {
  enum class Kind { undefined, number, boolean, text, list };
  Kind kind = Kind::undefined;
  double number = 0;  ///< of a boolean 0 or 1
  std::string text{};
  std::vector<CsgValue> items{};
};

struct CsgNode {
  std::string name{};
  char modifier = 0;  ///< one of % # * !, or 0
  std::vector<std::pair<std::string, CsgValue>> arguments{};
  std::vector<CsgNode> children{};
  Place place{};

  /// Returns the argument of a name, or the first one without a name for "". Returns an undefined
  /// value if there is none.
  const CsgValue& argument(std::string_view called) const;
  double number(std::string_view called, double usual) const;
  bool flag(std::string_view called) const { return number(called, 0) != 0; }
  std::string text(std::string_view called) const { return argument(called).text; }
  /// Returns a list of at least `least` numbers, or nothing if it is something else.
  std::optional<std::vector<double>> numbers(std::string_view called, std::size_t least) const;
};

/// Returns the numbers of a list, or nothing if there are other items, or fewer.
std::optional<std::vector<double>> numbers_of(const CsgValue& list, std::size_t least);

/// Reads the file of a number in the notes. Throws Failure for what is no such tree.
std::vector<CsgNode> parse_csg(std::string_view text, int file);

}  // namespace crt::importing
