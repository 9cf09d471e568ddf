// This file runs a script from its text to a Scene.
#include <algorithm>
#include <charconv>
#include <deque>
#include <map>
#include <new>
#include <set>
#include <system_error>
#include <utility>

#include "crt/script.hpp"
#include "lang/check.hpp"
#include "lang/compat.hpp"
#include "lang/context.hpp"
#include "lang/interpreter.hpp"
#include "lang/library.hpp"
#include "lang/name_uses.hpp"
#include "lang/parser.hpp"
#include "lang/run_parsed.hpp"
#include "lang/settings.hpp"
#include "lang/suggestion.hpp"
#include "lang/utf8.hpp"
#include "text/format.hpp"

namespace crt {

namespace lang {

namespace {

namespace fs = std::filesystem;

fs::path without_links(const fs::path& path) {
  std::error_code failed;
  const fs::path canonical = fs::canonical(path, failed);
  return failed ? path.lexically_normal() : canonical;
}

class Session {
 public:
  /// `parsed` is null if the script is to be parsed.
  Session(const ScriptOptions& options, const ParsedScript* parsed)
      : options_(options),
        parsed_(parsed),
        symbols_(parsed ? parsed->symbols : SymbolTable()),
        reporter_(sources_, std::max<std::size_t>(options.limits.errors, 1)),
        context_(options, symbols_, sources_, reporter_),
        memory_left_(options.limits.memory_bytes),
        interpreter_(context_) {
    interpreter_.set_importer([this](const Import& import) { run_import(import); });
  }

  /// Does what run_script() does, without its last catch clauses.
  void run(std::string_view text, const std::string& name, ScriptResult& result);

  std::vector<Diagnostic>& diagnostics() { return reporter_.diagnostics(); }

 private:
  int compat_of(const Source& source);
  std::optional<Unit> unit_of(const Source& source);
  const Script* load(const Source& source, TextKind kind);
  const Script* checked(Script& script);
  void run_main(const Source& source, const Script& script, ScriptResult& result);
  void run_import(const Import& import);
  void run_library(const Import& import);
  template <class AddSource>
  void run_once(const Import& import, const std::string& key, const AddSource& add_source);
  const Script& load_imported(const Source& source, bool sets_here);
  std::size_t bytes_left() const;
  void take_variables();
  void take_settings();
  bool evaluate_override(std::string_view option,
                         const std::pair<std::string, std::string>& setting, Given& given);
  void refuse_unknown_variables();
  std::vector<Given> all_settings();

  const ScriptOptions& options_;
  const ParsedScript* parsed_;
  SourceMap sources_;
  SymbolTable symbols_;
  Reporter reporter_;
  Context context_;
  std::size_t memory_left_;
  std::deque<Script> scripts_;
  Interpreter interpreter_;
  fs::path main_directory_;
  std::vector<std::pair<fs::path, std::string>>
      running_;  ///< the script and the imports within one another
  /// Says which scripts were imported into which top level.
  std::set<std::pair<int, std::string>> imported_;
  std::map<std::string, Value> imported_apart_;  ///< what those with a name have set
  std::set<Symbol> assigned_;                    ///< names set at the top level of any script
  NameUses name_uses_;                           ///< of the text that was loaded last
  std::set<Symbol> read_by_imports_;             ///< names that imported scripts read
  bool reads_time_ = false;                      ///< whether any text that was loaded does
  std::vector<std::pair<Symbol, Span>> variables_;
  std::vector<Given> overrides_;
};

/// Returns which year's script this is. That decides how it is read, and is known before. The check
/// of the settings reports a number that is no such year later.
int Session::compat_of(const Source& source) {
  if (options_.compat != 0 && options_.compat != compat_2015)
    reporter_.error({}, text::format("ScriptOptions::compat must be 0 or {}", compat_2015),
                    ErrorCode::invalid_argument);
  if (options_.compat != 0) return options_.compat;
  std::int64_t number = 0;
  const auto setting = std::find_if(options_.settings.rbegin(), options_.settings.rend(),
                                    [](const auto& given) { return given.first == "compat"; });
  if (setting == options_.settings.rend()) {
    number = written_compat(sources_, source);
  } else {
    const std::string& text = setting->second;
    std::from_chars(text.data(), text.data() + text.size(), number);
  }
  return number == compat_2015 ? compat_2015 : 0;
}

/// Returns the unit of the scene, if it is known before anything runs.
std::optional<Unit> Session::unit_of(const Source& source) {
  const auto setting = std::find_if(options_.settings.rbegin(), options_.settings.rend(),
                                    [](const auto& given) { return given.first == "unit"; });
  if (setting == options_.settings.rend()) return written_unit(sources_, source);
  const std::string_view text = setting->second;
  const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
  return is_quoted ? unit_of_name(text.substr(1, text.size() - 2)) : std::nullopt;
}

/// Parses and checks a text. Returns null after an error.
const Script* Session::load(const Source& source, TextKind kind) {
  Script& script = scripts_.emplace_back(
      parse(source, kind, context_.compat, symbols_, reporter_, memory_left_));
  return reporter_.has_errors() ? nullptr : checked(script);
}

/// Returns null after an error.
const Script* Session::checked(Script& script) {
  check(script, context_.compat, symbols_, reporter_);
  name_uses_ = find_name_uses(script, symbols_, reporter_);
  reads_time_ = reads_time_ || name_uses_.reads_time;
  return reporter_.has_errors() ? nullptr : &script;
}

void Session::run(std::string_view text, const std::string& name, ScriptResult& result) {
  if (text.size() > context_.limits.source_bytes) {
    sources_.add(name, {});
    reporter_.error(
        {}, text::format("the script is longer than {} bytes", context_.limits.source_bytes),
        ErrorCode::limit);
    return;
  }
  main_directory_ = fs::path(name).parent_path();
  context_.files.set_script_directory(main_directory_);
  const Source& source = sources_.add(name, std::string(text), main_directory_);
  running_.emplace_back(without_links(name), name);
  context_.compat = compat_of(source);
  context_.unit = unit_of(source);
  const bool is_parsed = parsed_ && parsed_->compat == context_.compat;
  const Script* script = is_parsed ? checked(parsed_->script) : load(source, TextKind::script);
  if (script) run_main(source, *script, result);
}

/// Turns spans into places in the main script.
std::vector<EntityPlace> places_of_entities(const Source& main,
                                            const std::vector<std::pair<Span, Span>>& spans) {
  const auto in_main = [&](Span span) {
    return TextSpan{span.begin - main.base, span.end - main.base};
  };
  std::vector<EntityPlace> places;
  places.reserve(spans.size());
  for (const auto& [statement, origin] : spans) {
    const bool is_in_main = origin.begin >= main.base && origin.end <= main.base + main.text.size();
    places.push_back({in_main(statement), in_main(is_in_main ? origin : statement)});
  }
  return places;
}

void Session::run_main(const Source& source, const Script& script, ScriptResult& result) {
  const NameUses name_uses = std::move(name_uses_);
  interpreter_.set_name_uses(name_uses);
  take_variables();
  take_settings();
  collect_assigned(script.statements, assigned_);
  interpreter_.run(script, false);
  refuse_unknown_variables();
  const auto& statements = script.statements.statements;
  const bool has_scene =
      std::any_of(statements.begin(), statements.end(), [](const Statement& statement) {
        return std::holds_alternative<SceneBlock>(statement.node);
      });
  const Span start{source.base, source.base};
  const auto end = static_cast<std::uint32_t>(source.base + source.text.size());
  if (!has_scene) reporter_.error({end, end}, "the script has no Scene block");
  Scene scene;
  try {
    apply_settings(context_, interpreter_.settings_span().value_or(start), all_settings(), scene);
  } catch (const Failure& failure) {
    reporter_.error(failure);
  }
  if (reporter_.has_errors()) return;
  // Scripts of 2015 are what they are.
  if (context_.compat != compat_2015) {
    interpreter_.warn_of_idle_materials();
    warn_of_shadowed_names(name_uses, assigned_, symbols_, reporter_);
    warn_of_unused_names(name_uses, read_by_imports_, symbols_, reporter_);
  }
  result.reads_time = reads_time_;
  scene.entities = std::move(interpreter_.entities());
  result.entity_places = places_of_entities(source, interpreter_.entity_spans());
  result.scene = std::move(scene);
}

// ---- imports ------------------------------------------------------------------------------------

void Session::run_import(const Import& import) {
  if (is_library_path(import.path)) return run_library(import);
  const Span span = import.path_span;
  const Files::Found found =
      context_.files.find(import.path, sources_.source_of(span).directory, span);
  const std::string name = found.shown.string();
  const auto cycle = std::find_if(running_.begin(), running_.end(),
                                  [&](const auto& running) { return running.first == found.path; });
  if (cycle != running_.end()) {
    std::string chain;
    for (auto script = cycle; script != running_.end(); ++script)
      chain += printable(script->second) + " imports ";
    throw Failure{
        .span = span,
        .message = text::format("scripts import one another: {}{}", chain, printable(name))};
  }
  const std::size_t depth = running_.size();
  run_once(import, found.path.string(), [&]() -> const Source& {
    const Source& source = sources_.add(name, context_.files.read_text(found, bytes_left(), span),
                                        found.shown.parent_path());
    running_.emplace_back(found.path, name);
    return source;
  });
  running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(depth), running_.end());
}

/// Imports a script that comes with CRT. These import nothing.
void Session::run_library(const Import& import) {
  const std::string_view text = find_library(import.path, import.path_span);
  // No path of a file has a name without a folder.
  run_once(import, std::string(library_name(import.path)), [&]() -> const Source& {
    if (text.size() > bytes_left())
      throw Failure{.span = import.path_span,
                    .message = text::format("'{}' is too long", printable(import.path)),
                    .code = ErrorCode::limit};
    return sources_.add(import.path, std::string(text));
  });
}

/// Runs a script that is imported, once for each top level that it is imported into, and once for
/// all imports that have a name. The names of these are set to the same dictionary.
template <class AddSource>
void Session::run_once(const Import& import, const std::string& key, const AddSource& add_source) {
  if (!import.name) {
    if (imported_.emplace(interpreter_.top_level(), key).second)
      interpreter_.run(load_imported(add_source(), true), true);
    return;
  }
  auto known = imported_apart_.find(key);
  if (known == imported_apart_.end()) {
    Value members = interpreter_.run_apart(load_imported(add_source(), false), import.path_span);
    known = imported_apart_.emplace(key, std::move(members)).first;
  }
  interpreter_.set_variable(import.name->symbol, known->second);
}

/// Parses a script that is imported. `sets_here` says whether its variables are those of the
/// script that imports it.
const Script& Session::load_imported(const Source& source, bool sets_here) {
  const Script* script = load(source, TextKind::script);
  // Without these definitions the rest would only give false errors.
  if (!script) throw GiveUp{};
  for (const auto& [name, places] : name_uses_.reads) read_by_imports_.insert(name);
  if (sets_here) collect_assigned(script->statements, assigned_);
  return *script;
}

std::size_t Session::bytes_left() const {
  return context_.limits.source_bytes - std::min(context_.limits.source_bytes, sources_.size());
}

// ---- what is set from outside -------------------------------------------------------------------

/// Evaluates the expression of an option such as <set n>. Returns false after an error.
bool Session::evaluate_override(std::string_view option,
                                const std::pair<std::string, std::string>& setting, Given& given) {
  const auto& [name, text] = setting;
  if (text.size() > bytes_left()) {
    reporter_.error({}, text::format("<{} {}> is too long", option, printable(name)),
                    ErrorCode::limit);
    return false;
  }
  const Source& source = sources_.add(text::format("<{} {}>", option, name), text, main_directory_);
  given.name_span =
      given.value_span = {source.base, source.base + static_cast<std::uint32_t>(text.size())};
  const Script* script = load(source, TextKind::expression);
  if (!script) return false;
  given.value_span = script->expression->span;
  try {
    given.value = interpreter_.evaluate(*script->expression);
    if (!std::holds_alternative<Nothing>(given.value)) return true;
    reporter_.error(given.value_span, "this call has no value");
  } catch (const Failure& failure) {
    reporter_.error(failure);
    if (ends_script(failure)) throw GiveUp{};
  }
  return false;
}

void Session::take_variables() {
  std::vector<std::pair<Symbol, Value>> values;
  for (const auto& variable : options_.variables) {
    Given given;
    if (!evaluate_override("set", variable, given)) continue;
    const Symbol symbol = symbols_.intern(variable.first);
    values.emplace_back(symbol, std::move(given.value));
    variables_.emplace_back(symbol, given.name_span);
  }
  for (auto& [symbol, value] : values) interpreter_.override_variable(symbol, std::move(value));
}

void Session::take_settings() {
  const ObjectType& type = settings_type();
  for (const auto& setting : options_.settings) {
    Given given;
    if (!evaluate_override("setting", setting, given)) continue;
    const std::size_t index = find_attribute(type, setting.first);
    if (index < type.attributes.size()) {
      given.type = &type.attributes[index];
      std::erase_if(overrides_, [&](const Given& earlier) { return earlier.type == given.type; });
      overrides_.push_back(std::move(given));
      continue;
    }
    std::vector<std::string_view> names;
    for (const AttributeType& attribute : type.attributes) names.push_back(attribute.name);
    reporter_.error(given.name_span,
                    text::format("Settings has no attribute '{}'{}", printable(setting.first),
                                 did_you_mean(setting.first, names)));
  }
}

/// Reports variables that were set from outside and that no script ever sets, as these are
/// mistakes.
void Session::refuse_unknown_variables() {
  std::vector<std::string_view> names;
  for (const Symbol symbol : assigned_) names.push_back(symbols_.name(symbol));
  for (const auto& [symbol, span] : variables_) {
    if (assigned_.contains(symbol)) continue;
    const std::string_view name = symbols_.name(symbol);
    const std::string path = library_path_of(name);
    const std::string hint =
        path.empty() ? did_you_mean(name, names)
                     : text::format("; '{}' is in \"{}\", which it does not import", name, path);
    reporter_.error(span, text::format("the script sets no variable '{}' at its top level{}",
                                       printable(name), hint));
  }
}

std::vector<Given> Session::all_settings() {
  std::vector<Given> settings = std::move(interpreter_.settings());
  std::erase_if(settings, [this](const Given& given) {
    return std::any_of(overrides_.begin(), overrides_.end(), [&](const Given& override_given) {
      return override_given.type == given.type;
    });
  });
  settings.insert(settings.end(), overrides_.begin(), overrides_.end());
  return settings;
}

Diagnostic unplaced(const std::string& file, std::string message, ErrorCode code) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  diagnostic.message = std::move(message);
  diagnostic.place.file = file;
  return diagnostic;
}

ScriptResult run(std::string_view text, const std::string& name, const ScriptOptions& options,
                 const ParsedScript* parsed) {
  ScriptResult result;
  try {
    Session session(options, parsed);
    try {
      session.run(text, name, result);
    } catch (const GiveUp&) {
      // Everything was reported already.
    }
    result.diagnostics = std::move(session.diagnostics());
  } catch (const std::bad_alloc&) {
    result.scene.reset();
    result.diagnostics.push_back(unplaced(name, "out of memory", ErrorCode::out_of_memory));
  }
  return result;
}

}  // namespace

ScriptResult run_parsed(std::string_view text, const std::string& name,
                        const ScriptOptions& options, const ParsedScript& parsed) {
  return run(text, name, options, &parsed);
}

}  // namespace lang

ScriptResult run_script(std::string_view text, const std::string& name,
                        const ScriptOptions& options) {
  return lang::run(text, name, options, nullptr);
}

ScriptResult run_script_file(const std::filesystem::path& path, const ScriptOptions& options) {
  const std::string name = path.string();
  ScriptResult result;
  std::optional<std::string> text;
  if (options.open_file) {
    if (const auto content = options.open_file(path))
      text.emplace(reinterpret_cast<const char*>(content->data()), content->size());
  }
  const std::size_t most_bytes = std::min(options.limits.source_bytes, lang::SourceMap::most_bytes);
  if (!text) text = lang::read_regular_file(path, most_bytes);
  if (text) return run_script(*text, name, options);
  std::error_code failed;
  const bool exists = std::filesystem::exists(path, failed);
  const bool regular = std::filesystem::is_regular_file(path, failed);
  const bool too_long = regular && std::filesystem::file_size(path, failed) > most_bytes && !failed;
  if (too_long) {
    result.diagnostics.push_back(lang::unplaced(
        name, text::format("the script is longer than {} bytes", most_bytes), ErrorCode::limit));
    return result;
  }
  const char* reason = !exists   ? "there is no such file"
                       : regular ? "it cannot be read"
                                 : "it is not a regular file";
  result.diagnostics.push_back(
      lang::unplaced(name, text::format("cannot read the script: {}", reason), ErrorCode::io));
  return result;
}

}  // namespace crt
