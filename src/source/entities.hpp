// Entities become source code: statements, each of which makes one that is used more than once or
// whose text would be long.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/entity/entity_node.hpp"
#include "source/program.hpp"

namespace crt::source {

class EntityWriter {
 public:
  explicit EntityWriter(Program& program) : program_(program) {}

  /// Counts how often each part of an entity occurs. All entities are counted before any is
  /// written.
  void count(const Entity& entity);
  /// Returns the name or the text of what makes an entity. What it is made of is written first.
  /// Trees of any depth are written without recursion.
  std::string write(const Entity& entity);

 private:
  std::string value(const EntityNode& node);
  std::string operation(const CsgOperation& operation);
  std::string chain(const std::vector<std::string>& parts, const char* sign);
  std::string wrapper(const EntityWrapper& wrapper);
  std::string placed(std::string entity, const core::TransformChain& chain);
  std::string with_user(const std::string& text, std::uint64_t user);
  /// Says that an entity casts no shadow ("shadow"), or that the camera does not see it
  /// ("visible").
  std::string without(const std::string& text, std::string_view what);
  std::string placed_by(const std::string& entity, const Transform& map);
  std::string with_material(const std::string& entity, const SharedMaterial& material);
  std::string modified(const std::string& entity, std::string_view modifier,
                       const std::string& operand) const;
  std::string called(const std::string& entity, const std::string& call) const;

  Program& program_;
  std::map<const EntityNode*, int> uses_;
  std::map<const EntityNode*, std::string> written_;
};

}  // namespace crt::source
