// An open program is what is left of a CSG program in a part of space where some of its leaves are
// decided: no point there is inside of them, or every point is.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/csg/program.hpp"

namespace crt::core {

struct OpenProgram {
  /// A Node is true if `needed` of its open children are. Parents stand before their children.
  struct Node {
    std::uint32_t parent = 0;
    std::uint32_t needed = 1;
    std::uint32_t open = 1;
  };
  struct OpenLeaf {
    std::uint32_t leaf = 0;  ///< within the object
    std::uint32_t parent = 0;
  };

  std::vector<Node> nodes;
  std::vector<OpenLeaf> leaves;

  /// Makes that of a lone leaf.
  static OpenProgram of_leaf();
  static OpenProgram of(const CsgProgram& program);

  /// Returns the value of the root for values of the open leaves.
  bool value(std::span<const bool> leaves_true) const;
};

/// A LeafValue is what is known of a leaf.
enum class LeafValue : std::uint8_t { open, always_false, always_true };

/// Decides the leaves that are not open. Returns the value of the root if that decides it, and else
/// nothing. Then `rest` is what is left.
std::optional<bool> decide(const OpenProgram& program, std::span<const LeafValue> values,
                           OpenProgram& rest);

}  // namespace crt::core
