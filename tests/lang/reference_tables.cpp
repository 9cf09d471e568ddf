#include "reference_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "lang/settings.hpp"

namespace crt::test {

namespace {

const lang::ObjectType* type_of(std::string_view name) {
  return name == "Settings" ? &lang::settings_type() : lang::find_object_type(name);
}

}  // namespace

std::vector<std::string> cells(std::string_view row) {
  std::vector<std::string> result;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] != '|' || row[i - 1] == '\\') {
      cell += row[i];
      continue;
    }
    const std::size_t begin = cell.find_first_not_of(' ');
    const std::size_t end = cell.find_last_not_of(' ');
    result.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
    cell.clear();
  }
  return result;
}

std::string attribute_rows(const lang::ObjectType& type,
                           const std::map<std::string, std::string, std::less<>>& meanings) {
  std::string rows;
  for (const lang::AttributeType& attribute : type.attributes) {
    std::string about(attribute.about);
    const auto meaning = meanings.find(fmt::format("`{}`", attribute.name));
    if (about.empty() && meaning != meanings.end() && !attribute.is_of_schema)
      about = meaning->second;
    const std::string default_text =
        attribute.required ? "required" : fmt::format("`{}`", attribute.default_text);
    rows += fmt::format("| `{}` | {} | {} |{}|\n", attribute.name, attribute.type, default_text,
                        about.empty() ? " " : " " + about + " ");
  }
  return rows;
}

std::string with_attribute_tables(const std::string& page) {
  std::istringstream lines(page);
  std::string result;
  std::string heading;
  for (std::string line; std::getline(lines, line);) {
    result += line + '\n';
    if (line.starts_with("#")) heading = line.substr(line.find(' ') + 1);
    const lang::ObjectType* const type = type_of(heading);
    if (!line.starts_with("| attribute |") || !type) continue;
    std::map<std::string, std::string, std::less<>> meanings;
    std::getline(lines, line);
    result += line + '\n';
    while (std::getline(lines, line) && line.starts_with("|")) {
      const std::vector<std::string> row = cells(line);
      if (row.size() == 4) meanings[row[0]] = row[3];
    }
    result += attribute_rows(*type, meanings) + line + '\n';
  }
  return result;
}

std::string with_object_words(const std::string& dictionary) {
  std::vector<std::string> words;
  const auto add = [&words](std::string_view word) {
    const std::string line = fmt::format("\"{}\"\n", word);
    if (std::find(words.begin(), words.end(), line) == words.end()) words.push_back(line);
  };
  for (const lang::ObjectType& type : lang::object_types()) add(type.name);
  for (const lang::ObjectType& type : lang::object_types())
    for (const lang::AttributeType& attribute : type.attributes) add(attribute.name);
  for (const lang::AttributeType& attribute : lang::settings_type().attributes) add(attribute.name);
  const std::string heading = "# Objects and attributes, as ./dev generate writes them:\n";
  const std::size_t begin = dictionary.find(heading) + heading.size();
  const std::size_t end = dictionary.find("# More words:", begin);
  return fmt::format("{}{}{}", dictionary.substr(0, begin), fmt::join(words, ""),
                     dictionary.substr(end));
}

}  // namespace crt::test
