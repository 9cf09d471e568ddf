#include "import/openscad_facets.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <crt/error.hpp>
#include <cstdint>
#include <map>
#include <numbers>
#include <tuple>

#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr double grid_fine = 0.00000095367431640625;  // 2^-20: what is smaller has 3 fragments

/// Makes faces of points, of which equal ones are one.
class FaceBuilder {
 public:
  std::uint32_t point(const Vec3& p) {
    const auto [place, is_new] = places_.try_emplace(
        std::tuple(p.x, p.y, p.z), static_cast<std::uint32_t>(made_.points.size()));
    if (is_new) made_.points.push_back(p);
    return place->second;
  }

  void face(const std::vector<std::uint32_t>& corners) {
    std::vector<std::uint32_t> kept;
    for (const std::uint32_t corner : corners)
      if (kept.empty() || kept.back() != corner) kept.push_back(corner);
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() >= 3) made_.faces.push_back(std::move(kept));
  }

  Faces take() { return std::move(made_); }

 private:
  Faces made_;
  std::map<std::tuple<double, double, double>, std::uint32_t> places_;
};

/// Throws before there is no end to the making of points.
void check_facets(double count) {
  if (count > static_cast<double>(most_facets))
    throw Error(ErrorCode::limit, text::format("it would have over {} facets", most_facets));
}

double helix_length(double radius, double height, double radians) {
  return elementary::hypot(radius * radians, height);
}

/// Is the length of r = a t from t = 0 to an angle (the spiral of Archimedes).
double spiral_length(double a, double t) {
  const double root = std::sqrt(1 + t * t);
  return 0.5 * a * (t * root + elementary::log(t + root));
}

int whole(double number) {
  return static_cast<int>(std::clamp(std::ceil(number), 1.0, 1.0 * most_fragments));
}

int twisted_slices(double radius, const Twist& twist, const Resolution& resolution) {
  const double degrees = std::abs(twist.degrees);
  const int least = std::max(1, whole(degrees / 120));
  if (radius < grid_fine || !std::isfinite(resolution.fn)) return least;
  if (resolution.fn > 0) return std::max(least, whole(degrees / 360 * resolution.fn));
  const double radians = degrees * (std::numbers::pi / 180);
  double length = helix_length(radius, twist.height, radians);
  if (twist.scale_x == twist.scale_y && twist.scale_x != 1) {
    const double scale = twist.scale_x;
    const double end = scale > 1 ? radians * scale / (scale - 1) : radians / (1 - scale);
    const double a = radius / end;
    length =
        elementary::hypot(spiral_length(a, end) - spiral_length(a, end - radians), twist.height);
  }
  return std::max(least, std::min(whole(degrees / resolution.fa), whole(length / resolution.fs)));
}

int scaled_slices(double way, const Twist& twist, const Resolution& resolution) {
  if (way < grid_fine || !std::isfinite(resolution.fn)) return 1;
  if (resolution.fn > 0)
    return std::clamp(static_cast<int>(std::min(resolution.fn, 1.0 * most_fragments)), 1,
                      most_fragments);
  return whole(elementary::hypot(way, twist.height) / resolution.fs);
}

}  // namespace

Resolution resolution_of(const CsgNode& node) {
  Resolution resolution{node.number("$fn", 0), node.number("$fa", 12), node.number("$fs", 2)};
  resolution.fa = std::max(resolution.fa, 0.01);
  resolution.fs = std::max(resolution.fs, 0.01);
  return resolution;
}

int fragments_of(double radius, const Resolution& resolution) {
  if (radius < grid_fine || !std::isfinite(resolution.fn)) return 3;
  if (resolution.fn > 0)
    return static_cast<int>(std::clamp(resolution.fn, 3.0, 1.0 * most_fragments));
  const double around = 2 * std::numbers::pi * radius / resolution.fs;
  return whole(std::max(std::min(360 / resolution.fa, around), 5.0));
}

Faces sphere_facets(double radius, int fragments) {
  const int rings = (fragments + 1) / 2;
  check_facets(static_cast<double>(rings) * fragments);
  FaceBuilder builder;
  std::vector<std::vector<std::uint32_t>> circles;
  for (int ring = 0; ring < rings; ++ring) {
    const double polar = 180.0 * (ring + 0.5) / rings;
    const double across = radius * sine_of_degrees(polar);
    std::vector<std::uint32_t>& circle = circles.emplace_back();
    for (const ProfilePoint& p : circle_contour(0, 0, across, fragments))
      circle.push_back(builder.point({p.x, p.y, radius * cosine_of_degrees(polar)}));
  }
  builder.face(circles.front());
  builder.face(circles.back());
  const auto count = static_cast<std::size_t>(fragments);
  for (std::size_t ring = 1; ring < circles.size(); ++ring) {
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t next = (i + 1) % count;
      builder.face(
          {circles[ring - 1][i], circles[ring - 1][next], circles[ring][next], circles[ring][i]});
    }
  }
  return builder.take();
}

Faces frustum_facets(double z1, double r1, double z2, double r2, int fragments) {
  FaceBuilder builder;
  std::vector<std::uint32_t> low, high;
  for (const ProfilePoint& p : circle_contour(0, 0, 1, fragments)) {
    low.push_back(builder.point({p.x * r1, p.y * r1, z1}));
    high.push_back(builder.point({p.x * r2, p.y * r2, z2}));
  }
  builder.face(low);
  builder.face(high);
  for (std::size_t i = 0; i < low.size(); ++i) {
    const std::size_t next = (i + 1) % low.size();
    builder.face({low[i], low[next], high[next], high[i]});
  }
  return builder.take();
}

int slices_of(const Region& region, const Twist& twist, const Resolution& resolution) {
  double radius = 0, way = 0;
  for (const Contour& contour : region) {
    for (const ProfilePoint& p : contour) {
      radius = std::max(radius, elementary::hypot(p.x, p.y));
      way = std::max(way, elementary::hypot(p.x * (1 - twist.scale_x), p.y * (1 - twist.scale_y)));
    }
  }
  int slices = 1;
  if (twist.degrees != 0) slices = twisted_slices(radius, twist, resolution);
  if (twist.scale_x != twist.scale_y)
    slices = std::max(slices, scaled_slices(way, twist, resolution));
  return slices;
}

Faces twisted_facets(const Contour& contour, const Twist& twist, bool is_hole) {
  check_facets(static_cast<double>(contour.size()) * (twist.slices + 1.0));
  FaceBuilder builder;
  std::vector<std::vector<Vec3>> levels;
  for (int slice = 0; slice <= twist.slices; ++slice) {
    const double share = static_cast<double>(slice) / twist.slices;
    const double c = cosine_of_degrees(twist.degrees * share);
    const double s = sine_of_degrees(twist.degrees * share);
    const double x = 1 - (1 - twist.scale_x) * share, y = 1 - (1 - twist.scale_y) * share;
    std::vector<Vec3>& level = levels.emplace_back();
    for (const ProfilePoint& p : contour)
      level.emplace_back(x * (c * p.x + s * p.y), y * (c * p.y - s * p.x), twist.height * share);
  }
  const auto end = [&](const std::vector<Vec3>& level) {
    std::vector<std::uint32_t> corners;
    corners.reserve(level.size());
    for (const Vec3& p : level) corners.push_back(builder.point(p));
    builder.face(corners);
  };
  end(levels.front());
  const bool is_flat = twist.scale_x == 0 || twist.scale_y == 0;
  if (!is_flat) end(levels.back());
  const bool is_even = twist.degrees == 0 && twist.scale_x == twist.scale_y;
  for (std::size_t slice = 1; slice < levels.size(); ++slice) {
    const std::vector<Vec3>& low = levels[slice - 1];
    const std::vector<Vec3>& high = levels[slice];
    for (std::size_t i = 0; i < low.size(); ++i) {
      const std::size_t next = (i + 1) % low.size();
      const std::uint32_t a = builder.point(low[i]), b = builder.point(low[next]);
      const std::uint32_t c = builder.point(high[next]), d = builder.point(high[i]);
      if (is_even) {
        builder.face({a, b, c, d});
        continue;
      }
      // A side is divided along its shorter diagonal, as it is seen along z.
      const double rising = elementary::hypot(low[i].x - high[next].x, low[i].y - high[next].y);
      const double falling = elementary::hypot(low[next].x - high[i].x, low[next].y - high[i].y);
      const bool is_same = std::abs(rising - falling) <= (rising + falling) * 1e-9;
      const bool turns_back = twist.degrees <= 0;
      const bool rises = is_same ? is_hole == turns_back : rising < falling;
      if (rises) {
        builder.face({a, b, c});
        builder.face({a, c, d});
      } else {
        builder.face({a, b, d});
        builder.face({b, c, d});
      }
    }
  }
  return builder.take();
}

Faces revolved_facets(const Contour& contour, double degrees, int fragments) {
  check_facets(static_cast<double>(contour.size()) * (fragments + 1.0));
  FaceBuilder builder;
  const bool is_closed = degrees == 360;
  std::vector<std::vector<std::uint32_t>> rings;
  for (int ring = 0; ring <= fragments; ++ring) {
    // A full turn begins at -x, as it did in OpenSCAD before there were others.
    const double angle =
        is_closed ? 180 - 360.0 * (ring % fragments) / fragments : degrees * ring / fragments;
    std::vector<std::uint32_t>& corners = rings.emplace_back();
    for (const ProfilePoint& p : contour)
      corners.push_back(
          builder.point({p.x * cosine_of_degrees(angle), p.x * sine_of_degrees(angle), p.y}));
  }
  if (!is_closed) {
    builder.face(rings.front());
    builder.face(rings.back());
  }
  for (std::size_t ring = 1; ring < rings.size(); ++ring) {
    for (std::size_t i = 0; i < contour.size(); ++i) {
      const std::size_t next = (i + 1) % contour.size();
      // A piece on the axis makes no face.
      if (contour[i].x == 0 && contour[next].x == 0) continue;
      builder.face({rings[ring - 1][i], rings[ring - 1][next], rings[ring][next], rings[ring][i]});
    }
  }
  return builder.take();
}

}  // namespace crt::importing
