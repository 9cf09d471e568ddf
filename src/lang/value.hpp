// A script computes with immutable values, which are shared and not copied where they are large.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "crt/background.hpp"
#include "crt/camera.hpp"
#include "crt/entity.hpp"
#include "crt/field.hpp"
#include "crt/light.hpp"
#include "crt/material.hpp"
#include "lang/symbol.hpp"

namespace crt::lang {

struct Builtin;
struct MacroLiteral;
class Scope;
struct StringValue;
struct ListValue;
struct DictionaryValue;
struct MacroValue;

/// Nothing is what a call without a value gives, such as that of `print`.
struct Nothing {};

/// Unknown is what a variable holds when the statement that should have set it failed. Using it is
/// no further error.
struct Unknown {};

using String = std::shared_ptr<const StringValue>;
using List = std::shared_ptr<const ListValue>;
using Dictionary = std::shared_ptr<const DictionaryValue>;
using Macro = std::shared_ptr<const MacroValue>;

// The order is that of type_name() in value.cpp.
using Value = std::variant<Nothing, Unknown, std::int64_t, double, bool, Vec3, Color, String, List,
                           Dictionary, Macro, const Builtin*, Entity, SharedMaterial,
                           std::shared_ptr<const Pattern>, std::shared_ptr<const Light>,
                           std::shared_ptr<const Camera>, std::shared_ptr<const Background>, Field>;

/// A Charge is memory that a value holds. It is given back to its counter when the value goes.
class Charge {
 public:
  Charge() = default;
  Charge(std::size_t& counter, std::size_t bytes) : counter_(&counter), bytes_(bytes) {
    counter += bytes;
  }
  Charge(Charge&& other) noexcept
      : counter_(std::exchange(other.counter_, nullptr)), bytes_(other.bytes_) {}
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;
  Charge& operator=(Charge&&) = delete;
  ~Charge() {
    if (counter_) *counter_ -= bytes_;
  }

  /// Takes over what another has of the same counter.
  void add(Charge other) {
    if (!counter_) counter_ = other.counter_;
    bytes_ += other.bytes_;
    other.counter_ = nullptr;
  }

 private:
  std::size_t* counter_ = nullptr;
  std::size_t bytes_ = 0;
};

struct StringValue {
  std::string text;
  Charge charge = {};
};

struct ListValue {
  std::vector<Value> items;
  /// The depth counts lists and dictionaries within one another: 1 for a flat one.
  int depth = 1;
  Charge charge = {};
};

/// Variables are names bound to values, in the order in which they were set first.
class Variables {
 public:
  /// Returns the value of a name, or null.
  const Value* find(Symbol name) const {
    if (index_) return find_by_index(name);
    for (const auto& [symbol, value] : variables_) {
      if (symbol == name) return &value;
    }
    return nullptr;
  }
  void set(Symbol name, Value value);
  void clear();

  std::size_t size() const { return variables_.size(); }
  auto begin() const { return variables_.begin(); }
  auto end() const { return variables_.end(); }

 private:
  const Value* find_by_index(Symbol name) const;

  std::vector<std::pair<Symbol, Value>> variables_;
  /// Maps names to places in variables_, once there are too many for a linear search.
  std::unique_ptr<std::unordered_map<Symbol, std::size_t>> index_;
};

/// A DictionaryValue has values by names.
struct DictionaryValue {
  Variables entries;
  /// The depth counts dictionaries and lists within one another, as that of a list does.
  int depth = 1;
  Charge charge = {};
};

/// A MacroValue is a macro and the scope that it was made in.
struct MacroValue {
  const MacroLiteral* literal = nullptr;
  std::shared_ptr<Scope> scope;
};

/// Returns the depth of a list or dictionary, and 0 for all others.
int depth_of(const Value& value);

/// Returns "Integer", "Vec3", ...
std::string_view type_name(const Value& value);

/// Returns the name with its article: "an Integer".
std::string type_with_article(const Value& value);

/// Returns "a" or "an", as the word needs.
std::string_view article(std::string_view word);

/// Returns a number as a Float, or null for any other value. An Integer is converted into
/// `storage`.
inline const double* as_float(const Value& value, double& storage) {
  if (const auto* number = std::get_if<double>(&value)) return number;
  const auto* integer = std::get_if<std::int64_t>(&value);
  if (!integer) return nullptr;
  storage = static_cast<double>(*integer);
  return &storage;
}

/// Returns a Float as text: the shortest that reads as the same number ("2" for 2.0).
std::string float_text(double number);

}  // namespace crt::lang
