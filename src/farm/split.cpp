#include "farm/split.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <random>

namespace crt::farm {

namespace {

// A task has pieces in several places of a picture. So what a map does not show of one is made up
// by the others. Small pieces cost more, as they have a margin.
constexpr int max_pieces_of_task = 16;
constexpr std::int64_t least_pixels_of_piece = 256;

/// A frame is not cut where that would make a piece of less than this share of a task.
constexpr double least_share = 0.05;
/// A frame that is less than this share of a task is not cut at all.
constexpr double small_frame = 0.1;

/// Returns the place across a region, or down, where its first part has this share of its cost.
int place_of_cut(const CostMap& map, const Region& region, bool across, double share) {
  const double wanted = share * map.of(region);
  int least = 0;
  int most = across ? region.width : region.height;
  while (least < most) {
    const int middle = least + (most - least) / 2;
    Region part = region;
    (across ? part.width : part.height) = middle;
    if (map.of(part) < wanted) {
      least = middle + 1;
    } else {
      most = middle;
    }
  }
  return least;
}

/// Cuts a region into as many pieces as there are shares, in these ratios, by recursive bisection:
/// Bentley, Multidimensional binary search trees used for associative searching, CACM 18(9), 1975.
/// A piece may be empty.
void cut(const CostMap& map, const Region& region, std::span<const double> shares,
         std::vector<Region>& pieces) {
  if (shares.size() == 1) {
    pieces.push_back(region);
    return;
  }
  const std::size_t half = shares.size() / 2;
  const double first =
      std::accumulate(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(half), 0.0);
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  const bool across = region.width >= region.height;
  const int place = place_of_cut(map, region, across, first / all);
  Region before = region;
  Region behind = region;
  if (across) {
    before.width = place;
    behind.x += place;
    behind.width -= place;
  } else {
    before.height = place;
    behind.y += place;
    behind.height -= place;
  }
  cut(map, before, shares.first(half), pieces);
  cut(map, behind, shares.subspan(half), pieces);
}

bool is_empty(const Region& region) {
  return region.width == 0 || region.height == 0;
}

/// A TaskShare is a part of a frame that a task gets.
struct TaskShare {
  std::size_t task = 0;
  double share = 0;  ///< of a task
};

void add_frame(const CostMap& map, int frame, std::span<const TaskShare> takers,
               std::vector<Task>& tasks) {
  const auto give = [&](std::size_t task, const Region& region) {
    if (!is_empty(region)) tasks[task].pieces.push_back({frame, region});
  };
  const Region all{0, 0, map.width, map.height};
  if (takers.size() == 1) {
    give(takers.front().task, all);
    return;
  }
  const std::int64_t pixels = std::int64_t{map.width} * map.height;
  const std::int64_t fitting =
      pixels / least_pixels_of_piece / static_cast<std::int64_t>(takers.size());
  const auto rounds =
      static_cast<std::size_t>(std::clamp<std::int64_t>(fitting, 1, max_pieces_of_task));
  // In every round the tasks have another order. Else a task would have the same corner of each
  // area, whose pieces may all be dearer than the map says.
  std::minstd_rand random;
  std::vector<TaskShare> order;
  for (std::size_t round = 0; round < rounds; ++round) {
    order.insert(order.end(), takers.begin(), takers.end());
    for (std::size_t i = takers.size(); i > 1; --i)
      std::swap(order[order.size() - i], order[order.size() - 1 - random() % i]);
  }
  std::vector<double> shares;
  shares.reserve(order.size());
  for (const TaskShare& taker : order) shares.push_back(taker.share);
  std::vector<Region> pieces;
  cut(map, all, shares, pieces);
  for (std::size_t i = 0; i < pieces.size(); ++i) give(order[i].task, pieces[i]);
}

double seconds_of(const CostMap& map) {
  return map.total() + map.prepare_seconds;
}

void split_by_cost(std::span<const CostMap* const> frames, int first, std::vector<Task>& tasks) {
  double all = 0;
  for (const CostMap* map : frames) all += seconds_of(*map);
  const double task_seconds = all / static_cast<double>(tasks.size());
  const auto last_task = static_cast<double>(tasks.size());
  double end = 0;    // of the frames so far, in tasks
  double taken = 0;  // up to which tasks are full
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double length = seconds_of(*frames[i]) / task_seconds;
    const double begin = end;
    end += length;
    std::vector<TaskShare> takers;
    if (length < small_frame) {
      const double middle = std::min(begin + length / 2, last_task - least_share);
      takers.push_back({.task = static_cast<std::size_t>(middle), .share = 1});
    } else {
      double until = end;
      if (std::abs(until - std::round(until)) < least_share) until = std::round(until);
      if (i + 1 == frames.size()) until = last_task;
      double from = std::min(std::max(taken, begin - least_share), until);
      while (from < until) {
        const double next = std::min(std::floor(from) + 1, until);
        takers.push_back({.task = static_cast<std::size_t>(from), .share = next - from});
        from = next;
      }
      if (takers.empty()) {
        const double task = std::min(from, last_task - 1);
        takers.push_back({.task = static_cast<std::size_t>(task), .share = 1});
      }
      taken = until;
    }
    add_frame(*frames[i], first + static_cast<int>(i), takers, tasks);
  }
}

struct Tile {
  Piece piece;
  double seconds = 0;
};

std::vector<Tile> tiles_of(std::span<const CostMap* const> frames, int first,
                           const SplitShape& shape) {
  std::vector<Tile> tiles;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const CostMap& map = *frames[i];
    for (int y = 0; y < map.height; y += shape.tile_height) {
      for (int x = 0; x < map.width; x += shape.tile_width) {
        const Region region{x, y, std::min(shape.tile_width, map.width - x),
                            std::min(shape.tile_height, map.height - y)};
        tiles.push_back({{first + static_cast<int>(i), region}, map.of(region)});
      }
    }
  }
  return tiles;
}

/// Gives each tile, the dearest first, to the task that has least: Graham, Bounds on
/// multiprocessing timing anomalies, SIAM Journal on Applied Mathematics 17(2), 1969.
void give_to_least(std::vector<Tile> tiles, std::vector<Task>& tasks) {
  std::stable_sort(tiles.begin(), tiles.end(),
                   [](const Tile& a, const Tile& b) { return a.seconds > b.seconds; });
  using Load = std::pair<double, std::size_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::size_t i = 0; i < tasks.size(); ++i) loads.emplace(0.0, i);
  for (const Tile& tile : tiles) {
    const auto [seconds, task] = loads.top();
    loads.pop();
    tasks[task].pieces.push_back(tile.piece);
    loads.emplace(seconds + tile.seconds, task);
  }
}

/// Gives tiles to tasks in their order, so that a task has to do with few frames.
void give_in_order(const std::vector<Tile>& tiles, std::vector<Task>& tasks) {
  double all = 0;
  for (const Tile& tile : tiles) all += tile.seconds;
  double before = 0;
  for (const Tile& tile : tiles) {
    const double middle = (before + tile.seconds / 2) / all * static_cast<double>(tasks.size());
    const auto task = std::min(static_cast<std::size_t>(middle), tasks.size() - 1);
    tasks[task].pieces.push_back(tile.piece);
    before += tile.seconds;
  }
}

}  // namespace

double CostMap::total() const {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

double CostMap::of(const Region& region) const {
  // In cells:
  const double left = double{1} * region.x * columns / width;
  const double right = double{1} * (region.x + region.width) * columns / width;
  const double top = double{1} * region.y * rows / height;
  const double bottom = double{1} * (region.y + region.height) * rows / height;
  double sum = 0;
  for (int row = static_cast<int>(top); row < rows && row < bottom; ++row) {
    const double down = std::min(bottom, row + 1.0) - std::max(top, double{1} * row);
    for (int column = static_cast<int>(left); column < columns && column < right; ++column) {
      const double across = std::min(right, column + 1.0) - std::max(left, double{1} * column);
      sum += down * across *
             seconds[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
  }
  return sum;
}

std::vector<Task> split(std::span<const CostMap* const> frames, int first,
                        const SplitShape& shape) {
  std::vector<Task> tasks(static_cast<std::size_t>(shape.tasks));
  if (shape.tile_width == 0) {
    split_by_cost(frames, first, tasks);
  } else if (frames.size() == 1) {
    give_to_least(tiles_of(frames, first, shape), tasks);
  } else {
    give_in_order(tiles_of(frames, first, shape), tasks);
  }
  for (Task& task : tasks) {
    const CostMap* prepared = nullptr;
    int last_frame = 0;
    for (const auto& [frame, region] : task.pieces) {
      const CostMap& map = *frames[static_cast<std::size_t>(frame - first)];
      if (prepared == nullptr || frame != last_frame) task.seconds += map.prepare_seconds;
      prepared = &map;
      last_frame = frame;
      task.seconds += map.of(region);
    }
  }
  return tasks;
}

}  // namespace crt::farm
