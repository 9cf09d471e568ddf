// Some shapes have conservative tests for their own type.
#pragma once

#include <variant>

namespace crt::core {

class BoxShape;
class FrustumShape;
class PlaneShape;
class SphereShape;
class TorusShape;

/// A TypedShape is a shape by its own type where there are conservative tests for that, and nothing
/// for all others.
using TypedShape = std::variant<std::monostate, const SphereShape*, const BoxShape*,
                                const PlaneShape*, const FrustumShape*, const TorusShape*>;

/// Returns the shape of that type, or null if it is another.
template <class Kind>
const Kind* shape_as(const TypedShape& typed) {
  const auto* shape = std::get_if<const Kind*>(&typed);
  return shape == nullptr ? nullptr : *shape;
}

}  // namespace crt::core
