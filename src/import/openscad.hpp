// The modules of OpenSCAD become solids and regions.
#pragma once

#include <algorithm>
#include <chrono>
#include <crt/entity.hpp>
#include <crt/measure.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "import/csg_tree.hpp"
#include "import/import.hpp"
#include "import/openscad_facets.hpp"
#include "import/region.hpp"
#include "import/script_writer.hpp"
#include "import/solid.hpp"

namespace crt::importing {

/// OpenSCAD writes numbers with so many digits.
inline constexpr int csg_digits = 6;

/// Says of what dimension a node is: 2, 3, or 0 if it has nothing.
int dimension_of(const CsgNode& node);

/// Says whether a node only groups its children.
bool is_group(const CsgNode& node);
std::optional<Matrix> matrix_of(const CsgNode& node);
/// Returns the size of a cube or a square, or nothing if it has none.
std::optional<std::vector<double>> size_of(const CsgNode& node, std::size_t dimensions);
/// Returns the children that count: those that are shown and not left out.
std::vector<const CsgNode*> children_of(const CsgNode& node);

/// Makes the entity of a solid, to measure it. Returns nothing if a script of it has an error.
std::optional<Entity> entity_of(const SharedSolid& solid, const std::string& materials,
                                const std::string& name);

class OpenScad {
 public:
  OpenScad(Notes& notes, ScriptWriter& writer, const ImportOptions& options, std::string name)
      : notes_(notes), writer_(writer), options_(options), name_(std::move(name)) {}

  /// Returns the solid of a node. Colours within one that has a colour do not count.
  SharedSolid solid(const CsgNode& node, bool has_color);
  /// Returns the solid of nodes side by side.
  SharedSolid all(const std::vector<const CsgNode*>& nodes, bool has_color);
  /// Draws out a tree of flat things.
  SharedSolid extruded(const CsgNode& node, double height);
  /// Returns whether some solid has no colour.
  bool has_plain() const { return has_plain_; }

 private:
  // openscad_solids.cpp
  SharedSolid cube(const CsgNode& node);
  SharedSolid sphere(const CsgNode& node);
  SharedSolid cylinder(const CsgNode& node);
  SharedSolid polyhedron(const CsgNode& node);
  SharedSolid imported(const CsgNode& node);
  SharedSolid surface(const CsgNode& node);
  SharedSolid resized(const CsgNode& node, bool has_color);
  SharedSolid placed(const CsgNode& node, const SharedSolid& solid, bool is_flat);
  SharedSolid colored(const CsgNode& node, bool has_color);

  // openscad_extrude.cpp
  SharedSolid linear_extrude(const CsgNode& node);
  SharedSolid rotate_extrude(const CsgNode& node);
  SharedSolid extruded_all(const CsgNode& node, double height);
  SharedSolid tapered(const CsgNode& node, const Twist& asked);
  SharedSolid text(const CsgNode& node, double height);

  // openscad_flat.cpp
  Region region(const CsgNode& node, bool facets);
  std::vector<Region> regions(const CsgNode& node, bool facets);
  Region polygon(const CsgNode& node);
  Region text_region(const CsgNode& node);
  Region offset(const CsgNode& node, bool facets);
  Region projection(const CsgNode& node);
  Region resized_region(const CsgNode& node, bool facets);
  Region flat_hull(const CsgNode& node, bool facets);
  Region flat_minkowski(const CsgNode& node, bool facets);
  /// Does something with regions, and notes what goes wrong.
  Region guarded(const CsgNode& node, const std::function<Region()>& make);

  // openscad_hull.cpp
  SharedSolid hull(const CsgNode& node);
  SharedSolid minkowski(const CsgNode& node);

  bool is_faceted(const CsgNode& node) const;
  /// Returns the polyhedron, and throws Error (limit) if all together have too many facets.
  SharedSolid made_of(const Faces& faces);
  /// Returns the solid of a node that has none within it.
  SharedSolid leaf(const CsgNode& node, bool has_color);

  /// Measures something of a solid, which all together takes no longer than some seconds.
  template <class Measure>
  auto timed(const Measure& measure) {
    constexpr double shortest = 0.05;
    const auto begin = std::chrono::steady_clock::now();
    auto result = measure(MeasureOptions{.seconds = std::max(shortest, seconds_left_)});
    seconds_left_ -=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

  Notes& notes_;
  ScriptWriter& writer_;
  const ImportOptions& options_;
  std::string name_;
  bool has_plain_ = false;
  double seconds_left_ = 3;  ///< for what is measured
  std::size_t facets_ = 0;
  std::size_t regions_ = 0;

  friend class HullReader;
};

}  // namespace crt::importing
