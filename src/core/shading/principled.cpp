#include "core/shading/principled.hpp"

#include <numbers>

#include "core/shading/fresnel.hpp"
#include "core/shading/microfacets.hpp"

namespace crt::core {

namespace {

constexpr double inverse_pi = 1 / std::numbers::pi;

template <class Real>
Real largest_channel(const Vec3Of<Real>& color) {
  return max(max(color.x, color.y), color.z);
}

/// Returns a / b, or 0 where b is 0.
template <class Real>
Real quotient(const Real& a, const Real& b) {
  const auto is_defined = b > 0.0;
  return select(is_defined, Real(a / select(is_defined, b, broadcast<Real>(1))), Real{});
}

template <class Real>
Vec3Of<Real> grey_of(const Real& value) {
  return {value, value, value};
}

/// Tables are those of the lanes.
template <class Real>
using Tables = std::array<const SharesTable*, lanes_in<Real>>;

/// Looks up shares in the lanes that have tables: look_up(table, lane).
template <class Real, class LookUp>
LayerShares<Real> shares_by_lane(const Tables<Real>& tables, const LookUp& look_up) {
  LayerShares<Real> shares;
  for (std::size_t lane = 0; lane < lanes_in<Real>; ++lane) {
    if (tables[lane] == nullptr) continue;
    const LayerShares<double> one = look_up(*tables[lane], lane);
    set_lane(shares.below_sheen, lane, one.below_sheen);
    set_lane(shares.below_coat, lane, one.below_coat);
    set_lane(shares.above, lane, one.above);
    set_lane(shares.metal, lane, one.metal);
    set_lane(shares.dielectric, lane, one.dielectric);
    set_lane(shares.transparent, lane, one.transparent);
  }
  return shares;
}

template <class Real>
LayerShares<Real> shares_at(const Tables<Real>& tables, const Real& cosine, const Real& roughness) {
  return shares_by_lane<Real>(tables, [&](const SharesTable& table, std::size_t lane) {
    return table.at(lane_of(cosine, lane), lane_of(roughness, lane));
  });
}

template <class Real>
LayerShares<Real> mean_shares(const Tables<Real>& tables, const Real& roughness) {
  return shares_by_lane<Real>(tables, [&](const SharesTable& table, std::size_t lane) {
    return table.mean(lane_of(roughness, lane));
  });
}

/// Choice has the probabilities of what sample() follows.
template <class Real>
struct Choice {
  Real coat{};
  Real facets{};        ///< those of the surface below
  Real wide{};          ///< what else is scattered back, mostly at grazing angles
  Real wide_through{};  ///< or behind the surface
};

/// A Scatterer is a surface that is seen from a direction. Directions are in the normal's frame.
template <class Real>
class Scatterer {
 public:
  using Vector = Vec3Of<Real>;
  using Mask = MaskOf<Real>;

  Scatterer(const PrincipledSurface<Real>& surface, const Vector& to_viewer);

  Scattering<Real> scattering(const Vector& i) const;
  ScatteredRay<Real> sample(const std::array<Real, 3>& numbers) const;

 private:
  static Vector seen_from_front(const Vector& o) {
    constexpr double lowest_height = 1e-9;
    return {o.x, o.y, max(broadcast<Real>(lowest_height), o.z)};
  }

  /// Returns Fresnel's share for the cosine between a direction and a microfacet's normal.
  Real glass(const Real& cosine) const {
    return fresnel_reflectance<Real>(min(broadcast<Real>(1), cosine), broadcast<Real>(1),
                                     surface_.relative_index);
  }
  static Real glass_of_coat(const Real& cosine) {
    return fresnel_reflectance<Real>(min(broadcast<Real>(1), cosine), broadcast<Real>(1),
                                     broadcast<Real>(coat_index));
  }
  /// Returns what a microfacet of the mixture mirrors, if that is Fresnel's share.
  Vector mirrored(const Real& cosine, const Real& glass_share) const {
    return metal_ * metal_reflectance<Real>(surface_.color, cosine) +
           grey_of<Real>((1.0 - metal_) * glass_share);
  }
  /// Returns which share of rays that go on from such a microfacet is mirrored.
  Real mirrored_choice(const Vector& mirrored, const Real& glass_share) const {
    const Real back = largest_channel<Real>(mirrored);
    const Real through = transparent_ * (1.0 - glass_share) * brightest_;
    return select(through > 0.0, quotient<Real>(back, back + through), broadcast<Real>(1));
  }

  void set_even_scattering();
  void set_choice();
  void set_mirrored(const Vector& i, const LayerShares<Real>& of_i, Scattering<Real>& sum) const;
  void set_through(const Vector& i, const LayerShares<Real>& of_i, Scattering<Real>& sum) const;
  void add_evenly(const Vector& i, const LayerShares<Real>& of_i, Scattering<Real>& sum) const;
  LayerShares<Real> shares_of(const Vector& i) const;
  void set_delta(const Mask& mirrors, const Mask& lets_through, const Real& mirrored_share,
                 ScatteredRay<Real>& ray) const;

  const PrincipledSurface<Real>& surface_;
  Vector o_;
  Real metal_;
  Real opaque_;       ///< the share of the dielectric that lets nothing through
  Real transparent_;  ///< and of that which does
  Real brightest_;    ///< channel of the colour
  Microfacets<Real> facets_;
  Microfacets<Real> coat_facets_;
  Mask is_straight_;
  LayerShares<Real> of_o_;
  // What is scattered evenly is a factor for each part of the mixture, times the shares of both
  // directions.
  Vector even_metal_;
  Vector even_body_;
  Real even_transparent_{};
  Vector even_through_;
  Choice<Real> choice_;
};

template <class Real>
Scatterer<Real>::Scatterer(const PrincipledSurface<Real>& surface, const Vector& to_viewer)
    : surface_(surface),
      o_(seen_from_front(to_viewer)),
      metal_(surface.metallic),
      opaque_((1.0 - surface.metallic) * (1.0 - surface.transmission)),
      transparent_((1.0 - surface.metallic) * surface.transmission),
      brightest_(largest_channel<Real>(surface.color)),
      facets_{width_of<Real>(surface.roughness)},
      coat_facets_{width_of<Real>(surface.coat_roughness)},
      is_straight_(is_straight<Real>(surface.relative_index)),
      of_o_(shares_at<Real>(surface.before, o_.z, surface.roughness)) {
  set_even_scattering();
  set_choice();
}

/// Sets the factors of what is scattered evenly. What is left of light from i goes to o in
/// proportion to what would be left of light from o. So the sum is right, and the light takes the
/// same way back.
template <class Real>
void Scatterer<Real>::set_even_scattering() {
  const LayerShares<Real> before = mean_shares<Real>(surface_.before, surface_.roughness);
  const LayerShares<Real> behind = mean_shares<Real>(surface_.behind, surface_.roughness);
  // A metal mirrors what it keeps at least twice: Kulla, Conty, slide 16. Schlick's mean is 1 / 21
  // of the way to white.
  const Vector mean = (20.0 / 21.0) * surface_.color + grey_of<Real>(broadcast<Real>(1.0 / 21.0));
  const Vector tint = (1.0 - before.metal) * (mean * mean) /
                      (grey_of<Real>(broadcast<Real>(1 + 1e-30)) - before.metal * mean);
  even_metal_ = metal_ * inverse_pi * quotient<Real>(broadcast<Real>(1), before.metal) * tint;
  even_body_ =
      opaque_ * inverse_pi * quotient<Real>(broadcast<Real>(1), before.dielectric) * surface_.color;
  // Light that is scattered in a boundary leaves to both sides, by how much each could take up.
  const Real square = surface_.relative_index * surface_.relative_index;
  const Real all = before.transparent + square * behind.transparent;
  const Real factor = transparent_ * inverse_pi * quotient<Real>(broadcast<Real>(1), all);
  even_transparent_ = factor;
  even_through_ = factor * square * surface_.color;
  // The choices are albedos here.
  const Real scattered = std::numbers::pi * of_o_.transparent;
  choice_.wide = 1.0 - of_o_.below_sheen + metal_ * of_o_.metal * largest_channel<Real>(tint) +
                 scattered * before.transparent * factor;
  choice_.wide_through = scattered * behind.transparent * largest_channel<Real>(even_through_);
}

/// Sets the probabilities of choices by the light that each stands for.
template <class Real>
void Scatterer<Real>::set_choice() {
  // A dark metal still mirrors at grazing angles.
  constexpr double least_of_metal = 0.05;
  const Real glass_share = glass(o_.z);
  const Real of_metal = max(broadcast<Real>(least_of_metal),
                            largest_channel<Real>(metal_reflectance<Real>(surface_.color, o_.z)));
  const Real of_glass = glass_share + (1.0 - glass_share) * brightest_;
  const auto kept = [&](const Real& left) { return max(Real{}, Real(1.0 - of_o_.above - left)); };
  choice_.facets = metal_ * kept(of_o_.metal) * of_metal + opaque_ * kept(of_o_.dielectric) +
                   transparent_ * kept(of_o_.transparent) * of_glass;
  choice_.coat = max(Real{}, Real(of_o_.above - (1.0 - of_o_.below_sheen)));
  const Real sum = choice_.coat + choice_.facets + choice_.wide + choice_.wide_through;
  const Real scale = quotient<Real>(broadcast<Real>(1), sum);
  choice_.coat = scale * choice_.coat;
  choice_.facets = scale * choice_.facets;
  choice_.wide = scale * choice_.wide;
  choice_.wide_through = scale * choice_.wide_through;
}

/// Sets what microfacets and fibres send to the viewer's side, but for perfect mirrors.
template <class Real>
void Scatterer<Real>::set_mirrored(const Vector& i, const LayerShares<Real>& of_i,
                                   Scattering<Real>& sum) const {
  const Vector h = of_unit_length<Real>(o_ + i);
  const Real cosine = dot(o_, h);
  const Real glass_share = glass(cosine);
  const Vector by_facet = mirrored(cosine, glass_share);
  const auto is_rough = facets_.alpha > 0.0;
  const Real normals = select(is_rough, facets_.density(h), Real{});
  const Real layers = of_o_.below_coat * of_i.below_coat;
  sum.value = (layers * normals * facets_.visibility(o_, i) * i.z) * by_facet;
  sum.density = choice_.facets * mirrored_choice(by_facet, glass_share) * normals /
                (2.0 * (o_.z + facets_.reach(o_)));

  const Real coat_normals = select(coat_facets_.alpha > 0.0, coat_facets_.density(h), Real{});
  const Real coat = of_o_.below_sheen * of_i.below_sheen * surface_.coat * glass_of_coat(cosine) *
                    coat_normals * coat_facets_.visibility(o_, i) * i.z;
  sum.density += choice_.coat * coat_normals / (2.0 * (o_.z + coat_facets_.reach(o_)));
  const Real sheen = surface_.sheen * fibres<Real>(o_, i) * i.z;
  sum.value = sum.value + grey_of<Real>(coat + sheen);
}

/// Sets what microfacets let through, but for clear glass: Walter and others 2007, section 4.2.
template <class Real>
void Scatterer<Real>::set_through(const Vector& i, const LayerShares<Real>& of_i,
                                  Scattering<Real>& sum) const {
  const Real& index = surface_.relative_index;
  const Vector along = o_ + index * i;
  const auto is_upwards = along.z > 0.0;
  const Real length = sqrt(dot(along, along));
  const auto is_rough = (facets_.alpha > 0.0) & !is_straight_ & (length > 0.0);
  const Real inverse = 1.0 / select(is_rough, length, broadcast<Real>(1));
  const Vector h = select(is_upwards, inverse, Real(-inverse)) * along;
  const Real cosine_o = dot(o_, h);
  const Real cosine_i = -dot(i, h);
  const auto is_seen = is_rough & (cosine_o > 0.0) & (cosine_i > 0.0);
  // Both sides have the same share. There is no total reflection on the thinner one.
  const auto is_thin = index > 1.0;
  const Real share = 1.0 - fresnel_reflectance<Real>(
                               min(broadcast<Real>(1), select(is_thin, cosine_o, cosine_i)),
                               broadcast<Real>(1), select(is_thin, index, Real(1.0 / index)));
  const Real normals = select(is_seen, facets_.density(h), Real{});
  const Real per_solid_angle = index * index * max(Real{}, cosine_i) * inverse * inverse;
  const Real layers = of_o_.below_coat * of_i.below_coat;
  // G1(o) / o.z is 2 / (o.z + reach).
  const Real seen_of_o = 2.0 / (o_.z + facets_.reach(o_));
  const Real visible = normals * max(Real{}, cosine_o) * seen_of_o * per_solid_angle;
  sum.value = (transparent_ * layers * share * facets_.seen(i) * visible) * surface_.color;
  const Real glass_share = glass(max(Real{}, cosine_o));
  const Real choice = 1.0 - mirrored_choice(mirrored(cosine_o, glass_share), glass_share);
  sum.density = choice_.facets * choice * visible;
}

template <class Real>
void Scatterer<Real>::add_evenly(const Vector& i, const LayerShares<Real>& of_i,
                                 Scattering<Real>& sum) const {
  const auto is_back = i.z > 0.0;
  const Real height = abs(i.z);
  sum.body = select(is_back, height * of_o_.dielectric * of_i.dielectric * even_body_, Vector{});
  const Vector back = of_o_.metal * of_i.metal * even_metal_ +
                      grey_of<Real>(of_o_.transparent * of_i.transparent * even_transparent_);
  const Vector through = of_o_.transparent * of_i.transparent * even_through_;
  sum.value = sum.value + sum.body + height * select(is_back, back, through);
  sum.density += 0.5 * inverse_pi * select(is_back, choice_.wide, choice_.wide_through);
}

/// Returns the shares of a direction on its side.
template <class Real>
LayerShares<Real> Scatterer<Real>::shares_of(const Vector& i) const {
  Tables<Real> tables;
  for (std::size_t lane = 0; lane < tables.size(); ++lane)
    tables[lane] = lane_of(i.z, lane) > 0 ? surface_.before[lane] : surface_.behind[lane];
  return shares_at<Real>(tables, abs(i.z), surface_.roughness);
}

template <class Real>
Scattering<Real> Scatterer<Real>::scattering(const Vector& i) const {
  const LayerShares<Real> of_i = shares_of(i);
  const auto is_back = i.z > 0.0;
  Scattering<Real> back;
  Scattering<Real> through;
  if (any(is_back)) set_mirrored(select(is_back, i, o_), of_i, back);
  if (!all(is_back)) set_through(i, of_i, through);
  Scattering<Real> sum = {.value = select(is_back, back.value, through.value),
                          .body = {},
                          .density = select(is_back, back.density, through.density)};
  add_evenly(i, of_i, sum);
  return sum;
}

/// Sets the weights of rays that perfect mirrors and clear glass send on.
template <class Real>
void Scatterer<Real>::set_delta(const Mask& mirrors, const Mask& lets_through,
                                const Real& mirrored_share, ScatteredRay<Real>& ray) const {
  const auto both = mirrors | lets_through;
  if (!any(both)) return;
  const LayerShares<Real> of_i = shares_of(ray.direction);
  const Real layers = quotient<Real>(of_o_.below_coat * of_i.below_coat, choice_.facets);
  const Real glass_share = glass(o_.z);
  const Vector back = quotient<Real>(layers, mirrored_share) * mirrored(o_.z, glass_share);
  const Vector through =
      (quotient<Real>(layers, 1.0 - mirrored_share) * transparent_ * (1.0 - glass_share)) *
      surface_.color;
  ray.weight = select(both, select(mirrors, back, through), ray.weight);
  ray.density = select(both, Real{}, ray.density);
  ray.is_delta = both;
}

template <class Real>
ScatteredRay<Real> Scatterer<Real>::sample(const std::array<Real, 3>& numbers) const {
  const auto& [choice, u, v] = numbers;
  const Real up_to_facets = choice_.coat + choice_.facets;
  const auto is_coat = choice < choice_.coat;
  const auto is_even = !(choice < up_to_facets);
  const auto is_facet = !(is_coat | is_even);
  const auto is_back = choice < up_to_facets + choice_.wide;

  // These are even by the cosine.
  const PlanePointOf<Real> in_disc = point_of_disc(u, v);
  const Real squared = in_disc.x * in_disc.x + in_disc.y * in_disc.y;
  const Real stretch = sqrt(Real(2.0 - squared));
  const Real height = max(Real{}, Real(1.0 - squared));
  const Vector evenly = {stretch * in_disc.x, stretch * in_disc.y,
                         select(is_back, height, Real(-height))};

  const Microfacets<Real> facets = {select(is_coat, coat_facets_.alpha, facets_.alpha)};
  const Vector h = facets.visible_normal(o_, in_disc);
  const auto refraction = refract<Real>(-o_, h, broadcast<Real>(1), surface_.relative_index);
  const Real cosine = dot(o_, h);
  const Real mirrored_share =
      mirrored_choice(mirrored(cosine, refraction.reflectance), refraction.reflectance);
  // What is left of the number is even again.
  const Real rest = quotient<Real>(choice - choice_.coat, choice_.facets);
  const auto is_through_facet = is_facet & (rest >= mirrored_share);
  const Vector by_facet = select(is_through_facet, select(is_straight_, -o_, refraction.direction),
                                 2.0 * cosine * h - o_);

  ScatteredRay<Real> ray;
  ray.direction = select(is_even, evenly, by_facet);
  ray.is_transmitted = select(is_even, !is_back, is_through_facet);
  const auto is_possible = select(ray.is_transmitted, ray.direction.z<0.0, ray.direction.z> 0.0);
  const Scattering<Real> found = scattering(ray.direction);
  ray.density = found.density;
  ray.weight = quotient<Real>(broadcast<Real>(1), found.density) * (found.value - found.body);

  const auto is_smooth = facets.alpha == 0.0;
  ray.is_delta = is_coat & is_even;  // none
  set_delta(is_facet & (rest < mirrored_share) & is_smooth,
            is_through_facet & (is_smooth | is_straight_), mirrored_share, ray);
  const auto is_coat_mirror = is_coat & is_smooth;
  if (any(is_coat_mirror)) {
    const LayerShares<Real> of_i = shares_of(ray.direction);
    const Real weight = quotient<Real>(
        of_o_.below_sheen * of_i.below_sheen * surface_.coat * glass_of_coat(o_.z), choice_.coat);
    ray.weight = select(is_coat_mirror, grey_of<Real>(weight), ray.weight);
    ray.density = select(is_coat_mirror, Real{}, ray.density);
    ray.is_delta = ray.is_delta | is_coat_mirror;
  }
  ray.weight = select(is_possible, ray.weight, Vector{});
  return ray;
}

}  // namespace

template <class Real>
Scattering<Real> evaluate(const PrincipledSurface<Real>& surface, const Vec3Of<Real>& to_viewer,
                          const Vec3Of<Real>& normal, const Vec3Of<Real>& to_light) {
  const NormalFrame<Real> frame(normal);
  return Scatterer<Real>(surface, frame.to_frame(to_viewer)).scattering(frame.to_frame(to_light));
}

template <class Real>
ScatteredRay<Real> sample(const PrincipledSurface<Real>& surface, const Vec3Of<Real>& to_viewer,
                          const Vec3Of<Real>& normal, const std::array<Real, 3>& numbers) {
  const NormalFrame<Real> frame(normal);
  ScatteredRay<Real> ray = Scatterer<Real>(surface, frame.to_frame(to_viewer)).sample(numbers);
  ray.direction = frame.to_world(ray.direction);
  return ray;
}

template Scattering<double> evaluate(const PrincipledSurface<double>&, const Vec3&, const Vec3&,
                                     const Vec3&);
template Scattering<Lanes> evaluate(const PrincipledSurface<Lanes>&, const VectorLanes&,
                                    const VectorLanes&, const VectorLanes&);
template ScatteredRay<double> sample(const PrincipledSurface<double>&, const Vec3&, const Vec3&,
                                     const std::array<double, 3>&);
template ScatteredRay<Lanes> sample(const PrincipledSurface<Lanes>&, const VectorLanes&,
                                    const VectorLanes&, const std::array<Lanes, 3>&);

}  // namespace crt::core
