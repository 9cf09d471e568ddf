#include "core/geometry/extrusion/functions.hpp"

namespace crt::core {

void ExtrusionFunctions::look(const PointOf<Interval>& box, NearFaces& near) const {
  if (box[2].hi < lower || box[2].lo > upper) return near.say(NearFaces::Kind::outside);
  look_at_region(*profile, false, {box[0], box[1], Interval{0, 0}}, near);
  if (box[2].lo <= lower) near.keep_within(0);
  if (box[2].hi >= upper) near.keep_within(1);
}

}  // namespace crt::core
