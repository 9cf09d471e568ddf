#include "service/script_tree.hpp"

#include <string>
#include <utility>
#include <variant>

#include "lang/tree_walk.hpp"
#include "lang/utf8.hpp"
#include "service/literal.hpp"
#include "service/material_kind.hpp"

namespace crt::service {

namespace {

using lang::Expression;

/// Names that stand for names that stand for names are followed so far.
constexpr int max_names = 20;

const char* sign_of(lang::BinaryOperator op) {
  return op == lang::BinaryOperator::add         ? "+"
         : op == lang::BinaryOperator::subtract  ? "-"
         : op == lang::BinaryOperator::intersect ? "^"
                                                 : "";
}

/// Walks over the whole tree and makes nodes of what is of interest.
class TreeMaker : public lang::TreeWalk<TreeMaker> {
 public:
  using TreeWalk::operator();
  using TreeWalk::visit;

  explicit TreeMaker(const Program& program) : program_(program) {}

  std::vector<ScriptNode> make() {
    visit(program_.script().statements);
    return std::move(nodes_);
  }

  void visit(const Expression* expression) {
    if (!expression) return;
    const lang::Span before = std::exchange(span_, expression->span);
    const Expression* around = std::exchange(expression_, expression);
    std::visit(*this, expression->node);
    span_ = before;
    expression_ = around;
  }

  void visit(const lang::Block& block) {
    for (const lang::Statement& statement : block.statements) {
      const lang::Span before = std::exchange(span_, statement.span);
      std::visit(*this, statement.node);
      span_ = before;
    }
  }

  void visit(const std::vector<lang::AttributeSyntax>& attributes) {
    const std::size_t owner = parent_;
    for (const lang::AttributeSyntax& syntax : attributes) {
      ScriptAttribute attribute{.name = text_of(syntax.name.symbol),
                                .name_span = place_of(syntax.name.span)};
      if (syntax.value) {
        attribute.value_span = place_of(syntax.value->span);
        describe_value(program_, *syntax.value, attribute);
      }
      nodes_[owner].attributes.push_back(std::move(attribute));
      // A variable's name says nothing more than the attribute does.
      if (syntax.value && !std::holds_alternative<lang::Name>(syntax.value->node))
        visit(syntax.value);
    }
  }

  void operator()(const lang::SettingsBlock& settings) {
    const Inside inside(*this, NodeKind::settings, "Settings", settings.keyword);
    TreeWalk::operator()(settings);
  }
  void operator()(const lang::SceneBlock& scene) {
    const Inside inside(*this, NodeKind::scene, "Scene", scene.keyword);
    TreeWalk::operator()(scene);
  }
  void operator()(const lang::Import& import) {
    const Inside inside(*this, NodeKind::import, import.path, import.path_span);
  }
  void operator()(const lang::For& loop) {
    const Inside inside(*this, NodeKind::loop, "for", loop.keyword);
    TreeWalk::operator()(loop);
  }
  void operator()(const lang::While& loop) {
    const Inside inside(*this, NodeKind::loop, "while", loop.keyword);
    TreeWalk::operator()(loop);
  }
  void operator()(const lang::If& choice) {
    const Inside inside(*this, NodeKind::choice, "if", {span_.begin, span_.begin});
    TreeWalk::operator()(choice);
  }
  void operator()(const lang::Assignment& assignment) {
    const Inside inside(*this, NodeKind::assignment, text_of(assignment.name.symbol),
                        assignment.name.span);
    TreeWalk::operator()(assignment);
  }
  void operator()(const lang::MacroLiteral& macro) {
    const std::string name = parent_ != ScriptNode::no_parent ? nodes_[parent_].name : "Macro";
    const Inside inside(*this, NodeKind::macro, name, {span_.begin, span_.begin});
    TreeWalk::operator()(macro);
  }
  void operator()(const lang::ObjectLiteral& object) {
    const Inside inside(*this, NodeKind::object, text_of(object.name.symbol), object.name.span);
    TreeWalk::operator()(object);
  }
  void operator()(const lang::DerivedMaterial& material) {
    const std::string base(program_.text_of(material.base->span));
    const lang::ObjectType* type = material_type(program_, *material.base);
    const Inside inside(*this, NodeKind::object, type ? std::string(type->name) : base,
                        material.base->span);
    const std::size_t node = parent_;
    nodes_[node].base = base;
    for (const lang::AttributeSyntax* syntax : inherited_attributes(program_, material)) {
      ScriptAttribute attribute{.name = text_of(syntax->name.symbol)};
      describe_value(program_, *syntax->value, attribute);
      attribute.written = lang::abbreviated(program_.text_of(syntax->value->span));
      nodes_[node].inherited.push_back(std::move(attribute));
    }
    visit(material.attributes);
  }
  void operator()(const lang::Chain& chain) {
    if (!may_be_entity(*expression_)) return TreeWalk::operator()(chain);
    const lang::ChainLink& first = chain.links.front();
    const Inside inside(*this, NodeKind::combination, sign_of(first.op), first.op_span);
    TreeWalk::operator()(chain);
  }
  void operator()(const lang::Modified& modified) {
    std::string words;
    for (const lang::Modifier& modifier : modified.modifiers)
      words += (words.empty() ? "" : ", ") + std::string(lang::word_of(modifier.kind));
    const Inside inside(*this, NodeKind::placed, words, {modified.base->span.end, span_.end});
    TreeWalk::operator()(modified);
  }
  void operator()(const lang::Call& call) {
    if (!may_be_entity(*expression_)) return TreeWalk::operator()(call);
    const Inside inside(*this, NodeKind::call, std::string(program_.text_of(call.callee->span)),
                        call.callee->span);
    visit(call.arguments);
  }
  void operator()(const lang::ListLiteral& list) {
    if (!may_be_entity(*expression_)) return TreeWalk::operator()(list);
    const Inside inside(*this, NodeKind::list, "list", {span_.begin, span_.begin});
    TreeWalk::operator()(list);
  }
  void operator()(const lang::Name& name) {
    if (may_be_entity(*expression_))
      const Inside inside(*this, NodeKind::name, text_of(name.symbol), span_);
  }

 private:
  /// While an Inside lives, new nodes are those of a node that it adds.
  class Inside {
   public:
    Inside(TreeMaker& maker, NodeKind kind, std::string name, lang::Span name_span)
        : maker_(maker), before_(std::exchange(maker.parent_, maker.nodes_.size())) {
      maker.nodes_.push_back({.kind = kind,
                              .name = std::move(name),
                              .span = maker.place_of(maker.span_),
                              .name_span = maker.place_of(name_span),
                              .parent = before_});
    }
    Inside(const Inside&) = delete;
    Inside& operator=(const Inside&) = delete;
    ~Inside() { maker_.parent_ = before_; }

   private:
    TreeMaker& maker_;
    std::size_t before_;
  };

  std::string text_of(lang::Symbol symbol) const {
    return std::string(program_.symbols().name(symbol));
  }

  TextSpan place_of(lang::Span span) const { return span_in(program_.main(), span); }

  /// Says whether a value looks like an entity, a material or a list of such: not like a number.
  bool may_be_entity(const Expression& expression) const {
    const Expression* value = &expression;
    for (int names = 0; value && names < max_names;) {
      if (std::holds_alternative<lang::ObjectLiteral>(value->node) ||
          std::holds_alternative<lang::DerivedMaterial>(value->node) ||
          std::holds_alternative<lang::Modified>(value->node))
        return true;
      if (const auto* chain = std::get_if<lang::Chain>(&value->node)) {
        if (*sign_of(chain->links.front().op) == '\0') return false;
        value = chain->first;
      } else if (const auto* list = std::get_if<lang::ListLiteral>(&value->node)) {
        value = list->items.empty() ? nullptr : list->items.front();
      } else if (const auto* call = std::get_if<lang::Call>(&value->node)) {
        const lang::DeclaredName* callee = program_.declared_at(call->callee->span);
        return callee && callee->kind == lang::NameKind::macro;
      } else if (std::holds_alternative<lang::Name>(value->node)) {
        const lang::DeclaredName* name = program_.declared_at(value->span);
        value = name && name->kind == lang::NameKind::variable ? name->value : nullptr;
        ++names;
      } else {
        value = nullptr;
      }
    }
    return false;
  }

  const Program& program_;
  std::vector<ScriptNode> nodes_;
  std::size_t parent_ = ScriptNode::no_parent;
  lang::Span span_{};
  const Expression* expression_ = nullptr;
};

}  // namespace

std::vector<ScriptNode> tree_of(const Program& program) {
  return TreeMaker(program).make();
}

}  // namespace crt::service
