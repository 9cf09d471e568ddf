// This asks the library about a tree of solids, as a scene with nothing else.
#pragma once

#include <limits>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "oracle/solid_tree.hpp"

namespace crt::test {

struct FoundFlip {
  double t = 0;
  bool entering = false;

  friend bool operator==(const FoundFlip&, const FoundFlip&) = default;
};
struct FoundFlips {
  bool inside_before = false;
  std::vector<FoundFlip> flips;

  friend bool operator==(const FoundFlips&, const FoundFlips&) = default;
};

class PreparedTree {
 public:
  PreparedTree(const Entity& tree, Precision precision) : scene_(description(tree, precision)) {}

  FoundFlips flips(const GridRay& ray) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const core::WorldRay line{.origin = ray.origin,
                              .direction = ray.direction,
                              .t_min = -infinity,
                              .t_max = infinity,
                              .start = {}};
    FoundFlips result;
    scene_.containing_solids(line, hits_, work_);
    result.inside_before = !hits_.empty();
    scene_.crossings(line, hits_, work_);
    for (const core::RayHit& hit : hits_) result.flips.push_back({hit.t, hit.entering});
    return result;
  }
  std::uint64_t escalations() const { return work_.escalations(); }

 private:
  static Scene description(const Entity& tree, Precision precision) {
    Scene scene;
    scene.entities.push_back(tree);
    scene.settings.precision = precision;
    return scene;
  }

  core::PreparedData scene_;
  core::RayWorkspace work_;
  std::vector<core::RayHit> hits_;
};

}  // namespace crt::test
