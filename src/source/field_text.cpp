
#include <array>
#include <limits>
#include <map>

#include "core/geometry/implicit/field_node.hpp"
#include "core/geometry/implicit/profile_distance.hpp"
#include "core/geometry/profile/profile.hpp"
#include "crt/error.hpp"
#include "source/shapes.hpp"
#include "text/format.hpp"

namespace crt::source {

namespace {

using core::FieldNode;
using core::FieldOperation;

/// A FieldWriter writes each node once, however often it occurs. It may name what is long, by
/// statements of a macro, so that no expression has many brackets within one another.
class FieldWriter {
 public:
  FieldWriter(std::size_t most_bytes, bool names_parts)
      : max_bytes_(most_bytes), names_parts_(names_parts) {}

  /// Returns the statements that name parts, and the coordinates among the operands: "x, z".
  const std::string& statements() const { return statements_; }
  std::string coordinates() const {
    std::vector<std::string> names;
    for (std::size_t axis = 0; axis < uses_.size(); ++axis) {
      if (uses_[axis]) names.emplace_back(1, "xyz"[axis]);
    }
    return joined("", names, "");
  }

  const std::string& text(const FieldNode& node) {
    const auto found = texts_.find(&node);
    if (found != texts_.end()) return found->second;
    std::string text = written(node);
    if (text.size() > max_bytes_) {
      throw Error(ErrorCode::limit,
                  text::format("a field would be longer than {} bytes", max_bytes_));
    }
    if (names_parts_ && text.size() > max_inline) {
      const std::string name = text::format("part_{}", ++parts_);
      statements_ += text::format("    {} = {}\n", name, text);
      text = name;
    }
    return texts_[&node] = std::move(text);
  }

 private:
  std::string written(const FieldNode& node) {
    switch (node.operation) {
      case FieldOperation::constant:
        return number(node.number);
      case FieldOperation::x:
        return coordinate(0);
      case FieldOperation::y:
        return coordinate(1);
      case FieldOperation::z:
        return coordinate(2);
      case FieldOperation::negate:
        return text::format("(-{})", text(*node.a));
      case FieldOperation::add:
        return binary(node, "+");
      case FieldOperation::subtract:
        return binary(node, "-");
      case FieldOperation::multiply:
        return binary(node, "*");
      case FieldOperation::divide:
        return binary(node, "/");
      case FieldOperation::square:
        return text::format("({} ** 2)", text(*node.a));
      case FieldOperation::whole_power:
      case FieldOperation::power:
        return text::format("({} ** {})", text(*node.a), Syntax::number(node.number));
      case FieldOperation::profile_distance:
        return text::format("profileDistance({}, {}, {})",
                            contour_lists(Syntax(SourceLanguage::script), *node.profile->profile()),
                            text(*node.a), text(*node.b));
      default:
        return function(node);
    }
  }

  std::string function(const FieldNode& node) {
    const std::string name = name_of(node.operation);
    return node.b ? text::format("{}({}, {})", name, text(*node.a), text(*node.b))
                  : text::format("{}({})", name, text(*node.a));
  }

  static const char* name_of(FieldOperation operation) {
    switch (operation) {
      case FieldOperation::square_root:
        return "sqrt";
      case FieldOperation::absolute:
        return "abs";
      case FieldOperation::minimum:
        return "min";
      case FieldOperation::maximum:
        return "max";
      case FieldOperation::sine:
        return "sin";
      case FieldOperation::cosine:
        return "cos";
      case FieldOperation::tangent:
        return "tan";
      case FieldOperation::arc_sine:
        return "asin";
      case FieldOperation::arc_cosine:
        return "acos";
      case FieldOperation::arc_tangent:
        return "atan";
      case FieldOperation::arc_tangent_of_two:
        return "atan2";
      case FieldOperation::exponential:
        return "exp";
      case FieldOperation::logarithm:
        return "log";
      case FieldOperation::floor:
        return "floor";
      case FieldOperation::ceiling:
        return "ceil";
      case FieldOperation::round:
        return "round";
      default:
        throw Error(ErrorCode::internal, "an operation of fields has no name");
    }
  }

  std::string coordinate(std::size_t axis) {
    uses_[axis] = true;
    return {"xyz"[axis]};
  }

  /// Returns a Float. Whole numbers would be divided as such.
  static std::string number(double value) {
    std::string text = Syntax::number(value);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text.front() == '-' ? "(" + text + ")" : text;
  }

  std::string binary(const FieldNode& node, const char* sign) {
    return text::format("({} {} {})", text(*node.a), sign, text(*node.b));
  }

  static constexpr std::size_t max_inline = 80;

  std::size_t max_bytes_;
  bool names_parts_;
  std::map<const FieldNode*, std::string> texts_;
  std::array<bool, 3> uses_{};
  int parts_ = 0;
  std::string statements_;
};

std::string without_brackets(const std::string& text) {
  const bool is_in_brackets = text.size() > 2 && text.front() == '(' && text.back() == ')';
  return is_in_brackets ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

std::string field_text(const Field& field, std::size_t most_bytes) {
  return without_brackets(FieldWriter(most_bytes, false).text(field.node()));
}

std::string field_value(Program& program, const Field& field) {
  if (std::string known = program.known(&field.node()); !known.empty()) return known;
  FieldWriter writer(std::numeric_limits<std::size_t>::max(), true);
  const std::string text = writer.text(field.node());
  if (writer.statements().empty()) return without_brackets(text);
  program.refuse_in_2015("macros that return a value");
  const std::string name = program.new_name("field");
  const std::string coordinates = writer.coordinates();
  program.add_block(text::format("{} = Macro ({}) {{\n{}    return {}\n}}\n", name, coordinates,
                                 writer.statements(), text));
  return program.remember(&field.node(), text::format("{}({})", name, coordinates));
}

}  // namespace crt::source
