// The query for all crossings of one ray.
#pragma once

#include <limits>
#include <vector>

#include "core/intersect/object_query.hpp"

namespace crt::core {

class All final : public ObjectQuery<All> {
 public:
  /// If `opacity` is given the query stops at the first crossing of an opaque material.
  All(const Accelerator& accelerator, const WorldRay& world_ray, RayWorkspace& workspace,
      const Opacity* opacity, std::vector<RayHit>& hits)
      : ObjectQuery(accelerator, world_ray, workspace),
        accelerator_(accelerator),
        opacity_(opacity),
        left_object_(opacity == nullptr ? nothing : accelerator.left_for_good(world_ray.start)),
        out_(hits) {}
  static constexpr bool takes_one = false;
  bool stopped = false;

  void test(std::uint32_t object) {
    if (object != left_object_) ObjectQuery::test(object);
  }

  bool take(const RayHit& hit) {
    if (!is_before_end(hit)) return false;
    if (opacity_ != nullptr && opacity_->of_materials[accelerator_.leaf(hit.leaf).material]) {
      stopped = true;
      set_limit(-std::numeric_limits<double>::infinity());
      return false;
    }
    out_.push_back(hit);
    return true;
  }

 private:
  const Accelerator& accelerator_;
  const Opacity* opacity_;
  std::uint32_t left_object_;
  std::vector<RayHit>& out_;
};

}  // namespace crt::core
