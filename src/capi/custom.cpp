// This file implements custom shapes of the C interface.
#include "crt/custom.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "capi/structs.hpp"
#include "crt/primitives.hpp"

namespace crt::capi {

template <>
crt_custom defaults<crt_custom>() {
  crt_custom custom{};
  custom.face_count = 1;
  return custom;
}

namespace {

/// A CalledBack is a custom shape whose functions are the caller's.
class CalledBack final : public CustomShape {
 public:
  explicit CalledBack(const crt_custom& given)
      : given_(given), name_(given.name == nullptr ? CustomShape::name() : given.name) {}
  CalledBack(const CalledBack&) = delete;
  CalledBack& operator=(const CalledBack&) = delete;
  ~CalledBack() override {
    if (is_kept_ && given_.release != nullptr) given_.release(given_.user);
  }

  /// Says that what the caller gave is released with the shape.
  void keep() { is_kept_ = true; }

  BoundingBox bounds() const override {
    return {.lower = to_vec3(given_.lower, "lower"), .upper = to_vec3(given_.upper, "upper")};
  }

  void crossings(const Ray& ray, std::vector<CustomCrossing>& out) const override {
    const crt_ray line = {{ray.origin.x, ray.origin.y, ray.origin.z},
                          {ray.direction.x, ray.direction.y, ray.direction.z},
                          ray.t_min,
                          ray.t_max};
    constexpr std::size_t usual = 16;
    std::array<crt_custom_crossing, usual> few;
    const std::size_t count = ask(line, few.data(), few.size());
    if (count <= few.size()) {
      append(few.data(), count, out);
      return;
    }
    if (count > most_crossings) refuse_count(count);
    std::vector<crt_custom_crossing> all(count);
    const std::size_t again = ask(line, all.data(), all.size());
    if (again > count) refuse_count(again);
    append(all.data(), again, out);
  }

  CustomPoint point(const Vec3& position, std::uint32_t face) const override {
    const std::array<double, 3> place = {position.x, position.y, position.z};
    crt_custom_point found{};
    stop_for(given_.point(place.data(), face, &found, given_.user));
    return {.normal = to_vec3(found.normal, "normal"), .u = found.u, .v = found.v};
  }

  std::uint32_t face_count() const override { return given_.face_count; }
  std::string name() const override { return name_; }

 private:
  static void stop_for(int answer) {
    if (answer != 0) throw CancelledByCallback{answer};
  }

  [[noreturn]] void refuse_count(std::size_t count) const {
    throw Error(ErrorCode::invalid_argument,
                name_ + ": there cannot be " + std::to_string(count) + " crossings", "crossings");
  }

  std::size_t ask(const crt_ray& ray, crt_custom_crossing* crossings, std::size_t capacity) const {
    std::size_t count = 0;
    stop_for(given_.crossings(&ray, crossings, capacity, &count, given_.user));
    return count;
  }

  static void append(const crt_custom_crossing* crossings, std::size_t count,
                     std::vector<CustomCrossing>& out) {
    std::transform(crossings, crossings + count, std::back_inserter(out),
                   [](const crt_custom_crossing& crossing) {
                     return CustomCrossing{
                         .t = crossing.t, .error = crossing.error, .face = crossing.face};
                   });
  }

  crt_custom given_;
  std::string name_;
  bool is_kept_ = false;
};

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_custom_init(crt_custom* custom, size_t struct_size) {
  return guarded([&] { initialise(custom, struct_size, defaults<crt_custom>()); });
}

crt_status crt_custom_create(const crt_custom* custom, crt_entity** out) {
  return create(out, [&] {
    const auto given = taken(custom, "custom");
    if (given.crossings == nullptr) reject("crossings", "must not be NULL");
    if (given.point == nullptr) reject("point", "must not be NULL");
    const auto shape = std::make_shared<CalledBack>(given);
    crt::Entity entity = crt::Custom{.shape = shape};
    shape->keep();
    return entity;
  });
}
