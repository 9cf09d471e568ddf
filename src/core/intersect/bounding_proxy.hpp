// Conservative tests spare most exact ones: they say whether a line surely misses an object, or
// surely meets it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/geometry/placed_solid.hpp"

namespace crt::core {

/// A BoundingProxy is an object as the conservative tests see it. It is small, as rays come by many
/// of them.
struct BoundingProxy {
  /// What encloses the object. Without it every ray that comes to the object's box is tested.
  const PlacedSolid* solid = nullptr;
  /// The leaf that the object is, if Shape::span() gives its crossings: in the standard tier.
  const Leaf* leaf = nullptr;
  const FaceSurface* faces = nullptr;  ///< of what the solid is made of
  std::uint32_t face_count = 0;        ///< 0 if no start on a face makes a difference
  std::uint32_t object = invalid_index;
  std::uint32_t leaf_index = invalid_index;  ///< of a lone leaf
  /// The object is merely somewhere within the solid: only what misses that is sure.
  bool is_within = false;
  bool has_quick_spans = false;          ///< of the leaf
  PassingRays passed_by = passing_none;  ///< these rays do not meet the object

  /// Returns whether rays that surely meet the solid meet the object.
  bool is_met_with_solid() const { return solid != nullptr && !is_within; }
};

/// EarlierProxies are those of a scene that another one has objects from.
struct EarlierProxies {
  const CompiledScene& scene;
  std::span<const std::uint32_t> objects;     ///< by object of the other scene its number here
  bool keeps_numbers;                         ///< of objects, leaves and faces in the other scene
  std::vector<const BoundingProxy*> proxies;  ///< by object here
};

/// BoundingProxies are those of some objects of a scene, which must outlive them. The number of an
/// object may be invalid_index: its place is left empty.
struct BoundingProxies {
  std::vector<BoundingProxy> list;
  /// Those of the list's proxies that are not from an earlier scene have these.
  std::vector<std::unique_ptr<const PlacedSolid>> solids;

  BoundingProxies() = default;
  BoundingProxies(const CompiledScene& scene, std::span<const std::uint32_t> objects,
                  const Workers& workers = {}, const EarlierProxies* earlier = nullptr);
};

}  // namespace crt::core
