// What most tests include, read once by the compiler (cmake/CrtPrecompile.cmake).
#pragma once

#include <doctest/doctest.h>

#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "core/precompiled.hpp"
#include "crt/query.hpp"
#include "crt/render.hpp"
