// What most tests include, read once by the compiler (cmake/CrtPrecompile.cmake).
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>

#include "core/math/double_double.hpp"
#include "core/math/vector.hpp"
#include "core/math/vector_lanes.hpp"
#include "crt/query.hpp"
#include "crt/render.hpp"
#include "crt/scene.hpp"
