// This program shows what an editor asks: `language_service` lists the objects of the language, and
// with SCRIPT.crt what is wrong with a script, its files, blocks and names. With LINE COLUMN it
// says what is known about that place, and with NEW_NAME it prints the script with another name for
// the one there. Lines and columns count from 1, and columns in units of UTF-16, as in many
// editors.
#include <algorithm>
#include <crt/error.hpp>
#include <crt/language_service.hpp>
#include <crt/text_places.hpp>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace {

/// An Editor has one script open.
struct Editor {
  std::string name;
  std::string text;
  crt::LanguageService service{text, name};
  crt::TextPlaces places{text};
};

/// Returns "scene.crt:3:5" for the first byte of a location.
std::string shown(const Editor& editor, const crt::ScriptLocation& location) {
  for (const crt::ScriptFile& file : editor.service.files()) {
    if (file.name != location.file) continue;
    const crt::LineColumn place =
        crt::TextPlaces(file.text).position_of(location.span.begin, crt::ColumnUnit::utf16);
    return file.name + ":" + std::to_string(place.line + 1) + ":" +
           std::to_string(place.column + 1);
  }
  return location.file;
}

void list_objects() {
  for (const crt::ObjectDescription& object : crt::describe_objects()) {
    std::cout << object.name << ':';
    for (const crt::AttributeDescription& attribute : object.attributes)
      std::cout << ' ' << attribute.name;
    std::cout << '\n';
  }
}

void list_script(const Editor& editor) {
  for (const crt::Diagnostic& diagnostic : editor.service.diagnostics())
    std::cout << crt::format_diagnostic(diagnostic);
  for (const crt::ScriptFile& file : editor.service.files())
    std::cout << file.name << " has " << file.text.size() << " bytes\n";
  const std::vector<crt::ScriptToken> tokens = editor.service.tokens();
  const auto comments = std::count_if(tokens.begin(), tokens.end(), [](const auto& token) {
    return token.kind == crt::TokenKind::comment;
  });
  std::cout << comments << " comments\n";
  for (const crt::ScriptNode& node : editor.service.tree()) {
    if (node.parent != crt::ScriptNode::no_parent) continue;
    std::cout << shown(editor, {editor.name, node.name_span}) << ": " << node.name << '\n';
  }
  for (const crt::ScriptSymbol& symbol : editor.service.symbols())
    std::cout << symbol.name << " stands at " << symbol.uses.size() << " places\n";
}

void describe_place(const Editor& editor, std::uint32_t byte) {
  if (const auto hover = editor.service.hover(byte)) std::cout << hover->markdown << '\n';
  if (const auto definition = editor.service.definition(byte))
    std::cout << "set at " << shown(editor, *definition) << '\n';
  for (const crt::ScriptLocation& place : editor.service.places(byte))
    std::cout << "stands at " << shown(editor, place) << '\n';
  for (const crt::Completion& completion : editor.service.complete(byte).items)
    std::cout << completion.label << ' ';
  std::cout << "may come there\n";
}

/// Prints the script with another name, laid out.
void rename(const Editor& editor, std::uint32_t byte, const std::string& new_name) {
  const auto old_name = editor.service.renamable_name(byte);
  if (!old_name) throw crt::Error(crt::ErrorCode::invalid_argument, "there is no name to change");
  std::string text = editor.text;
  auto places = editor.service.rename(byte, new_name);
  std::reverse(places.begin(), places.end());
  for (const crt::ScriptLocation& place : places) {
    if (place.file == editor.name)
      text.replace(place.span.begin, place.span.end - place.span.begin, new_name);
  }
  std::cout << crt::format_script(text, editor.name).text.value_or(text);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 1) return list_objects(), 0;
  if (argc == 3 || argc > 5) {
    std::cerr << "usage: language_service [SCRIPT.crt [LINE COLUMN [NEW_NAME]]]\n";
    return 2;
  }
  std::ifstream file(argv[1], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const Editor editor{.name = argv[1], .text = text};
  if (argc == 2) list_script(editor);
  if (argc < 4) return 0;
  const crt::LineColumn place{static_cast<std::uint32_t>(std::stoul(argv[2]) - 1),
                              static_cast<std::uint32_t>(std::stoul(argv[3]) - 1)};
  const std::uint32_t byte = editor.places.byte_at(place, crt::ColumnUnit::utf16);
  if (argc == 4) describe_place(editor, byte);
  if (argc == 5) rename(editor, byte, argv[4]);
} catch (const std::exception& error) {
  std::cerr << "language_service: " << error.what() << '\n';
  return 1;
}
