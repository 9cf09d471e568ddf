#include "cli/command_description.hpp"

#include <sstream>

namespace crt::cli {

ValueKind value_kind(const std::string& type) {
  if (type == "FILE" || type == "NAME") return ValueKind::file;
  if (type == "FOLDER") return ValueKind::folder;
  if (type == "SCENE.crt") return ValueKind::script;
  return type.find('|') != std::string::npos ? ValueKind::choice : ValueKind::anything;
}

std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> choices;
  std::istringstream words(type);
  for (std::string word; std::getline(words, word, '|');) choices.push_back(word);
  return choices;
}

}  // namespace crt::cli
