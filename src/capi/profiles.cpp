// This file implements profiles of the C interface, and what is made of them.
#include <algorithm>
#include <iterator>

#include "capi/structs.hpp"
#include "crt/curves.hpp"
#include "crt/offset.hpp"
#include "crt/shaped_extrusion.hpp"
#include "crt/svg_path.hpp"
#include "crt/sweep.hpp"
#include "crt/text.hpp"

namespace crt::capi {

namespace {

/// Returns the contour to which pieces are added.
Contour& drawn_contour(crt_profile* profile) {
  require(profile, "profile");
  if (!profile->is_drawn) {
    reject("profile", "must have the begin of a contour first: call crt_profile_move_to");
  }
  return profile->contours.back();
}

crt_status add_piece(crt_profile* profile, const ProfilePoint& corner) {
  return guarded([&] { drawn_contour(profile).push_back(corner); });
}

/// Adds finished contours.
void add_contours(crt_profile& profile, std::vector<Contour> contours) {
  profile.contours.insert(profile.contours.end(), std::make_move_iterator(contours.begin()),
                          std::make_move_iterator(contours.end()));
  profile.is_drawn = false;
}

/// Returns how many points of a path are looked at. One more than is possible is refused.
std::size_t looked_at(std::size_t count) {
  return std::min(count, most_path_points + 1);
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_profile_create(crt_profile** out) {
  return guarded([&] {
    require(out, "out");
    *out = new crt_profile;
  });
}

crt_status crt_profile_move_to(crt_profile* profile, double x, double y) {
  return guarded([&] {
    require(profile, "profile");
    profile->contours.push_back({{.x = x, .y = y}});
    profile->is_drawn = true;
  });
}

crt_status crt_profile_line_to(crt_profile* profile, double x, double y) {
  return add_piece(profile, {.x = x, .y = y});
}

crt_status crt_profile_arc_to(crt_profile* profile, double x, double y, double bulge) {
  return add_piece(profile, {.x = x, .y = y, .bulge = bulge});
}

crt_status crt_profile_cubic_to(crt_profile* profile, double x1, double y1, double x2, double y2,
                                double x, double y, double deviation) {
  return guarded([&] {
    crt::append_cubic(drawn_contour(profile), {x1, y1}, {x2, y2}, {x, y}, deviation);
  });
}

crt_status crt_profile_quadratic_to(crt_profile* profile, double x1, double y1, double x, double y,
                                    double deviation) {
  return guarded([&] {
    crt::append_quadratic(drawn_contour(profile), {x1, y1}, {x, y}, deviation);
  });
}

crt_status crt_profile_svg_path(crt_profile* profile, const char* path, size_t length, int32_t fill,
                                double deviation) {
  return guarded([&] {
    require(profile, "profile");
    require(path, "path");
    const auto rule = to_enum(fill, crt::FillRule::even_odd, "fill", "crt_fill_rule");
    std::vector<crt::Contour> contours =
        crt::svg_path_contours({path, length}, {.fill = rule, .deviation = deviation});
    add_contours(*profile, std::move(contours));
  });
}

crt_status crt_profile_offset(crt_profile* profile, double distance) {
  return guarded([&] {
    require(profile, "profile");
    profile->contours = crt::offset_contours(profile->contours, distance);
    profile->is_drawn = false;
  });
}

crt_status crt_profile_text(crt_profile* profile, const char* text, size_t length, const char* font,
                            double size, int32_t alignment, double line_spacing, double deviation,
                            size_t* missing) {
  return guarded([&] {
    require(profile, "profile");
    require(text, "text");
    const crt::TextLayout layout{.size = size,
                                 .alignment = to_enum(alignment, crt::TextAlignment::right,
                                                      "alignment", "crt_text_alignment"),
                                 .line_spacing = line_spacing,
                                 .options = {.deviation = deviation}};
    const auto used = font == nullptr ? crt::standard_font() : crt::read_font(font);
    crt::TextContours made = crt::text_contours({text, length}, *used, layout);
    add_contours(*profile, std::move(made.contours));
    if (missing != nullptr) *missing = made.missing_letters.size();
  });
}

crt_status crt_profile_contour_count(const crt_profile* profile, size_t* count) {
  return guarded([&] {
    require(profile, "profile");
    require(count, "count");
    *count = profile->contours.size();
  });
}

crt_status crt_profile_contour(const crt_profile* profile, size_t index, double* corners,
                               size_t capacity, size_t* count) {
  return guarded([&] {
    require(profile, "profile");
    if (capacity > 0) require(corners, "corners");
    require(count, "count");
    if (index >= profile->contours.size()) reject("index", "must be below the number of contours");
    const crt::Contour& contour = profile->contours[index];
    for (std::size_t i = 0; i < contour.size() && i < capacity; ++i) {
      corners[3 * i] = contour[i].x;
      corners[3 * i + 1] = contour[i].y;
      corners[3 * i + 2] = contour[i].bulge;
    }
    *count = contour.size();
  });
}

crt_status crt_extrusion_create(const crt_profile* profile, const double from[3],
                                const double to[3], crt_entity** out) {
  return guarded([&] {
    require(profile, "profile");
    require(out, "out");
    const auto made = crt::make_profile(profile->contours);
    *out = new crt_entity(crt::extruded(made, to_vec3(from, "from"), to_vec3(to, "to")));
  });
}

crt_status crt_revolution_create(const crt_profile* profile, const double from[3],
                                 const double to[3], double angle, crt_entity** out) {
  return guarded([&] {
    require(profile, "profile");
    require(out, "out");
    const auto made = crt::make_profile(profile->contours);
    *out = new crt_entity(crt::revolved(made, to_vec3(from, "from"), to_vec3(to, "to"), angle));
  });
}

crt_status crt_shaped_extrusion_create(const crt_profile* profile, double height, double twist,
                                       double taper, double bevel, double rounding,
                                       crt_entity** out) {
  return guarded([&] {
    require(profile, "profile");
    require(out, "out");
    *out = new crt_entity(crt::ShapedExtrusion{.profile = crt::make_profile(profile->contours),
                                               .height = height,
                                               .twist = twist,
                                               .taper = taper,
                                               .bevel = bevel,
                                               .rounding = rounding});
  });
}

crt_status crt_sweep_create(const crt_profile* profile, const double* path, size_t count,
                            double bend, const double up[3], int32_t closed, crt_entity** out) {
  return guarded([&] {
    require(profile, "profile");
    require(out, "out");
    *out = new crt_entity(crt::Sweep{.profile = crt::make_profile(profile->contours),
                                     .path = to_vectors(path, looked_at(count), "path"),
                                     .bend = bend,
                                     .up = to_vec3(up, "up"),
                                     .closed = closed != 0});
  });
}

crt_status crt_tube_create(const double* path, const double* radii, size_t count, int32_t smooth,
                           int32_t closed, double deviation, crt_entity** out) {
  return guarded([&] {
    require(out, "out");
    std::vector<crt::Vec3> points = to_vectors(path, looked_at(count), "path");
    if (count > 0) require(radii, "radii");
    *out = new crt_entity(crt::Tube{.path = std::move(points),
                                    .radii = {radii, radii + looked_at(count)},
                                    .smooth = smooth != 0,
                                    .closed = closed != 0,
                                    .deviation = deviation});
  });
}
