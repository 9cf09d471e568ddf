// The text of src/core/math/elementary_tables.hpp, computed by MPFR.
#pragma once

#include <string>

namespace crt::tests {

std::string elementary_tables();

}  // namespace crt::tests
