#include "lang/value.hpp"

#include <array>
#include <cmath>

#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Up to so many variables a linear search beats hashing.
constexpr std::size_t few = 12;

}  // namespace

const Value* Variables::find_by_index(Symbol name) const {
  const auto found = index_->find(name);
  return found == index_->end() ? nullptr : &variables_[found->second].second;
}

void Variables::set(Symbol name, Value value) {
  if (const Value* known = find(name)) {
    const_cast<Value&>(*known) =
        std::move(value);  // NOLINT(cppcoreguidelines-pro-type-const-cast): ours
    return;
  }
  variables_.emplace_back(name, std::move(value));
  if (index_) {
    index_->emplace(name, variables_.size() - 1);
  } else if (variables_.size() > few) {
    index_ = std::make_unique<std::unordered_map<Symbol, std::size_t>>();
    for (std::size_t i = 0; i < variables_.size(); ++i) index_->emplace(variables_[i].first, i);
  }
}

void Variables::clear() {
  variables_.clear();
  index_.reset();
}

int depth_of(const Value& value) {
  if (const List* list = std::get_if<List>(&value)) return (*list)->depth;
  const Dictionary* dictionary = std::get_if<Dictionary>(&value);
  return dictionary ? (*dictionary)->depth : 0;
}

std::string_view type_name(const Value& value) {
  constexpr std::array<std::string_view, std::variant_size_v<Value>> names = {
      "nothing", "unknown value", "Integer",    "Float",      "Boolean", "Vec3",   "Color",
      "String",  "List",          "Dictionary", "Macro",      "Macro",   "Entity", "Material",
      "Pattern", "Light",         "Camera",     "Background", "Field"};
  return names[value.index()];
}

std::string_view article(std::string_view word) {
  constexpr std::string_view vowels = "AEIOUaeiou";
  return !word.empty() && vowels.find(word[0]) != std::string_view::npos ? "an" : "a";
}

std::string type_with_article(const Value& value) {
  const std::string_view name = type_name(value);
  if (std::holds_alternative<Nothing>(value)) return std::string(name);
  return text::format("{} {}", article(name), name);
}

std::string float_text(double number) {
  // The sign of a NaN depends on the machine.
  return std::isnan(number) ? "nan" : text::format("{}", number);
}

}  // namespace crt::lang
