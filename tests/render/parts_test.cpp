// These tests check the small parts that rendering is made of.
#include <doctest/doctest.h>

#include <set>
#include <vector>

#include "core/render/media.hpp"
#include "core/render/tiles.hpp"

using namespace crt::core;

namespace {

std::vector<std::uint32_t> objects(const MediaLists& lists, MediaLists::List list) {
  std::vector<std::uint32_t> result;
  for (; list != MediaLists::empty; list = lists.around(list))
    result.push_back(lists.innermost(list).object);
  return result;
}

using Objects = std::vector<std::uint32_t>;

}  // namespace

TEST_CASE("the medium entered last is the innermost") {
  MediaLists lists;
  const auto one = lists.entered(MediaLists::empty, {1, 10});
  const auto two = lists.entered(one, {2, 20});
  CHECK(objects(lists, two) == Objects{2, 1});
  CHECK(lists.innermost(two).material == 20);
  CHECK(lists.left(two, 2) == one);
  CHECK(lists.left(one, 1) == MediaLists::empty);
}

TEST_CASE("a solid may be left while others are still around, in any order") {
  MediaLists lists;
  auto list = MediaLists::empty;
  for (const std::uint32_t object : {1u, 2u, 3u, 4u}) list = lists.entered(list, {object, 0});
  const auto without_two = lists.left(list, 2);
  CHECK(objects(lists, without_two) == Objects{4, 3, 1});
  CHECK(objects(lists, list) == Objects{4, 3, 2, 1});  // other rays' lists stay as they were
  CHECK(objects(lists, lists.left(without_two, 1)) == Objects{4, 3});
}

TEST_CASE("leaving a solid that one is not in changes nothing, entering one twice counts once") {
  MediaLists lists;
  const auto list = lists.entered(lists.entered(MediaLists::empty, {1, 0}), {2, 0});
  CHECK(lists.left(list, 3) == list);
  CHECK(lists.left(MediaLists::empty, 3) == MediaLists::empty);
  CHECK(objects(lists, lists.entered(list, {1, 0})) == Objects{1, 2});
}

TEST_CASE("lists made before a mark outlive its release") {
  MediaLists lists;
  const auto list = lists.entered(lists.entered(MediaLists::empty, {1, 0}), {2, 0});
  const auto mark = lists.mark();
  lists.left(list, 1);
  lists.release(mark);
  CHECK(lists.mark() == mark);
  CHECK(objects(lists, list) == Objects{2, 1});
}

TEST_CASE("tiles cover each pixel of a region once and nothing else") {
  for (const crt::Region& region :
       {crt::Region{0, 0, 1, 1}, crt::Region{3, 5, 8, 8}, crt::Region{2, 0, 37, 19}}) {
    const Tiles tiles(region);
    std::set<std::pair<int, int>> covered;
    for (std::size_t i = 0; i < tiles.count(); ++i) {
      const crt::Region tile = tiles.tile(i);
      for (int y = tile.y; y < tile.y + tile.height; ++y) {
        for (int x = tile.x; x < tile.x + tile.width; ++x) REQUIRE(covered.emplace(x, y).second);
      }
    }
    CHECK(covered.size() == static_cast<std::size_t>(region.width * region.height));
    CHECK(*covered.begin() == std::pair(region.x, region.y));
    CHECK(*covered.rbegin() ==
          std::pair(region.x + region.width - 1, region.y + region.height - 1));
  }
}
