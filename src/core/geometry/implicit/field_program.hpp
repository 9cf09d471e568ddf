// A field is evaluated as a flat program: one step for each operation, equal ones once.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry/implicit/field_node.hpp"
#include "core/math/dyadic.hpp"

namespace crt::core {

/// A FieldStep puts the result of an operation on one or two registers into a register.
struct FieldStep {
  FieldOperation operation = FieldOperation::constant;
  std::uint16_t result = 0;
  std::uint16_t a = 0;
  std::uint16_t b = 0;
  double number = 0;
  const ProfileDistance* profile = nullptr;

  friend bool operator==(const FieldStep&, const FieldStep&) = default;
};

class FieldProgram {
 public:
  /// Throws Error (invalid_argument) for a field that takes too many steps or registers.
  explicit FieldProgram(const Field& field);

  /// Returns the program of a field, which is made once. Throws as the constructor does.
  static std::shared_ptr<const FieldProgram> of(const Field& field);

  /// The last step has the value of the field.
  const std::vector<FieldStep>& steps() const { return steps_; }

  static constexpr std::size_t most_steps = 4096;
  static constexpr std::size_t max_registers = 256;

  /// Returns numbers that are equal for equal programs alone.
  std::vector<Dyadic> numbers() const;

  std::size_t bytes() const;

 private:
  std::vector<FieldStep> steps_;
  std::vector<std::shared_ptr<const ProfileDistance>> profiles_;  ///< those of the steps
};

}  // namespace crt::core
