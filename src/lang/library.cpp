#include "lang/library.hpp"

#include <vector>

#include "lang/reporter.hpp"
#include "lang/suggestion.hpp"
#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

constexpr std::string_view prefix = "crt/";
constexpr std::string_view ending = ".crt";

}  // namespace

std::string library_path_of(std::string_view name) {
  // A test checks that each variable of the library begins a line.
  const std::string setting = text::format("\n{} = ", name);
  for (const LibraryScript& script : library()) {
    if (script.text.find(setting) != std::string_view::npos)
      return text::format("{}{}", prefix, script.name);
  }
  return {};
}

bool is_library_path(std::string_view path) {
  return path.starts_with(prefix);
}

std::string_view library_name(std::string_view path) {
  std::string_view name = path.substr(prefix.size());
  if (name.ends_with(ending)) name.remove_suffix(ending.size());
  return name;
}

std::string_view find_library(const std::string& path, Span span) {
  const std::string_view name = library_name(path);
  std::vector<std::string_view> paths;
  std::vector<std::string> listed;
  static const std::vector<std::string> all = [] {
    std::vector<std::string> result;
    for (const LibraryScript& script : library())
      result.push_back(std::string(prefix) + std::string(script.name));
    return result;
  }();
  for (const LibraryScript& script : library()) {
    if (script.name == name) return script.text;
  }
  for (const std::string& known : all) {
    paths.emplace_back(known);
    listed.push_back(text::format("'{}'", known));
  }
  std::string hint = did_you_mean(path, paths);
  if (hint.empty()) hint = "; there are " + enumerate(listed, "and");
  throw Failure{.span = span,
                .message = text::format("CRT comes with no '{}'{}", abbreviated(path), hint),
                .code = ErrorCode::io};
}

}  // namespace crt::lang
