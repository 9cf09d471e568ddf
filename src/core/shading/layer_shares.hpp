// Tables of what the layers of a principled surface leave over: computed once a material from the
// formulas that shade, so that nothing is lost between layers.
//
// Sources: Kulla, Conty, Revisiting physically based shading at Imageworks, SIGGRAPH 2017 (energy
// that microfacets scatter more than once, in a form that keeps reciprocity). Ashikhmin, Shirley,
// An anisotropic Phong BRDF model, 2000, and Kelemen, Szirmay-Kalos, A microfacet based coupled
// specular-matte BRDF model, 2001 (diffuse light under a layer).
//
// Tests: tests/shading/principled_test.cpp
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// LayerShares are shares of the light along a direction.
template <class Real>
struct LayerShares {
  Real below_sheen{};  ///< what the sheen does not scatter
  Real below_coat{};   ///< what neither sheen nor coat scatter
  Real above{};        ///< what sheen and coat send back, of what gets out through them
  // What is left of the light for white surfaces, which single microfacets have neither mirrored
  // nor let through.
  Real metal{};
  Real dielectric{};   ///< that lets nothing through
  Real transparent{};  ///< a dielectric that lets light through
};

/// These are the layers of a surface. All that has equal ones shares its tables.
struct Layers {
  double index_behind = 1.5;  ///< relative to that before the surface
  double coat = 0;
  double coat_roughness = 0;
  double sheen = 0;
  /// Some light gets through. Otherwise both sides of the surface are alike.
  bool transmits = true;
  /// The roughness of the surface below, or below 0 for all there are: it is a pattern.
  double roughness = 0;

  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes a 0 of the compiler for one here
  auto operator<=>(const Layers&) const = default;
};

/// A SharesTable has the shares of directions on one side of a surface.
class SharesTable {
 public:
  /// Returns the shares of directions at that cosine from the normal, for surfaces of that
  /// roughness.
  LayerShares<double> at(double cosine, double roughness) const;
  /// Returns the means of the shares, weighted by the cosine. They are those of what at() returns.
  LayerShares<double> mean(double roughness) const;

 private:
  friend class LayerTables;
  static constexpr std::size_t intervals = 48;
  static constexpr std::size_t all_rows = 17;  ///< from a roughness of 0 to 1
  struct Row {
    std::array<LayerShares<double>, intervals + 1> shares;
    LayerShares<double> mean;
  };
  /// Place is what a number lies between: one entry, and the share of the next.
  struct Place {
    std::size_t index;
    double rest;
  };

  explicit SharesTable(double relative_index);

  double cosine_of(std::size_t entry) const { return cosines_[entry]; }
  std::size_t entry_below(double cosine) const;
  Place row_of(double roughness) const;
  void set_means();

  double relative_index_;
  double critical_ = 0;                        ///< the cosine below which all light is mirrored
  std::size_t first_above_ = 0;                ///< the entry of that
  std::array<double, intervals + 1> cosines_;  ///< of the entries, from 0 to 1
  std::vector<Row> rows_;                      ///< one if there is one roughness
};

/// LayerTables are those of both sides.
class LayerTables {
 public:
  explicit LayerTables(const Layers& layers);

  /// Returns the table of the side that has sheen and coat.
  const SharesTable& outside() const { return sides_[0]; }
  const SharesTable& inside() const { return transmits_ ? sides_[1] : sides_[0]; }

  /// Returns the bytes of memory that they take.
  std::size_t bytes() const;

 private:
  void set_below_layers(const Layers& layers);
  void set_leftovers(const Layers& layers, std::size_t side, double roughness, std::size_t row);

  bool transmits_;
  std::array<SharesTable, 2> sides_;
};

/// A LayerTablePool has the tables of one scene, so that equal layers are computed once.
class LayerTablePool {
 public:
  /// Until settle() is called, tables that are asked for are taken over from another pool, which
  /// may be null.
  explicit LayerTablePool(const LayerTablePool* earlier = nullptr) : earlier_(earlier) {}
  void settle() { earlier_ = nullptr; }

  std::shared_ptr<const LayerTables> get(const Layers& layers);
  /// Returns the bytes of memory of all its tables.
  std::size_t bytes() const;

 private:
  const LayerTablePool* earlier_;
  std::map<Layers, std::shared_ptr<const LayerTables>> tables_;
};

}  // namespace crt::core
