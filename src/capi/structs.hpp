// These functions convert between the structs of the C interface and the values of the C++ one.
#pragma once

#include "capi/growable.hpp"
#include "capi/handles.hpp"
#include "crt/background.hpp"
#include "crt/camera.hpp"
#include "crt/light.hpp"
#include "crt/material.hpp"
#include "crt/measure.hpp"
#include "crt/mesh.hpp"
#include "crt/render.hpp"
#include "crt/settings.hpp"
#include "crt/stats.hpp"

namespace crt::capi {

/// Makes an entity and hands it out.
template <class Make>
crt_status create(crt_entity** out, const Make& make) {
  return guarded([&] {
    require(out, "out");
    *out = new crt_entity(make());
  });
}

inline CancelValue new_cancel_value() {
  return std::make_shared<std::atomic<int>>(0);
}

/// Runs a body that a callback may cancel. The body gets what is to keep the callback's number.
template <class Body>
crt_status guarded_with_cancel(const Body& body) {
  return guarded([&] {
    const CancelValue cancel_value = new_cancel_value();
    try {
      body(cancel_value);
    } catch (const Error& error) {
      if (error.code() == ErrorCode::cancelled) set_cancel_value(*cancel_value);
      throw;
    }
  });
}

/// Gives a text as far as it fits, and its whole length.
void give_text(const std::string& from, const char* argument, char* text, std::size_t capacity,
               std::size_t* length);

/// Returns three numbers from the caller, and throws for NULL. The C++ interface checks whether
/// they are good.
Vec3 to_vec3(const double* numbers, const char* argument);
/// Returns `count` of them. NULL is possible for none.
std::vector<Vec3> to_vectors(const double* numbers, std::uint64_t count, const char* argument);

/// Throws that the argument has a value which `list`, an enumeration of crt.h, has not.
[[noreturn]] void reject_value(const char* argument, std::int32_t value, const char* list);

/// Converts a number to an enumeration of C++ whose values have the numbers of the interface, 0 to
/// `last`.
template <class Enum>
Enum to_enum(std::int32_t value, Enum last, const char* argument, const char* list) {
  if (value < 0 || value > static_cast<std::int32_t>(last)) reject_value(argument, value, list);
  return static_cast<Enum>(value);
}

// Each takes all that the caller's struct holds, and throws for NULL and unknown enumeration
// values.
Material to_material(const crt_material* material);
PrincipledMaterial to_material(const crt_principled* material);
/// `depth` counts the patterns that this one lies within, and itself.
Pattern to_pattern(const crt_pattern* pattern, const char* argument, int depth = 1);
MeshOptions to_mesh_options(const crt_mesh_options* options);
Light to_light(const crt_light* light);
Camera to_camera(const crt_camera* camera);
Background to_background(const crt_background* background);
Settings to_settings(const crt_settings* settings);
// NULL stands for the defaults here.
ScriptOptions to_options(const crt_script_options* options);
RenderOptions to_options(const crt_render_options* options, const CancelValue& cancel_value);
/// A relative width of 0 stands for the usual one.
MeasureOptions to_options(const crt_measure_options* options, const CancelValue& cancel_value,
                          double usual_width = MeasureOptions().relative_width);

/// Makes what a poll callback is called through, which keeps the number that it stops with. It is
/// empty without one.
std::function<bool()> to_go_on(crt_poll_fn call, void* user, const CancelValue& cancel_value);

/// Makes what a progress callback is called through, which keeps the number that it stops with.
std::function<bool(double)> to_progress(crt_progress_fn call, void* user,
                                        const CancelValue& cancel_value);

// These convert back. The texts stay where they are, in the settings.
crt_light to_c(const Light& light);
crt_camera to_c(const Camera& camera);
/// `image` is the handle for the background's picture, if it has one.
crt_background to_c(const Background& background, const crt_image* image);
crt_settings to_c(const Settings& settings);
crt_render_stats to_c(const RenderStats& stats);

/// Returns the defaults of one type of pattern or light.
crt_pattern default_pattern(std::int32_t type);
crt_light default_light(std::int32_t type);

}  // namespace crt::capi
