// Built-ins are the functions and constants that every script has.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "lang/context.hpp"
#include "lang/syntax.hpp"
#include "lang/value.hpp"

namespace crt::lang {

/// Arguments hold what a built-in was called with. The readers throw a Failure at the argument that
/// is wrong.
class Arguments {
 public:
  Arguments(Context& new_context, const Builtin& builtin, Span new_call,
            std::span<const Value> values, std::span<const Expression* const> expressions)
      : context(new_context),
        call(new_call),
        builtin_(builtin),
        values_(values),
        expressions_(expressions) {}

  Context& context;
  Span call;

  std::size_t size() const { return values_.size(); }
  const Value& operator[](std::size_t i) const { return values_[i]; }
  Span span(std::size_t i) const { return expressions_[i]->span; }
  std::span<const Value> values() const { return values_; }

  /// A number that an argument gives as a Float.
  double number(std::size_t i) const;
  std::int64_t integer(std::size_t i) const;
  const ListValue& list(std::size_t i) const;
  Vec3 vector(std::size_t i) const;
  bool all_integers() const;
  /// Returns whether any is a field, and so the result is one.
  bool any_field() const;
  Field field(std::size_t i) const;

  /// Calls the argument, a macro or a built-in, with values.
  Value call_argument(std::size_t i, std::span<const Value> values) const;

  /// Warns if the first argument, an angle, is a whole number of degrees.
  void expect_radians() const;

  [[noreturn]] void wrong_type(std::size_t i, std::string_view wanted) const;

 private:
  const Builtin& builtin_;
  std::span<const Value> values_;
  std::span<const Expression* const> expressions_;
};

/// The most arguments of a built-in that takes any number of them.
inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

struct Builtin {
  std::string_view name;
  /// The signature is as the reference writes it: "clamp(x, low, high)".
  std::string_view signature;
  std::size_t least_arguments = 0;
  std::size_t max_arguments = 0;
  Value (*function)(const Arguments&) = nullptr;
  /// Says that it calls what it is given, see Arguments::call_argument().
  bool calls_others = false;
};

/// Returns all built-ins.
std::span<const Builtin> builtins();

// These return the parts of the table, by subject.
std::span<const Builtin> number_builtins();
std::span<const Builtin> vector_builtins();
std::span<const Builtin> easing_builtins();
std::span<const Builtin> list_builtins();
std::span<const Builtin> string_builtins();
std::span<const Builtin> contour_builtins();
std::span<const Builtin> measure_builtins();

}  // namespace crt::lang
