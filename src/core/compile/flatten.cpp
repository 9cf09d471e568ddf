#include "core/compile/flatten.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/compile/grouping.hpp"
#include "core/compile/instancing.hpp"
#include "core/compile/material_numbering.hpp"
#include "core/compile/part.hpp"
#include "core/compile/surface_table.hpp"
#include "core/geometry/mesh/mesh.hpp"

namespace crt::core {

namespace {

PassingRays kinds_that_pass(const Entity& entity) {
  return static_cast<PassingRays>((entity.is_visible() ? passing_none : passing_camera) |
                                  (entity.casts_shadow() ? passing_none : passing_shadow));
}

class Flattening {
 public:
  Flattening(Precision precision, const Workers& workers)
      : exact_(precision == Precision::exact), workers_(workers) {}
  FlatScene flatten(std::span<const Entity> entities, std::span<const std::uint32_t> places,
                    Instancing instancing, const Instancing::Count& count,
                    const PrimitiveLimit& limit);
  FlatScene flatten(const PrototypeSource& prototype);

 private:
  /// A Pending is a place in a program that is still to be filled: with `part`, negated if
  /// `complemented`, below node `parent`.
  struct Pending {
    Part part;
    std::uint32_t parent = 0;
    bool complemented = false;
  };

  void add_entity(const Part& entity, const PrimitiveLimit& limit);
  /// Makes objects of solids that are one union, of which some are worth sharing.
  void add_solids(const PrimitiveLimit& limit);
  /// Returns the boxes of those parts of solids_ that are shared, by node and in its space.
  std::unordered_map<const EntityNode*, Bounds> bounds_of_shared() const;
  void add_instance(const Part& part);
  std::uint32_t prototype_number(const Part& part);
  void add_group(std::span<const Part> parts);
  void build_program(std::span<const Part> parts, CsgProgram& program);
  void expand(const Pending& pending, CsgProgram& program);
  void add_leaf(const Part& part, bool complemented);
  std::uint32_t placement_number(const TransformChain* to_world);
  /// Returns the material that a part was given, or null.
  static const SharedMaterial* material_of(const Part& part, const Primitive& primitive);
  FlatScene take_result();

  bool exact_;
  Workers workers_;
  Instancing instancing_;
  Instancing::Count count_;
  bool is_prototype_ = false;
  PassingRays passed_by_ = passing_none;  ///< these pass the entity
  FlatScene result_;
  std::uint32_t program_ = no_program;  ///< that leaves are added to
  Transform last_map_;                  ///< of the last placement
  bool last_is_all_ = true;             ///< whether last_map_ is all of it
  MaterialNumbering materials_;
  std::map<std::pair<const EntityNode*, const Material*>, std::uint32_t> prototype_numbers_;
  // These are reused from one entity to the next.
  std::vector<Pending> stack_;
  std::vector<Part> open_;
  std::vector<Part> solids_;
  std::vector<Part> surfaces_;
};

FlatScene Flattening::take_result() {
  result_.materials = materials_.take_materials();
  result_.default_material = materials_.default_number();
  result_.count = count_;
  return std::move(result_);
}

FlatScene Flattening::flatten(std::span<const Entity> entities,
                              std::span<const std::uint32_t> places, Instancing instancing,
                              const Instancing::Count& count, const PrimitiveLimit& limit) {
  instancing_ = std::move(instancing);
  count_ = count;
  limit.check(count_);
  std::uint64_t leaves = 0;
  for (const std::uint32_t place : places) leaves += entities[place].node().leaf_count;
  leaves = std::min(leaves, count_.primitives);
  result_.leaves.reserve(leaves);
  result_.programs_of_leaves.reserve(leaves);
  result_.objects.reserve(places.size());
  result_.entity_ends.reserve(places.size());
  result_.placements.push_back(nullptr);
  for (const std::uint32_t place : places) {
    const Entity& entity = entities[place];
    if (!entity.is_empty()) {
      const Part part{.node = &entity.node(), .id = place, .part_id = place};
      passed_by_ = kinds_that_pass(entity);
      add_entity(part.unwrapped(result_.transforms), limit);
    }
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    result_.entity_ends.push_back({size(result_.leaves), size(result_.objects),
                                   size(result_.programs), size(result_.instances), 0});
  }
  return take_result();
}

FlatScene Flattening::flatten(const PrototypeSource& prototype) {
  is_prototype_ = true;
  result_.placements.push_back(nullptr);
  const Part part{.node = prototype.node, .material = prototype.material};
  add_group(std::span(&part, 1));
  return take_result();
}

void Flattening::add_entity(const Part& entity, const PrimitiveLimit& limit) {
  if (instancing_.is_shared(*entity.node)) return add_instance(entity);
  if (entity.operation() == nullptr) return add_group(std::span(&entity, 1));
  // These are the parts of nested unions, left to right.
  solids_.clear();
  surfaces_.clear();
  open_.assign(1, entity);
  while (!open_.empty()) {
    const Part part = open_.back();
    open_.pop_back();
    workers_.poll_at(solids_.size() + surfaces_.size());
    const CsgOperation* operation = part.operation();
    const bool is_union = operation != nullptr && operation->op == CsgOperator::set_union;
    if (is_union && !instancing_.is_shared(*part.node)) {
      for (std::size_t i = operation->parts.size(); i-- > 0;) {
        if (repeats(*operation, i)) continue;
        open_.push_back(part.child(operation->parts[i], result_.transforms));
      }
    } else {
      (part.node->solid ? solids_ : surfaces_).push_back(part);
    }
  }
  add_solids(limit);
  for (const Part& surface : surfaces_) {
    if (instancing_.is_shared(*surface.node)) {
      add_instance(surface);
    } else {
      add_group(std::span(&surface, 1));
    }
  }
}

std::unordered_map<const EntityNode*, Bounds> Flattening::bounds_of_shared() const {
  std::unordered_map<const EntityNode*, Bounds> bounds;
  for (const Part& part : solids_) {
    if (!instancing_.is_shared(*part.node)) continue;
    const auto [entry, added] = bounds.try_emplace(part.node);
    if (added) entry->second = part_bounds({.node = part.node});
  }
  return bounds;
}

void Flattening::add_solids(const PrimitiveLimit& limit) {
  const auto shared = bounds_of_shared();
  const auto bounds_of = [&](const Part& part) {
    const auto found = shared.find(part.node);
    if (found == shared.end()) return part_bounds(part);
    return part.to_world == nullptr ? found->second
                                    : moved_bounds(part.to_world->product.rounded(), found->second);
  };
  // Solids that cannot touch need not know of each other. Others are one object, of which nothing
  // is shared.
  std::size_t begin = 0;
  for (const std::size_t end : disjoint_groups(solids_, bounds_of, workers_)) {
    const auto group = std::span<const Part>(solids_).subspan(begin, end - begin);
    begin = end;
    if (group.size() == 1 && instancing_.is_shared(*group[0].node)) {
      add_instance(group[0]);
      continue;
    }
    for (const Part& part : group) {
      if (!instancing_.is_shared(*part.node)) continue;
      count_.primitives += part.node->primitive_count;
      result_.expanded_primitives += part.node->primitive_count;
      limit.check(count_);
    }
    add_group(group);
  }
}

void Flattening::add_instance(const Part& part) {
  workers_.poll_at(result_.instances.size());
  SceneObject object;
  object.instance = static_cast<std::uint32_t>(result_.instances.size());
  object.solid = part.node->solid;
  object.passed_by = passed_by_;
  result_.objects.push_back(object);
  result_.instances.push_back({.to_world = part.to_world,
                               .prototype = prototype_number(part),
                               .entity_id = part.id,
                               .part_id = part.part_id,
                               .user = part.user.value_or(0),
                               .id_is_of_all = part.id_is_final,
                               .has_part_id = part.has_part_id});
}

std::uint32_t Flattening::prototype_number(const Part& part) {
  const Material* const material = part.material == nullptr ? nullptr : &**part.material;
  const auto number = static_cast<std::uint32_t>(result_.prototypes.size());
  const auto [entry, added] = prototype_numbers_.try_emplace({part.node, material}, number);
  if (added) result_.prototypes.push_back({part.node, part.material});
  return entry->second;
}

void Flattening::add_group(std::span<const Part> parts) {
  SceneObject object;
  object.first_leaf = static_cast<std::uint32_t>(result_.leaves.size());
  object.solid = parts[0].node->solid;
  object.passed_by = passed_by_;
  program_ = no_program;
  if (parts.size() == 1 && parts[0].operation() == nullptr) {
    add_leaf(parts[0], false);
  } else {
    object.program = program_ = static_cast<std::uint32_t>(result_.programs.size());
    CsgProgram program;
    build_program(parts, program);
    result_.programs.push_back(std::move(program));
  }
  result_.objects.push_back(object);
}

void Flattening::build_program(std::span<const Part> parts, CsgProgram& program) {
  program.nodes.push_back({.parent = 0, .needed = 1, .count_outside = 0});
  stack_.clear();
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
    stack_.push_back({*part, 0, false});
  while (!stack_.empty()) {
    const Pending pending = stack_.back();
    stack_.pop_back();
    workers_.poll_at(stack_.size());
    if (pending.part.operation() == nullptr) {
      add_leaf(pending.part, pending.complemented);
      program.leaf_parents.push_back(pending.parent);
    } else {
      expand(pending, program);
    }
  }
}

void Flattening::expand(const Pending& pending, CsgProgram& program) {
  const CsgOperation& operation = *pending.part.operation();
  // By De Morgan a complement turns OR into AND and moves to the children. a - b is a AND NOT b.
  const bool is_or = (operation.op == CsgOperator::set_union) != pending.complemented;
  const std::uint32_t needed = is_or ? 1 : all_children;
  std::uint32_t node = pending.parent;
  const bool only_root =
      program.leaf_parents.empty() && program.nodes.size() == 1 && stack_.empty();
  if (only_root) {
    program.nodes[0].needed = needed;
  } else if (program.nodes[node].needed != needed) {
    node = static_cast<std::uint32_t>(program.nodes.size());
    program.nodes.push_back({.parent = pending.parent, .needed = needed, .count_outside = 0});
  }
  for (std::size_t i = operation.parts.size(); i-- > 0;) {
    if (repeats(operation, i)) continue;
    const bool cutter = operation.op == CsgOperator::difference && i > 0;
    stack_.push_back({pending.part.child(operation.parts[i], result_.transforms), node,
                      pending.complemented != cutter});
  }
}

void Flattening::add_leaf(const Part& part, bool complemented) {
  workers_.poll_at(result_.leaves.size());
  const auto& primitive = std::get<Primitive>(part.node->content);
  const SharedMaterial* const material = material_of(part, primitive);
  const FacetAttributes* const facets = material ? nullptr : facet_attributes(primitive);
  const bool has_materials = facets != nullptr && facets->has_materials();
  result_.leaves.push_back(
      {.primitive = &primitive,
       .placement = placement_number(part.to_world),
       .material = has_materials ? materials_.number(*facets) : materials_.number(material),
       .entity_id = part.id,
       .part_id = part.part_id,
       .user = part.user.value_or(0),
       .complemented = complemented,
       .has_materials = has_materials,
       .is_mesh = std::holds_alternative<Mesh>(primitive),
       .takes_entity_id = !part.id_is_final,
       .takes_part_id = !part.has_part_id,
       .takes_user = !part.user});
  result_.programs_of_leaves.push_back(program_);
}

std::uint32_t Flattening::placement_number(const TransformChain* to_world) {
  // Most leaves are not moved at all, or together with the one before.
  if (to_world == nullptr) return 0;
  if (to_world != result_.placements.back()) {
    const Transform map = to_world->product.rounded();
    // In the exact tier that may not be all of it.
    const bool is_all = !exact_ || to_world->is_plain();
    if (is_all && map == Transform{} && !is_prototype_) return 0;
    if (!is_all || !last_is_all_ || !(map == last_map_) || is_prototype_) {
      last_map_ = map;
      last_is_all_ = is_all;
      result_.placements.push_back(to_world);
    }
  }
  return static_cast<std::uint32_t>(result_.placements.size() - 1);
}

const SharedMaterial* Flattening::material_of(const Part& part, const Primitive& primitive) {
  const auto& own = std::visit(
      [](const auto& shape) -> const auto& { return shape.material; }, primitive);
  return own ? &*own : part.material;
}

}  // namespace

FlatScene flatten(std::span<const Entity> entities, std::span<const std::uint32_t> places,
                  Instancing instancing, const Instancing::Count& count, Precision precision,
                  const Workers& workers, const PrimitiveLimit& limit) {
  return Flattening(precision, workers)
      .flatten(entities, places, std::move(instancing), count, limit);
}

FlatScene flatten(const PrototypeSource& prototype, Precision precision, const Workers& workers) {
  return Flattening(precision, workers).flatten(prototype);
}

}  // namespace crt::core
