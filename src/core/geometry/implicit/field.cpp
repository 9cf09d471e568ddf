// Fields are put together from nodes here.
#include "crt/field.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/implicit/field_node.hpp"
#include "core/geometry/implicit/profile_distance.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

Field FieldNode::make(FieldOperation operation, double number, const Field* a, const Field* b,
                      std::shared_ptr<const ProfileDistance> profile) {
  auto node = std::make_shared<FieldNode>();
  node->operation = operation;
  node->number = number;
  node->profile = std::move(profile);
  for (const auto& [operand, place] : {std::pair{a, &node->a}, std::pair{b, &node->b}}) {
    if (operand == nullptr) continue;
    *place = operand->node_;
    node->depth = std::max(node->depth, operand->node_->depth + 1);
  }
  if (node->depth > deepest_field) {
    throw Error(ErrorCode::invalid_argument,
                text::format("field has more than {} operations within one another", deepest_field),
                "field");
  }
  return Field(std::move(node));
}

namespace {

Field of_one(FieldOperation operation, const Field& a) {
  return FieldNode::make(operation, 0, &a);
}

Field of_two(FieldOperation operation, const Field& a, const Field& b) {
  return FieldNode::make(operation, 0, &a, &b);
}

}  // namespace

}  // namespace core

using core::FieldNode;
using core::FieldOperation;

Field::Field(double constant) {
  if (!std::isfinite(constant)) {
    throw Error(ErrorCode::invalid_argument,
                text::format("field has a number that is not finite ({})", constant), "field");
  }
  *this = FieldNode::make(FieldOperation::constant, constant);
}

Field Field::x() {
  return FieldNode::make(FieldOperation::x);
}
Field Field::y() {
  return FieldNode::make(FieldOperation::y);
}
Field Field::z() {
  return FieldNode::make(FieldOperation::z);
}

Field operator-(const Field& a) {
  return core::of_one(FieldOperation::negate, a);
}
Field operator+(const Field& a, const Field& b) {
  return core::of_two(FieldOperation::add, a, b);
}
Field operator-(const Field& a, const Field& b) {
  return core::of_two(FieldOperation::subtract, a, b);
}
Field operator*(const Field& a, const Field& b) {
  if (&a.node() == &b.node()) return core::of_one(FieldOperation::square, a);
  return core::of_two(FieldOperation::multiply, a, b);
}
Field operator/(const Field& a, const Field& b) {
  return core::of_two(FieldOperation::divide, a, b);
}

Field pow(const Field& a, double exponent) {
  if (!std::isfinite(exponent)) return a * Field(exponent);  // which throws
  if (exponent == 0) return 1;
  if (exponent == 1) return a;
  if (exponent == 2) return core::of_one(FieldOperation::square, a);
  if (exponent < 0) return 1 / pow(a, -exponent);
  const bool is_whole = exponent == std::floor(exponent);
  return FieldNode::make(is_whole ? FieldOperation::whole_power : FieldOperation::power, exponent,
                         &a);
}
Field pow(const Field& a, const Field& exponent) {
  if (exponent.node().operation == FieldOperation::constant) return pow(a, exponent.node().number);
  return exp(exponent * log(a));
}
Field sqrt(const Field& a) {
  return core::of_one(FieldOperation::square_root, a);
}
Field abs(const Field& a) {
  return core::of_one(FieldOperation::absolute, a);
}
Field min(const Field& a, const Field& b) {
  return core::of_two(FieldOperation::minimum, a, b);
}
Field max(const Field& a, const Field& b) {
  return core::of_two(FieldOperation::maximum, a, b);
}
Field sin(const Field& a) {
  return core::of_one(FieldOperation::sine, a);
}
Field cos(const Field& a) {
  return core::of_one(FieldOperation::cosine, a);
}
Field tan(const Field& a) {
  return core::of_one(FieldOperation::tangent, a);
}
Field asin(const Field& a) {
  return core::of_one(FieldOperation::arc_sine, a);
}
Field acos(const Field& a) {
  return core::of_one(FieldOperation::arc_cosine, a);
}
Field atan(const Field& a) {
  return core::of_one(FieldOperation::arc_tangent, a);
}
Field atan2(const Field& y, const Field& x) {
  return core::of_two(FieldOperation::arc_tangent_of_two, y, x);
}
Field profile_distance(const std::shared_ptr<const Profile>& profile, const Field& x,
                       const Field& y) {
  if (!profile) throw Error(ErrorCode::invalid_argument, "profile must be given", "profile");
  return FieldNode::make(FieldOperation::profile_distance, 0, &x, &y,
                         std::make_shared<const core::ProfileDistance>(profile));
}
Field exp(const Field& a) {
  return core::of_one(FieldOperation::exponential, a);
}
Field log(const Field& a) {
  return core::of_one(FieldOperation::logarithm, a);
}
Field floor(const Field& a) {
  return core::of_one(FieldOperation::floor, a);
}
Field ceil(const Field& a) {
  return core::of_one(FieldOperation::ceiling, a);
}
Field round(const Field& a) {
  return core::of_one(FieldOperation::round, a);
}

}  // namespace crt
