#include "core/accel/box_tree.hpp"

#include <utility>

namespace crt::core {

BoxTree::BoxTree(std::span<const Bounds> boxes, const Bounds& total, double farthest,
                 StopCheck* stop)
    : first_(std::make_shared<const EmbreeTree>(boxes, total, farthest, stop)),
      first_count_(boxes.size()),
      farthest_(farthest) {}

BoxTree::BoxTree(const BoxTree& earlier, std::vector<bool> left_out, std::span<const Bounds> added,
                 const Bounds& total, double farthest, StopCheck* stop)
    : first_(earlier.first_),
      first_count_(earlier.first_count_),
      farthest_(earlier.farthest_),
      is_edited_(true),
      left_out_(std::move(left_out)) {
  if (!added.empty()) added_ = std::make_unique<const EmbreeTree>(added, total, farthest, stop);
}

std::uint64_t BoxTree::bytes() const {
  return (first_ ? first_->bytes() : 0) + (added_ ? added_->bytes() : 0);
}

void BoxTree::traverse_both(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                            bool from_near, BoxVisitor& visitor) const {
  double limit = t_max;
  const auto visit = [&](std::uint32_t box) {
    if (!left_out_[box]) limit = visitor.visit(box);
    return limit;
  };
  first_->traverse(origin, direction, t_min, t_max, from_near, visit);
  if (added_ == nullptr || limit < t_min) return;
  const auto visit_added = [&](std::uint32_t box) {
    limit = visitor.visit(static_cast<std::uint32_t>(first_count_) + box);
    return limit;
  };
  added_->traverse(origin, direction, t_min, limit, from_near, visit_added);
}

void BoxTree::traverse_both(const RayPacket& packet, RayMask rays, PacketVisitor& visitor) const {
  const auto visit = [&](std::uint32_t box, RayMask met) {
    return left_out_[box] ? RayMask{0} : visitor.visit(box, met);
  };
  first_->traverse(packet, rays, visit);
  if (added_ == nullptr) return;
  const auto visit_added = [&](std::uint32_t box, RayMask met) {
    return visitor.visit(static_cast<std::uint32_t>(first_count_) + box, met);
  };
  added_->traverse(packet, rays, visit_added);
}

}  // namespace crt::core
