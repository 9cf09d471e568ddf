// What is not understood of a file is noted with its place.
#pragma once

#include <crt/script.hpp>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace crt::importing {

/// A Place is where something stands in one of the files that are read. Columns count bytes of
/// ASCII, as both languages have little else.
struct Place {
  int file = 0;
  int line = 1;
  int column = 1;
};

/// A Failure ends the reading of a file.
class Failure : public std::runtime_error {
 public:
  Failure(const Place& place, const std::string& message, ErrorCode code = ErrorCode::script)
      : std::runtime_error(message), place_(place), code_(code) {}

  const Place& place() const { return place_; }
  ErrorCode code() const { return code_; }

 private:
  Place place_;
  ErrorCode code_;
};

/// Notes become diagnostics. What is said of one place is said once, however often loops come
/// there.
class Notes {
 public:
  explicit Notes(bool partial) : partial_(partial) {}

  /// Adds a file, and returns its number. Its text is kept.
  int add_file(const std::string& name, std::string text);
  const std::string& text(int file) const { return files_[static_cast<std::size_t>(file)].text; }
  const std::string& name(int file) const { return files_[static_cast<std::size_t>(file)].name; }

  /// Notes that a part of the shape is missing, which is an error unless a partial script will do.
  void lost(const Place& place, const std::string& message);
  /// Notes that something looks different, or is made in another way.
  void differs(const Place& place, const std::string& message);
  void failed(const Failure& failure);

  bool has_errors() const { return has_errors_; }
  std::vector<Diagnostic> take() { return std::move(diagnostics_); }

 private:
  struct File {
    std::string name;
    std::string text;
  };

  void add(Severity severity, ErrorCode code, const Place& place, const std::string& message);

  bool partial_;
  bool has_errors_ = false;
  std::vector<File> files_;
  std::vector<Diagnostic> diagnostics_;
  std::set<std::tuple<int, int, int, std::string>> said_;
};

}  // namespace crt::importing
