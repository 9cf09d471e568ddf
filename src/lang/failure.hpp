// These functions throw a Failure with a formatted message. The formatting happens in a function of
// its own, so that the function that throws keeps a small stack frame. The interpreter has many of
// them on the stack at once.
#pragma once

#include <string>
#include <type_traits>

#include "lang/reporter.hpp"
#include "lang/value.hpp"
#include "text/format.hpp"

namespace crt::lang {

/// Is thrown by an expression that uses a variable whose setting failed. That was already reported.
struct Abandoned {};

/// A value stands in a message as its type: "an Integer".
template <class Argument>
decltype(auto) as_shown(const Argument& argument) {
  if constexpr (std::is_same_v<Argument, Value>) {
    return type_with_article(argument);
  } else {
    return (argument);
  }
}

template <class Argument>
using Shown = std::remove_cvref_t<decltype(as_shown(std::declval<const Argument&>()))>;

template <class... Arguments>
[[noreturn, gnu::noinline]] void fail(Span span, text::Form<Shown<Arguments>...> form,
                                      const Arguments&... arguments) {
  const auto write = [&](const auto&... shown) { return text::format(form, shown...); };
  throw Failure{.span = span, .message = write(as_shown(arguments)...)};
}

}  // namespace crt::lang
