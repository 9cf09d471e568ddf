// What rays need of a scene that was edited is taken here from what the one before had.
#include <algorithm>
#include <vector>

#include "core/accel/space_order.hpp"
#include "core/intersect/accelerator.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// A tree is kept as long as fewer than one in so many of its boxes are left out, and fewer than
/// one in so many of all are beside it. So rays take hardly longer than through one tree.
constexpr std::size_t share_beside = 4;

}  // namespace

EarlierProxies Accelerator::proxies_for(const RecompiledScene& scene) const {
  EarlierProxies earlier{compiled_, scene.earlier_objects, scene.keeps_numbers, {}};
  earlier.proxies.resize(compiled_.objects.size());
  for (const BoundingProxies* proxies : {&bounded_, &unbounded_}) {
    for (const BoundingProxy& proxy : proxies->list) {
      if (proxy.object != invalid_index) earlier.proxies[proxy.object] = &proxy;
    }
  }
  return earlier;
}

void Accelerator::keep_solids() {
  for (BoundingProxies* proxies : {&bounded_, &unbounded_}) {
    std::vector<std::unique_ptr<const PlacedSolid>>& made = proxies->solids;
    if (made.empty()) continue;
    std::vector<std::unique_ptr<const PlacedSolid>>& kept = compiled_.stores.back()->solids;
    kept.insert(kept.end(), std::make_move_iterator(made.begin()),
                std::make_move_iterator(made.end()));
    made.clear();
  }
}

void Accelerator::find_enclosed(const Accelerator* earlier,
                                std::span<const std::uint32_t> earlier_objects,
                                const Workers& workers) {
  const CompiledScene& scene = compiled_;
  enclosed_.assign(scene.leaves.size(), invalid_index);
  const auto is_enclosed = [&](const SceneObject& object, std::uint32_t number, const Leaf& leaf) {
    const bool holds = !object.is_csg() || scene.program_of(object).is_within(number, leaf);
    return holds && leaf.shape->is_convex();
  };
  for_ranges(scene.objects.size(), items_for_a_thread, workers,
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i) {
                 const SceneObject& object = scene.objects[i];
                 if (object.is_instance()) continue;
                 const std::span<const Leaf> leaves = scene.leaves_of(object);
                 const bool is_new = earlier == nullptr || earlier_objects[i] == invalid_index;
                 const std::uint32_t* const before =
                     is_new ? nullptr
                            : &earlier->enclosed_[earlier->object(earlier_objects[i]).first_leaf];
                 for (std::uint32_t k = 0; k < leaves.size(); ++k) {
                   if (is_new ? is_enclosed(object, k, leaves[k]) : before[k] != invalid_index)
                     enclosed_[object.first_leaf + k] = static_cast<std::uint32_t>(i);
                 }
               }
             });
}

std::vector<std::uint32_t> Accelerator::order_of_earlier(
    const Accelerator& earlier, std::span<const std::uint32_t> earlier_objects,
    std::span<const std::uint32_t> bounded, const Bounds& total, const Workers& workers) const {
  const BoxTree& tree = earlier.tree_;
  // Flat lists take the place of small trees, which are built in no time.
  if (tree.empty() || bounded.size() <= FlatBoxList::max_boxes ||
      !(total.farthest() <= tree.farthest()))
    return {};
  std::vector<std::uint32_t> numbers(earlier.compiled_.objects.size(), invalid_index);
  for (std::uint32_t i = 0; i < earlier_objects.size(); ++i) {
    if (earlier_objects[i] != invalid_index) numbers[earlier_objects[i]] = i;
  }
  std::vector<bool> is_in_tree(compiled_.objects.size(), false);
  std::vector<std::uint32_t> order;
  order.reserve(tree.first_count() + bounded.size() / share_beside);
  std::size_t left_out = 0;
  for (std::size_t box = 0; box < tree.first_count(); ++box) {
    const std::uint32_t before = earlier.bounded_.list[box].object;
    const std::uint32_t object = before == invalid_index ? invalid_index : numbers[before];
    order.push_back(object);
    if (object == invalid_index) {
      ++left_out;
    } else {
      is_in_tree[object] = true;
    }
  }
  std::vector<std::uint32_t> beside;
  for (const std::uint32_t object : bounded) {
    if (!is_in_tree[object]) beside.push_back(object);
  }
  if (share_beside * left_out > tree.first_count() || share_beside * beside.size() > bounded.size())
    return {};
  sort_along_curve(compiled_, total, beside, workers);
  order.insert(order.end(), beside.begin(), beside.end());
  return order;
}

void Accelerator::build_tree(std::span<const std::uint32_t> bounded, const Bounds& total,
                             const Accelerator* earlier, bool is_tree_kept,
                             const Workers& workers) {
  const auto boxes_of = [&](std::span<const std::uint32_t> objects) {
    std::vector<Bounds> boxes;
    boxes.reserve(objects.size());
    for (const std::uint32_t object : objects) boxes.push_back(compiled_.objects[object].bounds);
    return boxes;
  };
  if (is_tree_kept) {
    const std::size_t count = earlier->tree_.first_count();
    std::vector<bool> left_out(count);
    for (std::size_t box = 0; box < count; ++box) left_out[box] = bounded[box] == invalid_index;
    const std::vector<Bounds> beside = boxes_of(bounded.subspan(count));
    Bounds around;
    for (const Bounds& box : beside) around.include(box);
    tree_ = BoxTree(earlier->tree_, std::move(left_out), beside, around, farthest_, workers.stop);
    return;
  }
  // A scene that is edited may well grow.
  const double farthest = earlier == nullptr ? farthest_ : 2 * farthest_;
  std::vector<Bounds> boxes = boxes_of(bounded);
  tree_ = BoxTree(boxes, total, farthest, workers.stop);
  if (boxes.size() > FlatBoxList::max_boxes) return;
  for (Bounds& box : boxes) box = box.grown(margin_);
  flat_box_list_ = FlatBoxList(boxes);
}

}  // namespace crt::core
