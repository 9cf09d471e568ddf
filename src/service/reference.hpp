// The reference of the language (docs/language.md) is what editors show about objects, attributes,
// built-ins and keywords. Its text is a part of the program. This finds the pieces in it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crt::service {

/// Returns the text of docs/language.md, as it was when the program was built.
std::string_view reference_text();

class Reference {
 public:
  explicit Reference(std::string_view markdown);

  /// Says what an object is, in Markdown, or nothing if there is no more to say than its
  /// attributes.
  std::string object(std::string_view name) const;

  /// Says what an attribute of an object means. It may be nothing.
  std::string attribute(std::string_view object, std::string_view name) const;

  /// Says what a built-in, a constant or a keyword is, or nothing.
  std::string word(std::string_view name) const;

 private:
  class Reader;

  std::map<std::string, std::string, std::less<>> objects_;
  std::map<std::pair<std::string, std::string>, std::string> attributes_;
  std::map<std::string, std::string, std::less<>> words_;
};

}  // namespace crt::service
