#include "lang/scope.hpp"

namespace crt::lang {

namespace {

/// Up to so many variables a linear search beats hashing.
constexpr std::size_t few = 12;

}  // namespace

const Value* Scope::find_here(Symbol name) const {
  if (index_) {
    const auto found = index_->find(name);
    return found == index_->end() ? nullptr : &variables_[found->second].second;
  }
  for (const auto& [symbol, value] : variables_) {
    if (symbol == name) return &value;
  }
  return nullptr;
}

const Value* Scope::find(Symbol name) const {
  for (const Scope* scope = this; scope; scope = scope->parent()) {
    if (const Value* value = scope->find_here(name)) return value;
  }
  return nullptr;
}

Scope& Scope::target_of(Symbol name) {
  for (Scope* scope = this; scope; scope = scope->parent_.get()) {
    if (scope->find_here(name)) return *scope;
    if (scope->kind_ == Kind::border) break;
  }
  return *this;
}

void Scope::set(Symbol name, Value value) {
  if (const Value* known = find_here(name)) {
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

void Scope::clear() {
  variables_.clear();
  index_.reset();
}

}  // namespace crt::lang
