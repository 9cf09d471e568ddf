#include "crt/entity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <limits>

#include "core/entity/entity_node.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/shape.hpp"
#include "crt/error.hpp"

namespace crt {

namespace {

template <class Count>
Count saturating_sum(Count a, Count b) {
  constexpr Count most = std::numeric_limits<Count>::max();
  return a > most - b ? most : a + b;
}

Entity make_entity(EntityNode::Content content) {
  return Entity(std::make_shared<const EntityNode>(std::move(content)));
}

/// Returns a wrapper of the entity to add to: its own, or a new one that changes nothing.
EntityWrapper wrapper_of(const Entity& entity) {
  if (const auto* wrapper = std::get_if<EntityWrapper>(&entity.node().content)) return *wrapper;
  EntityWrapper wrapper;
  wrapper.child = entity.shared_node();
  return wrapper;
}

void require_solid(const Entity& entity, const char* operation) {
  if (entity.is_solid()) return;
  throw Error(ErrorCode::invalid_argument,
              std::string("an operand of the ") + operation +
                  " has no inside, and only solids can be cut: " + entity.solid_fault());
}

/// Refuses a part that light or the camera are to pass, as they could not tell it from the others.
void require_usual_rays(const Entity& part) {
  if (part.casts_shadow() && part.is_visible()) return;
  const std::string name = part.is_visible() ? "shadow" : "visible";
  throw Error(ErrorCode::invalid_argument,
              "a part of a combination has '" + name +
                  "' false, which is of whole entities: give it to the combination instead",
              name);
}

/// Combines the parts that are not empty. Empty ones must make no difference, so the first part of
/// a difference must not be empty.
Entity combine(CsgOperator op, std::span<const Entity> parts) {
  CsgOperation operation{.op = op, .parts = {}};
  operation.parts.reserve(parts.size());
  for (const Entity& part : parts) {
    if (!part.is_empty()) operation.parts.push_back(part.shared_node());
  }
  if (operation.parts.size() == 1) return Entity(std::move(operation.parts.front()));
  for (const EntityPointer& part : operation.parts) require_usual_rays(Entity(part));
  return make_entity(std::move(operation));
}

void require_finite(const Transform& transform) {
  for (const Vec3& v : {transform.row_x, transform.row_y, transform.row_z, transform.translation}) {
    for (int axis = 0; axis < 3; ++axis) {
      if (std::isfinite(v[axis])) continue;
      throw Error(ErrorCode::invalid_argument, "a transform must consist of finite numbers",
                  "transform");
    }
  }
}

constexpr double smallest_scale = 1e-100;
constexpr double largest_scale = 1e100;

/// Refuses transforms that flatten space or leave the range of sizes that geometry is made for.
void require_usable(const core::PreciseTransform& transform) {
  const Transform map = transform.rounded();
  double largest = 0;
  for (const Vec3& v : {map.row_x, map.row_y, map.row_z}) {
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(v[axis]));
  }
  double farthest = 0;
  for (int axis = 0; axis < 3; ++axis)
    farthest = std::max(farthest, std::abs(map.translation[axis]));
  const char* const flat_map = "a transform must not flatten space (it has no inverse)";
  if (largest == 0) throw Error(ErrorCode::invalid_argument, flat_map, "transform");
  if (!(largest >= smallest_scale && largest <= largest_scale && farthest <= largest_scale)) {
    throw Error(ErrorCode::invalid_argument,
                "a transform must keep sizes and places between 1e-100 and 1e100", "transform");
  }
  // The determinant is that of the map with its largest entry brought to about 1, where 0 means
  // flat.
  const double unit = std::ldexp(1.0, -std::ilogb(largest));
  const core::PreciseTransform scaled(
      Transform{map.row_x * unit, map.row_y * unit, map.row_z * unit, Vec3(0)});
  bool flat = !(std::abs(core::determinant(scaled).value()) > std::numeric_limits<double>::min());
  if (!flat) {
    const Transform back = core::inverse(scaled).rounded();
    for (const Vec3& v : {back.row_x, back.row_y, back.row_z}) {
      for (int axis = 0; axis < 3; ++axis) flat = flat || !(std::abs(v[axis]) <= largest_scale);
    }
  }
  if (flat) throw Error(ErrorCode::invalid_argument, flat_map, "transform");
}

using ChainPointer = std::shared_ptr<const core::TransformChain>;

/// Returns what `earlier` (or nothing, if it is null) and then `transform` do together.
ChainPointer transformed_more(ChainPointer earlier, const Transform& transform) {
  if (!earlier) return std::make_shared<const core::TransformChain>(transform);
  struct Both {
    ChainPointer earlier;
    core::TransformChain later;
    core::TransformChain all;
  };
  const core::TransformChain later(transform);
  const core::TransformChain all = core::compose(later, *earlier);
  if (all.is_product()) return std::make_shared<const core::TransformChain>(all);
  const auto both = std::make_shared<Both>(Both{std::move(earlier), later, core::TransformChain{}});
  both->all = core::compose(both->later, *both->earlier);
  return {both, &both->all};
}

}  // namespace

EntityNode::EntityNode(Content new_content) : content(std::move(new_content)) {
  if (const auto* primitive = std::get_if<Primitive>(&content)) {
    solid = core::is_solid(*primitive);
    if (const auto* mesh = std::get_if<Mesh>(primitive)) primitive_count = mesh->triangles->size();
  } else if (const auto* wrapper = std::get_if<EntityWrapper>(&content)) {
    solid = wrapper->child->solid;
    leaf_count = wrapper->child->leaf_count;
    primitive_count = wrapper->child->primitive_count;
  } else {
    leaf_count = 0;
    primitive_count = 0;
    for (const EntityPointer& part : std::get<CsgOperation>(content).parts) {
      solid = solid && part->solid;
      leaf_count = saturating_sum(leaf_count, part->leaf_count);
      primitive_count = saturating_sum(primitive_count, part->primitive_count);
    }
  }
}

EntityNode::~EntityNode() {
  // This is a list of nodes that only this destructor still holds, linked through themselves.
  EntityPointer doomed;
  const auto release = [&doomed](EntityPointer& child) {
    if (child && child.use_count() == 1) {
      // Nobody else can see the node, so it may be changed.
      auto& node =
          const_cast<EntityNode&>(*child);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
      node.next_to_free_ = std::move(doomed);
      doomed = std::move(child);
    }
    child.reset();
  };
  const auto release_children = [&release](Content& held) {
    if (auto* wrapper = std::get_if<EntityWrapper>(&held)) release(wrapper->child);
    if (auto* operation = std::get_if<CsgOperation>(&held)) {
      for (EntityPointer& part : operation->parts) release(part);
    }
  };
  release_children(content);
  while (doomed) {
    auto& node = const_cast<EntityNode&>(*doomed);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    EntityPointer rest = std::move(node.next_to_free_);
    EntityPointer last = std::move(doomed);
    doomed = std::move(rest);
    release_children(node.content);
  }
}

Entity::Entity(Primitive primitive) {
  core::validate(primitive);
  node_ = std::make_shared<const EntityNode>(std::move(primitive));
}

Entity Entity::transformed(const Transform& transform) const {
  require_finite(transform);
  EntityWrapper wrapper = wrapper_of(*this);
  wrapper.to_parent = transformed_more(std::move(wrapper.to_parent), transform);
  require_usable(wrapper.to_parent->product);
  if (is_empty()) return *this;
  return make_entity(std::move(wrapper));
}

Entity Entity::with_material(SharedMaterial material) const {
  if (is_empty()) return *this;
  EntityWrapper wrapper = wrapper_of(*this);
  if (!wrapper.material) wrapper.material = std::move(material);
  return make_entity(std::move(wrapper));
}

Entity Entity::with_id(std::uint32_t id) const {
  if (is_empty()) return *this;
  EntityWrapper wrapper = wrapper_of(*this);
  wrapper.id = id;
  return make_entity(std::move(wrapper));
}

Entity Entity::with_user(std::uint64_t user) const {
  if (is_empty()) return *this;
  EntityWrapper wrapper = wrapper_of(*this);
  if (!wrapper.user) wrapper.user = user;
  return make_entity(std::move(wrapper));
}

Entity Entity::with_shadow(bool casts) const {
  if (is_empty()) return *this;
  EntityWrapper wrapper = wrapper_of(*this);
  wrapper.casts_shadow = casts;
  return make_entity(std::move(wrapper));
}

Entity Entity::with_visible(bool visible) const {
  if (is_empty()) return *this;
  EntityWrapper wrapper = wrapper_of(*this);
  wrapper.visible = visible;
  return make_entity(std::move(wrapper));
}

bool Entity::casts_shadow() const {
  const auto* wrapper = std::get_if<EntityWrapper>(&node_->content);
  return wrapper == nullptr || wrapper->casts_shadow;
}

bool Entity::is_visible() const {
  const auto* wrapper = std::get_if<EntityWrapper>(&node_->content);
  return wrapper == nullptr || wrapper->visible;
}

bool Entity::is_solid() const {
  return node_->solid;
}

std::string Entity::solid_fault() const {
  if (is_solid()) return "";
  const EntityNode* node = node_.get();
  while (true) {
    if (const auto* wrapper = std::get_if<EntityWrapper>(&node->content)) {
      node = wrapper->child.get();
    } else if (const auto* operation = std::get_if<CsgOperation>(&node->content)) {
      node = std::find_if(operation->parts.begin(), operation->parts.end(),
                          [](const EntityPointer& part) { return !part->solid; })
                 ->get();
    } else {
      break;
    }
  }
  const auto& primitive = std::get<Primitive>(node->content);
  const auto* mesh = std::get_if<Mesh>(&primitive);
  if (mesh == nullptr) return "Disc, Triangle and HalfPlane are surfaces";
  return "a mesh is open: " + mesh->triangles->fault();
}

bool Entity::is_empty() const {
  return node_->primitive_count == 0;
}

std::uint64_t Entity::primitive_count() const {
  return node_->primitive_count;
}

Entity csg_union(std::span<const Entity> parts) {
  if (parts.empty())
    throw Error(ErrorCode::invalid_argument, "a union needs at least one part", "parts");
  return parts.size() == 1 ? parts[0] : combine(CsgOperator::set_union, parts);
}

Entity csg_intersection(std::span<const Entity> parts) {
  if (parts.empty())
    throw Error(ErrorCode::invalid_argument, "an intersection needs at least one part", "parts");
  for (const Entity& part : parts) require_solid(part, "intersection");
  if (std::any_of(parts.begin(), parts.end(), [](const Entity& part) { return part.is_empty(); })) {
    return empty_entity();
  }
  return parts.size() == 1 ? parts[0] : combine(CsgOperator::intersection, parts);
}

Entity csg_difference(const Entity& from, std::span<const Entity> cutters) {
  require_solid(from, "difference");
  for (const Entity& cutter : cutters) require_solid(cutter, "difference");
  if (cutters.empty() || from.is_empty()) return from;
  std::vector<Entity> parts{from};
  parts.insert(parts.end(), cutters.begin(), cutters.end());
  return combine(CsgOperator::difference, parts);
}

Entity empty_entity() {
  return make_entity(CsgOperation{});
}

Entity operator+(const Entity& a, const Entity& b) {
  return csg_union(std::array{a, b});
}

Entity operator-(const Entity& a, const Entity& b) {
  return csg_difference(a, std::span(&b, 1));
}

Entity operator^(const Entity& a, const Entity& b) {
  return csg_intersection(std::array{a, b});
}

}  // namespace crt
