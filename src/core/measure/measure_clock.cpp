#include "core/measure/measure_clock.hpp"

#include "crt/error.hpp"

namespace crt::core {

void validate(const MeasureOptions& options) {
  if (!(options.relative_width > 0 && options.relative_width <= 1))
    throw Error(ErrorCode::invalid_argument, "relative_width must be above 0 and at most 1",
                "relative_width");
  if (!(options.seconds > 0))
    throw Error(ErrorCode::invalid_argument, "seconds must be above 0", "seconds");
}

}  // namespace crt::core
