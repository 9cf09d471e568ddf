// A field is a graph of nodes, which fields share and nothing changes.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>

#include "crt/field.hpp"

namespace crt::core {

enum class FieldOperation : std::uint8_t {
  constant,
  x,
  y,
  z,
  negate,
  add,
  subtract,
  multiply,
  divide,
  square,
  whole_power,  ///< to the power of `number`, which is whole
  power,        ///< to the power of `number`
  square_root,
  absolute,
  minimum,
  maximum,
  sine,
  cosine,
  tangent,
  arc_sine,
  arc_cosine,
  arc_tangent,
  arc_tangent_of_two,
  exponential,
  logarithm,
  floor,
  ceiling,
  round,
  profile_distance,  ///< of a point of the plane
};

class FieldProgram;
class ProfileDistance;

struct FieldNode {
  FieldOperation operation = FieldOperation::constant;
  double number = 0;
  std::shared_ptr<const FieldNode> a{};
  std::shared_ptr<const FieldNode> b{};
  std::shared_ptr<const ProfileDistance> profile{};
  std::uint32_t depth = 1;  ///< counts the operations within one another

  /// All solids of a field share its program, which is made when the first of them is.
  mutable std::once_flag program_once{};
  mutable std::shared_ptr<const FieldProgram> program{};

  /// Makes a field of an operation. Throws Error (invalid_argument) if it is too deep.
  static Field make(FieldOperation operation, double number = 0, const Field* a = nullptr,
                    const Field* b = nullptr, std::shared_ptr<const ProfileDistance> profile = {});
};

/// More operations within one another would take too much of the stack.
inline constexpr std::uint32_t deepest_field = 1024;

}  // namespace crt::core
