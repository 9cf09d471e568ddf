// Directives of POV-Ray's language: loops, conditions, macros, included files and declarations.
#include <cmath>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "import/pov_stream.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr std::size_t most_frames = 100;  // macros and files within one another
constexpr std::uintmax_t most_bytes_of_file = std::uintmax_t{64} << 20;
constexpr std::size_t most_files = 200;

bool opens_block(const std::string& directive) {
  return directive == "if" || directive == "ifdef" || directive == "ifndef" ||
         directive == "while" || directive == "for" || directive == "switch" ||
         directive == "macro";
}

/// Says whether a path stays in the folder that it is looked for in.
bool stays_inside(const std::filesystem::path& path) {
  if (path.is_absolute()) return false;
  for (const std::filesystem::path& part : path)
    if (part == "..") return false;
  return true;
}

/// Arrays are values: who changes one changes no other.
PovValue copied(PovValue value) {
  const auto* const array = value.get<std::shared_ptr<PovArray>>();
  if (!array) return value;
  const auto copy = std::make_shared<PovArray>(**array);
  for (PovValue& element : *copy) element = copied(std::move(element));
  return {copy};
}

}  // namespace

double PovStream::condition() {
  expect("(", "behind this directive");
  const bool was = std::exchange(no_compare_, false);
  const double value = float_expression();
  no_compare_ = was;
  expect(")", "behind a condition");
  return value;
}

void PovStream::follow(const PovToken& directive) {
  const std::string& name = directive.text;
  if (name == "declare" || name == "local") return follow_declare(name == "local");
  if (name == "include") return follow_include(directive.place);
  if (name == "if") return follow_condition(condition() != 0);
  if (name == "ifdef" || name == "ifndef")
    return follow_condition(is_defined() == (name == "ifdef"));
  if (name == "while") return follow_while();
  if (name == "for") return follow_for();
  if (name == "switch") return follow_switch();
  if (name == "macro") return follow_macro();
  if (name == "end") return follow_end(directive.place);
  if (name == "break") return follow_break();
  if (name == "else" || name == "elseif" || name == "case" || name == "range") {
    if (frame().open.empty())
      throw Failure(directive.place, text::format("#{} stands in no block", name));
    if (frame().open.back().kind == Open::Kind::choice) {
      // What was chosen goes on into the next case.
      if (name == "case") condition();
      if (name == "range") {
        expect("(", "behind #range");
        float_expression();
        expect(",", "between the ends of a #range");
        float_expression();
        expect(")", "behind #range");
      }
      return;
    }
    skip_to_end(false);
    frame().open.pop_back();
    return;
  }
  if (name == "version") {
    hold_ = frames_.size();
    version_ = float_expression();
    take_sign(";");
    return give_back();
  }
  if (name == "undef") {
    take_raw("a name");
    return;
  }
  if (name == "default") return default_texture();
  if (name == "debug" || name == "warning" || name == "render" || name == "statistics" ||
      name == "error") {
    const std::string text = text_of_directive();
    if (name == "error") throw Failure(directive.place, "the scene says: " + text);
    return;
  }
  throw Failure(directive.place, text::format("#{} is not understood", name));
}

void PovStream::follow_condition(bool is_true) {
  if (is_true) {
    open_if({});
  } else {
    skip_to_end(true);
  }
}

bool PovStream::is_defined() {
  if (!take_raw("'('").is_sign("(")) fail("'(' is expected behind #ifdef");
  const std::string name = take_raw("a name").text;
  int depth = 1;
  while (depth > 0) {
    const PovToken token = take_raw("')'");
    depth += token.is_sign("(") ? 1 : token.is_sign(")") ? -1 : 0;
  }
  return find(name) != nullptr;
}

void PovStream::skip_to_end(bool stops_at_else) {
  for (int depth = 0;;) {
    const PovToken token = take_raw("#end");
    if (token.kind != PovToken::Kind::directive) continue;
    if (opens_block(token.text)) {
      ++depth;
    } else if (token.text == "end") {
      if (depth-- == 0) return;
    } else if (depth == 0 && stops_at_else && token.text == "else") {
      return open_if({});
    } else if (depth == 0 && stops_at_else && token.text == "elseif") {
      return follow_condition(condition() != 0);
    }
  }
}

void PovStream::follow_while() {
  const std::size_t begin = frame().at;
  if (condition() == 0) return skip_to_end(false);
  open_if({Open::Kind::loop, [this, begin] {
             frame().at = begin;
             follow_while();
           }});
}

void PovStream::follow_for() {
  expect("(", "behind #for");
  const std::string name = take_raw("a name").text;
  expect(",", "behind the name of a loop");
  const double first = float_expression();
  expect(",", "behind the first value of a loop");
  const double last = float_expression();
  const double step = take_sign(",") ? float_expression() : 1;
  expect(")", "behind #for");
  if (step == 0) fail("the step of a loop is 0");
  set(name, {first}, true);
  next_round(name, last, step, frame().at);
}

void PovStream::next_round(const std::string& name, double last, double step, std::size_t body) {
  const PovValue* const value = find(name);
  const double* const now = value ? value->get<double>() : nullptr;
  const double room = std::abs(step) * 1e-6;
  if (!now || (step > 0 ? *now > last + room : *now < last - room)) return skip_to_end(false);
  open_if({Open::Kind::loop, [this, name, last, step, body] {
             const PovValue* const held = find(name);
             const double* const old = held ? held->get<double>() : nullptr;
             frame().at = body;
             if (old) set(name, {*old + step}, true);
             next_round(name, last, step, body);
           }});
}

void PovStream::follow_switch() {
  const double value = condition();
  for (int depth = 0;;) {
    const PovToken token = take_raw("#end");
    if (token.kind != PovToken::Kind::directive) continue;
    if (opens_block(token.text)) {
      ++depth;
      continue;
    }
    if (token.text == "end" && depth-- == 0) return;
    if (depth > 0) continue;
    bool is_chosen = token.text == "else";
    if (token.text == "case") is_chosen = condition() == value;
    if (token.text == "range") {
      expect("(", "behind #range");
      const double low = float_expression();
      expect(",", "between the ends of a #range");
      const double high = float_expression();
      expect(")", "behind #range");
      is_chosen = value >= low && value <= high;
    }
    if (is_chosen) return open_if({Open::Kind::choice, {}});
  }
}

void PovStream::follow_break() {
  for (;;) {
    if (frame().open.empty()) fail("#break stands in no loop and no #switch");
    const Open::Kind kind = frame().open.back().kind;
    skip_to_end(false);
    frame().open.pop_back();
    if (kind != Open::Kind::condition) return;
  }
}

void PovStream::follow_end(const Place& place) {
  if (frame().open.empty()) throw Failure(place, "this #end ends nothing");
  const Open open = std::move(frame().open.back());
  frame().open.pop_back();
  if (open.ends) open.ends();
}

void PovStream::follow_macro() {
  PovMacro macro;
  const std::string name = take_raw("a name").text;
  if (!take_raw("'('").is_sign("(")) fail("'(' is expected behind the name of a macro");
  for (;;) {
    const PovToken token = take_raw("')'");
    if (token.is_sign(")")) break;
    if (token.kind == PovToken::Kind::word && token.text != "optional")
      macro.parameters.push_back(token.text);
  }
  macro.tokens = frame().tokens;
  macro.begin = frame().at;
  skip_to_end(false);
  macro.end = frame().at - 1;
  set(name, {macro}, false);
}

bool PovStream::call_macro(const PovToken& name) {
  const PovValue* const value = find(name.text);
  const PovMacro* const found = value ? value->get<PovMacro>() : nullptr;
  if (!found || !raw() || !raw()->is_sign("(")) return false;
  const PovMacro macro = *found;
  if (frames_.size() >= most_frames)
    throw Failure(name.place, "macros and files lie too deep in one another", ErrorCode::limit);
  ++frame().at;
  const std::size_t held = std::exchange(hold_, 0);
  std::map<std::string, PovValue, std::less<>> names;
  for (std::size_t i = 0; !take_sign(")"); ++i) {
    if (i > 0) expect(",", "between the arguments of a macro");
    if (i >= macro.parameters.size())
      throw Failure(name.place, text::format("the macro '{}' takes {} arguments", name.text,
                                             macro.parameters.size()));
    names[macro.parameters[i]] = declared_value(macro.parameters[i]);
  }
  hold_ = held;
  frames_.push_back({.tokens = macro.tokens,
                     .at = macro.begin,
                     .end = macro.end,
                     .is_macro = true,
                     .open = {},
                     .names = std::move(names)});
  return true;
}

void PovStream::follow_include(const Place& place) {
  const std::string name = text_of_directive();
  if (frames_.size() >= most_frames || files_.size() >= most_files)
    throw Failure(place, "too many files are included", ErrorCode::limit);
  std::vector<std::filesystem::path> folders{folder_};
  folders.insert(folders.end(), options_.include_folders.begin(), options_.include_folders.end());
  for (const std::filesystem::path& folder : folders) {
    const std::filesystem::path path = folder / name;
    const auto known = files_.find(path.string());
    if (known != files_.end()) {
      frames_.push_back({.tokens = known->second, .end = known->second->size()});
      return;
    }
    std::error_code failed;
    if (!stays_inside(name) || !std::filesystem::is_regular_file(path, failed)) continue;
    if (std::filesystem::file_size(path, failed) > most_bytes_of_file)
      throw Failure(place, text::format("{} is too long", path.string()), ErrorCode::limit);
    std::ifstream stream(path, std::ios::binary);
    return open(path.string(), {std::istreambuf_iterator<char>(stream), {}});
  }
  notes_.lost(place, text::format("there is no file '{}' beside the scene or in a folder of "
                                  "--include",
                                  name));
}

void PovStream::follow_declare(bool is_local) {
  PovToken name = take_raw("a name");
  if (name.is_word("deprecated")) {
    do {
      name = take_raw("a name");
    } while (name.is_word("once") || name.kind == PovToken::Kind::text);
  }
  if (name.kind != PovToken::Kind::word) throw Failure(name.place, "a name is expected here");
  PovValue* place = nullptr;
  if (raw() && raw()->is_sign("[")) {
    place = find(name.text);
    if (!place) throw Failure(name.place, text::format("there is no array '{}'", name.text));
    while (take_sign("[")) {
      const double index = float_expression();
      expect("]", "behind an index");
      const auto* const array = place->get<std::shared_ptr<PovArray>>();
      if (!array || !(index >= 0) || index >= static_cast<double>((*array)->size()))
        throw Failure(name.place, text::format("'{}' has no such element", name.text));
      place = &(**array)[static_cast<std::size_t>(index)];
    }
  }
  expect("=", "behind a name that is declared");
  hold_ = frames_.size();
  PovValue value = copied(declared_value(name.text));
  take_sign(";");
  give_back();
  if (place) {
    *place = std::move(value);
  } else {
    set(name.text, std::move(value), is_local);
  }
}

}  // namespace crt::importing
