// This fuzzer asks a LanguageService all that it knows of a text, and checks what must hold: places
// lie in the text, nodes lie in those around them, and a name that is changed can be changed back.
// What comes before the first byte 1 is a script that the rest may import as "part.crt".
#include <algorithm>
#include <crt/error.hpp>
#include <crt/language_service.hpp>
#include <crt/text_places.hpp>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace crt;

const std::string main_name = "/fuzz/main.crt";
const std::string part_name = "/fuzz/part.crt";

void require(bool condition) {
  if (!condition) std::abort();
}

using Texts = std::map<std::string, std::string>;

ScriptOptions options_for(const Texts& texts) {
  ScriptOptions options;
  options.open_file = [texts](const std::filesystem::path& path) {
    const auto text = texts.find(path.string());
    if (text == texts.end()) return std::optional<std::vector<std::byte>>();
    const auto* begin = reinterpret_cast<const std::byte*>(text->second.data());
    return std::optional(std::vector<std::byte>(begin, begin + text->second.size()));
  };
  return options;
}

LanguageService service_of(const Texts& texts, const std::string& name) {
  return {texts.at(name), name, options_for(texts)};
}

void check_span(TextSpan span, const std::string& text) {
  require(span.begin <= span.end && span.end <= text.size());
}

void check_lists(const LanguageService& service, const std::string& text) {
  std::uint32_t behind = 0;
  for (const ScriptToken& token : service.tokens()) {
    check_span(token.span, text);
    require(token.span.begin >= behind);
    behind = token.span.end;
  }
  const std::vector<ScriptNode> tree = service.tree();
  for (std::size_t i = 0; i < tree.size(); ++i) {
    check_span(tree[i].span, text);
    check_span(tree[i].name_span, text);
    if (tree[i].parent == ScriptNode::no_parent) continue;
    require(tree[i].parent < i);
    const TextSpan around = tree[tree[i].parent].span;
    require(around.begin <= tree[i].span.begin && tree[i].span.end <= around.end);
  }
  for (const ScriptSymbol& symbol : service.symbols()) {
    check_span(symbol.definition, text);
    for (const TextSpan use : symbol.uses) check_span(use, text);
  }
  const TextPlaces places(text);
  for (const Diagnostic& diagnostic : service.diagnostics())
    if (diagnostic.place.file == main_name) check_span(places.span_of(diagnostic.place), text);
}

void check_places(const std::string& text, std::uint32_t byte) {
  const TextPlaces places(text);
  const std::uint32_t first = places.byte_of(places.unit_of(byte));
  require(first <= byte && places.unit_of(first) == places.unit_of(byte));
  for (const ColumnUnit unit : {ColumnUnit::utf8, ColumnUnit::utf16}) {
    const LineColumn position = places.position_of(byte, unit);
    const std::uint32_t back = places.byte_at(position, unit);
    require(back <= byte && places.position_of(back, unit) == position);
  }
}

Texts with_name(Texts texts, const std::vector<ScriptLocation>& places, const std::string& name) {
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    texts.at(place->file).replace(place->span.begin, place->span.end - place->span.begin, name);
  return texts;
}

/// Changes the name at a byte of the part or of the main script, and back.
void rename_and_back(const Texts& texts, const std::string& file, std::uint32_t byte) {
  const std::string new_name = "another_name";
  const LanguageService main = service_of(texts, main_name);
  const LanguageService part = service_of(texts, part_name);
  const LanguageService& asked = file == main_name ? main : part;
  const std::optional<TextSpan> span = asked.renamable_name(byte);
  std::vector<ScriptLocation> places;
  try {
    places = asked.rename(byte, new_name, {&main, &part});
  } catch (const Error&) {
    return;
  }
  require(span.has_value());
  const std::string& text = texts.at(file);
  const std::string name = text.substr(span->begin, span->end - span->begin);
  // Those of one file come in their order, as replacing them from behind needs.
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i - 1].file == places[i].file)
      require(places[i - 1].span.end <= places[i].span.begin);
  const Texts renamed = with_name(texts, places, new_name);
  const auto before = std::count_if(places.begin(), places.end(), [&](const auto& place) {
    return place.file == file && place.span.begin < span->begin;
  });
  const auto longer = static_cast<std::ptrdiff_t>(new_name.size() - name.size());
  const auto moved = static_cast<std::uint32_t>(span->begin + before * longer);
  const LanguageService other_main = service_of(renamed, main_name);
  const LanguageService other_part = service_of(renamed, part_name);
  const LanguageService& other = file == main_name ? other_main : other_part;
  require(with_name(renamed, other.rename(moved, name, {&other_main, &other_part}), name) == texts);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string all(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::size_t cut = std::min(all.find('\1'), all.size());
  const Texts texts{{part_name, all.substr(0, cut)},
                    {main_name, all.substr(std::min(cut + 1, all.size()))}};
  const std::string& file = data[0] % 2 == 0 ? main_name : part_name;
  const std::string& text = texts.at(file);
  const auto byte = static_cast<std::uint32_t>(data[0] * (text.size() + 1) / 256);
  const LanguageService service = service_of(texts, file);
  check_lists(service, text);
  check_places(text, byte);
  const CompletionList list = service.complete(byte);
  check_span({list.begin, list.end}, text);
  if (const auto hover = service.hover(byte)) check_span(hover->span, text);
  if (const auto place = service.definition(byte)) require(!place->file.empty());
  const std::vector<ScriptSymbol> symbols = service.symbols();
  if (symbols.empty()) return 0;
  rename_and_back(texts, file, symbols[data[0] / 2 % symbols.size()].definition.begin);
  return 0;
}
