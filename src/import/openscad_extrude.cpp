// What OpenSCAD draws out of flat things, and turns about an axis.
#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <crt/error.hpp>
#include <crt/text.hpp>
#include <utility>

#include "import/openscad.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

SharedSolid extrusion(const Region& region, double height) {
  if (region.empty()) return nullptr;
  return make_object("Extrusion",
                     {attribute("profile", profile_text(region)), attribute("height", height)});
}

/// Says whether a contour without arcs is a hole: whether it goes from y to x.
bool is_hole(const Contour& contour) {
  double area = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ProfilePoint& a = contour[i];
    const ProfilePoint& b = contour[(i + 1) % contour.size()];
    area += a.x * b.y - b.x * a.y;
  }
  return area < 0;
}

/// Makes solids of the contours of a region, and takes those of its holes away.
template <class Make>
SharedSolid of_contours(const Region& region, const Make& make) {
  std::vector<SharedSolid> solids, holes;
  for (const Contour& contour : region) {
    const bool hole = is_hole(contour);
    (hole ? holes : solids).push_back(make(contour, hole));
  }
  std::vector<SharedSolid> parts{make_sum(std::move(solids))};
  parts.insert(parts.end(), holes.begin(), holes.end());
  return make_difference(std::move(parts));
}

/// Is the only circle about the origin of which a tapered extrusion is a cone.
std::optional<double> radius_about_origin(const Region& region) {
  if (region.size() != 1 || region.front().size() != 2 || !has_arcs(region)) return {};
  const Contour& c = region.front();
  if (c[0].bulge != 1 || c[1].bulge != 1 || c[0].x != -c[1].x || c[0].y != -c[1].y) return {};
  return elementary::hypot(c[0].x, c[0].y);
}

Region mirrored(Region region) {
  for (Contour& contour : region) {
    for (ProfilePoint& p : contour) {
      p.x = -p.x;
      p.bulge = -p.bulge;
    }
  }
  return oriented(std::move(region));
}

Twist twist_of(const CsgNode& node) {
  Twist twist{.height = node.number("height", 100), .degrees = node.number("twist", 0)};
  if (const auto scale = node.numbers("scale", 2)) {
    twist.scale_x = std::max(0.0, (*scale)[0]);
    twist.scale_y = std::max(0.0, (*scale)[1]);
  }
  return twist;
}

}  // namespace

SharedSolid OpenScad::linear_extrude(const CsgNode& node) {
  const Twist twist = twist_of(node);
  if (!(twist.height > 0) || !std::isfinite(twist.height) || !std::isfinite(twist.degrees))
    return nullptr;
  SharedSolid solid = twist.is_none() ? extruded_all(node, twist.height) : tapered(node, twist);
  if (!solid || !node.flag("center")) return solid;
  return make_changed(solid, {"translate " + vector_text({0, 0, -twist.height / 2})});
}

SharedSolid OpenScad::extruded_all(const CsgNode& node, double height) {
  std::vector<SharedSolid> parts;
  for (const CsgNode* const child : children_of(node)) parts.push_back(extruded(*child, height));
  return make_sum(std::move(parts));
}

SharedSolid OpenScad::extruded(const CsgNode& node, double height) {
  if (is_group(node) || node.name == "union") return extruded_all(node, height);
  if (node.name == "multmatrix") return placed(node, extruded_all(node, height), true);
  if (node.name == "difference" || node.name == "intersection") {
    std::vector<SharedSolid> parts;
    for (const CsgNode* const child : children_of(node)) parts.push_back(extruded(*child, height));
    return node.name == "difference" ? make_difference(std::move(parts))
                                     : make_intersection(std::move(parts));
  }
  if (node.name == "square") {
    const auto size = size_of(node, 2);
    if (!size) return nullptr;
    const double x = (*size)[0], y = (*size)[1];
    const Vec3 low = node.flag("center") ? Vec3(-x / 2, -y / 2, 0) : Vec3(0, 0, 0);
    return make_object("Box",
                       {attribute("cornerA", low), attribute("cornerB", low + Vec3(x, y, height))});
  }
  const double radius = node.number("r", 1);
  if (node.name == "circle" && radius > 0 && std::isfinite(radius) && !is_faceted(node)) {
    return make_object("Cylinder",
                       {attribute("from", Vec3(0, 0, 0)), attribute("to", Vec3(0, 0, height)),
                        attribute("radius", radius)});
  }
  if (node.name == "text") return text(node, height);
  return extrusion(region(node, options_.facets), height);
}

SharedSolid OpenScad::text(const CsgNode& node, double height) {
  const std::string across = node.text("halign"), up = node.text("valign");
  const bool is_plain = node.number("spacing", 1) == 1 && (up == "baseline" || up.empty());
  const double size = node.number("size", 10);
  const Region letters = region(node, false);
  if (letters.empty()) return nullptr;
  if (!is_plain) return extrusion(letters, height);
  std::vector<std::string> attributes{attribute("text", quoted_text(node.text("text"))),
                                      attribute("depth", height),
                                      attribute("size", size * 100 / 72)};
  if (across == "center" || across == "right")
    attributes.push_back(attribute("alignment", quoted_text(across)));
  return make_object("Text", attributes);
}

SharedSolid OpenScad::tapered(const CsgNode& node, const Twist& asked) {
  Twist twist = asked;
  const bool is_cone = twist.degrees == 0 && twist.scale_x == twist.scale_y;
  const Region round = guarded(node, [&] { return united(regions(node, options_.facets)); });
  if (round.empty()) return nullptr;
  if (const auto radius = is_cone ? radius_about_origin(round) : std::nullopt) {
    std::vector<std::string> attributes{attribute("from", Vec3(0, 0, 0)),
                                        attribute("to", Vec3(0, 0, twist.height)),
                                        attribute("radius", *radius)};
    if (twist.scale_x > 0) attributes.push_back(attribute("radius2", *radius * twist.scale_x));
    return make_object("Cone", attributes);
  }
  if (!options_.facets && (twist.degrees != 0 || has_arcs(round)))
    notes_.differs(node.place, "what is twisted or tapered is made of OpenSCAD's facets");
  const Region straight = guarded(node, [&] { return united(regions(node, true)); });
  if (has_arcs(straight)) {
    notes_.lost(node.place, "text that is twisted or tapered is not understood");
    return nullptr;
  }
  const double slices = node.number("slices", 0);
  twist.slices = slices >= 1 ? static_cast<int>(std::min(slices, 1.0 * most_fragments))
                             : slices_of(straight, twist, resolution_of(node));
  return of_contours(straight, [&](const Contour& contour, bool hole) {
    return made_of(twisted_facets(contour, twist, hole));
  });
}

SharedSolid OpenScad::rotate_extrude(const CsgNode& node) {
  double angle = node.number("angle", 360);
  if (!(std::abs(angle) <= 360)) angle = 360;
  if (angle == 0) return nullptr;
  const bool facets = is_faceted(node);
  Region profile = guarded(node, [&] { return united(regions(node, options_.facets)); });
  if (profile.empty()) return nullptr;
  RegionBounds bounds = bounds_of(profile);
  if (bounds.low_x < -1e-9 && bounds.high_x > 1e-9) {
    notes_.lost(node.place, "this profile lies on both sides of the axis, which OpenSCAD refuses");
    return nullptr;
  }
  const bool is_left = bounds.low_x < -1e-9;
  double start = is_left ? 180 : 0;
  if (is_left) profile = mirrored(std::move(profile));
  // Rounding may leave a corner on the wrong side.
  for (Contour& contour : profile)
    for (ProfilePoint& p : contour) p.x = std::max(p.x, 0.0);
  bounds = bounds_of(profile);
  if (facets && has_arcs(profile))
    profile = guarded(node, [&] { return united(regions(node, true)); });
  if (facets && !has_arcs(profile)) {
    const double pieces = fragments_of(bounds.high_x, resolution_of(node)) * std::abs(angle) / 360;
    const int fragments = std::max(1, static_cast<int>(pieces));
    const SharedSolid solid = of_contours(profile, [&](const Contour& contour, bool) {
      return made_of(revolved_facets(contour, angle, fragments));
    });
    return start == 0 ? solid : make_changed(solid, {"rotate " + vector_text({0, 0, start})});
  }
  if (angle < 0) start += angle;
  std::vector<std::string> attributes{attribute("profile", profile_text(profile))};
  const bool is_part = std::abs(angle) < 360;
  if (is_part) attributes.push_back(attribute("angle", std::abs(angle)));
  // y becomes z, and a turn that begins at z begins at x.
  const double turn = is_part ? std::remainder(start + 90, 360.0) : 0;
  return make_changed(make_object("Revolution", attributes),
                      {"rotate " + vector_text({90, 0, turn})});
}

}  // namespace crt::importing
