// This writes values as they stand in source code.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "crt/color.hpp"
#include "crt/source_code.hpp"
#include "crt/vec.hpp"

namespace crt::source {

/// Lines of code end at this column where a list can be broken.
inline constexpr std::size_t max_columns = 96;

class Syntax {
 public:
  explicit Syntax(SourceLanguage language) : language_(language) {}

  SourceLanguage language() const { return language_; }
  bool is_cpp() const { return language_ == SourceLanguage::cpp; }
  bool is_python() const { return language_ == SourceLanguage::python; }
  bool is_c() const { return language_ == SourceLanguage::c; }
  bool is_script() const { return language_ == SourceLanguage::script; }

  /// Returns the shortest text that reads as the number.
  static std::string number(double number);
  std::string boolean(bool value) const;
  /// Returns a text between quotes. Long ones are cut into pieces, a line each, but in a script.
  std::string text(const std::string& content) const;
  /// Returns three numbers as an argument.
  std::string vector(const Vec3& v) const;
  /// Returns a colour as C++ and scripts have it.
  std::string color(const Color& color) const;
  /// Returns items between brackets, which are "{}" in C++ and C.
  std::string list(std::span<const std::string> items) const;
  /// Returns "Name{items}", "crt.Name(items)" or "Name { items }".
  std::string constructed(const std::string& name, std::span<const std::string> items) const;
  /// Returns an enumerator. `prefix` is what its name in C begins with, such as "CRT_FILTER".
  std::string enumerator(std::string_view type, std::string_view prefix,
                         std::string_view name) const;

 private:
  SourceLanguage language_;
};

/// Puts items between brackets, with commas.
std::string joined(std::string begin, std::span<const std::string> items, std::string_view end);

/// Breaks lines behind commas, and before attributes of a script, where they would be too long, and
/// indents what follows. Texts between quotes and the vectors of scripts stay whole.
std::string wrapped(std::string_view text, std::size_t indent);

/// Returns numbers as items of a list.
template <class Numbers>
std::vector<std::string> number_items(const Numbers& numbers) {
  std::vector<std::string> items;
  items.reserve(numbers.size());
  for (const auto number : numbers) items.push_back(Syntax::number(static_cast<double>(number)));
  return items;
}

}  // namespace crt::source
