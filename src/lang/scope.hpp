// Variables are names bound to values, in scopes that lie in one another.
#pragma once

#include <memory>
#include <utility>

#include "lang/symbol.hpp"
#include "lang/value.hpp"

namespace crt::lang {

class Scope {
 public:
  enum class Kind {
    block,   ///< a body in braces: assignments look further out
    border,  ///< a macro's call or the top level: assignments stay within
  };

  Scope(Kind kind, std::shared_ptr<Scope> parent) : kind_(kind), parent_(std::move(parent)) {}

  /// Returns the value of a name, from here outwards, or null if there is none.
  const Value* find(Symbol name) const;

  /// Returns the scope that an assignment to `name` changes: the nearest up to the border that has
  /// it, else this.
  Scope& target_of(Symbol name);

  /// Binds the name in this very scope.
  template <class SomeValue>
  void set(Symbol name, SomeValue&& value) {
    variables_.set(name, std::forward<SomeValue>(value));
  }

  bool has(Symbol name) const { return variables_.find(name) != nullptr; }

  /// Forgets all names, for another round of a loop.
  void clear() { variables_.clear(); }

  /// Says whether a macro made here may still need it, so that it must not be used again.
  bool is_captured() const { return captured_; }
  void set_captured() { captured_ = true; }

  const Scope* parent() const { return parent_.get(); }
  const std::shared_ptr<Scope>& shared_parent() const { return parent_; }
  const Variables& variables() const { return variables_; }

 private:
  Kind kind_;
  bool captured_ = false;
  std::shared_ptr<Scope> parent_;
  Variables variables_;
};

}  // namespace crt::lang
