// A scene that no script has made is listed as text, so that pages show it as they show scripts: in
// an editor that changes nothing, in the tree, and as properties.
#pragma once

#include <crt/scene.hpp>
#include <crt/script.hpp>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace crt::studio {

/// A Listing has a line for each entity, and behind it a line for each of its parts, in ASCII.
struct Listing {
  /// An Item is a name or a value in the text.
  struct Item {
    TextSpan name{};
    TextSpan value{};
  };
  struct Node {
    std::string kind;
    std::size_t parent = 0;
    TextSpan span{};
    TextSpan name{};
    std::vector<Item> values{};
  };

  std::string text;
  std::vector<Node> nodes;
  std::vector<EntityPlace> places;  ///< of the scene's entities
};

Listing list_scene(const Scene& scene);

/// Returns the message `analysis` of a listing.
nlohmann::json listing_message(const Listing& listing, std::uint32_t revision);

}  // namespace crt::studio
