// These functions write docs/accuracy.md: what was measured, as a page of text.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "oracle/accuracy_plot.hpp"
#include "oracle/agreement.hpp"
#include "oracle/csg_measure.hpp"
#include "oracle/field_measure.hpp"
#include "oracle/mesh_measure.hpp"

namespace crt::test {

/// Holds all that was measured about a primitive.
struct MeasuredPrimitive {
  Measured in_place;
  Record placed;  ///< of the exact tier, transformed
};

/// Holds what all queries reported of subjects of a kind.
struct MeasuredAgreement {
  std::size_t kind = 0;
  AgreementRecord standard;
  AgreementRecord exact;
};

/// Holds what was measured of meshes of a kind, or of differences of meshes.
struct MeasuredMeshes {
  std::string name;
  MeshRecord record;
};

/// Holds what was measured of fields of a kind.
struct MeasuredFields {
  std::string name;
  FieldRecord record;
};

struct MeasuredAll {
  std::vector<MeasuredPrimitive> primitives;
  CsgRecord trees;
  std::vector<MeasuredMeshes> meshes;
  std::vector<MeasuredFields> fields;
  std::vector<MeasuredAgreement> agreement;
};

/// Returns the whole page.
std::string accuracy_page(const MeasuredAll& all);

/// Returns the rows of a primitive in the table that compares the tiers.
std::string tier_rows(const Measured& of);
/// Returns the rows of trees, of meshes, of fields and of the queries' agreement.
std::string tree_rows(const CsgRecord& record);
std::string mesh_rows(const MeasuredMeshes& of);
std::string field_rows(const MeasuredFields& of);
std::string agreement_rows(const MeasuredAgreement& of);

/// Replaces the rows of what was measured in a page that exists. Rows that it lacks become the last
/// of their table. Throws std::runtime_error, and changes nothing, if it lacks a table.
std::string with_rows_replaced(const std::string& page, const MeasuredAll& some);

}  // namespace crt::test
