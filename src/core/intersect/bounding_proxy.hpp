// Conservative tests spare most exact ones: they say whether a line surely misses an object, or
// surely meets it.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/csg/evaluate.hpp"
#include "core/geometry/frustum/enclose.hpp"
#include "core/geometry/plane/enclose.hpp"
#include "core/geometry/sphere/enclose.hpp"
#include "core/geometry/torus/enclose.hpp"
#include "core/intersect/proxy_box.hpp"

namespace crt::core {

/// A BoundingProxy is an object as the conservative tests see it. It is small, as rays come by many
/// of them. Objects have one if scenes have many of them and their exact test costs much more.
struct BoundingProxy {
  enum class Kind : std::uint8_t { unknown, sphere, moved_sphere, plane, torus, cylinder, box };

  Kind kind = Kind::unknown;
  /// This says whether there is a conservative test of the object.
  bool has_test = false;
  /// If it encloses the object, which is somewhere within, only what misses it is sure.
  bool encloses = false;
  std::uint32_t object = nothing;
  std::uint32_t surface =
      nothing;  ///< its whole surface, or that of what encloses it; a box has six
  /// For a sphere this is its leaf, if the proxy alone gives its crossings: in the standard tier,
  /// without a transform. For others it is the number of their ProxyAxis or ProxyBox.
  std::uint32_t detail = nothing;
  Vec3 place{0, 0, 0};  ///< the center, or a point of the plane
  double radius = 0;    ///< the torus's is that of its ring

  bool has_axis() const {
    return kind != Kind::unknown && kind != Kind::sphere && kind != Kind::box;
  }
  bool is_sphere() const { return kind == Kind::sphere || kind == Kind::moved_sphere; }
};

/// A ProxyAxis has what some proxies need besides.
struct ProxyAxis {
  Vec3 normal{
      0, 0,
      0};  ///< of the plane, its largest component about 1; the axis of the torus or the cylinder
  double thickness =
      0;  ///< of the torus, and a little more for all roundings on the offset to the world
  /// The leaf is as BoundingProxy::detail has it for a sphere. Planes across a coordinate axis have
  /// one, and tori, moved spheres, cylinders and cones.
  std::uint32_t leaf = nothing;
  /// The caps are surfaces of a cylinder or cone, if it has them.
  std::array<std::uint32_t, 2> caps = {nothing, nothing};
  const Leaf* moved = nullptr;  ///< that leaf, but for planes, moved or not; the scene owns it
  TypedShape typed;             ///< its shape
};

struct CompiledScene;

struct BoundingProxies {
  std::vector<BoundingProxy> list;
  std::vector<ProxyAxis> axes;
  std::vector<ProxyBox> boxes;

  /// Makes the proxies of some objects, in their order. They are of unknown kind where an object
  /// has none.
  BoundingProxies() = default;
  BoundingProxies(const CompiledScene& scene, std::span<const std::uint32_t> objects,
                  const Workers& workers = {});

  const ProxyAxis& axis(const BoundingProxy& proxy) const { return axes[proxy.detail]; }
  const ProxyBox& box(const BoundingProxy& proxy) const { return boxes[proxy.detail]; }

  /// Returns the leaf of an object whose proxy alone gives its crossings; else nothing.
  std::uint32_t resolved_leaf(const BoundingProxy& proxy) const {
    switch (proxy.kind) {
      case BoundingProxy::Kind::sphere:
        return proxy.detail;
      case BoundingProxy::Kind::moved_sphere:
      case BoundingProxy::Kind::plane:
      case BoundingProxy::Kind::torus:
      case BoundingProxy::Kind::cylinder:
        return axis(proxy).leaf;
      case BoundingProxy::Kind::box:
        return box(proxy).is_resolved ? box(proxy).leaf : nothing;
      default:
        return nothing;
    }
  }
};

/// Returns what encloses a torus.
inline EnclosedTorus enclosed_torus(const BoundingProxy& torus, const ProxyAxis& axis) {
  return {.center = torus.place, .axis = axis.normal, .ring = torus.radius, .tube = axis.thickness};
}

/// Returns whether a ray that starts on a torus and goes outwards leaves it for good.
template <class Real>
MaskOf<Real> leaves_torus(const BoundingProxy& torus, const ProxyAxis& axis,
                          const FilterLine<Real>& line) {
  return leaves_for_good(enclosed_torus(torus, axis), line);
}

/// Decides whether crossings with a proxy that has a test and is no box count up to a limit. `last`
/// is set for a plane, to a t up to which it surely has been met if it is met at all. Nothing else
/// is accepted unless `any_will_do`, as nobody asks for that.
template <class Real>
Decision<MaskOf<Real>> test_proxy(const BoundingProxy& proxy, const BoundingProxies& proxies,
                                  const FilterLine<Real>& line, const Real& limit, bool any_will_do,
                                  Real& last) {
  // Each primitive has its own copy of what follows from its enclosure: much of that is constant.
  const auto by_enclosure = [&](const auto& solid, bool may_accept) {
    const auto all_lines = lanes_of_mask<Real>(~std::uint32_t{0});
    Enclosure<Real> part;
    if (!enclose(solid, line, all_lines, part)) {
      return Decision<MaskOf<Real>>{.rejected = all_lines, .accepted = {}};
    }
    if (proxy.encloses) return Decision<MaskOf<Real>>{is_outside(part, line, limit), {}};
    return decide(part, line, limit, may_accept);
  };
  switch (proxy.kind) {
    case BoundingProxy::Kind::sphere:
    case BoundingProxy::Kind::moved_sphere:
      return by_enclosure(EnclosedSphere{proxy.place, proxy.radius}, any_will_do);
    case BoundingProxy::Kind::torus:
      return by_enclosure(enclosed_torus(proxy, proxies.axis(proxy)), any_will_do);
    case BoundingProxy::Kind::cylinder: {
      const Vec3& axis = proxies.axis(proxy).normal;
      return by_enclosure(EndlessCylinder{proxy.place, axis, proxy.radius}, false);
    }
    default: {
      const auto crossing = enclose(EnclosedPlane{proxy.place, proxies.axis(proxy).normal}, line);
      last = crossing.to;
      return decide(crossing, line, limit);
    }
  }
}

}  // namespace crt::core
