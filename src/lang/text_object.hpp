// The object Text is letters that are drawn out along z.
#pragma once

#include "lang/objects.hpp"

namespace crt::lang {

/// Returns the row of Text.
ObjectType text_object();

}  // namespace crt::lang
