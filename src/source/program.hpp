// A program is put together here: statements of the function that makes a scene, and before them
// the arrays that it uses.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "source/fields.hpp"
#include "source/syntax.hpp"

namespace crt::source {

class Program {
 public:
  explicit Program(const SourceOptions& options)
      : syntax_(options.language), max_bytes_(options.most_bytes), name_(options.name) {}

  const Syntax& syntax() const { return syntax_; }

  /// Throws Error (limit) if there is surely no space for a list of so many numbers. It is asked
  /// before any of them is written.
  void require_space(std::size_t numbers) const;
  /// Adds a line of the function. Throws Error (limit) if the program becomes too long.
  void add_line(const std::string& line);
  /// Adds lines as they are, which may be too many likewise.
  void add_block(const std::string& lines);
  /// Returns a name of this kind that nothing else has.
  std::string new_name(const std::string& kind);
  /// Gives a value a name, but in C. `type` is that of C++. Returns the name.
  std::string define(const std::string& kind, const std::string& type, const std::string& value);
  /// Adds a call in C that makes a thing and puts it behind its last argument. It is released at
  /// the end of the function. Returns the thing's name.
  std::string create(const std::string& kind, const std::string& function,
                     std::vector<std::string> arguments);
  /// Returns a struct as a value. In C it is a variable with the name that is returned, filled in
  /// with the defaults of a type if that is given.
  std::string structure(const std::string& kind, const std::string& name, const Fields& fields,
                        const std::string& type = "");
  /// Gives an array a name. `type` is that of its items in C and C++. Python and scripts have the
  /// list as it is.
  std::string array(const std::string& kind, const std::string& type,
                    std::span<const std::string> items);
  /// Gives an array in C a name, of items that are known in the function alone.
  std::string local_array(const std::string& kind, const std::string& type,
                          std::span<const std::string> items);

  /// Returns the name under which something was remembered, or nothing.
  std::string known(const void* thing) const;
  std::string remember(const void* thing, std::string name);

  /// Returns the name that a value was remembered under, or nothing.
  std::string known_value(const std::string& value) const;
  void remember_value(const std::string& value, const std::string& name) { values_[value] = name; }

  /// Adds a file that is to lie beside a script. Returns its name.
  std::string add_file(std::span<const std::byte> content, const std::string& ending);
  const std::vector<SourceFile>& files() const { return files_; }

  /// Returns an angle in degrees. It warns if they are other radians.
  std::string degrees(double radians);
  /// Returns an angle as structs have it: in radians, and in scripts in degrees.
  std::string angle(double radians);

  /// Says that a script is to be one of 2015.
  void set_is_of_2015() { is_of_2015_ = true; }
  /// Throws Error (unsupported) if the script that is written is one of 2015.
  void refuse_in_2015(const std::string& what) const;

  void warn_once(const std::string& warning);

  const std::string& arrays() const { return arrays_; }
  const std::string& lines() const { return lines_; }
  /// Returns what releases all things but one that create() has made.
  std::string releases(const std::string& kept) const;
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void grow(std::size_t bytes);
  [[noreturn]] void refuse() const;

  struct Made {
    std::string kind;
    std::string name;
  };

  Syntax syntax_;
  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::map<std::string, int> numbers_;
  std::map<const void*, std::string> known_;
  std::map<std::string, std::string> values_;
  std::vector<Made> made_;
  std::string arrays_;
  std::string lines_;
  std::vector<std::string> warnings_;
  bool is_of_2015_ = false;
  std::string name_;
  std::vector<SourceFile> files_;
};

}  // namespace crt::source
