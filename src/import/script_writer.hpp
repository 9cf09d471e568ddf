// The writer of scripts: solids and materials become definitions and expressions.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "import/solid.hpp"

namespace crt::importing {

/// Puts blanks before each line but the first.
std::string indented_text(const std::string& text, int columns);

class ScriptWriter {
 public:
  /// Returns the name of a material, "Material { ... }". Equal ones are one. It is called as is
  /// wished, if that is a word that is free.
  std::string material(const std::string& text, const std::string& wish);
  /// Returns a free name that is a word of scripts.
  std::string free_name(const std::string& wish);

  /// Counts what a solid consists of, so that what occurs more than once gets a name. All solids
  /// are counted before any is written.
  void count(const SharedSolid& solid);
  /// Returns an expression. What has a name is defined before.
  std::string write(const SharedSolid& solid);

  const std::string& materials() const { return materials_; }
  /// Returns the materials that a text names behind the word "material".
  std::string materials_of(std::string_view text) const;
  const std::string& definitions() const { return definitions_; }
  std::size_t size() const { return materials_.size() + definitions_.size(); }

 private:
  struct Written {
    std::string text;
    bool is_operand = true;  ///< a suffix or operator may follow without brackets
    int depth = 0;           ///< of expressions within one another
  };
  struct Known {
    int uses = 0;
    std::string name{};
  };

  int number_of(const SharedSolid& solid);
  Written expression(const SharedSolid& solid);
  Written body(const Solid& solid);
  Written combined(const Solid& solid, const char* sign);
  Written named(const Solid& solid, const Written& written, Known& known);

  std::string materials_;
  std::string definitions_;
  std::map<std::string, std::string> material_names_;
  std::set<std::string> names_{"part", "scene"};
  std::map<std::string, int> next_;  ///< the number of a name that may be free
  std::unordered_map<std::string, int> numbers_;
  std::unordered_map<const Solid*, int> numbers_of_solids_;
  std::vector<Known> known_;
};

}  // namespace crt::importing
