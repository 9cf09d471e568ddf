// This visits a whole tree, for what looks for something in it without running it.
#pragma once

#include <variant>
#include <vector>

#include "lang/syntax.hpp"

namespace crt::lang {

/// A TreeWalk visits all expressions and statements in the order of the text. Its depth is bounded
/// by max_nesting. A class that derives from it has overloads of operator() for the kinds of nodes
/// that it is interested in, and of visit() for what it looks at in another way. It says
/// `using TreeWalk::operator();` for all others, and `using TreeWalk::visit;`.
template <class Derived>
class TreeWalk {
 public:
  void operator()(const Literal&) {}
  void operator()(const Length&) {}
  void operator()(const Interpolation& text) { derived().visit(text.parts); }
  void operator()(const Name&) {}
  void operator()(const ObjectLiteral& object) { derived().visit(object.attributes); }
  void operator()(const DerivedMaterial& material) {
    derived().visit(material.base);
    derived().visit(material.attributes);
  }
  void operator()(const MacroLiteral& macro) {
    derived().visit(macro.parameters.defaults);
    derived().visit(macro.body);
  }
  void operator()(const ListLiteral& list) { derived().visit(list.items); }
  void operator()(const Comprehension& list) {
    derived().visit(list.value);
    for (const Clause& clause : list.clauses) derived().visit(clause.operand);
  }
  void operator()(const DictionaryLiteral& dictionary) {
    for (const AttributeSyntax& entry : dictionary.entries) derived().visit(entry.value);
  }
  void operator()(const Index& index) {
    derived().visit(index.base);
    derived().visit(index.index);
  }
  void operator()(const Slice& slice) {
    derived().visit(slice.base);
    derived().visit(slice.first);
    derived().visit(slice.end);
  }
  void operator()(const Member& member) { derived().visit(member.base); }
  void operator()(const Call& call) {
    derived().visit(call.callee);
    derived().visit(call.arguments);
  }
  void operator()(const Modified& modified) {
    derived().visit(modified.base);
    for (const Modifier& modifier : modified.modifiers)
      for (const Expression* operand : modifier.operands())
        if (operand) derived().visit(operand);
  }
  void operator()(const Unary& unary) { derived().visit(unary.operand); }
  void operator()(const Chain& chain) {
    derived().visit(chain.first);
    for (const ChainLink& link : chain.links) derived().visit(link.operand);
  }
  void operator()(const Logical& logical) { derived().visit(logical.operands); }
  void operator()(const Conditional& conditional) {
    derived().visit(conditional.condition);
    derived().visit(conditional.yes);
    derived().visit(conditional.no);
  }
  void operator()(const Assignment& assignment) { derived().visit(assignment.value); }
  void operator()(const Destructuring& assignment) { derived().visit(assignment.value); }

  void operator()(const ExpressionStatement& statement) { derived().visit(statement.expression); }
  void operator()(const While& loop) {
    derived().visit(loop.condition);
    derived().visit(loop.body);
  }
  void operator()(const If& choice) {
    for (const If::Branch& branch : choice.branches) {
      derived().visit(branch.condition);
      derived().visit(branch.body);
    }
  }
  void operator()(const For& loop) {
    derived().visit(loop.list);
    derived().visit(loop.body);
  }
  void operator()(const Jump& jump) { derived().visit(jump.name); }
  void operator()(const Return& result) {
    derived().visit(result.value);
    derived().visit(result.name);
  }
  void operator()(const SettingsBlock& settings) { derived().visit(settings.attributes); }
  void operator()(const SceneBlock& scene) { derived().visit(scene.body); }
  void operator()(const Import&) {}

  /// Visits an expression, if there is one.
  void visit(const Expression* expression) {
    if (expression) std::visit(derived(), expression->node);
  }
  void visit(const std::vector<const Expression*>& expressions) {
    for (const Expression* expression : expressions) derived().visit(expression);
  }
  void visit(const std::vector<AttributeSyntax>& attributes) {
    for (const AttributeSyntax& attribute : attributes) derived().visit(attribute.value);
  }
  void visit(const Block& block) {
    for (const Statement& statement : block.statements) std::visit(derived(), statement.node);
  }

 private:
  Derived& derived() { return static_cast<Derived&>(*this); }
};

}  // namespace crt::lang
