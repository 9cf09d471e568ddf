// This puts what completion offers into the words of an editor's list.
#pragma once

#include <string>

#include "lang/builtins.hpp"
#include "lang/name_map.hpp"
#include "lang/objects.hpp"
#include "service/completion.hpp"

namespace crt::service {

class CompletionItems {
 public:
  explicit CompletionItems(const Reference& reference) : reference_(reference) {}

  Completion attribute(const lang::ObjectType& type, const lang::AttributeType& attribute,
                       bool needs_arrow) const;
  Completion object(const lang::ObjectType& type) const;
  Completion function(const lang::Builtin& builtin) const;
  Completion constant(const std::string& name) const;
  Completion keyword(const std::string& name) const;
  /// Returns a part of a value: a component of a Vec3, or an entry of a dictionary.
  static Completion part(std::string_view name);
  static Completion parameter(std::string_view name, bool needs_arrow);
  Completion name(const Program& program, const lang::DeclaredName& name, int rank) const;

 private:
  const Reference& reference_;
};

/// Returns an attribute's type, and whether it must be given or what it is by default.
std::string attribute_signature(const lang::AttributeType& attribute);

/// Returns what a name is, as it was set: "tower(height, tint)", "parameter n", "n = 18".
std::string signature_of(const Program& program, const lang::DeclaredName& name);

}  // namespace crt::service
