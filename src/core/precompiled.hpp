// What most sources of the renderer include, read once by the compiler (cmake/CrtPrecompile.cmake).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/double_double.hpp"
#include "core/math/vector.hpp"
#include "core/math/vector_lanes.hpp"
#include "crt/primitives.hpp"
#include "crt/scene.hpp"
