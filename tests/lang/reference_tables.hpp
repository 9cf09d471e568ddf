// The tables of attributes in docs/language.md, and the words of the fuzzer's dictionary, are
// written here from the objects of the language.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lang/objects.hpp"

namespace crt::test {

/// Returns the cells of "| a | b \| c |", without the blanks around them.
std::vector<std::string> cells(std::string_view row);

/// Returns the rows of an object's table. What attributes mean that are no rows of the schema is
/// taken from `meanings`.
std::string attribute_rows(const lang::ObjectType& type,
                           const std::map<std::string, std::string, std::less<>>& meanings);

/// Returns the reference with the tables of attributes as the code has them.
std::string with_attribute_tables(const std::string& page);

/// Returns the fuzzer's dictionary with the names of all objects and attributes.
std::string with_object_words(const std::string& dictionary);

}  // namespace crt::test
