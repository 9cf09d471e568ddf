// The fields of a primitive are checked by their rules in the schema.
#pragma once

#include <type_traits>

#include "core/geometry/checks.hpp"
#include "crt/schema.hpp"

namespace crt::core {

/// Checks each field by the rule of its row.
template <class Description>
void check_fields(const Description& description) {
  schema::for_each_field<Description>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    const Value& value = description.*row.member;
    if constexpr (std::is_same_v<Value, double>) {
      check_number(row.name, row.rule, value);
    } else if constexpr (std::is_same_v<Value, Vec3>) {
      const bool has_other = !row.rule.other.empty();
      check_vector(row.name, row.rule, value,
                   has_other ? schema::value_of<Vec3>(description, row.rule.other) : value);
    } else if constexpr (requires { value == nullptr; }) {
      if (row.rule.kind == schema::Rule::made) check_made(row.name, row.rule, value != nullptr);
    }
  });
}

}  // namespace crt::core
