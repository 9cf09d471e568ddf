#include "studio/listing.hpp"

#include <crt/language_service.hpp>
#include <crt/source_code.hpp>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace crt::studio {

using nlohmann::json;

namespace {

/// A Lister writes the entities one after the other.
class Lister {
 public:
  explicit Lister(Listing& listing) : listing_(listing) {}

  void add(const EntityDescription& description) {
    while (!open_.empty() && open_.back() != description.parent) close();
    listing_.text.append(2 * open_.size(), ' ');
    Listing::Node node{.kind = description.kind, .parent = description.parent};
    node.span.begin = place();
    node.name = written(description.kind);
    for (const auto& [name, value] : description.values) {
      listing_.text += "  ";
      const TextSpan name_span = written(name);
      listing_.text += ' ';
      node.values.push_back({name_span, written(value)});
    }
    node.span.end = place();
    listing_.text += '\n';
    open_.push_back(listing_.nodes.size());
    listing_.nodes.push_back(std::move(node));
  }

  void finish() {
    while (!open_.empty()) close();
  }

 private:
  std::uint32_t place() const { return static_cast<std::uint32_t>(listing_.text.size()); }

  TextSpan written(std::string_view text) {
    const std::uint32_t begin = place();
    listing_.text += text;
    return {begin, place()};
  }

  /// Ends a node behind the last of its parts.
  void close() {
    Listing::Node& node = listing_.nodes[open_.back()];
    node.span.end = place() - 1;
    if (node.parent == EntityDescription::no_parent)
      listing_.places.push_back({node.span, node.span});
    open_.pop_back();
  }

  Listing& listing_;
  std::vector<std::size_t> open_;
};

json span_of(TextSpan span) {
  return {span.begin, span.end};
}

void add_token(json& tokens, TextSpan span, TokenKind kind) {
  tokens.push_back(span.begin);
  tokens.push_back(span.end);
  tokens.push_back(static_cast<std::uint32_t>(kind));
}

const char* kind_of(const std::string& kind) {
  if (kind == "Placed") return "placed";
  return kind == "Union" || kind == "Intersection" || kind == "Difference" ? "combination"
                                                                           : "object";
}

}  // namespace

Listing list_scene(const Scene& scene) {
  Listing listing;
  Lister lister(listing);
  for (const EntityDescription& description : describe_entities(scene)) lister.add(description);
  lister.finish();
  return listing;
}

json listing_message(const Listing& listing, std::uint32_t revision) {
  json tokens = json::array();
  json tree = json::array();
  for (const Listing::Node& node : listing.nodes) {
    add_token(tokens, node.name, TokenKind::object);
    json attributes = json::array();
    for (const auto& [name, value] : node.values) {
      add_token(tokens, name, TokenKind::attribute);
      attributes.push_back({{"name", listing.text.substr(name.begin, name.end - name.begin)},
                            {"nameSpan", span_of(name)},
                            {"span", span_of(value)},
                            {"literal", "none"},
                            {"reason", "of the program's scene"}});
    }
    const bool is_root = node.parent == EntityDescription::no_parent;
    tree.push_back({{"kind", kind_of(node.kind)},
                    {"name", node.kind},
                    {"span", span_of(node.span)},
                    {"nameSpan", span_of(node.name)},
                    {"parent", is_root ? -1 : static_cast<std::int64_t>(node.parent)},
                    {"attributes", std::move(attributes)}});
  }
  return {{"type", "analysis"},
          {"revision", revision},
          {"tokens", std::move(tokens)},
          {"tree", std::move(tree)}};
}

}  // namespace crt::studio
