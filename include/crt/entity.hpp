#pragma once

#include <array>
#include <concepts>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <crt/transform.hpp>
#include <cstdint>
#include <memory>
#include <span>

namespace crt {

class Entity;
struct EntityNode;

/// One of the primitives' structs: Sphere, Box, ...
template <class Shape>
concept PrimitiveShape = !std::same_as<Shape, Primitive> && !std::same_as<Shape, Entity> &&
                         std::constructible_from<Primitive, Shape>;

/// Something in a scene: a primitive, or several combined by constructive solid geometry, placed by
/// transforms. An immutable value: copies share, and any thread may use it. Combining and placing
/// are O(1) and give new entities.
class Entity {
 public:
  /// Takes any primitive; throws Error (invalid_argument) naming the field that is out of range.
  Entity(Primitive primitive);  // NOLINT(google-explicit-constructor): a primitive is an entity

  /// The same for a primitive as it stands in the code: Sphere{...}.
  template <PrimitiveShape Shape>
  Entity(Shape shape)  // NOLINT(google-explicit-constructor): Sphere{...} + Box{...} is to read as
                       // it does
      : Entity(Primitive(std::move(shape))) {}

  /// Internal: takes a node of the tree.
  explicit Entity(std::shared_ptr<const EntityNode> node) : node_(std::move(node)) {}

  /// This entity moved by `transform`, after whatever moved it before. A transform that flattens
  /// space (no inverse) or has a number that is not finite is an error.
  Entity transformed(const Transform& transform) const;

  /// This entity with `material` on every part that has no material of its own.
  Entity with_material(SharedMaterial material) const;

  /// This entity under a number of the caller's choice, reported in hits. Without one it is the
  /// entity's place in Scene::entities. The outermost id holds.
  Entity with_id(std::uint32_t id) const;

  /// Whether it has an inside: false if any part of it is a mere surface (Disc, Triangle,
  /// HalfPlane).
  bool is_solid() const;

  /// Whether there is nothing of it: see empty_entity().
  bool is_empty() const;

  /// How many primitives it is made of, a part that occurs twice counted twice (saturating).
  std::uint64_t primitive_count() const;

  /// Internal: the tree of what was combined and placed.
  const EntityNode& node() const { return *node_; }
  /// Internal: the same, to hold on to.
  const std::shared_ptr<const EntityNode>& shared_node() const { return node_; }

 private:
  std::shared_ptr<const EntityNode> node_;
};

/// Union: what is in either. Parts keep their materials. Surfaces may take part in it.
Entity operator+(const Entity& a, const Entity& b);

/// Difference: what is in `a` and not in `b`; the cut has b's material. Both must be solids.
Entity operator-(const Entity& a, const Entity& b);

/// Intersection: what is in both. Both must be solids. (C++ gives ^ a low precedence: bracket it.)
Entity operator^(const Entity& a, const Entity& b);

/// Unions, intersections and differences of many; at least one part each.
Entity csg_union(std::span<const Entity> parts);
Entity csg_intersection(std::span<const Entity> parts);
/// `from` without any of the cutters (there may be none).
Entity csg_difference(const Entity& from, std::span<const Entity> cutters);

/// Nothing: the solid without a point, what is left of a sphere whose radius shrinks to 0. No ray
/// meets it. Combined it is what the empty set is: `a + nothing` and `a - nothing` are `a`, `a ^
/// nothing` and `nothing - a` are nothing; moving it or giving it a material or an id changes
/// nothing.
Entity empty_entity();

/// The corners of a triangle of a mesh, by their places in the list of positions.
using TriangleIndices = std::array<std::uint32_t, 3>;

/// A surface of many triangles with shared corners: a union of Triangle. Triangles without an area
/// are left out; throws Error (invalid_argument) if that leaves none, for an index that is out of
/// range, and as Triangle does.
Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles);

}  // namespace crt
