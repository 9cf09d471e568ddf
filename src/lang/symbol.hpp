// A symbol is a name as a number: two names are equal if their symbols are.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace crt::lang {

enum class Symbol : std::uint32_t {};

class SymbolTable {
 public:
  SymbolTable() = default;
  /// Copies the names with their numbers.
  SymbolTable(const SymbolTable& other) {
    for (const std::string& name : other.names_) intern(name);
  }
  SymbolTable& operator=(const SymbolTable&) = delete;

  Symbol intern(std::string_view name) {
    if (const auto known = symbols_.find(name); known != symbols_.end()) return known->second;
    const auto symbol = static_cast<Symbol>(names_.size());
    symbols_.emplace(names_.emplace_back(name), symbol);
    return symbol;
  }

  /// Returns the symbol of a name, if there is one.
  std::optional<Symbol> find(std::string_view name) const {
    const auto known = symbols_.find(name);
    return known == symbols_.end() ? std::nullopt : std::optional(known->second);
  }

  std::string_view name(Symbol symbol) const { return names_[static_cast<std::size_t>(symbol)]; }

 private:
  std::deque<std::string> names_;  // a deque, so that the views in the map stay valid
  std::unordered_map<std::string_view, Symbol> symbols_;
};

}  // namespace crt::lang
