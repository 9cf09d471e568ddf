// The functions of an implicit solid's faces, for questions about boxes (face_functions.hpp): the
// field, and those of its box.
#pragma once

#include <memory>

#include "core/geometry/box/functions.hpp"
#include "core/geometry/implicit/field_program.hpp"

namespace crt::core {

struct ImplicitFunctions {
  static constexpr bool has_series = false;
  static constexpr std::uint32_t field = 0;  ///< those of the box follow

  std::shared_ptr<const FieldProgram> program;
  BoxFunctions box_functions;

  static constexpr int max_crossings(std::uint32_t face) { return face == field ? 0 : 1; }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  /// Nothing is known of the field where it may have no value.
  Interval value(std::uint32_t face, const PointOf<Interval>& point) const;
  Jet value(std::uint32_t face, const PointOf<Jet>& point) const;
};

}  // namespace crt::core
