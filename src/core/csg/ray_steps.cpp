#include "core/csg/ray_steps.hpp"

#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

void RaySteps::look(std::uint64_t taken) const {
  poll();
  if (taken <= most()) return;
  throw Error(ErrorCode::limit, text::format("a ray comes near more than {} things at once: "
                                             "there are too many in one place (see max_ray_steps)",
                                             most()));
}

void RaySteps::poll() const {
  if (rules != nullptr && rules->poll) rules->poll();
}

}  // namespace crt::core
