#include "core/shading/prepared_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <glm/common.hpp>
#include <numbers>
#include <type_traits>

#include "core/math/direction_and_length.hpp"
#include "core/math/plane_point.hpp"
#include "core/shading/image_mapping.hpp"
#include "core/shading/noise.hpp"
#include "core/shading/rgb.hpp"

namespace crt::core {

namespace {

/// Returns where in its period a coordinate is, in [0, 1), or 0 where doubles cannot resolve it.
template <class Real>
Real period_share(const Real& coordinate) {
  const Real share = coordinate - floor(coordinate);
  return select(share < 1.0, share, Real{});  // also for NaN, from coordinates beyond all bounds
}

/// Returns whether a whole number is odd, exactly. NaN counts as odd, as its remainder is not 0.
template <class Real>
auto is_odd(const Real& whole_number) {
  return whole_number - 2.0 * floor(0.5 * whole_number) != 0.0;
}

/// Goes from 0 to 1 and back, smoothly, once a period.
double wave(double coordinate) {
  return 0.5 - 0.5 * elementary::cos(2 * std::numbers::pi * period_share(coordinate));
}

/// Returns a point a little under the surface. A surface that lies exactly on an edge of a pattern
/// then has the colour inside of it, and not a mixture that rounding makes.
template <class Real>
Vec3Of<Real> under_surface(const SurfacePointOf<Real>& point, double scale) {
  constexpr double of_scale = 0x1p-20;
  constexpr double of_coordinates = 0x1p-48;
  const Real least = broadcast<Real>(scale * of_scale);
  const Real depth = of_coordinates * largest_component(point.position);
  return point.position - select(least < depth, depth, least) * point.normal;
}

template <class Real = double, class Solid>
Vec3Of<Real> in_periods(const Solid& pattern, const Vec3Of<Real>& position) {
  return (position - broadcast<Real>(pattern.offset)) / broadcast<Real>(pattern.scale);
}

// For patterns of two colours with an edge between them, is_second() returns whether the second
// colour is seen.

template <class Real>
auto is_second(const Checker& checker, const SurfacePointOf<Real>& point) {
  const auto cell = floor(in_periods<Real>(checker, under_surface(point, checker.scale)));
  return is_odd(cell.x) != (is_odd(cell.y) != is_odd(cell.z));
}

template <class Real>
auto is_second(const Stripes& stripes, const SurfacePointOf<Real>& point) {
  const auto place = in_periods<Real>(stripes, under_surface(point, stripes.scale));
  return period_share(dot(place, broadcast<Real>(stripes.direction))) >= 0.5;
}

template <class Kind>
constexpr bool has_edges = requires(const Kind& kind, const SurfacePoint& point) {
  is_second(kind, point);
};

// For the other patterns of two colours, share_of() returns how much of the second is seen.

double share_of(const Gradient& gradient, const SurfacePoint& point) {
  const Vec3 place = in_periods(gradient, point.position);
  return wave(glm::dot(place, gradient.direction));
}

double share_of(const Noise& noise, const SurfacePoint& point) {
  const double level = fractal_noise(in_periods(noise, point.position), noise.octaves);
  return 0.5 + 0.5 * level;
}

double share_of(const Marble& marble, const SurfacePoint& point) {
  const Vec3 place = in_periods(marble, point.position);
  const double shift = marble.turbulence * fractal_noise(place, marble.octaves);
  return wave(glm::dot(place, marble.direction) + shift);
}

double share_of(const Wood& wood, const SurfacePoint& point) {
  const Vec3 place = in_periods(wood, point.position);
  const Vec3 from_line = place - glm::dot(place, wood.direction) * wood.direction;
  const double shift = wood.turbulence * fractal_noise(place, wood.octaves);
  return wave(direction_and_length(from_line).length + shift);
}

/// Returns the colour between the stops around a share.
Color color_between(const std::vector<ColorStop>& stops, double share) {
  const auto after =
      std::upper_bound(stops.begin(), stops.end(), share,
                       [](double value, const ColorStop& stop) { return value < stop.position; });
  if (after == stops.begin()) return stops.front().color;
  if (after == stops.end()) return stops.back().color;
  const ColorStop& before = *(after - 1);
  return mix(before.color, after->color,
             (share - before.position) / (after->position - before.position));
}

/// Returns the place in a map's picture, in texels.
PlanePoint place_in(const ImageMap& map, const Texture& texture, const SurfacePoint& point) {
  const PictureCoordinates at =
      map.mapping == ImageMapping::uv ? PictureCoordinates{point.u, point.v} : mapped(map, point);
  // v runs up the surface, rows run down the picture.
  return {period_share(at.u * map.repeat_u) * texture.width(),
          (1 - period_share(at.v * map.repeat_v)) * texture.height()};
}

Color color_of(const ImageMap& map, const Texture& texture, const SurfacePoint& point) {
  const PlanePoint place = place_in(map, texture, point);
  return texture.bilinear(place.x, place.y, TextureWrap::repeat, TextureWrap::repeat);
}

/// Returns the colour of any pattern. Only an image map has a texture.
template <class Kind>
Color color_at(const Kind& kind, const Texture* texture, const SurfacePoint& point) {
  if constexpr (has_edges<Kind>) {
    return is_second(kind, point) ? kind.color_b : kind.color_a;
  } else if constexpr (std::is_same_v<Kind, ImageMap>) {
    return color_of(kind, *texture, point);
  } else {
    return mix(kind.color_a, kind.color_b, share_of(kind, point));
  }
}

template <class Kind>
ColorLanes colors_at(const Kind& kind, const Texture* texture, const SurfacePointLanes& points,
                     std::uint32_t lanes) {
  if constexpr (has_edges<Kind>) {
    return select(is_second(kind, points), lanes_of(kind.color_b), lanes_of(kind.color_a));
  } else if constexpr (std::is_same_v<Kind, ImageMap>) {
    PlanePointLanes places;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if ((lanes >> lane & 1u) == 0) continue;
      set_lane(places, lane, place_in(kind, *texture, lane_of(points, lane)));
    }
    return texture->bilinear(places.x, places.y, TextureWrap::repeat, TextureWrap::repeat, lanes);
  } else {
    ColorLanes result;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if ((lanes >> lane & 1u) != 0)
        result.set(lane, color_at(kind, texture, lane_of(points, lane)));
    }
    return result;
  }
}

template <class Solid>
constexpr bool has_direction = requires(Solid pattern) {
  pattern.direction;
};

}  // namespace

template <class Kind>
void PreparedPattern::prepare_colors(const Kind& kind, TexturePool& textures) {
  const auto take_color = [this](const Color& color) {
    opaque_ = opaque_ && color.a == 1;
    brightest_ = std::max(brightest_, brightest_channel(color));
  };
  if constexpr (requires { kind.colors; }) {
    is_composed_ = !kind.colors.empty();
    for (const ColorStop& stop : kind.colors) take_color(stop.color);
    if (is_composed_) return;
  }
  const auto take_side = [&](const Color& color, const SharedPattern& pattern,
                             std::shared_ptr<const PreparedPattern>& prepared) {
    if (!pattern) return take_color(color);
    is_composed_ = true;
    prepared = std::make_shared<const PreparedPattern>(pattern->pattern, textures);
    uses_uv_ = uses_uv_ || prepared->uses_uv();
    opaque_ = opaque_ && prepared->opaque();
    brightest_ = std::max(brightest_, prepared->brightest());
  };
  take_side(kind.color_a, kind.pattern_a, pattern_a_);
  take_side(kind.color_b, kind.pattern_b, pattern_b_);
}

PreparedPattern::PreparedPattern(const Pattern& pattern, TexturePool& textures)
    : pattern_(pattern) {
  std::visit(
      [&](auto& kind) {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, ImageMap>) {
          texture_ = textures.get(kind.image);
          uses_uv_ = kind.mapping == ImageMapping::uv;
          opaque_ = texture_->opaque();
          brightest_ = texture_->brightest();
        } else {
          prepare_colors(kind, textures);
        }
        if constexpr (has_direction<Kind>)
          kind.direction = direction_and_length(kind.direction).direction;
      },
      pattern_);
}

/// Returns the colour of a pattern of other patterns or of several colours.
Color PreparedPattern::composed_color(const SurfacePoint& point) const {
  const auto color_of_side = [&](const auto& side, const Color& color) {
    return side ? side->color(point) : color;
  };
  return std::visit(
      [&](const auto& kind) -> Color {
        using Kind = std::decay_t<decltype(kind)>;
        if constexpr (std::is_same_v<Kind, ImageMap>) {
          return color_of(kind, *texture_, point);
        } else if constexpr (has_edges<Kind>) {
          return is_second(kind, point) ? color_of_side(pattern_b_, kind.color_b)
                                        : color_of_side(pattern_a_, kind.color_a);
        } else {
          const double share = share_of(kind, point);
          if (!kind.colors.empty()) return color_between(kind.colors, share);
          return mix(color_of_side(pattern_a_, kind.color_a),
                     color_of_side(pattern_b_, kind.color_b), share);
        }
      },
      pattern_);
}

Color PreparedPattern::color(const SurfacePoint& point) const {
  if (is_composed_) return composed_color(point);
  return std::visit([&](const auto& kind) { return color_at(kind, texture_.get(), point); },
                    pattern_);
}

ColorLanes PreparedPattern::colors(const SurfacePointLanes& points, std::uint32_t lanes) const {
  if (is_composed_) {
    ColorLanes result;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      if ((lanes >> lane & 1u) != 0) result.set(lane, composed_color(lane_of(points, lane)));
    }
    return result;
  }
  return std::visit(
      [&](const auto& kind) { return colors_at(kind, texture_.get(), points, lanes); }, pattern_);
}

}  // namespace crt::core
