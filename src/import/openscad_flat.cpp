// Flat modules of OpenSCAD become regions.
#include <algorithm>
#include <cmath>
#include <crt/curves.hpp>
#include <crt/error.hpp>
#include <crt/measure.hpp>
#include <crt/section.hpp>
#include <crt/text.hpp>
#include <utility>

#include "import/openscad.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr std::size_t most_regions = 50000;

/// The em of a font in the size that OpenSCAD gives letters: 100 dots an inch by 72 points.
constexpr double em_of_size = 100.0 / 72;

Region shifted(const Region& region, double x, double y) {
  Region result = region;
  for (Contour& contour : result) {
    for (ProfilePoint& p : contour) {
      p.x += x;
      p.y += y;
    }
  }
  return result;
}

/// Lays letters out at distances that are not those of the font.
Region spaced(const std::string& text, const Font& font, const TextLayout& layout, double spacing) {
  Region all;
  double x = 0;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0U) == 0x80U) ++end;
    const TextContours letter = text_contours(text.substr(at, end - at), font, layout);
    for (const Contour& contour : shifted(letter.contours, x, 0)) all.push_back(contour);
    x += letter.width * spacing;
    at = end;
  }
  return all;
}

bool is_full_circle(const Region& region) {
  return region.size() == 1 && region.front().size() == 2 && region.front()[0].bulge == 1 &&
         region.front()[1].bulge == 1;
}

/// Says whether a region is one convex contour of straight pieces.
bool is_convex_polygon(const Region& region) {
  if (region.size() != 1 || has_arcs(region)) return false;
  const Contour& c = region.front();
  for (std::size_t i = 0; i < c.size(); ++i) {
    const ProfilePoint& a = c[i];
    const ProfilePoint& b = c[(i + 1) % c.size()];
    const ProfilePoint& d = c[(i + 2) % c.size()];
    if ((b.x - a.x) * (d.y - b.y) - (b.y - a.y) * (d.x - b.x) < 0) return false;
  }
  return true;
}

/// Returns all points of two regions added up, or nothing if that is not known.
std::optional<Region> sum_of(const Region& a, const Region& b) {
  if (a.empty() || b.empty()) return Region{};
  if (is_full_circle(a) && !is_full_circle(b)) return sum_of(b, a);
  if (is_full_circle(b)) {
    const RegionBounds bounds = bounds_of(b);
    const std::optional<Region> wide =
        offset_region(a, (bounds.high_x - bounds.low_x) / 2, OffsetCorner::round, 0);
    if (!wide) return {};
    return shifted(*wide, (bounds.low_x + bounds.high_x) / 2, (bounds.low_y + bounds.high_y) / 2);
  }
  if (!is_convex_polygon(a) || !is_convex_polygon(b)) return {};
  Contour sums;
  for (const ProfilePoint& p : a.front())
    for (const ProfilePoint& q : b.front()) sums.push_back({p.x + q.x, p.y + q.y, 0});
  return hull_of({{sums}});
}

/// Returns the contours of a section across z in x and y.
Region region_of(const Section& section) {
  const bool mirrors = section.frame.x_axis.x * section.frame.y_axis.y < 0;
  Region region;
  for (const Contour& contour : section.contours) {
    Contour made;
    for (const ProfilePoint& p : contour) {
      const Vec3 at = section.frame.at(p.x, p.y);
      made.push_back({at.x, at.y, mirrors ? -p.bulge : p.bulge});
    }
    region.push_back(std::move(made));
  }
  return oriented(std::move(region));
}

}  // namespace

Region OpenScad::guarded(const CsgNode& node, const std::function<Region()>& make) {
  if (++regions_ > most_regions)
    throw Failure(node.place, text::format("over {} regions are made", most_regions),
                  ErrorCode::limit);
  try {
    return make();
  } catch (const Error& error) {
    notes_.lost(node.place, text::format("'{}' is left out: {}", node.name, error.what()));
    return {};
  }
}

std::vector<Region> OpenScad::regions(const CsgNode& node, bool facets) {
  std::vector<Region> result;
  for (const CsgNode* const child : children_of(node)) result.push_back(region(*child, facets));
  return result;
}

Region OpenScad::region(const CsgNode& node, bool facets) {
  if (is_group(node) || node.name == "union")
    return guarded(node, [&] { return united(regions(node, facets)); });
  if (node.name == "square") {
    const auto size = size_of(node, 2);
    if (!size) return {};
    const double x = (*size)[0], y = (*size)[1];
    return node.flag("center") ? Region{rectangle_contour(-x / 2, -y / 2, x / 2, y / 2)}
                               : Region{rectangle_contour(0, 0, x, y)};
  }
  if (node.name == "circle") {
    const double radius = node.number("r", 1);
    if (!(radius > 0) || !std::isfinite(radius)) return {};
    const int fragments =
        facets || is_faceted(node) ? fragments_of(radius, resolution_of(node)) : 0;
    return {circle_contour(0, 0, radius, fragments)};
  }
  if (node.name == "polygon") return polygon(node);
  if (node.name == "text") return guarded(node, [&] { return text_region(node); });
  if (node.name == "multmatrix") {
    const auto matrix = matrix_of(node);
    if (!matrix) return {};
    return guarded(node, [&] { return mapped(united(regions(node, facets)), *matrix); });
  }
  if (node.name == "difference") {
    return guarded(node, [&] {
      std::vector<Region> all = regions(node, facets);
      if (all.empty()) return Region{};
      const Region from = all.front();
      all.erase(all.begin());
      return subtracted(from, all);
    });
  }
  if (node.name == "intersection")
    return guarded(node, [&] { return intersected(regions(node, facets)); });
  if (node.name == "offset") return guarded(node, [&] { return offset(node, facets); });
  if (node.name == "hull") return guarded(node, [&] { return flat_hull(node, facets); });
  if (node.name == "minkowski") return guarded(node, [&] { return flat_minkowski(node, facets); });
  if (node.name == "resize") return guarded(node, [&] { return resized_region(node, facets); });
  if (node.name == "projection") return guarded(node, [&] { return projection(node); });
  if (dimension_of(node) == 3) {
    notes_.differs(node.place,
                   text::format("'{}' is a solid where a flat thing belongs, and OpenSCAD ignores "
                                "it, too",
                                node.name));
    return {};
  }
  notes_.lost(node.place, text::format("'{}' is not understood as a flat thing", node.name));
  return {};
}

Region OpenScad::polygon(const CsgNode& node) {
  std::vector<CurvePoint> points;
  for (const CsgValue& item : node.argument("points").items) {
    const auto point = numbers_of(item, 2);
    if (!point) {
      notes_.lost(node.place, "a point of this polygon is not two numbers");
      return {};
    }
    points.push_back({(*point)[0], (*point)[1]});
  }
  Region contours;
  const CsgValue& paths = node.argument("paths");
  if (paths.kind != CsgValue::Kind::list || paths.items.empty()) {
    Contour& contour = contours.emplace_back();
    for (const CurvePoint& p : points) contour.push_back({p.x, p.y, 0});
  }
  for (const CsgValue& path : paths.items) {
    Contour& contour = contours.emplace_back();
    for (const CsgValue& item : path.items) {
      // OpenSCAD leaves out what is no place in the list.
      if (!(item.number >= 0) || !(item.number < static_cast<double>(points.size()))) continue;
      const CurvePoint& p = points[static_cast<std::size_t>(item.number)];
      contour.push_back({p.x, p.y, 0});
    }
  }
  Region kept;
  for (Contour& contour : contours)
    if (contour.size() >= 3) kept.push_back(std::move(contour));
  return oriented(std::move(kept));
}

Region OpenScad::text_region(const CsgNode& node) {
  const std::string content = node.text("text");
  const double size = node.number("size", 10);
  const double spacing = node.number("spacing", 1);
  if (content.empty() || !(size > 0)) return {};
  const std::string family = node.text("font");
  if (!family.empty() && family != "Liberation Sans") {
    notes_.differs(node.place, text::format("the font '{}' is not at hand: the letters are those "
                                            "of Liberation Sans",
                                            family));
  }
  if (node.text("direction") != "ltr" && !node.text("direction").empty())
    notes_.differs(node.place, "this text runs from left to right, and not as it says");
  const TextLayout layout{.size = size * em_of_size};
  const std::shared_ptr<const Font> font = standard_font();
  const TextContours plain = text_contours(content, *font, layout);
  const Region region =
      oriented(spacing == 1 ? plain.contours : spaced(content, *font, layout, spacing));
  if (region.empty()) return {};
  const RegionBounds bounds = bounds_of(region);
  double x = 0, y = 0;
  const std::string across = node.text("halign"), up = node.text("valign");
  const double width = plain.width * spacing;
  if (across == "center") x = -width / 2;
  if (across == "right") x = -width;
  if (up == "top") y = -bounds.high_y;
  if (up == "center") y = -(bounds.low_y + bounds.high_y) / 2;
  if (up == "bottom") y = -bounds.low_y;
  return x == 0 && y == 0 ? region : shifted(region, x, y);
}

Region OpenScad::offset(const CsgNode& node, bool facets) {
  const bool is_round = node.argument("r").kind == CsgValue::Kind::number;
  const double distance = is_round ? node.number("r", 1) : node.number("delta", 1);
  if (!std::isfinite(distance)) return {};
  const OffsetCorner corner = is_round               ? OffsetCorner::round
                              : node.flag("chamfer") ? OffsetCorner::chamfer
                                                     : OffsetCorner::miter;
  const bool is_meant = facets || is_faceted(node);
  const int fragments = is_meant ? fragments_of(std::abs(distance), resolution_of(node)) : 0;
  const auto made = offset_region(united(regions(node, facets)), distance, corner, fragments);
  if (made) return *made;
  notes_.differs(node.place,
                 "an arc is too narrow for this offset, which is made of OpenSCAD's facets");
  const auto again = offset_region(united(regions(node, true)), distance, corner,
                                   fragments_of(std::abs(distance), resolution_of(node)));
  return again ? *again : Region{};
}

Region OpenScad::projection(const CsgNode& node) {
  const SharedSolid child = all(children_of(node), true);
  if (!child) return {};
  if (!node.flag("cut")) {
    notes_.lost(node.place, "the shadow of a solid is not understood: projection() without cut");
    return {};
  }
  const std::optional<Entity> entity = entity_of(child, writer_.materials(), name_);
  if (!entity) {
    notes_.lost(node.place, "this section cannot be made, as its solid cannot");
    return {};
  }
  const BoundingBox box = bounding_box(*entity);
  const Vec3 size = box.upper - box.lower;
  const double deviation = 1e-6 * std::max({size.x, size.y, size.z});
  const auto cut_towards = [&](double z) {
    return timed([&](const MeasureOptions& options) {
      return section(*entity, {0, 0, z}, 0, deviation, options);
    });
  };
  Section cut = cut_towards(-1);
  if (cut.empty()) cut = cut_towards(1);
  if (!(cut.deviation <= deviation))
    notes_.lost(node.place, "this section is not known well enough");
  return region_of(cut);
}

Region OpenScad::resized_region(const CsgNode& node, bool facets) {
  Region region = united(regions(node, facets));
  const auto wanted = node.numbers("newsize", 2);
  if (!wanted || region.empty()) return region;
  const RegionBounds bounds = bounds_of(region);
  const std::array<double, 2> size{bounds.high_x - bounds.low_x, bounds.high_y - bounds.low_y};
  const auto fits = node.numbers("auto", 2);
  Matrix matrix = identity_matrix;
  double largest = 0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if ((*wanted)[axis] > 0) matrix[axis][axis] = (*wanted)[axis] / size[axis];
    if ((*wanted)[axis] > 0) largest = std::max(largest, matrix[axis][axis]);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if ((*wanted)[axis] <= 0 && fits && (*fits)[axis] != 0 && largest > 0)
      matrix[axis][axis] = largest;
  }
  return mapped(region, matrix);
}

Region OpenScad::flat_hull(const CsgNode& node, bool facets) {
  try {
    return hull_of(regions(node, facets));
  } catch (const Error&) {
    if (facets) throw;
  }
  notes_.differs(node.place, "this hull of arcs is made of OpenSCAD's facets");
  return hull_of(regions(node, true));
}

Region OpenScad::flat_minkowski(const CsgNode& node, bool facets) {
  for (const bool with_facets : {facets, true}) {
    std::optional<Region> sum;
    bool is_first = true;
    for (const Region& region : regions(node, with_facets)) {
      if (is_first) {
        sum = region;
        is_first = false;
      } else if (sum) {
        sum = sum_of(*sum, region);
      }
    }
    if (is_first) return {};
    if (sum) return *sum;
  }
  notes_.lost(node.place, "this minkowski() is neither of convex polygons nor with a circle");
  return {};
}

}  // namespace crt::importing
