#include "core/geometry/custom/custom.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/geometry/checks.hpp"
#include "core/geometry/custom/functions.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

constexpr std::uint32_t max_faces = Shape::max_compared_faces;

std::string text_of(const Vec3& v) {
  return text::format("({}, {}, {})", v.x, v.y, v.z);
}

[[noreturn]] void refuse_answer(const CustomShape& shape, const std::string& complaint) {
  throw Error(ErrorCode::invalid_argument, text::format("{}: {}", shape.name(), complaint),
              "shape");
}

[[noreturn]] void refuse_crossings(const CustomShape& shape, const Ray& ray,
                                   const std::string& complaint) {
  refuse_answer(shape, text::format("{}, along the ray from {} to {} of the shape's own space, for "
                                    "t from {} to {}",
                                    complaint, text_of(ray.origin), text_of(ray.direction),
                                    ray.t_min, ray.t_max));
}

Bounds bounds_of(const CustomShape& shape) {
  const BoundingBox box = shape.bounds();
  return {box.lower, box.upper};
}

/// Appends crossings, without spans and gaps of no length.
void append(const CustomLine& line, std::span<const CustomCrossing> found, std::size_t start,
            CrossingList& out) {
  const std::size_t before = out.size();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const CustomCrossing& given = found[i];
    Crossing crossing{
        .face = given.face, .root = static_cast<std::uint8_t>(i), .entering = i % 2 == 0};
    if (i != start) {
      const DoubleDouble t = line.to_t(given.t);
      crossing.t = t.hi;
      crossing.t_low = t.lo;
      crossing.error = line.to_t_length(given.error + line.rounding()) + rounding_of(t.hi);
    }
    // Entries and exits still alternate if two go.
    if (out.size() > before && !(out.back().t < crossing.t)) {
      out.pop_back();
    } else {
      out.push_back(crossing);
    }
  }
}

}  // namespace

CalledShape::CalledShape(const Custom& custom)
    : shape_(custom.shape), bounds_(bounds_of(*shape_)), face_count_(shape_->face_count()) {}

bool CalledShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const CustomLine line(bounds_, ray);
  if (line.misses_bounds()) return false;
  std::vector<CustomCrossing>& found = out.of_custom;
  ask(line.ray(), found);
  std::size_t start = found.size();
  if (ray.start.face != invalid_index) start = put_start(ray, line, found);
  append(line, found, start, out);
  return false;
}

void CalledShape::ask(const Ray& ray, std::vector<CustomCrossing>& found) const {
  found.clear();
  shape_->crossings(ray, found);
  const auto refuse = [&](const std::string& complaint) {
    refuse_crossings(*shape_, ray, complaint);
  };
  if (found.size() > CustomShape::most_crossings) {
    refuse(text::format("there are {} crossings, and at most {} may be", found.size(),
                        CustomShape::most_crossings));
  }
  if (found.size() % 2 != 0) {
    refuse(text::format("there are {} crossings, an odd number", found.size()));
  }
  // The bounds may be as tight as the program's own rounding makes them.
  constexpr double slack = 1e-6;
  const double margin = slack * size_of(bounds_);
  double last = -infinity;
  for (CustomCrossing& crossing : found) {
    const auto& [t, error, face] = crossing;
    if (!std::isfinite(t)) refuse(text::format("a crossing has t = {}", t));
    if (!(error >= 0 && error < infinity)) refuse(text::format("an error is {}", error));
    if (face >= face_count_) {
      refuse(text::format("a crossing has face {} of {}", face, face_count_));
    }
    if (t < last) refuse(text::format("crossings are not in order: {} comes after {}", t, last));
    last = t;
    if (t < ray.t_min - error - margin || t > ray.t_max + error + margin) {
      refuse(text::format("the crossing at t = {} is not within the bounds", t));
    }
  }
  for (CustomCrossing& crossing : found) {
    const double within = std::clamp(crossing.t, ray.t_min, ray.t_max);
    crossing.error += std::abs(within - crossing.t);
    crossing.t = within;
  }
}

CustomPoint CalledShape::ask(const Vec3& position, std::uint32_t face) const {
  const CustomPoint point = shape_->point(position, face);
  const double length = largest_component(point.normal);
  if (!(length > 0 && length < infinity)) {
    refuse_answer(*shape_, text::format("the normal of face {} at {} is {}", face,
                                        text_of(position), text_of(point.normal)));
  }
  if (!std::isfinite(point.u) || !std::isfinite(point.v)) {
    refuse_answer(*shape_, text::format("(u, v) of face {} at {} are ({}, {})", face,
                                        text_of(position), point.u, point.v));
  }
  return point;
}

std::size_t CalledShape::put_start(const ObjectRay& ray, const CustomLine& line,
                                   std::vector<CustomCrossing>& found) const {
  const bool is_inside_after = ray.start.side == Side::inside;
  // Crossings at even places enter. The start goes the way that its side says.
  const std::size_t first = is_inside_after ? 0 : 1;
  double across = 2 * line.rounding() + line.to_length(ray.start.t_error);
  double largest_error = 0;
  for (const CustomCrossing& crossing : found) {
    largest_error = std::max(largest_error, crossing.error);
  }
  across += 2 * largest_error;  // also that of the crossing where the ray comes from
  const Vec3 normal = unit_vector(ask(line.ray().origin, ray.start.face).normal);
  const double cosine = std::abs(glm::dot(normal, line.ray().direction));
  // Where a ray grazes, the other end of its chord bounds the error, for curves up to this radius.
  const double radius = size_of(bounds_);
  const double along = std::min(across / cosine, 2 * std::sqrt(across * radius));

  std::size_t start = found.size();
  for (std::size_t i = first; i < found.size(); i += 2) {
    const double distance = std::abs(found[i].t);
    if (distance <= along && (start == found.size() || distance < std::abs(found[start].t))) {
      start = i;
    }
  }
  if (start == found.size()) {
    // Else the ray grazes. If what is before 0 contradicts the side, it is on that side for as long
    // as the errors leave open.
    const auto ahead = std::upper_bound(
        found.begin(), found.end(), 0.0,
        [](double place, const CustomCrossing& crossing) { return place < crossing.t; });
    const auto place = static_cast<std::size_t>(ahead - found.begin());
    if (place % 2 != first) return found.size();
    start = place;
    found.insert(ahead, 2, {.t = 0, .error = across, .face = ray.start.face});
  }
  found[start] = {.t = 0, .error = 0, .face = ray.start.face};
  for (std::size_t i = 0; i < start; ++i) found[i].t = std::min(found[i].t, 0.0);
  double last = 0;
  for (std::size_t i = start + 1; i < found.size(); ++i) {
    // What follows the start is ahead of it.
    last = std::max(last, found[i].t > 0 ? found[i].t : across);
    found[i].t = last;
  }
  return start;
}

SurfacePoint CalledShape::point_on(const Vec3& offset, const Vec3& /*direction*/,
                                   std::uint32_t face, bool /*with_uv*/) const {
  SurfacePoint result;
  result.position = middle_of(bounds_) + offset;
  const CustomPoint point = ask(result.position, face);
  result.normal = unit_vector(point.normal);
  result.u = point.u;
  result.v = point.v;
  return result;
}

Surface CalledShape::surface(std::uint32_t face) const {
  const std::array<double, 3> numbers = identity_of(*shape_, face);
  return {.kind = SurfaceKind::custom, .sizes = {numbers[0], numbers[1], numbers[2]}};
}

std::array<double, 3> identity_of(const CustomShape& shape, std::uint32_t face) {
  const auto address = std::uint64_t{reinterpret_cast<std::uintptr_t>(&shape)};
  constexpr std::uint64_t low_half = 0xffffffff;
  return {static_cast<double>(address >> 32), static_cast<double>(address & low_half),
          static_cast<double>(face)};
}

void validate(const Custom& custom) {
  if (custom.shape == nullptr) reject("shape", "must not be null");
  const CustomShape& shape = *custom.shape;
  const Bounds bounds = bounds_of(shape);
  const auto is_possible = [](const Vec3& corner) {
    constexpr double farthest = 1e100;
    return std::isfinite(corner.x + corner.y + corner.z) && largest_component(corner) <= farthest;
  };
  if (!is_possible(bounds.lower) || !is_possible(bounds.upper)) {
    refuse_answer(shape, text::format("bounds must be finite and at most 1e100 in magnitude, but "
                                      "are {} to {}",
                                      text_of(bounds.lower), text_of(bounds.upper)));
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (bounds.upper[axis] - bounds.lower[axis] >= smallest_length) continue;
    refuse_answer(shape, text::format("upper bounds must be above lower ones by at least 1e-100, "
                                      "but bounds are {} to {}",
                                      text_of(bounds.lower), text_of(bounds.upper)));
  }
  const std::uint32_t faces = shape.face_count();
  if (faces == 0 || faces > max_faces) {
    refuse_answer(shape, text::format("there must be 1 to {} faces, but are {}", max_faces, faces));
  }
}

std::unique_ptr<const FaceFunctions> CalledShape::face_functions() const {
  return face_functions_of(CustomFunctions{bounds_});
}

std::unique_ptr<const Shape> make_shape(const Custom& custom) {
  validate(custom);  // the program may have changed its mind
  return std::make_unique<CalledShape>(custom);
}

}  // namespace crt::core
