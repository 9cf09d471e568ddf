#include "core/shading/layer_shares.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>

#include "core/shading/fresnel.hpp"
#include "core/shading/microfacets.hpp"
#include "core/shading/principled.hpp"

namespace crt::core {

namespace {

/// Sums over directions take this many steps.
constexpr std::size_t height_steps = 64;
constexpr std::size_t turn_steps = 24;
/// This stands for grazing angles.
constexpr double lowest_cosine = 1e-9;

/// A HalfCircle has points of one side by side.
struct HalfCircle {
  std::array<Lanes, turn_steps / lane_count> cosines;
  std::array<Lanes, turn_steps / lane_count> sines;

  HalfCircle() {
    for (std::size_t step = 0; step < turn_steps; ++step) {
      const double angle =
          std::numbers::pi * ((static_cast<double>(step) + 0.5) / double{turn_steps} - 0.5);
      cosines[step / lane_count][step % lane_count] = elementary::cos(angle);
      sines[step / lane_count][step % lane_count] = elementary::sin(angle);
    }
  }
};

/// Adds up over heights from 0 to 1 and over directions about an axis, of which the other half is
/// alike. Low heights are looked at more closely, as functions change most there. `add` takes a
/// height, points of the unit circle side by side, and the part of the sum that each stands for.
template <class Add>
void for_heights(const HalfCircle& circle, const Add& add) {
  for (std::size_t step = 0; step < height_steps; ++step) {
    const double root = (static_cast<double>(step) + 0.5) / double{height_steps};
    const double part = 2 * root / double{height_steps * turn_steps};
    for (std::size_t i = 0; i < circle.cosines.size(); ++i)
      add(root * root, circle.cosines[i], circle.sines[i], part);
  }
}

/// Adds up over normals of microfacets that are visible from o. `add` takes some side by side, and
/// the share that each stands for.
template <class Add>
void for_facets(const HalfCircle& circle, const Microfacets<Lanes>& facets, const VectorLanes& o,
                const Add& add) {
  // The shares' sum, of 4 y^3 at the middles of steps.
  constexpr double all = 1 - 0.5 / double{height_steps * height_steps};
  for_heights(circle, [&](double height, const Lanes& cosines, const Lanes& sines, double part) {
    const double radius = std::sqrt((1 - height) * (1 + height));
    add(facets.visible_normal(o, {radius * cosines, radius * sines}), 2 * height * part / all);
  });
}

double sum_of(const Lanes& x) {
  return x[0] + x[1] + (x[2] + x[3]);
}

VectorLanes direction_at(double cosine) {
  return lanes_of(Vec3(std::sqrt((1 - cosine) * (1 + cosine)), 0, cosine));
}

VectorLanes mirrored_by(const VectorLanes& o, const VectorLanes& h) {
  return 2.0 * dot(o, h) * h - o;
}

/// Returns the share of light that fibres scatter.
double sheen_albedo(const HalfCircle& circle, const VectorLanes& o) {
  Lanes sum{};
  for_heights(circle, [&](double height, const Lanes& cosines, const Lanes& sines, double part) {
    const double level = std::sqrt((1 - height) * (1 + height));
    // The viewer is in the plane of x and z.
    const VectorLanes i = {level * sines, level * cosines, lanes_of(height)};
    sum += part * 2 * std::numbers::pi * height * fibres<Lanes>(o, i);
  });
  return sum_of(sum);
}

/// Returns the share of light that a coat mirrors, times `below(cosine)` where it goes.
template <class Below>
double coat_albedo(const HalfCircle& circle, const VectorLanes& o, double coat_roughness,
                   const Below& below) {
  const Microfacets<Lanes> facets = {lanes_of(width_of<double>(coat_roughness))};
  Lanes sum{};
  for_facets(circle, facets, o, [&](const VectorLanes& h, double share) {
    const VectorLanes i = mirrored_by(o, h);
    const Lanes mirrored =
        fresnel_reflectance<Lanes>(min(lanes_of(1), dot(o, h)), lanes_of(1), lanes_of(coat_index));
    const Lanes gone = mirrored * facets.mirrored_share(o, i) * below(i.z);
    sum += share * select(i.z > 0.0, gone, Lanes{});
  });
  return sum_of(sum);
}

/// Looks up one share of a table by lane.
Lanes share_at(const SharesTable& table, double LayerShares<double>::*share, const Lanes& cosines,
               double roughness) {
  Lanes shares{};
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    shares[lane] = table.at(cosines[lane], roughness).*share;
  return shares;
}

LayerShares<double> mixed_shares(const LayerShares<double>& a, const LayerShares<double>& b,
                                 double share) {
  const auto mixed = [share](double from, double to) { return from + share * (to - from); };
  return {mixed(a.below_sheen, b.below_sheen),
          mixed(a.below_coat, b.below_coat),
          mixed(a.above, b.above),
          mixed(a.metal, b.metal),
          mixed(a.dielectric, b.dielectric),
          mixed(a.transparent, b.transparent)};
}

}  // namespace

/// Places entries so that they are close where shares change fast: at grazing angles on this side,
/// and on the side behind.
SharesTable::SharesTable(double relative_index) : relative_index_(relative_index) {
  if (relative_index < 1) {
    critical_ = std::sqrt((1 - relative_index) * (1 + relative_index));
    first_above_ = intervals / 3;
  }
  for (std::size_t entry = 0; entry < first_above_; ++entry) {
    const double root = static_cast<double>(entry) / static_cast<double>(first_above_);
    cosines_[entry] = critical_ * (root * root * (root * root));
  }
  for (std::size_t entry = first_above_; entry <= intervals; ++entry) {
    const double root =
        static_cast<double>(entry - first_above_) / static_cast<double>(intervals - first_above_);
    const double square = root * root;
    const double behind = relative_index_ * square;
    cosines_[entry] =
        relative_index < 1 ? std::sqrt(critical_ * critical_ + behind * behind) : square * square;
  }
  cosines_.back() = 1;
}

/// Returns the entry at or below a cosine in [0, 1], but the last. It inverts what places them.
std::size_t SharesTable::entry_below(double cosine) const {
  const bool is_above = cosine >= critical_;
  const double behind = std::sqrt(std::max(0.0, (cosine - critical_) * (cosine + critical_)));
  const double root = !is_above       ? std::sqrt(std::sqrt(cosine / critical_))
                      : critical_ > 0 ? std::sqrt(behind / relative_index_)
                                      : std::sqrt(std::sqrt(cosine));
  const std::size_t first = is_above ? first_above_ : 0;
  const std::size_t count = is_above ? intervals - first_above_ : first_above_;
  const auto step = static_cast<std::size_t>(root * static_cast<double>(count));
  return std::min(first + step, intervals - 1);
}

SharesTable::Place SharesTable::row_of(double roughness) const {
  if (rows_.size() == 1) return {0, 0};
  const double place = roughness * double{all_rows - 1};
  const auto index = std::min(static_cast<std::size_t>(place), all_rows - 2);
  return {index, place - static_cast<double>(index)};
}

LayerShares<double> SharesTable::at(double cosine, double roughness) const {
  const double within = std::clamp(cosine, 0.0, 1.0);
  const std::size_t entry = entry_below(within);
  // Between entries a share is linear in the cosine, so that its mean is a plain sum.
  const double low = cosines_[entry];
  const double rest = std::clamp((within - low) / (cosines_[entry + 1] - low), 0.0, 1.0);
  const Place row = row_of(roughness);
  const auto in_row = [&](std::size_t index) {
    const auto& shares = rows_[index].shares;
    return mixed_shares(shares[entry], shares[entry + 1], rest);
  };
  const LayerShares<double> first = in_row(row.index);
  return row.rest == 0 ? first : mixed_shares(first, in_row(row.index + 1), row.rest);
}

LayerShares<double> SharesTable::mean(double roughness) const {
  const Place row = row_of(roughness);
  const LayerShares<double>& first = rows_[row.index].mean;
  return row.rest == 0 ? first : mixed_shares(first, rows_[row.index + 1].mean, row.rest);
}

void SharesTable::set_means() {
  for (Row& row : rows_) {
    row.mean = {};
    for (std::size_t entry = 0; entry < intervals; ++entry) {
      // This is the integral of 2 x f(x), for a linear f from a to b.
      const double a = cosine_of(entry);
      const double b = cosine_of(entry + 1);
      const double of_a = (b - a) * (2 * a + b) / 3;
      const double of_b = (b - a) * (a + 2 * b) / 3;
      const auto add = [&](double LayerShares<double>::*share) {
        row.mean.*share += of_a * row.shares[entry].*share + of_b * row.shares[entry + 1].*share;
      };
      add(&LayerShares<double>::below_sheen);
      add(&LayerShares<double>::below_coat);
      add(&LayerShares<double>::above);
      add(&LayerShares<double>::metal);
      add(&LayerShares<double>::dielectric);
      add(&LayerShares<double>::transparent);
    }
  }
}

LayerTables::LayerTables(const Layers& layers)
    : transmits_(layers.transmits),
      sides_{SharesTable(layers.index_behind), SharesTable(1 / layers.index_behind)} {
  const bool is_pattern = layers.roughness < 0;
  for (SharesTable& side : sides_) side.rows_.resize(is_pattern ? SharesTable::all_rows : 1);
  set_below_layers(layers);
  for (std::size_t row = 0; row < sides_[0].rows_.size(); ++row) {
    const double roughness = is_pattern
                                 ? static_cast<double>(row) / double{SharesTable::all_rows - 1}
                                 : layers.roughness;
    for (std::size_t side = 0; side < (transmits_ ? sides_.size() : 1); ++side)
      set_leftovers(layers, side, roughness, row);
  }
  for (SharesTable& side : sides_) side.set_means();
}

/// Sets what gets through sheen and coat, which is the same in all rows.
void LayerTables::set_below_layers(const Layers& layers) {
  const HalfCircle circle;
  for (std::size_t entry = 0; entry <= SharesTable::intervals; ++entry) {
    const VectorLanes o = direction_at(std::max(lowest_cosine, sides_[0].cosine_of(entry)));
    double sheen = 0;
    double coat = 0;
    if (layers.sheen > 0) sheen = std::min(1.0, layers.sheen * sheen_albedo(circle, o));
    if (layers.coat > 0) {
      coat = layers.coat * coat_albedo(circle, o, layers.coat_roughness,
                                       [](const Lanes&) { return lanes_of(1); });
    }
    for (auto& row : sides_[0].rows_) {
      row.shares[entry].below_sheen = 1 - sheen;
      row.shares[entry].below_coat = (1 - sheen) * (1 - coat);
      row.shares[entry].above = sheen;
    }
    for (auto& row : sides_[1].rows_) {
      row.shares[entry].below_sheen = 1;
      row.shares[entry].below_coat = 1;
    }
  }
  if (layers.coat == 0) return;
  const SharesTable& table = sides_[0];
  for (std::size_t entry = 0; entry <= SharesTable::intervals; ++entry) {
    const VectorLanes o = direction_at(std::max(lowest_cosine, table.cosine_of(entry)));
    const double mirrored =
        coat_albedo(circle, o, layers.coat_roughness, [&](const Lanes& cosines) {
          return share_at(table, &LayerShares<double>::below_sheen, cosines, 0);
        });
    for (auto& row : sides_[0].rows_)
      row.shares[entry].above += row.shares[entry].below_sheen * layers.coat * mirrored;
  }
}

/// Sets what single microfacets leave of light from one side.
void LayerTables::set_leftovers(const Layers& layers, std::size_t side, double roughness,
                                std::size_t row) {
  using Shares = LayerShares<double>;
  const HalfCircle circle;
  const SharesTable& before = sides_[side];
  const SharesTable& behind = sides_[1 - side];
  const bool has_layers = layers.coat > 0 || layers.sheen > 0;
  const double index = side == 0 ? layers.index_behind : 1 / layers.index_behind;
  const bool is_going_straight = is_straight<double>(index);
  const Microfacets<Lanes> facets = {lanes_of(width_of<double>(roughness))};
  const auto below = [&](const SharesTable& table, const Lanes& cosines) {
    return has_layers ? share_at(table, &Shares::below_coat, cosines, roughness) : lanes_of(1);
  };
  for (std::size_t entry = 0; entry <= SharesTable::intervals; ++entry) {
    const VectorLanes o = direction_at(std::max(lowest_cosine, before.cosine_of(entry)));
    Lanes metal{}, dielectric{}, through{};
    for_facets(circle, facets, o, [&](const VectorLanes& h, double share) {
      const VectorLanes back = mirrored_by(o, h);
      const Lanes kept = facets.mirrored_share(o, back) * below(before, back.z);
      const Lanes mirrored = share * select(back.z > 0.0, kept, Lanes{});
      const auto [glass, refracted] = refract<Lanes>(-o, h, lanes_of(1), lanes_of(index));
      metal += mirrored;
      dielectric += glass * mirrored;
      if (!transmits_) return;
      const VectorLanes on = is_going_straight ? -o : refracted;
      const Lanes seen = is_going_straight ? lanes_of(1) : facets.seen(on);
      const Lanes let_through = (1.0 - glass) * seen * below(behind, Lanes(-on.z));
      through += share * select(on.z < 0.0, let_through, Lanes{});
    });

    Shares& shares = sides_[side].rows_[row].shares[entry];
    const auto left = [&](double albedo) {
      return std::max(0.0, 1 - shares.above - shares.below_coat * albedo);
    };
    shares.metal = left(sum_of(metal));
    shares.dielectric = left(sum_of(dielectric));
    shares.transparent = left(sum_of(dielectric) + sum_of(through));
  }
}

std::size_t LayerTables::bytes() const {
  return sizeof *this + sides_.size() * sides_[0].rows_.capacity() * sizeof sides_[0].rows_[0];
}

std::shared_ptr<const LayerTables> LayerTablePool::get(const Layers& layers) {
  std::shared_ptr<const LayerTables>& tables = tables_[layers];
  if (!tables && earlier_ != nullptr) {
    const auto found = earlier_->tables_.find(layers);
    if (found != earlier_->tables_.end()) tables = found->second;
  }
  if (!tables) tables = std::make_shared<const LayerTables>(layers);
  return tables;
}

std::size_t LayerTablePool::bytes() const {
  std::size_t sum = 0;
  for (const auto& [layers, tables] : tables_) sum += tables->bytes();
  return sum;
}

}  // namespace crt::core
