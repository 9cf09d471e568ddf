#include "import/script_writer.hpp"

#include <algorithm>
#include <array>
#include <crt/error.hpp>
#include <utility>

#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::importing {

namespace {

constexpr std::size_t most_columns = 90;  // columns of what stands on one line
constexpr std::size_t worth_a_name = 48;  // columns of a lone object that is used again
constexpr int most_depth_of_expression = 6;
constexpr std::size_t most_bytes = std::size_t{60} << 20;

bool is_one_line(const std::string& text) {
  return text.find('\n') == std::string::npos;
}

/// Cuts a text behind commas outside of round brackets that lie in so many square ones at most.
std::vector<std::string_view> pieces_of_list(std::string_view text, int most_depth) {
  std::vector<std::string_view> pieces;
  int round = 0, square = 0;
  bool in_quotes = false;
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' && (at == 0 || text[at - 1] != '\\')) in_quotes = !in_quotes;
    if (in_quotes) continue;
    round += c == '(' ? 1 : c == ')' ? -1 : 0;
    square += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c != ',' || round > 0 || square > most_depth) continue;
    pieces.push_back(text.substr(begin, at + 1 - begin));
    begin = at + 1;
  }
  pieces.push_back(text.substr(begin));
  return pieces;
}

/// Breaks a long list where as few brackets as can be are open.
std::string broken(const std::string& text, std::size_t columns) {
  if (text.size() <= columns) return text;
  std::vector<std::string_view> pieces;
  for (int depth = 1; depth <= 3; ++depth) {
    pieces = pieces_of_list(text, depth);
    if (std::all_of(pieces.begin(), pieces.end(),
                    [&](std::string_view piece) { return piece.size() <= columns; }))
      break;
  }
  std::string result;
  std::size_t line = 0;
  for (std::string_view piece : pieces) {
    if (line > 0 && line + piece.size() > columns) {
      result += "\n    ";
      line = 4;
      piece.remove_prefix(std::min(piece.find_first_not_of(' '), piece.size()));
    }
    result += piece;
    line += piece.size();
  }
  return result;
}

std::string object_text(const Solid& solid) {
  std::string line = solid.type + " {";
  for (const std::string& attribute : solid.texts) line += " " + attribute;
  line += " }";
  if (line.size() <= most_columns) return line;
  std::string lines = solid.type + " {\n";
  for (const std::string& attribute : solid.texts)
    lines += "    " + indented_text(broken(attribute, most_columns - 4), 4) + "\n";
  return lines + "}";
}

/// Makes a word of scripts of a name of another language.
std::string word_of(const std::string& wish) {
  static constexpr std::array<std::string_view, 31> taken = {
      "scale", "translate", "rotate", "true",   "false",    "while",    "if",     "else",
      "for",   "in",        "t",      "import", "elif",     "return",   "as",     "id",
      "break", "matrix",    "shadow", "pi",     "sum",      "x",        "y",      "z",
      "vec3",  "rgb",       "rgba",   "srgb",   "material", "continue", "visible"};
  std::string word;
  bool begins = false;
  for (const char c : wish) {
    const bool is_digit = c >= '0' && c <= '9';
    const bool is_letter = text::small_letter(c) >= 'a' && text::small_letter(c) <= 'z';
    if (!is_letter && (!is_digit || word.empty())) {
      begins = !word.empty();
      continue;
    }
    const char small = text::small_letter(c);
    word += word.empty()                        ? small
            : begins && is_letter && c == small ? static_cast<char>(c - 'a' + 'A')
                                                : c;
    begins = false;
  }
  if (word.empty()) word = "solid";
  if (word.size() > 60) word.resize(60);
  if (std::find(taken.begin(), taken.end(), word) != taken.end()) word += "1";
  return word;
}

}  // namespace

std::string indented_text(const std::string& text, int columns) {
  std::string result;
  for (const char c : text) {
    result += c;
    if (c == '\n') result.append(static_cast<std::size_t>(columns), ' ');
  }
  return result;
}

std::string ScriptWriter::free_name(const std::string& wish) {
  std::string word = word_of(wish);
  if (names_.insert(word).second) return word;
  const std::string stem = word.back() >= '0' && word.back() <= '9' ? word + "x" : word;
  for (int& number = next_.try_emplace(stem, 1).first->second;;) {
    std::string name = stem + text::format("{}", ++number);
    if (names_.insert(name).second) return name;
  }
}

std::string ScriptWriter::material(const std::string& text, const std::string& wish) {
  const auto [place, is_new] = material_names_.try_emplace(text);
  if (is_new) {
    place->second = free_name(wish);
    materials_ += place->second + " = " + text + "\n";
  }
  return place->second;
}

std::string ScriptWriter::materials_of(std::string_view text) const {
  constexpr std::string_view word = "material ";
  std::set<std::string_view> used;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at)) {
    at += word.size();
    used.insert(text.substr(at, text.find_first_of(",>", at) - at));
  }
  std::string materials;
  for (std::size_t begin = 0; begin < materials_.size();) {
    const std::size_t end = materials_.find('\n', begin) + 1;
    const std::string_view line = std::string_view(materials_).substr(begin, end - begin);
    if (used.contains(line.substr(0, line.find(' ')))) materials += line;
    begin = end;
  }
  return materials;
}

int ScriptWriter::number_of(const SharedSolid& solid) {
  const auto found = numbers_of_solids_.find(solid.get());
  if (found != numbers_of_solids_.end()) return found->second;
  std::string key = text::format("{}{}{{", static_cast<int>(solid->kind), solid->type);
  for (const std::string& text : solid->texts) key += text + ";";
  for (const SharedSolid& part : solid->parts) key += text::format("{},", number_of(part));
  const auto [place, is_new] =
      numbers_.try_emplace(std::move(key), static_cast<int>(known_.size()));
  if (is_new) known_.emplace_back();
  numbers_of_solids_.emplace(solid.get(), place->second);
  return place->second;
}

void ScriptWriter::count(const SharedSolid& solid) {
  if (!solid) return;
  // What is counted a second time has its parts written once all the same.
  if (++known_.at(static_cast<std::size_t>(number_of(solid))).uses > 1) return;
  for (const SharedSolid& part : solid->parts) count(part);
}

std::string ScriptWriter::write(const SharedSolid& solid) {
  return solid ? expression(solid).text : "sum([])";
}

ScriptWriter::Written ScriptWriter::expression(const SharedSolid& solid) {
  const auto number = static_cast<std::size_t>(number_of(solid));
  if (!known_[number].name.empty()) return {known_[number].name};
  Written written = body(*solid);
  const bool is_worth_it = solid->kind != Solid::Kind::object || written.text.size() > worth_a_name;
  const bool is_again = known_[number].uses > 1 && is_worth_it;
  if (is_again || !solid->name.empty() || written.depth >= most_depth_of_expression)
    return named(*solid, written, known_[number]);
  return written;
}

ScriptWriter::Written ScriptWriter::named(const Solid& solid, const Written& written,
                                          Known& known) {
  std::string wish = solid.name;
  if (wish.empty()) wish = solid.kind == Solid::Kind::object ? solid.type : "solid";
  if (size() > most_bytes) throw Error(ErrorCode::limit, "the script would be too long");
  known.name = free_name(wish);
  definitions_ += known.name + " = " + written.text + "\n";
  return {known.name};
}

ScriptWriter::Written ScriptWriter::body(const Solid& solid) {
  switch (solid.kind) {
    case Solid::Kind::object:
      return {object_text(solid)};
    case Solid::Kind::sum:
      return combined(solid, "+");
    case Solid::Kind::difference:
      return combined(solid, "-");
    case Solid::Kind::intersection:
      return combined(solid, "^");
    case Solid::Kind::changed:
      break;
  }
  const Written part = expression(solid.parts.front());
  std::string modifiers;
  for (const std::string& modifier : solid.texts)
    modifiers += (modifiers.empty() ? "" : ", ") + modifier;
  const std::string inner = part.is_operand ? part.text : "(" + part.text + ")";
  return {inner + " <" + modifiers + ">", true, part.depth + 1};
}

ScriptWriter::Written ScriptWriter::combined(const Solid& solid, const char* sign) {
  std::vector<Written> parts;
  std::size_t columns = 0;
  bool is_short = true;
  int depth = 0;
  for (const SharedSolid& part : solid.parts) {
    parts.push_back(expression(part));
    columns += parts.back().text.size() + 3;
    is_short = is_short && is_one_line(parts.back().text);
    depth = std::max(depth, parts.back().depth + 1);
  }
  is_short = is_short && columns <= most_columns;
  if (*sign == '+' && !is_short) {
    std::string text = "sum([\n";
    for (const Written& part : parts)
      text += "    " + indented_text(part.text, 4) + (&part == &parts.back() ? "\n" : ",\n");
    return {text + "])", true, depth};
  }
  // What is cut off may be many things, which are listed as one.
  if (*sign == '-' && parts.size() > 8) {
    std::string list;
    for (std::size_t part = 1; part < parts.size(); ++part)
      list +=
          "    " + indented_text(parts[part].text, 4) + (part + 1 < parts.size() ? ",\n" : "\n");
    const Written& from = parts.front();
    return {from.text + " - sum([\n" + list + "])", false, depth};
  }
  std::string text = parts.front().text;
  for (std::size_t place = 1; place < parts.size(); ++place) {
    const Written& part = parts[place];
    const std::string operand = part.is_operand ? part.text : "(" + part.text + ")";
    text += is_short ? " " : "\n    ";
    text += std::string(sign) + " " + (is_short ? operand : indented_text(operand, 4));
  }
  return {text, false, depth};
}

}  // namespace crt::importing
