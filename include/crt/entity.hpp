#pragma once

#include <concepts>
#include <crt/bounding_box.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <crt/transform.hpp>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace crt {

class Entity;
struct EntityNode;

/// Holds for each of the primitives' structs: Sphere, Box, ...
template <class Shape>
concept PrimitiveShape = !std::same_as<Shape, Primitive> && !std::same_as<Shape, Entity> &&
                         std::constructible_from<Primitive, Shape>;

/// An Entity is something in a scene: a primitive, or several combined by constructive solid
/// geometry, placed by transforms. It is an immutable value: copies share, and any thread may use
/// it. Combining and placing are O(1) and give new entities. Placing copies of one entity a million
/// times is cheap: what they share is prepared once (docs/architecture.md, Preparing).
class Entity {
 public:
  /// Takes any primitive. Throws Error (invalid_argument) naming the field that is out of range.
  Entity(Primitive primitive);  // NOLINT(google-explicit-constructor): a primitive is an entity

  /// Takes a primitive as it stands in the code, such as Sphere{...}. It throws as the constructor
  /// above.
  template <PrimitiveShape Shape>
  Entity(Shape shape)  // NOLINT(google-explicit-constructor): Sphere{...} + Box{...} is to read as
                       // it does
      : Entity(Primitive(std::move(shape))) {}

  /// Takes a node of the tree. This is internal.
  explicit Entity(std::shared_ptr<const EntityNode> node) : node_(std::move(node)) {}

  /// Returns this entity moved by `transform`, after whatever moved it before. Throws Error
  /// (invalid_argument) for a transform that flattens space (no inverse) or has a number that is
  /// not finite.
  Entity transformed(const Transform& transform) const;

  /// Returns this entity with `material` on every part that has no material of its own. A part that
  /// has one, from its maker or an earlier call, keeps it. That of MeshAttributes gives way.
  Entity with_material(SharedMaterial material) const;

  /// Returns this entity under a number of the caller's choice, which hits report. Without one,
  /// hits report the entity's place in Scene::entities. The outermost id holds for the entity, and
  /// the innermost for the part that it was given to (see HitPart).
  Entity with_id(std::uint32_t id) const;

  /// Returns this entity with a number of the caller's choice for all its parts that have none,
  /// such as a pointer or a key. FullHit and Location report it, and 0 for parts without one. The
  /// innermost one holds. Scripts cannot say it.
  Entity with_user(std::uint64_t user) const;

  /// Returns this entity as one that casts a shadow or none. Without one, light passes it on its
  /// way to what it lights. Mirrors, glass and the camera still see it. The last call holds. It is
  /// of whole entities of a scene: combining one that casts none with others throws Error
  /// (invalid_argument).
  Entity with_shadow(bool casts) const;

  /// Returns this entity as one that the camera sees or not. If it does not, its rays pass the
  /// entity as if that were not there. Mirrors, glass and shadows still show it, and ray queries
  /// meet it. Otherwise as with_shadow().
  Entity with_visible(bool visible) const;

  /// Says whether it casts a shadow: see with_shadow().
  bool casts_shadow() const;

  /// Says whether the camera sees it: see with_visible().
  bool is_visible() const;

  /// Says whether it has an inside. It has none if any part of it is a mere surface (Disc,
  /// Triangle, HalfPlane, or a Mesh that is open).
  bool is_solid() const;

  /// Says why it has no inside, by the first part that has none: of a mesh which edge is open, and
  /// how many are. It is empty for a solid.
  std::string solid_fault() const;

  /// Says whether it has no points at all: see empty_entity().
  bool is_empty() const;

  /// Returns how many primitives it is made of. A part that occurs twice is counted twice, and a
  /// mesh as often as it has triangles. The count saturates.
  std::uint64_t primitive_count() const;

  /// Returns the tree of what was combined and placed. This is internal.
  const EntityNode& node() const { return *node_; }
  /// Returns the same tree, as a pointer that can be kept. This is internal.
  const std::shared_ptr<const EntityNode>& shared_node() const { return node_; }

 private:
  std::shared_ptr<const EntityNode> node_;
};

/// This is the id of what is hit where nothing is.
inline constexpr std::uint32_t no_entity_id = 0xffffffff;

/// Returns a box that holds the entity, rounded outwards. It may be larger than the smallest one:
/// of a difference it holds what is cut from. It takes O(n log n) for n primitives. Throws Error
/// (limit, out_of_memory) as prepare() does.
BoundingBox bounding_box(const Entity& entity);

/// Returns the union: what is in either. Parts keep their materials. Surfaces may take part in it.
Entity operator+(const Entity& a, const Entity& b);

/// Returns the difference: what is in `a` and not in `b`. The cut has b's material. Both must be
/// solids.
Entity operator-(const Entity& a, const Entity& b);

/// Returns the intersection: what is in both. Both must be solids. (C++ gives ^ a low precedence,
/// so put it in brackets.)
Entity operator^(const Entity& a, const Entity& b);

/// Returns the union of all parts, of which there is at least one.
Entity csg_union(std::span<const Entity> parts);
/// Returns the intersection of all parts, of which there is at least one.
Entity csg_intersection(std::span<const Entity> parts);
/// Returns `from` without any of the cutters. There may be no cutters.
Entity csg_difference(const Entity& from, std::span<const Entity> cutters);

/// Returns the solid without a point, which is what is left of a sphere whose radius shrinks to 0.
/// No ray meets it. In combinations it behaves as the empty set: `a + nothing` and `a - nothing`
/// are `a`, `a ^ nothing` and `nothing - a` are nothing. Moving it or giving it a material or an id
/// changes nothing.
Entity empty_entity();

/// Makes a Mesh of triangles with shared corners, as mesh_triangles() does: a solid if they are
/// closed, and else a surface.
Entity triangle_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles);

/// Makes an Extrusion of a profile from one point to another, at least 1e-100 apart. The profile's
/// origin is at `from`, and its plane is across the axis. Its x axis is where angles about the axis
/// begin: along z as far as that is across the axis, or along x if the axis is mostly along z. Its
/// y axis is a quarter of a turn from there about the axis. So from (0, 0, a) to (0, 0, b), with a
/// < b, x and y are those of the scene, and nothing is rounded. Throws Error (invalid_argument) as
/// the primitives do.
Entity extruded(const std::shared_ptr<const Profile>& profile, const Vec3& from, const Vec3& to);

/// Makes a Revolution of a profile about the axis from one point towards another, at least 1e-100
/// apart. Heights y of the profile are from `from` on, in scene units. It starts where angles about
/// the axis begin, which extruded() says, and turns by `angle` (in radians). So about the y axis
/// nothing is rounded. Throws Error (invalid_argument) as the primitives do.
Entity revolved(const std::shared_ptr<const Profile>& profile, const Vec3& from, const Vec3& to,
                double angle);

}  // namespace crt
