// A literal is a value that stands in a script as it is: a number, a string, a vector of numbers.
#pragma once

#include <crt/language_service.hpp>

#include "lang/syntax.hpp"
#include "service/program.hpp"

namespace crt::service {

/// Fills in what the value of an attribute is as a literal, or why it is none.
void describe_value(const Program& program, const lang::Expression& value,
                    ScriptAttribute& attribute);

}  // namespace crt::service
