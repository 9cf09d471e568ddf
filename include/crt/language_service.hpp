// This header tells editors about scripts while they are written: what each token is, the tree with
// its places, what names mean, what may come at a place, what is wrong. A text need not be whole.
// All places are bytes of the text, which crt/text_places.hpp translates. It belongs to the library
// crt::service.
#pragma once

#include <crt/script.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crt {

/// Says what a token is, by what the front end makes of it.
enum class TokenKind : std::uint32_t {
  comment,
  string,
  number,
  keyword,
  object,
  attribute,
  variable,
  parameter,
  function,
};

/// A ScriptToken is a piece of a script with what it is. Signs are no tokens here.
struct ScriptToken {
  TextSpan span{};
  TokenKind kind = TokenKind::comment;
};

/// Says what is offered to complete a text.
enum class CompletionKind { attribute, object, variable, macro, function, constant, keyword };

/// A Completion is one of the things that may stand at a place.
struct Completion {
  CompletionKind kind = CompletionKind::variable;
  std::string label{};
  std::string detail{};
  std::string documentation{};  ///< in Markdown
  std::string text{};           ///< what is put in
  std::string snippet{};        ///< the same with places to fill in ($1, ..., $0), or empty
  int rank = 0;                 ///< lower ones are shown first
};

/// A CompletionList is all that may stand at a place.
struct CompletionList {
  std::vector<Completion> items{};
  /// The piece of the text that an item replaces: the word at the place.
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
};

/// A ScriptHover is what to show about the word at a place.
struct ScriptHover {
  std::string markdown{};
  TextSpan span{};
};

/// A ScriptFile is the main script or one that it imports, with the text that was read.
struct ScriptFile {
  std::string name{};  ///< as in a ScriptLocation and in the place of a Diagnostic
  std::string_view text{};
};

/// A ScriptLocation is a piece of the main script or of a script that it imports.
struct ScriptLocation {
  std::string file{};  ///< the main script's is the name that it was given
  TextSpan span{};
};

/// Says what a name is.
enum class SymbolKind { variable, macro, parameter, loop_variable };

/// A ScriptSymbol is a name that the main script sets.
struct ScriptSymbol {
  std::string name{};
  SymbolKind kind = SymbolKind::variable;
  TextSpan definition{};         ///< where it is set first
  std::vector<TextSpan> uses{};  ///< all its places in the main script, in their order
};

/// Says what the value of an attribute is as text. A value of kind `none` is computed.
enum class LiteralKind { none, number, boolean, string, vector, color };

/// A ScriptAttribute is an attribute with its value, as they stand in a script.
struct ScriptAttribute {
  std::string name{};
  TextSpan name_span{};
  TextSpan value_span{};
  LiteralKind literal = LiteralKind::none;
  /// Has the number, 1 or 0 for a Boolean, the 3 numbers of `vec3` and `rgb` or the 4 of `rgba`.
  std::vector<double> numbers{};
  std::string text{};  ///< what a string says
  /// Says for a value that is no literal what it is: "the variable 'wood'".
  std::string reason{};
  /// Has the value as it is written, shortened to a line. Only inherited attributes have it, whose
  /// spans are empty.
  std::string written{};
};

/// Says what a node of the tree is.
enum class NodeKind {
  settings,     ///< the Settings block
  scene,        ///< the Scene block
  import,       ///< named by its path
  assignment,   ///< named by its variable
  macro,        ///< its name is that of the assignment above it
  object,       ///< named by its type, with attributes; so are derived materials
  combination,  ///< of entities; its name is the first of the operators
  placed,       ///< what has modifiers; its name is theirs
  call,         ///< of a macro
  name,         ///< of a variable that stands for an entity
  list,
  loop,
  choice,
};

/// A ScriptNode is a statement or a value that says what is in the scene, or an object. What is
/// computed beside, such as numbers, is not in the tree.
struct ScriptNode {
  NodeKind kind = NodeKind::object;
  std::string name{};
  TextSpan span{};
  TextSpan name_span{};
  /// Is the place in the list of the node around it, or `no_parent`.
  std::size_t parent = no_parent;
  std::vector<ScriptAttribute> attributes{};
  /// Names the variable whose copy a derived material is. Of others it is empty. If it is not known
  /// which type of material the variable has, the node has its name.
  std::string base{};
  /// Lists the attributes that a derived material has from there, and not from `attributes`.
  std::vector<ScriptAttribute> inherited{};

  static constexpr std::size_t no_parent = static_cast<std::size_t>(-1);
};

/// An AttributeDescription says what an attribute of an object takes.
struct AttributeDescription {
  std::string name{};
  std::string type{};  ///< as the reference names it: "Float"
  bool required = false;
  std::string default_text{};
  std::string documentation{};         ///< in Markdown
  std::vector<std::string> choices{};  ///< the words that it takes, if it takes only some
};

/// An ObjectDescription says which attributes an object has.
struct ObjectDescription {
  std::string name{};
  std::vector<AttributeDescription> attributes{};
};

/// Describes all objects of the language, and Settings last.
std::vector<ObjectDescription> describe_objects();

/// A FormattedScript is a script as the formatter lays it out, or what is wrong with it.
struct FormattedScript {
  /// Is absent if the script has syntax errors. Formatting it again gives the same.
  std::optional<std::string> text{};
  std::vector<Diagnostic> diagnostics{};
};

/// Lays a script out. `name` stands for it in messages. It throws nothing for what a script holds.
FormattedScript format_script(std::string_view text, const std::string& name);

/// A LanguageService knows one version of one script. It never changes, and any number of threads
/// may ask it. The files that it imports are read when it is made.
class LanguageService {
 public:
  /// Takes a script. `name` is its path, or anything if it has none. `options` say how its files
  /// are found; limits are lowered to what takes well under a second. Throws only what callbacks
  /// throw, and std::bad_alloc.
  LanguageService(const std::string& text, const std::string& name,
                  const ScriptOptions& options = {});
  ~LanguageService();
  /// Takes what the other knows, which is then good for nothing but being destroyed.
  LanguageService(LanguageService&&) noexcept;
  LanguageService(const LanguageService&) = delete;
  LanguageService& operator=(const LanguageService&) = delete;

  /// Lists the main script and then those that it imports. The texts last as long as the service.
  /// A script that comes with CRT has the name that it is imported by, such as "crt/metals".
  std::vector<ScriptFile> files() const;
  /// Says whether the script or one that it imports is in this file, by any path of it. If so, a
  /// change of the file needs another service.
  bool has_file(const std::filesystem::path& path) const;

  /// Lists the tokens and comments in their order.
  std::vector<ScriptToken> tokens() const;
  /// Lists the nodes of the tree. Each comes behind the node around it.
  std::vector<ScriptNode> tree() const;
  /// Lists the names that the main script sets, in the order of their definitions.
  std::vector<ScriptSymbol> symbols() const;
  /// Returns where the name at a byte is set, or the file that is imported there.
  std::optional<ScriptLocation> definition(std::uint32_t byte) const;
  /// Lists all places of the name at a byte, in all scripts.
  std::vector<ScriptLocation> places(std::uint32_t byte) const;
  /// Returns the name at a byte, in the main script, if rename() may change it.
  std::optional<TextSpan> renamable_name(std::uint32_t byte) const;
  /// Lists the places, in all scripts, that must get a new name for the name at a byte. `others`
  /// know other scripts that an editor has open. Those that import the script in which the name is
  /// set are changed as well. Throws Error (invalid_argument) if the new name is none, if any name
  /// would mean something else by it, if a script that it stands in has syntax errors, or if the
  /// others were made of another text of the script. Nothing else is wrong with the result of
  /// putting the new name in.
  std::vector<ScriptLocation> rename(std::uint32_t byte, const std::string& new_name,
                                     const std::vector<const LanguageService*>& others = {}) const;
  /// Returns what may come at a byte.
  CompletionList complete(std::uint32_t byte) const;
  /// Returns what to show about the word at a byte, if there is anything.
  std::optional<ScriptHover> hover(std::uint32_t byte) const;
  /// Runs the script, once, within low limits and without reading pictures and meshes, and returns
  /// what is wrong. What only a low limit ends is no error. A script without Scene and Settings is
  /// one to import. The file of a diagnostic's place is one of files().
  std::vector<Diagnostic> diagnostics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace crt
