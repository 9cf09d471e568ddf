// Revolutions of the exact tier find where the line crosses each body without rounding.
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/known_places.hpp"
#include "core/geometry/revolution/revolution.hpp"

namespace crt::core {

namespace {

using ExactBodies = std::vector<std::unique_ptr<const ExactShape>>;

/// Returns the ray with another start. It is kept in `near`, which must outlive it.
ExactRay started_on(const TurnedProfile& turned, std::uint32_t body, const ExactRay& ray,
                    ObjectRay& near) {
  near = ray.near;
  near.start = turned.start_on(body, ray.near.start);
  near.begin = -std::numeric_limits<double>::infinity();
  near.first_wanted_after = std::numeric_limits<double>::infinity();
  return ray.seen_as(near);
}

std::optional<RealRoot> place_on(const TurnedProfile& turned, const ExactBodies& bodies,
                                 const ExactRay& ray, Crossing crossing) {
  if (is_start(ray, crossing)) return RealRoot::at(0);
  const std::uint32_t body = body_of_face(crossing.face);
  crossing.face = 0;
  ObjectRay near;
  return bodies[body]->place(started_on(turned, body, ray, near), crossing);
}

class ExactTier final : public RevolutionTier {
 public:
  ExactTier(const TurnedProfile& turned, const ExactBodies& bodies, const ExactRay& ray)
      : turned_(turned), bodies_(bodies), ray_(ray) {}

  bool meet(std::uint32_t body, const FaceStart&, CrossingList& out) const override {
    ObjectRay near;
    return bodies_[body]->crossings(started_on(turned_, body, ray_, near), out);
  }

  int order(const Crossing& first, const Crossing& second) const override {
    if (are_on_one_surface(*turned_.profile, first.face, second.face) &&
        first.root == second.root) {
      return 0;
    }
    const auto find = [this](const Crossing& crossing) {
      return place_on(turned_, bodies_, ray_, crossing);
    };
    return places_.order(first, second, find);
  }

  ExactLine exact() const override { return ray_.exact(); }

  void place(const DoubleDouble& t, Crossing& crossing) const override {
    crossing = exact_crossing(t, crossing);
  }

 private:
  const TurnedProfile& turned_;
  const ExactBodies& bodies_;
  const ExactRay& ray_;
  mutable KnownPlaces places_;
};

class ExactRevolutionShape final : public ExactShape {
 public:
  explicit ExactRevolutionShape(const Revolution& revolution)
      : turned_(revolution), bodies_(turned_.body_count()) {
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i] = make_exact_shape(turned_.body(i));
    }
  }

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    append_crossings(turned_, ray.near, ExactTier(turned_, bodies_, ray), out);
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    return place_on(turned_, bodies_, ray, crossing);
  }

  ExactSurface surface(std::uint32_t face) const override {
    return bodies_[turned_.body_of_surface(face)]->surface(0);
  }

  /// Returns only its own bytes, and not those of the profile.
  std::size_t bytes() const override {
    std::size_t bytes = sizeof *this + bodies_.capacity() * sizeof(bodies_[0]);
    for (const auto& body : bodies_) bytes += body->bytes();
    return bytes;
  }

 private:
  TurnedProfile turned_;
  ExactBodies bodies_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Revolution& revolution) {
  return std::make_unique<ExactRevolutionShape>(revolution);
}

}  // namespace crt::core
