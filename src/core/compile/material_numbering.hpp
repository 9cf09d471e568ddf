// Materials are numbered in the order in which leaves use them first.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/base/invalid_index.hpp"
#include "core/geometry/mesh/facet_attributes.hpp"
#include "crt/material.hpp"

namespace crt::core {

/// A MaterialNumbering makes the list of a scene's materials.
class MaterialNumbering {
 public:
  /// Returns the number of a material. Null is the default one.
  std::uint32_t number(const SharedMaterial* material) {
    if (material == nullptr) {
      if (default_number_ == invalid_index) default_number_ = add(default_material());
      return default_number_;
    }
    if (&**material == last_material_) return last_number_;
    const auto [entry, added] = numbers_.try_emplace(&**material, count());
    if (added) add(*material);
    last_material_ = &**material;
    last_number_ = entry->second;
    return last_number_;
  }

  /// Returns the number of the default material before those of facets.
  std::uint32_t number(const FacetAttributes& facets) {
    const auto [entry, added] = of_facets_.try_emplace(&facets, count());
    if (added) {
      add(default_material());
      materials_.insert(materials_.end(), facets.materials().begin(), facets.materials().end());
    }
    return entry->second;
  }

  const std::vector<SharedMaterial>& materials() const { return materials_; }
  std::vector<SharedMaterial> take_materials() { return std::move(materials_); }
  /// Returns the number of what is the default for leaves, or invalid_index if none has it.
  std::uint32_t default_number() const { return default_number_; }

 private:
  std::uint32_t count() const { return static_cast<std::uint32_t>(materials_.size()); }
  std::uint32_t add(const SharedMaterial& material) {
    materials_.push_back(material);
    return count() - 1;
  }
  const SharedMaterial& default_material() {
    if (default_.empty()) default_.emplace_back(Material{});
    return default_.front();
  }

  std::vector<SharedMaterial> materials_;
  std::unordered_map<const Material*, std::uint32_t> numbers_;
  std::unordered_map<const FacetAttributes*, std::uint32_t> of_facets_;
  std::vector<SharedMaterial> default_;  ///< made when it is first asked for
  std::uint32_t default_number_ = invalid_index;
  const Material* last_material_ = nullptr;
  std::uint32_t last_number_ = 0;
};

}  // namespace crt::core
