#include "lang/scope.hpp"

namespace crt::lang {

const Value* Scope::find(Symbol name) const {
  for (const Scope* scope = this; scope; scope = scope->parent()) {
    if (const Value* value = scope->variables_.find(name)) return value;
  }
  return nullptr;
}

Scope& Scope::target_of(Symbol name) {
  for (Scope* scope = this; scope; scope = scope->parent_.get()) {
    if (scope->has(name)) return *scope;
    if (scope->kind_ == Kind::border) break;
  }
  return *this;
}

}  // namespace crt::lang
