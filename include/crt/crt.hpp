// This header includes all of the C++ API but scripts (crt/script.hpp, library crt::lang).
#pragma once

#include <crt/background.hpp>
#include <crt/camera.hpp>
#include <crt/color.hpp>
#include <crt/curves.hpp>
#include <crt/entity.hpp>
#include <crt/error.hpp>
#include <crt/file.hpp>
#include <crt/image.hpp>
#include <crt/job.hpp>
#include <crt/light.hpp>
#include <crt/material.hpp>
#include <crt/mesh_file.hpp>
#include <crt/pattern.hpp>
#include <crt/prepared_scene.hpp>
#include <crt/primitives.hpp>
#include <crt/query.hpp>
#include <crt/render.hpp>
#include <crt/scene.hpp>
#include <crt/settings.hpp>
#include <crt/stats.hpp>
#include <crt/svg_path.hpp>
#include <crt/transform.hpp>
#include <crt/validate.hpp>
#include <crt/vec.hpp>
#include <crt/version.hpp>
