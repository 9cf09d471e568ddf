#include "core/scene/compile.hpp"

#include <algorithm>
#include <unordered_map>

#include "core/scene/grouping.hpp"
#include "core/scene/part.hpp"
#include "core/scene/surface_table.hpp"
#include "crt/error.hpp"

namespace crt::core {

namespace {

constexpr std::uint64_t most_primitives = std::uint64_t{1} << 25;

class Compiler {
 public:
  explicit Compiler(Precision precision) : precision_(precision) {}
  CompiledScene compile(std::span<const Entity> entities);

 private:
  /// A place in a program still to be filled: `part`, negated if `complemented`, below node `parent`.
  struct Pending {
    Part part;
    std::uint32_t parent = 0;
    bool complemented = false;
  };

  void compile_entity(const Entity& entity, std::uint32_t id);
  void add_group(std::span<const Part> parts);
  void build_program(std::span<const Part> parts, CsgProgram& program);
  void expand(const Pending& pending, CsgProgram& program);
  void add_leaf(const Part& part, bool complemented);
  void finish_program(CsgProgram& program);
  /// Narrows the boxes of the leaves to where they matter; returns the box around the object.
  Bounds narrow_bounds(const CsgProgram& program);
  std::vector<Bounds> boxes_of(const CsgProgram& program) const;
  const Placement* place(const PreciseTransform& to_world);
  std::uint32_t material_number(const Part& part);

  Precision precision_;
  CompiledScene result_;
  SurfaceTable surfaces_;
  std::unordered_map<const Material*, std::uint32_t> material_numbers_;
  std::optional<SharedMaterial> default_material_;
  std::vector<Pending> stack_;
};

CompiledScene Compiler::compile(std::span<const Entity> entities) {
  std::uint64_t count = 0;
  for (const Entity& entity : entities) {
    const std::uint64_t primitives = entity.primitive_count();
    count += std::min(primitives, most_primitives);
    if (primitives > most_primitives || count > most_primitives) {
      throw Error(ErrorCode::limit, "the scene has more than 33554432 primitives", "entities");
    }
  }
  result_.leaves.reserve(count);
  for (std::size_t i = 0; i < entities.size(); ++i)
    compile_entity(entities[i], static_cast<std::uint32_t>(i));
  return std::move(result_);
}

void Compiler::compile_entity(const Entity& entity, std::uint32_t id) {
  // The parts of nested unions, left to right.
  std::vector<Part> solids;
  std::vector<Part> surfaces;
  std::vector<Part> open{Part{.node = &entity.node(), .to_world = {}, .id = id}.unwrapped()};
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    const auto* operation = std::get_if<CsgOperation>(&part.node->content);
    if (operation != nullptr && operation->op == CsgOperator::set_union) {
      for (auto child = operation->parts.rbegin(); child != operation->parts.rend(); ++child) {
        open.push_back(part.child(*child));
      }
    } else {
      (part.node->solid ? solids : surfaces).push_back(part);
    }
  }
  // Solids that cannot touch need not know of each other.
  for (const std::vector<Part>& group : group_apart(std::move(solids))) add_group(group);
  for (const Part& surface : surfaces) add_group(std::span(&surface, 1));
}

void Compiler::add_group(std::span<const Part> parts) {
  SceneObject object;
  object.first_leaf = static_cast<std::uint32_t>(result_.leaves.size());
  if (parts.size() == 1 && std::holds_alternative<Primitive>(parts[0].node->content)) {
    add_leaf(parts[0], false);
    object.solid = result_.leaves.back().shape->is_solid();
    object.bounds = result_.leaves.back().bounds;
  } else {
    CsgProgram program;
    program.first_leaf = object.first_leaf;
    build_program(parts, program);
    object.bounds = narrow_bounds(program);
    program.tree = LeafTree(boxes_of(program));
    object.program = static_cast<std::uint32_t>(result_.programs.size());
    result_.programs.push_back(std::move(program));
  }
  if (!object.bounds.empty()) result_.objects.push_back(object);
}

void Compiler::build_program(std::span<const Part> parts, CsgProgram& program) {
  program.nodes.push_back({.parent = 0, .needed = 1, .count_outside = 0});
  stack_.clear();
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) stack_.push_back({*part, 0, false});
  while (!stack_.empty()) {
    const Pending pending = stack_.back();
    stack_.pop_back();
    if (std::holds_alternative<Primitive>(pending.part.node->content)) {
      add_leaf(pending.part, pending.complemented);
      program.leaf_parents.push_back(pending.parent);
    } else {
      expand(pending, program);
    }
  }
  finish_program(program);
}

// Marks a node that is an AND until finish_program() knows how many children it has.
constexpr std::uint32_t all_children = 0xffffffffu;

void Compiler::expand(const Pending& pending, CsgProgram& program) {
  const auto& operation = std::get<CsgOperation>(pending.part.node->content);
  // De Morgan: a complement turns OR into AND and moves on to the children; a - b is a AND NOT b.
  const bool is_or = (operation.op == CsgOperator::set_union) != pending.complemented;
  const std::uint32_t needed = is_or ? 1 : all_children;
  std::uint32_t node = pending.parent;
  const bool only_root = program.leaf_parents.empty() && program.nodes.size() == 1 && stack_.empty();
  if (only_root) {
    program.nodes[0].needed = needed;
  } else if (program.nodes[node].needed != needed) {
    node = static_cast<std::uint32_t>(program.nodes.size());
    program.nodes.push_back({.parent = pending.parent, .needed = needed, .count_outside = 0});
  }
  for (std::size_t i = operation.parts.size(); i-- > 0;) {
    const bool cutter = operation.op == CsgOperator::difference && i > 0;
    stack_.push_back({pending.part.child(operation.parts[i]), node, pending.complemented != cutter});
  }
}

void Compiler::finish_program(CsgProgram& program) {
  std::vector<std::uint32_t> children(program.nodes.size(), 0);
  for (std::size_t node = 1; node < program.nodes.size(); ++node) ++children[program.nodes[node].parent];
  for (const std::uint32_t parent : program.leaf_parents) ++children[parent];
  for (std::size_t node = 0; node < program.nodes.size(); ++node) {
    if (program.nodes[node].needed == all_children) program.nodes[node].needed = children[node];
  }
  // Values where every leaf is outside; children come after their parents.
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    if (result_.leaves[program.first_leaf + i].complemented)
      ++program.nodes[program.leaf_parents[i]].count_outside;
  }
  for (std::size_t node = program.nodes.size(); node-- > 1;) {
    const CsgNode& child = program.nodes[node];
    if (child.count_outside >= child.needed) ++program.nodes[child.parent].count_outside;
  }
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = result_.leaves[program.first_leaf + i];
    for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
      numbers.push_back(result_.face_surfaces[leaf.first_face + face].surface);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  std::unordered_map<std::uint32_t, std::uint32_t> shared;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] == numbers[i - 1])
      shared.try_emplace(numbers[i], static_cast<std::uint32_t>(shared.size()));
  }
  program.shared_surfaces = static_cast<std::uint32_t>(shared.size());
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = result_.leaves[program.first_leaf + i];
    for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
      FaceSurface& surface = result_.face_surfaces[leaf.first_face + face];
      const auto found = shared.find(surface.surface);
      if (found != shared.end()) surface.shared = found->second;
    }
  }
}

// Every node has a box outside of which it has the value that it has where all leaves are outside
// of their primitives, whatever its leaves do there. If one child's having that value is enough for it,
// the boxes of such children are all boxes of the node, and so is what they have in common. What a
// leaf does outside of the boxes of all nodes above it does not matter: a ray that misses what
// they leave of the leaf's own box may leave out the leaf.
Bounds Compiler::narrow_bounds(const CsgProgram& program) {
  const auto outside_value = [&](std::size_t node) {
    return program.nodes[node].count_outside >= program.nodes[node].needed;
  };
  const auto one_is_enough = [&](std::size_t node) {
    return outside_value(node) == (program.nodes[node].needed == 1);
  };
  std::vector<Bounds> bounds(program.nodes.size());
  for (std::size_t node = 0; node < bounds.size(); ++node) {
    if (one_is_enough(node)) bounds[node] = Bounds::everything();
  }
  const auto add = [&](std::uint32_t node, const Bounds& child, bool child_value) {
    if (!one_is_enough(node)) {
      if (!child.empty()) bounds[node].include(child);
    } else if (child_value == outside_value(node)) {
      bounds[node] = bounds[node].clipped(child);
    }
  };
  // Children come after their parents.
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    const Leaf& leaf = result_.leaves[program.first_leaf + i];
    add(program.leaf_parents[i], leaf.bounds, leaf.complemented);
  }
  for (std::size_t node = bounds.size(); node-- > 1;) {
    add(program.nodes[node].parent, bounds[node], outside_value(node));
  }
  for (std::size_t node = 1; node < bounds.size(); ++node) {
    bounds[node] = bounds[node].clipped(bounds[program.nodes[node].parent]);
  }
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    Leaf& leaf = result_.leaves[program.first_leaf + i];
    leaf.bounds = leaf.bounds.clipped(bounds[program.leaf_parents[i]]);
  }
  return bounds[0];
}

std::vector<Bounds> Compiler::boxes_of(const CsgProgram& program) const {
  std::vector<Bounds> boxes;
  boxes.reserve(program.leaf_count());
  for (std::uint32_t i = 0; i < program.leaf_count(); ++i) {
    boxes.push_back(result_.leaves[program.first_leaf + i].bounds);
  }
  return boxes;
}

void Compiler::add_leaf(const Part& part, bool complemented) {
  const auto& primitive = std::get<Primitive>(part.node->content);
  Leaf leaf;
  leaf.shape = make_shape(primitive);
  if (precision_ == Precision::exact) leaf.exact = make_exact_shape(primitive);
  leaf.placement = place(part.to_world);
  leaf.bounds = leaf.placement->bounds_to_world(leaf.shape->bounds());
  leaf.material = material_number(part);
  leaf.entity_id = part.id;
  leaf.complemented = complemented;
  leaf.first_face = static_cast<std::uint32_t>(result_.face_surfaces.size());
  leaf.face_count = leaf.shape->face_count();
  for (std::uint32_t face = 0; face < leaf.face_count; ++face) {
    result_.face_surfaces.push_back(surfaces_.find(leaf.shape->surface(face), *leaf.placement));
  }
  result_.leaves.push_back(std::move(leaf));
}

const Placement* Compiler::place(const PreciseTransform& to_world) {
  // Most leaves are not moved at all, or together with the one before.
  const Transform map = to_world.rounded();
  if (result_.placements.empty()) result_.placements.emplace_back();
  if (map == Transform{}) return &result_.placements.front();
  if (!(result_.placements.back().to_world() == map)) result_.placements.emplace_back(to_world);
  return &result_.placements.back();
}

std::uint32_t Compiler::material_number(const Part& part) {
  const auto& primitive = std::get<Primitive>(part.node->content);
  const auto& own = std::visit(
      [](const auto& shape) -> const auto& { return shape.material; }, primitive);
  const SharedMaterial* material = own ? &*own : part.material;
  if (material == nullptr) {
    if (!default_material_) default_material_.emplace(Material{});
    material = &*default_material_;
  }
  const auto [entry, added] =
      material_numbers_.try_emplace(&**material, static_cast<std::uint32_t>(result_.materials.size()));
  if (added) result_.materials.push_back(*material);
  return entry->second;
}

}  // namespace

CompiledScene compile(std::span<const Entity> entities, Precision precision) {
  return Compiler(precision).compile(entities);
}

}  // namespace crt::core
