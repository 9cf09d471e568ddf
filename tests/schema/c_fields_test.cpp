// What a table of the schema has is in the struct of crt.h, or the row says that C has it not.
#include <doctest/doctest.h>

#include <algorithm>

#include "capi/fields.hpp"
#include "crt/schema_materials.hpp"
#include "crt/schema_scene.hpp"
#include "crt/schema_settings.hpp"

namespace {

/// Checks that a struct of C has the fields of one of C++, and returns how many.
template <class Struct, class C>
int fields_in() {
  int count = 0;
  const auto has = [](std::string_view name) {
    const auto fields = crt::capi::c_fields<C>();
    return std::any_of(fields.begin(), fields.end(),
                       [name](const crt::capi::CField& field) { return field.name == name; });
  };
  crt::schema::for_each_field<Struct>([&](const auto& row) {
    if (row.c_name().empty()) return;
    CAPTURE(row.c_name());
    ++count;
    CHECK(has(row.c_name()));
    if (!row.uses.alpha.empty()) CHECK(has(row.uses.alpha));
    if (!row.uses.map.empty()) CHECK(has(row.uses.map));
  });
  return count;
}

}  // namespace

TEST_CASE("the structs of C have the fields of those of C++") {
  CHECK(fields_in<crt::Settings, crt_settings>() >= 24);
  CHECK(fields_in<crt::Material, crt_material>() >= 10);
  CHECK(fields_in<crt::PrincipledMaterial, crt_principled>() >= 12);
  CHECK(fields_in<crt::Camera, crt_camera>() >= 8);
  CHECK(fields_in<crt::SolidBackground, crt_background>() == 1);
  CHECK(fields_in<crt::GradientBackground, crt_background>() == 2);
  CHECK(fields_in<crt::PanoramaBackground, crt_background>() == 2);
  CHECK(fields_in<crt::SkyBackground, crt_background>() == 5);
  crt::schema::for_each_kind<crt::Light>(
      []<class Kind>(std::type_identity<Kind>) { CHECK(fields_in<Kind, crt_light>() >= 1); });
  crt::schema::for_each_kind<crt::Pattern>(
      []<class Kind>(std::type_identity<Kind>) { CHECK(fields_in<Kind, crt_pattern>() >= 6); });
}

TEST_CASE("settings go to C and back without a change") {
  const crt::Settings settings{.title = "a title",
                               .width = 17,
                               .gamma = 1.5,
                               .exposure = 0.75,
                               .tone_map = crt::ToneMap::filmic,
                               .light_samples = 4,
                               .max_samples = 64,
                               .filter = crt::PixelFilter::blackman_harris,
                               .indirect = 2,
                               .clamp = 30,
                               .head_light = false,
                               .show_clip = true,
                               .seed = 0xfedcba9876543210,
                               .compat = 2015};
  crt_settings out{};
  out.struct_size = sizeof out;
  crt::capi::put_fields(out, settings);
  CHECK(out.no_head_light == 1);
  CHECK(out.show_clip == 1);
  crt::Settings back;
  crt::capi::take_fields(back, out, "settings");
  crt::schema::for_each_field<crt::Settings>([&](const auto& row) {
    CAPTURE(row.name);
    CHECK((back.*row.member == settings.*row.member));
  });
}
