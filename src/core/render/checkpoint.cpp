#include "core/render/checkpoint.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <span>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/render/tracer.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

constexpr std::string_view magic = "CRT checkpoint 6 of " CRT_VERSION "\n";

// These are in seconds. The first checkpoint is to be there after 10, with the time that writing a
// large one takes. Later on writing is to take a small part of the time, whatever the size.
constexpr double first_break = 5;
constexpr double shortest_break = 10;
constexpr double break_per_writing = 20;

/// This many samples on each side distinguish scenes, if the picture has as many pixels.
constexpr int probes_a_side = 32;

template <class... T>
void add(ByteHash& hash, const T&... numbers) {
  static_assert(((std::is_arithmetic_v<T> || std::is_enum_v<T>)&&...));
  (hash.add(std::as_bytes(std::span(&numbers, 1))), ...);
}

void add_settings(ByteHash& hash, const Settings& s) {
  add(hash, s.width, s.height, s.recursion_depth, s.min_weight, s.gamma, s.seed, s.precision,
      s.target_error, s.min_samples, s.max_samples, s.filter, s.filter_width, s.exposure,
      s.tone_map, s.light_samples, s.indirect, s.clamp, s.cutoff, s.denoise);
  if (s.compat != 0) add(hash, s.compat);
}

/// Adds the light along rays through the middles of pixels that are distributed over the region.
void add_light(ByteHash& hash, const Frame& frame, const Region& region, Progress& progress,
               const StepRules& rules) {
  WorkspacePool pool(rules);
  WorkspacePool::Loan work(pool);
  Tracer tracer(frame, *work, progress);
  constexpr double middle = 0.5;
  std::array<PicturePlaceLanes, RayPacket::group_count> places;
  std::array<LensPointLanes, RayPacket::group_count> lens_points;
  lens_points.fill(frame.camera().lens_points(lanes_of(middle), lanes_of(middle)));
  std::array<RayLanes, RayPacket::group_count> rays;
  std::array<Sample, packet_size> all_samples;
  std::size_t count = 0;
  const auto trace = [&] {
    const std::span<Sample> samples = std::span(all_samples).first(count);
    const std::size_t with_lens = frame.features().lens ? lens_points.size() : 0;
    frame.camera().rays(count, places, std::span(lens_points).first(with_lens), rays);
    tracer.trace(rays, samples);
    for (const Sample& sample : samples) {
      for (std::size_t channel = 0; channel < lane_count; ++channel)
        add(hash, sample.channels[channel]);
    }
    count = 0;
  };
  const int columns = std::min(probes_a_side, region.width);
  const int rows = std::min(probes_a_side, region.height);
  for (int row = 0; row < rows; ++row) {
    const double y = region.y + (row + middle) * region.height / rows;
    for (int column = 0; column < columns; ++column) {
      const double x = region.x + (column + middle) * region.width / columns;
      set_lane(places[count / lane_count], count % lane_count, {x, y});
      if (++count == packet_size) trace();
    }
  }
  trace();
}

/// Returns whether there is surely no file. If the system does not say, reading will say why.
bool is_missing(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::status(path, ignored).type() == std::filesystem::file_type::not_found;
}

}  // namespace

std::uint64_t fingerprint(const Frame& frame, const Region& region, const KeptOfPixels& kept,
                          Progress& progress, const StepRules& rules) {
  ByteHash hash;
  add_settings(hash, frame.settings());
  add(hash, region.x, region.y, region.width, region.height, kept.first_hits,
      frame.features().lens);
  if (kept.guides) add(hash, kept.guides);
  add_light(hash, frame, region, progress, rules);
  return hash.value();
}

void leave_empty_checkpoint(const std::filesystem::path& path) {
  if (!is_missing(path)) return;
  write_state_file(path, [](StateWriter& out) { out.put_all(std::span<const char>(magic)); });
}

Checkpoint::Checkpoint(std::filesystem::path path, std::uint64_t fingerprint, Passes& passes,
                       Canvas& canvas, WorkspacePool& pool, const PassClock::Seconds& seconds,
                       double begin)
    : path_(std::move(path)),
      fingerprint_(fingerprint),
      passes_(passes),
      canvas_(canvas),
      pool_(pool),
      seconds_(seconds),
      next_(begin + first_break) {}

void Checkpoint::write() const {
  // While changes are held, the picture, its counts and what is known of its pixels are of the same
  // moment.
  const auto hold = passes_.hold();
  const Image picture = canvas_.copy();
  const std::vector<Guide> guides = canvas_.guides();
  const WorkspacePool::Counts counts = pool_.settled();
  write_state_file(path_, [&](StateWriter& out) {
    out.put_all(std::span<const char>(magic));
    out.put(fingerprint_);
    for (const auto count : summed_counts) out.put(counts.stats.*count);
    out.put(counts.cutoff.units);
    out.put(counts.cutoff.most);
    out.put_all(picture.pixels());
    out.put_all(std::as_bytes(std::span(guides)));
    passes_.store(out);
  });
}

void Checkpoint::keep() noexcept {
  const std::lock_guard one_at_a_time(writing_);
  try {
    const double begin = seconds_();
    write();
    const double end = seconds_();
    next_ = end + std::max(shortest_break, break_per_writing * (end - begin));
  } catch (const std::exception& error) {
    next_ = seconds_() + shortest_break;
    const std::lock_guard lock(complaining_);
    complaint_ = error.what();
  }
}

void Checkpoint::keep_if_due() noexcept {
  double due = next_;
  constexpr double never = std::numeric_limits<double>::infinity();
  // Only the first thread that sees that it is due writes.
  if (due <= seconds_() && next_.compare_exchange_strong(due, never)) keep();
}

std::string Checkpoint::take_complaint() {
  const std::lock_guard lock(complaining_);
  return std::exchange(complaint_, {});
}

void Checkpoint::take_up() {
  if (!is_missing(path_)) read();
  passes_.make_storable([&pool = pool_](Workspace& workspace) { pool.settle(workspace); });
  pool_.settle_all();
}

void Checkpoint::read() {
  StateReader in(path_);
  std::array<char, magic.size()> head;
  in.get_all(std::span<char>(head));
  const bool is_ours = std::string_view(head.data(), head.size()) == magic;
  if (is_ours && in.at_end()) return;  // an empty one
  if (!is_ours || in.get<std::uint64_t>() != fingerprint_) {
    throw Error(
        ErrorCode::invalid_argument,
        text::format(
            "the checkpoint '{}' is of another picture: of another scene, size, part, accuracy, "
            "or by another version of CRT",
            path_.string()),
        "checkpoint");
  }
  WorkspacePool::Counts counts;
  for (const auto count : summed_counts) counts.stats.*count = in.get<std::uint64_t>();
  counts.cutoff.units = in.get<std::uint64_t>();
  counts.cutoff.most = in.get<double>();
  std::vector<float> pixels(4 * pixel_count(canvas_.region()));
  in.get_all(std::span<float>(pixels));
  std::vector<Guide> guides = canvas_.guides();
  in.get_all(std::as_writable_bytes(std::span(guides)));
  passes_.restore(in);
  if (!in.at_end()) in.fail();
  canvas_.put(canvas_.region(), pixels);
  canvas_.set_guides(std::move(guides));
  pool_.set_total(counts);
}

}  // namespace crt::core
