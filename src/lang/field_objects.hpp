// The objects Implicit, Blob and Superellipsoid are solids of fields.
#pragma once

#include <vector>

#include "lang/objects.hpp"

namespace crt::lang {

/// Returns the rows of these objects.
std::vector<ObjectType> field_objects();

}  // namespace crt::lang
