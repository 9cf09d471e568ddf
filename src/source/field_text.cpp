#include <fmt/format.h>

#include <map>

#include "core/geometry/implicit/field_node.hpp"
#include "crt/error.hpp"
#include "source/shapes.hpp"

namespace crt::source {

namespace {

using core::FieldNode;
using core::FieldOperation;

/// A FieldWriter writes each node once, however often it occurs.
class FieldWriter {
 public:
  explicit FieldWriter(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  const std::string& text(const FieldNode& node) {
    const auto found = texts_.find(&node);
    if (found != texts_.end()) return found->second;
    std::string text = written(node);
    if (text.size() > most_bytes_) {
      throw Error(ErrorCode::limit,
                  fmt::format("a field would be longer than {} bytes", most_bytes_));
    }
    return texts_[&node] = std::move(text);
  }

 private:
  std::string written(const FieldNode& node) {
    switch (node.operation) {
      case FieldOperation::constant:
        return number(node.number);
      case FieldOperation::x:
        return "x";
      case FieldOperation::y:
        return "y";
      case FieldOperation::z:
        return "z";
      case FieldOperation::negate:
        return fmt::format("(-{})", text(*node.a));
      case FieldOperation::add:
        return binary(node, "+");
      case FieldOperation::subtract:
        return binary(node, "-");
      case FieldOperation::multiply:
        return binary(node, "*");
      case FieldOperation::divide:
        return binary(node, "/");
      case FieldOperation::square:
        return fmt::format("({} ** 2)", text(*node.a));
      case FieldOperation::whole_power:
      case FieldOperation::power:
        return fmt::format("({} ** {})", text(*node.a), number(node.number));
      default:
        return function(node);
    }
  }

  std::string function(const FieldNode& node) {
    const std::string name = name_of(node.operation);
    return node.b ? fmt::format("{}({}, {})", name, text(*node.a), text(*node.b))
                  : fmt::format("{}({})", name, text(*node.a));
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

  static std::string number(double value) {
    return value < 0 ? fmt::format("({})", value) : Syntax::number(value);
  }

  std::string binary(const FieldNode& node, const char* sign) {
    return fmt::format("({} {} {})", text(*node.a), sign, text(*node.b));
  }

  std::size_t most_bytes_;
  std::map<const FieldNode*, std::string> texts_;
};

}  // namespace

std::string field_text(const Field& field, std::size_t most_bytes) {
  std::string text = FieldWriter(most_bytes).text(field.node());
  const bool is_in_brackets = text.size() > 2 && text.front() == '(' && text.back() == ')';
  return is_in_brackets ? text.substr(1, text.size() - 2) : text;
}

}  // namespace crt::source
