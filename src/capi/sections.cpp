// This file implements the sections of the C interface.
#include "capi/structs.hpp"
#include "crt/section.hpp"

namespace crt::capi {

namespace {

void copy(const Vec3& from, double* to) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

/// Fills in the points of contours in the world.
void list_points(crt_section& section, double deviation) {
  const std::vector<SectionPolyline> lines = section_polylines(section.value, deviation);
  section.first.reserve(lines.size() + 1);
  std::size_t count = 0;
  for (const SectionPolyline& line : lines) {
    section.first.push_back(count);
    count += line.size();
  }
  section.first.push_back(count);
  section.points.resize(3 * count);
  std::size_t next = 0;
  for (const SectionPolyline& line : lines) {
    for (const Vec3& point : line) copy(point, &section.points[3 * next++]);
  }
}

crt_status write_section_file(const crt_section* section, const char* path, std::int32_t unit,
                              double hatch) {
  return guarded([&] {
    require(section, "section");
    const SectionDrawing drawing{.unit = to_enum(unit, Unit::in, "unit", "crt_unit"),
                                 .hatch = hatch};
    require(path, "path");
    if (*path == 0) reject("path", "must not be empty");
    write_section(path, section->value, drawing);
  });
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_section_create(crt_entity* entity, const double normal[3], double offset,
                              double deviation, crt_section** out) {
  return crt_section_create_with(entity, normal, offset, deviation, nullptr, out);
}

crt_status crt_section_create_with(crt_entity* entity, const double normal[3], double offset,
                                   double deviation, const crt_measure_options* options,
                                   crt_section** out) {
  return guarded_with_cancel([&](const CancelValue& cancel_value) {
    require(entity, "entity");
    require(normal, "normal");
    require(out, "out");
    Reference<crt_section> section(new crt_section);
    section->value = crt::section(entity->value, {normal[0], normal[1], normal[2]}, offset,
                                  deviation, to_options(options, cancel_value));
    list_points(*section, deviation);
    *out = section.release();
  });
}

crt_status crt_section_area(const crt_section* section, crt_interval* out) {
  return guarded([&] {
    require(section, "section");
    require(out, "out");
    *out = {.lower = section->value.area.lower, .upper = section->value.area.upper};
  });
}

crt_status crt_section_deviation(const crt_section* section, double* out) {
  return guarded([&] {
    require(section, "section");
    require(out, "out");
    *out = section->value.deviation;
  });
}

crt_status crt_section_frame(const crt_section* section, double origin[3], double x_axis[3],
                             double y_axis[3], double* offset) {
  return guarded([&] {
    require(section, "section");
    require(origin, "origin");
    require(x_axis, "x_axis");
    require(y_axis, "y_axis");
    require(offset, "offset");
    const crt::SectionFrame& frame = section->value.frame;
    copy(frame.origin, origin);
    copy(frame.x_axis, x_axis);
    copy(frame.y_axis, y_axis);
    *offset = frame.offset;
  });
}

crt_status crt_section_contours(const crt_section* section, size_t* contour_count,
                                const size_t** first, const double** points) {
  return guarded([&] {
    require(section, "section");
    require(contour_count, "contour_count");
    require(first, "first");
    require(points, "points");
    *contour_count = section->value.contours.size();
    *first = section->first.data();
    *points = section->points.data();
  });
}

crt_status crt_section_profile(const crt_section* section, crt_profile** out) {
  return guarded([&] {
    require(section, "section");
    require(out, "out");
    Reference<crt_profile> profile(new crt_profile);
    profile->contours = section->value.contours;
    *out = profile.release();
  });
}

crt_status crt_section_write(const crt_section* section, const char* path) {
  return write_section_file(section, path, CRT_UNIT_M, 0);
}

crt_status crt_section_write_with(const crt_section* section, const char* path, int32_t unit,
                                  double hatch) {
  return write_section_file(section, path, unit, hatch);
}
