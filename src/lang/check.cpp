#include "lang/check.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "lang/objects.hpp"
#include "lang/settings.hpp"
#include "lang/suggestion.hpp"
#include "lang/tree_walk.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Says what stands here for objects of other languages.
constexpr std::array foreign_objects = {
    Hint{"Cube", "; did you mean 'Box'?"},
    Hint{"Cuboid", "; did you mean 'Box'?"},
    Hint{"Ball", "; did you mean 'Sphere'?"},
    Hint{"Tube", "; did you mean 'Cylinder'?"},
    Hint{"Ring", "; did you mean 'Torus'?"},
    Hint{"Circle", "; did you mean 'Disc'?"},
    Hint{"Texture", "; did you mean 'Material'?"},
    Hint{"Pigment", "; did you mean 'Material'?"},
    Hint{"Finish", "; did you mean 'Material'?"},
    Hint{"Union", "; the union of two entities is a + b"},
    Hint{"Difference", "; the difference of two entities is a - b"},
    Hint{"Intersection", "; the intersection of two entities is a ^ b"},
};

/// Returns what an unknown object most likely is, or all lights or all objects that there are.
std::string meant(std::string_view name) {
  const std::string_view foreign = hint_of(name, foreign_objects);
  if (!foreign.empty()) return std::string(foreign);
  std::vector<std::string_view> names;
  for (const ObjectType& type : object_types()) names.push_back(type.name);
  if (std::string hint = did_you_mean(name, names); !hint.empty()) return hint;
  constexpr std::string_view light = "Light";
  const bool is_light = name.ends_with(light);
  std::vector<std::string> listed;
  for (const std::string_view known : names) {
    if (!is_light || known.ends_with(light)) listed.emplace_back(known);
  }
  return text::format("; there are {}", enumerate(listed, "and"));
}

/// Returns an angle with a unit, such as 45deg, that stands somewhere as a number, or null.
const Expression* written_angle(const Expression& expression) {
  const auto* unary = std::get_if<Unary>(&expression.node);
  const Expression& number = unary ? *unary->operand : expression;
  const auto* literal = std::get_if<Literal>(&number.node);
  return literal && literal->is_angle ? &number : nullptr;
}

class ScriptChecker {
 public:
  ScriptChecker(int compat, const SymbolTable& symbols, Reporter& reporter)
      : compat_(compat), symbols_(symbols), reporter_(reporter) {}

  void check_object(ObjectLiteral& object) {
    const std::string_view name = symbols_.name(object.name.symbol);
    object.type = find_object_type(name);
    if (object.type) return check_attributes(*object.type, object.name.span, object.attributes);
    reporter_.error(object.name.span, text::format("unknown object '{}'{}", name, meant(name)));
  }

  void check_attributes(const ObjectType& type, Span name_span,
                        std::vector<AttributeSyntax>& attributes) {
    std::vector<bool> given(type.attributes.size(), false);
    for (AttributeSyntax& attribute : attributes) {
      const std::string_view name = symbols_.name(attribute.name.symbol);
      attribute.index = find_attribute(type, name);
      if (attribute.index == type.attributes.size()) {
        // The attribute that was meant is not missing.
        const std::size_t meant = unknown_attribute(type, attribute.name.span, name);
        if (meant < given.size()) given[meant] = true;
      } else if (given[attribute.index]) {
        reporter_.error(attribute.name.span,
                        text::format("the attribute '{}' is given twice", name));
      } else {
        given[attribute.index] = true;
        // A rule of its own means that the script's unit, degrees, is not the core's.
        if (!type.attributes[attribute.index].rule.empty())
          refuse_angle(*attribute.value, text::format("'{}'", name));
      }
    }
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (type.attributes[i].required && !given[i])
        missing.push_back(text::format("'{}'", type.attributes[i].name));
    }
    if (missing.empty()) return;
    reporter_.error(name_span,
                    text::format("{} needs the attribute{} {}", type.name,
                                 missing.size() > 1 ? "s" : "", enumerate(missing, "and")));
  }

  /// Refuses <rotate vec3(0, 45deg, 0)>, as that would be 45 degrees in radians taken for degrees.
  void check_modifiers(const Modified& modified) {
    for (const Modifier& modifier : modified.modifiers) {
      const auto* vector = std::get_if<Call>(&modifier.operand->node);
      const auto* name = vector ? std::get_if<Name>(&vector->callee->node) : nullptr;
      if (modifier.kind != ModifierKind::rotate || !name) continue;
      if (symbols_.name(name->symbol) != "vec3") continue;
      for (const Expression* angle : vector->arguments) refuse_angle(*angle, "'rotate'");
    }
  }

 private:
  /// Refuses an angle with a unit, which is one in radians, where degrees are to be.
  void refuse_angle(const Expression& value, const std::string& what) {
    if (const Expression* angle = written_angle(value)) {
      reporter_.error(angle->span, text::format("{} is in degrees already: write the number alone, "
                                                "without a unit",
                                                what));
    }
  }

  /// Reports an unknown attribute. Returns the index of the one that was most likely meant, or the
  /// number of attributes if none was.
  std::size_t unknown_attribute(const ObjectType& type, Span span, std::string_view name) {
    std::vector<std::string_view> names;
    std::vector<std::string> listed;
    for (const AttributeType& attribute : type.attributes) {
      names.push_back(attribute.name);
      listed.emplace_back(attribute.name);
    }
    std::string hint = did_you_mean(name, names);
    if (hint.empty()) hint = text::format("; {} has {}", type.name, enumerate(listed, "and"));
    if (compat_ == compat_2015) {
      reporter_.warning(span, text::format("unknown attribute '{}' is passed over{}", name, hint));
      return type.attributes.size();
    }
    reporter_.error(span, text::format("unknown attribute '{}'{}", name, hint));
    return find_attribute(type, nearest(name, names));
  }

  int compat_;
  const SymbolTable& symbols_;
  Reporter& reporter_;
};

/// Collects the names that a statement assigns to, to any depth, but not those in the bodies of
/// macros.
class AssignedNames : public TreeWalk<AssignedNames> {
 public:
  using TreeWalk::operator();

  explicit AssignedNames(std::set<Symbol>& names) : names_(names) {}

  void operator()(const MacroLiteral&) {}
  void operator()(const Assignment& assignment) {
    names_.insert(assignment.name.symbol);
    visit(assignment.value);
  }
  void operator()(const Destructuring& assignment) {
    for (const NamePlace& name : assignment.names) names_.insert(name.symbol);
    visit(assignment.value);
  }
  void operator()(const Import& import) {
    if (import.name) names_.insert(import.name->symbol);
  }

 private:
  std::set<Symbol>& names_;
};

}  // namespace

void check(Script& script, int compat, const SymbolTable& symbols, Reporter& reporter) {
  ScriptChecker checker(compat, symbols, reporter);
  const Span* settings_span = nullptr;
  const Span* scene_span = nullptr;
  const auto only_one = [&](const Span*& first, const Span& span, const char* name) {
    if (first)
      reporter.error(span, text::format("a script has one {} block, and this is another", name));
    first = &span;
  };
  for (Expression& expression : script.expressions) {
    if (auto* object = std::get_if<ObjectLiteral>(&expression.node)) checker.check_object(*object);
    if (const auto* modified = std::get_if<Modified>(&expression.node))
      checker.check_modifiers(*modified);
  }
  for (Statement& statement : script.statements.statements) {
    if (auto* settings = std::get_if<SettingsBlock>(&statement.node)) {
      only_one(settings_span, settings->keyword, "Settings");
      checker.check_attributes(settings_type(), settings->keyword, settings->attributes);
    }
    if (const auto* scene = std::get_if<SceneBlock>(&statement.node))
      only_one(scene_span, scene->keyword, "Scene");
  }
}

void collect_assigned(const Statement& statement, std::set<Symbol>& names) {
  std::visit(AssignedNames(names), statement.node);
}

void collect_assigned(const Block& block, std::set<Symbol>& names) {
  for (const Statement& statement : block.statements) collect_assigned(statement, names);
}

}  // namespace crt::lang
