// The tokens of a scene as they come once directives have been followed: loops, conditions, macros
// and included files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "import/import.hpp"
#include "import/pov_value.hpp"

namespace crt::importing {

class PovStream {
 public:
  PovStream(Notes& notes, const ImportOptions& options) : notes_(notes), options_(options) {}
  virtual ~PovStream() = default;
  PovStream(const PovStream&) = delete;
  PovStream& operator=(const PovStream&) = delete;

 protected:
  using Tokens = std::shared_ptr<const std::vector<PovToken>>;

  /// Opens the text of a file. Throws Failure.
  void open(const std::string& name, std::string text);

  /// Returns the next token, without taking it. Directives before it are followed.
  const PovToken& peek();
  PovToken take();
  bool take_sign(std::string_view sign);
  bool take_word(std::string_view word);
  void expect(std::string_view sign, std::string_view where);
  /// Returns the token behind the next one, if it stands in the same piece of text.
  const PovToken* behind() const;
  /// Skips what stands in braces, with those.
  void skip_braces();

  [[noreturn]] void fail(const std::string& message);
  Place place() { return peek().place; }

  PovValue* find(const std::string& name);
  void set(const std::string& name, PovValue value, bool is_local);
  Notes& notes() { return notes_; }
  const ImportOptions& options() const { return options_; }
  /// Counts a step of the evaluation. Throws Failure if there are too many.
  void count(std::uint64_t steps = 1);

  // What directives need of the language.
  virtual double float_expression() = 0;
  /// Reads anything that may be declared.
  virtual PovValue declared_value(const std::string& name) = 0;
  virtual std::string text_expression() = 0;
  virtual void default_texture() = 0;

  /// Directives of the text so deep wait until an expression there is read.
  std::size_t hold_ = 0;
  bool no_compare_ = true;  ///< comparisons stand in brackets and conditions alone
  double version_ = 0;

 private:
  /// An Open is a directive whose #end is to come, and what that does.
  struct Open {
    enum class Kind { condition, choice, loop };
    Kind kind = Kind::condition;
    std::function<void()> ends{};
  };

  /// A Frame is a piece of text that is read: a file, or a macro with its own names.
  struct Frame {
    Tokens tokens;
    std::size_t at = 0;
    std::size_t end = 0;
    bool is_macro = false;
    std::vector<Open> open{};
    std::map<std::string, PovValue, std::less<>> names{};
  };

  /// Reads the text of a directive, and no token behind it.
  std::string text_of_directive();
  /// Puts back a token that was looked at.
  void give_back();
  const PovToken* raw() const;
  PovToken take_raw(const char* what);
  void follow(const PovToken& directive);
  void follow_condition(bool is_true);
  void follow_while();
  void follow_for();
  void follow_switch();
  void follow_macro();
  void follow_include(const Place& place);
  void follow_declare(bool is_local);
  void follow_end(const Place& place);
  void follow_break();
  bool is_defined();
  bool call_macro(const PovToken& name);
  void skip_to_end(bool stops_at_else);
  void next_round(const std::string& name, double last, double step, std::size_t body);
  void open_if(Open open) { frame().open.push_back(std::move(open)); }
  double condition();
  Frame& frame() { return frames_.back(); }

  Notes& notes_;
  const ImportOptions& options_;
  std::vector<Frame> frames_;
  std::map<std::string, PovValue, std::less<>> globals_;
  std::map<std::string, Tokens, std::less<>> files_;
  std::filesystem::path folder_;
  PovToken next_{};
  bool has_next_ = false;
  std::uint64_t steps_ = 0;
};

}  // namespace crt::importing
