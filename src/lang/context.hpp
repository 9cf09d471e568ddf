// The context holds what a running script uses: its limits, memory, files, random numbers and log.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "crt/script.hpp"
#include "lang/files.hpp"
#include "lang/random.hpp"
#include "lang/reporter.hpp"
#include "lang/symbol.hpp"
#include "lang/value.hpp"

namespace crt::lang {

/// Work that copies or compares is paid for in steps, so that no step takes long.
constexpr std::size_t items_per_step = 16;
/// Copying what is shared counts its users, and takes as long as so many plain items.
constexpr std::size_t items_of_shared = 8;
constexpr std::size_t bytes_per_step = 64;

/// An entity takes about as long to make as so many expressions to evaluate.
constexpr std::size_t steps_per_entity = 16;

/// Lists and dictionaries within one another are at most this deep, as freeing them takes stack.
constexpr int deepest_list = 100;

class Context {
 public:
  Context(const ScriptOptions& options, SymbolTable& symbols, SourceMap& sources,
          Reporter& reporter);
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const ScriptOptions& options;
  /// These are the caller's limits, cut to what this implementation can bear.
  const ScriptLimits limits;
  SymbolTable& symbols;
  SourceMap& sources;
  Reporter& reporter;
  Files files;
  /// This is the value of the options, or else of the running script's Settings.
  int compat = 0;
  /// This is the unit of the scene, as far as it is known before its Settings have run.
  std::optional<Unit> unit;
  Random random;
  Random2015 random_2015;
  /// Calls a macro or a built-in, under a name for messages. The interpreter sets it.
  std::function<Value(std::string_view name, Span call, const Value& callee,
                      std::span<const Value> arguments)>
      call;

  /// Counts an expression evaluated at `span`. This is the hot path.
  void step(Span span) {
    if (++steps_ > next_pause_) [[unlikely]]
      pause(span);
  }
  void spend(Span span, std::size_t steps);
  /// Pays for copying the items of a list.
  void spend_on_items(Span span, const std::vector<Value>& items);

  /// Counts an entity that was made.
  void count_made(Span span);
  /// Counts primitives that were put into the scene.
  void count_emitted(Span span, std::uint64_t primitives);
  /// Refuses an entity of more primitives than a scene may have.
  void check_size(Span span, const Entity& entity);

  // Strings and lists are made here, where they are paid for.
  Value make_string(Span span, std::string text);
  Value make_list(Span span, std::vector<Value> items);
  Value make_dictionary(Span span, Variables entries);
  /// Returns the depth of a list or dictionary around things of such a depth. Throws if it is too
  /// much.
  int depth_around(Span span, int inside) const;
  /// Throws unless a string or list of such a size is allowed.
  void check_string_size(Span span, std::size_t bytes);
  void check_list_size(Span span, std::size_t items);
  Charge charge_memory(Span span, std::size_t bytes);

  /// Returns how many scene units a length is. Throws a Failure while the unit is not known.
  double length(Span span, double value, Unit unit_of_value);
  /// Says whether a length was asked for, which the unit has then decided.
  bool has_lengths() const { return has_lengths_; }

  /// A Truncation is a division of Integers that left a rest.
  struct Truncation {
    Span sign;
    std::int64_t dividend = 0;
    std::int64_t divisor = 0;
  };
  /// Notes that the value of the expression at `value` comes of such a division.
  void note_truncation(Span value, const Truncation& division);
  /// Returns that division, or null.
  const Truncation* truncation_of(Span value) const;
  /// Notes whether a variable is set to what comes of such a division.
  void note_variable(Symbol name, Span value);
  /// Notes that a variable is read, if it was set so.
  void note_reading(Symbol name, Span span, const Value& value);
  /// Forgets what was noted of an expression that is evaluated again.
  void forget_truncation(Span value);
  bool has_truncations() const { return has_truncations_; }
  /// Warns if an Integer at `value` that is used as a Float comes of such a division.
  void used_as_float(Span value);

  void print(Span span, const std::string& line);

  /// Throws a Failure for a limit, naming the loop or call that it was passed in.
  [[noreturn]] void pass_limit(Span span, const std::string& message) const;

  /// An Activity is a loop or macro call that runs now.
  struct Activity {
    std::string_view name;  ///< name of the macro, or "while" or "for"
    Span span;
    bool is_loop = false;
    std::uint64_t rounds = 0;
  };

  /// Holds an activity as long as it runs.
  class Running {
   public:
    Running(Context& context, Activity activity) : activities_(context.activities_) {
      activities_.push_back(activity);
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() { activities_.pop_back(); }

   private:
    std::vector<Activity>& activities_;
  };

  /// Counts a round of the innermost loop.
  void count_round() { ++activities_.back().rounds; }

 private:
  /// Ends the script if it has used up its steps or the caller wants it. Else it sets the next
  /// pause.
  void pause(Span span);
  std::string where() const;

  std::uint64_t steps_ = 0;
  std::uint64_t next_pause_ = 0;
  std::uint64_t made_ = 0;
  std::uint64_t emitted_ = 0;
  std::size_t memory_ = 0;
  std::size_t printed_bytes_ = 0;
  bool has_lengths_ = false;
  std::vector<Activity> activities_;
  std::unordered_map<std::uint64_t, Truncation> truncations_;  ///< by where their values are
  std::unordered_map<Symbol, Truncation> truncated_variables_;
  std::set<std::uint64_t> reported_divisions_;
  bool has_truncations_ = false;  ///< or had
};

/// A ListMaker makes a list item by item, and pays for its memory as it grows.
class ListMaker {
 public:
  ListMaker(Context& context, Span span) : context_(context), span_(span) {}

  void add(Value item);
  Value finish();

 private:
  Context& context_;
  Span span_;
  std::vector<Value> items_;
  int depth_inside_ = 0;
  Charge charge_;
};

}  // namespace crt::lang
