#include "service/reference.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "text/format.hpp"

namespace crt::service {

namespace {

/// Returns the cells of a table's row, `| a | b \| c |`, without the blanks around them.
std::vector<std::string> cells_of(std::string_view row) {
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < row.size(); ++i) {
    if (row[i] == '\\' && i + 1 < row.size() && row[i + 1] == '|') continue;
    if (row[i] != '|' || row[i - 1] == '\\') {
      cell += row[i];
      continue;
    }
    const std::size_t begin = cell.find_first_not_of(' ');
    const std::size_t end = cell.find_last_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, end - begin + 1));
    cell.clear();
  }
  return cells;
}

std::string_view without_blanks_before(std::string_view line) {
  return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

/// Replaces links by their texts, as they lead nowhere in an editor.
std::string without_links(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t middle = text[i] == '[' ? text.find("](", i) : std::string_view::npos;
    const std::size_t end = middle == std::string_view::npos ? middle : text.find(')', middle);
    const bool is_link = end != std::string_view::npos &&
                         text.substr(i + 1, middle - i - 1).find('[') == std::string_view::npos;
    if (is_link) {
      result += text.substr(i + 1, middle - i - 1);
      i = end;
    } else {
      result += text[i];
    }
  }
  return result;
}

/// Returns what stands in backticks in a text, each piece.
std::vector<std::string_view> code_in(std::string_view text) {
  std::vector<std::string_view> pieces;
  for (std::size_t open = text.find('`'); open != std::string_view::npos;) {
    const std::size_t close = text.find('`', open + 1);
    if (close == std::string_view::npos) break;
    pieces.push_back(text.substr(open + 1, close - open - 1));
    open = text.find('`', close + 1);
  }
  return pieces;
}

/// Returns the word that a text begins with.
std::string first_word(std::string_view text) {
  const auto is_word = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  return std::string(text.begin(), std::find_if_not(text.begin(), text.end(), is_word));
}

void add_paragraph(std::string& text, const std::string& paragraph) {
  if (!text.empty()) text += "\n\n";
  text += paragraph;
}

bool names_in_code(std::string_view text, std::string_view name) {
  return text.find(text::format("`{}`", name)) != std::string_view::npos;
}

/// Returns the sentences of a text that speak of a name.
std::string sentences_about(std::string_view text, std::string_view name) {
  std::string result;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(". "), text.size() - 1) + 1;
    const std::string_view sentence = text.substr(0, end);
    if (names_in_code(sentence, name)) {
      if (!result.empty()) result += ' ';
      result += sentence;
    }
    text.remove_prefix(std::min(text.find_first_not_of(' ', end), text.size()));
  }
  return result;
}

}  // namespace

/// Reads the page line by line, as paragraphs and rows of tables under headings.
class Reference::Reader {
 public:
  explicit Reader(Reference& reference) : reference_(reference) {}

  void read(std::string_view markdown) {
    while (!markdown.empty()) {
      const std::size_t end = std::min(markdown.find('\n'), markdown.size());
      read_line(markdown.substr(0, end));
      markdown.remove_prefix(std::min(end + 1, markdown.size()));
    }
    end_paragraph();
    complete();
  }

 private:
  void read_line(std::string_view line) {
    if (line.starts_with("```")) {
      end_paragraph();
      in_code_ = !in_code_;
    } else if (in_code_) {
      return;
    } else if (line.starts_with('#')) {
      end_paragraph();
      begin_section(line);
    } else if (const std::string_view row = without_blanks_before(line); row.starts_with('|')) {
      end_paragraph();
      read_row(row);
    } else if (line.empty()) {
      end_paragraph();
      table_.clear();
    } else {
      if (line.starts_with("- ")) end_paragraph();
      if (!paragraph_.empty()) paragraph_ += ' ';
      paragraph_ += without_blanks_before(line);
    }
  }

  void begin_section(std::string_view line) {
    const std::size_t level = line.find_first_not_of('#');
    section_ = line.substr(std::min(level + 1, line.size()));
    if (level <= group_level) group_ = section_;
    table_.clear();
    group_of_[section_] = group_;
  }

  void read_row(std::string_view line) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() < 3 || cells[0].starts_with("---")) return;
    if (table_.empty()) {
      table_ = cells[0];
      if (table_ == "attribute") sections_.insert(section_);
      return;
    }
    const std::vector<std::string_view> code = code_in(cells[0]);
    if (table_ == "attribute" && cells.size() == 4 && !code.empty()) {
      reference_.attributes_[{section_, std::string(code[0])}] = without_links(cells[3]);
    } else if (table_ == "function") {
      for (const std::string_view call : code)
        reference_.words_[first_word(call)] =
            text::format("{}: {}\n\n{}", cells[0], without_links(cells[1]), cells[2]);
    } else if (table_ == "statement" && !code.empty()) {
      reference_.words_[first_word(code[0])] =
          text::format("`{}`: {}", code[0], without_links(cells[2]));
    } else if (table_ == "modifier" && !code.empty()) {
      reference_.words_[first_word(code[0])] =
          text::format("`<{}>` with {}: {}", code[0], without_links(cells[1]), cells[2]);
    }
  }

  void end_paragraph() {
    if (paragraph_.empty()) return;
    paragraphs_[section_].push_back(without_links(paragraph_));
    paragraph_.clear();
  }

  /// Brings paragraphs to what they are about, when all has been read.
  void complete() {
    for (const std::string& section : sections_) {
      for (const std::string& paragraph : paragraphs_[section]) {
        if (!paragraph.starts_with("- **`")) add_paragraph(reference_.objects_[section], paragraph);
      }
    }
    for (auto& [key, text] : reference_.attributes_) complete_attribute(key, text);
    // These are explained in paragraphs, which begin so.
    const std::array beginnings = {
        std::pair{"Expressions", "- **Modifiers** are"},
        std::pair{"Built-ins", "Constants are"},
    };
    for (const auto& [section, beginning] : beginnings) {
      for (const std::string& paragraph : paragraphs_[section]) {
        if (!paragraph.starts_with(beginning)) continue;
        for (const std::string_view name : code_in(paragraph))
          reference_.words_.emplace(first_word(name), without_dash(paragraph));
      }
    }
    for (const std::string& paragraph : paragraphs_["Variables, scopes and macros"]) {
      if (paragraph.starts_with("A **macro** is")) reference_.words_["Macro"] = paragraph;
    }
    reference_.words_["else"] = reference_.words_["if"];
    reference_.words_["elif"] = reference_.words_["if"];
    reference_.words_["in"] = reference_.words_["for"];
  }

  void complete_attribute(const std::pair<std::string, std::string>& key, std::string& text) {
    const auto& [section, name] = key;
    for (const std::string& paragraph : paragraphs_[section]) {
      const bool is_note = paragraph.starts_with("- **`");
      if (is_note && names_in_code(paragraph.substr(0, paragraph.find("**", 4)), name))
        add_paragraph(text, without_dash(paragraph));
    }
    if (!text.empty()) return;
    for (const std::string& paragraph : paragraphs_[group_of_[section]]) {
      const std::string about = sentences_about(without_dash(paragraph), name);
      if (!about.empty()) add_paragraph(text, about);
    }
  }

  static std::string without_dash(const std::string& paragraph) {
    return paragraph.starts_with("- ") ? paragraph.substr(2) : paragraph;
  }

  /// Sections of this level and above hold what their subsections have in common.
  static constexpr std::size_t group_level = 3;

  Reference& reference_;
  bool in_code_ = false;
  std::string section_;
  std::string group_;
  std::string table_;  ///< the first cell of the table's head
  std::string paragraph_;
  std::set<std::string> sections_;  ///< those with a table of attributes
  std::map<std::string, std::string> group_of_;
  std::map<std::string, std::vector<std::string>> paragraphs_;
};

Reference::Reference(std::string_view markdown) {
  Reader(*this).read(markdown);
}

std::string Reference::object(std::string_view name) const {
  const auto found = objects_.find(name);
  return found == objects_.end() ? std::string() : found->second;
}

std::string Reference::attribute(std::string_view object, std::string_view name) const {
  const auto found = attributes_.find({std::string(object), std::string(name)});
  return found == attributes_.end() ? std::string() : found->second;
}

std::string Reference::word(std::string_view name) const {
  const auto found = words_.find(name);
  return found == words_.end() ? std::string() : found->second;
}

}  // namespace crt::service
