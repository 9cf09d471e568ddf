// These tests read JSON that means harm.
#include "text/json.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <string>

using namespace crt::text;
using nlohmann::json;

namespace {

std::string nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

}  // namespace

TEST_CASE("JSON is read to the depth that is allowed, and no deeper") {
  const JsonLimits limits{.depth = 3};
  CHECK(parse_json("[[[]]]", limits) == json::parse("[[[]]]"));
  CHECK(parse_json(R"({"a": [{"b": 1}]})", limits).at("a").at(0).at("b") == 1);
  CHECK_THROWS_WITH_AS(parse_json("[[[[]]]]", limits), "it is nested too deeply", JsonError);
  CHECK_THROWS_AS(parse_json(R"({"a": [{"b": {}}]})", limits), JsonError);
}

TEST_CASE("JSON that is nested as deeply as a stack is not, closed or open, is refused") {
  for (const std::string& deep : {nested(10'000'000), std::string(10'000'000, '[')})
    CHECK_THROWS_WITH_AS(parse_json(deep, {.depth = 64}), "it is nested too deeply", JsonError);
}

TEST_CASE("JSON has as many values as are allowed, and no more") {
  const JsonLimits limits{.depth = 3, .values = 4};
  CHECK(parse_json("[1, [2]]", limits).size() == 2);
  CHECK(parse_json(R"({"a": 1, "b": [2]})", limits).size() == 2);
  CHECK_THROWS_WITH_AS(parse_json("[1, [2], 3]", limits), "it has too many values", JsonError);
  CHECK_THROWS_AS(parse_json("[[],[],[],[]]", limits), JsonError);
}

TEST_CASE("what is no JSON is refused in the same way") {
  for (const char* text : {"", "{", "nonsense", "\"\xff\"", "1e999", "[1,]"})
    CHECK_THROWS_AS(parse_json(text, {}), JsonError);
}

TEST_CASE("whole numbers are those that their type holds") {
  CHECK(whole_number<std::uint32_t>(json::parse("4294967295")) == 4294967295U);
  CHECK(whole_number<int>(json::parse("-7")) == -7);
  CHECK(whole_number<std::uint64_t>(json::parse("18446744073709551615")) == UINT64_MAX);
  for (const char* text : {"4294967296", "-1", "1.5", "1e300", "-1e300", "true", "null", "[1]"})
    CHECK_THROWS_AS(whole_number<std::uint32_t>(json::parse(text)), JsonError);
  CHECK_THROWS_AS(whole_number<int>(json::parse("2147483648")), JsonError);
}

TEST_CASE("an id is a number or a short text") {
  for (const char* id : {"7", "-7", "1.5", R"("")", R"("a")"}) CHECK(is_json_id(json::parse(id)));
  for (const char* id : {"null", "true", "[]", "{}", "[[7]]"}) CHECK(!is_json_id(json::parse(id)));
  CHECK(is_json_id(std::string(128, 'a')));
  CHECK(!is_json_id(std::string(129, 'a')));
}
