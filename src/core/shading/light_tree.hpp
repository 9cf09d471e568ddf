// Of many lights, a point asks those that matter most to it.
//
// Sources: Estevez, Kulla, Importance sampling of many lights with adaptive tree splitting, HPG
// 2018. The bounds of angles are those of Pharr, Jakob, Humphreys, Physically based rendering, 4th
// edition, 2023, 12.6.3.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/shading/prepared_light.hpp"

namespace crt::core {

/// A LitPoint is a point of a surface that may be lit from one side.
struct LitPoint {
  Vec3 position;
  Vec3 normal;  ///< to that side, of unit length; it may be off by 2^-12
};

/// A LightTree has lights with an extent at its leaves. Each node bounds where its lights are, and
/// where they shine to.
class LightTree {
 public:
  /// Lights of no strength are never chosen.
  explicit LightTree(std::span<const PreparedLight> lights);

  /// A Choice is a light by its number, and with which probability it is chosen.
  struct Choice {
    std::uint32_t light = 0;
    double probability = 0;  ///< 0 if no light can reach the point; `light` then means nothing
  };
  /// Chooses a light by a number in [0, 1).
  Choice choose(const LitPoint& point, double number) const;

  /// Returns the probability with which choose() chooses a light.
  double probability(const LitPoint& point, std::uint32_t light) const;

  bool empty() const { return nodes_.empty(); }
  /// Returns the bytes of memory that it takes.
  std::size_t bytes() const;

 private:
  /// LightBounds hold lights. All the directions in which they shine most are within a cone.
  struct LightBounds {
    Bounds box;
    Vec3 axis{0, 0, 0};  ///< of the cone; unit length
    double cosine = -1;  ///< of its half angle
    bool is_two_sided = false;
    double strength = 0;

    /// Returns a number in proportion to what a point may get of them.
    double importance(const LitPoint& point) const;
  };
  struct Node {
    LightBounds bounds;
    std::uint32_t parent = 0;
    std::uint32_t second = 0;  ///< the second child; the first is the next node. 0 for a leaf.
    std::uint32_t light = 0;   ///< of a leaf
  };
  /// A Member is a light that is to be in the tree.
  struct Member {
    LightBounds bounds;
    std::uint32_t light;
  };
  /// A Split says how members become those of two nodes.
  struct Split {
    int axis = 0;
    double place = 0;
    double cost = 0;
  };

  static LightBounds bounds_of(const LightExtent& extent);
  static LightBounds together(const LightBounds& a, const LightBounds& b);
  static double cost(const LightBounds& bounds, double longest_over_side);
  static Split best_split(std::span<const Member> members, const Bounds& middles);
  std::uint32_t add(std::span<Member> members, std::uint32_t parent);
  /// Returns the probability of the first child of a node that is no leaf, or a negative number if
  /// nothing of either reaches the point.
  double share_of_first(std::uint32_t node, const LitPoint& point) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> leaves_;  ///< of the lights; 0xffffffff if a light is in none
};

}  // namespace crt::core
